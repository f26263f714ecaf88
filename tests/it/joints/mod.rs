//! Joints: what they hold, drive and bear, by closed forms.

mod pendulums;
