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
    ("pile", 0x1490_8ADB_E214_2D81),
    ("pool", 0x8749_9CAD_7385_7397),
    ("materials", 0xABE2_9A34_10C6_8800),
    ("slide", 0x27F6_7519_CAC7_2A70),
    ("slope", 0x4BF6_0A5A_3E2C_82FF),
    ("platforms", 0x9096_06E1_9C44_34BD),
    ("attractor", 0x09F7_F6DA_E8AD_61B6),
    ("polygons", 0xA859_1EBE_DF3C_4903),
    ("solar_system", 0xA6BE_1264_61D2_67E1),
    ("sandbox", 0x3C3A_6E8D_E23B_0BC4),
    ("tower", 0x9356_ECFC_9C8A_64C0),
    ("far_tower", 0x9B17_5D18_56AA_3B25),
    ("pyramid", 0x4F63_AC9E_ABCE_3F9A),
    ("card_house", 0x4B52_32AB_084A_B915),
    ("arch", 0xDF3C_088B_F3E4_A815),
    ("dominoes", 0x4018_5A45_0683_5000),
    ("mass_ratio", 0xC862_59B8_1AF2_D1BD),
    ("friction_ramp", 0xA195_8E90_E20A_E987),
    ("cradle", 0x9232_C499_910D_85AD),
    ("bounce", 0x6025_4DA5_6719_59A7),
    ("billiards", 0x9C51_62E0_94FE_163A),
    ("confined", 0x34CF_2EE9_D8C6_8E55),
    ("tumbler", 0xA98B_F516_722C_059D),
    ("washer", 0x74DC_7D51_85E0_4D24),
    ("spinner", 0x07B8_8699_4EFD_005F),
    ("wind_tunnel", 0xAFB9_8A72_C2C8_5774),
    ("pinball", 0xAF84_2DEC_57AE_E46B),
    ("orbit", 0x9F8A_1F9B_4AED_59DD),
    ("galaxy", 0xFD8E_1B6C_FDDC_2B2C),
    ("smash", 0x8043_9DA4_ADD7_C4F1),
    ("ball_pit", 0x2BAF_291E_9C82_F643),
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
