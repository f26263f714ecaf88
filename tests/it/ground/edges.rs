//! What is an edge of the ground stays one, and becomes one as its neighbour goes.

use rustycs::prelude::*;

use crate::support::{add, earth, place, run, velocity};

fn tile_at(x: f64, y: f64) -> Body {
    Body::fixed(Shape::aabb(1.0, 1.0)).at([x, y]).friction(0.0).restitution(0.0)
}

fn slider(x: f64, speed: f32) -> Body {
    let body = Body::dynamic(Shape::rectangle(1.0, 1.0)).at([x, 0.5]).velocity([speed, 0.0]);
    body.friction(0.0).restitution(0.0).density(1.0)
}

#[test]
fn a_step_of_a_centimetre_stops_a_box() {
    for speed in [0.5_f32, 3.0, 10.0] {
        let mut world = earth();
        for number in -5..20 {
            add(&mut world, tile_at(f64::from(number), if number < 5 { -0.5 } else { -0.49 }));
        }
        let id = add(&mut world, slider(0.0, speed));
        run(&mut world, 1.0 + 6.0 / f64::from(speed));
        // With its centre above the edge it tips over, when it is fast; it does not slide on.
        let passed = place(&world, id)[0] > 5.0;
        assert!(!passed || speed > 5.0, "{speed} m/s: at {:?}", place(&world, id));
        assert!(velocity(&world, id)[0] < 0.9 * f64::from(speed), "{speed} m/s");
    }
}

/// A tile that is taken out leaves a hole with sides; put back, it closes.
#[test]
fn edges_follow_edits() {
    let mut world = earth();
    let tiles: Vec<BodyId> =
        (-3..12).map(|number| add(&mut world, tile_at(f64::from(number), -0.5))).collect();
    let id = add(&mut world, slider(0.0, 3.0));
    run(&mut world, 1.0);
    assert!((velocity(&world, id)[0] - 3.0).abs() < 1e-3);
    // The tile at 7 m goes; a small box falls in, and stops at the far side.
    world.remove(tiles[10]);
    let small = Body::dynamic(Shape::rectangle(0.4, 0.4))
        .at([6.0, 0.2])
        .velocity([2.0, 0.0])
        .friction(0.0)
        .restitution(0.0);
    world.remove(id);
    let small = add(&mut world, small);
    run(&mut world, 2.0);
    let [x, y] = place(&world, small);
    assert!(y < -0.2 && (6.5..7.5).contains(&x), "it fell in at {x}, {y}");
    world.body_mut(small).unwrap().set_pose(Pose::at([5.0, 0.2])).unwrap();
    world.body_mut(small).unwrap().set_velocity([2.0, 0.0]).set_angular_velocity(0.0);
    add(&mut world, tile_at(7.0, -0.5));
    run(&mut world, 1.5);
    assert!((velocity(&world, small)[0] - 2.0).abs() < 1e-3 && (place(&world, small)[1] - 0.2).abs() < 1e-3);
    // Made dynamic the next one falls away, and the end is an edge again.
    world.body_mut(tiles[12]).unwrap().set_body_type(BodyType::Dynamic).unwrap();
    world.step();
    world.validate().unwrap();
}

/// Pressed against a wall of tiles a box slides down as along one wall; along a ceiling likewise.
#[test]
fn walls_and_ceilings_of_tiles_are_as_smooth() {
    let mut world = earth();
    world.add_force(Force::new("wind", [5.0, 0.0]));
    for number in -20..20 {
        add(&mut world, tile_at(1.0, f64::from(number)));
    }
    let falls = add(
        &mut world,
        Body::dynamic(Shape::rectangle(1.0, 1.0)).at([0.0, 15.3]).friction(0.0).restitution(0.0),
    );
    run(&mut world, 2.0);
    assert!((velocity(&world, falls)[1] + 2.0 * 9.81).abs() < 1e-3, "{:?}", velocity(&world, falls));
    assert!(velocity(&world, falls)[0].abs() < 1e-3);

    let mut world = World::new(Settings { sleep: false, ..Settings::default() });
    world.add_force(Force::new("lift", [0.0, 5.0]));
    for number in -5..40 {
        add(&mut world, tile_at(f64::from(number), 1.0));
    }
    let slides = slider(0.0, 4.0).at([0.0, 0.0]);
    let slides = add(&mut world, slides);
    run(&mut world, 5.0);
    assert!((velocity(&world, slides)[0] - 4.0).abs() < 1e-3);
}

/// Pushed into an inner corner of tiles it stands on the floor and at the wall, in a slot as wide as itself on the floor too.
#[test]
fn inner_corners_and_slots_hold() {
    for wall in [-1.0, 1.0] {
        let mut world = earth();
        world.add_force(Force::new("wind", [3.0, 0.0]));
        for number in -4..4 {
            add(&mut world, tile_at(f64::from(number), -0.5));
            add(&mut world, tile_at(3.0, 0.5 + f64::from(number + 4)));
        }
        if wall > 0.0 {
            add(&mut world, tile_at(1.0, 0.5));
        }
        let id = add(&mut world, slider(if wall > 0.0 { 2.0 } else { 0.0 }, 0.0));
        run(&mut world, 3.0);
        let [x, y] = place(&world, id);
        assert!((x - 2.0).abs() < 2e-3 && (y - 0.5).abs() < 2e-3, "at {x}, {y}");
        assert!(world.body(id).unwrap().angle().abs() < 1e-3);
    }
}

/// From a slope onto the flat and off it again over a ridge, in boards: a disc rolls as it does over one board after the other,
/// and keeps its energy.
#[test]
fn a_disc_keeps_its_energy_over_a_ridge_of_boards() {
    let mut world = earth();
    let board = |from: [f32; 2], to: [f32; 2]| {
        let (from, to) = (Vec2::from(from), Vec2::from(to));
        let along = to - from;
        let length = along.length();
        let turn = Rot { c: along.x / length, s: along.y / length };
        let middle = (from + to) * 0.5 + turn.rotate(Vec2::new(0.0, -0.25));
        Body::fixed(Shape::rectangle(length, 0.5))
            .at(middle)
            .angle(turn.angle())
            .friction(1.0)
            .restitution(0.0)
    };
    for (from, to) in [
        ([-20.0, 0.0], [0.0, 0.0]),
        ([0.0, 0.0], [4.0, -0.3]),
        ([4.0, -0.3], [9.0, -0.9]),
        ([9.0, -0.9], [30.0, -0.9]),
    ] {
        add(&mut world, board(from, to));
    }
    let disc = Body::dynamic(Shape::circle(0.5)).at([-5.0, 0.5]).velocity([2.0, 0.0]).angular_velocity(-4.0);
    let disc = disc.rolling_resistance(0.0);
    let id = add(&mut world, disc.friction(1.0).restitution(0.0).density(1.0));
    let before = world.energy();
    run(&mut world, 6.0);
    assert!(place(&world, id)[0] > 9.0);
    // At the foot it turns by 0.12 rad at 3.2 m/s and loses what goes into the ground: 0.12² of 2/3 of its energy of motion.
    let lost = (before - world.energy()) / world.kinetic_energy();
    assert!((-1e-3..0.02).contains(&lost), "lost {lost}");
}

/// The shapes of one body are neighbours too: over a moving platform of three boards a box slides without a seam.
#[test]
fn a_platform_of_several_shapes_has_no_seams() {
    let mut world = earth();
    let board =
        |x: f32| Collider::new(Shape::rectangle(2.0, 0.5)).at([x, 0.0]).friction(0.0).restitution(0.0);
    let platform =
        Body::kinematic(Shape::rectangle(2.0, 0.5)).with(board(2.0)).with(board(4.0)).with(board(6.0));
    let platform = platform.at([0.0, -0.25]).velocity([0.0, 0.5]).friction(0.0).restitution(0.0);
    add(&mut world, platform);
    let id = add(&mut world, slider(0.0, 3.0).velocity([3.0, 0.5]));
    run(&mut world, 1.8);
    let [x, y] = velocity(&world, id);
    assert!((x - 3.0).abs() < 1e-3 && (y - 0.5).abs() < 1e-2, "{x}, {y} m/s");
}

/// Bodies that were parted from others, or tiles from others, feel no seams: only a body that passes through some of the ground does.
#[test]
fn parted_bodies_go_over_seams_as_others_do() {
    let mut world = earth();
    let tiles: Vec<BodyId> =
        (-3..20).map(|number| add(&mut world, tile_at(f64::from(number), -0.5))).collect();
    let ghost = add(&mut world, slider(-50.0, 0.0));
    let id = add(&mut world, slider(0.0, 3.0));
    world.set_collision(id, ghost, false);
    for tile in tiles {
        world.set_collision(tile, ghost, false);
    }
    run(&mut world, 3.0);
    assert!((velocity(&world, id)[0] - 3.0).abs() < 3e-4, "{:?}", velocity(&world, id));
}
