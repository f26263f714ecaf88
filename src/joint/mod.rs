//! Joints: what holds two bodies together, or a body to the world, and how a world keeps them.
//!
//! A [`Joint`] is a description, as a [`Body`](crate::Body) is; [`World::add_joint`](crate::World::add_joint) checks it and
//! gives its [`JointId`]. What a joint asks of its bodies is a list of rows, each a coordinate (the gap of the anchors, the
//! angle, the way along an axis, a distance) and a role (rigid, limits, spring, speed); the solver knows only these.

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
    JointId
}
