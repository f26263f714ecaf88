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
    ("pile", 0x0F8D_D161_0A3F_55B1),
    ("pool", 0x7814_3735_F800_8295),
    ("materials", 0x764F_D9D8_6E4E_C121),
    ("slide", 0x54FB_51FC_5A6F_B3E2),
    ("slope", 0xE093_3937_CEA1_76D7),
    ("platforms", 0xC748_B26F_AFD5_5A6F),
    ("attractor", 0x8646_7075_F30A_867F),
    ("polygons", 0x286F_2B58_AF36_9877),
    ("solar_system", 0xA6BE_1264_61D2_67E1),
    ("sandbox", 0x3C3A_6E8D_E23B_0BC4),
    ("tower", 0xBC19_9271_107B_9D80),
    ("far_tower", 0x5584_CD9A_DDFE_2609),
    ("pyramid", 0x6DF0_13E1_DA78_D63B),
    ("card_house", 0x3684_4E22_9C49_6200),
    ("arch", 0x7BF8_A691_6944_6B5F),
    ("dominoes", 0x694F_EEEA_9C34_EC9C),
    ("mass_ratio", 0x76D6_FE30_C682_11AF),
    ("friction_ramp", 0x39BA_FE9E_8A12_3FDD),
    ("cradle", 0xA270_44CD_6A93_452B),
    ("bounce", 0xE33D_37CC_A165_5F40),
    ("billiards", 0x55FB_5FF6_26A7_6421),
    ("confined", 0xD845_6144_94B3_C922),
    ("tumbler", 0xB1C1_46C0_67D3_FA58),
    ("washer", 0x4D37_26AC_4F5C_308D),
    ("spinner", 0x4BB0_E9FF_26F3_8FA7),
    ("wind_tunnel", 0x6262_CFEE_81ED_46DB),
    ("pinball", 0x32C1_2B68_C46A_5BD6),
    ("orbit", 0x9F8A_1F9B_4AED_59DD),
    ("galaxy", 0x29DB_EC05_0A29_9265),
    ("smash", 0x72BA_7B72_A7DA_D2B5),
    ("ball_pit", 0xD61A_3402_F686_79DC),
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
