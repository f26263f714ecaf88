//! Closed worlds by chance, and the laws that hold for all of them: momentum, angular momentum, and energy that is never made.
//! The same holds wherever the world is, however it is turned, and in a mirror.

mod worlds;

use rustycs::prelude::*;
use worlds::{ClosedWorld, View};

/// Momentum may change by this share of Σ m |v|: rounding of `f32`, 6e-8 in each of some hundred impulses to a body.
const MOMENTUM: f64 = 1e-5;
/// Angular momentum may change by this share of Σ |x × m v| + |I w| about the common centre.
const ANGULAR_MOMENTUM: f64 = 1e-3;
/// Energy may grow by this share of what it began with.
const ENERGY: f64 = 1e-3;

/// What is kept, and the sums of its absolute values; about the common centre of mass.
#[derive(Clone, Copy, Debug, Default)]
struct Kept {
    momentum: [f64; 2],
    angular: f64,
    energy: f64,
    /// Σ m |v|.
    motion: f64,
    /// Σ m |x| |v| + |I w|.
    turning: f64,
}

fn kept(world: &World) -> Kept {
    let mut kept = Kept::default();
    let (mut mass, mut center) = (0.0, [0.0; 2]);
    for (_, body) in world.bodies() {
        let m = f64::from(body.mass());
        mass += m;
        for (sum, x) in center.iter_mut().zip(body.position_f64()) {
            *sum += m * x;
        }
    }
    for (_, body) in world.bodies() {
        let (m, inertia) = (f64::from(body.mass()), f64::from(body.inertia()));
        let [x, y] = [0, 1].map(|axis| body.position_f64()[axis] - center[axis] / mass);
        let (vx, vy) = (f64::from(body.velocity().x), f64::from(body.velocity().y));
        let w = f64::from(body.angular_velocity());
        let spin = if w == 0.0 { 0.0 } else { inertia * w };
        kept.momentum[0] += m * vx;
        kept.momentum[1] += m * vy;
        kept.angular += m * (x * vy - y * vx) + spin;
        kept.energy += 0.5 * (m * (vx * vx + vy * vy) + spin * w);
        kept.motion += m * vx.hypot(vy);
        kept.turning += m * x.hypot(y) * vx.hypot(vy) + spin.abs();
    }
    kept
}

/// The greatest breach of each law, as a share: momentum, angular momentum, energy.
#[derive(Clone, Copy, Debug, Default)]
struct Breach {
    momentum: f64,
    angular: f64,
    energy: f64,
}

fn breach(closed: &ClosedWorld, seed: u64, view: View) -> Breach {
    let mut world = closed.build(view);
    let (first, all_turn) = (kept(&world), closed.all_turn());
    let mut worst = Breach::default();
    for tick in 0..closed.ticks() {
        closed.before_tick(tick, &mut world);
        world.step();
        world.validate().unwrap_or_else(|fault| panic!("seed {seed}, {view:?}: {fault}"));
        let now = kept(&world);
        let change = (now.momentum[0] - first.momentum[0]).hypot(now.momentum[1] - first.momentum[1]);
        worst.momentum = worst.momentum.max(change / first.motion);
        if all_turn {
            worst.angular = worst.angular.max((now.angular - first.angular).abs() / first.turning);
        }
        worst.energy = worst.energy.max(now.energy / first.energy - 1.0);
    }
    worst
}

/// The laws that a world breaks, seen from all sides.
#[derive(Debug, Default, PartialEq)]
struct Broken {
    /// What is said of them: momentum, energy.
    faults: Vec<String>,
    /// Whether angular momentum is, in any view.
    angular: bool,
}

fn broken(closed: &ClosedWorld, seed: u64) -> Broken {
    let mut broken = Broken::default();
    for view in [View::AsItIs, View::Shifted, View::Turned, View::Mirrored] {
        let Breach { momentum, angular, energy } = breach(closed, seed, view);
        if momentum > MOMENTUM || energy > ENERGY {
            broken
                .faults
                .push(format!("seed {seed}, {view:?}: momentum by {momentum:e}, energy by {energy:e}"));
        }
        broken.angular |= angular > ANGULAR_MOMENTUM;
    }
    broken
}

/// The worlds below [`SOME`] whose angular momentum changes by more than it may, a known failure: without restitution, a blow
/// that is fast for the length of a substep is answered before it is due, where the arms of the two bodies differ by the way
/// that is still to go, and by sweeps whose arms hold still within the step. One that comes to hold is taken off the list.
const ANGULAR_FAILURES: &[u64] = &[
    25, 46, 47, 49, 56, 78, 84, 111, 117, 122, 126, 135, 152, 174, 187, 215, 228, 232, 244, 275, 278, 289,
    300, 328, 379, 396, 397,
];

/// The same of worlds of compounds, of half as many.
const ANGULAR_FAILURES_OF_COMPOUNDS: &[u64] = &[1, 34, 35, 46, 47, 49, 56, 78, 84, 111, 152, 188];

/// The same of worlds of capsules and round corners.
const ANGULAR_FAILURES_OF_ROUNDED: &[u64] =
    &[34, 35, 46, 49, 52, 56, 84, 103, 111, 117, 132, 152, 155, 179, 197];

/// How many worlds are looked at in each run, and how many in a long one.
const SOME: u64 = 400;
const MANY: u64 = 20_000;

#[test]
fn closed_worlds_keep_momentum_and_make_no_energy_wherever_they_are() {
    let all: Vec<(u64, Broken)> =
        (0..SOME).map(|seed| (seed, broken(&ClosedWorld::new(seed), seed))).collect();
    let faults: Vec<&String> = all.iter().flat_map(|(_, broken)| &broken.faults).collect();
    assert!(faults.is_empty(), "{faults:#?}");
    let angular: Vec<u64> = all.iter().filter(|(_, broken)| broken.angular).map(|&(seed, _)| seed).collect();
    assert_eq!(angular, ANGULAR_FAILURES, "angular momentum changes in other worlds than those known");
}

/// The same of bodies of several shapes. Their angular momentum changes for the same reason, about as often.
#[test]
fn closed_worlds_of_compounds_keep_momentum_and_make_no_energy() {
    let all: Vec<(u64, Broken)> =
        (0..SOME / 2).map(|seed| (seed, broken(&ClosedWorld::of_compounds(seed), seed))).collect();
    let faults: Vec<&String> = all.iter().flat_map(|(_, broken)| &broken.faults).collect();
    assert!(faults.is_empty(), "{faults:#?}");
    let angular: Vec<u64> = all.iter().filter(|(_, broken)| broken.angular).map(|&(seed, _)| seed).collect();
    assert_eq!(
        angular, ANGULAR_FAILURES_OF_COMPOUNDS,
        "angular momentum changes in other worlds than those known"
    );
}

/// The same of capsules and of polygons with round corners, mixed with all others.
#[test]
fn closed_worlds_of_round_corners_keep_momentum_and_make_no_energy() {
    let all: Vec<(u64, Broken)> =
        (0..SOME / 2).map(|seed| (seed, broken(&ClosedWorld::of_rounded(seed), seed))).collect();
    let faults: Vec<&String> = all.iter().flat_map(|(_, broken)| &broken.faults).collect();
    assert!(faults.is_empty(), "{faults:#?}");
    let angular: Vec<u64> = all.iter().filter(|(_, broken)| broken.angular).map(|&(seed, _)| seed).collect();
    assert_eq!(
        angular, ANGULAR_FAILURES_OF_ROUNDED,
        "angular momentum changes in other worlds than those known"
    );
}

/// Seeds that change from run to run are printed where a law is broken.
#[test]
#[ignore = "20,000 worlds from four sides, some minutes; the 400 above are like them"]
fn twenty_thousand_closed_worlds_keep_momentum_and_make_no_energy() {
    let now = std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH).expect("it is after 1970");
    let first = now.as_secs() << 16;
    let mut angular = 0;
    let mut faults = Vec::new();
    for seed in first..first + MANY {
        let Broken { faults: of_world, angular: is_angular } = broken(&ClosedWorld::new(seed), seed);
        faults.extend(of_world);
        angular += u64::from(is_angular);
    }
    println!(
        "angular momentum changes by more than {ANGULAR_MOMENTUM:e} in {angular} of {MANY} worlds from {first} on"
    );
    assert!(faults.is_empty(), "{faults:#?}");
}
