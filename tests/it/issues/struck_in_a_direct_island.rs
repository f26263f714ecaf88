//! What struck a body of an island that is solved directly, after the contacts had been solved and before it moved, was lost.

use rustycs::prelude::*;

use crate::support::{add, add_floor, assert_near, earth_with, run, unit_box};

/// A disc of 10 kg flies against a wall at 1.5 km/s, comes back, and strikes a box in the same substep. The floor is smooth: from the wall
/// on all have the momentum of the disc, whether the box bears a load of 2 t, and is solved directly, or not.
#[test]
fn what_strikes_a_box_under_a_great_load_in_the_middle_of_a_substep_is_not_lost() {
    for load in [2_000.0, 10.0] {
        let mut world = earth_with(Settings { sleep: false, ..Settings::default() });
        add_floor(&mut world, 0.0);
        let smooth = |body: Body| body.friction(0.0).restitution(0.0);
        let below = add(&mut world, smooth(unit_box(0.0, 0.5).density(10.0)));
        add(&mut world, smooth(unit_box(0.0, 1.5).density(load)));
        let wall = Body::fixed(Shape::rectangle(1.0, 4.0)).at([4.5, 2.0]);
        add(&mut world, wall.restitution(1.0));
        run(&mut world, 1.0);
        assert_eq!(world.body(below).unwrap().tier() == Tier::Direct, load > 10.0);
        let disc = Body::dynamic(Shape::circle(0.1)).at([2.5, 0.5]).velocity([1_500.0, 0.0]).mass(10.0);
        add(&mut world, disc.restitution(1.0));
        world.step();
        assert_near(world.momentum().x.into(), -15_000.0, 1.0, "momentum");
        assert!(world.body(below).unwrap().velocity().x < -1.0, "it is struck");
    }
}
