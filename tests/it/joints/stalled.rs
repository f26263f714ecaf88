//! Drives that a wall holds up press with all that they are able to, however their contact is solved.

use rustycs::prelude::*;

use crate::support::{add, assert_near, assert_relative, place, run};

/// A kind of joint with a motor of this force, N, or torque at a lever of 1 m, N m, between a body and the world.
type Drive = fn(BodyId, f32) -> Joint;

/// Those that push a body to the right. The springs could do more.
const PUSHES: [(&str, Drive); 3] = [
    ("prismatic", |body, force| Joint::prismatic(body, None).axis([-1.0, 0.0]).motor(1.0, force)),
    ("drag", |body, force| {
        Joint::drag(body, [0.0, 0.0]).target([2.0, 0.0]).spring(60.0, 1.0).max_force(force)
    }),
    ("motor_to", |body, force| {
        Joint::motor_to(body, None).local_anchors([0.0, 0.0], [2.0, 0.0]).spring(60.0, 1.0).max_force(force)
    }),
];

/// Those that turn it clockwise about a pin 1 m below it.
const TURNS: [(&str, Drive); 3] = [
    ("revolute", |body, torque| Joint::revolute(body, None).at([0.0, -1.0]).motor(1.0, torque)),
    ("wheel", |body, torque| {
        Joint::wheel(body, None).at([0.0, -1.0]).axis([1.0, 0.0]).travel(0.0..=0.0).motor(1.0, torque)
    }),
    ("ratchet", |body, torque| Joint::ratchet(body, None, 0.01).at([0.0, -1.0]).motor(1.0, torque)),
];

/// All that the contacts of a body press with, N.
fn pressed(world: &World, body: BodyId) -> f64 {
    let points = world.contacts_of(body).flat_map(|contact| contact.points().to_vec());
    let impulse: f64 = points.map(|point| f64::from(point.normal_impulse)).sum();
    impulse * f64::from(world.settings().tick_rate) * f64::from(world.settings().substeps)
}

/// Presses a disc of `mass` and 1 m that a wall stops, with `force`. Returns whether it was solved directly.
fn press(name: &str, drive: Drive, mass: f32, force: f32, adaptive: bool) -> bool {
    let what = format!("{force} N on {mass} kg by {name}, adaptive {adaptive}");
    let mut world = World::new(Settings { sleep: false, adaptive, ..Settings::default() });
    add(&mut world, Body::fixed(Shape::aabb(1.0, 4.0)).at([1.0, 0.0]).friction(0.0));
    let disc = Body::dynamic(Shape::circle(0.5)).mass(mass).friction(0.0).restitution(0.0);
    // It is turned about its pin, which the wall is not to resist.
    let disc = disc.rolling_resistance(0.0);
    let body = add(&mut world, disc);
    let joint = world.add_joint(drive(body, force)).unwrap();
    run(&mut world, 2.0);
    assert_relative(pressed(&world, body), f64::from(force), 1e-3, &format!("on the wall: {what}"));
    let borne = f64::from(world.joint(joint).unwrap().force().length());
    assert_relative(borne, f64::from(force), 1e-3, &format!("on the joint: {what}"));
    // Sweeps may leave an eightieth of the disc.
    if adaptive {
        assert_near(place(&world, body)[0], 0.0, 1.0 / 80.0, &what);
    }
    world.body(body).unwrap().tier() == Tier::Direct
}

#[test]
fn a_stalled_drive_presses_with_its_force() {
    for (name, drive) in PUSHES.into_iter().chain(TURNS) {
        for force in [1.0, 100.0, 1e3] {
            press(name, drive, 1.0, force, false);
        }
        let mut direct = 0;
        for (mass, force) in [(1.0, 1.0), (1.0, 100.0), (1.0, 1e3), (1.0, 1e4), (10.0, 1e4), (10.0, 1e6)] {
            direct += u32::from(press(name, drive, mass, force, true));
        }
        assert!(direct >= 2, "{name}: {direct} solved directly");
    }
}
