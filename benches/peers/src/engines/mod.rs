//! The engines, each behind the same trait, set up to solve the same problem.
//!
//! What a [`Scene`](crate::scene::Scene) says holds in all of them. For the rest:
//!
//! | | rustycs | Box2D | Rapier |
//! |---|---|---|---|
//! | sleeping, where a scene does not ask for it | off | off | off |
//! | friction of a pair | geometric mean | geometric mean (its default) | geometric mean |
//! | restitution of a pair | larger | larger (its default) | larger |
//! | slowest approach that bounces | 0.1 m/s (default) | 0 (default 1 m/s) | has none |
//! | what [`Fineness::substeps`](crate::engine::Fineness::substeps) sets | substeps | substeps | solver iterations, each a substep |
//! | continuous collision | what a step foresees of two bodies (default) | default: against what is fixed | default: against what is fixed |
//! | softness of contacts, warm starting, top speed | default | default | default |
//! | numbers | `f32`, centres `f64` | `f32` | `f32` |
//! | threads | 1 | 1 | 1 |
//!
//! That all of this reaches the engines is proved by [`check`](crate::check).

#[allow(unsafe_code, reason = "Box2D is a C library; all calls into it are in this module")]
mod box2d;
#[cfg(test)]
mod misled;
mod rapier;

use rustycs_cases::Rustycs;

use crate::engine::Engine;
use box2d::Box2d;
use rapier::Rapier;

pub(crate) use box2d::{LANES as BOX2D_LANES, use_rust_allocator as use_rust_allocator_for_box2d};
#[cfg(test)]
pub(crate) use misled::Misled;

/// The engines, in the order of tables.
pub(crate) fn all() -> Vec<Box<dyn Engine>> {
    vec![Box::new(Rustycs::default()), Box::new(Box2d::default()), Box::new(Rapier::default())]
}

/// The engines, each with and without what it has to sweep bodies: rustycs a setting, the others a flag of bodies.
pub(crate) fn continuous() -> Vec<Box<dyn Engine>> {
    let [rustycs, box2d, rapier] =
        <[Box<dyn Engine>; 3]>::try_from(all()).unwrap_or_else(|_| unreachable!("there are three engines"));
    vec![
        rustycs,
        without_continuous(),
        box2d,
        Box::new(Box2d { are_bullets: true }),
        rapier,
        Box::new(Rapier { has_ccd: true }),
    ]
}

/// rustycs with continuous collision switched off.
pub(crate) fn without_continuous() -> Box<dyn Engine> {
    Box::new(Rustycs { is_discrete: true, ..Rustycs::default() })
}

/// rustycs with a clock between the stages of a step.
pub(crate) fn with_clock() -> Box<dyn Engine> {
    Box::new(Rustycs { times_stages: true, ..Rustycs::default() })
}

/// Whether the engines are built for a fair race.
///
/// # Errors
/// What is wrong with the build, and what to do.
pub(crate) fn fair_build() -> Result<(), String> {
    if cfg!(debug_assertions) {
        return Err("This is a debug build, in which rustycs and Rapier are slow and Box2D is not. \
                    Add --release to the command."
            .to_owned());
    }
    fair_box2d()
}

/// Whether Box2D is built for a fair race.
///
/// # Errors
/// What is wrong with the build, and what to do.
pub(crate) fn fair_box2d() -> Result<(), String> {
    box2d::fair_build()
}
