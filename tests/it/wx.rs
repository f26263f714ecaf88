use rustycs::prelude::*;
#[test]
#[ignore = "explores"]
fn pile() {
    let scene = rustycs_scenes::find("pile").unwrap();
    for (n, ticks) in [(4, 1), (1u32, 1), (2, 1), (3, 1), (1, 3), (8, 1)] {
        let mut world = scene.build(1, Settings::default());
        for _ in 0..90 {
            world.step();
        }
        let usual = world.settings().clone();
        world.set_settings(Settings { substeps: n, ..usual.clone() }).unwrap();
        let mut line = format!("{n} {ticks}:");
        let log = |w: &World| {
            let (s, id, b) = w
                .bodies()
                .map(|(id, b)| (b.velocity().length(), id, b))
                .max_by(|a, b| a.0.total_cmp(&b.0))
                .unwrap();
            format!(" {s:.2}/{:?}/{:.4}", id.to_bits() as u32, b.mass())
        };
        for _ in 0..ticks {
            world.step();
            line += &log(&world);
        }
        line += " |";
        world.set_settings(usual).unwrap();
        for _ in 0..10 {
            world.step();
            line += &log(&world);
        }
        println!("{line}");
    }
}
