//! Ground made of pieces: which parts of them neighbours cover, kept up to date with every edit.
//!
//! Found at the begin of a step, of shapes with other neighbours than before: those of a fixed or kinematic shape are all fixed and
//! kinematic ones, those of one of several shapes of a dynamic body are the others.

use crate::body::{BodyType, Exposures, Role};
use crate::math::Vec2;
use crate::shape::{Exposure, Neighbour};
use crate::world::World;

/// Directions of one-way floors are the same that differ by less, no unit: rounding of rotations is far less.
const SAME_WAY: f32 = 1e-3;

impl World {
    /// Has the exposures of the shapes of the body in `slot` found anew, and of the ground beside them. To be called before and after a
    /// change of where it is or of what it is made of, with its boxes up to date, and before it is removed.
    pub(in crate::world) fn note_ground(&mut self, slot: u32) {
        let (is_ground, body_type) = (self.bodies.is_ground(slot), self.bodies.records[slot].body_type);
        if !is_ground && !self.bodies.is_compound(slot) {
            return;
        }
        let mut exposures = std::mem::take(&mut self.bodies.exposures);
        if body_type == BodyType::Kinematic {
            exposures.note_kinematic(slot);
        }
        for collider in self.bodies.colliders(slot) {
            exposures.note_stale(collider);
            if is_ground {
                self.note_beside(collider, &mut exposures);
            }
        }
        self.bodies.exposures = exposures;
    }

    /// Has the exposures of the ground beside a shape found anew, but for the others of its body. Returns whether there is any.
    fn note_beside(&self, collider: u32, exposures: &mut Exposures) -> bool {
        let Self { bodies, broad_phase, .. } = self;
        let body = bodies.body_of(collider);
        let mut has_any = false;
        broad_phase.query(broad_phase.fat_aabb(collider).grown(Exposure::FARTHEST), |other| {
            if bodies.is_ground(other) && bodies.body_of(other) != body {
                exposures.note_stale(other);
                has_any = true;
            }
            true
        });
        has_any
    }

    /// Finds what neighbours leave of the shapes whose neighbours have changed.
    pub(in crate::world) fn find_exposures(&mut self) {
        let mut exposures = std::mem::take(&mut self.bodies.exposures);
        self.note_moving_ground(&mut exposures);
        exposures.find_stale(|slot, neighbours| self.exposure_of(slot, neighbours));
        // In the next step they are no longer there.
        self.note_moving_ground(&mut exposures);
        self.bodies.exposures = exposures;
    }

    /// Has the exposures of kinematic bodies that move, or did in the last step, found anew where there is other ground, and those of that.
    fn note_moving_ground(&self, exposures: &mut Exposures) {
        let moves = |slot: u32| {
            let is_kinematic =
                self.bodies.records.at(slot).is_some_and(|record| record.body_type == BodyType::Kinematic);
            is_kinematic && {
                let (state, motion) = (self.bodies.state(slot), &self.bodies.motions[slot as usize]);
                Vec2::from(state.velocity) != Vec2::ZERO
                    || state.angular_velocity != 0.0
                    || self.bodies.previous_pose(slot) != motion.pose
            }
        };
        for place in 0..exposures.kinematic().len() {
            let slot = exposures.kinematic()[place];
            if moves(slot) {
                for collider in self.bodies.colliders(slot) {
                    if self.note_beside(collider, exposures) {
                        exposures.note_stale(collider);
                    }
                }
            }
        }
    }

    /// What neighbours leave of the shape in `slot`; `None` where it is exposed all round, or there is no such shape. `neighbours` is room for
    /// these.
    fn exposure_of(&self, slot: u32, neighbours: &mut Vec<Neighbour>) -> Option<Exposure> {
        let bodies = &self.bodies;
        bodies.records.at(slot)?;
        let shape = &bodies.shapes[slot as usize];
        let hull = shape.hull().filter(|_| !bodies.is_compound(slot))?;
        if bodies.is_ground(slot) || bodies.body_of(slot) != slot {
            self.find_ground_beside(slot, neighbours);
        }
        if neighbours.is_empty() && shape.link().is_none() {
            return None;
        }
        Exposure::new(hull, shape.link(), neighbours)
    }

    /// Finds the shapes that a shape is one ground with, in the order of their slots.
    fn find_ground_beside(&self, slot: u32, neighbours: &mut Vec<Neighbour>) {
        let bodies = &self.bodies;
        let (is_ground, body) = (bodies.is_ground(slot), bodies.body_of(slot));
        let pose = |slot: u32| {
            let pose = bodies.motions[slot as usize].pose;
            (pose.center, bodies.shapes[slot as usize].rotation_at(pose.rotation))
        };
        let (center, rotation) = pose(slot);
        let extent = |slot: u32| bodies.motions[slot as usize].extent;
        self.broad_phase.query(self.broad_phase.fat_aabb(slot).grown(Exposure::FARTHEST), |other| {
            let is_one_ground =
                if is_ground { bodies.is_ground(other) } else { bodies.body_of(other) == body };
            let (other_center, other_rotation) = pose(other);
            let reach = f64::from(extent(slot) + extent(other) + Exposure::FARTHEST);
            // The sum is rounded, and so is the distance.
            let is_near = center.distance(other_center) <= reach * 1.001;
            if other != slot
                && is_one_ground
                && is_near
                && self.covers(other, slot)
                && self.move_alike(other, slot)
            {
                let shape = &bodies.shapes[other as usize];
                neighbours.extend(shape.hull().map(|&hull| Neighbour {
                    slot: other,
                    hull,
                    rotation: rotation.inverse() * other_rotation,
                    center: rotation.unrotate(other_center - center),
                    is_link: shape.link().is_some(),
                }));
            }
            true
        });
        neighbours.sort_unstable_by_key(|neighbour| neighbour.slot);
    }

    /// Whether two pieces of ground stay beside each other for a step: a paddle that brushes a wall leaves it open to what flies there.
    fn move_alike(&self, one: u32, other: u32) -> bool {
        let bodies = &self.bodies;
        if bodies.body_of(one) == bodies.body_of(other) {
            return true;
        }
        let [a, b] = [one, other].map(|slot| bodies.state(slot));
        let apart = bodies.motions[other as usize].pose.center - bodies.motions[one as usize].pose.center;
        let turning = b.angular_velocity - a.angular_velocity;
        // At the centre of the other.
        let sliding = bodies.velocity_of_shape(other)
            - (bodies.velocity_of_shape(one) + apart.perp() * a.angular_velocity);
        let speed = sliding.length() + turning.abs() * bodies.motions[other as usize].extent;
        speed * self.settings.tick_seconds() as f32 <= Exposure::FARTHEST
    }

    /// Whether one piece of ground may cover another: only if all that meets the other meets it too, of which equal filters are a sign. Bodies
    /// that are parted from some are another matter, see `Bodies::exposures_of`.
    fn covers(&self, piece: u32, covered: u32) -> bool {
        let bodies = &self.bodies;
        let [of_piece, of_covered] = [piece, covered].map(|slot| bodies.roles.of(slot));
        if of_piece.filter != of_covered.filter || of_piece.is_sensor {
            return false;
        }
        let is_link = |slot: u32| bodies.shapes[slot as usize].link().is_some();
        // What passes a link from behind may meet the other; along its front it is ground as any.
        if is_link(piece) || is_link(covered) {
            let is_one_way_floor = |slot: u32, role: Role| role.one_way.is_some() && !is_link(slot);
            return !is_one_way_floor(piece, of_piece) && !is_one_way_floor(covered, of_covered);
        }
        let direction = |slot: u32, role: Role| {
            role.one_way.map_or(Vec2::ZERO, |up| bodies.motions[slot as usize].pose.rotation.rotate(up))
        };
        direction(piece, of_piece).distance(direction(covered, of_covered)) < SAME_WAY
    }
}
