//! Vectors, rotations, poses and boxes: the arithmetic everything above is written in.
//!
//! Places in the world ([`Point`]) are kept in `f64`, everything relative ([`Vec2`]) in `f32`: far from the
//! origin an `f32` coordinate would carry millimetres of noise, and the small steps of a fine substep would
//! be lost in it. The types keep the two apart: a point minus a point is a vector.

mod aabb;
mod convert;
mod point;
mod pose;
mod reach;
mod rot;
pub mod trig;
mod vec2;

pub use aabb::Aabb;
pub use point::Point;
pub use pose::Pose;
pub(crate) use reach::{Opposite, Reach};
pub use rot::Rot;
pub(crate) use trig::{atan2_f64, sin_cos_of_small};
pub use vec2::Vec2;
