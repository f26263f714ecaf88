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
    ("pile", 0xF6CD_361D_697C_19A1),
    ("pool", 0xB853_6921_FBC6_E6C7),
    ("materials", 0xABE2_9A34_10C6_8800),
    ("slide", 0xABA8_9369_C185_7A57),
    ("slope", 0x099D_0F10_8195_94EF),
    ("platforms", 0x19CA_5CFE_9907_81E8),
    ("attractor", 0xAA90_57E4_47EC_762C),
    ("polygons", 0x7FD5_80F2_3FF9_2BC8),
    ("solar_system", 0xA6BE_1264_61D2_67E1),
    ("sandbox", 0x3C3A_6E8D_E23B_0BC4),
    ("tower", 0x8C2E_8E2E_7161_E27D),
    ("far_tower", 0x29DF_4C68_3159_556C),
    ("pyramid", 0xF473_60F5_E780_7C60),
    ("card_house", 0x4B52_32AB_084A_B915),
    ("arch", 0x5403_ADE7_678F_FFF3),
    ("dominoes", 0xD80D_036E_05DC_5D2E),
    ("mass_ratio", 0x5EA4_D2FF_5992_9BAA),
    ("friction_ramp", 0x6A3D_7CC8_54FE_779E),
    ("cradle", 0x9232_C499_910D_85AD),
    ("bounce", 0x6025_4DA5_6719_59A7),
    ("billiards", 0x9C51_62E0_94FE_163A),
    ("confined", 0x1F65_AB8F_6763_EC01),
    ("tumbler", 0xDCD8_2B78_2900_B06F),
    ("washer", 0x0E05_D8C0_AA74_3477),
    ("spinner", 0xD27E_802F_13D3_E8C7),
    ("wind_tunnel", 0x7178_F0F7_D097_63B3),
    ("pinball", 0xAF84_2DEC_57AE_E46B),
    ("orbit", 0x9F8A_1F9B_4AED_59DD),
    ("galaxy", 0xA981_95D8_BE1D_A277),
    ("smash", 0x22E2_6BAC_1E0A_9AC9),
    ("ball_pit", 0xC585_1612_0B9E_1867),
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
