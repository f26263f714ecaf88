//! What scenes with joints are made of.

use rustycs::{Body, BodyId, Filter, Joint, JointId, Material, Shape, Vec2, World};

use crate::parts::put;

/// Of parts of one machine that pass each other, as those of a linkage do, one behind the other.
pub(crate) const GHOST: Filter = Filter { group: -1, ..Filter::DEFAULT };

/// Adds a joint that is right by construction.
///
/// # Panics
/// If it is not: a mistake in the scene.
pub(crate) fn join(world: &mut World, joint: Joint) -> JointId {
    world.add_joint(joint).unwrap_or_else(|error| panic!("a scene adds a joint that is refused: {error}"))
}

/// A bar of metal from one place to another, m, that moves.
pub(crate) fn bar(from: Vec2, to: Vec2, width: f32) -> Body {
    let along = to - from;
    let body = Body::dynamic(Shape::obb(along.length(), width)).at(from + along * 0.5);
    body.angle(along.angle()).material(Material::METAL)
}

/// Adds bars that hang together, along a line of places from the first to the last, m; returns them.
pub(crate) fn put_chain(
    world: &mut World,
    places: &[Vec2],
    link: impl Fn(Vec2, Vec2) -> Body,
) -> Vec<BodyId> {
    let bodies: Vec<BodyId> = places.windows(2).map(|ends| put(world, link(ends[0], ends[1]))).collect();
    for (pair, &place) in bodies.windows(2).zip(&places[1..]) {
        join(world, Joint::revolute(pair[0], pair[1]).at(place));
    }
    bodies
}

/// Places at the same distance from each other, the first and the last with them.
pub(crate) fn divided(from: Vec2, to: Vec2, pieces: u16) -> Vec<Vec2> {
    let share = |piece: u16| f32::from(piece) / f32::from(pieces);
    (0..=pieces).map(|piece| from + (to - from) * share(piece)).collect()
}

/// How far the joint is off that is off most, m.
pub(crate) fn largest_gap(world: &World) -> f32 {
    world.joints().map(|(_, joint)| joint.error().distance).fold(0.0, f32::max)
}
