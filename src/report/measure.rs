//! What is measured.

use core::fmt;

use crate::world::World;

/// A number that can be read off a world.
type Gauge<'a> = Box<dyn Fn(&World) -> f64 + 'a>;

/// What a study calls error.
///
/// The first one needs a reference: the scene at finer settings, or a closed form. So does a
/// [`quantity`](Self::quantity). All others are their own measure: they should be 0.
///
/// ```
/// # use rustycs::prelude::*;
/// # let throw = |settings: Settings| {
/// #     let mut world = World::new(settings);
/// #     world.add_force(Force::EARTH_GRAVITY);
/// #     world.add(Body::dynamic(Shape::circle(0.5)).velocity([3.0, 4.0])).unwrap();
/// #     world
/// # };
/// use rustycs::report::{Measure, Study};
///
/// // Does a throw keep its energy?
/// let report = Study::new(throw).measure(Measure::EnergyDrift).run()?;
/// assert!(report.rows().iter().all(|row| row.error < 1e-5));
/// # Ok::<(), rustycs::report::StudyError>(())
/// ```
#[non_exhaustive]
#[derive(Debug)]
pub enum Measure<'a> {
    /// m: how far a point of a moving body is at most from where it should be, over all bodies and sample
    /// times: the distance of the centres, plus the extent of the body times 2 sin(Δangle / 2).
    Trajectory,
    /// The largest change of the energy since the start, as a part of the largest kinetic energy. Meant for
    /// scenes that keep it: no friction, restitution 1.
    EnergyDrift,
    /// The largest rise of the energy above what it was at any time before, as a part of the largest kinetic
    /// energy. It should be 0 in every scene without kinematic bodies, whatever is lost on the way.
    EnergyGain,
    /// The largest change of the momentum, as a part of the largest Σ m |v|. Meant for scenes without forces
    /// and fixed bodies.
    MomentumDrift,
    /// The largest change of the angular momentum about the origin, as a part of the largest
    /// Σ m |x| |v| + I |w|.
    AngularMomentumDrift,
    /// m: the deepest overlap of two bodies in any step.
    Penetration,
    /// m/s: the largest speed with which touching points still approach each other after a step.
    Residual,
    /// A number that is compared with the reference's: see [`quantity`](Self::quantity).
    Quantity(Custom<'a>),
    /// A number that should be 0: see [`error`](Self::error).
    Error(Custom<'a>),
}

impl<'a> Measure<'a> {
    /// A number of the world, read at each sample time (at the tick that ends there or next after it), and
    /// compared with the reference's: the error is the largest difference. `unit` may be empty.
    pub fn quantity(
        name: impl Into<String>,
        unit: impl Into<String>,
        of: impl Fn(&World) -> f64 + 'a,
    ) -> Self {
        Self::Quantity(Custom { name: name.into(), unit: unit.into(), of: Box::new(of) })
    }

    /// A number of the world that should be 0, read after each tick: the error is the largest size of it.
    /// `unit` may be empty.
    pub fn error(name: impl Into<String>, unit: impl Into<String>, of: impl Fn(&World) -> f64 + 'a) -> Self {
        Self::Error(Custom { name: name.into(), unit: unit.into(), of: Box::new(of) })
    }

    /// What the numbers are, as a table or an axis says it.
    pub fn name(&self) -> &str {
        match self {
            Self::Trajectory => "error of the trajectory",
            Self::Quantity(custom) | Self::Error(custom) => &custom.name,
            _ => self.invariant().map_or("", Invariant::name),
        }
    }

    /// Their unit; empty for a mere number.
    pub fn unit(&self) -> &str {
        match self {
            Self::Trajectory => "m",
            Self::Quantity(custom) | Self::Error(custom) => &custom.unit,
            _ => self.invariant().map_or("", Invariant::unit),
        }
    }

    pub(super) fn invariant(&self) -> Option<Invariant> {
        match self {
            Self::EnergyDrift => Some(Invariant::EnergyDrift),
            Self::EnergyGain => Some(Invariant::EnergyGain),
            Self::MomentumDrift => Some(Invariant::MomentumDrift),
            Self::AngularMomentumDrift => Some(Invariant::AngularMomentumDrift),
            Self::Penetration => Some(Invariant::Penetration),
            Self::Residual => Some(Invariant::Residual),
            Self::Trajectory | Self::Quantity(_) | Self::Error(_) => None,
        }
    }

    /// What to read at sample times.
    pub(super) fn quantity_gauge(&self) -> Option<&Gauge<'a>> {
        if let Self::Quantity(custom) = self { Some(&custom.of) } else { None }
    }

    /// What to read after each tick.
    pub(super) fn error_gauge(&self) -> Option<&Gauge<'a>> {
        if let Self::Error(custom) = self { Some(&custom.of) } else { None }
    }
}

/// A number of the caller's own choice.
///
/// ```
/// # use rustycs::prelude::*;
/// # let throw = |settings: Settings| {
/// #     let mut world = World::new(settings);
/// #     world.add_force(Force::EARTH_GRAVITY);
/// #     world.add(Body::dynamic(Shape::circle(0.5)).velocity([3.0, 4.0])).unwrap();
/// #     world
/// # };
/// use rustycs::report::{Measure, Study};
///
/// let height = Measure::quantity("height", "m", |world| world.bodies().next().unwrap().1.position_f64()[1]);
/// let report = Study::new(throw).measure(height).exact_value(|t| 4.0 * t - 0.5 * 9.81 * t * t).run()?;
/// assert!(report.rows().iter().all(|row| row.error < 1e-5));
/// # Ok::<(), rustycs::report::StudyError>(())
/// ```
pub struct Custom<'a> {
    name: String,
    unit: String,
    of: Gauge<'a>,
}

impl fmt::Debug for Custom<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Custom").field("name", &self.name).field("unit", &self.unit).finish_non_exhaustive()
    }
}

/// What should stay as it is, or be 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Invariant {
    EnergyDrift,
    EnergyGain,
    MomentumDrift,
    AngularMomentumDrift,
    Penetration,
    Residual,
}

impl Invariant {
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::EnergyDrift => "drift of the energy",
            Self::EnergyGain => "gain of energy",
            Self::MomentumDrift => "drift of the momentum",
            Self::AngularMomentumDrift => "drift of the angular momentum",
            Self::Penetration => "deepest penetration",
            Self::Residual => "velocity residual",
        }
    }

    pub(super) fn unit(self) -> &'static str {
        match self {
            Self::Penetration => "m",
            Self::Residual => "m/s",
            _ => "",
        }
    }

    pub(super) fn of(self, invariants: &Invariants) -> f64 {
        match self {
            Self::EnergyDrift => invariants.energy_drift,
            Self::EnergyGain => invariants.energy_gain,
            Self::MomentumDrift => invariants.momentum_drift,
            Self::AngularMomentumDrift => invariants.angular_momentum_drift,
            Self::Penetration => invariants.penetration,
            Self::Residual => invariants.residual,
        }
    }
}

/// What should stay as it is, or be 0, and how far from that it was in a run. Every row has all of them.
///
/// ```
/// # use rustycs::prelude::*;
/// # let throw = |settings: Settings| {
/// #     let mut world = World::new(settings);
/// #     world.add_force(Force::EARTH_GRAVITY);
/// #     world.add(Body::dynamic(Shape::circle(0.5)).velocity([3.0, 4.0])).unwrap();
/// #     world
/// # };
/// use rustycs::report::Study;
///
/// let report = Study::new(throw).run()?;
/// let kept = report.rows()[0].invariants;
/// assert!(kept.energy_drift < 1e-5 && kept.penetration == 0.0);
/// # Ok::<(), rustycs::report::StudyError>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Invariants {
    /// See [`Measure::EnergyDrift`].
    pub energy_drift: f64,
    /// See [`Measure::EnergyGain`].
    pub energy_gain: f64,
    /// See [`Measure::MomentumDrift`].
    pub momentum_drift: f64,
    /// See [`Measure::AngularMomentumDrift`].
    pub angular_momentum_drift: f64,
    /// m. See [`Measure::Penetration`].
    pub penetration: f64,
    /// m/s. See [`Measure::Residual`].
    pub residual: f64,
}

impl Invariants {
    /// The larger of each.
    pub(super) fn max(self, other: Self) -> Self {
        Self {
            energy_drift: larger(self.energy_drift, other.energy_drift),
            energy_gain: larger(self.energy_gain, other.energy_gain),
            momentum_drift: larger(self.momentum_drift, other.momentum_drift),
            angular_momentum_drift: larger(self.angular_momentum_drift, other.angular_momentum_drift),
            penetration: larger(self.penetration, other.penetration),
            residual: larger(self.residual, other.residual),
        }
    }
}

/// The larger of two errors; what is not a number is as wrong as can be.
pub(super) fn larger(a: f64, b: f64) -> f64 {
    if b.is_nan() { f64::INFINITY } else { a.max(b) }
}
