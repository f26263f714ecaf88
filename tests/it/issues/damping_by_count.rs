//! A damped body got its second half of the warm start in another way where it was one of few, and momentum out of nothing
//! with it.

use rustycs::prelude::*;

use crate::support::{add, add_floor, earth_with, place, run, spin, unit_box, velocity};

#[test]
fn a_damped_body_moves_the_same_among_few_bodies_and_among_many() {
    let with_others = |others: u32| {
        let mut world = earth_with(Settings::default());
        add_floor(&mut world, 0.5);
        let slider = unit_box(-3.0, 0.5).velocity([8.0, 0.0]).linear_damping(0.5).angular_damping(0.5);
        let mut bodies = vec![slider];
        bodies.extend((0..3).map(|row| unit_box(0.2 * f64::from(row), 0.5 + f64::from(row))));
        bodies.extend((0..others).map(|other| unit_box(1000.0 + 10.0 * f64::from(other), 100.0)));
        let ids: Vec<BodyId> = bodies.into_iter().map(|body| add(&mut world, body)).collect();
        run(&mut world, 2.0);
        [0, 1, 2, 3]
            .map(|body| (place(&world, ids[body]), velocity(&world, ids[body]), spin(&world, ids[body])))
    };
    let alone = with_others(0);
    let [_, (hit, ..), ..] = alone;
    assert!(hit[0] > 0.1, "it pushes the lowest box of the tower: {alone:?}");
    assert_eq!(alone, with_others(100));
}
