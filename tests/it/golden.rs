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
    ("pile", 0x6BF4_8910_FD2F_4E9E),
    ("pool", 0x0830_0D4E_AFF8_7FAC),
    ("materials", 0x68B8_C6F3_A007_6C58),
    ("slide", 0x011E_2CC0_94AF_C8A2),
    ("slope", 0x762C_0ABF_43B4_09D9),
    ("platforms", 0x3C6D_4906_3109_9ACF),
    ("attractor", 0x506E_5C61_DCF9_1704),
    ("polygons", 0x82C7_7779_7F47_472A),
    ("solar_system", 0xA6BE_1264_61D2_67E1),
    ("sandbox", 0x3C3A_6E8D_E23B_0BC4),
    ("tower", 0x0C95_6A4A_6334_D6A7),
    ("far_tower", 0xC4DE_8FAC_972C_E7FE),
    ("pyramid", 0x0932_969A_65C5_E4DB),
    ("card_house", 0x2FB8_873A_0228_A2A9),
    ("arch", 0xD795_B0F1_4A8D_B386),
    ("dominoes", 0x2A88_BAFC_49A9_2D70),
    ("mass_ratio", 0xB1F2_AA8F_E1B0_0E31),
    ("friction_ramp", 0x7621_B44F_23E2_09B3),
    ("cradle", 0xA270_44CD_6A93_452B),
    ("bounce", 0x7B0F_57B2_D11A_F410),
    ("billiards", 0x98B8_14FB_1F60_E6F9),
    ("confined", 0xAF3C_F978_54FB_9ECA),
    ("tumbler", 0xE197_507D_FD87_D61F),
    ("washer", 0xF404_CA0C_3F5B_A115),
    ("spinner", 0xEDCB_A368_B4FD_4BC0),
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
