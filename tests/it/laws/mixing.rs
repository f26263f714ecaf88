//! How the coefficients of two surfaces mix, by the way that a box slides and the speed that a ball keeps.

use rustycs::prelude::*;

use crate::support::{G, add, assert_near, assert_relative, earth, place, run, space, velocity};

type Rule = fn(f64, f64) -> f64;

/// Every rule, from the weakest to the strongest, and what it makes of two coefficients.
fn rules() -> [(Mix, Rule); 5] {
    [
        (Mix::Average, |a, b| 0.5 * (a + b)),
        (Mix::GeometricMean, |a, b| (a * b).sqrt()),
        (Mix::Min, f64::min),
        (Mix::Multiply, |a, b| a * b),
        (Mix::Max, f64::max),
    ]
}

/// Where a box comes to rest that slides at 3 m/s over a floor, with these rules, m.
fn way(floor: Option<Mix>, of_box: Option<Mix>, usual: Mix) -> f64 {
    let mut world = earth();
    world.set_settings(Settings { friction_mix: usual, ..world.settings().clone() }).unwrap();
    let ground = Body::fixed(Shape::aabb(200.0, 2.0)).at([0.0, -1.0]).friction(0.3).restitution(0.0);
    let sliding = Body::dynamic(Shape::obb(1.0, 0.5)).at([0.0, 0.25]).velocity([3.0, 0.0]);
    let sliding = sliding.friction(0.8).restitution(0.0);
    let with = |body: Body, mix: Option<Mix>| match mix {
        Some(mix) => body.friction_mix(mix),
        None => body,
    };
    add(&mut world, with(ground, floor));
    let id = add(&mut world, with(sliding, of_box));
    run(&mut world, 3.0);
    assert_near(velocity(&world, id)[0], 0.0, 1e-4, "speed after it stopped");
    place(&world, id)[0]
}

/// v²/(2 µ g), with µ by the stronger rule of the two; a surface without a rule of its own has that of the settings.
#[test]
fn a_box_slides_as_far_as_the_stronger_rule_says() {
    let (v, a, b) = (3.0, 0.3, 0.8);
    for (number, (floor, of_floor)) in rules().into_iter().enumerate() {
        for (other, (of_box, of_other)) in rules().into_iter().enumerate() {
            let friction = if number > other { of_floor(a, b) } else { of_other(a, b) };
            let expected = v * v / (2.0 * friction * G);
            let what = format!("{floor:?} and {of_box:?}");
            assert_relative(way(Some(floor), Some(of_box), Mix::Average), expected, 2e-3, &what);
            assert_relative(way(None, Some(of_box), floor), expected, 2e-3, &what);
            assert_relative(way(Some(floor), None, of_box), expected, 2e-3, &what);
        }
    }
}

#[test]
fn a_ball_bounces_by_the_stronger_rule_also_when_it_changes() {
    let mut world = space();
    let wall = add(&mut world, Body::fixed(Shape::aabb(1.0, 20.0)).at([0.0, 0.0]).restitution(0.2));
    let ball = Body::dynamic(Shape::circle(0.5)).at([3.0, 0.0]).friction(0.0).restitution(0.9);
    let ball = add(&mut world, ball.velocity([-4.0, 0.0]));
    for (mix, rule) in rules() {
        world.body_mut(wall).unwrap().set_restitution_mix(mix);
        let expected = 4.0 * rule(0.2, 0.9);
        world.body_mut(ball).unwrap().set_position([3.0, 0.0]).unwrap();
        world.body_mut(ball).unwrap().set_velocity([-4.0, 0.0]);
        run(&mut world, 1.0);
        assert_near(velocity(&world, ball)[0], expected, 1e-3, &format!("{mix:?}"));
        assert_eq!(world.body(wall).unwrap().restitution_mix(), Some(mix));
    }
    world.body_mut(wall).unwrap().set_restitution_mix(None);
    assert_eq!(world.body(wall).unwrap().describe().get_restitution_mix(), None);
}

/// The rule of a body holds for its shapes that have none of their own.
#[test]
fn the_shapes_of_a_body_have_its_rule_or_their_own() {
    let mut world = World::new(Settings::default());
    let plain = Collider::new(Shape::circle(0.5)).at([2.0, 0.0]);
    let own = plain.at([4.0, 0.0]).friction_mix(Mix::Min).restitution_mix(Mix::Multiply);
    let body = Body::dynamic(Shape::circle(0.5)).with(plain).with(own).friction_mix(Mix::Max);
    let id = add(&mut world, body.clone());
    let found: Vec<_> = world
        .body(id)
        .unwrap()
        .colliders()
        .map(|part| [part.friction_mix(), part.restitution_mix()])
        .collect();
    let (max, min) = (Some(Mix::Max), Some(Mix::Min));
    assert_eq!(found, [[max, None], [max, None], [min, Some(Mix::Multiply)]]);
    assert_eq!(world.remove(id).unwrap().get_friction_mix(), max);
    assert_eq!(body.get_restitution_mix(), None);
}
