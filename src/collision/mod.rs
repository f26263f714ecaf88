//! Which bodies touch, and how: from bounding boxes (broad phase) to pairs in reach of each other, to contact points
//! (narrow phase), to contacts that live across steps.
//!
//! Two shapes need no world:
//!
//! ```
//! use rustycs::prelude::*;
//!
//! let (ball, crate_) = (Shape::circle(0.5), Shape::rectangle(2.0, 1.0));
//! let manifold = collision::detect(&crate_, Pose::at([0.0, 0.0]), &ball, Pose::at([0.3, 0.98])).unwrap();
//! let [point] = manifold.points() else { panic!("a ball touches at one point") };
//! assert!((point.separation + 0.02).abs() < 1e-6 && manifold.normal == Vec2::new(0.0, 1.0));
//! assert!(collision::detect(&crate_, Pose::at([0.0, 0.0]), &ball, Pose::at([5.0, 0.0])).is_none());
//! ```

pub(crate) mod broad_phase;
mod candidates;
mod contacts;
mod detection;
mod ghosts;
mod manifold;
mod one_way;
mod refresh;

pub(crate) use candidates::CandidatePairs;
pub(crate) use contacts::{AHEAD, ChosenContacts, Contact, Contacts, Frozen};
pub use detection::detect;
pub(crate) use detection::{
    Offset, Swept, Touch, detect_flat, detect_from, detect_within, gap_between, is_flat, noise_of,
    time_of_impact, touch,
};
pub(crate) use ghosts::{Placed, without_ghosts};
pub(crate) use manifold::Corner;
pub use manifold::{FeatureId, Manifold, ManifoldPoint};
pub(crate) use one_way::{OneWay, free_side_of, is_on_free_side, was_before_links};
pub(crate) use refresh::{Refresh, are_out_of_reach, refresh};
