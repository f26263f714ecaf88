//! Fixed ticks from the time of frames.
//!
//! Frames are as long as they are, ticks are of one length. What a game does once per frame must come to the same all the
//! same: events of all ticks of a frame are kept, forces given in a frame act for as long as the frame lasts
//! ([`HeldForces`](super::held_forces::HeldForces)), and a body can be drawn between its last two poses.

use crate::world::World;

/// Sixty frames of 1/60 s make sixty ticks, whatever way their sum is rounded: a tick is due from this share of it on.
const DUE_SHARE: f64 = 1.0 - 1e-9;

impl World {
    /// Takes as many ticks as fit into `frame_seconds` and what earlier calls left over; returns how many.
    ///
    /// A game calls it once per frame:
    ///
    /// ```
    /// # use rustycs::prelude::*;
    /// # let mut world = World::new(Settings::default());
    /// # let ship = world.add(Body::dynamic(Shape::circle(0.5)).mass(1.0))?;
    /// # let draw = |_: Pose| ();
    /// // Sixty frames of a second. 60 N on 1 kg give 60 m/s, at any number of frames.
    /// for _ in 0..60 {
    ///     world.body_mut(ship).unwrap().apply_force([60.0, 0.0]);
    ///     world.advance(1.0 / 60.0);
    ///     for hit in world.events().hits() {
    ///         println!("{:?} hit {:?}", hit.a, hit.b); // of all ticks of this frame
    ///     }
    ///     draw(world.body(ship).unwrap().interpolated_pose(world.alpha()));
    /// }
    /// assert!((world.body(ship).unwrap().velocity().x - 60.0).abs() < 1e-4);
    /// # Ok::<(), BodyError>(())
    /// ```
    ///
    /// - **Events** are those of all ticks of this call, tick by tick. A call without a tick leaves none.
    /// - **Forces and torques** given since the last call act for `frame_seconds` of simulated time, in as many ticks as that
    ///   takes: in three ticks of a slow frame, or as a part of one. Where no tick is due they wait for it.
    /// - **What must happen in each tick** is said by [`advance_with`](Self::advance_with), as control is, and by
    ///   [`advance_then`](Self::advance_then), as a [`Mover`](crate::Mover) is moved.
    /// - **At most [`Settings::max_ticks_per_advance`](crate::Settings::max_ticks_per_advance)** ticks are taken: time beyond
    ///   them is dropped, so that a slow frame cannot make the next one slower still.
    ///   [`dropped_seconds`](Self::dropped_seconds) tells of it.
    ///
    /// Time that is negative or not finite counts as none.
    pub fn advance(&mut self, frame_seconds: impl Into<f64>) -> u32 {
        self.advance_around(frame_seconds, |_| (), |_| ())
    }

    /// [Advances](Self::advance), and calls `before_tick` before each tick.
    ///
    /// What is done there is done once per tick at any number of frames per second, and so comes to the same, bit for bit.
    /// A force given there acts for that tick. The events are those of the ticks of this call so far.
    ///
    /// ```
    /// # use rustycs::prelude::*;
    /// # let mut world = World::new(Settings::default());
    /// # let ball = world.add(Body::dynamic(Shape::circle(0.5)).mass(1.0).at([1.0, 0.0]))?;
    /// // A spring of 20 N/m to the origin: its force depends on the place, and is wanted before each tick.
    /// let tick = world.settings().tick_seconds() as f32;
    /// let ticks = world.advance_with(0.1, |world| {
    ///     let mut ball = world.body_mut(ball).unwrap();
    ///     let force = -20.0 * ball.position();
    ///     ball.apply_impulse(force * tick);
    /// });
    /// assert_eq!(ticks, 6);
    /// # Ok::<(), BodyError>(())
    /// ```
    pub fn advance_with(&mut self, frame_seconds: impl Into<f64>, before_tick: impl FnMut(&mut Self)) -> u32 {
        self.advance_around(frame_seconds, before_tick, |_| ())
    }

    /// [Advances](Self::advance), and calls `after_tick` after each tick: for what goes by where bodies are now, as a
    /// [`Mover`](crate::Mover) on a lift does, and for what answers to the events of the tick.
    ///
    /// A force given there acts for the next tick. The [events](Self::events) there are those of all ticks of this call so far, and not of the
    /// last alone: those of the last have its number, `event.tick == world.ticks()`.
    ///
    /// ```
    /// # use rustycs::prelude::*;
    /// # let mut world = World::new(Settings::default());
    /// let lift = Body::kinematic(Shape::rectangle(2.0, 0.4)).velocity([0.0, 1.0]);
    /// let lift = world.add(lift)?;
    /// let mut hero = Mover::new(Character::new(Shape::rectangle(0.4, 0.9)).at([0.0, 0.66]))?;
    /// for _ in 0..20 {
    ///     world.advance_then(1.0 / 20.0, |world| { // three ticks
    ///         hero.move_by(world, [0.0, -0.01]);
    ///     });
    /// }
    /// let above = hero.position().y - world.body(lift).unwrap().position_f64()[1];
    /// assert!((above - 0.65).abs() < 0.01, "it stands on the lift");
    /// # Ok::<(), BodyError>(())
    /// ```
    pub fn advance_then(&mut self, frame_seconds: impl Into<f64>, after_tick: impl FnMut(&mut Self)) -> u32 {
        self.advance_around(frame_seconds, |_| (), after_tick)
    }

    fn advance_around(
        &mut self,
        frame_seconds: impl Into<f64>,
        mut before_tick: impl FnMut(&mut Self),
        mut after_tick: impl FnMut(&mut Self),
    ) -> u32 {
        let frame_seconds: f64 = frame_seconds.into();
        self.events.clear();
        self.held_forces.take(&mut self.bodies, &mut self.forced, self.unused_time);
        if frame_seconds.is_finite() && frame_seconds > 0.0 {
            self.unused_time += frame_seconds;
        }
        let mut ticks = 0;
        while self.unused_time >= self.settings.tick_seconds() * DUE_SHARE {
            if ticks == self.settings.max_ticks_per_advance {
                self.dropped_time = (self.dropped_time + self.unused_time).min(f64::MAX);
                self.unused_time = 0.0;
                break;
            }
            before_tick(self);
            // It may have changed the tick rate.
            let tick = self.settings.tick_seconds();
            self.apply_held_forces(tick);
            self.tick();
            self.unused_time = (self.unused_time - tick).max(0.0);
            ticks += 1;
            after_tick(self);
        }
        self.held_forces.end_frame(self.unused_time);
        ticks
    }

    /// Applies what forces of frames do in a tick of so many seconds.
    fn apply_held_forces(&mut self, tick: f64) {
        let mut held = std::mem::take(&mut self.held_forces);
        held.next_tick(tick, |force| {
            if self.bodies.has(force.body) {
                self.add_force_to(force);
            }
        });
        self.held_forces = held;
    }

    /// How far the time that [`advance`](Self::advance) was given has gone from the last tick to the next, 0 to 1. Draw bodies that
    /// far between their poses before and after the last tick:
    /// [`interpolated_pose(world.alpha())`](crate::BodyRef::interpolated_pose).
    pub fn alpha(&self) -> f32 {
        ((self.unused_time / self.settings.tick_seconds()) as f32).clamp(0.0, 1.0)
    }

    /// How much of the time given to [`advance`](Self::advance) was dropped so far, s, as it was more than
    /// [`Settings::max_ticks_per_advance`](crate::Settings::max_ticks_per_advance) ticks in one call.
    pub fn dropped_seconds(&self) -> f64 {
        self.dropped_time
    }
}
