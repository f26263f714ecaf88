//! What bodies are to what they meet: filters, pairs that do not collide, sensors.

mod filters;
mod sensors;
