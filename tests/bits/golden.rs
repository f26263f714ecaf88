//! Golden hashes: what some scenes come to, bit for bit; together they use every kind of shape, contact and event.
//!
//! The table is the same for debug and release builds and for every machine, so each of them checks all the
//! others. It changes when the motion does, and only then: such a commit says why, and the test
//! `motion` of `it` says whether it has got worse. To renew it, run
//!
//! ```text
//! RUSTYCS_PRINT_HASHES=1 cargo test --release --test bits golden -- --nocapture
//! ```
//!
//! and paste what it prints, once both builds print the same.

use std::fmt::Write as _;

use rustycs::Settings;

/// Length of a run, ticks.
const TICKS: usize = 300;

/// State hash of each scene after [`TICKS`] ticks with seed 1 and default settings.
const GOLDEN: &[(&str, u64)] = &[
    ("pile", 0xAD66_C566_DD85_BACB),
    ("pool", 0x2C4D_0748_727C_BEF4),
    ("materials", 0xB205_0F2C_4C4A_83B5),
    ("platforms", 0x1060_54D5_7824_0635),
    ("far_tower", 0xA088_7AFD_EC9D_88A7),
    ("card_house", 0x46B7_F5CC_E017_FE24),
    ("bounce", 0x1558_2EDA_59DA_0250),
    ("tumbler", 0xF1AF_D037_D2C0_C992),
    ("pinball", 0xAF84_2DEC_57AE_E46B),
    ("galaxy", 0x93F2_1D80_5041_65A5),
];

fn hashes() -> Vec<(&'static str, u64)> {
    rustycs_scenes::all()
        .iter()
        .filter(|scene| GOLDEN.iter().any(|&(golden, _)| golden == scene.name))
        .map(|scene| {
            let mut world = scene.build(1, Settings::default());
            for _ in 0..TICKS {
                scene.before_tick(&mut world);
                world.step();
            }
            (scene.name, world.state_hash())
        })
        .collect()
}

/// The table as source text.
fn table(hashes: &[(&str, u64)]) -> String {
    hashes.iter().fold(String::new(), |mut text, &(name, hash)| {
        let [a, b, c, d] = [48, 32, 16, 0].map(|shift| hash >> shift & 0xFFFF);
        _ = writeln!(text, "    (\"{name}\", 0x{a:04X}_{b:04X}_{c:04X}_{d:04X}),");
        text
    })
}

#[test]
fn scenes_come_to_their_golden_hashes() {
    let hashes = hashes();
    if std::env::var_os("RUSTYCS_PRINT_HASHES").is_some() {
        println!("const GOLDEN: &[(&str, u64)] = &[\n{}];", table(&hashes));
        return;
    }
    let moved: Vec<&str> =
        hashes.iter().filter(|hash| !GOLDEN.contains(hash)).map(|&(name, _)| name).collect();
    assert!(
        moved.is_empty() && hashes.len() == GOLDEN.len(),
        "the motion of {moved:?} has changed; the table is now\n{}",
        table(&hashes)
    );
}
