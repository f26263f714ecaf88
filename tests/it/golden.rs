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
    ("pile", 0xB205_C012_7DC4_ECF7),
    ("pool", 0x7AA2_2C85_7131_005C),
    ("materials", 0xB23A_C4FF_018F_010C),
    ("slide", 0x407F_0920_3414_B3A9),
    ("slope", 0x2121_C0AF_E321_1025),
    ("platforms", 0x3586_2C21_E56C_9C04),
    ("attractor", 0xF7D9_A2DD_56AB_D6D9),
    ("polygons", 0x0056_15CA_BC8A_78E8),
    ("solar_system", 0xA6BE_1264_61D2_67E1),
    ("sandbox", 0x3C3A_6E8D_E23B_0BC4),
    ("tower", 0x915B_E1CF_25A6_5D55),
    ("far_tower", 0x3CC8_D366_564E_C090),
    ("pyramid", 0x06BC_1FE7_639F_333E),
    ("card_house", 0xB47B_31B1_0806_BE82),
    ("arch", 0x1FF3_B13B_B1FE_65D0),
    ("dominoes", 0x638A_234C_B9C2_92C9),
    ("mass_ratio", 0x2FDE_9BCC_3F42_703D),
    ("friction_ramp", 0xCBDF_228B_618D_4ADF),
    ("cradle", 0x7824_96CF_BEDD_475C),
    ("bounce", 0x72D1_7E2A_5104_74E4),
    ("billiards", 0xE693_9E4B_F8A4_2775),
    ("confined", 0xA770_0E07_9134_EE05),
    ("tumbler", 0x3D3B_2C03_C32B_8915),
    ("washer", 0x9DFE_488D_7C4F_E698),
    ("spinner", 0xF941_0E80_66A2_A532),
    ("wind_tunnel", 0xB7A4_EC59_491E_E081),
    ("pinball", 0x8D66_9F8A_0ADF_4623),
    ("orbit", 0x9F8A_1F9B_4AED_59DD),
    ("galaxy", 0x92E8_3983_400A_8277),
    ("smash", 0x6D03_2CA6_4917_36A0),
    ("ball_pit", 0xB4C5_538D_2608_E54F),
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
