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
    ("pile", 0x1D3D_1F6B_E425_262E),
    ("pool", 0x3503_B4F2_96C3_D057),
    ("materials", 0x68B8_C6F3_A007_6C58),
    ("slide", 0x43DD_80B8_1653_2312),
    ("slope", 0xCCDE_2628_01CA_F8DD),
    ("platforms", 0x83C6_87D8_0924_8BA4),
    ("attractor", 0xDD67_AF1C_1E74_9C09),
    ("polygons", 0x2465_5644_215A_7E10),
    ("solar_system", 0xA6BE_1264_61D2_67E1),
    ("sandbox", 0x3C3A_6E8D_E23B_0BC4),
    ("tower", 0xBC19_9271_107B_9D80),
    ("far_tower", 0x5584_CD9A_DDFE_2609),
    ("pyramid", 0x8236_C0E6_ADF9_5CBE),
    ("card_house", 0xA645_7E0D_9849_B09A),
    ("arch", 0x2A0C_C9AA_860D_FD5B),
    ("dominoes", 0xFD83_12FA_2586_839A),
    ("mass_ratio", 0x76D6_FE30_C682_11AF),
    ("friction_ramp", 0x3B88_26D8_14EE_AD10),
    ("cradle", 0xA270_44CD_6A93_452B),
    ("bounce", 0x1BB6_304D_8B12_A43C),
    ("billiards", 0x213B_C348_F901_97B2),
    ("confined", 0xAF3C_F978_54FB_9ECA),
    ("tumbler", 0x1B77_C629_8F7A_A426),
    ("washer", 0x58D3_2EE9_587E_9F14),
    ("spinner", 0x0B56_D7E0_44FC_F1D1),
    ("wind_tunnel", 0x6EE3_6647_AE71_33DF),
    ("pinball", 0xB70B_C2B6_A97B_C231),
    ("orbit", 0x9F8A_1F9B_4AED_59DD),
    ("galaxy", 0x0764_99E0_76D5_3DBE),
    ("smash", 0xFAEE_0E6A_0810_1177),
    ("ball_pit", 0x1B81_6310_C03C_2594),
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
