//! What a case is.

use crate::scene::Scene;
use crate::stability::causes;
use crate::stability::run::Lab;

/// A hard case, and what must hold in it.
pub struct Case {
    /// In lower case, without spaces.
    pub name: String,
    /// Where it stands on the page.
    pub group: Group,
    /// What must hold, and from what it follows.
    pub statement: String,
    /// What it is played with first; empty where the judge builds everything itself.
    pub scene: Scene,
    /// Simulated time of the longest run, s.
    pub seconds: f64,
    /// Plays it and measures.
    pub judge: Judge,
    /// Whether a quick run leaves it out: it takes many seconds.
    pub is_long: bool,
    /// What is to be seen of it.
    pub seen: Seen,
}

/// Groups of cases.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Group {
    /// Boxes on boxes.
    Stacks,
    /// Pyramids, houses, arches, what is about to tip.
    Structures,
    /// Too many bodies for the place they have.
    Confined,
    /// Very large, very small, very thin.
    Sizes,
    /// Very fast.
    Speeds,
    /// Far from the origin.
    Far,
    /// Forces, rates and materials at their limits.
    Forces,
    /// For a very long time.
    Long,
    /// By chance.
    Random,
}

impl Group {
    /// All groups, in the order of the page.
    pub const ALL: [Self; 9] = [
        Self::Stacks,
        Self::Structures,
        Self::Confined,
        Self::Sizes,
        Self::Speeds,
        Self::Far,
        Self::Forces,
        Self::Long,
        Self::Random,
    ];

    /// As a heading.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Stacks => "stacks and loads",
            Self::Structures => "structures",
            Self::Confined => "confined",
            Self::Sizes => "sizes",
            Self::Speeds => "speeds",
            Self::Far => "far from the origin",
            Self::Forces => "forces, rates, materials",
            Self::Long => "long",
            Self::Random => "random",
        }
    }
}

/// Plays a scene in an engine.
pub type Play = dyn Fn(&mut Lab<'_>, &Scene) -> Vec<Check>;
/// Plays a case of rustycs alone.
pub type PlayOurs = dyn Fn(&mut Lab<'_>) -> Vec<Check>;

/// Plays a case and measures what must hold.
pub enum Judge {
    /// In any engine.
    Every(Box<Play>),
    /// In rustycs only, through its own interface.
    Ours {
        /// Why other engines are not asked.
        why: &'static str,
        /// Plays it. The lab's clock is to be used, its engine is not.
        judge: Box<PlayOurs>,
    },
}

impl core::fmt::Debug for Judge {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            Self::Every(_) => "Every",
            Self::Ours { .. } => "Ours",
        })
    }
}

impl core::fmt::Debug for Case {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let Self { name, statement, judge, .. } = self;
        f.debug_struct("Case")
            .field("name", name)
            .field("statement", statement)
            .field("judge", judge)
            .finish_non_exhaustive()
    }
}

impl Case {
    /// A case for every engine, of 10 s, that is not long.
    pub(super) fn new(
        name: impl Into<String>,
        group: Group,
        statement: impl Into<String>,
        scene: Scene,
        judge: impl Fn(&mut Lab<'_>, &Scene) -> Vec<Check> + 'static,
    ) -> Self {
        Self {
            name: name.into(),
            group,
            statement: statement.into(),
            scene,
            seconds: 10.0,
            judge: Judge::Every(Box::new(judge)),
            is_long: false,
            seen: Seen::No,
        }
    }

    /// A case for rustycs alone.
    pub(super) fn ours(
        name: impl Into<String>,
        group: Group,
        statement: impl Into<String>,
        why: &'static str,
        judge: impl Fn(&mut Lab<'_>) -> Vec<Check> + 'static,
    ) -> Self {
        Self {
            name: name.into(),
            group,
            statement: statement.into(),
            scene: Scene::default(),
            seconds: 10.0,
            judge: Judge::Ours { why, judge: Box::new(judge) },
            is_long: false,
            seen: Seen::No,
        }
    }

    pub(super) fn lasting(self, seconds: f64) -> Self {
        Self { seconds, ..self }
    }

    pub(super) fn long(self) -> Self {
        Self { is_long: true, ..self }
    }

    pub(super) fn seen(self) -> Self {
        Self { seen: Seen::Whole, ..self }
    }

    /// Why rustycs fails, where it does; empty where that is not known.
    #[must_use]
    pub fn cause(&self) -> &'static str {
        causes::of(&self.name)
    }

    /// Plays the case in the engine of the lab; `None` if that engine is not asked.
    pub fn play(&self, lab: &mut Lab<'_>) -> Option<Vec<Check>> {
        match &self.judge {
            Judge::Every(judge) => Some(judge(lab, &self.scene)),
            Judge::Ours { judge, .. } => lab.is_ours().then(|| judge(lab)),
        }
    }
}

/// The unit of parts of a whole.
pub const SHARE: &str = "share";
/// The unit of numbers of things.
pub const COUNT: &str = "";

/// What is to be seen of a case in the end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Seen {
    /// Nothing.
    No,
    /// Where the bodies were set, and somewhat around it.
    Whole,
    /// What is within these corners, m.
    Part([[f64; 2]; 2]),
}

/// Something that must hold, with what was found.
#[derive(Clone, Debug, PartialEq)]
pub struct Check {
    /// What is measured.
    pub what: String,
    /// In `unit`.
    pub value: f64,
    /// What the value must keep to.
    pub limit: Limit,
    /// [`SHARE`], [`COUNT`], or as it is written.
    pub unit: &'static str,
}

/// What a value must keep to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Limit {
    /// It must not be more.
    AtMost(f64),
    /// It must not be less.
    AtLeast(f64),
}

impl Check {
    /// A value that must not be more than a limit.
    pub(super) fn at_most(what: impl Into<String>, value: f64, limit: f64, unit: &'static str) -> Self {
        Self { what: what.into(), value, limit: Limit::AtMost(limit), unit }
    }

    /// A value that must not be less than a limit.
    pub(super) fn at_least(what: impl Into<String>, value: f64, limit: f64, unit: &'static str) -> Self {
        Self { what: what.into(), value, limit: Limit::AtLeast(limit), unit }
    }

    /// How far the value is from its limit: above 1 beyond it, 0 for what must not be and is not.
    #[must_use]
    pub fn strain(&self) -> f64 {
        let strain = match self.limit {
            Limit::AtMost(limit) if self.value <= 0.0 && limit >= 0.0 => 0.0,
            Limit::AtMost(limit) => self.value / limit,
            Limit::AtLeast(limit) => limit / self.value,
        };
        if strain.is_nan() { f64::INFINITY } else { strain }
    }

    /// Whether the value keeps to its limit. One that is no number does not.
    #[must_use]
    pub fn holds(&self) -> bool {
        match self.limit {
            Limit::AtMost(limit) => self.value <= limit,
            Limit::AtLeast(limit) => self.value >= limit,
        }
    }
}
