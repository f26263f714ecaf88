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
    ("pile", 0x6DC9_476A_2135_E136),
    ("pool", 0xBD1D_0794_F10C_C6F4),
    ("materials", 0xAD07_8EC9_3676_E8FF),
    ("slide", 0x5C36_8019_8DCF_024C),
    ("slope", 0x5822_C7E0_616F_AAD4),
    ("platforms", 0x9898_6168_11CA_2F92),
    ("attractor", 0x0CEE_5B54_2F09_0296),
    ("polygons", 0x761C_37FE_66A7_DB08),
    ("solar_system", 0xA6BE_1264_61D2_67E1),
    ("sandbox", 0x3C3A_6E8D_E23B_0BC4),
    ("tower", 0x91BE_47C3_2A19_2AE2),
    ("far_tower", 0xCB4E_889C_EB5C_CAE7),
    ("pyramid", 0xE6CD_3741_8AC2_14B1),
    ("card_house", 0x5E2E_DC95_2AB2_4840),
    ("arch", 0xD393_1517_5165_3CE7),
    ("dominoes", 0x525A_B54E_D8BC_8B9E),
    ("mass_ratio", 0x16DF_3A87_F365_07A5),
    ("friction_ramp", 0xB0BB_EA15_EAC5_BE11),
    ("cradle", 0xA270_44CD_6A93_452B),
    ("bounce", 0x308B_1A45_3E2E_7FF7),
    ("billiards", 0x7636_F6DD_5EE6_1857),
    ("confined", 0x3D8A_8B1E_875F_37BF),
    ("tumbler", 0x2495_B2C6_8235_D10E),
    ("washer", 0x06E3_E2D9_022D_6349),
    ("spinner", 0xD73C_76D7_4230_743B),
    ("wind_tunnel", 0x20DB_E7DF_0FDB_4C9C),
    ("pinball", 0x59B6_DFE9_2CE6_D344),
    ("orbit", 0x9F8A_1F9B_4AED_59DD),
    ("galaxy", 0x08EF_7A9D_774B_B6A5),
    ("smash", 0x745C_7B90_0F12_3295),
    ("ball_pit", 0x0F1E_DF92_CAA6_20D1),
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
