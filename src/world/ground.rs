//! Ground made of pieces: which parts of them neighbours cover, kept up to date with every edit.
//!
//! Found at the begin of a step, of shapes with other neighbours than before: those of a fixed or kinematic shape are all fixed and
//! kinematic ones, those of one of several shapes of a dynamic body are the others.

use crate::body::{BodyType, Exposures, Role};
use crate::math::{Pose, Rot, Vec2};
use crate::shape::{Exposure, Neighbour, Place};
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
        // Noted for the next step: what is beside them now will have lost them by then.
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
                state.velocity.to_vec2() != Vec2::ZERO
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
        let extent = |slot: u32| bodies.motions[slot as usize].extent;
        let poses = self.poses_over_step(slot);
        self.broad_phase.query(self.broad_phase.fat_aabb(slot).grown(Exposure::FARTHEST), |other| {
            let is_one_ground =
                if is_ground { bodies.is_ground(other) } else { bodies.body_of(other) == body };
            let reach = f64::from(extent(slot) + extent(other) + Exposure::FARTHEST);
            let center = bodies.motions[other as usize].pose.center;
            // The sum is rounded, and so is the distance.
            let is_near = poses[0].center.distance(center) <= reach * 1.001;
            if other != slot && is_one_ground && is_near && self.covers(other, slot) {
                let shape = &bodies.shapes[other as usize];
                let of_other = self.poses_over_step(other);
                let place = |time: usize| Place {
                    rotation: poses[time].rotation.inverse() * of_other[time].rotation,
                    center: poses[time].rotation.unrotate(of_other[time].center - poses[time].center),
                };
                let begin = place(0);
                let places = [begin, if bodies.body_of(other) == body { begin } else { place(1) }];
                let is_link = shape.link().is_some();
                neighbours.extend(shape.hull().map(|&hull| Neighbour { slot: other, hull, is_link, places }));
            }
            true
        });
        neighbours.sort_unstable_by_key(|neighbour| neighbour.slot);
    }

    /// The poses of a shape as the step begins, and as it ends if nothing acts on its body.
    fn poses_over_step(&self, slot: u32) -> [Pose; 2] {
        let (bodies, dt) = (&self.bodies, self.settings.tick_seconds() as f32);
        let (pose, state) = (bodies.motions[slot as usize].pose, bodies.state(slot));
        let (turn, arm) = (Rot::from_angle(state.angular_velocity * dt), bodies.arm(slot));
        let moved = state.velocity.to_vec2() * dt + (turn.rotate(arm) - arm);
        let at_end = Pose { center: pose.center + moved, rotation: turn * pose.rotation };
        let shape = &bodies.shapes[slot as usize];
        [pose, at_end].map(|pose| Pose { rotation: shape.rotation_at(pose.rotation), ..pose })
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
