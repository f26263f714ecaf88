//! What a body is: its description ([`Body`], and [`Collider`] for further shapes), its material, and how the engine keeps many of them.
//!
//! Data is split by how often it is touched. Hot: `BodyState`, 32 bytes, one row per awake body, read and written
//! several times per substep. Warm: `Motion`, pose and mass, 64 bytes, touched a few times per step by each contact;
//! `Forcing`, what acts on the body, touched once; `RestWatch`, touched once where a body is slow. Cold: `Record`, touched when
//! somebody asks or a contact begins.
//!
//! A body of several shapes has a slot for itself and one for each of its shapes.
//!
//! ```
//! use rustycs::prelude::*;
//!
//! let mut world = World::new(Settings::default());
//! let head = Collider::new(Shape::rectangle(0.4, 0.2)).at([0.0, 0.5]).material(Material::METAL);
//! let hammer = Body::dynamic(Shape::rectangle(0.1, 0.9)).with(head).at([2.0, 3.0]).angular_velocity(4.0);
//! let hammer = world.add(hammer.density(0.7).friction(0.4))?;
//! // Near the head: 0.7 · 0.09 kg and 7.8 · 0.08 kg.
//! assert!((world.body(hammer).unwrap().position().y - 3.454).abs() < 1e-3);
//! # Ok::<(), BodyError>(())
//! ```

mod bodies;
mod body_type;
mod chain;
mod collide;
mod collider;
mod compound;
mod contact_filter;
mod description;
mod error;
mod exposures;
mod filter;
pub(crate) mod limits;
mod material;
mod mixing;
mod pieces;
mod rest;
mod role;
mod rolling;
mod tiles;

pub(crate) use bodies::{Bodies, Forcing, Motion, NONE, Record};
pub use body_type::BodyType;
pub use collider::{Collider, ColliderId};
pub use contact_filter::{ContactFilter, FilteredShape};
pub use description::Body;
pub use error::BodyError;
pub(crate) use error::{Number, check_range};
pub(crate) use exposures::Exposures;
pub use filter::Filter;
pub use material::{Material, Mix};
pub(crate) use material::{Mixed, Mixes};
pub(crate) use rest::{HORIZON, RestRule, RestWatch};
pub(crate) use role::{Role, Roles};
pub use tiles::Ground;
pub(crate) use tiles::{body_of_tiles, boxes_of_tiles, check_tile_size};

crate::store::id_type! {
    /// Names a body of a world.
    ///
    /// ```
    /// use rustycs::prelude::*;
    ///
    /// let mut world = World::new(Settings::default());
    /// let ball = world.add(Body::dynamic(Shape::circle(0.5)))?;
    /// let mut names = vec![String::new(); world.body_count()];
    /// names[ball.index()] = "ball".into();
    /// world.remove(ball);
    /// assert!(world.body(ball).is_none());
    /// let next = world.add(Body::dynamic(Shape::circle(0.5)))?;
    /// assert!(next.index() == ball.index() && next != ball, "in the same place, but not the same");
    /// # Ok::<(), BodyError>(())
    /// ```
    BodyId
}
