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
    ("pile", 0x56BD_F8FB_35BB_CD40),
    ("pool", 0xB779_FFD6_323C_C38D),
    ("materials", 0x0616_0556_BED9_85E2),
    ("slide", 0x0A7E_FCF8_AE6D_B439),
    ("slope", 0xE96D_48CC_7C52_4A57),
    ("platforms", 0x1210_D439_9C8D_748F),
    ("attractor", 0x506E_5C61_DCF9_1704),
    ("polygons", 0xD7D9_CA4D_1743_D36D),
    ("solar_system", 0xA6BE_1264_61D2_67E1),
    ("sandbox", 0x3C3A_6E8D_E23B_0BC4),
    ("tower", 0x0E8F_33C8_A9EA_4954),
    ("far_tower", 0x8EDC_3A18_608F_5295),
    ("pyramid", 0x728E_5CED_BF4B_BEC6),
    ("card_house", 0x3FE1_ADFA_857E_4D2E),
    ("arch", 0x2296_BAE9_AACA_4136),
    ("dominoes", 0x5739_CB00_345B_50F2),
    ("mass_ratio", 0x6860_DFCB_B33A_E977),
    ("friction_ramp", 0xD61C_E7E3_AA4C_DA88),
    ("cradle", 0xA270_44CD_6A93_452B),
    ("bounce", 0x0F5B_EB8E_8C5A_7A32),
    ("billiards", 0x98B8_14FB_1F60_E6F9),
    ("confined", 0x7A42_EDAB_38BA_AB36),
    ("tumbler", 0xE197_507D_FD87_D61F),
    ("washer", 0xE95E_A574_1203_8F63),
    ("spinner", 0xCD96_685E_F8C9_D738),
    ("wind_tunnel", 0xF9E2_D705_3282_1070),
    ("pinball", 0xB70B_C2B6_A97B_C231),
    ("orbit", 0x9F8A_1F9B_4AED_59DD),
    ("galaxy", 0x968B_B482_9F0E_9B04),
    ("smash", 0xBA19_9AF3_74A1_25B1),
    ("ball_pit", 0xCC48_C403_EEFA_EB18),
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
