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
    ("pile", 0xB524_46F1_3E76_ADE1),
    ("pool", 0xAD69_3048_985C_E6FC),
    ("materials", 0xAD07_8EC9_3676_E8FF),
    ("slide", 0x43BE_338A_B8E0_4F62),
    ("slope", 0x0251_EF0F_D4A8_7397),
    ("platforms", 0x8406_89AB_020D_7296),
    ("attractor", 0x7C31_4B76_6498_B3AC),
    ("polygons", 0xE905_F0A4_57E4_35C4),
    ("solar_system", 0xA6BE_1264_61D2_67E1),
    ("sandbox", 0x3C3A_6E8D_E23B_0BC4),
    ("tower", 0xD551_4F4B_1BD7_162D),
    ("far_tower", 0x9E84_B5C6_1070_3FC0),
    ("pyramid", 0x62B6_B2DE_3EAD_E0D7),
    ("card_house", 0x08F0_5D5F_4A1E_5B6D),
    ("arch", 0xB37F_6B6F_ABB3_BB98),
    ("dominoes", 0xAED8_7EC8_1591_26F5),
    ("mass_ratio", 0xEEFA_51B3_A696_C7DF),
    ("friction_ramp", 0xF1F2_27DC_A4D6_CEDD),
    ("cradle", 0xA270_44CD_6A93_452B),
    ("bounce", 0x308B_1A45_3E2E_7FF7),
    ("billiards", 0xBE3A_5B8C_2FFC_FA87),
    ("confined", 0x3D8A_8B1E_875F_37BF),
    ("tumbler", 0xBC22_DA3D_51FE_7DF8),
    ("washer", 0x811F_8C6C_14C7_2764),
    ("spinner", 0x16EB_7849_1210_7908),
    ("wind_tunnel", 0x732B_8F97_B6EF_E7AF),
    ("pinball", 0x59B6_DFE9_2CE6_D344),
    ("orbit", 0x9F8A_1F9B_4AED_59DD),
    ("galaxy", 0x08EF_7A9D_774B_B6A5),
    ("smash", 0xAA8E_A41B_B9C4_F7E9),
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
