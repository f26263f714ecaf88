//! What can be set about a world, and what is refused.

use core::fmt;

use crate::body::{HORIZON, Mix, Mixes, Number, RestRule};
use crate::compute::{Lanes, MOST_THREADS};
use crate::math::{Aabb, Vec2};
use crate::resolution::{Asked, MOST_SUBSTEPS, Scheme, SpeedLimits};

/// How overlapping bodies are parted.
///
/// ```
/// use rustycs::prelude::*;
///
/// // As the engines of the nineties did it, for comparison.
/// let projected = PositionCorrection::Projection { iterations: 4 };
/// assert_eq!(Settings::classic().position_correction, projected);
/// let world = World::new(Settings { position_correction: projected, ..Settings::default() });
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum PositionCorrection {
    /// By a bias in the velocity sweeps that leaves no velocity behind.
    Bias,
    /// By moving the bodies directly after the velocities are solved: the classic way.
    Projection {
        /// How many times every contact is visited.
        iterations: u32,
    },
}

/// What can be set about a world.
///
/// All fields are public; write the ones you care about and take the rest from the default:
///
/// ```
/// use rustycs::Settings;
///
/// let settings = Settings { tick_rate: 120.0, substeps: 8, ..Settings::default() };
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// Ticks per second of simulated time, 1/s, 0.1 to 10⁶. Default 60. What the tests check begins at 10; at 1 and below, with four substeps,
    /// bodies fall through floors.
    pub tick_rate: f32,
    /// Most ticks that one [`advance`](crate::World::advance) takes, 1 to 10⁶: time beyond them is dropped, so that the world
    /// falls behind in a slow frame instead of making the next one slower still. Default 8.
    pub max_ticks_per_advance: u32,
    /// Substeps per tick, 1 to 256. The error of contacts falls as their number grows. Default 4.
    ///
    /// Bodies at rest sag into each other by an amount that depends on the length of a substep. A change of it lifts or lowers what
    /// stands: ten boxes of 1 m on each other by a centimetre, from 60 to 240 ticks per second. For slow motion, multiply
    /// the tick rate by as much as the substeps are divided by: nothing moves then.
    pub substeps: u32,
    /// Whether more is done where loads are great, as with heavy bodies on light ones or in tall stacks. Default true.
    ///
    /// Three things are done, each where it is needed:
    /// - An island may be solved [directly](crate::Tier::Direct), if that is little work. Other islands do not pay for it.
    /// - The moment of inertia of a body is scaled for a step, in an island that is swept, if its loads would let it rock faster than substeps can follow: it
    ///   turns more slowly than it would, and bears its load as before. That is a light body under some hundred times its weight.
    /// - The whole world takes up to eight times as many substeps, while heavy bodies would press light ones flat in an island that
    ///   is swept. It does not where more than 32 joints are awake, and never takes more than 256.
    ///
    /// All may be done at once: an island that is solved directly needs no more substeps, but all islands take as many as the one that needs the
    /// most. [`Counters`](crate::Counters) tell of the first and the last. Nothing is done without [`split_kick`](Self::split_kick), or where
    /// [`position_correction`](Self::position_correction) is a projection.
    pub adaptive: bool,
    /// Sequential-impulse sweeps over all contacts before the bodies move, per substep, 1 to 1000. Default 1.
    pub iterations: u32,
    /// Sweeps after the bodies have moved, which take the push out of overlaps out of the velocities again,
    /// per substep, 0 to 1000; 1 or more where `split_kick` is set. Default 1.
    pub relax_iterations: u32,
    /// Whether forces act half before and half after the bodies move (second order) or whole before it
    /// (first order, the classic way). Default true.
    pub split_kick: bool,
    /// Whether contacts begin with the impulse they ended with. Default true.
    pub warm_starting: bool,
    /// Whether bodies that get their speed within a tick, or spin fast, are swept along their ways, so that they pass
    /// through nothing. Others pay nothing. Default true.
    pub continuous: bool,
    /// Whether the two points of a contact are solved together. Default true.
    pub block_solve: bool,
    /// Whether manifolds are kept, and contacts with circles hold still within a step, while the bodies hardly move
    /// against each other. Default true.
    pub recycling: bool,
    /// How overlapping bodies are parted. Default [`PositionCorrection::Bias`].
    pub position_correction: PositionCorrection,
    /// Whether bodies at rest are put to sleep, which costs nothing until something wakes them. Default true.
    ///
    /// Bodies that touch each other sleep together, once all of them are at rest and each is held there: by contacts that
    /// bear load, on something that does not move, or by damping. What nothing holds sleeps only if it does not move at all.
    /// Without [rolling resistance](crate::Body::rolling_resistance) a disc rolls for ever, and a pile in which one does never sleeps.
    pub sleep: bool,
    /// What strays from its place more slowly than this is at rest, m/s, 0 to 10⁶: on average over the next ten seconds,
    /// and of the point of the body that strays most. Default 10⁻⁴, 1 mm in ten seconds.
    pub sleep_speed: f32,
    /// How long bodies must have been at rest before they sleep, s, 0 to 3600. What trembles takes longer. Default 0.5.
    pub sleep_time: f32,
    /// Slowest approach that bounces, m/s, 0 to 10¹⁸; 0: everything bounces. Approaches slower than the speed gained
    /// from forces in two substeps never bounce. Default 0.1.
    pub restitution_threshold: f32,
    /// Slowest approach that is reported as a [hit](crate::HitEvent), m/s, 0 to 10¹⁸. Default 1.
    pub hit_threshold: f32,
    /// Whether the impulses of every contact are added up over the tick. Then [`ContactRef::impulse_on`] tells them. And bodies that
    /// rest on each other report a blow that runs through them as a hit, as in a stack that something falls on. What counts is the
    /// impulse beside the load that they bear: it must be `hit_threshold` times their reduced mass or more, and a quarter of the
    /// load or more. Bodies that meet report their hits either way. It costs 3 to 5 % of a lively step, and up to
    /// 20 % of one in which all rests and is awake; no bit of a motion depends on it. Default false.
    ///
    /// [`ContactRef::impulse_on`]: crate::world::ContactRef::impulse_on
    pub sum_impulses: bool,
    /// How the friction of a surface mixes with that of others, if it has [no rule of its own](crate::Body::friction_mix). Default
    /// [`Mix::Average`], which keeps 0 at 0.
    pub friction_mix: Mix,
    /// The same of restitution. Default [`Mix::Average`], which keeps 0 at 0.
    pub restitution_mix: Mix,
    /// G in a = G·mass/r² of attractors, m³/(kg s²), 0 to 10¹². Default 1.
    pub gravitational_constant: f32,
    /// Bodies that move and whose centre leaves this box are removed at the end of the step, and
    /// [reported](crate::Events::left). Default `None`: a world has no bounds, and what flies away costs next to
    /// nothing.
    pub bounds: Option<Aabb>,
    /// Components of velocities are cut to this speed, m/s, 10⁻³ to 10⁶, as soon as they are set or come about. Default 10⁵.
    pub max_speed: f32,
    /// Angular velocities are cut to this, rad/s, 10⁻³ to 10⁶, likewise. Default 10⁵.
    pub max_spin: f32,
    /// How many contacts are solved at a time. No bit of a result depends on it. Default [`Lanes::Auto`].
    pub lanes: Lanes,
    /// How many threads may work on a step, the caller's among them, 1 to 16: no more than the processor has cores. No
    /// bit of a result depends on it. A step that is too short to be worth it is done by one, and all are where the
    /// feature `parallel` is off. Worlds with the same number share threads, which end at the first step of the last
    /// of them that asks for another number, or with it. Default 1.
    pub threads: usize,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            tick_rate: 60.0,
            max_ticks_per_advance: 8,
            substeps: 4,
            adaptive: true,
            iterations: 1,
            relax_iterations: 1,
            split_kick: true,
            warm_starting: true,
            continuous: true,
            block_solve: true,
            recycling: true,
            position_correction: PositionCorrection::Bias,
            sleep: true,
            sleep_speed: 1e-4,
            sleep_time: 0.5,
            restitution_threshold: 0.1,
            hit_threshold: 1.0,
            sum_impulses: false,
            friction_mix: Mix::Average,
            restitution_mix: Mix::Average,
            gravitational_constant: 1.0,
            bounds: None,
            max_speed: 1e5,
            max_spin: 1e5,
            lanes: Lanes::Auto,
            threads: 1,
        }
    }
}

impl Settings {
    /// The scheme of classic engines: one substep with a single kick, ten sweeps with friction over points
    /// one at a time, no relax sweep, manifolds found anew each step, positions projected afterwards.
    pub fn classic() -> Self {
        Self {
            substeps: 1,
            adaptive: false,
            iterations: 10,
            relax_iterations: 0,
            split_kick: false,
            block_solve: false,
            recycling: false,
            position_correction: PositionCorrection::Projection { iterations: 4 },
            ..Self::default()
        }
    }

    /// Whether bodies move by these settings as they do by `others`.
    pub(crate) fn moves_bodies_like(&self, others: &Self) -> bool {
        let Self { max_ticks_per_advance, hit_threshold, sum_impulses, bounds, .. } = *self;
        let Self { lanes, threads, .. } = *self;
        let rest = Self { max_ticks_per_advance, hit_threshold, sum_impulses, bounds, ..others.clone() };
        let same = Self { lanes, threads, ..rest };
        *self == same
    }

    /// Length of a tick, s.
    pub fn tick_seconds(&self) -> f64 {
        1.0 / f64::from(self.tick_rate)
    }

    /// Checks every number.
    ///
    /// # Errors
    /// [`SettingsError`], if a number is NaN or outside the range its field states, if the bounds hold nothing, or if
    /// a split kick is asked for without a relax sweep to solve its second half.
    pub fn validate(&self) -> Result<(), SettingsError> {
        let projections = match self.position_correction {
            PositionCorrection::Bias => 1,
            PositionCorrection::Projection { iterations } => iterations,
        };
        for (field, value, min, max) in [
            ("tick_rate", f64::from(self.tick_rate), 0.1, 1e6),
            ("max_ticks_per_advance", f64::from(self.max_ticks_per_advance), 1.0, 1e6),
            ("substeps", f64::from(self.substeps), 1.0, f64::from(MOST_SUBSTEPS)),
            ("iterations", f64::from(self.iterations), 1.0, 1000.0),
            ("relax_iterations", f64::from(self.relax_iterations), 0.0, 1000.0),
            ("position_correction.iterations", f64::from(projections), 1.0, 1000.0),
            ("restitution_threshold", f64::from(self.restitution_threshold), 0.0, 1e18),
            ("hit_threshold", f64::from(self.hit_threshold), 0.0, 1e18),
            ("sleep_speed", f64::from(self.sleep_speed), 0.0, 1e6),
            ("sleep_time", f64::from(self.sleep_time), 0.0, 3600.0),
            ("gravitational_constant", f64::from(self.gravitational_constant), 0.0, 1e12),
            ("max_speed", f64::from(self.max_speed), 1e-3, 1e6),
            ("max_spin", f64::from(self.max_spin), 1e-3, 1e6),
            ("threads", self.threads as f64, 1.0, MOST_THREADS as f64),
        ] {
            // NaN fails the comparison.
            if !(value >= min && value <= max) {
                return Err(SettingsError::OutOfRange { field, value, min, max });
            }
        }
        if let Some(Aabb { min, max }) = self.bounds {
            // NaN fails the comparison.
            if !(min.is_finite() && max.is_finite() && min.x < max.x && min.y < max.y) {
                return Err(SettingsError::Bounds { min, max });
            }
        }
        if self.split_kick && self.relax_iterations == 0 {
            return Err(SettingsError::SplitKickWithoutRelax);
        }
        Ok(())
    }

    /// Whether islands may be solved directly, moments of inertia scaled, and substeps refined.
    pub(crate) fn adapts(&self) -> bool {
        self.adaptive && self.split_kick && self.position_correction == PositionCorrection::Bias
    }

    /// What counts as rest.
    pub(crate) fn rest_rule(&self) -> RestRule {
        RestRule {
            time: self.sleep_time,
            reach: self.sleep_speed * HORIZON,
            tick: self.tick_seconds() as f32,
        }
    }

    /// How the materials of two bodies mix.
    pub(crate) fn mixes(&self) -> Mixes {
        Mixes { friction: self.friction_mix, restitution: self.restitution_mix }
    }

    /// Length of a substep, s.
    pub(crate) fn substep_seconds(&self) -> f32 {
        self.tick_seconds() as f32 / self.substeps as f32
    }

    /// What velocities are cut to.
    pub(crate) fn speed_limits(&self) -> SpeedLimits {
        SpeedLimits { speed: self.max_speed, spin: self.max_spin }
    }

    /// What the solver needs to know for a step that computes with so many bodies or contacts after each other.
    pub(crate) fn scheme(
        &self,
        substeps: u32,
        fitted_kernels: bool,
        sizes: impl Iterator<Item = usize>,
    ) -> Scheme {
        Scheme {
            dt: self.tick_seconds() as f32,
            substeps,
            asked_substeps: self.substeps,
            iterations: self.iterations,
            relax_iterations: self.relax_iterations,
            split_kick: self.split_kick,
            adapts: self.adaptive,
            warm_starting: self.warm_starting,
            continuous: self.continuous,
            block_solve: self.block_solve,
            projections: match self.position_correction {
                PositionCorrection::Bias => None,
                PositionCorrection::Projection { iterations } => Some(iterations),
            },
            restitution_threshold: self.restitution_threshold,
            asked: if self.sum_impulses { Asked::ALL } else { Asked::meeting_from(self.hit_threshold) },
            limits: self.speed_limits(),
            width: self.lanes.width_for(sizes),
            fitted_kernels,
        }
    }
}

/// Why settings were refused. The world keeps the ones it has.
///
/// ```
/// use rustycs::prelude::*;
///
/// let read_from_a_file = Settings { substeps: 0, ..Settings::default() };
/// let error = World::try_new(read_from_a_file).unwrap_err();
/// assert_eq!(error.to_string(), "Settings::substeps is 0; give a number from 1 to 256");
/// assert!(matches!(error, SettingsError::OutOfRange { field: "substeps", .. }));
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum SettingsError {
    /// A number is NaN or outside the range of its field.
    OutOfRange {
        /// Name of the field.
        field: &'static str,
        /// The number given.
        value: f64,
        /// Smallest number allowed.
        min: f64,
        /// Largest number allowed.
        max: f64,
    },
    /// The corners of `bounds` are not finite, or the first is not below and left of the second.
    Bounds {
        /// The first corner, m.
        min: Vec2,
        /// The second corner, m.
        max: Vec2,
    },
    /// `split_kick` is set and `relax_iterations` is 0.
    SplitKickWithoutRelax,
}

impl fmt::Display for SettingsError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::OutOfRange { field, value, min, max } => {
                let [value, min, max] = [*value, *min, *max].map(Number);
                write!(f, "Settings::{field} is {value}; give a number from {min} to {max}")
            }
            Self::Bounds { min, max } => write!(
                f,
                "Settings::bounds is from ({}, {}) to ({}, {}); give two finite corners, the lower left one first",
                min.x, min.y, max.x, max.y
            ),
            Self::SplitKickWithoutRelax => f.write_str(
                "Settings::split_kick needs relax_iterations of 1 or more, to solve the second half of the \
                 kick; set one or clear the other",
            ),
        }
    }
}

impl std::error::Error for SettingsError {}
