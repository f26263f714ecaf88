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
    ("pile", 0x88BF_E972_3284_AC87),
    ("pool", 0x9ACB_62E8_A38A_C45C),
    ("materials", 0x764F_D9D8_6E4E_C121),
    ("slide", 0x0072_04DA_ABC1_F4A6),
    ("slope", 0xE807_E891_196B_7052),
    ("platforms", 0x7A8F_9ADF_B3C0_D182),
    ("attractor", 0x78E5_9544_1953_0A82),
    ("polygons", 0x1408_9DD7_63CE_0397),
    ("solar_system", 0xA6BE_1264_61D2_67E1),
    ("sandbox", 0x3C3A_6E8D_E23B_0BC4),
    ("tower", 0xBC19_9271_107B_9D80),
    ("far_tower", 0x5584_CD9A_DDFE_2609),
    ("pyramid", 0x8236_C0E6_ADF9_5CBE),
    ("card_house", 0x3684_4E22_9C49_6200),
    ("arch", 0x2A0C_C9AA_860D_FD5B),
    ("dominoes", 0x7B9B_666E_E6DF_614F),
    ("mass_ratio", 0x76D6_FE30_C682_11AF),
    ("friction_ramp", 0x3B88_26D8_14EE_AD10),
    ("cradle", 0xA270_44CD_6A93_452B),
    ("bounce", 0xE33D_37CC_A165_5F40),
    ("billiards", 0xAAA8_AEEB_B2C0_8B29),
    ("confined", 0xD845_6144_94B3_C922),
    ("tumbler", 0x4AEE_E99F_28FC_AA6B),
    ("washer", 0x2CBE_A685_6286_3EEA),
    ("spinner", 0x4150_A771_CD8E_ECB0),
    ("wind_tunnel", 0xFA3D_9A7A_7651_046C),
    ("pinball", 0x32C1_2B68_C46A_5BD6),
    ("orbit", 0x9F8A_1F9B_4AED_59DD),
    ("galaxy", 0x93E3_581C_8752_9AD0),
    ("smash", 0x73A6_1F02_4202_74A3),
    ("ball_pit", 0xA30C_1B31_B0AC_CCD5),
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
