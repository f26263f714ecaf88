//! Which stages of a step ran, on how much, and for how long.

use core::fmt;
use std::sync::Arc;

/// The stages of a step, in order.
///
/// ```
/// use rustycs::prelude::*;
///
/// let mut world = World::new(Settings::default());
/// world.step();
/// assert!(Stage::ALL.iter().all(|&stage| !world.profile().stage(stage).ran), "nothing is there");
/// world.add(Body::dynamic(Shape::circle(0.5)))?;
/// world.step();
/// assert!(world.profile().stage(Stage::Solve).ran && !world.profile().stage(Stage::Contacts).ran);
/// # Ok::<(), BodyError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Stage {
    /// Broad phase: new pairs among bodies whose boxes have moved.
    Pairs,
    /// Narrow phase: manifolds of pairs that are close.
    Contacts,
    /// The substep loop: forces, impacts, contacts, motion.
    Solve,
    /// New poses and boxes.
    Finalize,
    /// Contacts that began or ended.
    Events,
    /// What began and ceased to overlap sensors.
    Sensors,
    /// Islands at rest go to sleep.
    Sleep,
}

impl Stage {
    /// All stages, in the order in which a step runs them.
    pub const ALL: &[Self] =
        &[Self::Pairs, Self::Contacts, Self::Solve, Self::Finalize, Self::Events, Self::Sensors, Self::Sleep];

    /// The name of the stage.
    pub fn name(self) -> &'static str {
        match self {
            Self::Pairs => "pairs",
            Self::Contacts => "contacts",
            Self::Solve => "solve",
            Self::Finalize => "finalize",
            Self::Events => "events",
            Self::Sensors => "sensors",
            Self::Sleep => "sleep",
        }
    }
}

/// What one stage did in the last step.
///
/// ```
/// use rustycs::prelude::*;
///
/// let mut world = World::new(Settings::default());
/// world.add(Body::dynamic(Shape::circle(0.5)))?;
/// world.step();
/// for (stage, StageReport { ran, count, .. }) in world.profile().stages() {
///     println!("{}: {}", stage.name(), if ran { format!("{count} things") } else { "did not run".into() });
/// }
/// assert_eq!(world.profile().stage(Stage::Solve).count, 1);
/// # Ok::<(), BodyError>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct StageReport {
    /// Whether it ran; a stage without input does not.
    pub ran: bool,
    /// How many things it worked on: moved boxes, contacts, bodies, ...
    pub count: usize,
    /// How long it took, s; `None` without a clock. It is finite and not negative, whatever the [`Clock`] tells.
    pub seconds: Option<f64>,
}

/// A clock: a function that tells the seconds since any moment of the caller's choice. Clones of a world share it.
///
/// The library reads no clock of its own; on the web there is none in the standard library.
///
/// ```
/// use rustycs::prelude::*;
/// use std::time::Instant;
///
/// let mut world = World::new(Settings::default());
/// world.add(Body::dynamic(Shape::circle(0.5)))?;
/// let start = Instant::now();
/// world.set_clock(Clock::new(move || start.elapsed().as_secs_f64()));
/// world.step();
/// println!("the step took {:.1} µs", world.profile().seconds().unwrap() * 1e6);
/// # Ok::<(), BodyError>(())
/// ```
#[derive(Clone)]
pub struct Clock(Arc<dyn Fn() -> f64 + Send + Sync>);

impl Clock {
    /// A clock that is read by calling a function.
    ///
    /// A stage took no time if the function went backwards meanwhile, or if the difference of its two readings is NaN or infinite. So all
    /// times of a [`Profile`] are finite, and none is negative.
    ///
    /// If the function panics, the step panics in the middle. The world cannot be stepped again, nor can a clone that is made of it afterwards.
    /// Drop both, and go on with a clone from before.
    pub fn new(seconds: impl Fn() -> f64 + Send + Sync + 'static) -> Self {
        Self(Arc::new(seconds))
    }

    fn seconds(&self) -> f64 {
        (self.0)()
    }

    /// How much later it is now than at a reading of before, s: 0 if the clock went backwards or tells no number.
    fn seconds_since(&self, start: f64) -> f64 {
        let passed = self.seconds() - start;
        // NaN is not above 0.
        if passed > 0.0 && passed.is_finite() { passed } else { 0.0 }
    }
}

impl fmt::Debug for Clock {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Clock")
    }
}

/// What the last step did.
///
/// ```
/// use rustycs::prelude::*;
///
/// let mut world = World::new(Settings::default());
/// world.set_clock(Clock::new({
///     let start = std::time::Instant::now();
///     move || start.elapsed().as_secs_f64()
/// }));
/// world.add(Body::dynamic(Shape::circle(0.5)))?;
/// world.step();
/// let slowest = world.profile().stages().max_by(|(_, one), (_, other)| one.seconds.partial_cmp(&other.seconds).unwrap());
/// println!("most time goes to: {}", slowest.unwrap().0.name());
/// # Ok::<(), BodyError>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct Profile {
    stages: [StageReport; Stage::ALL.len()],
    pub(crate) clock: Option<Clock>,
    pub(crate) counters: Counters,
}

/// How much there was in the last step.
///
/// ```
/// use rustycs::prelude::*;
///
/// let mut world = World::new(Settings::default());
/// world.add_force(Force::EARTH_GRAVITY);
/// world.add(Body::fixed(Shape::rectangle(20.0, 1.0)).at([0.0, -0.5]))?;
/// for x in 0..3 {
///     world.add(Body::dynamic(Shape::rectangle(1.0, 1.0)).at([2.0 * f64::from(x), 0.5]))?;
/// }
/// world.step();
/// let Counters { awake_bodies, contacts, .. } = world.profile().counters();
/// assert_eq!((awake_bodies, contacts), (3, 3));
/// # Ok::<(), BodyError>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Counters {
    /// Bodies that the solver moved.
    pub awake_bodies: usize,
    /// Contacts with points: what the solver solved.
    pub contacts: usize,
    /// Pairs of bodies whose boxes overlap.
    pub pairs: usize,
    /// Contacts that could bounce.
    pub bouncy_contacts: usize,
    /// Bounces.
    pub impacts: usize,
    /// Colours of the constraint graph in use.
    pub colours: usize,
    /// Contacts that found no colour.
    pub overflow: usize,
    /// Substeps, of which there may be [more than are asked for](crate::Settings::adaptive), until they have not been needed for
    /// 60 steps; 0 where nothing is awake.
    pub substeps: u32,
    /// Bodies of islands that were solved [directly](crate::Tier::Direct).
    pub direct_bodies: usize,
    /// Those islands.
    pub direct_islands: usize,
}

impl Profile {
    /// What one stage did.
    pub fn stage(&self, stage: Stage) -> StageReport {
        self.stages[stage as usize]
    }

    /// What each stage did, in the order in which they ran.
    pub fn stages(&self) -> impl Iterator<Item = (Stage, StageReport)> {
        Stage::ALL.iter().copied().zip(self.stages)
    }

    /// How long the stages took together, s; `None` without a clock.
    pub fn seconds(&self) -> Option<f64> {
        self.clock.as_ref()?;
        let sum: f64 = self.stages.iter().filter_map(|stage| stage.seconds).sum();
        Some(sum.min(f64::MAX))
    }

    /// How much there was.
    pub fn counters(&self) -> Counters {
        self.counters
    }

    /// Runs a stage, unless it has no input.
    pub(crate) fn run_stage(&mut self, stage: Stage, count: usize, work: impl FnOnce()) {
        let report = &mut self.stages[stage as usize];
        *report = StageReport { ran: count > 0, count, seconds: self.clock.as_ref().map(|_| 0.0) };
        if count == 0 {
            return;
        }
        let start = self.clock.as_ref().map(Clock::seconds);
        work();
        report.seconds = self.clock.as_ref().zip(start).map(|(clock, start)| clock.seconds_since(start));
    }
}
