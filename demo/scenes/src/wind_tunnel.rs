//! Air that streams past obstacles.
//!
//! The air is a wind that drags every body toward its own speed: a = c (u - v), which is a force c u and a
//! damping c. What leaves on the right comes in again on the left.

use rustycs::{Body, BodyId, BodyType, Force, Material, Settings, Shape, Vec2, World};

use crate::mark::Mark;
use crate::parts::{grid, put, regular_polygon};
use crate::{Scene, View};

/// Air that streams past obstacles.
pub const SCENE: Scene = Scene {
    name: "wind_tunnel",
    group: "machines",
    summary: "Grains in a wind part before a disc, a plate and a wing, crowd at the edges and leave a wake.",
    view: View::above(-6.6, 0.0, 34.0, 13.2),
    build,
    before_tick: Some(recycle),
    ..Scene::PLAIN
};

/// Speed of the wind, m/s.
const WIND: f32 = 5.0;
/// How fast bodies take up the speed of the wind, 1/s.
const DRAG: f32 = 1.0;
/// Half of the length and of the height of the tunnel, m.
const HALF: [f32; 2] = [16.0, 6.0];
/// Grains in a column, and in all.
const GRAINS: [usize; 2] = [20, 900];
/// From one grain to the next at the start, m.
const PITCH: f32 = 0.56;
/// Radius of a grain, m.
const RADIUS: f32 = 0.11;

/// Marks what comes in again.
const GRAIN: usize = 0;

fn build(_seed: u64, settings: Settings) -> World {
    let mut world = World::new(settings);
    world.add_force(Force::new("wind", [WIND * DRAG, 0.0]));
    let smooth = Material { density: 1.0, friction: 0.0, restitution: 0.1 };
    let [length, height] = HALF;
    for side in [-1.0, 1.0] {
        let wall = Body::fixed(Shape::aabb(2.0 * length + 4.0, 0.6)).at([0.0, side * (height + 0.3)]);
        put(&mut world, wall.material(smooth));
    }
    let wing = [[-2.0, 0.0], [-1.6, 0.35], [-0.6, 0.5], [0.6, 0.4], [2.0, 0.0], [0.0, -0.12], [-1.4, -0.15]];
    let obstacles = [
        Body::fixed(Shape::circle(1.3)).at([-6.0, 2.0]),
        Body::fixed(Shape::obb(0.3, 3.2)).at([0.0, -2.6]).angle(0.3),
        Body::fixed(Shape::polygon(wing).expect("the wing is convex")).at([7.0, 2.2]).angle(-0.2),
    ];
    for obstacle in obstacles {
        put(&mut world, obstacle.material(smooth));
    }
    let mut index = 0;
    let mut grains = 0;
    while grains < GRAINS[1] {
        // The grid lies on its side: columns of grains from the left.
        let place = grid(index, GRAINS[0], PITCH, Vec2::ZERO);
        let place = Vec2::new(place.y - length + 0.3, place.x);
        index += 1;
        if !is_free(&world, place) {
            continue;
        }
        let shape = if grains % 2 == 0 { Shape::circle(RADIUS) } else { regular_polygon(6, RADIUS) };
        let grain = Body::dynamic(shape).at(place).velocity([WIND, 0.0]).linear_damping(DRAG);
        put(&mut world, Mark::part(GRAIN).on(grain.material(smooth)));
        grains += 1;
    }
    world
}

fn is_free(world: &World, place: Vec2) -> bool {
    let reach = Vec2::new(RADIUS, RADIUS) * 1.1;
    world.bodies_in(place - reach, place + reach).is_empty()
}

/// Brings grains that have left the tunnel on the right in again on the left, as fast as the wind. Each comes
/// in at a height of its own, which changes from tick to tick; where there is no room it tries again in the
/// next.
fn recycle(world: &mut World) {
    let [length, height] = HALF;
    let gone: Vec<(usize, BodyId)> = world
        .bodies()
        .filter(|&(_, body)| Mark::of(body).part == Some(GRAIN) && body.body_type() == BodyType::Dynamic)
        .enumerate()
        .filter(|(_, (_, body))| body.position().x > length || body.position().y.abs() > height)
        .map(|(number, (id, _))| (number, id))
        .collect();
    for (number, id) in gone {
        // Fractions of multiples of the golden ratio fill the height evenly, in any order.
        let share = (world.ticks() as f64 * 0.618_034 + number as f64 * 0.414_214).fract() as f32;
        let entry = Vec2::new(-length, (2.0 * share - 1.0) * (height - 2.0 * RADIUS));
        if !is_free(world, entry) {
            continue;
        }
        if let Some(mut grain) = world.body_mut(id) {
            // Numbers of a scene are within what a body can be given.
            _ = grain.set_position(entry);
            grain.set_velocity([WIND, 0.0]).set_angular_velocity(0.0);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::run;

    /// Grains that do not find room wait a little beyond the exit; none is lost, and the wind keeps blowing.
    #[test]
    fn grains_stay_in_the_tunnel() {
        let mut world = SCENE.build(1, Settings::default());
        run(&SCENE, &mut world, 600);
        let mut speed = 0.0;
        for (_, body) in world.bodies().filter(|&(_, body)| body.body_type() == BodyType::Dynamic) {
            let place = body.position();
            assert!(place.x.abs() < HALF[0] + 4.0 && place.y.abs() < HALF[1], "a grain is at {place:?}");
            speed += body.velocity().x / GRAINS[1] as f32;
        }
        assert!(speed > 0.4 * WIND && speed < WIND, "the mean speed is {speed} m/s");
    }
}
