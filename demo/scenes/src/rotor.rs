//! Kinematic bodies that move as the parts of one machine.
//!
//! A kinematic body turns about its own centre. A drum is made of several of them, and a flipper turns about
//! its end, so before each tick each part is told the velocity that brings its centre to where the machine has
//! it at the end of the tick: v = (p' - p) / dt with p' = pivot + R' r. As p' comes from the machine's rotation
//! and not from p, the parts do not drift apart however long they turn.

use rustycs::{BodyId, BodyType, Rot, Vec2, World};

use crate::mark::Mark;

/// Where a part sits in its machine while that stands at the angle 0.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Seat {
    /// Centre of the part as seen from the pivot, m.
    pub(crate) offset: Vec2,
    /// Angle of the part, rad.
    pub(crate) angle: f32,
}

/// Parts of the world that are marked as part 0 to `seats` - 1 of a machine: their ids and numbers.
pub(crate) fn parts(world: &World, seats: usize) -> Vec<(BodyId, usize)> {
    let is_part = |body: rustycs::BodyRef<'_>| {
        let part = Mark::of(body).part.filter(|&part| part < seats);
        part.filter(|_| body.body_type() == BodyType::Kinematic)
    };
    world.bodies().filter_map(|(id, body)| Some((id, is_part(body)?))).collect()
}

/// Turns the machine by `spin` (rad/s) about `pivot` (m). The rotation of the first part is the machine's, so
/// that it goes on from where it is, whatever the tick rate was before.
pub(crate) fn turn(world: &mut World, pivot: Vec2, spin: f32, seats: &[Seat]) {
    let parts = parts(world, seats.len());
    let Some((first, place)) = parts.first().copied() else { return };
    let Some(leader) = world.body(first) else { return };
    let machine = leader.rotation() * Rot::from_angle(seats[place].angle).inverse();
    for (id, place) in parts {
        steer(world, id, pivot, machine, spin, seats[place]);
    }
}

/// Gives one part the velocity and spin (rad/s) that keep it in its seat while the machine, now at the
/// rotation `machine`, turns about `pivot` (m).
pub(crate) fn steer(world: &mut World, id: BodyId, pivot: Vec2, machine: Rot, spin: f32, seat: Seat) {
    let dt = world.settings().tick_seconds() as f32;
    let Some(mut part) = world.body_mut(id) else { return };
    let [x, y] = part.view().position_f64();
    let now = part.view().rotation();
    let center = Rot::from_angle(spin * dt) * machine;
    let goal = center.rotate(seat.offset);
    let way = [f64::from(pivot.x) + f64::from(goal.x) - x, f64::from(pivot.y) + f64::from(goal.y) - y];
    // What rounding has turned the part by, against the machine.
    let behind = (machine * Rot::from_angle(seat.angle) * now.inverse()).angle();
    // Speeds of scenes are far within what a body can be given; a part that was dragged away may not be.
    let speed = |way: f64| ((way as f32) / dt).clamp(-FASTEST, FASTEST);
    part.set_velocity([speed(way[0]), speed(way[1])]);
    part.set_angular_velocity((spin + behind / dt).clamp(-FASTEST, FASTEST));
}

/// Fastest that a part is steered, m/s and rad/s: above what any scene needs; a part that was moved by hand
/// returns no faster.
const FASTEST: f32 = 60.0;
