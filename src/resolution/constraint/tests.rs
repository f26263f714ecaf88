use super::*;
use crate::collision::{FeatureId, ManifoldPoint};
use crate::compute::LaneRot;
use crate::math::{Rot, Vec2};

/// A box of 2 kg, 1 m wide, on ground that nothing moves: both lower corners touch.
fn box_on_ground() -> ContactConstraint<f32> {
    let one = LaneVec2 { x: 0.0, y: 1.0 };
    let mut constraint = ContactConstraint {
        inverse_mass_b: 0.5,
        inverse_inertia_b: 3.0,
        normal: one,
        friction: 0.5,
        turns: Turns { a: 1.0, b: 1.0 },
        ..ContactConstraint::default()
    };
    let point =
        |x: f32| ManifoldPoint::new(Vec2::new(x, 0.5), Vec2::new(0.0, 1.0), 0.01, FeatureId::default());
    let manifold = Manifold::of_two(Vec2::new(0.0, 1.0), point(-0.5), point(0.5));
    constraint.set_manifold_in(&manifold, &BodyState::REST, &BodyState::REST);
    constraint
}

/// k = 1/m + (r × n)²/I with r × n = ±1/2, and their product between the two points.
#[test]
fn effective_masses_are_those_of_a_box() {
    let constraint = box_on_ground();
    assert_eq!(constraint.points.map(|point| point.normal_k), [0.5 + 0.75; 2]);
    assert_eq!(constraint.coupling, 0.5 - 0.75);
    assert_eq!(constraint.frictions.map(|friction| friction.mass), [1.0 / (0.5 + 0.75); 2]);
}

/// Without inverse inertia both points respond by 1/m to either impulse: equal ones, of x each, are to be answered by 2 x/m, to
/// the rounding of two sums, and unlike ones by a matrix that can be inverted.
#[test]
fn points_that_respond_as_one_answer_equal_impulses_exactly() {
    let mut constraint = ContactConstraint { inverse_inertia_b: 0.0, ..box_on_ground() };
    for point in &mut constraint.points {
        point.normal_k = THERE;
    }
    constraint.find_masses::<2>();
    for point in &constraint.points {
        assert!((point.normal_k + constraint.coupling - 2.0 * 0.5).abs() <= 2.0 * f32::EPSILON);
        assert!(constraint.coupling < 0.99951 * point.normal_k, "{constraint:?}");
    }
}

#[test]
fn a_manifold_of_one_point_leaves_nothing_of_two() {
    let mut constraint = box_on_ground();
    let point = ManifoldPoint::new(Vec2::new(0.1, 0.5), Vec2::new(0.0, 1.0), 0.0, FeatureId::default());
    let one = Manifold::of_one(Vec2::new(0.0, 1.0), point);
    constraint.set_manifold_in(&one, &BodyState::REST, &BodyState::REST);
    assert_eq!((constraint.points[1].normal_k, constraint.coupling), (0.0, 0.0));
}

/// A corner of the box goes down by l sin θ as the box turns, and by its fall.
#[test]
fn separations_follow_the_motion_of_both_bodies() {
    let constraint = box_on_ground();
    let Rot { c, s } = Rot::from_angle(0.02);
    let delta_position = Vec2::new(0.3, -0.004).into();
    let b = BodyState { delta_position, delta_rotation: LaneRot { c, s }, ..BodyState::REST };
    let turned = |x: f32, y: f32| f64::from(x) * f64::from(s) + f64::from(y) * (f64::from(c) - 1.0);
    for (point, x) in constraint.points.iter().zip([-0.5, 0.5]) {
        let expected = 0.01 - 0.004 + turned(x, -0.5);
        let found = constraint.separation(point, &BodyState::REST, &b);
        assert!((f64::from(found) - expected).abs() < 1e-8, "{found} m instead of {expected}");
    }
}

/// A collision stops the corner that it acts on, and friction of at most µ times as much goes against the slip.
#[test]
fn a_collision_impulse_changes_the_speed_of_its_point_by_k_times_itself() {
    let constraint = box_on_ground();
    let velocity = LaneVec2 { x: 3.0, y: -1.0 };
    let mut pair = [BodyState::REST, BodyState { velocity, ..BodyState::REST }];
    constraint.apply_collision_impulses([0.8, 0.0], None, &mut pair);
    let [a, b] = pair;
    // 0.8 N s upwards, and 0.4 N s against the slip, both at the corner (-1/2, -1/2).
    let (velocity, spin) = (b.velocity.to_vec2(), b.angular_velocity);
    assert!((velocity - Vec2::new(3.0 - 0.5 * 0.4, -1.0 + 0.5 * 0.8)).length() < 1e-6, "{velocity:?}");
    assert!((spin - 3.0 * (-0.5 * 0.8 + 0.5 * -0.4)).abs() < 1e-6, "{spin} rad/s");
    assert_eq!(a.velocity.to_vec2(), Vec2::ZERO);
}
