//! Ground made of pieces: which parts of them neighbours cover, kept up to date with every edit.
//!
//! Runs at the begin of a step, on shapes with other neighbours than before: those of a fixed shape are all fixed ones, those of
//! one of several shapes of a body that moves are the others.

use crate::body::BodyType;
use crate::math::Vec2;
use crate::shape::{Exposure, Neighbour};
use crate::world::World;

/// Directions of one-way floors are the same that differ by less, no unit: rounding of rotations is far less.
const SAME_WAY: f32 = 1e-3;

impl World {
    /// Takes note that the body in `slot` is where it is now, or will cease to be: what lies beside it may be covered by it.
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

    /// What neighbours leave of the shape in `slot`; `None` where that is all, or there is no such shape.
    fn exposure_of(&self, slot: u32) -> Option<Exposure> {
        let bodies = &self.bodies;
        let record = bodies.records.at(slot)?;
        let hull = bodies.shapes[slot as usize].hull().filter(|_| !bodies.is_compound(slot))?;
        if bodies.shapes[slot as usize].is_segment() {
            return bodies.shapes[slot as usize].link().map(|link| Exposure::of_link(hull, link));
        }
        let (is_fixed, body) = (record.body_type == BodyType::Fixed, bodies.body_of(slot));
        if !is_fixed && body == slot {
            return None;
        }
        let mut beside = Vec::new();
        self.broad_phase.query(self.broad_phase.fat_aabb(slot).grown(Exposure::FARTHEST), |other| {
            let of_other = bodies.records[other].body_type;
            if if is_fixed { of_other == BodyType::Fixed } else { bodies.body_of(other) == body } {
                beside.push(other);
            }
            true
        });
        // Only what is met by all that this one is met by covers it. Bodies that are parted from some are another matter, see
        // `Bodies::exposures_of`.
        let role = bodies.roles.of(slot);
        let direction = |slot: u32| {
            let of = bodies.roles.of(slot);
            of.one_way.map_or(Vec2::ZERO, |up| bodies.motions[slot as usize].pose.rotation.rotate(up))
        };
        let motion = |slot: u32| &bodies.motions[slot as usize];
        beside.retain(|&other| {
            let reach = motion(slot).extent + motion(other).extent + Exposure::FARTHEST;
            if motion(slot).pose.center.distance(motion(other).pose.center) > f64::from(reach) * 1.001 {
                return false;
            }
            let of_other = bodies.roles.of(other);
            let is_alike = of_other.filter == role.filter && !of_other.is_sensor;
            other != slot && is_alike && direction(other).distance(direction(slot)) < SAME_WAY
        });
        beside.sort_unstable();
        let pose = |slot: u32| {
            let pose = bodies.motions[slot as usize].pose;
            (pose.center, bodies.shapes[slot as usize].rotation_at(pose.rotation))
        };
        let (center, rotation) = pose(slot);
        let neighbours: Vec<Neighbour<'_>> = beside
            .into_iter()
            .filter_map(|other| {
                let (other_center, other_rotation) = pose(other);
                // What has no thickness covers nothing.
                let shape = Some(&bodies.shapes[other as usize]).filter(|shape| !shape.is_segment())?;
                Some(Neighbour {
                    hull: shape.hull()?,
                    rotation: rotation.inverse() * other_rotation,
                    center: rotation.unrotate(other_center - center),
                })
            })
            .collect();
        Exposure::new(hull, &neighbours)
    }
}
