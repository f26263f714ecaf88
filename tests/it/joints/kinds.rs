//! What each kind does, by its closed form.

use rustycs::prelude::*;

use crate::support::{G, add, assert_near, assert_relative, earth, place, run, space, unit_box, velocity};

/// ω of a spring of so many hertz, rad/s.
fn omega(hertz: f64) -> f64 {
    core::f64::consts::TAU * hertz
}

/// A force F stops 2 kg at 3 m/s after m v/F = 1.5 s and m v²/(2 F) = 2.25 m. The force is constant but in the substep of the
/// stop, in which it moves by less than a h²: 4e-5 m.
#[test]
fn friction_slows_by_its_force_over_the_mass_and_then_holds() {
    let mut world = space();
    let body = Body::dynamic(Shape::circle(0.5)).at([0.0, 0.0]).mass(2.0).velocity([3.0, 0.0]);
    let body = add(&mut world, body);
    world.add_joint(Joint::friction(body, None).max_force(4.0)).unwrap();
    run(&mut world, 1.0);
    assert_near(velocity(&world, body)[0], 3.0 - 2.0, 1e-4, "speed after a second");
    run(&mut world, 1.0);
    assert_near(velocity(&world, body)[0], 0.0, 1e-5, "speed in the end");
    assert_near(place(&world, body)[0], 2.25, 1e-4, "way");
}

/// It is bounded as a vector: whichever way the body goes, it is stopped straight ahead after m v²/(2 F) = 4.1667 m, with F = 6 N. The
/// direction is that of the first substep, to rounding; the way as above.
#[test]
fn friction_is_the_same_in_all_directions() {
    for degrees in [0.0_f64, 15.0, 30.0, 45.0, 80.0, 200.0] {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let mut world = space();
        let body = Body::dynamic(Shape::rectangle(1.0, 1.0))
            .at([0.0, 0.0])
            .mass(2.0)
            .velocity([5.0 * cos as f32, 5.0 * sin as f32]);
        let body = add(&mut world, body);
        let joint = world.add_joint(Joint::friction(body, None).max_force(6.0)).unwrap();
        run(&mut world, 1.0);
        assert_relative(f64::from(world.joint(joint).unwrap().force().length()), 6.0, 1e-5, "force");
        run(&mut world, 2.0);
        let [x, y] = place(&world, body);
        assert_relative(x * cos + y * sin, 25.0 / 6.0, 1e-4, "way");
        assert_near(x * sin - y * cos, 0.0, 1e-5, "off the way");
    }
}

/// What drags a body drags it with no more than its greatest force, in any direction: at F t/m after a second.
#[test]
fn a_hand_drags_alike_in_all_directions() {
    for degrees in [0.0_f64, 30.0, 45.0] {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let mut world = space();
        let body = add(&mut world, Body::dynamic(Shape::circle(0.5)).at([0.0, 0.0]).mass(2.0));
        let hand = Joint::drag(body, [0.0, 0.0]).target([1000.0 * cos, 1000.0 * sin]).max_force(6.0);
        world.add_joint(hand).unwrap();
        run(&mut world, 1.0);
        let [x, y] = velocity(&world, body);
        assert_relative(x * cos + y * sin, 3.0, 1e-3, "speed");
        assert_near(x * sin - y * cos, 0.0, 1e-3, "speed across");
    }
}

/// A wheel that hangs from what does not move sags by g/ω², and no farther than its travel.
#[test]
fn a_suspension_sags_by_its_closed_form_and_stops_at_its_travel() {
    for (travel, sag) in [(1.0, G / omega(3.0).powi(2)), (0.02, 0.02)] {
        let mut world = earth();
        let car = add(&mut world, Body::fixed(Shape::aabb(1.0, 1.0)).at([0.0, 2.0]));
        let wheel = add(&mut world, Body::dynamic(Shape::circle(0.3)).at([0.0, 0.0]).mass(5.0));
        let joint = Joint::wheel(car, wheel).at([0.0, 0.0]).suspension(3.0, 0.7).travel(-travel..=travel);
        let joint = world.add_joint(joint).unwrap();
        run(&mut world, 4.0);
        assert_near(world.joint(joint).unwrap().translation(), -sag, 1e-5, "sag");
    }
}

/// What hangs on a drag joint is below its target by g/ω². A critical spring of the scheme has the poles of the exact one, and for
/// that a stiffness of tanh²(ω h/2) in the place of (ω h/2)²: it hangs lower by a share of (ω h)²/6, 3e-3 at 5 Hz.
#[test]
fn a_dragged_body_hangs_below_its_target_by_its_closed_form() {
    let mut world = earth();
    let body = add(&mut world, Body::dynamic(Shape::circle(0.5)).at([0.0, 0.0]).mass(3.0));
    world.add_joint(Joint::drag(body, [0.0, 0.0]).target([1.0, 2.0]).spring(5.0, 1.0)).unwrap();
    run(&mut world, 4.0);
    assert_near(place(&world, body)[0], 1.0, 1e-5, "along x");
    let (sag, share) = (G / omega(5.0).powi(2), (omega(5.0) / 240.0).powi(2) / 6.0);
    assert_near(2.0 - place(&world, body)[1], sag, share * sag + 1e-6, "sag");
}

/// On a slack rope a body falls freely, y = -g t²/2, which the scheme does exactly; on a taut one it hangs, and bears its weight.
#[test]
fn a_rope_is_not_there_while_it_is_slack_and_holds_when_it_is_taut() {
    let mut world = earth();
    let body = add(&mut world, Body::dynamic(Shape::circle(0.2)).at([0.0, 0.0]).mass(4.0));
    let rope = Joint::rope(body, None).between([0.0, 0.0], [0.0, 0.5]).max_length(2.0);
    let rope = world.add_joint(rope).unwrap();
    run(&mut world, 0.5);
    assert_near(place(&world, body)[1], -0.125 * G, 1e-4, "height in free fall");
    for _ in 0..240 {
        world.step();
        assert!(place(&world, body)[1] > -1.5 - 1e-5, "longer than the rope");
    }
    assert_near(place(&world, body)[1], -1.5, 1e-5, "height in the end");
    assert_relative(f64::from(world.joint(rope).unwrap().force().length()), 4.0 * G, 1e-3, "tension");
}

/// Wheels of 1000 turns and more are where the ratio has them: angles are in `f64`, and their gap is closed in each substep.
#[test]
fn a_gear_keeps_its_ratio_over_a_thousand_turns() {
    let mut world = space();
    let [a, b] =
        [0.0, 3.0].map(|x| add(&mut world, Body::dynamic(Shape::circle(1.0)).at([x, 0.0]).mass(1.0)));
    let driven = world.add_joint(Joint::revolute(a, None).motor(-60.0, 100.0)).unwrap();
    let other = world.add_joint(Joint::revolute(b, None)).unwrap();
    world.add_joint(Joint::gear(a, b, 2.5)).unwrap();
    run(&mut world, 110.0);
    // Angles are those of the world as seen from the wheels.
    let [turned_a, turned_b] = [driven, other].map(|joint| -world.joint(joint).unwrap().angle());
    assert!(turned_a > 1000.0 * core::f64::consts::TAU, "{turned_a} rad");
    assert_near(turned_a + 2.5 * turned_b, 0.0, 1e-5, "angle of a and ratio times that of b");
}

/// A ratchet goes on, and back no farther than to the last multiple of its tooth.
#[test]
fn a_ratchet_goes_back_to_its_last_tooth_and_no_farther() {
    let mut world = space();
    let hub = add(&mut world, Body::fixed(Shape::circle(0.1)).at([0.0, 0.0]));
    let wheel = add(&mut world, Body::dynamic(Shape::circle(1.0)).at([0.0, 0.0]).mass(1.0));
    let joint = world.add_joint(Joint::ratchet(hub, wheel, 0.3).motor(1.0, 10.0)).unwrap();
    run(&mut world, 1.0);
    let angle = world.joint(joint).unwrap().angle();
    assert!((0.9..1.0).contains(&angle), "it has gone on to {angle}");
    world.joint_mut(joint).unwrap().set_motor(-1.0, 10.0);
    run(&mut world, 2.0);
    assert_near(world.joint(joint).unwrap().angle(), 0.9, 1e-5, "angle at the tooth");
}

/// Without anchors a motor joint pulls to the pose that its bodies have: nothing moves.
#[test]
fn a_motor_joint_keeps_the_pose_that_its_bodies_have() {
    let mut world = space();
    let a = add(&mut world, unit_box(0.0, 0.0).angle(0.3));
    let b = add(&mut world, unit_box(2.0, 0.7).angle(-0.4));
    world.add_joint(Joint::motor_to(a, b)).unwrap();
    run(&mut world, 2.0);
    for (body, expected) in [(a, [0.0, 0.0]), (b, [2.0, 0.7])] {
        let found = place(&world, body);
        assert!((found[0] - expected[0]).abs() + (found[1] - expected[1]).abs() < 1e-6, "{found:?}");
    }
}
