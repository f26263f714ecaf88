//! Sensors: what overlaps them, told as it begins and ends.
//!
//! What a sensor overlaps is a matter of where bodies are, at the end of each step, and of nothing else: it is asked anew
//! of the trees, and compared with what it was. So nothing is lost, whether something moved, was put somewhere, removed, made
//! into something else, or sleeps. Beside that, a body that moved by half its width or more is swept along the straight line
//! from where it was, and has begun and ended where it went through a sensor.
//!
//! Cost: nothing where there are no sensors, or neither an awake body nor an edit; else a question to the trees per sensor, a
//! narrow phase per body whose box meets it, and a comparison per awake body.

use crate::body::{BodyId, ColliderId};
use crate::collision::{Swept, time_of_impact};
use crate::compute::GROUND_ROW;
use crate::math::{Pose, Vec2};
use crate::world::World;
use crate::world::events::{Events, SensorEvent};

/// A body is swept that moves by more than this share of its width in a step, no unit: by less, and it has not gone past
/// anything in its way that is not thinner than the rest of it.
const SWEPT_FROM: f32 = 0.5;

/// The body of a sensor, the shape that is the sensor, and a body that it overlaps.
type Overlap = (BodyId, ColliderId, BodyId);

/// What sensors overlap.
#[derive(Debug, Default)]
pub(in crate::world) struct Sensors {
    /// As of the end of the last step, sorted.
    overlaps: Vec<Overlap>,
    /// Whether an edit since then may have changed them.
    are_stale: bool,
    /// Scratch: as of now.
    found: Vec<Overlap>,
    /// Scratch: what went through within the step.
    passed: Vec<Overlap>,
}

clone_into_buffers!(Sensors { overlaps, are_stale } scratch { found, passed });

impl Sensors {
    /// Takes note of an edit that may change what overlaps.
    pub(in crate::world) fn note_edit(&mut self) {
        self.are_stale = true;
    }

    /// What overlaps as of the end of the last step.
    pub(in crate::world) fn overlaps(&self) -> &[Overlap] {
        &self.overlaps
    }

    /// Gives up scratch.
    pub(in crate::world) fn trim(&mut self) {
        (self.found, self.passed) = (Vec::new(), Vec::new());
    }

    /// Reports what of the overlaps found now, in this tick, is new, and what is gone; goes on with those of now.
    fn report(&mut self, tick: u64, events: &mut Events) {
        let (before, now) = (&self.overlaps, &self.found);
        let event = |&(sensor, collider, body): &Overlap| SensorEvent { sensor, collider, body, tick };
        let is_new = |overlap: &&Overlap| before.binary_search(overlap).is_err();
        let is_gone = |overlap: &&Overlap| now.binary_search(overlap).is_err();
        events.sensor_began.extend(now.iter().filter(is_new).map(event));
        events.sensor_ended.extend(before.iter().filter(is_gone).map(event));
        self.passed.sort_unstable();
        self.passed.dedup();
        let passed = || self.passed.iter().filter(is_new).filter(is_gone).map(event);
        events.sensor_began.extend(passed());
        events.sensor_ended.extend(passed());
        std::mem::swap(&mut self.overlaps, &mut self.found);
        self.are_stale = false;
    }
}

impl World {
    /// What a sensor overlapped at the end of the last step, by ascending id; nothing for a body that is no sensor, or was
    /// removed. Bodies that were removed since are left out.
    ///
    /// ```
    /// # use rustycs::prelude::*;
    /// # let mut world = World::new(Settings::default());
    /// let zone = world.add(Body::fixed(Shape::aabb(4.0, 4.0)).sensor(true))?;
    /// let player = world.add(Body::dynamic(Shape::circle(0.5)).at([1.0, 1.0]))?;
    /// world.step();
    /// assert_eq!(world.events().sensor_began()[0].body, player);
    /// assert!(world.sensor_overlaps(zone).eq([player]));
    /// # Ok::<(), BodyError>(())
    /// ```
    pub fn sensor_overlaps(&self, sensor: BodyId) -> impl Iterator<Item = BodyId> {
        let overlaps = self.sensors.overlaps();
        let first = overlaps.partition_point(|&(of, ..)| of < sensor);
        let of_sensor = &overlaps[first..];
        let of_sensor = &of_sensor[..of_sensor.partition_point(|&(of, ..)| of == sensor)];
        // What several shapes of the sensor overlap is told once.
        let is_told = move |&(_, shape, body): &Overlap| {
            of_sensor.iter().take_while(|&&(_, other, _)| other < shape).any(|&(.., other)| other == body)
        };
        let once = of_sensor.iter().filter(move |&overlap| !is_told(overlap));
        once.map(|&(.., body)| body).filter(|&body| self.bodies.has(body))
    }

    /// How much there is to do about sensors: nothing if nothing has moved.
    pub(in crate::world) fn sensor_work(&self) -> usize {
        let may_have_changed = self.sensors.are_stale || self.bodies.awake_count() > 0;
        let sensors = self.bodies.roles.sensors().len().max(usize::from(!self.sensors.overlaps.is_empty()));
        if may_have_changed { sensors } else { 0 }
    }

    /// Finds what sensors overlap now, and reports what has changed.
    pub(in crate::world) fn find_sensor_overlaps(&mut self) {
        let mut sensors = std::mem::take(&mut self.sensors);
        let mut found = std::mem::take(&mut sensors.found);
        let mut passed = std::mem::take(&mut sensors.passed);
        found.clear();
        passed.clear();
        for &slot in self.bodies.roles.sensors() {
            self.find_overlaps_of(slot, &mut found);
        }
        found.sort_unstable();
        found.dedup();
        if !self.bodies.roles.sensors().is_empty() {
            self.find_passed(&mut passed);
        }
        (sensors.found, sensors.passed) = (found, passed);
        sensors.report(self.next_tick(), &mut self.events);
        self.sensors = sensors;
    }

    /// Appends what the sensor in `slot` overlaps.
    fn find_overlaps_of(&self, slot: u32, found: &mut Vec<Overlap>) {
        let (shape, pose) = (&self.bodies.shapes[slot as usize], self.bodies.motions[slot as usize].pose);
        self.broad_phase.query(self.bodies.aabb(slot), |other| {
            let pair = [slot, other];
            let meets = self.bodies.roles.may_meet(pair, self.bodies.bodies_of(pair));
            if meets && self.overlaps_body(shape, pose, other) {
                found.push((self.id_of(slot), self.collider_id(slot), self.id_of(other)));
            }
            true
        });
    }

    /// Appends sensors and bodies of which one has gone through the other in this step, and some that overlap now or did.
    fn find_passed(&self, passed: &mut Vec<Overlap>) {
        let (bodies, roles) = (&self.bodies, &self.bodies.roles);
        let rows = GROUND_ROW as usize + 1..bodies.row_count();
        for slot in rows.flat_map(|row| bodies.colliders(bodies.slot_of_row(row))) {
            let (motion, previous) = (&bodies.motions[slot as usize], bodies.previous_pose(slot));
            let moved = motion.pose.center - previous.center;
            if motion.thickness.is_finite() && moved.length() <= SWEPT_FROM * motion.thickness {
                continue;
            }
            let shape = &bodies.shapes[slot as usize];
            let way = shape.bounding_box(previous).union(shape.bounding_box(motion.pose));
            self.broad_phase.query(way, |other| {
                let is_seen = [slot, other].map(|slot| roles.of(slot).is_sensor);
                let pair = [slot, other];
                let meets = is_seen.contains(&true) && roles.may_meet(pair, bodies.bodies_of(pair));
                if meets && self.have_met(pair) {
                    let ids = pair.map(|slot| self.id_of(slot));
                    for (index, _) in is_seen.into_iter().enumerate().filter(|&(_, is_sensor)| is_sensor) {
                        passed.push((ids[index], self.collider_id(pair[index]), ids[1 - index]));
                    }
                }
                true
            });
        }
    }

    /// Whether two bodies met within the step, if each went straight from where it was to where it is.
    fn have_met(&self, slots: [u32; 2]) -> bool {
        let poses =
            slots.map(|slot| (self.bodies.previous_pose(slot), self.bodies.motions[slot as usize].pose));
        let swept = |index: usize| {
            let (before, now): (Pose, Pose) = poses[index];
            let spin = (now.rotation * before.rotation.inverse()).angle();
            let shape = &self.bodies.shapes[slots[index] as usize];
            Swept { shape, rotation: before.rotation, spin, arm: Vec2::ZERO }
        };
        let [moved_a, moved_b] = poses.map(|(before, now)| now.center - before.center);
        let offset = poses[1].0.center - poses[0].0.center;
        // In units of the step.
        time_of_impact(swept(0), swept(1), offset, moved_b - moved_a, 1.0, 0.0).is_some()
    }
}
