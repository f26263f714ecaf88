//! Laws of manifolds, each against the slow twin in [`reference`] on random pairs of every kind.

mod known;
mod reference;
mod rounded;
mod segment;
mod time_of_impact;

use crate::collision::detection::{aabb_aabb, box_box, detect_within, polygon_polygon};
use crate::collision::{FeatureId, Manifold};
use crate::math::{Rot, Vec2};
use crate::shape::Shape;
use crate::shape::testing::{random_shapes, rng};
use crate::testing::Random;
use reference::{Solid, gap_along, signed_distance, wide};

/// Shapes are at most 4 m apart and 3 m large; a length comes from some ten roundings of half an epsilon each:
/// 10 · 6e-8 · 4 m.
const ROUNDING: f64 = 2.4e-6;

struct Case {
    a: Shape,
    rotation_a: Rot,
    b: Shape,
    rotation_b: Rot,
    offset: Vec2,
    margin: f32,
}

impl Case {
    fn manifold(&self) -> Option<Manifold> {
        detect_within(&self.a, self.rotation_a, &self.b, self.rotation_b, self.offset, self.margin)
    }

    fn solids(&self) -> (Solid, Solid) {
        (Solid::new(&self.a, self.rotation_a, Vec2::ZERO), Solid::new(&self.b, self.rotation_b, self.offset))
    }

    /// By how much the reported depth may fall short: the preference for a's faces where both have faces.
    fn preference(&self) -> f64 {
        match (self.a.core(), self.b.core()) {
            (Some((a, radius_a)), Some((b, radius_b))) => {
                // A segment leaves it to the other.
                let inradius =
                    |shape: &Shape, inradius| if shape.is_segment() { f32::INFINITY } else { inradius };
                let [a, b] =
                    [inradius(&self.a, a.inradius + radius_a), inradius(&self.b, b.inradius + radius_b)];
                if self.a.is_segment() && self.b.is_segment() { 0.0 } else { 1e-3 * f64::from(a.min(b)) }
            }
            _ => 0.0,
        }
    }

    /// Whether one of the two has round corners.
    fn is_rounded(&self) -> bool {
        [self.a, self.b].iter().any(|shape| matches!(shape, Shape::Rounded(_)))
    }

    fn flipped(&self) -> Self {
        Self {
            a: self.b,
            rotation_a: self.rotation_b,
            b: self.a,
            rotation_b: self.rotation_a,
            offset: -self.offset,
            ..*self
        }
    }
}

/// Cases of every kind of pair near contact, each handed to `check` with its name.
fn for_random_cases(seed: u64, rounds: usize, mut check: impl FnMut(&Case, &str)) {
    let mut rng = rng(seed);
    for round in 0..rounds {
        let (shapes_a, shapes_b) = (random_shapes(&mut rng), random_shapes(&mut rng));
        for (i, &a) in shapes_a.iter().enumerate() {
            for (j, &b) in shapes_b.iter().enumerate() {
                let case = random_case(&mut rng, a, b);
                check(&case, &format!("round {round}, pair {i} {j}"));
            }
        }
    }
}

fn random_case(rng: &mut Random, a: Shape, b: Shape) -> Case {
    // Now and then square to the axes or to each other, where ties are.
    let mut angle = || if rng.random_range(0..4) == 0 { 0.5 } else { rng.random_range(-3.2f32..3.2) };
    let (rotation_a, rotation_b) = (Rot::from_angle(angle()), Rot::from_angle(angle()));
    let direction = Rot::from_angle(rng.random_range(-3.2f32..3.2));
    // From overlapping well to a little apart.
    let reach = a.extent() + b.extent();
    let offset = direction.rotate(Vec2::new(reach * rng.random_range(0.1f32..1.1), 0.0));
    let margin = if rng.random_range(0..2) == 0 { 0.0 } else { 0.3 };
    Case { a, rotation_a, b, rotation_b, offset, margin }
}

#[test]
fn a_manifold_is_there_within_the_margin_and_as_deep_as_the_true_distance() {
    let (mut touching, mut apart) = (0, 0);
    for_random_cases(11, 2000, |case, name| {
        let (a, b) = case.solids();
        let truth = signed_distance(&a, &b);
        let Some(manifold) = case.manifold() else {
            assert!(truth > f64::from(case.margin) - ROUNDING, "{name}: {truth} missed");
            return;
        };
        if truth > 0.0 {
            apart += 1;
        } else {
            touching += 1;
        }
        let least = manifold.points().iter().map(|p| p.separation).fold(f32::INFINITY, f32::min);
        let error = f64::from(least) - truth;
        assert!(error.abs() <= case.preference() + ROUNDING, "{name}: {least}, truly {truth}");
        for point in manifold.points() {
            // Taking off radii rounds once more.
            let rounding = if case.is_rounded() { ROUNDING as f32 } else { 0.0 };
            assert!(point.separation <= case.margin + rounding, "{name}");
            assert_eq!((point.normal_impulse, point.tangent_impulse), (0.0, 0.0));
        }
    });
    assert!(touching > 5000 && apart > 2000, "{touching} {apart}");
}

/// Only along the right normal is the gap between the supports the true distance; an error of the angle φ shows as
/// the chord it swings, so the tolerance is that of the distance.
#[test]
fn the_normal_is_a_unit_vector_along_which_the_gap_is_the_distance() {
    for_random_cases(12, 1000, |case, name| {
        let Some(manifold) = case.manifold() else { return };
        assert!((manifold.normal.length() - 1.0).abs() < 4e-7, "{name}: {:?}", manifold.normal);
        let (a, b) = case.solids();
        let gap = gap_along(&a, &b, wide(manifold.normal));
        let truth = signed_distance(&a, &b);
        assert!((gap - truth).abs() <= case.preference() + ROUNDING, "{name}: gap {gap}, truly {truth}");
    });
}

/// Half the separation back along the normal is a's surface, half of it on is b's; of a circle that touches something
/// else the point is on its own surface, and all of the separation from the other.
#[test]
fn each_point_lies_between_the_surfaces_its_separation_apart() {
    let mut pairs_of_points = 0;
    for_random_cases(13, 1000, |case, name| {
        let Some(manifold) = case.manifold() else { return };
        let (a, b) = case.solids();
        let least = manifold.points().iter().map(|point| point.separation).fold(f32::INFINITY, f32::min);
        for point in manifold.points() {
            // On the side of what is rounded, away from the nearest point, the normal is that of the other's face.
            if case.is_rounded() && f64::from(point.separation - least) > ROUNDING {
                continue;
            }
            let to_a = match [&case.a, &case.b].map(|shape| shape.radius().is_some()) {
                [true, false] => 0.0,
                [false, true] => 1.0,
                _ => 0.5,
            };
            let back = manifold.normal * (to_a * point.separation);
            let on_a = point.anchor_a - back;
            let on_b = on_a + manifold.normal * point.separation;
            let tolerance = ROUNDING + if case.is_rounded() { case.preference() } else { 0.0 };
            assert!(a.distance_to_outline(wide(on_a)) < tolerance, "{name}: {point:?}");
            assert!(b.distance_to_outline(wide(on_b)) < tolerance, "{name}: {point:?}");
            let mismatch = (point.anchor_a - point.anchor_b) - case.offset;
            assert!(f64::from(mismatch.length()) < ROUNDING, "{name}");
        }
        if let [first, second] = manifold.points() {
            pairs_of_points += 1;
            assert_ne!(first.feature, second.feature, "{name}");
        }
    });
    assert!(pairs_of_points > 1000);
}

#[test]
fn exchanging_the_shapes_flips_the_manifold() {
    for_random_cases(14, 1000, |case, name| {
        let (one, other) = (case.manifold(), case.flipped().manifold());
        let has_circle = case.a.radius().is_some() || case.b.radius().is_some();
        if has_circle && case.a.radius().is_some() != case.b.radius().is_some() {
            // The same computation, so the same bits.
            assert_eq!(one, other.map(|m| m.flipped()), "{name}");
            return;
        }
        let (Some(one), Some(other)) = (one, other.map(|m| m.flipped())) else {
            let (a, b) = case.solids();
            let slack = case.preference() + ROUNDING;
            let at_the_margin = (signed_distance(&a, &b) - f64::from(case.margin)).abs() <= slack;
            assert!(one.is_none() && other.is_none() || at_the_margin, "{name}");
            return;
        };
        // Alike, unless a face of each is as good a reference: then each side prefers its own.
        if (one.normal - other.normal).length() < 1e-5 && one.points().len() == other.points().len() {
            // Normals 1e-5 apart, at the end of an arm of 3 m.
            let tolerance = 3e-5 + 2.0 * ROUNDING;
            for (p, q) in one.points().iter().zip(other.points()) {
                assert!(
                    f64::from((p.anchor_a - q.anchor_a).length()) < tolerance,
                    "{name}: {one:?} {other:?}"
                );
                assert!(f64::from((p.separation - q.separation).abs()) < tolerance, "{name}");
                assert_eq!(p.feature, q.feature, "{name}");
            }
        } else {
            let least = |m: &Manifold| m.points().iter().map(|p| p.separation).fold(f32::INFINITY, f32::min);
            let difference = f64::from((least(&one) - least(&other)).abs());
            assert!(difference <= case.preference() + 2.0 * ROUNDING, "{name}: {one:?} {other:?}");
        }
    });
}

fn assert_same_contact(fast: Option<Manifold>, slow: Option<Manifold>, name: &str) {
    let (Some(fast), Some(slow)) = (fast, slow) else {
        assert!(fast.is_none() && slow.is_none(), "{name}: {fast:?} {slow:?}");
        return;
    };
    // Two corners s apart give a direction to rounding / s.
    let separation = fast.points()[0].separation;
    let blur = if fast.points().len() == 1 && separation > 0.0 { 4e-7 / separation } else { 0.0 };
    assert!((fast.normal - slow.normal).length() < 1e-6 + blur, "{name}: {fast:?} {slow:?}");
    assert_eq!(fast.points().len(), slow.points().len(), "{name}");
    for (p, q) in fast.points().iter().zip(slow.points()) {
        assert_eq!(p.feature, q.feature, "{name}");
        assert!((p.anchor_a - q.anchor_a).length() < 4e-6, "{name}: {fast:?} {slow:?}");
        assert!((p.separation - q.separation).abs() < 4e-6, "{name}");
    }
}

#[test]
fn the_box_paths_give_what_the_general_path_gives() {
    let mut compared = 0;
    for_random_cases(15, 2000, |case, name| {
        let (Some(hull_a), Some(hull_b)) = (case.a.hull(), case.b.hull()) else { return };
        let (Shape::Aabb(a) | Shape::Obb(a), Shape::Aabb(b) | Shape::Obb(b)) = (&case.a, &case.b) else {
            return;
        };
        let (rot_a, rot_b) = (case.rotation_a, case.rotation_b);
        let slow = polygon_polygon::detect(hull_a, rot_a, hull_b, rot_b, case.offset, case.margin);
        let fast = box_box::detect(a, rot_a, b, rot_b, case.offset, case.margin);
        assert_same_contact(fast, slow, name);
        let still = Rot::IDENTITY;
        let slow = polygon_polygon::detect(hull_a, still, hull_b, still, case.offset, case.margin);
        assert_same_contact(aabb_aabb::detect(a, b, case.offset, case.margin), slow, name);
        assert_same_contact(box_box::detect(a, still, b, still, case.offset, case.margin), slow, name);
        compared += usize::from(fast.is_some());
    });
    assert!(compared > 2000);
}

/// A tilt or a shift by rounding decides anew which face is the reference and which corner is further out; the ids
/// must not follow. 1 m boxes: 1e-7 m is about an epsilon.
#[test]
fn feature_ids_stay_while_a_box_on_an_equal_box_trembles() {
    let unit = Shape::obb(1.0, 1.0);
    let ids = |tilt: f32, shift: f32| -> Vec<FeatureId> {
        let rotation = Rot { c: 1.0, s: tilt };
        let manifold =
            detect_within(&unit, Rot::IDENTITY, &unit, rotation, Vec2::new(shift, 0.999), 0.02).unwrap();
        manifold.points().iter().map(|p| p.feature).collect()
    };
    let expected = [FeatureId::of_vertices(2, 1), FeatureId::of_vertices(3, 0)];
    for tilt in [-1e-3, -1e-7, 0.0, 1e-7, 1e-3] {
        for shift in [-0.1, -1e-7, 0.0, 1e-7, 0.1] {
            assert_eq!(ids(tilt, shift), expected, "tilt {tilt}, shift {shift}");
        }
    }
    // And in whichever order the two come.
    let from_above = detect_within(&unit, Rot::IDENTITY, &unit, Rot::IDENTITY, Vec2::new(0.0, -0.999), 0.02);
    let flipped: Vec<_> = from_above.unwrap().flipped().points().iter().map(|p| p.feature).collect();
    assert_eq!(flipped, expected);
}

/// A power of two only moves the exponent, so a scaled pair has the same manifold, scaled, to the last bit: nothing in
/// detection is tuned to metres. 2^-15 and 2^25 bring shapes of about 1 m near the ends of the range.
#[test]
fn manifolds_scale_with_the_shapes() {
    let scaled = |shape: &Shape, k: f32| match shape {
        Shape::Circle(c) => Shape::circle(k * c.radius()),
        Shape::Aabb(r) => Shape::aabb(k * r.width(), k * r.height()),
        Shape::Obb(r) => Shape::obb(k * r.width(), k * r.height()),
        Shape::Polygon(p) => Shape::polygon(p.vertices().iter().map(|&v| v * k)).unwrap(),
        Shape::Segment(s) => Shape::segment(s.vertices()[0] * k, s.vertices()[1] * k),
        Shape::Rounded(r) => Shape::rounded(r.vertices().iter().map(|&v| v * k), r.radius() * k).unwrap(),
    };
    for k in [1.0_f32 / 32_768.0, 33_554_432.0] {
        for_random_cases(16, 200, |case, name| {
            // Round corners of 5 cm come to the end of the range sooner.
            let k = if case.is_rounded() { k.max(1.0 / 2048.0) } else { k };
            // Each polygon centred once more, the unscaled ones too.
            let with = |k| (scaled(&case.a, k), scaled(&case.b, k));
            let ((a, b), (large_a, large_b)) = (with(1.0), with(k));
            let (offset, margin) = (case.offset * k, case.margin * k);
            let large = Case { a: large_a, b: large_b, offset, margin, ..*case };
            let case = Case { a, b, ..*case };
            let expected = case.manifold().map(|mut manifold| {
                for point in manifold.points_mut() {
                    point.anchor_a *= k;
                    point.anchor_b *= k;
                    point.separation *= k;
                }
                manifold
            });
            assert_eq!(large.manifold(), expected, "{name}");
        });
    }
}
