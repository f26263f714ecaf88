//! Arches of wedges, which stand by thrust alone.

use std::f64::consts::PI;

use crate::scene::{BodySpec, Kind, Scene, floor, rectangle};
use crate::stability::case::{Case, Group};
use crate::stability::figures::polygon;
use crate::stability::on_earth;
use crate::stability::rest::{BEARS, Scale, bears};

pub(super) fn cases() -> Vec<Case> {
    vec![arch(false), arch(true), vault()]
}

/// Number of wedges of the arch; odd, so that there is a keystone.
const WEDGES: u32 = 13;
/// Inner and outer radius of the arch, m.
const INNER: f64 = 2.5;
const OUTER: f64 = 3.3;
const FRICTION: f64 = 0.8;
/// Width and height of the load, m.
const LOAD: [f64; 2] = [0.7, 0.5];

/// Where a joint stands, from the right springing, rad.
fn joint(index: u32) -> f64 {
    PI * f64::from(index) / f64::from(WEDGES)
}

fn wedge(index: u32) -> BodySpec {
    let at = |radius: f64, angle: f64| [radius * angle.cos(), radius * angle.sin()];
    let (from, to) = (joint(index), joint(index + 1));
    let spec = polygon(Kind::Dynamic, &[at(INNER, from), at(OUTER, from), at(OUTER, to), at(INNER, to)]);
    BodySpec { friction: FRICTION, ..spec }
}

/// Area of a wedge, m²: of two triangles about the centre, one without the other.
fn wedge_area() -> f64 {
    0.5 * (OUTER * OUTER - INNER * INNER) * joint(1).sin()
}

fn build(is_loaded: bool) -> Scene {
    let mut bodies = vec![BodySpec { friction: FRICTION, ..floor() }];
    bodies.extend((0..WEDGES).map(wedge));
    if is_loaded {
        let top = OUTER * (0.5 * joint(1)).cos();
        let [width, height] = LOAD;
        // Half of the weight of the arch.
        let density = 0.5 * f64::from(WEDGES) * wedge_area() / (width * height);
        let spec = BodySpec { density, friction: FRICTION, ..rectangle(width, height) };
        bodies.push(BodySpec { position: [0.0, top + 0.5 * height], ..spec });
    }
    on_earth(bodies)
}

fn arch(is_loaded: bool) -> Case {
    let load = if is_loaded { " under a block of half its weight on the keystone" } else { "" };
    let statement = format!(
        "A half ring of {WEDGES} wedges, {INNER} m inside and {OUTER} m outside{load}, friction {FRICTION}. Statics \
         (Heyman's safe theorem): a line of thrust can be drawn within the ring that crosses each joint at less than the \
         angle of friction - a test draws it - so it stands. Each wedge {BEARS}."
    );
    let name = if is_loaded { "arch-loaded" } else { "arch" };
    standing(name, statement, build(is_loaded), OUTER)
}

fn standing(name: &str, statement: String, scene: Scene, height: f64) -> Case {
    Case::new(name, Group::Structures, statement, scene, move |lab, scene| {
        let mut run = lab.run(scene);
        let checks = bears(&mut run, 10.0, Scale::of_height(height));
        lab.picture(&run);
        checks
    })
    .seen()
}

/// Parameter of the catenary, half of its length, and the thickness of the vault, m.
const CATENARY: f64 = 3.0;
const HALF_LENGTH: f64 = 6.0;
const THICKNESS: f64 = 0.3;
/// Number of wedges of the vault.
const PIECES: u32 = 21;

/// The corners across a joint of the vault, inside and outside, at an arc length from the crown: the curve is
/// x = a asinh(s/a), y = -√(a² + s²), its normal (s, a)/√(a² + s²).
fn across(length: f64) -> [[f64; 2]; 2] {
    let radius = CATENARY.hypot(length);
    let (x, y) = (CATENARY * (length / CATENARY).asinh(), CATENARY.hypot(HALF_LENGTH) - radius);
    let normal = [length / radius, CATENARY / radius];
    [-0.5, 0.5].map(|side| [x + side * THICKNESS * normal[0], y + side * THICKNESS * normal[1]])
}

fn vault() -> Case {
    let piece = 2.0 * HALF_LENGTH / f64::from(PIECES);
    let stone = |kind, index: f64| {
        let (from, to) = (-HALF_LENGTH + index * piece, -HALF_LENGTH + (index + 1.0) * piece);
        let ([inner, outer], [next_inner, next_outer]) = (across(from), across(to));
        BodySpec { friction: FRICTION, ..polygon(kind, &[inner, next_inner, next_outer, outer]) }
    };
    // The last stones at each end are the ground.
    let ends = [-1.0, f64::from(PIECES)].map(|index| stone(Kind::Fixed, index));
    let stones = (0..PIECES).map(|index| stone(Kind::Dynamic, f64::from(index)));
    let height = CATENARY.hypot(HALF_LENGTH) - CATENARY;
    let statement = format!(
        "A vault along a catenary, {height:.1} m high and {:.1} m wide, of {PIECES} stones {THICKNESS} m thick with joints \
         across it. Statics: the curve of a hanging chain, upside down, carries its own weight by thrust along the \
         curve, square to every joint, so it stands. Each stone {BEARS}.",
        2.0 * CATENARY * (HALF_LENGTH / CATENARY).asinh()
    );
    standing("catenary-vault", statement, on_earth(ends.into_iter().chain(stones)), height)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Outline;

    /// Whether a line of thrust stays within the arch: with a thrust H at height c of the crown, and weights w at x from
    /// the crown on to a joint at the angle θ, the moment about the centre puts the force on the joint at
    /// t = (c H + Σ x w) / (V cos θ + H sin θ) from the centre, V = Σ w; its part across the joint is V cos θ + H sin θ,
    /// that along it V sin θ - H cos θ.
    fn carries(thrust: f64, crown: f64, load: f64) -> bool {
        let wedge_weight = wedge_area();
        // Half of the keystone and of the load, at the middle of its half.
        let mut weight = 0.5 * wedge_weight + 0.5 * load;
        let mut moment = 0.5 * wedge_weight * keystone_arm() + 0.5 * load * 0.25 * LOAD[0];
        (0..=WEDGES / 2).rev().all(|index| {
            let (sin, cos) = joint(index).sin_cos();
            if index < WEDGES / 2 {
                weight += wedge_weight;
                moment += wedge_weight * wedge(index).position[0];
            }
            let pressure = weight * cos + thrust * sin;
            let at = (crown * thrust + moment) / pressure;
            // A hundredth of the thickness is kept from the edges.
            let edge = 0.01 * (OUTER - INNER);
            at > INNER + edge
                && at < OUTER - edge
                && (weight * sin - thrust * cos).abs() < FRICTION * pressure
        })
    }

    /// How far from the middle the centre of half a keystone is, m.
    fn keystone_arm() -> f64 {
        let half = 0.5 * joint(1);
        let [inner, outer] = [INNER, OUTER].map(|radius| radius * half.sin());
        // A trapezium's half from the middle line: (a² + a b + b²) / (3 (a + b)).
        (inner * inner + inner * outer + outer * outer) / (3.0 * (inner + outer))
    }

    #[test]
    fn a_line_of_thrust_can_be_drawn_within_the_arch() {
        let weight = f64::from(WEDGES) * wedge_area();
        for load in [0.0, 0.5 * weight] {
            let is_carried = (1..200).any(|h| {
                (1..50).any(|c| {
                    let thrust = 0.005 * f64::from(h) * weight;
                    carries(thrust, INNER + 0.02 * f64::from(c) * (OUTER - INNER), load)
                })
            });
            assert!(is_carried, "no line for a load of {load}");
        }
    }

    #[test]
    fn wedges_and_stones_have_the_area_they_should() {
        let Outline::Polygon(corners) = wedge(3).outline else { panic!("a wedge is a polygon") };
        let area: f64 = corners
            .iter()
            .zip(corners.iter().cycle().skip(1))
            .map(|([a, b], [c, d])| 0.5 * (a * d - b * c))
            .sum();
        assert!((area - wedge_area()).abs() < 1e-12, "{area} {}", wedge_area());
    }
}
