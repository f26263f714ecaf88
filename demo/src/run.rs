//! A world that runs, with all that is kept about it from tick to tick.

use rustycs::{BodyId, BodyRef, Clock, Pose, Settings, World};
use rustycs_scenes::Scene;

use macroquad::time::get_time;

use crate::gauges::Gauges;
use crate::history::{History, Moment};
use crate::poses::Poses;
use crate::spring::Spring;
use crate::trails::Trails;

/// Ticks that one frame takes at most: after a slow frame the world falls behind instead of making the next
/// frame slower still.
const MOST_TICKS: u32 = 64;

/// What happens to the world in every tick, beside its own step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tick<'a> {
    pub(crate) scene: &'static Scene,
    /// The keys of a player: the left one, the right one.
    pub(crate) player: Option<[bool; 2]>,
    /// The spring that drags a body.
    pub(crate) spring: Option<&'a Spring>,
    /// Whether places are kept for trails.
    pub(crate) keeps_trails: bool,
}

/// A world that runs.
#[derive(Debug)]
pub(crate) struct Run {
    pub(crate) world: World,
    /// Simulated time since the scene began, s.
    pub(crate) seconds: f64,
    pub(crate) gauges: Gauges,
    pub(crate) trails: Trails,
    pub(crate) history: History,
    poses: Poses,
    /// Time that frames have given and no tick has used yet, s.
    unused: f64,
}

impl Run {
    /// A scene at time 0.
    pub(crate) fn new(scene: &Scene, seed: u64) -> Self {
        let mut world = scene.build(seed, Settings::default());
        world.set_clock(Clock::new(get_time));
        Self::at(Moment { world, seconds: 0.0 })
    }

    /// A world at a moment, with nothing known about what was before.
    pub(crate) fn at(moment: Moment) -> Self {
        Self {
            world: moment.world,
            seconds: moment.seconds,
            gauges: Gauges::default(),
            trails: Trails::default(),
            history: History::default(),
            poses: Poses::default(),
            unused: 0.0,
        }
    }

    /// Takes as many ticks as fit into some simulated time, s, and what earlier calls left over.
    pub(crate) fn advance(&mut self, seconds: f64, tick: Tick<'_>) {
        self.unused += seconds;
        for _ in 0..MOST_TICKS {
            let length = self.world.settings().tick_seconds();
            // Sixty frames of 1/60 s are to make sixty ticks, whatever way the sum is rounded.
            if self.unused < length * (1.0 - 1e-9) {
                return;
            }
            self.unused = (self.unused - length).max(0.0);
            self.tick(tick);
        }
        self.unused = 0.0;
    }

    fn tick(&mut self, tick: Tick<'_>) {
        self.history.observe(&self.world, self.seconds);
        self.poses.keep(&self.world);
        match tick.player {
            Some(keys) => tick.scene.before_tick_played(&mut self.world, keys),
            None => tick.scene.before_tick(&mut self.world),
        }
        if let Some(spring) = tick.spring {
            spring.pull(&mut self.world);
        }
        self.world.step();
        self.seconds += self.world.settings().tick_seconds();
        self.gauges.observe(&self.world);
        if tick.keeps_trails {
            self.trails.observe(&self.world);
        }
    }

    /// Shows bodies where they are, and lets the next tick begin from nothing.
    pub(crate) fn settle(&mut self) {
        self.poses.forget();
        self.unused = 0.0;
    }

    /// The world as it is now.
    pub(crate) fn moment(&self) -> Moment {
        Moment { world: self.world.clone(), seconds: self.seconds }
    }

    /// Puts the world of another moment in place of this one; it keeps the settings of now.
    pub(crate) fn go_to(&mut self, moment: Moment) {
        let settings = self.world.settings().clone();
        self.world = moment.world;
        self.seconds = moment.seconds;
        if *self.world.settings() != settings {
            self.world.set_settings(settings).expect("settings that are in force are in range");
        }
        self.trails.clear();
        self.settle();
    }

    /// Goes back to the last world kept from before now.
    pub(crate) fn rewind(&mut self) {
        if let Some(earlier) = self.history.before(self.seconds) {
            self.go_to(earlier);
        }
    }

    /// Every body with the pose to show it in.
    pub(crate) fn bodies(&self) -> impl Iterator<Item = (BodyId, BodyRef<'_>, Pose)> {
        let share = (self.unused / self.world.settings().tick_seconds()) as f32;
        self.poses.bodies(&self.world, share.clamp(0.0, 1.0))
    }
}
