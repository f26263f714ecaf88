//! Joints: what they hold, drive and bear, by closed forms.

mod by_chance;
mod drives;
mod impacts;
mod kinds;
mod loads;
mod loops;
mod machines;
mod pendulums;
mod pulleys;
mod stalled;
mod stones;
mod use_of_joints;
