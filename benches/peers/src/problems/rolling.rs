//! Rolling: down a slope, out of a slide, and in a bowl.

use std::f64::consts::TAU;

use rustycs::report::Unit;

use crate::problems::friction::Slope;
use crate::problems::{Class, G, Problem, Range, block, disc, distance, floor, on_earth};
use crate::scene::BodySpec;

pub(super) fn problems() -> Vec<Problem> {
    vec![roll(), slip_to_roll(), bowl()]
}

/// I = m r²/2 of a disc: of a force along its way, two thirds move it on and the rest turns it.
const ROLLING: f64 = 2.0 / 3.0;

fn roll() -> Problem {
    const RADIUS: f64 = 0.5;
    const DURATION: f64 = 2.0;
    let slope = Slope::new(10.0);
    let acceleration = ROLLING * G * 10.0_f64.to_radians().sin();
    let way = 0.5 * acceleration * DURATION * DURATION;
    Problem {
        name: "roll".into(),
        statement: "A disc rolls from rest down 10° with µ = 0.6: s = r θ = (2/3) g sin 10° t²/2, for 2 s."
            .into(),
        measure: "largest error of the way s and of r θ / way",
        unit: Unit::Part,
        class: Class::Smooth,
        scene: slope.scene(BodySpec { friction: 0.6, ..disc(RADIUS) }, RADIUS),
        duration: DURATION,
        error: Box::new(move |run| {
            run.largest(|run| {
                let exact = 0.5 * acceleration * run.time() * run.time();
                // It turns clockwise.
                let errors = [slope.way(run.state(0)) - exact, -RADIUS * run.turned(0) - exact];
                errors[0].abs().max(errors[1].abs())
            }) / way
        }),
        range: Range::Full,
        goal: None,
        note: "",
    }
}

fn slip_to_roll() -> Problem {
    const RADIUS: f64 = 0.5;
    const SPEED: f64 = 6.0;
    const FRICTION: f64 = 0.3;
    const DURATION: f64 = 2.0;
    // It slows by µ g while µ m g r spins it up, until v = w r.
    let rolls_from = SPEED / (3.0 * FRICTION * G);
    let exact = move |t: f64| {
        let slips = t.min(rolls_from);
        SPEED * slips - 0.5 * FRICTION * G * slips * slips + ROLLING * SPEED * (t - slips)
    };
    let way = exact(DURATION);
    let sliding =
        BodySpec { position: [-5.0, RADIUS], velocity: [SPEED, 0.0], friction: FRICTION, ..disc(RADIUS) };
    Problem {
        name: "slip-to-roll".into(),
        statement:
            "A disc is set down sliding at v₀ = 6 m/s with µ = 0.3. It slows by µ g until it rolls, after \
                    v₀/(3µg) = 0.68 s, at (2/3) v₀."
                .into(),
        measure: "largest error of the way / way in 2 s, and of the speed / v₀",
        unit: Unit::Part,
        class: Class::Smooth,
        scene: on_earth([BodySpec { friction: FRICTION, ..floor() }, sliding]),
        duration: DURATION,
        error: Box::new(move |run| {
            let of_way = run.largest(|run| (run.state(0).position[0] + 5.0 - exact(run.time())).abs()) / way;
            let of_speed = (run.state(0).velocity[0] - ROLLING * SPEED).abs() / SPEED;
            of_way.max(of_speed)
        }),
        range: Range::Full,
        goal: None,
        note: "",
    }
}

/// A bowl of flat facets that touch a circle of this radius, m.
const BOWL: f64 = 5.0;
/// Radius of the bead, m.
const BEAD: f64 = 0.5;
/// Facets of the full circle.
const FACETS: i32 = 256;
/// The facet on which the bead is set down, counted from the lowest one: 24/256 of a turn is 34°.
const FIRST: i32 = -24;
/// Facets on either side of the lowest one.
const BUILT: i32 = 32;
/// By how much the box of a facet goes on beyond its ends, into the ground behind its neighbours, m: a bead at 3 m/s
/// meets the face of the next box and not its corner, at 30 Hz too.
const OVERLAP: f64 = 0.15;

/// Angle between two facets, rad.
fn corner() -> f64 {
    TAU / f64::from(FACETS)
}

/// Where the bead is: on which facet, how far from its middle (m), and how fast (m/s).
#[derive(Clone, Copy, Debug)]
struct Bead {
    facet: i32,
    along: f64,
    speed: f64,
}

impl Bead {
    fn place(self) -> [f64; 2] {
        let (sin, cos) = (f64::from(self.facet) * corner()).sin_cos();
        let deep = BOWL - BEAD;
        [deep * sin + self.along * cos, -deep * cos + self.along * sin]
    }

    /// Rolls on for `time` s. On a facet at the angle θ its acceleration is -(2/3) g sin θ. At a corner of angle δ it
    /// hits the next facet without bouncing: about the new point of contact its angular momentum
    /// m v r (cos δ + 1/2) is kept and is (3/2) m v' r after, so that v' = v (1 + 2 cos δ)/3.
    fn roll(&mut self, mut time: f64) {
        let half = (BOWL - BEAD) * (0.5 * corner()).tan();
        let kept = (1.0 + 2.0 * corner().cos()) / 3.0;
        while let Some((passes, side)) = self.next_corner(half).filter(|&(passes, _)| passes <= time) {
            self.speed = (self.speed + self.acceleration() * passes) * kept;
            self.facet += side;
            self.along = -f64::from(side) * half;
            time -= passes;
        }
        self.along += self.speed * time + 0.5 * self.acceleration() * time * time;
        self.speed += self.acceleration() * time;
    }

    /// m/s².
    fn acceleration(self) -> f64 {
        -ROLLING * G * (f64::from(self.facet) * corner()).sin()
    }

    /// When it comes to an end of its facet, which is `half` a facet from the middle, and to which: +1 or -1.
    fn next_corner(self, half: f64) -> Option<(f64, i32)> {
        let (v, a) = (self.speed, self.acceleration());
        let arrival = |side: i32| {
            let left = f64::from(side) * half - self.along;
            // a t²/2 + v t = left, solved without cancellation. On leaving a corner t = 0 is no arrival.
            let q = -0.5 * (v + (v * v + 2.0 * a * left).sqrt().copysign(v));
            let times = [2.0 * q / a, -left / q];
            times
                .into_iter()
                .filter(|&time| time > 1e-12 && time.is_finite())
                .reduce(f64::min)
                .map(|time| (time, side))
        };
        [arrival(1), arrival(-1)].into_iter().flatten().min_by(|one, other| one.0.total_cmp(&other.0))
    }
}

fn bowl() -> Problem {
    let start = Bead { facet: FIRST, along: 0.0, speed: 0.0 };
    let mut bodies = Vec::new();
    for facet in -BUILT..=BUILT {
        let angle = f64::from(facet) * corner();
        let middle = BOWL + 0.5;
        bodies.push(BodySpec {
            position: [middle * angle.sin(), -middle * angle.cos()],
            angle,
            ..block(2.0 * (BOWL * (0.5 * corner()).tan() + OVERLAP), 1.0)
        });
    }
    bodies.push(BodySpec { position: start.place(), ..disc(BEAD) });
    let swing = (BOWL - BEAD) * -f64::from(FIRST) * corner();
    Problem {
        name: "bowl".into(),
        statement: "A disc of r = 0.5 m swings, rolling, in a bowl of R = 5 m made of flat facets, 256 to the circle, \
                    for 10 s (about two swings). The exact motion is that in the bowl of facets, not in a round one: \
                    s'' = -(2/3) g sin θ on each, and v' = v (1 + 2 cos δ)/3 at each corner of δ = 1.4°."
            .into(),
        measure: "largest distance from the exact place / first amplitude",
        unit: Unit::Part,
        class: Class::Smooth,
        scene: on_earth(bodies),
        duration: 10.0,
        error: Box::new(move |run| {
            run.largest(|run| {
                let mut exact = start;
                exact.roll(run.time());
                distance(run.state(0).position, exact.place())
            }) / swing
        }),
        range: Range::Full,
        goal: None,
        note: "What is left is the give of the contact, of first order: set down on the surface, the disc sinks in by \
               0.14 g h/(2 · 28/s), 0.1 mm at default settings, and the energy of that is missing in every swing.",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The arrivals at corners, against very small steps of the same law.
    #[test]
    fn the_bead_rolls_as_small_steps_have_it() {
        let half = (BOWL - BEAD) * (0.5 * corner()).tan();
        let kept = (1.0 + 2.0 * corner().cos()) / 3.0;
        let mut exact = Bead { facet: FIRST, along: 0.0, speed: 0.0 };
        let mut stepped = exact;
        let step = 1e-6;
        for _ in 0..50 {
            exact.roll(0.1);
            for _ in 0..100_000 {
                stepped.along += stepped.speed * step + 0.5 * stepped.acceleration() * step * step;
                stepped.speed += stepped.acceleration() * step;
                if stepped.along.abs() > half {
                    let side = stepped.along.signum();
                    stepped.facet += side as i32;
                    stepped.along -= 2.0 * half * side;
                    stepped.speed *= kept;
                }
            }
            assert!(distance(exact.place(), stepped.place()) < 2e-5, "{exact:?} {stepped:?}");
        }
    }

    /// In a round bowl a small swing takes 2π √(3 (R - r) / 2g).
    #[test]
    fn the_bead_swings_in_the_time_of_a_pendulum() {
        let mut bead = Bead { facet: -4, along: 0.0, speed: 0.0 };
        let quarter = 0.25 * TAU * (1.5 * (BOWL - BEAD) / G).sqrt();
        let mut time = 0.0;
        while bead.place()[0] < 0.0 {
            bead.roll(1e-3);
            time += 1e-3;
        }
        assert!((time / quarter - 1.0).abs() < 0.03, "{time} s, a round bowl takes {quarter} s");
    }

    /// On a facet it keeps (3/4) v² + g y, per mass; at a corner it loses some.
    #[test]
    fn the_bead_never_gains_energy_and_keeps_it_on_a_facet() {
        let energy = |bead: Bead| 0.75 * bead.speed * bead.speed + G * bead.place()[1];
        let mut bead = Bead { facet: FIRST, along: 0.0, speed: 0.0 };
        for _ in 0..20_000 {
            let before = bead;
            bead.roll(1e-3);
            let gain = energy(bead) - energy(before);
            assert!(
                gain < 1e-9 && (gain > -1e-9 || bead.facet != before.facet),
                "{gain} J/kg: {before:?} {bead:?}"
            );
        }
        assert!(bead.facet.abs() < -FIRST, "{bead:?}");
    }
}
