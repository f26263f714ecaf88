//! Forces that are given once per frame, and act for as long as the frame lasts.
//!
//! A frame has no tick, one or several. A force F given in a frame of length t is to give the impulse F t in all, when that
//! time is simulated. So each body has the force of this frame, and the impulse of earlier frames that no tick has used
//! yet. A tick of length T takes time u of earlier frames first, with its part of that impulse, and the rest from this one:
//!
//! ```text
//! force in the tick = (impulse of u + F (T - u)) / T
//! ```
//!
//! It is summed in `f64`, so that the same force in all frames is that force, to the last bit of `f32`, in all ticks.
//! A world that is stepped by hand, or in which no body is pushed, has none of this.

use crate::body::{Bodies, BodyId};
use crate::math::Vec2;
use crate::world::World;

/// Forces (N) and torques (N m) of one tick add up to at most this: over the smallest mass it stays in `f32`.
const STRONGEST_SUM: f32 = 1e20;

/// A force on a body in the next tick.
#[derive(Clone, Copy, Debug)]
pub(in crate::world) struct TickForce {
    pub(in crate::world) body: BodyId,
    /// N.
    pub(in crate::world) force: Vec2,
    /// N m.
    pub(in crate::world) torque: f32,
    /// Whether it wakes the body; otherwise it does nothing to one that sleeps.
    pub(in crate::world) wakes: bool,
}

/// A body that was given a force since the last tick, and whether one was given that wakes.
#[derive(Clone, Copy, Debug)]
pub(in crate::world) struct Forced {
    pub(in crate::world) body: BodyId,
    pub(in crate::world) wakes: bool,
}

/// What was given to one body. Arrays are along x, along y, and turning.
#[derive(Clone, Copy, Debug)]
struct HeldForce {
    body: BodyId,
    wakes: bool,
    /// While this frame lasts: N, N, N m.
    force: [f64; 3],
    /// Of earlier frames: N s, N s, N m s.
    impulse: [f64; 3],
}

/// What was given to bodies in this frame and is left of earlier ones.
#[derive(Debug, Default)]
pub(in crate::world) struct HeldForces {
    /// By ascending id.
    all: Vec<HeldForce>,
    /// The time that the impulses are of, s.
    earlier_time: f64,
}

clone_into_buffers!(HeldForces { all, earlier_time });

impl HeldForces {
    /// Begins a frame: takes the forces that were given since the last tick from the bodies. So many seconds of earlier
    /// frames have not been simulated.
    pub(in crate::world) fn take(&mut self, bodies: &mut Bodies, forced: &mut Vec<Forced>, earlier: f64) {
        self.earlier_time = earlier;
        for Forced { body, wakes } in forced.drain(..) {
            if !bodies.has(body) {
                continue;
            }
            // The second time that a body is met there is nothing left to take.
            let forcing = &mut bodies.forcings[body.0.index() as usize];
            let force = [forcing.force.x, forcing.force.y, forcing.torque].map(f64::from);
            forcing.end_step();
            self.all.push(HeldForce { body, wakes, force, impulse: [0.0; 3] });
        }
        self.all.sort_unstable_by_key(|held| held.body);
        self.all.dedup_by(|again, held| {
            let is_same = again.body == held.body;
            if is_same {
                held.wakes |= again.wakes;
                for axis in 0..3 {
                    held.force[axis] += again.force[axis];
                    held.impulse[axis] += again.impulse[axis];
                }
            }
            is_same
        });
    }

    /// Calls `apply` with the force on each body in the next tick, which is `tick` seconds long.
    pub(in crate::world) fn next_tick(&mut self, tick: f64, mut apply: impl FnMut(TickForce)) {
        let earlier = self.earlier_time.min(tick);
        let share = if earlier < self.earlier_time { earlier / self.earlier_time } else { 1.0 };
        for held in &mut self.all {
            let used = held.impulse.map(|impulse| impulse * share);
            let [x, y, torque] =
                [0, 1, 2].map(|axis| ((used[axis] + held.force[axis] * (tick - earlier)) / tick) as f32);
            held.impulse = [0, 1, 2].map(|axis| held.impulse[axis] - used[axis]);
            apply(TickForce { body: held.body, force: Vec2::new(x, y), torque, wakes: held.wakes });
        }
        self.earlier_time -= earlier;
    }

    /// Ends a frame, of which and of earlier ones so many seconds are left to be simulated.
    pub(in crate::world) fn end_frame(&mut self, unused: f64) {
        let of_this_frame = (unused - self.earlier_time).max(0.0);
        self.all.retain_mut(|held| {
            for axis in 0..3 {
                held.impulse[axis] += held.force[axis] * of_this_frame;
            }
            held.force = [0.0; 3];
            unused > 0.0 && held.impulse != [0.0; 3]
        });
    }
}

impl World {
    /// Has a force act in the next tick, on a body that is there. Returns whether it does: it must not be 0, and the body
    /// dynamic, and awake if the force does not wake it.
    pub(in crate::world) fn add_force_to(
        &mut self,
        TickForce { body, force, torque, wakes }: TickForce,
    ) -> bool {
        let slot = body.0.index();
        let is_none = force == Vec2::ZERO && torque == 0.0;
        if is_none || !self.bodies.is_dynamic(slot) || !(wakes || self.bodies.is_awake(slot)) {
            return false;
        }
        if wakes {
            self.wake_slot(slot);
        }
        let forcing = &mut self.bodies.forcings[slot as usize];
        let cut = |value: f32| value.clamp(-STRONGEST_SUM, STRONGEST_SUM);
        let sum = forcing.force + force;
        forcing.force = Vec2::new(cut(sum.x), cut(sum.y));
        forcing.torque = cut(forcing.torque + torque);
        true
    }
}
