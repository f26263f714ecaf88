//! Sleep: what is at rest costs nothing, and wakes when anything happens to it.

mod falling_asleep;
mod waking;

use rustycs::prelude::*;

use crate::support::{add, unit_box};

/// Slow enough for a woken stack to be where it was, m.
const JUMP: f64 = 1e-4;

/// A world in which bodies may sleep.
fn earth() -> World {
    let mut world = World::new(Settings::default());
    world.add_force(Force::EARTH_GRAVITY);
    world
}

fn add_ground(world: &mut World) -> BodyId {
    let ground = Body::fixed(Shape::aabb(200.0, 2.0)).at([0.0, -1.0]);
    add(world, ground.friction(0.6).restitution(0.0))
}

fn add_stack(world: &mut World, x: f64, count: usize) -> Vec<BodyId> {
    (0..count).map(|i| add(world, unit_box(x, 0.5 + i as f64))).collect()
}

/// Whether all of the bodies that are still there are asleep within 30 s.
fn falls_asleep(world: &mut World, ids: &[BodyId]) -> bool {
    for _ in 0..1800 {
        world.step();
        if ids.iter().all(|&id| world.body(id).is_none_or(|body| body.is_sleeping())) {
            world.validate().unwrap();
            return true;
        }
    }
    false
}

fn step_until_asleep(world: &mut World, ids: &[BodyId]) {
    assert!(falls_asleep(world, ids), "awake after 30 s");
}

fn is_asleep(world: &World, id: BodyId) -> bool {
    world.body(id).unwrap().is_sleeping()
}

/// A ground and a stack of `count` boxes that sleeps on it.
fn sleeping_stack(count: usize) -> (World, BodyId, Vec<BodyId>) {
    let mut world = earth();
    let ground = add_ground(&mut world);
    let ids = add_stack(&mut world, 0.0, count);
    step_until_asleep(&mut world, &ids);
    (world, ground, ids)
}

/// A pool with 100 bodies of one density above it. A disc rolls without loss: one with nothing beside it may roll on for
/// ever, and what lies across one may swing for ever. Without `discs` hexagons take their places.
fn pile(seed: u64, discs: bool, sleep: bool) -> (World, Vec<BodyId>) {
    // What leaves the pool is removed.
    let bounds = Some(Aabb::new(Vec2::new(-12.0, -20.0), Vec2::new(12.0, 500.0)));
    let settings = Settings { bounds, sleep, ..Settings::default() };
    let mixed = rustycs_scenes::pile::build_with(100, seed, settings.clone());
    let mut world = World::new(settings);
    world.add_force(Force::EARTH_GRAVITY);
    for (_, body) in mixed.bodies() {
        let shape = match body.shape() {
            Shape::Circle(_) if !discs => hexagon(body.shape().extent()),
            shape => *shape,
        };
        let like =
            if body.body_type() == BodyType::Fixed { Body::fixed(shape) } else { Body::dynamic(shape) };
        let like = like.at(body.position_f64()).angle(body.angle()).material(body.material());
        add(&mut world, like.density(1.0));
    }
    let ids = world.bodies().filter(|(_, body)| body.body_type() == BodyType::Dynamic).map(|(id, _)| id);
    let ids = ids.collect();
    (world, ids)
}

fn hexagon(radius: f32) -> Shape {
    let corner = |k: u8| Rot::from_angle(f32::from(k) * core::f32::consts::FRAC_PI_3);
    let corners = [0, 1, 2, 3, 4, 5].map(|k| [radius * corner(k).c, radius * corner(k).s]);
    Shape::polygon(corners).unwrap()
}

/// How far the bodies have moved or turned since they were at `poses`, m: the point of each that has moved most.
fn moved(world: &World, poses: &[(BodyId, Pose)]) -> f64 {
    let moved = poses.iter().filter_map(|&(id, pose)| {
        let body = world.body(id)?;
        let [x, y] = (body.pose().center - pose.center).into();
        let Rot { c, s } = body.rotation();
        let turned = (c - pose.rotation.c).hypot(s - pose.rotation.s);
        Some(f64::from(Vec2::new(x, y).length() + turned * body.shape().extent()))
    });
    moved.fold(0.0, f64::max)
}

fn poses(world: &World, ids: &[BodyId]) -> Vec<(BodyId, Pose)> {
    ids.iter().filter_map(|&id| Some((id, world.body(id)?.pose()))).collect()
}
