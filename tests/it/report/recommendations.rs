//! What is recommended is good enough, with another seed too.

use rustycs::prelude::*;
use rustycs::report::{Measure, Study};

use crate::support::add;

/// A scene of the demo in which every dynamic body begins with a push of its own, up to 2 cm/s, by the seed.
fn pushed(name: &str, seed: u64, settings: Settings) -> World {
    let mut world = rustycs_scenes::find(name).expect("the scene is there").build(seed, settings);
    let dynamic = world.bodies().filter(|(_, body)| body.body_type() == BodyType::Dynamic);
    let ids: Vec<BodyId> = dynamic.map(|(id, _)| id).collect();
    let mut angle = seed as f32;
    for id in ids {
        angle += 2.4;
        let mut body = world.body_mut(id).unwrap();
        let velocity = body.view().velocity() + Rot::from_angle(angle).rotate(Vec2::new(0.02, 0.0));
        body.set_velocity(velocity);
    }
    world
}

#[test]
fn recommended_settings_meet_the_tolerance_with_another_seed() {
    for (name, tolerance, duration) in
        [("tower", 10e-3, 1.0), ("slope", 20e-3, 1.5), ("orbit", 1e-3, 5.0), ("bounce", 10e-3, 1.0)]
    {
        let study = |seeds: &[u64]| {
            Study::with_seeds(seeds.to_vec(), |seed, settings| pushed(name, seed, settings))
                .duration(duration)
        };
        let report = study(&[1, 2, 3]).tick_rates([30.0, 60.0, 120.0]).substeps([1, 2, 4, 8]).run().unwrap();
        assert_eq!(report.unit(), "m", "{name} is chaotic: {:?}", report.growth());
        let row = report.recommend(tolerance).unwrap_or_else(|| panic!("{name}:\n{}", report.to_markdown()));
        let reference = Settings { tick_rate: 480.0, substeps: 8, sleep: false, ..Settings::default() };
        let again = study(&[77]).base(row.settings.clone()).reference_settings(reference).run().unwrap();
        let error = again.rows()[0].error;
        assert!(error <= tolerance, "{name} at {}: {error} m of {tolerance} m", row.label);
    }
}

/// A pile, in which trajectories are chaotic and the seed places the bodies: the overlap.
#[test]
fn recommended_settings_keep_the_overlap_of_a_pile_within_the_tolerance_with_another_seed() {
    let study = |seeds: &[u64]| {
        let pile = rustycs_scenes::find("pile").expect("the scene is there");
        let study = Study::with_seeds(seeds.to_vec(), |seed, settings| pile.build(seed, settings));
        study.duration(1.0).measure(Measure::Penetration)
    };
    let report = study(&[1, 2, 3]).tick_rates([60.0, 120.0]).substeps([2, 4, 8]).run().unwrap();
    let row = report.recommend(0.1).unwrap_or_else(|| panic!("{}", report.to_markdown()));
    let again = study(&[77]).base(row.settings.clone()).run().unwrap();
    let error = again.rows()[0].error;
    assert!(error <= 0.1, "at {}: {error} m", row.label);
}

/// Of two that meet the tolerance the cheaper one, of those that do not none.
#[test]
fn the_cheapest_row_that_is_good_enough_is_recommended() {
    let fall = |settings| {
        let mut world = World::new(Settings { split_kick: false, ..settings });
        world.add_force(Force::EARTH_GRAVITY);
        add(&mut world, Body::dynamic(Shape::circle(0.5)));
        world
    };
    // After a second it is off by g h / 2: 82, 41 and 20 mm.
    let report = Study::new(fall).tick_rates([60.0, 120.0, 240.0]).substeps([1]).run().unwrap();
    let recommended = |tolerance: f64| report.recommend(tolerance).map(|row| row.settings.tick_rate);
    assert_eq!(recommended(100e-3), Some(60.0));
    assert_eq!(recommended(50e-3), Some(120.0));
    assert_eq!(recommended(25e-3), Some(240.0));
    assert_eq!(recommended(10e-3), None);
    assert_eq!(recommended(f64::NAN), None);
}
