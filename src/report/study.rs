//! What a study runs: the scene, what is measured, and at which settings.

use core::fmt;
use core::ops::ControlFlow;

use crate::report::error::StudyError;
use crate::report::measure::Measure;
use crate::report::reference::Source;
use crate::report::result::Report;
use crate::report::run::Runner;
use crate::report::sweep::Sweep;
use crate::report::track::Exact;
use crate::world::{Settings, World};

/// Builds a world from a seed and settings.
type Build<'a> = Box<dyn Fn(u64, Settings) -> World + 'a>;
/// Called before each tick.
type Drive<'a> = Box<dyn Fn(&mut World) + 'a>;
/// Tells the time, s.
type Clock<'a> = Box<dyn Fn() -> f64 + 'a>;
/// Called between and within runs.
type Watcher<'a> = Box<dyn FnMut(&Progress<'_>) -> ControlFlow<()> + 'a>;

/// How far a study is.
///
/// ```
/// # use rustycs::prelude::*;
/// # let throw = |settings: Settings| {
/// #     let mut world = World::new(settings);
/// #     world.add_force(Force::EARTH_GRAVITY);
/// #     world.add(Body::dynamic(Shape::circle(0.5)).velocity([3.0, 4.0])).unwrap();
/// #     world
/// # };
/// use rustycs::report::{Progress, Study};
///
/// use std::ops::ControlFlow;
///
/// let shown = Study::new(throw).progress(|&Progress { done, label, .. }| {
///     eprint!("\r{:3.0} % {label}", 100.0 * done);
///     ControlFlow::Continue(()) // `Break` where the user has had enough
/// });
/// assert!(shown.run()?.is_complete());
/// # Ok::<(), rustycs::report::StudyError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Progress<'a> {
    /// Part of the work that is done, 0 to 1.
    pub done: f64,
    /// What runs now.
    pub label: &'a str,
}

/// Measures the error of a scene against its run time, over a range of settings.
///
/// See the [module](crate::report) for an example.
///
/// ```
/// # use rustycs::prelude::*;
/// # let throw = |settings: Settings| {
/// #     let mut world = World::new(settings);
/// #     world.add_force(Force::EARTH_GRAVITY);
/// #     world.add(Body::dynamic(Shape::circle(0.5)).velocity([3.0, 4.0])).unwrap();
/// #     world
/// # };
/// use rustycs::report::{Exact, Study};
///
/// let report = Study::new(throw)
///     .exact(|t| vec![Exact::at([3.0 * t, 4.0 * t - 0.5 * 9.81 * t * t])])
///     .tick_rates([30.0, 60.0, 120.0])
///     .run()?;
/// assert!(report.rows().iter().all(|row| row.error < 1e-5), "free flight is exact");
/// # Ok::<(), rustycs::report::StudyError>(())
/// ```
pub struct Study<'a> {
    pub(super) name: String,
    pub(super) build: Build<'a>,
    pub(super) seeds: Vec<u64>,
    pub(super) drive: Option<Drive<'a>>,
    pub(super) duration: f64,
    pub(super) samples: u32,
    pub(super) measure: Measure<'a>,
    pub(super) sweep: Sweep,
    pub(super) source: Source<'a>,
    pub(super) repeats: u32,
    pub(super) clock: Option<Clock<'a>>,
    pub(super) progress: Watcher<'a>,
}

impl fmt::Debug for Study<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Study")
            .field("name", &self.name)
            .field("seeds", &self.seeds)
            .field("duration", &self.duration)
            .field("samples", &self.samples)
            .field("measure", &self.measure)
            .field("sweep", &self.sweep)
            .field("repeats", &self.repeats)
            .finish_non_exhaustive()
    }
}

impl<'a> Study<'a> {
    /// A study of the scene that `build` makes. It must make the same bodies in the same order for all
    /// settings, and a world that has the settings it is given.
    ///
    /// Without more, it runs one second with default settings and measures the trajectory.
    pub fn new(build: impl Fn(Settings) -> World + 'a) -> Self {
        Self::with_seeds([0], move |_, settings| build(settings))
    }

    /// The same for a scene with chance in it: every row is run once with each seed, and its error is the
    /// largest of them, so that a [recommendation](Report::recommend) does not hang on one draw.
    pub fn with_seeds(
        seeds: impl IntoIterator<Item = u64>,
        build: impl Fn(u64, Settings) -> World + 'a,
    ) -> Self {
        Self {
            name: "scene".into(),
            build: Box::new(build),
            seeds: seeds.into_iter().collect(),
            drive: None,
            duration: 1.0,
            samples: 20,
            measure: Measure::Trajectory,
            sweep: Sweep {
                base: Settings::default(),
                tick_rates: None,
                substeps: None,
                iterations: None,
                adaptive: None,
                named: Vec::new(),
            },
            source: Source::Finer { factor: 4 },
            repeats: 3,
            clock: None,
            progress: Box::new(|_| ControlFlow::Continue(())),
        }
    }

    /// What the scene is called in tables and plots.
    #[must_use]
    pub fn name(self, name: impl Into<String>) -> Self {
        Self { name: name.into(), ..self }
    }

    /// How long the scene runs, s.
    #[must_use]
    pub fn duration(self, seconds: f64) -> Self {
        Self { duration: seconds, ..self }
    }

    /// At how many times, evenly spread and the last at the end, bodies and quantities are compared. Default
    /// 20. Between two ticks bodies are where the cubic through both places and velocities puts them.
    #[must_use]
    pub fn samples(self, samples: u32) -> Self {
        Self { samples, ..self }
    }

    /// What is called error. Default [`Measure::Trajectory`].
    #[must_use]
    pub fn measure(self, measure: Measure<'a>) -> Self {
        Self { measure, ..self }
    }

    /// What the swept settings have in common. Default [`Settings::default`].
    #[must_use]
    pub fn base(mut self, settings: Settings) -> Self {
        self.sweep.base = settings;
        self
    }

    /// Tick rates to run, 1/s.
    #[must_use]
    pub fn tick_rates(mut self, rates: impl IntoIterator<Item = f32>) -> Self {
        self.sweep.tick_rates = Some(rates.into_iter().collect());
        self
    }

    /// Numbers of substeps to run, each with every tick rate.
    #[must_use]
    pub fn substeps(mut self, substeps: impl IntoIterator<Item = u32>) -> Self {
        self.sweep.substeps = Some(substeps.into_iter().collect());
        self
    }

    /// Numbers of iterations to run, each with every tick rate and number of substeps.
    #[must_use]
    pub fn iterations(mut self, iterations: impl IntoIterator<Item = u32>) -> Self {
        self.sweep.iterations = Some(iterations.into_iter().collect());
        self
    }

    /// Whether to run with [adaptive](Settings::adaptive) solving and substeps, without, or both, each with every other
    /// combination.
    #[must_use]
    pub fn adaptive(mut self, adaptive: impl IntoIterator<Item = bool>) -> Self {
        self.sweep.adaptive = Some(adaptive.into_iter().collect());
        self
    }

    /// More settings to run, as they are, under a name of their own.
    #[must_use]
    pub fn also(mut self, name: impl Into<String>, settings: impl IntoIterator<Item = Settings>) -> Self {
        self.sweep.named.push((name.into(), settings.into_iter().collect()));
        self
    }

    /// Called before each tick: for motors, players, wind.
    #[must_use]
    pub fn before_each_tick(self, drive: impl Fn(&mut World) + 'a) -> Self {
        Self { drive: Some(Box::new(drive)), ..self }
    }

    /// Takes the reference from the scene itself at `factor` times the highest tick rate, the most substeps of
    /// any row and without sleep. The default, with factor 4.
    #[must_use]
    pub fn reference_finer(self, factor: u32) -> Self {
        Self { source: Source::Finer { factor }, ..self }
    }

    /// Takes the reference from the scene itself at these settings. It is run at half and a quarter of the
    /// tick rate too, to know its error.
    #[must_use]
    pub fn reference_settings(self, settings: Settings) -> Self {
        Self { source: Source::Settings(Box::new(settings)), ..self }
    }

    /// Takes the trajectory from a closed form: of the time, s, the place of each body that is not fixed, in
    /// the order in which the scene adds them.
    #[must_use]
    pub fn exact(self, exact: impl Fn(f64) -> Vec<Exact> + 'a) -> Self {
        Self { source: Source::Exact(Box::new(exact)), ..self }
    }

    /// Takes a [quantity](Measure::quantity) from a closed form, of the time, s.
    #[must_use]
    pub fn exact_value(self, exact: impl Fn(f64) -> f64 + 'a) -> Self {
        Self { source: Source::ExactValue(Box::new(exact)), ..self }
    }

    /// A clock to time the rows with: the seconds since any moment. Without one, the cost of a row is how often it visits all
    /// contacts, and the report is the same in every run.
    #[must_use]
    pub fn clock(self, seconds: impl Fn() -> f64 + 'a) -> Self {
        Self { clock: Some(Box::new(seconds)), ..self }
    }

    /// How often each row is timed at least; what is very short is timed more often. Default 3.
    #[must_use]
    pub fn repeats(self, repeats: u32) -> Self {
        Self { repeats, ..self }
    }

    /// Called often, but not while something is timed. [`ControlFlow::Break`] ends the study with the rows that
    /// are done.
    #[must_use]
    pub fn progress(self, progress: impl FnMut(&Progress<'_>) -> ControlFlow<()> + 'a) -> Self {
        Self { progress: Box::new(progress), ..self }
    }

    /// Runs the study.
    ///
    /// # Errors
    /// [`StudyError`], if the duration is not positive, a list or a count is empty, settings are refused, the
    /// scene has no bodies, nothing to measure or other bodies for other settings, the closed form does not
    /// fit, or the progress function stopped the study before the first row.
    pub fn run(self) -> Result<Report, StudyError> {
        Runner::new(self)?.run()
    }

    /// Everything that can be checked without a world.
    pub(super) fn check(&self) -> Result<(), StudyError> {
        if !(self.duration > 0.0 && self.duration.is_finite()) {
            return Err(StudyError::Duration(self.duration));
        }
        let factor = if let Source::Finer { factor } = self.source { factor } else { 1 };
        for (count, value) in [("samples", self.samples), ("repeats", self.repeats), ("times finer", factor)]
        {
            if value == 0 {
                return Err(StudyError::Zero { count });
            }
        }
        if self.seeds.is_empty() {
            return Err(StudyError::EmptySweep { list: "seeds" });
        }
        self.source.check(&self.measure)
    }
}
