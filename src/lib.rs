//! 2D rigid-body physics that reports its error, stays stable on hard cases, and leaves out what a scene does
//! not need.
//!
//! Units are metres, kilograms, seconds and radians; y points up. Choose how many pixels a metre has, and multiply when you draw.
//! [`coming_from`] has the names of Box2D and Rapier beside those here.
//!
//! A [`World`] holds [bodies](Body) of [shapes](Shape) and [materials](Material), [forces](Force) and
//! [attractors](Attractor); [`World::step`] moves it by one tick.
//!
//! ```
//! use rustycs::prelude::*;
//!
//! let mut world = World::new(Settings::default()); // 60 ticks per second, 4 substeps, no gravity
//! world.add_force(Force::EARTH_GRAVITY);
//! world.add(Body::fixed(Shape::aabb(20.0, 1.0)).at([0.0, -0.5]))?;
//! let ball = world.add(Body::dynamic(Shape::circle(0.5)).at([0.0, 5.0]).material(Material::RUBBER))?;
//! for _ in 0..60 {
//!     world.step();
//! }
//! println!("after a second the ball is at {:?}", world.body(ball).unwrap().position());
//! # Ok::<(), BodyError>(())
//! ```
//!
//! # In a game
//!
//! [`World::advance`] takes the time of a frame and as many ticks as fit; it comes to the same at any number of frames per
//! second. [`World::advance_with`] calls back before each tick, for control. [`World::body_mut`] pushes, changes and reads a
//! body, [`World::contacts_of`] tells what it touches, and [`BodyRef::interpolated_pose`] where to draw it.
//! A character that is moved by hand is a [`Mover`], and a map of tiles a [`TileMap`].
//! [`Events::hits`] tell where bodies met, and with which impulse; [`World::draw_lines`] draws all there is.
//!
//! # A step
//!
//! | stage | runs on | does |
//! |---|---|---|
//! | pairs | boxes that moved | finds new pairs of overlapping boxes |
//! | contacts | awake pairs | updates manifolds, ends pairs whose boxes have parted |
//! | solve | awake bodies | substeps: forces, impacts, contacts, motion |
//! | finalize | awake bodies | adds the motion to the poses, updates boxes that bodies have left |
//! | events | awake contacts | what began, ended, hit |
//! | sensors | sensors | what began and ceased to overlap them |
//! | sleep | bodies long at rest | puts islands in equilibrium to sleep |
//!
//! A stage without input does not run, and [`World::profile`] shows it.
//!
//! # Units
//!
//! Metres, kilograms, seconds, radians; y points up and angles turn counter-clockwise. Mass comes from the
//! density per area. The centre of a body is kept in `f64`, all that is relative in `f32`.
//!
//! # Layers
//!
//! Modules by layer (floor); each uses only those below it.
//!
//! | floor | module | what is in it |
//! |---|---|---|
//! | 0 | [`math`] | vectors, places, rotations, poses, boxes, our own sine and cosine |
//! | 0 | `store` | generational ids, slots, bit set, pair set |
//! | 0 | `compute` | numbers in lanes (scalar, SSE2, NEON, AVX2, AVX-512), the width chosen at run time, the hot rows of bodies, threads |
//! | 1 | [`shape`] | circle, boxes, convex polygon, capsule, round corners, segment; concave outlines as pieces; mass, rays, points |
//! | 2 | [`joint`] | description of joints, and how they are kept |
//! | 2 | [`body`] | description, material, role, and how many bodies are kept |
//! | 3 | [`collision`] | broad phase, detection, manifolds, contacts |
//! | 4 | `resolution` | the solver: substeps, constraint graph, contact kernel, direct solve, impacts, islands |
//! | 5 | [`world`] | the world, its step, and everything that can be asked of it; characters and tile maps |
//! | 6 | `report` | error against run time, for any scene; with the feature of that name |
//!
//! # Determinism
//!
//! Same calls, same bits: on every machine and build profile, at every width of lanes, on any number of threads, in
//! every clone. The library reads no clock, draws no random number and uses no trigonometry but its own.
//!
//! # Errors
//!
//! - What is built from data (shapes, bodies, settings, and changes of them) returns a `Result`. Its error is a sentence that
//!   says what to change, and nothing has changed.
//! - What a game does every frame (velocities, impulses, forces, see [`BodyMut`]) returns nothing that must be looked at. A
//!   number that is not finite or out of range is refused, and nothing changes: a debug build panics at the line of the call,
//!   a release build reports it in [`Events::refused`].
//! - An id of what was removed gives `None`.
//! - A constructor that panics says so, names the line of its caller, and has a twin `try_` that does not.
//! - [`World::step`] never fails, and no NaN gets in or out.
//!
//! # Features
//!
//! `report`: error against run time, without a dependency. `parallel`: several threads for the steps of large worlds,
//! as [`Settings::threads`] says, without a dependency. `mint`, `glam-027`, `glam-029`, `glam-030`: conversions of
//! vectors. None is on by default, and the default build has no dependency.

/// `Clone`, field by field, whose `clone_from` uses the buffers of the value that is there. What is scratch of a step stays
/// there as it is.
macro_rules! clone_into_buffers {
    ($type:ident $(<$parameter:ident>)? { $($field:ident),* $(,)? } $(scratch { $($scratch:ident),* $(,)? })?) => {
        impl$(<$parameter: Clone>)? Clone for $type$(<$parameter>)? {
            fn clone(&self) -> Self {
                Self {
                    $($field: Clone::clone(&self.$field),)*
                    $($($scratch: Clone::clone(&self.$scratch),)*)?
                }
            }

            fn clone_from(&mut self, source: &Self) {
                // A field that is not named does not compile.
                let Self { $($field,)* $($($scratch: _,)*)? } = self;
                $(Clone::clone_from($field, &source.$field);)*
            }
        }
    };
}

pub mod body;
pub mod collision;
#[cfg(any(doc, doctest))]
#[doc = include_str!("coming_from.md")]
pub mod coming_from {}
#[allow(unsafe_code)]
pub(crate) mod compute;
pub mod joint;
pub mod math;
#[cfg(feature = "report")]
pub mod report;
pub(crate) mod resolution;
pub mod shape;
pub(crate) mod store;
#[cfg(test)]
pub(crate) mod testing;
pub mod world;

pub use body::{
    Body, BodyError, BodyId, BodyType, Collider, ColliderId, ContactFilter, Filter, FilteredShape, Ground,
    Material, Mix,
};
pub use collision::{FeatureId, Manifold, ManifoldPoint};
pub use joint::{Joint, JointError, JointId, JointKind};
pub use math::{Aabb, Point, Pose, Rot, Vec2};
pub use shape::{Shape, ShapeError};
pub use world::{
    Attractor, AttractorError, AttractorId, Awake, BodyMut, BodyRef, Character, Clock, ClosestHit,
    ColliderMut, ColliderRef, ContactEvent, ContactRef, Counters, DrawnPart, Events, Force, ForceError,
    ForceId, HitEvent, JointGap, JointMut, JointRef, JointRefusal, Lanes, Moved, Mover, PositionCorrection,
    Profile, QueryFilter, RayHit, Refusal, SensorEvent, Settings, SettingsError, ShapeHit, Stage,
    StageReport, StepError, Tier, TileMap, World,
};

/// Everything a program needs by name.
///
/// ```
/// use rustycs::prelude::*;
///
/// let mut world = World::default();
/// world.add(Body::dynamic(Shape::circle(0.5)))?;
/// # Ok::<(), BodyError>(())
/// ```
///
/// Beside the prelude of another crate that has a `Vec2` too, name the one that is meant: `use rustycs::Vec2;`.
pub mod prelude {
    pub use crate::{
        Aabb, Attractor, AttractorError, AttractorId, Awake, Body, BodyError, BodyId, BodyMut, BodyRef,
        BodyType, Character, Clock, ClosestHit, Collider, ColliderId, ColliderMut, ColliderRef, ContactEvent,
        ContactFilter, ContactRef, Counters, DrawnPart, Events, FeatureId, Filter, FilteredShape, Force,
        ForceError, ForceId, Ground, HitEvent, Joint, JointError, JointGap, JointId, JointKind, JointMut,
        JointRef, JointRefusal, Lanes, Manifold, ManifoldPoint, Material, Mix, Moved, Mover, Point, Pose,
        PositionCorrection, Profile, QueryFilter, RayHit, Refusal, Rot, SensorEvent, Settings, SettingsError,
        Shape, ShapeError, ShapeHit, Stage, StageReport, StepError, Tier, TileMap, Vec2, World, collision,
    };
}

/// The code of the README compiles and runs.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
