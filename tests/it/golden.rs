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
    ("pile", 0x1DE9_B047_0159_5B52),
    ("pool", 0x0E38_7D66_98F0_5DAB),
    ("materials", 0xB23A_C4FF_018F_010C),
    ("slide", 0x0058_2899_C9CC_D7AA),
    ("slope", 0x02D3_EE2F_47B0_A470),
    ("platforms", 0x4462_E59D_6B36_E7C0),
    ("attractor", 0xC88E_5CC8_8E2D_25B4),
    ("polygons", 0x6237_20BB_083B_AAD4),
    ("solar_system", 0xA6BE_1264_61D2_67E1),
    ("sandbox", 0x3C3A_6E8D_E23B_0BC4),
    ("tower", 0x915B_E1CF_25A6_5D55),
    ("far_tower", 0x3CC8_D366_564E_C090),
    ("pyramid", 0x06BC_1FE7_639F_333E),
    ("card_house", 0xABE8_B2FA_085F_77E3),
    ("arch", 0x1FF3_B13B_B1FE_65D0),
    ("dominoes", 0x56FC_8BF5_7AAF_62A9),
    ("mass_ratio", 0x2FDE_9BCC_3F42_703D),
    ("friction_ramp", 0xCBDF_228B_618D_4ADF),
    ("cradle", 0x7824_96CF_BEDD_475C),
    ("bounce", 0x72D1_7E2A_5104_74E4),
    ("billiards", 0x6227_EE3E_7E8D_AE31),
    ("confined", 0x74BD_E673_0899_C1E5),
    ("tumbler", 0xDC33_0EC1_CABF_3E37),
    ("washer", 0x77CC_2C0F_6912_9CB2),
    ("spinner", 0x9E5E_072F_588B_EF7D),
    ("wind_tunnel", 0xBE34_68A0_59B3_8C7B),
    ("pinball", 0x8D66_9F8A_0ADF_4623),
    ("orbit", 0x9F8A_1F9B_4AED_59DD),
    ("galaxy", 0x5040_F5D4_FA05_453C),
    ("smash", 0xE834_D727_7FCD_E563),
    ("ball_pit", 0x5C26_25CD_4736_8A82),
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
