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
    ("pile", 0xDBE3_D786_1F06_133A),
    ("pool", 0xF442_524A_F450_2BB0),
    ("materials", 0xB23A_C4FF_018F_010C),
    ("slide", 0xBD74_3E4F_AB70_78AD),
    ("slope", 0x5199_B7DF_34EE_1D9D),
    ("platforms", 0x0734_CF9B_3C82_23ED),
    ("attractor", 0xF8C2_AB9B_82BA_3524),
    ("polygons", 0xA3E6_5D29_14A1_4960),
    ("solar_system", 0xA6BE_1264_61D2_67E1),
    ("sandbox", 0x3C3A_6E8D_E23B_0BC4),
    ("tower", 0x637F_A1CC_8D31_F7D5),
    ("far_tower", 0xC85B_3992_9E8F_7154),
    ("pyramid", 0xBB5C_2C79_0187_8479),
    ("card_house", 0xA4EA_E965_C7B8_7480),
    ("arch", 0xFB7E_C322_BDD3_6519),
    ("dominoes", 0x536F_C959_3674_B589),
    ("mass_ratio", 0x787F_73C8_5401_755B),
    ("friction_ramp", 0x122A_82A4_44A7_12D9),
    ("cradle", 0x7824_96CF_BEDD_475C),
    ("bounce", 0x72D1_7E2A_5104_74E4),
    ("billiards", 0x6228_AFE7_20A6_048F),
    ("confined", 0xA770_0E07_9134_EE05),
    ("tumbler", 0x43AD_5B57_191E_54EC),
    ("washer", 0x1293_3041_EF55_45F5),
    ("spinner", 0x4884_6C8D_9DCD_D338),
    ("wind_tunnel", 0x3F25_A62E_67C6_34EC),
    ("pinball", 0x8D66_9F8A_0ADF_4623),
    ("orbit", 0x9F8A_1F9B_4AED_59DD),
    ("galaxy", 0xBE1A_3494_8D8D_F3E2),
    ("smash", 0x5A9D_2017_F250_6720),
    ("ball_pit", 0x51BF_DF67_5BF9_EFAC),
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
