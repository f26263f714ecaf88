//! Bodies of several shapes: what they weigh, how they move and meet, and what each shape is for itself.

mod edits;
mod laws;
mod parts;
mod pieces;
mod set_into_each_other;
mod thrown;
