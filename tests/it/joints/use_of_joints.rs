//! Adding, changing and removing joints; sleep, clones, and what is refused.

use rustycs::prelude::*;

use crate::support::{add, earth, earth_with, run};

fn two_boxes(world: &mut World) -> [BodyId; 2] {
    [0.0, 0.8].map(|x| add(world, Body::dynamic(Shape::obb(1.0, 1.0)).at([x, 0.0])))
}

#[test]
fn a_joint_that_makes_no_sense_is_refused_with_a_sentence_and_nothing_changes() {
    let mut world = earth();
    let [a, b] = two_boxes(&mut world);
    let gone = add(&mut world, Body::dynamic(Shape::circle(1.0)));
    world.remove(gone);
    let bad = [
        (Joint::revolute(gone, b), "the first body of the joint has been removed"),
        (Joint::revolute(a, gone), "the second body of the joint has been removed"),
        (Joint::weld(a, a), "a joint cannot join a body to itself"),
        (Joint::revolute(a, b).limits(1.0..=-1.0), "the lower limit 1 is above the upper limit -1"),
        (Joint::revolute(a, b).at([f64::NAN, 0.0]), "the anchor is NaN"),
        (Joint::revolute(a, b).motor(f32::NAN, 1.0), "the speed of the motor is NaN"),
        (Joint::distance(a, b).length(-1.0), "the length is -1 m"),
        (Joint::rope(a, b).max_length(0.0), "the greatest length is 0 m; give a number of 1e-6 m or more"),
        (
            Joint::rope(a, b).break_at(-1.0, 0.0),
            "the force at which it breaks is -1 N; give a number of 0 N or more",
        ),
        (Joint::friction(a, b), "a friction joint without a greatest force or torque resists nothing"),
        (Joint::distance(a, b).spring(0.0, 0.0), "the frequency of the spring is 0 Hz"),
        (Joint::prismatic(a, b).axis([0.0, 0.0]), "the axis has no direction"),
        (
            Joint::weld(a, b).motor(1.0, 1.0),
            "a weld joint has no motor; leave it out, or take one of these kinds: revolute, prismatic, distance, wheel, ratchet",
        ),
        (Joint::gear(a, b, 0.0), "the size of the ratio is 0"),
    ];
    let before = world.state_hash();
    for (joint, sentence) in bad {
        let error = world.add_joint(joint.clone()).expect_err(sentence).to_string();
        assert!(error.starts_with(sentence), "{error}, expected {sentence}");
    }
    assert_eq!((world.joint_count(), world.state_hash()), (0, before));
}

#[test]
fn joined_bodies_do_not_touch_unless_told_and_do_when_parted() {
    for (collides, touch) in [(false, false), (true, true)] {
        let mut world = World::new(Settings { sleep: false, ..Settings::default() });
        let [a, b] = two_boxes(&mut world);
        let joint = world.add_joint(Joint::weld(a, b).collide_connected(collides)).unwrap();
        world.step();
        assert_eq!(world.contacts().count() > 0, touch);
        world.joint_mut(joint).unwrap().set_collide_connected(!collides);
        world.step();
        assert_eq!(world.contacts().count() > 0, !touch);
        world.remove_joint(joint);
        world.step();
        assert!(world.contacts().count() > 0, "parted");
    }
}

#[test]
fn removing_a_body_removes_and_reports_its_joints() {
    let mut world = earth();
    let [a, b] = two_boxes(&mut world);
    let joint = world.add_joint(Joint::revolute(a, b)).unwrap();
    let other = world.add_joint(Joint::distance(a, None).between([0.0, 0.0], [0.0, 3.0])).unwrap();
    assert_eq!((world.joints_of(a), world.joints_of(b)), (vec![joint, other], vec![joint]));
    world.remove(b);
    assert!(world.joint(joint).is_none() && world.joint(other).is_some());
    world.step();
    assert_eq!(world.events().removed_joints(), [joint]);
    world.step();
    assert!(world.events().removed_joints().is_empty());
}

#[test]
fn what_hangs_at_rest_sleeps_together_and_a_motor_wakes_it() {
    let mut world = earth_with(Settings::default());
    world.set_settings(Settings { sleep: true, ..Settings::default() }).unwrap();
    let upper = add(&mut world, Body::dynamic(Shape::obb(0.1, 1.0)).at([0.0, -0.5]));
    let lower = add(&mut world, Body::dynamic(Shape::obb(0.1, 1.0)).at([0.0, -1.5]));
    let hinge = world.add_joint(Joint::revolute(upper, None).at([0.0, 0.0])).unwrap();
    world.add_joint(Joint::revolute(lower, upper).at([0.0, -1.0])).unwrap();
    assert_eq!(world.islands().len(), 1);
    run(&mut world, 3.0);
    assert_eq!((world.awake_count(), world.sleeping_islands()), (0, 1));
    world.joint_mut(hinge).unwrap().set_motor(1.0, 100.0);
    assert_eq!(world.awake_count(), 2);
    run(&mut world, 0.5);
    assert!(world.joint(hinge).unwrap().angle() > 0.1, "it turns");
}

#[test]
fn clones_with_joints_go_on_with_the_same_bits() {
    let mut world = earth();
    let [a, b] = two_boxes(&mut world);
    world.add_joint(Joint::revolute(a, None).at([-0.5, 0.5])).unwrap();
    world.add_joint(Joint::weld(a, b).spring(3.0, 0.1)).unwrap();
    run(&mut world, 0.5);
    let mut clone = world.clone();
    let mut other = earth();
    other.clone_from(&world);
    for world in [&mut world, &mut clone, &mut other] {
        run(world, 1.0);
    }
    assert_eq!(world.state_hash(), clone.state_hash());
    assert_eq!(world.state_hash(), other.state_hash());
}
