//! How hard the solver works on a body, and on all that contacts connect with it.

/// How hard the solver works on an island.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Effort {
    /// As the settings say.
    #[default]
    Plain,
    /// Twice as many substeps.
    Double,
    /// Four times as many substeps.
    Fourfold,
    /// Eight times as many substeps.
    Eightfold,
    /// All contacts of the island are solved at once, in the substeps of the settings.
    Direct,
}

impl Effort {
    /// All efforts, the least first.
    pub const ALL: [Self; 5] = [Self::Plain, Self::Double, Self::Fourfold, Self::Eightfold, Self::Direct];

    /// How many substeps it takes for one of the settings.
    pub fn substep_factor(self) -> u32 {
        match self {
            Self::Plain | Self::Direct => 1,
            Self::Double => 2,
            Self::Fourfold => 4,
            Self::Eightfold => 8,
        }
    }
}
