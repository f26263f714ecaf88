//! What several scenes are made of.

use rustycs::{Body, BodyId, Force, Material, Settings, Shape, World};

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

/// Adds a floor of stone whose upper side is at height 0, `width` m wide about the origin and `depth` m deep.
pub(crate) fn put_floor(world: &mut World, width: f32, depth: f32) -> BodyId {
    put(world, Body::fixed(Shape::aabb(width, depth)).at([0.0, -0.5 * depth]).material(Material::STONE))
}
