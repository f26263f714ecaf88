//! Resolution: from manifolds to velocities.
//!
//! Sequential impulses in substeps over a coloured constraint graph, with soft contacts, a relax sweep and
//! impacts as a stage of their own. [`solve`] is the substep loop; read it first.

mod asked;
mod axis;
mod block;
mod blows;
mod constraint;
mod constraint_graph;
mod contact_block;
mod damping;
mod direct;
mod events;
mod integrate;
mod islands;
mod joint;
mod kernel;
mod load;
mod mass_scaling;
mod moving;
mod moving_geometry;
mod projection;
mod rates;
mod refinement;
mod rolling;
mod scheme;
mod softness;
mod solve_contact;
mod solver;
mod squeezes;
mod tangles;
mod tier;
mod tier_rule;
mod tiers;

pub(crate) use asked::Asked;
pub(crate) use blows::{Begun, Blow, Collision, Ids, Impact};
pub(crate) use constraint::StepResidual;
pub(crate) use constraint_graph::ConstraintGraph;
pub(crate) use events::Encounter;
pub(crate) use integrate::SpeedLimits;
pub(crate) use islands::{Connections, Islands, find_island};
#[cfg(feature = "report")]
pub(crate) use kernel::work_of_a_substep;
pub(crate) use load::{Loads, begins_at_rest};
pub(crate) use rates::Rescaling;
pub(crate) use refinement::{MOST_SUBSTEPS, Refinement, RefinementTables};
pub(crate) use scheme::Scheme;
pub(crate) use solver::{Acceleration, SolveTables, Solver, force_on, solve};
pub use tier::Tier;
pub(crate) use tier_rule::TierRule;
pub(crate) use tiers::{TierTables, Tiers};
