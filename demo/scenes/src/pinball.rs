//! A pinball table that plays by itself, or is played.
//!
//! The flippers are kinematic and turn about their ends; before each tick they look where the balls are. A ball
//! that is lost is shot in again.

use rustycs::{Body, BodyId, BodyType, Force, Material, Rot, Settings, Shape, Vec2, World};

use crate::mark::Mark;
use crate::parts::{beam, put};
use crate::rotor::{self, Seat};
use crate::{Scene, View};

/// A pinball table that plays by itself.
pub const SCENE: Scene = Scene {
    name: "pinball",
    group: "machines",
    summary: "Flippers strike as a ball comes near, bumpers send it back, and a lost ball is shot in again.",
    view: View::above(-10.0, 0.0, 26.0, 20.0),
    build,
    before_tick: Some(play),
    played: Some(played),
    hint: Some("Play it yourself: ← and → strike, or a finger on either side."),
    ..Scene::PLAIN
};

/// Acceleration down the table, m/s²: it is tilted.
const SLOPE: f32 = 6.0;
/// Half of the width of the table, and the height of its upper side and its lower end, m.
const SIDE: f32 = 6.0;
const TOP: f32 = 9.0;
const BOTTOM: f32 = -9.5;
/// Pivots of the flippers: left, right, m.
const PIVOTS: [Vec2; 2] = [Vec2::new(-3.2, -6.4), Vec2::new(3.2, -6.4)];
/// Length of a flipper, m.
const FLIPPER: f32 = 2.5;
/// Angles of the left flipper at rest and raised, rad; the right one is its mirror image.
const REST: f32 = -0.45;
const RAISED: f32 = 0.5;
/// Fastest that a flipper turns, rad/s, up and down.
const STRIKE: f32 = 10.0;
const RETURN: f32 = 5.0;
/// Balls on the table.
const BALLS: usize = 4;
/// Radius of a ball, m.
const BALL: f32 = 0.3;

/// Parts 0 and 1 are the flippers; balls are marked as the next.
const BALL_PART: usize = 2;

fn build(_seed: u64, settings: Settings) -> World {
    let mut world = World::new(settings);
    world.add_force(Force::new("slope of the table", [0.0, -SLOPE]));
    put_table(&mut world);
    put_bumpers(&mut world);
    let metal = Material { friction: 0.2, restitution: 0.3, ..Material::METAL };
    for (part, pivot) in PIVOTS.into_iter().enumerate() {
        let angle = angles(part)[0];
        let place = pivot + Rot::from_angle(angle).rotate(seat(part).offset);
        let flipper = Body::kinematic(Shape::obb(FLIPPER, 0.35)).at(place).angle(angle).material(metal);
        put(&mut world, Mark::part(part).on(flipper));
    }
    for ball in 0..BALLS {
        let place = [-3.0 + 2.0 * ball as f32, 7.6 - 0.2 * ball as f32];
        let body = Body::dynamic(Shape::circle(BALL)).at(place).velocity([2.0 - ball as f32, 0.0]);
        put(&mut world, Mark::part(BALL_PART).on(body.material(metal)));
    }
    world
}

/// Walls, the slanted corners above, and the lanes that lead to the flippers.
fn put_table(world: &mut World) {
    let wall = Material { friction: 0.1, restitution: 0.5, ..Material::PLASTIC };
    for side in [-1.0, 1.0] {
        let upright =
            Body::fixed(Shape::aabb(1.0, TOP - BOTTOM)).at([side * (SIDE + 0.5), 0.5 * (TOP + BOTTOM)]);
        put(world, upright.material(wall));
        let corner =
            Body::fixed(Shape::obb(5.0, 0.6)).at([side * (SIDE - 1.2), TOP - 1.2]).angle(side * -0.785);
        put(world, corner.material(wall));
        let [outer, inner] = [Vec2::new(side * SIDE, -4.2), Vec2::new(side * 3.4, -6.1)];
        let (left, right) = if side < 0.0 { (outer, inner) } else { (inner, outer) };
        put(world, beam(left, right, 0.4).material(wall));
    }
    put(world, Body::fixed(Shape::aabb(2.0 * SIDE + 2.0, 1.0)).at([0.0, TOP + 0.5]).material(wall));
}

/// Round bumpers, which return all of the speed, and two slanted ones above the flippers.
fn put_bumpers(world: &mut World) {
    let lively = Material { friction: 0.1, restitution: 1.0, ..Material::RUBBER };
    for (x, y, radius) in [(-2.3, 3.6, 0.8), (2.3, 3.6, 0.8), (0.0, 6.0, 0.7), (0.0, 1.2, 0.6)] {
        put(world, Body::fixed(Shape::circle(radius)).at([x, y]).material(lively));
    }
    for side in [-1.0, 1.0] {
        let corners = [[side * 4.4, -1.4], [side * 4.4, -3.4], [side * 3.2, -4.0]];
        let shape = Shape::polygon(corners).expect("a triangle is convex");
        // The body's place is the centroid of its corners.
        put(world, Body::fixed(shape).at([side * 4.0, -2.933]).material(lively));
    }
    for (x, y) in [(-4.4, 1.0), (4.4, 1.0)] {
        put(world, Body::fixed(Shape::obb(0.3, 1.4)).at([x, y]).material(Material::STONE));
    }
}

/// Angles of a flipper at rest and raised, rad.
fn angles(part: usize) -> [f32; 2] {
    if part == 0 { [REST, RAISED] } else { [-REST, -RAISED] }
}

/// A flipper is held at its outer end.
fn seat(part: usize) -> Seat {
    let side = if part == 0 { 1.0 } else { -1.0 };
    Seat { offset: Vec2::new(0.5 * side * FLIPPER, 0.0), angle: 0.0 }
}

/// Strikes where a ball is near, and shoots lost balls in again.
fn play(world: &mut World) {
    let balls = balls(world);
    // A ball is near when it is over the outer two thirds of the flipper and not above its reach.
    let is_raised = [0, 1].map(|part| {
        balls.iter().any(|&(_, place, velocity)| {
            let from_pivot = place - PIVOTS[part];
            let along = if part == 0 { from_pivot.x } else { -from_pivot.x };
            (0.9..FLIPPER + 0.3).contains(&along) && (-1.6..0.5).contains(&from_pivot.y) && velocity.y < 4.0
        })
    });
    played(world, is_raised);
}

/// Strikes where it is told to, and shoots lost balls in again.
fn played(world: &mut World, is_raised: [bool; 2]) {
    for (id, part) in rotor::parts(world, PIVOTS.len()) {
        swing(world, id, part, is_raised[part]);
    }
    for (place, (id, at, _)) in balls(world).into_iter().enumerate() {
        if at.y < BOTTOM || at.y > TOP + 1.0 || at.x.abs() > SIDE + 1.0 {
            shoot(world, id, place);
        }
    }
}

/// Every ball with its place and velocity.
fn balls(world: &World) -> Vec<(BodyId, Vec2, Vec2)> {
    world
        .bodies()
        .filter(|&(_, body)| Mark::of(body).part == Some(BALL_PART) && body.body_type() == BodyType::Dynamic)
        .map(|(id, body)| (id, body.position(), body.velocity()))
        .collect()
}

/// Turns a flipper toward its raised angle, or back to rest.
fn swing(world: &mut World, id: BodyId, part: usize, is_raised: bool) {
    let Some(flipper) = world.body(id) else { return };
    let (now, goal) = (flipper.rotation(), angles(part)[usize::from(is_raised)]);
    let rest_of_way = (Rot::from_angle(goal) * now.inverse()).angle();
    let fastest = if is_raised { STRIKE } else { RETURN };
    let rate = world.settings().tick_rate;
    let spin = (rest_of_way * rate).clamp(-fastest, fastest);
    rotor::steer(world, id, PIVOTS[part], now, spin, seat(part));
}

/// Shoots a ball in at the top, to a side that changes from ball to ball and with the time.
fn shoot(world: &mut World, id: BodyId, place: usize) {
    let side = if (world.ticks() as usize + place).is_multiple_of(2) { -1.0 } else { 1.0 };
    let entry = Vec2::new(side * 2.5, 7.0 - 0.1 * place as f32);
    let reach = Vec2::new(BALL, BALL);
    if !world.bodies_in(entry - reach, entry + reach).is_empty() {
        return;
    }
    if let Some(mut ball) = world.body_mut(id) {
        // Numbers of a scene are within what a body can be given.
        _ = ball.set_position(entry);
        ball.set_velocity([-3.0 * side, 1.0]).set_angular_velocity(0.0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::run;

    /// For a minute of play the flippers hold on to their pivots and the balls stay on the table.
    #[test]
    fn flippers_keep_their_pivots_and_balls_come_back() {
        let mut world = SCENE.build(1, Settings::default());
        let mut strikes = 0;
        for _ in 0..60 {
            run(&SCENE, &mut world, 60);
            for (id, part) in rotor::parts(&world, 2) {
                let flipper = world.body(id).expect("the flipper is there");
                let pivot = flipper.position() - flipper.rotation().rotate(seat(part).offset);
                let off = (pivot - PIVOTS[part]).length();
                // Six digits of f32 at 7 m.
                assert!(off < 1e-5, "flipper {part} is {off} m off its pivot");
                strikes += u32::from(flipper.angular_velocity() != 0.0);
            }
            for (_, body) in world.bodies().filter(|&(_, body)| body.body_type() == BodyType::Dynamic) {
                let place = body.position();
                assert!(
                    place.x.abs() < SIDE && place.y < TOP && place.y > BOTTOM - 1.0,
                    "a ball is at {place:?}"
                );
            }
        }
        assert!(strikes > 0, "no flipper was ever seen to move");
    }

    /// A flipper is raised while its key is down, the other one rests.
    #[test]
    fn a_key_raises_its_flipper() {
        let mut world = SCENE.build(1, Settings::default());
        for _ in 0..30 {
            SCENE.before_tick_played(&mut world, [true, false]);
            world.step();
        }
        for (id, part) in rotor::parts(&world, 2) {
            let angle = world.body(id).expect("the flipper is there").angle();
            let expected = angles(part)[1 - part];
            assert!((angle - expected).abs() < 1e-3, "flipper {part} is at {angle} rad, not {expected}");
        }
    }
}
