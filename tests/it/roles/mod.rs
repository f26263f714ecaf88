//! What bodies are to what they meet: filters, pairs that do not collide, sensors.

mod contact_filter;
mod conveyors;
mod filters;
mod one_way;
mod sensors;
