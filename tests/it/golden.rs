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
    ("pile", 0x0D0C_446F_9398_45D3),
    ("pool", 0xB98C_D6F4_C641_9249),
    ("materials", 0x8C98_48CB_7688_9095),
    ("slide", 0x48A1_D652_92B8_CC60),
    ("slope", 0xABA0_4238_C5FB_5EA1),
    ("platforms", 0xA5C4_AB39_C2F6_A4E6),
    ("attractor", 0x94FF_E18E_9E56_DCAE),
    ("polygons", 0xF169_8A45_BDE8_7B97),
    ("solar_system", 0xA6BE_1264_61D2_67E1),
    ("sandbox", 0x3C3A_6E8D_E23B_0BC4),
    ("tower", 0xBBA6_D5AA_F64C_0821),
    ("far_tower", 0x28EB_CAE0_1443_1CD0),
    ("pyramid", 0xDE24_7DC9_362F_7080),
    ("card_house", 0xB0C8_44BF_B1B0_B08B),
    ("arch", 0x0A35_6A8A_55F4_DBF6),
    ("dominoes", 0x7D3D_C261_2798_3709),
    ("mass_ratio", 0x1AFB_6635_E209_4446),
    ("friction_ramp", 0x5C50_6ED8_E580_BAA4),
    ("cradle", 0x7824_96CF_BEDD_475C),
    ("bounce", 0x7AC3_473C_3361_C064),
    ("billiards", 0xE693_9E4B_F8A4_2775),
    ("confined", 0xA770_0E07_9134_EE05),
    ("tumbler", 0xC2D4_2AAB_3B60_66A4),
    ("washer", 0x4553_0844_7E65_130F),
    ("spinner", 0x655B_186F_F8F0_FCF1),
    ("wind_tunnel", 0xED2E_FD89_DA2A_1223),
    ("pinball", 0x8D66_9F8A_0ADF_4623),
    ("orbit", 0x9F8A_1F9B_4AED_59DD),
    ("galaxy", 0x9BDE_C0FF_C286_D560),
    ("smash", 0x33A8_0A0B_B20D_C817),
    ("ball_pit", 0xB378_3801_0D5D_86B8),
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
