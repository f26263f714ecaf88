//! The world: everything that is simulated together, and all that can be asked of it.
//!
//! ```
//! use rustycs::prelude::*;
//!
//! let mut world = World::new(Settings::default());
//! world.add_force(Force::EARTH_GRAVITY);
//! world.add(Body::fixed(Shape::rectangle(20.0, 1.0)).at([0.0, -0.5]))?;
//! let hero = world.add(Body::dynamic(Shape::rectangle(0.6, 1.8)).at([0.0, 0.9]).fixed_rotation(true))?;
//! let frame = 1.0 / 144.0; // s, as measured
//! world.advance_with(frame, |world| {
//!     world.body_mut(hero).unwrap().apply_force([0.2, 0.0]); // what the player wants
//! });
//! for hit in world.events().hits() {
//!     println!("a sound at {}", hit.point);
//! }
//! let shown = world.body(hero).unwrap().interpolated_pose(world.alpha()); // where to draw it
//! # assert_eq!(shown.center, Point::new(0.0, 0.9));
//! # Ok::<(), BodyError>(())
//! ```

mod advance;
mod attractor;
mod body_change;
mod body_mut;
mod body_view;
mod character;
mod collider_mut;
mod collider_view;
mod collisions;
mod conserved;
mod contact_view;
mod draw;
mod edit;
mod events;
mod force;
mod ground;
mod hash;
mod held_forces;
mod hits;
mod joint_view;
mod joints;
mod memory;
mod mixing;
mod profile;
mod query;
mod sensors;
mod settings;
mod sleep;
mod step;
mod tile_map;
mod validate;

pub use crate::compute::Lanes;
pub use crate::resolution::Tier;
pub use attractor::{Attractor, AttractorError, AttractorId};
pub use body_mut::BodyMut;
pub use body_view::BodyRef;
pub use character::{Character, Moved, Mover};
pub use collider_mut::ColliderMut;
pub use collider_view::ColliderRef;
pub use contact_view::ContactRef;
pub use draw::DrawnPart;
pub use events::{ContactEvent, Events, HitEvent, JointRefusal, Refusal, SensorEvent};
pub use force::{Force, ForceError, ForceId};
pub use joint_view::{JointGap, JointMut, JointRef};
pub use profile::{Clock, Counters, Profile, Stage, StageReport};
pub use query::{ClosestHit, QueryFilter, RayHit, ShapeHit};
pub use settings::{PositionCorrection, Settings, SettingsError};
pub use sleep::Awake;
pub use tile_map::TileMap;

use crate::body::{Bodies, BodyError, BodyId};
use crate::collision::broad_phase::BroadPhase;
use crate::collision::{CandidatePairs, Contacts};
use crate::compute::ThreadPool;
use crate::joint::Joints;
use crate::math::{Aabb, Vec2};
use crate::resolution::{
    Connections, ConstraintGraph, Loads, Refinement, Rescaling, Solver, StepResidual, Tiers, find_island,
};
use crate::store::{BitSet, Slots};
use crate::world::attractor::Field;
use crate::world::held_forces::{Forced, HeldForces};
use crate::world::memory::MemoryUse;
use crate::world::sensors::Sensors;
use crate::world::sleep::{SleepTables, Sleepers};

/// Bodies, forces and attractors that are simulated together.
///
/// A world owns all it needs: it can be cloned, sent to another thread, and stepped there with the same result, bit for bit. It
/// shares nothing but threads, where [`Settings::threads`] asks for some. For rollback there is `clone_from`: it uses the memory
/// of the world that is overwritten, and allocates nothing if that is large enough. It also makes a world whole whose step panicked.
///
/// ```
/// use rustycs::prelude::*;
///
/// let mut world = World::new(Settings::default());
/// world.add_force(Force::EARTH_GRAVITY);
/// let ball = world.add(Body::dynamic(Shape::circle(0.5)).at([0.0, 10.0]))?;
/// for _ in 0..60 {
///     world.step();
/// }
/// let fallen = 10.0 - world.body(ball).unwrap().position().y;
/// assert!((fallen - 0.5 * 9.81).abs() < 1e-5);
/// # Ok::<(), BodyError>(())
/// ```
#[derive(Debug)]
pub struct World {
    settings: Settings,
    bodies: Bodies,
    broad_phase: BroadPhase,
    candidates: CandidatePairs,
    contacts: Contacts,
    joints: Joints,
    graph: ConstraintGraph,
    sleepers: Sleepers,
    forces: Slots<Force>,
    /// The sum of all forces, m/s².
    acceleration: Vec2,
    attractors: Slots<Attractor>,
    solver: Solver,
    tiers: Tiers,
    refinement: Refinement,
    rescaling: Rescaling,
    loads: Loads,
    events: Events,
    sensors: Sensors,
    profile: Profile,
    residual: StepResidual,
    /// Length of the substeps that the impulses of contacts are of, s; none before the first step.
    impulses_of: Option<f32>,
    /// Awake bodies that have been at rest for long enough to sleep.
    resting: usize,
    ticks: u64,
    /// The tick from which on the tick rate has been as it is, and when that was, s.
    rate_since: (u64, f64),
    /// Whether a step has begun and not ended: between steps it has only where one panicked.
    is_within_step: bool,
    /// Time that `advance` was given and no tick has used yet, s.
    unused_time: f64,
    /// Time that `advance` was given and has dropped, s.
    dropped_time: f64,
    /// Bodies that were given a force for the next tick; some may be in it more than once.
    forced: Vec<Forced>,
    held_forces: HeldForces,
    /// Bodies that were told to get to a pose in the next tick; some may have been told otherwise since, or more than once.
    arriving: Vec<BodyId>,
    pool: ThreadPool,
    /// Whether contacts are solved by kernels that leave out what is not there.
    fits_kernels: bool,
    memory_use: MemoryUse,
    /// Scratch of the step.
    new_pairs: Vec<(u32, u32)>,
    /// Scratch of the step, by place in the list of awake contacts: of those that have changed, whether the bodies are
    /// still close.
    is_close_now: Vec<Option<bool>>,
    /// Scratch of the step, by row but for the ground: bodies that have left their box.
    leaves_box: Vec<bool>,
    /// Scratch of the step: their slots.
    leaving: Vec<u32>,
    /// Scratch of the step: index, and whether the bodies are still close.
    changed_contacts: Vec<(u32, bool)>,
}

clone_into_buffers!(World {
    settings, bodies, broad_phase, candidates, contacts, joints, graph, sleepers, forces, acceleration,
    attractors, solver, tiers, refinement, loads, events, sensors, profile, residual, impulses_of, resting, ticks,
    rate_since, is_within_step, unused_time, dropped_time, forced, held_forces, arriving, fits_kernels,
    memory_use
} scratch {
    rescaling, pool, new_pairs, is_close_now, leaves_box, leaving, changed_contacts
});

impl Default for World {
    /// An empty world with the default [`Settings`].
    fn default() -> Self {
        Self::new(Settings::default())
    }
}

/// How far the last step was from perfect. Of bodies that sleep it is the step in which they fell asleep that counts.
///
/// ```
/// use rustycs::prelude::*;
///
/// let mut world = World::new(Settings::default());
/// world.add(Body::fixed(Shape::rectangle(20.0, 1.0)).at([0.0, -0.5]))?;
/// world.add(Body::dynamic(Shape::circle(0.5)).at([0.0, 0.48]))?;
/// world.step();
/// let StepError { penetration, .. } = world.error();
/// assert!(penetration > 0.01 && penetration < 0.02, "it was put in by 2 cm, and is on its way out");
/// # Ok::<(), BodyError>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct StepError {
    /// Deepest overlap of two bodies at the end of the step, m. It is measured at the points and along the normal of their contact, which are
    /// found as the step begins. Bodies that turn or pass each other fast may have left these by then: for them it may be too large or too small.
    pub penetration: f32,
    /// Largest speed with which two touching points still approach each other, m/s.
    pub velocity_residual: f32,
}

impl World {
    /// An empty world: no bodies, no forces, no gravity.
    ///
    /// # Panics
    /// If `settings` holds a number that [`Settings::validate`] refuses; [`try_new`](Self::try_new) returns
    /// the reason instead.
    #[track_caller]
    pub fn new(settings: Settings) -> Self {
        match Self::try_new(settings) {
            Ok(world) => world,
            Err(error) => panic!("{error}"),
        }
    }

    /// An empty world: no bodies, no forces, no gravity.
    ///
    /// # Errors
    /// [`SettingsError`], if `settings` holds a number that [`Settings::validate`] refuses.
    pub fn try_new(settings: Settings) -> Result<Self, SettingsError> {
        settings.validate()?;
        Ok(Self {
            settings,
            bodies: Bodies::default(),
            broad_phase: BroadPhase::default(),
            candidates: CandidatePairs::default(),
            contacts: Contacts::default(),
            joints: Joints::default(),
            graph: ConstraintGraph::default(),
            sleepers: Sleepers::default(),
            forces: Slots::default(),
            acceleration: Vec2::ZERO,
            attractors: Slots::default(),
            solver: Solver::default(),
            tiers: Tiers::default(),
            refinement: Refinement::default(),
            rescaling: Rescaling::default(),
            loads: Loads::default(),
            events: Events::default(),
            sensors: Sensors::default(),
            profile: Profile::default(),
            residual: StepResidual::default(),
            impulses_of: None,
            resting: 0,
            ticks: 0,
            rate_since: (0, 0.0),
            is_within_step: false,
            unused_time: 0.0,
            dropped_time: 0.0,
            forced: Vec::new(),
            held_forces: HeldForces::default(),
            arriving: Vec::new(),
            pool: ThreadPool::default(),
            fits_kernels: true,
            memory_use: MemoryUse::default(),
            new_pairs: Vec::new(),
            is_close_now: Vec::new(),
            leaves_box: Vec::new(),
            leaving: Vec::new(),
            changed_contacts: Vec::new(),
        })
    }

    /// The settings.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// Puts other settings in force from the next step on. Wakes all bodies, unless they are those it has, or differ only in
    /// what does not move a body: `max_ticks_per_advance`, `hit_threshold`, `sum_impulses`, `bounds`, `lanes`,
    /// `threads`.
    ///
    /// # Errors
    /// [`SettingsError`], if `settings` holds a number that [`Settings::validate`] refuses; the world keeps
    /// those it has.
    pub fn set_settings(&mut self, settings: Settings) -> Result<(), SettingsError> {
        settings.validate()?;
        let moves_nothing = settings.moves_bodies_like(&self.settings);
        let mixes = |settings: &Settings| (settings.friction_mix, settings.restitution_mix);
        let mix_changed = mixes(&settings) != mixes(&self.settings);
        if settings.tick_rate != self.settings.tick_rate {
            self.rate_since = (self.ticks, self.time());
        }
        self.settings = settings;
        if mix_changed {
            self.mix_all();
        }
        if !moves_nothing {
            let limits = self.settings.speed_limits();
            self.bodies.states.iter_mut().for_each(|state| limits.cut(state));
            self.wake_all();
        }
        Ok(())
    }

    /// The body with this id, or `None` if it has been removed.
    pub fn body(&self, id: BodyId) -> Option<BodyRef<'_>> {
        self.bodies.has(id).then(|| BodyRef::new(self, id))
    }

    /// The body with this id, for changing it, or `None` if it has been removed. Changes wake the body.
    pub fn body_mut(&mut self, id: BodyId) -> Option<BodyMut<'_>> {
        if self.bodies.has(id) { Some(BodyMut::new(self, id)) } else { None }
    }

    /// Every body, by ascending place; a removed body's place is used again.
    pub fn bodies(&self) -> impl Iterator<Item = (BodyId, BodyRef<'_>)> {
        self.bodies.ids().map(|id| (id, BodyRef::new(self, id)))
    }

    /// How many bodies there are.
    pub fn body_count(&self) -> usize {
        self.bodies.count()
    }

    /// What happened in the last [`step`](Self::step), or in all ticks of the last [`advance`](Self::advance).
    pub fn events(&self) -> &Events {
        &self.events
    }

    /// How far the last step was from perfect. Takes a look at each sleeping island.
    pub fn error(&self) -> StepError {
        StepError {
            penetration: self.residual.penetration.max(self.sleepers.penetration()),
            velocity_residual: self.residual.approach_speed,
        }
    }

    /// Takes the events out of the world, which has none then until the next step: to change the world while looking through
    /// them.
    ///
    /// ```
    /// # use rustycs::prelude::*;
    /// # let mut world = World::default();
    /// # let glass = world.add(Body::dynamic(Shape::circle(0.1)))?;
    /// for hit in world.take_events().hits() {
    ///     if hit.other(glass).is_some() && hit.speed > 3.0 {
    ///         world.remove(glass);
    ///     }
    /// }
    /// # Ok::<(), BodyError>(())
    /// ```
    pub fn take_events(&mut self) -> Events {
        self.events.take_reported()
    }

    /// What the last step did.
    pub fn profile(&self) -> &Profile {
        &self.profile
    }

    /// Hands the profile a clock to time stages with; `None` takes it away.
    pub fn set_clock(&mut self, clock: impl Into<Option<Clock>>) {
        self.profile.clock = clock.into();
    }

    /// How many steps the world has taken.
    pub fn ticks(&self) -> u64 {
        self.ticks
    }

    /// Simulated time since the world began, s: the sum of all ticks, each as long as it was.
    pub fn time(&self) -> f64 {
        let (first, began) = self.rate_since;
        began + (self.ticks - first) as f64 * self.settings.tick_seconds()
    }

    /// How many bodies are awake: those that the next step moves.
    pub fn awake_count(&self) -> usize {
        self.bodies.awake_count()
    }

    /// The islands: groups of dynamic bodies that are connected by contacts with points, or by joints. Bodies are ordered by their slot,
    /// islands by their lowest slot. Recomputed on each call.
    pub fn islands(&self) -> Vec<Vec<BodyId>> {
        let mut seen = BitSet::default();
        let mut islands = Vec::new();
        let all = Connections { contacts: &self.contacts, joints: &self.joints };
        for id in self.bodies.ids() {
            let slot = id.0.index();
            if self.bodies.is_dynamic(slot) && !seen.contains(slot) {
                let mut slots = Vec::new();
                find_island(slot, &self.bodies, all, &mut seen, &mut slots, |_, _| ());
                slots.sort_unstable();
                islands
                    .push(slots.into_iter().map(|slot| BodyId(self.bodies.records.key_at(slot))).collect());
            }
        }
        islands
    }

    /// How many islands of bodies sleep.
    pub fn sleeping_islands(&self) -> usize {
        self.sleepers.len()
    }

    /// The boxes of the broad phase's trees, m, for drawing: depth in the tree, and whether it is the fat
    /// box of one body.
    pub fn tree_boxes(&self) -> Vec<(Aabb, u32, bool)> {
        let mut boxes = Vec::new();
        self.broad_phase.for_each_node(|aabb, depth, is_leaf| boxes.push((aabb, depth, is_leaf)));
        boxes
    }

    fn field(&self) -> Field<'_> {
        Field {
            uniform: self.acceleration,
            attractors: &self.attractors,
            gravitational_constant: self.settings.gravitational_constant,
        }
    }

    fn sleep_tables(&mut self) -> (&mut Sleepers, SleepTables<'_>) {
        let Self { bodies, contacts, joints, graph, tiers, sleepers, .. } = self;
        (sleepers, SleepTables { bodies, contacts, joints, graph, tiers })
    }

    /// Refuses what a game does to a body every frame, and says so.
    #[track_caller]
    #[expect(clippy::manual_assert, reason = "the build decides, not a condition")]
    fn refuse(&mut self, body: BodyId, error: BodyError) {
        if cfg!(debug_assertions) {
            panic!("{error}");
        }
        self.events.refuse(Refusal { body, error });
    }

    fn wake_slot(&mut self, slot: u32) {
        let (sleepers, mut tables) = self.sleep_tables();
        sleepers.wake(&mut tables, slot);
    }

    fn wake_neighbours(&mut self, slot: u32) {
        let (sleepers, mut tables) = self.sleep_tables();
        sleepers.wake_neighbours(&mut tables, slot);
    }

    /// Has `Settings::threads` take part in every step, however short it and its parts are: slower, and no bit
    /// different. For tests of that.
    #[doc(hidden)]
    pub fn divide_all_work(&mut self) {
        self.pool.divide_all();
    }

    /// Has all contacts solved by the kernel that leaves out nothing, where there are others for contacts of one point, without
    /// friction, or of bodies that do not turn: slower, and no bit different. For tests of that, and to measure what it saves.
    #[doc(hidden)]
    pub fn use_general_kernels(&mut self) {
        self.fits_kernels = false;
    }

    /// Wakes every sleeping body.
    pub fn wake_all(&mut self) {
        let (sleepers, mut tables) = self.sleep_tables();
        sleepers.wake_all(&mut tables);
    }
}

#[cfg(all(test, feature = "parallel"))]
mod tests {
    use crate::prelude::*;

    /// Boxes and balls on a floor, and a paddle: few, as Miri and ThreadSanitizer look at every read and write.
    fn step_small_world(lanes: Lanes, threads: usize) -> u64 {
        let mut world = World::new(Settings { lanes, threads, ..Settings::default() });
        world.divide_all_work();
        world.add_force(Force::EARTH_GRAVITY);
        world.add(Body::fixed(Shape::aabb(20.0, 1.0)).at([0.0, -0.5])).unwrap();
        world.add(Body::kinematic(Shape::obb(3.0, 0.2)).at([0.0, 1.2]).angular_velocity(1.0)).unwrap();
        for number in 0..20_u8 {
            let shape = if number % 3 == 0 { Shape::circle(0.2) } else { Shape::obb(0.4, 0.4) };
            let place = [0.41 * f32::from(number % 10) - 2.0, 0.2 + 0.41 * f32::from(number / 10)];
            world.add(Body::dynamic(shape).at(place).velocity([0.5, 0.0])).unwrap();
        }
        (0..4).for_each(|_| world.step());
        world.state_hash()
    }

    #[test]
    fn a_small_world_steps_alike_in_lanes_and_on_threads() {
        let alone = step_small_world(Lanes::One, 1);
        for (lanes, threads) in [(Lanes::Four, 1), (Lanes::One, 3), (Lanes::Four, 3)] {
            assert_eq!(step_small_world(lanes, threads), alone, "{lanes:?}, {threads} threads");
        }
    }

    /// As much as the main thread has on Windows, which is the least. Without optimization all lanes of a kernel are on the stack: in one
    /// function sixteen took 2.8 MB.
    #[test]
    fn a_step_needs_no_more_stack_than_any_thread_has() {
        for lanes in [Lanes::One, Lanes::Four, Lanes::Eight, Lanes::Sixteen] {
            let thread = std::thread::Builder::new().stack_size(1 << 20);
            thread.spawn(move || step_small_world(lanes, 1)).unwrap().join().unwrap();
        }
    }
}
