//! Vectors, rotations, poses and boxes: the arithmetic everything above is written in.
//!
//! Places in the world ([`Point`]) are kept in `f64`, everything relative ([`Vec2`]) in `f32`: far from the
//! origin an `f32` coordinate would carry millimetres of noise, and the small steps of a fine substep would
//! be lost in it. The types keep the two apart: a point minus a point is a vector.
//!
//! ```
//! use rustycs::prelude::*;
//!
//! let (hero, exit) = (Point::new(2.0, 1.0), Point::new(14.0, 6.0));
//! let way = exit - hero;
//! assert_eq!((way, way.length()), (Vec2::new(12.0, 5.0), 13.0));
//! let step = way.clamp_length(0.13); // m in this tick
//! assert!((hero + step).distance([2.12, 1.05]) < 1e-6);
//! ```

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
