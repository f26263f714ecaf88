//! What several scenes are made of.

use rustycs::{Attractor, Body, BodyId, Force, Material, Rot, Settings, Shape, Vec2, World};

/// The named materials, in the order of their density.
pub(crate) const MATERIALS: [Material; 5] =
    [Material::DEFAULT, Material::RUBBER, Material::PLASTIC, Material::STONE, Material::METAL];

/// A surface that neither rubs nor loses energy.
pub(crate) const ELASTIC: Material = Material { density: 1.0, friction: 0.0, restitution: 1.0 };

/// Thickness of the walls and depth of the floor of a pool, m: four times what the fastest body moves in a
/// substep.
const WALL: f32 = 1.0;

/// An empty world under the Earth's gravity.
pub(crate) fn world_with_gravity(settings: Settings) -> World {
    let mut world = World::new(settings);
    world.add_force(Force::EARTH_GRAVITY);
    world
}

/// Adds a body whose numbers are right by construction.
///
/// # Panics
/// If they are not: a mistake in the scene.
pub(crate) fn put(world: &mut World, body: Body) -> BodyId {
    world.add(body).unwrap_or_else(|error| panic!("a scene adds a body that is refused: {error}"))
}

/// Adds an attractor at the origin for which G times the mass is `strength`, m³/s², whatever G the settings
/// have; none where G is 0 or too small for it.
pub(crate) fn put_attractor(world: &mut World, strength: f32, range: Option<f32>) {
    let mass = strength / world.settings().gravitational_constant;
    if let Ok(attractor) = Attractor::try_new([0.0, 0.0], mass, range) {
        world.add_attractor(attractor);
    }
}

/// Adds a floor of stone whose upper side is at height 0, `width` m wide about the origin and `depth` m deep.
pub(crate) fn put_floor(world: &mut World, width: f32, depth: f32) -> BodyId {
    put(world, Body::fixed(Shape::aabb(width, depth)).at([0.0, -0.5 * depth]).material(Material::STONE))
}

/// Floor on either side of a pool, m: for what bounces over its walls.
const SPILL: f32 = 40.0;

/// Adds a floor with its upper side at height 0, and walls of stone `height` m high and `width` m apart.
pub(crate) fn put_pool(world: &mut World, width: f32, height: f32) {
    put_floor(world, width + 2.0 * (WALL + SPILL), WALL);
    for side in [-1.0, 1.0] {
        let wall = Body::fixed(Shape::aabb(WALL, height)).at([side * 0.5 * (width + WALL), 0.5 * height]);
        put(world, wall.material(Material::STONE));
    }
}

/// Adds four walls about the origin that leave a room `width` m wide and `height` m high.
pub(crate) fn put_room(world: &mut World, width: f32, height: f32, material: Material) {
    for side in [-1.0, 1.0] {
        let upright = Body::fixed(Shape::aabb(WALL, height)).at([side * 0.5 * (width + WALL), 0.0]);
        put(world, upright.material(material));
        let across =
            Body::fixed(Shape::aabb(width + 2.0 * WALL, WALL)).at([0.0, side * 0.5 * (height + WALL)]);
        put(world, across.material(material));
    }
}

/// A fixed beam whose upper side goes from `left` to `right`, m.
pub(crate) fn beam(left: Vec2, right: Vec2, thickness: f32) -> Body {
    let along = right - left;
    let length = along.length();
    let rotation = Rot { c: along.x / length, s: along.y / length };
    let middle = left + along * 0.5 - rotation.rotate(Vec2::new(0.0, 0.5 * thickness));
    Body::fixed(Shape::obb(length, thickness)).at(middle).angle(rotation.angle()).material(Material::STONE)
}

/// A polygon of `corners` equal sides, with its corners `radius` m from the middle and a flat side below.
pub(crate) fn regular_polygon(corners: u8, radius: f32) -> Shape {
    let pitch = core::f32::consts::TAU / f32::from(corners);
    let points = (0..corners).map(|corner| {
        let angle = (f32::from(corner) + 0.5) * pitch - core::f32::consts::FRAC_PI_2;
        Rot::from_angle(angle).rotate(Vec2::new(radius, 0.0))
    });
    Shape::polygon(points).expect("corners on a circle are convex")
}

/// Centre of place `index` in a grid of `columns` places, `pitch` m from one to the next, m: the row of the
/// first is centred on `middle` and the rows follow upward.
pub(crate) fn grid(index: usize, columns: usize, pitch: f32, middle: Vec2) -> Vec2 {
    let (column, row) = (index % columns, index / columns);
    middle + Vec2::new(column as f32 - 0.5 * (columns - 1) as f32, row as f32) * pitch
}

/// Adds a bowl of stone about the origin: `staves` flat pieces that leave a round room of `radius`, m. Only
/// the pieces whose direction from the middle `holds` are put, so that it can be open above.
pub(crate) fn put_bowl(world: &mut World, radius: f32, staves: u16, holds: impl Fn(Vec2) -> bool) {
    let thickness = 0.6;
    let pitch = core::f32::consts::TAU / f32::from(staves);
    // Outer corners of neighbours meet: 2 (r + d) tan(π / n) wide.
    let half = Rot::from_angle(0.5 * pitch);
    let width = 2.0 * (radius + thickness) * half.s / half.c;
    for stave in 0..staves {
        let angle = (f32::from(stave) + 0.5) * pitch;
        let outward = Rot::from_angle(angle).rotate(Vec2::new(1.0, 0.0));
        if holds(outward) {
            let body = Body::fixed(Shape::obb(thickness, width)).at(outward * (radius + 0.5 * thickness));
            put(world, body.angle(angle).material(Material::STONE));
        }
    }
}
