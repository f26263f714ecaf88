//! A fixture that reads as physics.

use rustycs::prelude::*;

/// Gravity on the Earth, m/s².
pub const G: f64 = 9.81;

/// A world with default settings and gravity, in which nothing sleeps: rest must be rest by physics.
pub fn earth() -> World {
    earth_with(Settings::default())
}

/// The same with other settings.
#[expect(clippy::needless_pass_by_value, reason = "reads as giving the settings to the world")]
pub fn earth_with(settings: Settings) -> World {
    let mut world = World::new(Settings { sleep: false, ..settings });
    world.add_force(Force::EARTH_GRAVITY);
    world
}

/// A world without forces, in which nothing sleeps.
pub fn space() -> World {
    World::new(Settings { sleep: false, ..Settings::default() })
}

/// Steps for `seconds` of simulated time.
pub fn run(world: &mut World, seconds: f64) {
    let ticks = (seconds * f64::from(world.settings().tick_rate)).round() as u64;
    for _ in 0..ticks {
        world.step();
    }
}

/// Adds a body that is known to be good.
pub fn add(world: &mut World, body: Body) -> BodyId {
    world.add(body).expect("the description is good")
}

/// A floor 200 m wide with its surface at height 0, that does not bounce.
pub fn add_floor(world: &mut World, friction: f32) -> BodyId {
    let floor = Body::fixed(Shape::aabb(200.0, 2.0)).at([0.0, -1.0]);
    add(world, floor.friction(friction).restitution(0.0))
}

/// A dynamic box with sides of 1 m and density 1, that does not bounce, with its centre at (x, y).
pub fn unit_box(x: f64, y: f64) -> Body {
    Body::dynamic(Shape::obb(1.0, 1.0)).at([x, y]).density(1.0).friction(0.6).restitution(0.0)
}

/// Place of a body's centre, m.
pub fn place(world: &World, id: BodyId) -> [f64; 2] {
    world.body(id).expect("the body is there").position_f64()
}

/// Velocity of a body, m/s.
pub fn velocity(world: &World, id: BodyId) -> [f64; 2] {
    let v = world.body(id).expect("the body is there").velocity();
    [f64::from(v.x), f64::from(v.y)]
}

/// Angular velocity of a body, rad/s.
pub fn spin(world: &World, id: BodyId) -> f64 {
    f64::from(world.body(id).expect("the body is there").angular_velocity())
}

/// Fails unless `found` is within `tolerance` of `expected`.
#[track_caller]
pub fn assert_near(found: f64, expected: f64, tolerance: f64, what: &str) {
    let error = (found - expected).abs();
    assert!(error <= tolerance, "{what}: {found}, expected {expected} ± {tolerance:e}, off by {error:e}");
}

/// Fails unless `found` is within the fraction `tolerance` of `expected`.
#[track_caller]
pub fn assert_relative(found: f64, expected: f64, tolerance: f64, what: &str) {
    assert_near(found, expected, tolerance * expected.abs(), what);
}

/// File and line that a panic names; `None` where there is none.
pub fn place_of_panic(act: impl FnOnce()) -> Option<(String, u32)> {
    use std::cell::Cell;
    use std::panic;
    // Other tests run meanwhile, and panic too.
    thread_local! {
        static PLACE: Cell<Option<(String, u32)>> = const { Cell::new(None) };
    }
    let usual = panic::take_hook();
    panic::set_hook(Box::new(|info| {
        PLACE.set(info.location().map(|place| (place.file().to_owned(), place.line())));
    }));
    let result = panic::catch_unwind(panic::AssertUnwindSafe(act));
    panic::set_hook(usual);
    result.err().and_then(|_| PLACE.take())
}
