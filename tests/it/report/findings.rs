//! What a study finds is so.

use rustycs::prelude::*;
use rustycs::report::{Exact, Measure, Reference, Study};

use crate::report::{break_of_discs, planet, sliding, thrown};
use crate::support::{G, add, assert_near, assert_relative};

/// Where the thrown disc is after a time, s, with another gravity, m/s².
fn flight(g: f64) -> impl Fn(f64) -> Vec<Exact> {
    move |t| vec![Exact::at([3.0 * t, 4.0 * t - 0.5 * g * t * t]).angle(2.0 * t)]
}

/// A single kick per substep is wrong by g t h / 2 in free fall: first order, and at 60 Hz with one substep
/// off by 9.81 · 1 / 120 m after a second.
#[test]
fn free_fall_with_a_single_kick_is_of_first_order() {
    let base = Settings { split_kick: false, ..Settings::default() };
    let study =
        || Study::new(thrown).base(base.clone()).tick_rates([30.0, 60.0, 120.0, 240.0]).substeps([1, 4]);
    let exact = study().exact(flight(G)).run().unwrap();
    assert_near(exact.order().unwrap(), 1.0, 0.01, "order against the closed form");
    assert_relative(exact.rows()[1].error, G / 120.0, 1e-3, "error at 60 Hz");
    assert!(matches!(exact.reference(), Reference::ClosedForm));
    // The reference has a step of a quarter of the finest: the slope is 1.05 there, see the module `order`.
    let finer = study().run().unwrap();
    assert_near(finer.order().unwrap(), 1.0, 0.06, "order against finer settings");
    assert!(!finer.is_chaotic());
    // Its own error is what the closed form says: g t h / 2, with h = 1 / (960 · 4) s.
    assert_relative(finer.reference_error(), G / (2.0 * 960.0 * 4.0), 0.05, "error of the reference");
}

/// Half a kick before and half after the drift is velocity Verlet: second order.
#[test]
fn a_kepler_orbit_with_a_split_kick_is_of_second_order() {
    let report = Study::new(planet)
        .duration(std::f64::consts::TAU)
        .tick_rates([15.0, 30.0, 60.0, 120.0])
        .substeps([1, 2])
        .also("classic", [60.0, 120.0, 240.0].map(|tick_rate| Settings { tick_rate, ..Settings::classic() }))
        .run()
        .unwrap();
    assert!(!report.is_chaotic(), "{:?}", report.growth());
    assert_near(report.order().unwrap(), 2.0, 0.1, "order");
    assert_near(report.order_of("classic").unwrap(), 1.0, 0.15, "order of the classic scheme");
    assert_eq!(report.order_of("nothing"), None);
}

/// A fall in a world with 1 % too much gravity is off by 1 % of the way that gravity adds.
#[test]
fn a_planted_error_of_one_per_cent_is_seen() {
    let report = Study::new(thrown).exact(flight(1.01 * G)).run().unwrap();
    assert_relative(report.rows()[0].error, 0.01 * 0.5 * G, 1e-3, "error");
    let planted = Settings { tick_rate: 240.0, gravitational_constant: 1.01, ..Settings::default() };
    let good = Settings { gravitational_constant: 1.0, ..planted.clone() };
    let report = Study::new(planet)
        .duration(3.0)
        .tick_rates([120.0])
        .also("planted", [planted])
        .also("good", [good])
        .run();
    let report = report.unwrap();
    let [sweep, planted, good] = report.rows() else { panic!("three rows were asked for") };
    assert!(planted.error > 100.0 * sweep.error, "{planted:?} {sweep:?}");
    assert!(good.error < 0.5 * sweep.error || good.is_as_good_as_reference(), "{good:?} {sweep:?}");
    assert!(report.front().iter().all(|row| row.label != planted.label));
}

/// Free flight is exact up to rounding: every row is as good as the reference, and the cheapest is the front.
#[test]
fn rows_within_the_error_of_the_reference_are_not_ranked() {
    let report = Study::new(thrown).tick_rates([30.0, 60.0, 120.0]).substeps([1, 4]).run().unwrap();
    assert!(report.rows().iter().all(rustycs::report::Row::is_as_good_as_reference), "{:?}", report.rows());
    let [only] = report.front()[..] else { panic!("one row is enough") };
    assert_eq!(only.label, "30 Hz × 1");
    assert_eq!(report.order(), None);
    assert!(report.recommend(0.5 * report.reference_error()).is_none());
}

/// The samples fall between ticks of 1/60 s: the cubic through both ticks is the parabola of the flight.
#[test]
fn samples_between_ticks_are_exact_for_constant_forces() {
    let report = Study::new(thrown).duration(0.7131).samples(17).exact(flight(G)).run().unwrap();
    assert!(report.rows()[0].error < 1e-6, "{}", report.rows()[0].error);
}

#[test]
fn a_break_of_many_discs_is_chaotic_and_compares_the_energy() {
    let report =
        Study::new(break_of_discs).duration(4.0).tick_rates([60.0, 120.0]).substeps([2, 4]).run().unwrap();
    assert!(report.is_chaotic(), "{:?}", report.growth());
    assert_eq!(report.measure(), "drift of the energy");
    assert!(report.to_markdown().contains("Chaotic"));
    assert!(report.rows().iter().all(|row| row.error == row.invariants.energy_drift));
}

#[test]
fn sliding_and_orbits_are_not_chaotic() {
    for (name, scene) in [("slide", sliding as fn(Settings) -> World), ("orbit", planet)] {
        let report = Study::new(scene).duration(6.0).tick_rates([60.0, 120.0]).run().unwrap();
        assert!(!report.is_chaotic(), "{name}: {:?}", report.growth());
        assert_eq!(report.measure(), "error of the trajectory");
    }
}

/// One tick makes a disc in free flight 1 % faster: the energy is 2.01 % more than before, 2.01 / 102.01 of the
/// largest.
#[test]
fn a_planted_gain_of_energy_is_seen() {
    let free = |settings| {
        let mut world = World::new(settings);
        add(&mut world, Body::dynamic(Shape::circle(0.5)).velocity([2.0, 0.0]));
        world
    };
    let faster = |world: &mut World| {
        if world.ticks() == 30 {
            let id = world.bodies().next().unwrap().0;
            world.body_mut(id).unwrap().set_velocity([2.02, 0.0]);
        }
    };
    for measure in [Measure::EnergyDrift, Measure::EnergyGain] {
        let report = Study::new(free).measure(measure).before_each_tick(faster).run().unwrap();
        assert_near(report.rows()[0].error, 2.01 / 102.01, 1e-6, report.measure());
    }
    for measure in [Measure::MomentumDrift, Measure::AngularMomentumDrift] {
        let report = Study::new(free).measure(measure).run().unwrap();
        assert_eq!(report.rows()[0].error, 0.0, "{}", report.measure());
    }
}

/// A quantity of the caller's own, against finer settings and against its closed form: v = 5 - µ g t.
#[test]
fn quantities_and_errors_of_the_callers_own_are_measured() {
    let speed = |world: &World| f64::from(world.bodies().nth(1).unwrap().1.velocity().x);
    let quantity = || Measure::quantity("speed", "m/s", speed);
    let finer =
        Study::new(sliding).duration(0.5).measure(quantity()).tick_rates([60.0, 120.0]).run().unwrap();
    let exact = Study::new(sliding).duration(0.5).samples(10).measure(quantity());
    let exact = exact.exact_value(|t| 5.0 - 0.5 * G * t).run().unwrap();
    for report in [finer, exact] {
        assert_eq!((report.measure(), report.unit()), ("speed", "m/s"));
        assert!(report.rows().iter().all(|row| row.error < 0.1), "{:?}", report.rows());
    }
    let depth = Measure::error("depth", "m", |world| f64::from(world.error().penetration));
    let own = Study::new(sliding).measure(depth).run().unwrap();
    let row = &own.rows()[0];
    assert_eq!(row.error, row.invariants.penetration);
}

/// Without a clock nothing depends on the machine: two reports are the same. With one there is a time.
#[test]
fn a_report_is_the_same_in_every_run_and_has_times_only_with_a_clock() {
    fn clock() -> f64 {
        static TICKS: std::sync::atomic::AtomicU32 = std::sync::atomic::AtomicU32::new(0);
        f64::from(TICKS.fetch_add(1, std::sync::atomic::Ordering::Relaxed))
    }
    let study = || Study::new(sliding).tick_rates([30.0, 60.0]).substeps([1, 2]);
    let [one, other] = [(); 2].map(|()| study().run().unwrap());
    assert_eq!(one.to_csv(), other.to_csv());
    assert_eq!(one.to_svg(), other.to_svg());
    let timed = study().clock(clock).repeats(2).run().unwrap();
    for (row, untimed) in timed.rows().iter().zip(one.rows()) {
        let time = row.run_time.expect("there was a clock");
        assert_eq!((time.runs, time.least, time.most, row.cost()), (2, 1.0, 1.0, 1.0));
        assert_eq!((row.error, untimed.run_time), (untimed.error, None));
    }
}

/// Adaptive substeps are rows of their own, and cost what they take: awake, no less than they begin with.
#[test]
fn adaptive_substeps_are_swept_and_their_cost_is_what_they_take() {
    let tower = rustycs_scenes::find("tower").expect("the scene is there");
    let study = Study::new(|settings| tower.build(1, settings))
        .base(Settings { sleep: false, ..Settings::default() });
    let report = study.substeps([1, 2]).adaptive([false, true]).run().unwrap();
    let labels: Vec<&str> = report.rows().iter().map(|row| row.label.as_str()).collect();
    assert_eq!(labels, ["60 Hz × 1", "60 Hz × 2", "60 Hz × 1 adaptive", "60 Hz × 2 adaptive"]);
    let costs: Vec<f64> = report.rows().iter().map(rustycs::report::Row::cost).collect();
    assert_eq!(&costs[..2], [120.0, 240.0]);
    assert!(costs[2] >= costs[0] && costs[3] >= costs[1], "{costs:?}");
}
