//! A body whose rotation was fixed kept the spin it was given, whatever it met: it drove itself and others for ever.

use rustycs::prelude::*;

use crate::support::{add, add_floor, earth, place, run, space, spin};

/// A spin that rubs on the floor would drive the disc along it: at rest, with energy from nowhere.
#[test]
fn a_disc_with_fixed_rotation_does_not_drive_along_the_floor() {
    let mut world = earth();
    add_floor(&mut world, 1.0);
    let disc = Body::dynamic(Shape::circle(0.5)).at([0.0, 0.5]).friction(1.0).restitution(0.0);
    let id = add(&mut world, disc.fixed_rotation(true).angular_velocity(10.0));
    let start = world.energy();
    run(&mut world, 0.5);
    world.body_mut(id).unwrap().set_angular_velocity(10.0);
    run(&mut world, 0.5);
    assert_eq!((place(&world, id)[0], spin(&world, id)), (0.0, 0.0));
    assert!(world.energy() <= start, "{} J of {start}", world.energy());
}

/// Neither a spin nor an impulse nor a torque turns it; it can be put at another angle.
#[test]
fn fixed_rotation_keeps_the_angle_of_every_kind_of_body() {
    for body in [Body::dynamic(Shape::obb(1.0, 1.0)), Body::kinematic(Shape::obb(1.0, 1.0))] {
        let mut world = space();
        let id = add(&mut world, body.fixed_rotation(true).angle(0.25).angular_velocity(10.0));
        run(&mut world, 0.5);
        world.body_mut(id).unwrap().apply_angular_impulse(10.0);
        world.body_mut(id).unwrap().apply_torque(10.0);
        run(&mut world, 0.5);
        assert_eq!(world.body(id).unwrap().rotation(), Rot::from_angle(0.25));
        world.body_mut(id).unwrap().set_angle(0.5).unwrap();
        assert_eq!(world.body(id).unwrap().rotation(), Rot::from_angle(0.5));
    }
}
