//! How an island may be solved; [`tiers`](super::tiers) says which is.

/// How the contacts of an island are solved.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Tier {
    /// By sweeps over all contacts, one after the other.
    #[default]
    Swept,
    /// All contacts at once.
    Direct,
}
