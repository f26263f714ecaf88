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
    ("pile", 0xE227_3C99_421C_FB6C),
    ("pool", 0x0830_0D4E_AFF8_7FAC),
    ("materials", 0x68B8_C6F3_A007_6C58),
    ("slide", 0x621B_DA12_D381_524F),
    ("slope", 0xCCDE_2628_01CA_F8DD),
    ("platforms", 0xEDA4_1943_C446_448F),
    ("attractor", 0x506E_5C61_DCF9_1704),
    ("polygons", 0xDF48_837E_2F22_C471),
    ("solar_system", 0xA6BE_1264_61D2_67E1),
    ("sandbox", 0x3C3A_6E8D_E23B_0BC4),
    ("tower", 0xBC19_9271_107B_9D80),
    ("far_tower", 0x5584_CD9A_DDFE_2609),
    ("pyramid", 0xB68D_462F_16FA_8443),
    ("card_house", 0x2FB8_873A_0228_A2A9),
    ("arch", 0x2A0C_C9AA_860D_FD5B),
    ("dominoes", 0x2FF7_F247_1429_E3C1),
    ("mass_ratio", 0x76D6_FE30_C682_11AF),
    ("friction_ramp", 0x3B88_26D8_14EE_AD10),
    ("cradle", 0xA270_44CD_6A93_452B),
    ("bounce", 0x7B0F_57B2_D11A_F410),
    ("billiards", 0x98B8_14FB_1F60_E6F9),
    ("confined", 0xAF3C_F978_54FB_9ECA),
    ("tumbler", 0xFFA1_09C0_89BA_758D),
    ("washer", 0x4EC5_1F5A_5470_503B),
    ("spinner", 0x36C0_E077_C090_4B64),
    ("wind_tunnel", 0xF9E2_D705_3282_1070),
    ("pinball", 0xB70B_C2B6_A97B_C231),
    ("orbit", 0x9F8A_1F9B_4AED_59DD),
    ("galaxy", 0x968B_B482_9F0E_9B04),
    ("smash", 0xA8E4_3644_3D47_C1DA),
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
