//! rustycs: 2D rigid-body physics.
pub mod body;
pub mod collision;
pub(crate) mod compute;
pub mod math;
pub(crate) mod resolution;
pub mod shape;
pub(crate) mod store;
pub mod world;

pub use body::{Body, BodyError, BodyId, BodyType, Material, Mix};
pub use collision::{FeatureId, Manifold, ManifoldPoint};
pub use math::{Aabb, Point, Pose, Rot, Vec2};
pub use shape::{Shape, ShapeError};
pub use world::*;

/// All that a program needs by name.
pub mod prelude {
    pub use crate::*;
}
