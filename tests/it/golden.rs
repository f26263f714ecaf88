//! Golden hashes: what every scene comes to, bit for bit.
//!
//! The table is the same for debug and release builds and for every machine, so each of them checks all the
//! others. It changes when the motion does, and only then: such a commit says why. To renew it, run
//!
//! ```text
//! RUSTYCS_PRINT_HASHES=1 cargo test --release --test it golden -- --nocapture
//! ```
//!
//! and paste what it prints, once both builds print the same.

use std::fmt::Write as _;

use rustycs::Settings;

/// Length of a run, ticks.
const TICKS: usize = 300;

/// State hash of each scene after [`TICKS`] ticks with seed 1 and default settings.
const GOLDEN: &[(&str, u64)] = &[
    ("pile", 0x70A5_70C1_493D_590B),
    ("pool", 0xEC71_3498_1C8B_179A),
    ("materials", 0x8BB3_8FD3_C9EF_A7DE),
    ("slide", 0xD2B9_FF63_A14F_4349),
    ("slope", 0x02D3_EE2F_47B0_A470),
    ("platforms", 0x2F8D_969C_34E5_1BC1),
    ("attractor", 0xC88E_5CC8_8E2D_25B4),
    ("polygons", 0x9DC5_3D48_4E4F_2F76),
    ("solar_system", 0xA6BE_1264_61D2_67E1),
    ("sandbox", 0x3C3A_6E8D_E23B_0BC4),
    ("tower", 0x915B_E1CF_25A6_5D55),
    ("far_tower", 0x3CC8_D366_564E_C090),
    ("pyramid", 0x06BC_1FE7_639F_333E),
    ("card_house", 0x9104_C25A_B211_15B9),
    ("arch", 0x1FF3_B13B_B1FE_65D0),
    ("dominoes", 0x82F7_B2E4_44E8_2051),
    ("mass_ratio", 0x2FDE_9BCC_3F42_703D),
    ("friction_ramp", 0xCBDF_228B_618D_4ADF),
    ("cradle", 0x7824_96CF_BEDD_475C),
    ("bounce", 0xBEF3_C955_AF58_43C8),
    ("billiards", 0x186A_EEBF_4030_DFFB),
    ("confined", 0xED75_50E3_CB70_C3CC),
    ("tumbler", 0xDC33_0EC1_CABF_3E37),
    ("washer", 0x77CC_2C0F_6912_9CB2),
    ("spinner", 0x1B31_128E_7AD9_D5C4),
    ("wind_tunnel", 0xDCAE_A703_C3B2_2568),
    ("pinball", 0x8D66_9F8A_0ADF_4623),
    ("orbit", 0x9F8A_1F9B_4AED_59DD),
    ("galaxy", 0x5040_F5D4_FA05_453C),
    ("smash", 0x559A_0DD8_71FF_3119),
    ("ball_pit", 0x1637_3262_1B5D_AFF9),
];

fn hashes(threads: usize) -> Vec<(&'static str, u64)> {
    rustycs_scenes::all()
        .iter()
        .map(|scene| {
            let mut world = scene.build(1, Settings { threads, ..Settings::default() });
            world.divide_all_work();
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
fn every_scene_comes_to_its_golden_hash() {
    let hashes = hashes(1);
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

/// However little there is to divide.
#[test]
#[cfg(feature = "parallel")]
fn every_scene_comes_to_its_golden_hash_on_two_three_and_four_threads() {
    for threads in 2..=4 {
        for hash in hashes(threads) {
            assert!(GOLDEN.contains(&hash), "{} moves otherwise on {threads} threads", hash.0);
        }
    }
}
