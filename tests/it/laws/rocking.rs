//! A plank that rocks on a drum.

use std::f64::consts::{PI, TAU};

use rustycs::prelude::*;

use crate::support::{G, add, assert_relative, spin};

/// Radius of the drum, and half the thickness of the plank, m.
const DRUM: f64 = 0.5;
const HALF: f64 = 0.05;

/// A plank of this length, m, that rocks on a fixed drum without slipping.
struct Rocking {
    world: World,
    plank: BodyId,
    /// k² of the plank about its centre, m².
    square: f64,
    /// m/s².
    gravity: f64,
}

impl Rocking {
    /// Let go leaning by `lean`, rad. It touches the drum, which it has rolled on since it lay level, R φ from its middle.
    fn new(length: f64, lean: f64, gravity: f64) -> Self {
        let mut world = World::new(Settings::default());
        world.add_force(Force::new("gravity", [0.0, -gravity as f32]));
        let drum = Body::fixed(Shape::circle(DRUM as f32)).rolling_resistance(0.0);
        add(&mut world, drum.friction(2.0).restitution(0.0));
        let (sin, cos) = lean.sin_cos();
        let (up, along) = (DRUM + HALF, DRUM * lean);
        let plank = Body::dynamic(Shape::obb(length as f32, 2.0 * HALF as f32));
        let plank = plank.at([up * sin - along * cos, up * cos + along * sin]).angle(-lean as f32);
        let plank = add(&mut world, plank.friction(2.0).restitution(0.0));
        Self { world, plank, square: (length * length + 4.0 * HALF * HALF) / 12.0, gravity }
    }

    fn lean(&self) -> f64 {
        -f64::from(self.world.body(self.plank).unwrap().angle())
    }

    /// Angular frequency of small swings, rad/s: ω² = g (R - h)/(k² + h²).
    fn frequency(&self) -> f64 {
        (self.gravity * (DRUM - HALF) / (self.square + HALF * HALF)).sqrt()
    }

    /// Energy per mass, J/kg, above that of rest: g ((R + h)(cos φ - 1) + R φ sin φ) + (k² + h² + R² φ²) φ'²/2.
    fn energy(&self) -> f64 {
        let (lean, rate) = (self.lean(), spin(&self.world, self.plank));
        let height = (DRUM + HALF) * (lean.cos() - 1.0) + DRUM * lean * lean.sin();
        self.gravity * height + 0.5 * (self.square + HALF * HALF + (DRUM * lean).powi(2)) * rate * rate
    }
}

/// A swing whose normal and arm are late by half a step gains ω² dt/2 of its energy per second: e^(20 s · ω² dt/2) is 9 for
/// the long plank and 5,000 for the short one. Those of halfway through a step give nothing: what a step does to place
/// and speed has the determinant (1 - a)² + 2a - a² = 1, a = ω² dt²/2.
///
/// Arms hold still in a step in which the plank turns by φ' dt: it sinks in by h (φ' dt)²/2 more than is seen before the step
/// ends, and is pushed out at 28/s, so that it lies d = h φ'² dt/(2 · 28/s) deeper at its fastest. Of the energy per weight, g
/// (R - h) φ₀²/2, no more than g d is lost in a half swing, with φ' = ω φ₀: h ω² dt/(28/s · (R - h)) of it.
#[test]
fn a_plank_on_a_drum_rocks_on_with_the_energy_it_had() {
    for length in [2.0, 1.0] {
        let mut rocking = Rocking::new(length, 0.05, G);
        let (before, omega) = (rocking.energy(), rocking.frequency());
        let lost_per_half = HALF * omega * omega / (60.0 * 28.0 * (DRUM - HALF));
        for _ in 0..20 * 60 {
            rocking.world.step();
            let half_swings = 1.0 + rocking.world.time() * omega / PI;
            assert_relative(rocking.energy(), before, half_swings * lost_per_half, "energy");
        }
    }
}

/// With the first terms beyond φ², of inertia k² + h² + R² φ² and of height (R - h) φ²/2 - (3 R - h) φ⁴/24, a swing takes
/// longer by φ₀² (R²/(k² + h²) + (3 R - h)/(4 (R - h)))/4 of itself. The midpoint rule makes it shorter by ω² dt²/24 = 6e-4, the
/// overlap of 1e-4 m longer by half its share of R - h, 1e-4.
#[test]
fn a_plank_on_a_drum_rocks_as_slowly_as_the_radii_tell() {
    let lean = 0.05_f64;
    let mut rocking = Rocking::new(1.0, lean, G);
    let (mut before, mut first, mut last, mut swings) = (rocking.lean(), None, 0.0, 0);
    for _ in 0..20 * 60 {
        rocking.world.step();
        let now = rocking.lean();
        if before > 0.0 && now <= 0.0 {
            last = rocking.world.time() + now / (before - now) / 60.0;
            swings += u32::from(first.is_some());
            first.get_or_insert(last);
        }
        before = now;
    }
    let rolls = DRUM * DRUM / (rocking.square + HALF * HALF);
    let falls_away = (3.0 * DRUM - HALF) / (4.0 * (DRUM - HALF));
    let expected = TAU / rocking.frequency() * (1.0 + lean * lean * (rolls + falls_away) / 4.0);
    assert_relative((last - first.unwrap()) / f64::from(swings), expected, 1e-3, "period");
}

/// Under a great load a swing is faster than the midpoint rule can follow, for which swings of ω dt > 2 grow, at 2.5 to four times as much
/// in each step. In the substeps, of ω h = 0.6, it grows by no more than 1/√(1 - (ω h)²/4), 5 %.
#[test]
fn a_swing_that_is_fast_under_its_load_does_not_grow() {
    for adaptive in [true, false] {
        let lean = 0.002;
        let mut rocking = Rocking::new(0.3, lean, 541.0);
        rocking.world.set_settings(Settings { adaptive, ..rocking.world.settings().clone() }).unwrap();
        let swing = rocking.frequency() / 60.0;
        assert!((2.4..2.6).contains(&swing), "{swing}");
        for _ in 0..10 * 60 {
            rocking.world.step();
            assert!(rocking.lean().abs() < 1.06 * lean, "{} rad", rocking.lean());
        }
    }
}
