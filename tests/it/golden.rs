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
    ("pile", 0xF32F_AB71_EACF_DEF8),
    ("pool", 0x5EF0_D765_7B48_588B),
    ("materials", 0xB9F3_6753_0B18_3D22),
    ("slide", 0x4C3A_B9E7_C1A8_9538),
    ("slope", 0x3DE7_C9E3_A43A_FC93),
    ("platforms", 0x41DF_2984_AFF0_16F1),
    ("attractor", 0xA22A_D2CA_47A5_D695),
    ("polygons", 0xA26C_C779_7EFC_63A8),
    ("solar_system", 0xA6BE_1264_61D2_67E1),
    ("sandbox", 0x3C3A_6E8D_E23B_0BC4),
    ("tower", 0xBC19_9271_107B_9D80),
    ("far_tower", 0x5584_CD9A_DDFE_2609),
    ("pyramid", 0x8236_C0E6_ADF9_5CBE),
    ("card_house", 0xAB70_488D_68F9_D254),
    ("arch", 0x2A0C_C9AA_860D_FD5B),
    ("dominoes", 0x8484_403A_04CC_6FFA),
    ("mass_ratio", 0x76D6_FE30_C682_11AF),
    ("friction_ramp", 0x3B88_26D8_14EE_AD10),
    ("cradle", 0xA270_44CD_6A93_452B),
    ("bounce", 0x2606_9759_B3F2_5609),
    ("billiards", 0xAAA8_AEEB_B2C0_8B29),
    ("confined", 0x2142_3C3B_5794_4D54),
    ("tumbler", 0x0863_EE68_3CD8_55E1),
    ("washer", 0xBF50_F6CE_2A92_AC4C),
    ("spinner", 0x620B_5739_CE43_EDB3),
    ("wind_tunnel", 0xB2FF_17B9_0828_B0A3),
    ("pinball", 0x32C1_2B68_C46A_5BD6),
    ("orbit", 0x9F8A_1F9B_4AED_59DD),
    ("galaxy", 0x9C53_33C2_6118_28C5),
    ("smash", 0x02E4_144F_2187_31AE),
    ("ball_pit", 0x82B9_8E2C_E5CE_B1B5),
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
