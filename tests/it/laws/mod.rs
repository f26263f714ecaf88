//! Laws of physics, each against its closed form with a derived tolerance.

mod bounces;
mod collisions;
mod flight;
mod friction;
mod limits;
mod mixing;
mod orbits;
mod rocking;
mod rolling;
mod round_corners;
mod springs;
mod stacks;
mod toppling;
mod track;
