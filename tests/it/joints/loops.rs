//! Joints that form loops: what is held more than once, and what contradicts itself.

use rand::rngs::Xoshiro256PlusPlus;
use rand::{RngExt, SeedableRng};
use rustycs::prelude::*;

use crate::support::{add, add_floor, assert_near, assert_relative, earth, place, space, velocity};

/// A frame on wheels that a side rod joins, and the joints of it. One wheel is driven at 10 rad/s, with a torque, N m.
fn locomotive(world: &mut World, wheels: u32, torque: f32) -> (BodyId, Vec<JointId>) {
    let nothing = Filter { category: 2, mask: 0, ..Filter::DEFAULT };
    let box_of =
        |width, height, y| Body::dynamic(Shape::rectangle(width, height)).at([0.0, y]).filter(nothing);
    let frame = add(world, box_of(6.0, 0.8, 1.2).mass(300.0));
    let rod = add(world, box_of(4.6, 0.1, 0.85).mass(10.0));
    let mut joints = Vec::new();
    for number in 0..wheels {
        let x = -2.0 + 4.0 * number as f32 / (wheels - 1) as f32;
        let wheel = Body::dynamic(Shape::circle(0.5)).at([x, 0.5]).mass(20.0).friction(1.0);
        let wheel = add(world, wheel.restitution(0.0).rolling_resistance(0.0));
        let mut axle = Joint::revolute(frame, wheel).at([x, 0.5]);
        if number == 0 {
            axle = axle.motor(-10.0, torque);
        }
        joints.push(world.add_joint(axle).unwrap());
        joints.push(world.add_joint(Joint::revolute(wheel, rod).at([x, 0.85])).unwrap());
    }
    (frame, joints)
}

/// The rod holds three wheels and more once more than it takes. At its dead points, where cranks and rod are in line, it does not hold two. The
/// torque brings all to the speed of the motor, M a = T/r with discs that count one and a half times. The rod, of 10 kg in 400, goes up and
/// down by 0.35 m, which makes the speed uneven by m g 2 r/(M v²) = 0.7 % at most.
#[test]
fn side_rods_go_through_their_dead_points() {
    for wheels in [2, 3, 4_u32] {
        let mut world = earth();
        add_floor(&mut world, 1.0);
        let torque = 200.0;
        let (frame, joints) = locomotive(&mut world, wheels, torque);
        let seconds = 12.0;
        for tick in 0..720 {
            world.step();
            for &joint in &joints {
                let joint = world.joint(joint).unwrap();
                let (gap, force) = (joint.error().distance, joint.force().length());
                assert!(gap < 1e-3 && force.is_finite(), "{wheels} wheels, tick {tick}: {gap} m, {force} N");
            }
        }
        let mass = 300.0 + 10.0 + 20.0 * 1.5 * f64::from(wheels);
        let until = 5.0 / (f64::from(torque) / 0.5 / mass);
        assert_near(velocity(&world, frame)[0], 5.0, 0.05, "speed");
        assert_relative(place(&world, frame)[0], 5.0 * (seconds - 0.5 * until), 0.01, "way");
    }
}

/// Two joints of one pair of bodies, one of which is put elsewhere. Most contradict each other then. Gaps close at 3 m/s, at which both bodies, of
/// 3 kg, have 13.5 J. On the way they turn about each other, which may make them some times as fast as the gap. They do not explode,
/// which took 10³ to 10¹⁰ J, and what they bear is finite.
#[test]
fn joints_that_contradict_each_other_do_not_explode() {
    let mut random = Xoshiro256PlusPlus::seed_from_u64(20);
    let kinds = |a: BodyId, b: BodyId| {
        [
            Joint::revolute(a, b),
            Joint::prismatic(a, b).axis([0.3, 1.0]),
            Joint::weld(a, b).at([0.2, 0.1]),
            Joint::wheel(a, b),
            Joint::ratchet(a, b, 0.3),
            Joint::revolute(a, b).limits(-0.2..=0.2),
            Joint::distance(a, b).between([-0.4, 0.1], [0.4, 0.1]),
            Joint::prismatic(a, b).axis([1.0, 0.2]).limits(-0.1..=0.1),
        ]
    };
    for first in 0..8 {
        for second in first..8 {
            for trial in 0..3 {
                let mut world = space();
                let shape = Shape::rectangle(1.0, 0.5);
                let a = add(&mut world, Body::dynamic(shape).at([-0.8, 0.0]).mass(1.0));
                let b = add(&mut world, Body::dynamic(shape).at([0.8, 0.0]).mass(2.0));
                let joints = [first, second].map(|kind| world.add_joint(kinds(a, b)[kind].clone()).unwrap());
                let mut within = |most: f32| random.random_range(-most..most);
                let mut moved = world.body_mut(b).unwrap();
                moved.set_position([0.8 + within(1.5), within(1.5)]).unwrap();
                moved.set_angle(within(2.5)).unwrap();
                for tick in 0..200 {
                    world.step();
                    let (energy, what) = (world.kinetic_energy(), [first, second, trial]);
                    assert!(energy < 100.0, "{what:?}, tick {tick}: {energy} J");
                    for joint in joints {
                        let force = world.joint(joint).unwrap().force().length();
                        assert!(force.is_finite(), "{what:?}, tick {tick}: {force} N");
                    }
                }
            }
        }
    }
}
