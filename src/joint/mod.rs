//! Joints: what holds two bodies together, or a body to the world, and how a world keeps them.
//!
//! A [`Joint`] is a description, as a [`Body`](crate::Body) is; [`World::add_joint`](crate::World::add_joint) checks it and
//! gives its [`JointId`]. What a joint asks of its bodies is a list of rows, each a coordinate (the gap of the anchors, the
//! angle, the way along an axis, a distance, how much rope is in use) and a role (rigid, limits, spring, speed); the solver
//! knows only these.
//!
//! ```
//! use rustycs::prelude::*;
//!
//! let mut world = World::new(Settings::default());
//! world.add_force(Force::EARTH_GRAVITY);
//! let bob = world.add(Body::dynamic(Shape::circle(0.1)).at([1.0, 0.0]))?;
//! world.add_joint(Joint::distance(bob, None).between([1.0, 0.0], [0.0, 0.0]))?; // a pendulum of 1 m
//! while world.body(bob).unwrap().position().x > 0.0 {
//!     world.step();
//! }
//! // From the level to the lowest point: 1.854 √(l/g).
//! assert!((world.time() - 1.854 / 9.81_f64.sqrt()).abs() < 1.0 / 60.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod check;
mod description;
mod error;
mod table;

pub use description::{Joint, JointKind};
pub(crate) use description::{Motor, Spring};
pub use error::JointError;
pub(crate) use table::{End, JointRecord, Joints, Pace};

crate::store::id_type! {
    /// Names a joint of a world.
    ///
    /// ```
    /// use rustycs::prelude::*;
    ///
    /// let mut world = World::new(Settings::default());
    /// let lamp = world.add(Body::dynamic(Shape::circle(0.2)))?;
    /// let rope = world.add_joint(Joint::rope(lamp, None).between([0.0, 0.0], [0.0, 2.0]))?;
    /// assert_eq!(world.joints_of(lamp), [rope]);
    /// world.remove_joint(rope);
    /// assert!(world.joint(rope).is_none());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    JointId
}
