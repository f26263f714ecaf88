//! What rows are measured against: a closed form, or the scene itself at much finer settings; and whether
//! trajectories can be compared at all.
//!
//! # How wrong the reference is
//!
//! The scene is run with steps of 4h, 2h and h. If the error falls as h^p, the distances d1 = |x(4h) - x(2h)|
//! and d2 = |x(2h) - x(h)| are in the ratio 2^p, and x(h) is off by d2 / (2^p - 1) (Richardson, 1911, "The
//! approximate arithmetical solution by finite differences"). p is taken from d1 / d2, kept within ½ .. 2: not
//! to believe in an order that two lucky runs suggest.
//!
//! # Chaos
//!
//! The finest row is run twice, the second time with every dynamic body displaced by a micrometre, each in
//! another direction. Where that grows a thousand times and to a tenth of a body, or a thousand times while
//! finer settings do not converge, the trajectory says nothing about the settings. Smooth motion stays far
//! below: a phase error grows as t or t².

use crate::body::BodyType;
use crate::math::{Point, Rot};
use crate::report::error::StudyError;
use crate::report::measure::{Invariant, Measure, larger};
use crate::report::track::{Exact, Track};
use crate::world::{Settings, World};

/// How far bodies are displaced to see whether it grows, m: far above rounding, far below what is seen.
const NUDGE: f64 = 1e-6;
/// A growth that smooth motion does not reach in the time of a study.
const CHAOTIC_GROWTH: f64 = 1e3;
/// A displaced run that ends this many extents of a body elsewhere has another outcome.
const OTHER_OUTCOME: f64 = 0.1;
/// d2 / d1 from which on finer settings do not bring the runs together: p < ½.
const NOT_CONVERGING: f64 = 0.7;
/// Rounding of what `f32` velocities add up to, as a part of the way.
pub(super) const ROUNDING: f64 = 1.2e-7;
/// A scene whose reference keeps its energy within this part is one that should keep it.
const CONSERVES: f64 = 0.01;

/// Where the reference comes from.
pub(super) enum Source<'a> {
    Finer { factor: u32 },
    Settings(Box<Settings>),
    Exact(Box<dyn Fn(f64) -> Vec<Exact> + 'a>),
    ExactValue(Box<dyn Fn(f64) -> f64 + 'a>),
}

impl Source<'_> {
    /// Whether the measure has a use for it.
    pub(super) fn check(&self, measure: &Measure<'_>) -> Result<(), StudyError> {
        match (self, measure) {
            (Self::Exact(_), Measure::Trajectory)
            | (Self::ExactValue(_), Measure::Quantity(_))
            | (Self::Finer { .. } | Self::Settings(_), _) => Ok(()),
            (_, Measure::Trajectory) => Err(StudyError::ExactKind { method: "Study::exact" }),
            (_, Measure::Quantity(_)) => Err(StudyError::ExactKind { method: "Study::exact_value" }),
            _ => Err(StudyError::ExactKind { method: "none: this measure should be 0 by itself" }),
        }
    }

    /// The finest settings, unless there is a closed form.
    pub(super) fn settings(&self, rows: &[Settings]) -> Option<Settings> {
        match self {
            Self::Exact(_) | Self::ExactValue(_) => None,
            Self::Settings(settings) => Some(Settings::clone(settings)),
            Self::Finer { factor } => {
                let tick_rate = rows.iter().map(|row| row.tick_rate).fold(0.0, f32::max);
                let substeps = rows.iter().map(|row| row.substeps).fold(4, u32::max);
                // Sleep freezes what still creeps; substeps that come and go have no order of convergence.
                let base = rows.first()?.clone();
                Some(Settings {
                    tick_rate: tick_rate * *factor as f32,
                    substeps,
                    sleep: false,
                    adaptive: false,
                    ..base
                })
            }
        }
    }
}

/// The settings with steps of 4h, 2h and h.
pub(super) fn ladder(finest: &Settings) -> [Settings; 3] {
    [0.25, 0.5, 1.0].map(|part| Settings { tick_rate: finest.tick_rate * part, ..finest.clone() })
}

/// The scene at much finer settings.
#[derive(Debug)]
pub(super) struct FineRuns {
    pub(super) track: Track,
    /// Estimated error of the track, in the unit of the measure.
    pub(super) error: f64,
    /// Whether finer settings bring the runs together.
    pub(super) converges: bool,
}

impl FineRuns {
    /// From the tracks with steps of 4h, 2h and h.
    pub(super) fn new([coarse, middle, fine]: [Track; 3], measure: &Measure<'_>) -> Self {
        let rounding = if matches!(measure, Measure::Trajectory) { ROUNDING * fine.reach } else { 0.0 };
        let (d1, d2) = (coarse.error_against(&middle, measure), middle.error_against(&fine, measure));
        let converges = d2 <= NOT_CONVERGING * d1 || d2 <= 10.0 * rounding;
        // 2^p.
        let ratio = if d2 > 0.0 { (d1 / d2).clamp(core::f64::consts::SQRT_2, 4.0) } else { 4.0 };
        Self { error: larger(rounding, d2 / (ratio - 1.0)), converges, track: fine }
    }

    /// What can be compared where trajectories cannot.
    pub(super) fn fallback(&self) -> Invariant {
        let invariants = &self.track.invariants;
        if invariants.energy_drift < CONSERVES {
            Invariant::EnergyDrift
        } else if invariants.penetration > 0.0 {
            Invariant::Penetration
        } else {
            Invariant::EnergyGain
        }
    }
}

/// Displaces every dynamic body by [`NUDGE`], each in another direction.
pub(super) fn nudge(world: &mut World) {
    /// Turned by this from one body to the next, directions never repeat (golden angle), rad.
    const TURN: f32 = 2.399_963;
    let moves = world.bodies().filter(|(_, body)| body.body_type() == BodyType::Dynamic);
    let places: Vec<_> = moves.map(|(id, body)| (id, body.position_f64())).collect();
    let mut direction = Rot::from_angle(1.0);
    for (id, [x, y]) in places {
        direction = (direction * Rot::from_angle(TURN)).normalized();
        let place = Point::new(x + NUDGE * f64::from(direction.c), y + NUDGE * f64::from(direction.s));
        if let Some(mut body) = world.body_mut(id) {
            // A place that far out that it cannot be moved is left as it is.
            _ = body.set_position(place);
        }
    }
}

/// What a tiny change of the start comes to.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Sensitivity {
    /// How many times farther apart two runs end than they began.
    pub(super) growth: f64,
    pub(super) is_chaotic: bool,
}

impl Sensitivity {
    pub(super) fn new(run: &Track, nudged: &Track, converges: bool) -> Self {
        let (extent, distance) = run.worst_end_from(nudged);
        let growth = distance / NUDGE;
        let is_other = distance >= OTHER_OUTCOME * extent;
        Self { growth, is_chaotic: growth >= CHAOTIC_GROWTH && (is_other || !converges) }
    }

    /// The worse of two.
    pub(super) fn max(self, other: Self) -> Self {
        Self { growth: larger(self.growth, other.growth), is_chaotic: self.is_chaotic || other.is_chaotic }
    }
}
