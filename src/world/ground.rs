//! Ground made of pieces: which parts of them neighbours cover, kept up to date with every edit.
//!
//! Found at the begin of a step, of shapes with other neighbours than before: those of a fixed shape are all fixed ones, those of
//! one of several shapes of a body that moves are the others.

use crate::body::{BodyType, Role};
use crate::math::Vec2;
use crate::shape::{Exposure, Line, Neighbour};
use crate::world::World;

/// Directions of one-way floors are the same that differ by less, no unit: rounding of rotations is far less.
const SAME_WAY: f32 = 1e-3;

impl World {
    /// Has the exposures of the shapes of the body in `slot` found anew, and of the fixed ones beside them. To be called before and after a
    /// change of where it is or of what it is made of, with its boxes up to date, and before it is removed.
    pub(in crate::world) fn note_ground(&mut self, slot: u32) {
        let is_fixed = self.bodies.records[slot].body_type == BodyType::Fixed;
        if !is_fixed && !self.bodies.is_compound(slot) {
            return;
        }
        let Self { bodies, broad_phase, .. } = self;
        let colliders: Vec<u32> = bodies.colliders(slot).collect();
        for collider in colliders {
            bodies.exposures.note_stale(collider);
            if is_fixed {
                let around = broad_phase.fat_aabb(collider).grown(Exposure::FARTHEST);
                broad_phase.query(around, |other| {
                    if bodies.records[other].body_type == BodyType::Fixed {
                        bodies.exposures.note_stale(other);
                    }
                    true
                });
            }
        }
    }

    /// Finds what neighbours leave of the shapes whose neighbours have changed.
    pub(in crate::world) fn find_exposures(&mut self) {
        for slot in self.bodies.exposures.take_stale() {
            let exposure = self.exposure_of(slot).map(Box::new);
            self.bodies.exposures.set(slot, exposure);
        }
    }

    /// What neighbours leave of the shape in `slot`; `None` where it is exposed all round, or there is no such shape.
    fn exposure_of(&self, slot: u32) -> Option<Exposure> {
        let bodies = &self.bodies;
        let record = bodies.records.at(slot)?;
        let shape = &bodies.shapes[slot as usize];
        let hull = shape.hull().filter(|_| !bodies.is_compound(slot))?;
        let (is_fixed, body) = (record.body_type == BodyType::Fixed, bodies.body_of(slot));
        let may_be_covered = is_fixed || body != slot;
        let beside = if may_be_covered { self.ground_beside(slot, is_fixed) } else { Vec::new() };
        let pose = |slot: u32| {
            let pose = bodies.motions[slot as usize].pose;
            (pose.center, bodies.shapes[slot as usize].rotation_at(pose.rotation))
        };
        let (center, rotation) = pose(slot);
        let (mut neighbours, mut lines) = (Vec::new(), Vec::new());
        for other in beside {
            let (other_center, other_rotation) = pose(other);
            let of_other = &bodies.shapes[other as usize];
            let Some(hull) = of_other.hull() else { continue };
            let rotation_to = rotation.inverse() * other_rotation;
            let neighbour =
                Neighbour { hull, rotation: rotation_to, center: rotation.unrotate(other_center - center) };
            if of_other.is_segment() {
                lines.push(Line { piece: neighbour, is_link: of_other.link().is_some() });
            } else {
                neighbours.push(neighbour);
            }
        }
        if shape.is_segment() {
            Exposure::of_line(hull, shape.link(), &neighbours, &lines)
        } else {
            Exposure::new(hull, &neighbours, &lines)
        }
    }

    /// The slots of the shapes that a shape is one ground with, ascending.
    fn ground_beside(&self, slot: u32, is_fixed: bool) -> Vec<u32> {
        let bodies = &self.bodies;
        let body = bodies.body_of(slot);
        let mut beside = Vec::new();
        self.broad_phase.query(self.broad_phase.fat_aabb(slot).grown(Exposure::FARTHEST), |other| {
            let of_other = bodies.records[other].body_type;
            if if is_fixed { of_other == BodyType::Fixed } else { bodies.body_of(other) == body } {
                beside.push(other);
            }
            true
        });
        let motion = |slot: u32| &bodies.motions[slot as usize];
        beside.retain(|&other| {
            let reach = motion(slot).extent + motion(other).extent + Exposure::FARTHEST;
            other != slot
                && motion(slot).pose.center.distance(motion(other).pose.center) <= f64::from(reach) * 1.001
                && self.covers(other, slot)
        });
        beside.sort_unstable();
        beside
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
