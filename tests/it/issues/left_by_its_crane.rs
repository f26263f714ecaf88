//! What hung asleep from a kinematic body stayed where it was when that began to move, and its rope grew longer.

use rustycs::prelude::*;

use crate::support::add;

/// A rope of 5 m and a rod of 5 m keep their length to 0.1 mm, so that the load is nowhere below where they lead it. Welded and hinged it goes along.
#[test]
fn what_sleeps_is_woken_by_the_joint_that_leads_it() {
    type Lead = fn(&mut World, BodyId, f64);
    let leads: [Lead; 2] = [
        |world, crane, _| _ = world.body_mut(crane).unwrap().set_velocity([0.0, 1.0]),
        |world, crane, height| _ = world.body_mut(crane).unwrap().move_to(Pose::at([0.0, height])),
    ];
    let joints: [fn(BodyId, BodyId) -> Joint; 4] = [
        |a, b| Joint::rope(a, b),
        |a, b| Joint::distance(a, b),
        |a, b| Joint::weld(a, b),
        |a, b| Joint::revolute(a, b),
    ];
    for lead in leads {
        for joint in joints {
            let mut world = World::new(Settings::default());
            world.add_force(Force::EARTH_GRAVITY);
            let crane = add(&mut world, Body::kinematic(Shape::circle(0.1)).at([0.0, 5.0]));
            let load = add(&mut world, Body::dynamic(Shape::circle(0.5)).mass(85.0));
            world.add_joint(joint(crane, load)).unwrap();
            (0..120).for_each(|_| world.step());
            assert!(world.body(load).unwrap().is_sleeping());
            for tick in 1..=60 {
                lead(&mut world, crane, 5.0 + f64::from(tick) / 60.0);
                world.step();
                let [crane, load] = [crane, load].map(|id| world.body(id).unwrap().position().y);
                assert!(load > crane - 5.0 - 1e-4, "tick {tick}: {load} m under {crane} m");
            }
        }
    }
}

/// A spin wakes as a velocity does: a body that is welded to what turns by 1 rad/s turns by 1 rad in a second, to rounding.
#[test]
fn what_sleeps_is_woken_by_a_spin() {
    let mut world = World::new(Settings::default());
    let turntable = add(&mut world, Body::kinematic(Shape::circle(0.1)));
    let arm = add(&mut world, Body::dynamic(Shape::obb(2.0, 0.1)).at([1.0, 0.0]));
    world.add_joint(Joint::weld(turntable, arm)).unwrap();
    (0..120).for_each(|_| world.step());
    assert!(world.body(arm).unwrap().is_sleeping());
    world.body_mut(turntable).unwrap().set_angular_velocity(1.0);
    (0..60).for_each(|_| world.step());
    let angle = world.body(arm).unwrap().angle();
    assert!((angle - 1.0).abs() < 1e-4, "{angle} rad");
}
