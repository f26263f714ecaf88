//! A character that a game moves by hand: it slides along walls, walks slopes, climbs steps, rides platforms.
//!
//! Outside of the step. A [`Mover`] is no body: it asks the world what is on its way by [shape casts](World::shape_cast), keeps a
//! small gap to all of it, and changes nothing but what it pushes. A move takes a few casts and allocates nothing.
//!
//! 1. Where the ground has gone since the last move, the character goes too.
//! 2. The character is pushed out of what overlaps it; between two such things without room it is crushed.
//! 3. It goes along its way, and turns along each surface that it meets; see `trip`.
//! 4. On the ground it is set down to it again, so that it does not hop down slopes and steps.

mod description;
mod surroundings;
mod trip;

pub use description::Character;

use crate::body::{BodyError, BodyId};
use crate::math::{Point, Pose, Vec2};
use crate::world::character::trip::Trip;
use crate::world::{ShapeHit, World};

/// A [`Character`] at a place in a world, which is moved by hand.
///
/// ```
/// use rustycs::prelude::*;
///
/// let mut world = World::new(Settings::default());
/// world.add(Body::fixed(Shape::rectangle(20.0, 1.0)).at([0.0, -0.5]))?;
/// world.add(Body::fixed(Shape::rectangle(4.0, 0.2)).at([5.0, 0.1]))?; // a step of 0.2 m
/// let mut player = Mover::new(Character::new(Shape::rectangle(0.6, 1.8)).at([0.0, 1.0]).step_height(0.3))?;
/// let (mut fall, dt) = (0.0, 1.0 / 60.0);
/// for _ in 0..120 {
///     world.step();
///     let moved = player.move_by(&mut world, [3.0 * dt, fall * dt]); // to the right at 3 m/s
///     fall = if moved.is_grounded() { 0.0 } else { fall - 9.81 * dt };
/// }
/// assert!(player.is_grounded() && (player.position().y - 1.1).abs() < 0.01, "it stands on the step");
/// # Ok::<(), BodyError>(())
/// ```
///
/// Call [`move_by`](Self::move_by) once per tick, after the step, as [`World::advance_then`] does: so the character is where the
/// platforms are that carry it, and moves alike at any number of frames per second. Draw it at its
/// [`interpolated_pose`](Self::interpolated_pose).
///
/// The world does not see it. Where others are to meet it, add a kinematic body of the same shape, have the character
/// [ignore](Character::ignore) it, and [move](crate::BodyMut::move_to) it to the [pose](Self::pose) after each move.
#[derive(Clone, Debug)]
pub struct Mover {
    character: Character,
    position: Point,
    footing: Option<Footing>,
    passes_one_way: bool,
    /// The tick of the last move, and where the character was before that tick.
    tick: u64,
    previous: Point,
}

/// What a character stands on, and where on it.
#[derive(Clone, Copy, Debug)]
struct Footing {
    hit: ShapeHit,
    /// The place, m, in the frame of the shape.
    local: Vec2,
    /// Where the shape was.
    pose: Pose,
}

impl Footing {
    fn new(world: &World, hit: ShapeHit) -> Option<Self> {
        let pose = world.collider(hit.collider)?.pose();
        Some(Self { hit, local: pose.to_local(hit.point), pose })
    }

    /// How far the place has gone since, m. Rounding is the same of both, and what has not moved has gone nowhere.
    fn carried(&self, world: &World) -> Vec2 {
        let now = world.collider(self.hit.collider).map(|collider| collider.pose().to_world(self.local));
        now.map_or(Vec2::ZERO, |now| now - self.pose.to_world(self.local))
    }
}

/// What came of a move.
///
/// ```
/// use rustycs::prelude::*;
///
/// let mut world = World::new(Settings::default());
/// world.add(Body::fixed(Shape::rectangle(20.0, 1.0)).at([0.0, -0.5]))?;
/// let wall = world.add(Body::fixed(Shape::rectangle(1.0, 4.0)).at([2.0, 2.0]))?;
/// let mut hero = Mover::new(Character::new(Shape::rectangle(0.6, 1.8)).at([0.0, 0.92]))?;
/// world.step();
/// let moved: Moved = hero.move_by(&mut world, [3.0, -0.1]); // m
/// assert!(moved.is_grounded());
/// assert!(hero.position().x < 1.2, "the wall {wall:?} stops it");
/// # Ok::<(), BodyError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Moved {
    /// From where it was to where it is, m, with where it was carried.
    pub translation: Vec2,
    /// What it stands on. Between two slopes that are too steep and face each other it stands as on the level, with the direction up
    /// for a normal.
    pub ground: Option<ShapeHit>,
    /// What stopped it on its way, if that was too steep to walk.
    pub wall: Option<ShapeHit>,
    /// What stopped it from above.
    pub ceiling: Option<ShapeHit>,
    /// The body that it still overlaps, as there is no room beside it. The character is not moved by it then, does not fall, and can
    /// walk out of it, on the nearer side, which may be the far one; what becomes of it is for the game to say.
    pub crushed_by: Option<BodyId>,
}

impl Moved {
    /// Whether it stands on something that is not too steep.
    pub fn is_grounded(&self) -> bool {
        self.ground.is_some()
    }
}

impl Mover {
    /// A character where its description puts it.
    ///
    /// # Errors
    /// [`BodyError`], if its shape or a number of it is NaN, infinite or out of range.
    pub fn new(character: Character) -> Result<Self, BodyError> {
        character.validate()?;
        let position = character.at;
        Ok(Self { character, position, footing: None, passes_one_way: false, tick: 0, previous: position })
    }

    /// Where its centre is, m.
    pub fn position(&self) -> Point {
        self.position
    }

    /// Where it is. It is never turned.
    pub fn pose(&self) -> Pose {
        Pose::at(self.position)
    }

    /// Where to draw it between two ticks: between where it was before the last tick, at an [`alpha`](World::alpha) of the world of 0,
    /// and where it is now, at 1. What was [put elsewhere](Self::set_position), or not moved in the last tick, is drawn where it is.
    pub fn interpolated_pose(&self, world: &World) -> Pose {
        let is_on_its_way = world.ticks() == self.tick;
        let share = if is_on_its_way { world.alpha() } else { 1.0 };
        Pose::at(self.previous.lerp(self.position, share))
    }

    /// Its description, with the place where it began.
    pub fn character(&self) -> &Character {
        &self.character
    }

    /// Whether it stood on something that is not too steep after the last move.
    pub fn is_grounded(&self) -> bool {
        self.footing.is_some()
    }

    /// Velocity of what it stands on, there, m/s, that of a surface which moves included: what a jump begins with. 0 in the air.
    pub fn ground_velocity(&self, world: &World) -> Vec2 {
        let Some((hit, body)) = self.footing.and_then(|on| Some((on.hit, world.body(on.hit.body)?))) else {
            return Vec2::ZERO;
        };
        body.velocity_at(hit.point) + belt_velocity(world, hit)
    }

    /// Puts it elsewhere, m, into the air.
    ///
    /// # Errors
    /// [`BodyError`], if the place is not finite or farther than 10¹² m.
    pub fn set_position(&mut self, position: impl Into<Point>) -> Result<(), BodyError> {
        let position = position.into();
        crate::body::limits::check_place(position)?;
        (self.position, self.previous, self.footing) = (position, position, None);
        Ok(())
    }

    /// Whether it passes [one-way floors](crate::Body::one_way) also from above, as while a key is held to drop through them.
    pub fn set_passes_one_way(&mut self, passes: bool) {
        self.passes_one_way = passes;
    }

    /// Moves it along a way, m, as far as the world lets it: what it wants to walk in this tick, and what it falls or jumps.
    ///
    /// - On the ground, what is across [up](Character::up) is walked: along slopes, as fast as on the flat; up
    ///   [steps](Character::step_height); and down slopes and steps without a hop, as far as it [snaps](Character::snap).
    /// - A way upward is a jump, and leaves the ground.
    /// - In the air it slides along what it meets, and stands where that is not too steep. On what is too steep it slides down,
    ///   and does not climb.
    /// - What it stands on carries it: lifts, platforms that move and turn, belts.
    /// - Dynamic bodies that are in its way are [pushed](Character::push_force) with a limited force.
    ///
    /// A way that is not finite moves it nowhere; a debug build panics then at the line of the call.
    #[track_caller]
    pub fn move_by(&mut self, world: &mut World, translation: impl Into<Vec2>) -> Moved {
        let mut translation = translation.into();
        if !translation.is_finite() {
            debug_assert!(
                translation.is_finite(),
                "the way of a character is {translation}; give finite numbers"
            );
            translation = Vec2::ZERO;
        }
        let mut trip = Trip::new(world, &self.character, self.position, self.passes_one_way);
        let stood = self.footing.filter(|on| world.collider(on.hit.collider).is_some());
        if let Some(on) = stood {
            let ticks = world.ticks().saturating_sub(self.tick);
            let seconds = (ticks as f64 * world.settings().tick_seconds()) as f32;
            let belt = belt_velocity(world, on.hit) * seconds;
            trip.carry(on.hit, on.carried(world) + belt);
        }
        let crushed_by = trip.get_out();
        // What is crushed does not fall through what it stands on.
        let up = self.character.up;
        let fall = if crushed_by.is_some() { translation.dot(up).min(0.0) } else { 0.0 };
        trip.go(translation - up * fall);
        let Trip { at, ground, wall, ceiling, .. } = trip;
        let way = at - self.position;
        // Several moves in a tick are drawn as one.
        if world.ticks() != self.tick {
            self.previous = self.position;
        }
        (self.position, self.tick) = (at, world.ticks());
        self.footing = ground.and_then(|hit| Footing::new(world, hit));
        let also_ceiling = ceiling.filter(|above| wall.is_none_or(|beside| beside.body != above.body));
        for hit in [wall, also_ceiling].into_iter().flatten() {
            self.push(world, hit, translation);
        }
        Moved { translation: way, ground, wall, ceiling, crushed_by }
    }

    /// Pushes a dynamic body that is in the way, so that at the end of the tick it is as fast there as the character would be: with
    /// the force F that it takes, if that is not more than the character has.
    ///
    /// ```text
    /// F dt = (v - u) m,   1/m = 1/M + (r × d)²/I
    /// ```
    /// along d, with the speeds v that is wanted and u of the body there, its mass M and its moment of inertia I. A force, and no
    /// impulse: what friction holds does not move.
    fn push(&self, world: &mut World, hit: ShapeHit, translation: Vec2) {
        let tick = world.settings().tick_seconds() as f32;
        let Some(body) = world.body(hit.body).filter(|body| body.mass().is_finite()) else { return };
        let direction = -hit.normal;
        let missing = translation.dot(direction) / tick - body.velocity_at(hit.point).dot(direction);
        let arm = (hit.point - body.pose().center).cross(direction);
        let inverse_mass = 1.0 / body.mass() + arm * arm / body.inertia();
        let force = (missing / (inverse_mass * tick)).min(self.character.push_force);
        if force > 0.0
            && let Some(mut body) = world.body_mut(hit.body)
        {
            body.apply_force_at(direction * force, hit.point);
        }
    }
}

/// Velocity of a surface against its body, m/s: positive speeds take what lies on top to the right.
fn belt_velocity(world: &World, hit: ShapeHit) -> Vec2 {
    let speed =
        world.collider(hit.collider).map_or(0.0, |collider: crate::ColliderRef<'_>| collider.surface_speed());
    -hit.normal.perp() * speed
}
