//! Bodies of the pieces of a concave outline are what the outline is.

use rustycs::prelude::*;

use crate::support::{add, assert_near, assert_relative, earth, place, run, space};

/// Area (m²), centre (m) and moment of inertia about it (of 1 kg/m²) of an outline, by the closed form over its edges p to q, with
/// D = p × q: D/2, D/6 (p + q), and D/12 (p·p + p·q + q·q) about the origin.
fn moments(points: &[[f32; 2]]) -> (f64, [f64; 2], f64) {
    let (mut area, mut first, mut second) = (0.0, [0.0; 2], 0.0);
    for (p, q) in points.iter().zip(points.iter().cycle().skip(1)) {
        let [[px, py], [qx, qy]] = [p, q].map(|point| point.map(f64::from));
        let cross = px * qy - py * qx;
        area += cross / 2.0;
        first[0] += cross / 6.0 * (px + qx);
        first[1] += cross / 6.0 * (py + qy);
        second += cross / 12.0 * (px * px + py * py + px * qx + py * qy + qx * qx + qy * qy);
    }
    let center = first.map(|moment| moment / area);
    (area, center, second - area * (center[0] * center[0] + center[1] * center[1]))
}

const LETTER: [[f32; 2]; 8] =
    [[0.0, 0.0], [3.0, 0.0], [3.0, 1.0], [1.0, 1.0], [1.0, 3.0], [2.5, 3.0], [2.5, 4.0], [0.0, 4.0]];

#[test]
fn a_concave_body_weighs_what_its_outline_does() {
    let mut world = space();
    let (area, center, inertia) = moments(&LETTER);
    let pieces = Shape::concave(LETTER).unwrap();
    let turn = 0.5_f32;
    let id = add(&mut world, Body::dynamic_pieces(pieces).at([10.0, -5.0]).angle(turn).density(2.0));
    let body = world.body(id).unwrap();
    assert_relative(f64::from(body.mass()), 2.0 * area, 1e-6, "mass");
    assert_relative(f64::from(body.inertia()), 2.0 * inertia, 1e-5, "moment of inertia");
    let (sin, cos) = f64::from(turn).sin_cos();
    let expected = [10.0 + cos * center[0] - sin * center[1], -5.0 + sin * center[0] + cos * center[1]];
    for (found, expected) in place(&world, id).into_iter().zip(expected) {
        assert_near(found, expected, 1e-6, "centre of mass");
    }
    assert!(body.origin().distance([10.0, -5.0]) < 1e-6, "{}", body.origin());
    // Within an arm of the letter, and between the arms.
    let at = |x: f64, y: f64| [10.0 + cos * x - sin * y, -5.0 + sin * x + cos * y];
    assert!(body.contains(at(2.9, 0.9)) && body.contains(at(2.4, 3.1)) && !body.contains(at(2.0, 2.0)));
}

/// Taken out and added again, or made fixed and dynamic again, it is where it was.
#[test]
fn a_body_of_pieces_stays_where_it_is_through_edits() {
    let mut world = space();
    let pieces = Shape::concave(LETTER).unwrap();
    let id = add(&mut world, Body::dynamic_pieces(pieces.clone()).at([1.0, 2.0]).angle(1.0));
    let corners = |world: &World, id: BodyId| {
        let body = world.body(id).unwrap();
        let corner = |collider: ColliderRef<'_>| collider.pose().to_world(collider.shape().vertices()[0]);
        body.colliders().map(corner).collect::<Vec<_>>()
    };
    let before = corners(&world, id);
    let is_there = |world: &World, id: BodyId| {
        let now = corners(world, id);
        assert!(now.iter().zip(&before).all(|(now, before)| now.distance(*before) < 1e-5), "{now:?}");
    };
    world.body_mut(id).unwrap().set_density(3.0).unwrap();
    is_there(&world, id);
    world.body_mut(id).unwrap().set_body_type(BodyType::Fixed).unwrap();
    is_there(&world, id);
    world.body_mut(id).unwrap().set_body_type(BodyType::Dynamic).unwrap();
    is_there(&world, id);
    world.validate().unwrap();
    let description = world.remove(id).unwrap();
    let id = add(&mut world, description);
    is_there(&world, id);

    let fixed = add(&mut world, Body::fixed_pieces(pieces));
    assert_eq!((world.body(fixed).unwrap().origin(), place(&world, fixed)), (Point::ORIGIN, [0.0, 0.0]));
    assert!(world.body(fixed).unwrap().contains([2.9, 0.5]), "a body told no place is where its points are");
    world.validate().unwrap();
}

#[test]
fn a_body_without_pieces_is_refused() {
    let mut world = space();
    assert_eq!(world.add(Body::dynamic_pieces([])), Err(BodyError::NoShape));
    assert_eq!(world.bodies().count(), 0);
    assert!(BodyError::NoShape.to_string().contains("piece"));
}

/// A box slides over a concave floor in many pieces, with pillars and a hollow below, as over one: it loses nothing.
#[test]
fn a_concave_floor_is_smooth() {
    let mut world = earth();
    let mut outline = vec![[40.0_f32, 0.0], [0.0, 0.0]];
    for tooth in 0..20 {
        let x = 2.0 * tooth as f32;
        outline.extend([[x, -3.0], [x + 0.7, -3.0], [x + 1.0, -1.0], [x + 1.7, -1.5]]);
    }
    outline.push([40.0, -3.0]);
    let pieces = Shape::concave(outline).unwrap();
    assert!(pieces.len() > 20);
    let floor = Body::fixed_pieces(pieces).friction(0.0).restitution(0.0);
    add(&mut world, floor);
    for shape in [Shape::rectangle(1.0, 1.0), Shape::circle(0.5)] {
        let body = Body::dynamic(shape).at([1.0, 0.5]).velocity([5.0, 0.0]).friction(0.0).restitution(0.0);
        let id = add(&mut world, body);
        let mut kick = 0.0_f32;
        for _ in 0..420 {
            world.step();
            kick = kick.max(world.body(id).unwrap().velocity().y);
        }
        // 35 m on.
        let [x, y] = place(&world, id);
        assert!(
            (x - 36.0).abs() < 0.01 && (y - 0.5).abs() < 1e-3 && kick < 5e-4,
            "at {x}, {y}, kicked {kick}"
        );
        world.remove(id);
    }
}

/// A ring of pieces holds what is in its hole, and its hole is one.
#[test]
fn a_ball_lies_in_the_hole_of_a_ring() {
    let mut world = earth();
    let around = |radius: f32| {
        (0..16).map(move |i| {
            let Rot { c, s } = Rot::from_angle(core::f32::consts::TAU * i as f32 / 16.0);
            [radius * c, radius * s]
        })
    };
    let ring = Body::fixed_pieces(Shape::with_holes(around(3.0), [around(2.0)]).unwrap());
    add(&mut world, ring.restitution(0.0));
    let ball = Body::dynamic(Shape::circle(0.5)).at([1.2, 0.0]).restitution(0.0).rolling_resistance(0.1);
    let id = add(&mut world, ball.friction(1.0));
    run(&mut world, 10.0);
    // A corner of the hole is lowest, with a face rising to each side by 11.25°: the ball lies in it.
    let [x, y] = place(&world, id);
    let apothem = 2.0 * (core::f64::consts::PI / 16.0).cos();
    let expected = -(apothem - 0.5) / (core::f64::consts::PI / 16.0).cos();
    assert!(x.abs() < 5e-3 && (y - expected).abs() < 5e-3, "at {x}, {y}, not {expected}");
}
