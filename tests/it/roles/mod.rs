//! What bodies are to what they meet: filters and pairs that do not collide.

mod filters;
