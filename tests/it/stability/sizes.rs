//! Very large, very small, very thin.

use rustycs::prelude::*;

use super::hold;
use crate::support::{add, place};

#[test]
fn towers_stand_at_any_size() {
    hold(&["tower-1cm", "tower-1km"]);
}

#[test]
fn a_tower_of_millimetres_stands() {
    hold(&["tower-1mm"]);
}

#[test]
fn needles_come_to_rest_in_a_box() {
    hold(&["needles"]);
}

#[test]
fn tiny_edges_and_faces_that_are_hardly_not_parallel_carry() {
    hold(&["tiny-edges", "near-parallel"]);
}

#[test]
fn a_disc_on_a_vertex_stays_or_rolls_but_does_not_sink() {
    hold(&["disc-on-vertex"]);
}

#[test]
fn boxes_stand_on_a_planet() {
    hold(&["planet-as-ground"]);
}

/// Below what falls on it a disc of 6,400 km is level ground, to 2e-6 m. A ball bounces as there, to the rounding of
/// f32: 1e-7 of 8 m/s in each bounce, for 10 s. A box that lands on a corner comes to rest on a face, half its height
/// above the ground but for its sag: 0.14 g h/(2·28/s) = 0.1 mm times k of a corner over 1/m, shared by two, 2.5/2.
#[test]
fn what_falls_onto_a_planet_comes_to_rest_as_on_level_ground() {
    let radius = 6.4e6;
    let fall = |ground: Body| {
        let mut world = World::new(Settings::default());
        world.add_force(Force::EARTH_GRAVITY);
        add(&mut world, ground);
        let ball = Body::dynamic(Shape::circle(0.5)).at([0.0, 3.0]).restitution(0.5);
        let ball = add(&mut world, ball);
        let tilted = Body::dynamic(Shape::obb(1.0, 1.0)).at([5.0, 3.0]).angle(0.4).velocity([1.0, 0.0]);
        let tilted = add(&mut world, tilted);
        let mut step = || {
            world.step();
            place(&world, ball)[1]
        };
        let heights: Vec<f64> = (0..600).map(|_| step()).collect();
        (heights, place(&world, tilted)[1])
    };
    let (on_planet, box_on_planet) = fall(Body::fixed(Shape::circle(radius)).at([0.0, -f64::from(radius)]));
    let (on_ground, box_on_ground) = fall(Body::fixed(Shape::aabb(1000.0, 10.0)).at([0.0, -5.0]));
    for (here, there) in on_planet.iter().zip(&on_ground) {
        assert!((here - there).abs() < 1e-5, "{here} m, not {there} m");
    }
    for height in [box_on_planet, box_on_ground] {
        assert!((height - 0.5).abs() < 2e-4, "{height} m");
    }
}
