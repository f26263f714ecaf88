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
    ("pile", 0xAE44_542C_C6CA_E2A7),
    ("pool", 0xC337_83B0_F69B_EB26),
    ("materials", 0x6808_273D_F851_DCA0),
    ("slide", 0x304C_F876_DC06_C073),
    ("slope", 0xCD26_4EDE_EA7F_0C3C),
    ("platforms", 0xBF08_B910_0470_57E9),
    ("attractor", 0xF797_707A_30F9_D32D),
    ("polygons", 0x49DF_6380_3344_D376),
    ("solar_system", 0xA6BE_1264_61D2_67E1),
    ("sandbox", 0x3C3A_6E8D_E23B_0BC4),
    ("tower", 0x4FDC_9549_A48E_BB4C),
    ("far_tower", 0x9BAB_3E2B_6582_615D),
    ("pyramid", 0x5A43_8FBE_C67F_F6AC),
    ("card_house", 0xAC9D_8BA6_ABC2_8915),
    ("arch", 0x321B_4B0F_E822_18B4),
    ("dominoes", 0x8AF3_5A74_EE25_D6EE),
    ("mass_ratio", 0x1B6A_0C3F_2869_2CAD),
    ("friction_ramp", 0xFCE4_B67B_5587_E24C),
    ("cradle", 0x7824_96CF_BEDD_475C),
    ("bounce", 0x7730_F741_0EC3_BB58),
    ("billiards", 0x24FD_EC72_B8F5_922B),
    ("confined", 0xBB11_23E0_F6BA_7F05),
    ("tumbler", 0x0A0D_DE04_73B5_15BA),
    ("washer", 0x9F39_848B_FC34_2679),
    ("spinner", 0x11CA_47E4_F54A_9A71),
    ("wind_tunnel", 0x1D35_9E18_EB6E_1795),
    ("pinball", 0x8D66_9F8A_0ADF_4623),
    ("orbit", 0x9F8A_1F9B_4AED_59DD),
    ("galaxy", 0x336A_4109_9B1C_40D5),
    ("smash", 0xFF6F_96FF_E949_D090),
    ("ball_pit", 0x34C5_A818_F331_AAEC),
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
