//! Numbers in lanes: the contact kernel is one text, generic over how many contacts it solves at a time.
//!
//! [`Lane`] is what the kernel computes with. `f32` is the lane of width 1: the reference that every wider
//! lane must agree with bit for bit, which it can because no operation here is fused or estimated.

mod lane;
mod state;
mod vector;

pub(crate) use lane::Lane;
pub(crate) use state::{BodyState, GROUND_ROW};
pub(crate) use vector::{LaneRot, LaneVec2};
