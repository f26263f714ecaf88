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
    ("pile", 0x4F2E_0530_2BC2_FBC6),
    ("pool", 0xAD69_3048_985C_E6FC),
    ("materials", 0xAD07_8EC9_3676_E8FF),
    ("slide", 0x11E3_7CEB_7453_041F),
    ("slope", 0xB097_76E0_1294_623B),
    ("platforms", 0xF8A9_DC46_3EA1_429A),
    ("attractor", 0x7C31_4B76_6498_B3AC),
    ("polygons", 0x6BD1_047E_D16C_FC53),
    ("solar_system", 0xA6BE_1264_61D2_67E1),
    ("sandbox", 0x3C3A_6E8D_E23B_0BC4),
    ("tower", 0xC405_F6FB_193B_9115),
    ("far_tower", 0x8E66_8849_F0EE_3138),
    ("pyramid", 0xE926_8230_9108_88C0),
    ("card_house", 0x08F0_5D5F_4A1E_5B6D),
    ("arch", 0xEB3F_5728_0AB8_16E5),
    ("dominoes", 0xD4FE_1FAC_FCC8_D6AA),
    ("mass_ratio", 0x2EBE_2712_5E68_1259),
    ("friction_ramp", 0xD8A4_CC92_2F5D_93D4),
    ("cradle", 0xA270_44CD_6A93_452B),
    ("bounce", 0x308B_1A45_3E2E_7FF7),
    ("billiards", 0xBE3A_5B8C_2FFC_FA87),
    ("confined", 0x3D8A_8B1E_875F_37BF),
    ("tumbler", 0x62D5_1A54_AEBB_4468),
    ("washer", 0x395D_2F26_198B_8355),
    ("spinner", 0x6ACB_E407_9D5C_7C1B),
    ("wind_tunnel", 0xE4AF_6602_10DE_7E33),
    ("pinball", 0x59B6_DFE9_2CE6_D344),
    ("orbit", 0x9F8A_1F9B_4AED_59DD),
    ("galaxy", 0x08EF_7A9D_774B_B6A5),
    ("smash", 0xC38E_7DB2_4E58_099E),
    ("ball_pit", 0x031D_EF26_0A48_8379),
];

fn hashes() -> Vec<(&'static str, u64)> {
    rustycs_scenes::all()
        .iter()
        .map(|scene| {
            let mut world = scene.build(1, Settings::default());
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
    let hashes = hashes();
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
