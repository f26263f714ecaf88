//! Sleep: islands in equilibrium are taken out of the step until something wakes them.
//!
//! An island sleeps when every body in it is at rest, as its [`RestWatch`](crate::body::RestWatch) tells, and is held where
//! it is: rest alone is not equilibrium, as what floats slowly by is as slow. A body is held by contacts that bear load, if
//! the island stands on something that does not move, or by damping, which stops whatever still moves. What nothing holds
//! must not have moved at all. And the solver must be done with it: a change of tier moves bodies at rest.
//!
//! The bodies of the island lose their rows, its contacts leave the constraint graph and keep manifold and impulses, so that
//! the island wakes as it fell asleep. What was left wrong of them then, [`Sleepers::penetration`], stays so.

use crate::body::{Bodies, NONE, RestRule};
use crate::collision::Contacts;
use crate::joint::Joints;
use crate::math::Vec2;
use crate::resolution::{Connections, ConstraintGraph, Islands, Tiers, find_island};
use crate::store::{BitSet, Slots};

/// Islands at rest are looked for so many times a second: to look for them in each step takes a tenth of the time of a
/// heap in which a single body cannot come to rest.
const LOOKS_PER_SECOND: f32 = 8.0;

/// Whether islands at rest are looked for in this tick of a world.
pub(crate) fn is_due(tick: u64, tick_rate: f32) -> bool {
    tick.is_multiple_of((tick_rate / LOOKS_PER_SECOND).max(1.0) as u64)
}

/// An island that sleeps.
#[derive(Debug)]
struct SleepingIsland {
    /// Slots of its bodies.
    slots: Vec<u32>,
    /// Deepest overlap of its contacts, m.
    penetration: f32,
}

clone_into_buffers!(SleepingIsland { slots, penetration });

/// Sleeping islands.
#[derive(Debug, Default)]
pub(crate) struct Sleepers {
    groups: Slots<SleepingIsland>,
    /// Scratch: slots of the bodies whose islands have been found, one of these, and those at rest.
    seen: BitSet,
    island: Vec<u32>,
    resting: Islands,
}

clone_into_buffers!(Sleepers { groups } scratch { seen, island, resting });

/// The tables that putting to sleep and waking change.
#[derive(Debug)]
pub(crate) struct SleepTables<'a> {
    pub(crate) bodies: &'a mut Bodies,
    pub(crate) contacts: &'a mut Contacts,
    pub(crate) joints: &'a Joints,
    pub(crate) graph: &'a mut ConstraintGraph,
    pub(crate) tiers: &'a Tiers,
}

/// When bodies may sleep.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SleepRule {
    pub(crate) rest: RestRule,
    /// The tick of the world.
    pub(crate) tick: u64,
}

/// Why a body is awake, see [`BodyRef::why_awake`](crate::BodyRef::why_awake).
///
/// ```
/// use rustycs::prelude::*;
///
/// let mut world = World::new(Settings::default());
/// world.add_force(Force::EARTH_GRAVITY);
/// world.add(Body::fixed(Shape::rectangle(20.0, 1.0)).at([0.0, -0.5]))?;
/// let ball = world.add(Body::dynamic(Shape::circle(0.5)).at([0.0, 0.5]).velocity([1.0, 0.0]).angular_velocity(-2.0))?;
/// for _ in 0..120 {
///     world.step();
/// }
/// let keeps_heap_awake = |body: &BodyRef<'_>| body.why_awake().is_some_and(|why| why != Awake::Others);
/// let rolling: Vec<_> = world.bodies().filter(|(_, body)| keeps_heap_awake(body)).map(|(id, _)| id).collect();
/// assert_eq!(rolling, [ball]); // more rolling resistance would stop it sooner
/// # Ok::<(), BodyError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Awake {
    /// Sleep is off for it, or for the world.
    MayNotSleep,
    /// It moves, or has not been at rest for long enough since it moved, or was woken, as by a force.
    Moves,
    /// It is at rest, but nothing holds it there: no contact bears load, no joint holds it, and damping does not stop all of its motion.
    NotHeld,
    /// It could sleep, but for what it is connected with by contacts and joints: something of that cannot, or none of it stands on
    /// what does not move. Or it has just come to rest: what may sleep is looked for eight times a second.
    Others,
}

/// Whether the body in `slot` is at rest, and may sleep.
fn is_at_rest(bodies: &Bodies, slot: u32, rule: RestRule) -> bool {
    let motion = &bodies.motions[slot as usize];
    motion.is_watched && motion.may_sleep && bodies.watches[slot as usize].is_at_rest(rule)
}

/// Whether a contact or a joint holds the body in `slot`.
fn is_held(bodies: &Bodies, contacts: &Contacts, joints: &Joints, slot: u32) -> bool {
    contacts.of_body(bodies, slot).any(|index| contacts[index].is_loaded()) || joints.hold(slot)
}

/// Whether what still moves of the body in `slot`, which is at rest, is stopped by damping, or nothing does.
fn stops_by_itself(bodies: &Bodies, slot: u32) -> bool {
    let (forcing, state) = (&bodies.forcings[slot as usize], bodies.state(slot));
    let dampings = [forcing.linear_damping, forcing.angular_damping];
    let moves = [state.velocity.to_vec2() != Vec2::ZERO, state.angular_velocity != 0.0];
    let is_damped = dampings.iter().any(|&damping| damping > 0.0);
    let is_slowed = is_damped && dampings.iter().zip(moves).all(|(&damping, moves)| damping > 0.0 || !moves);
    is_slowed || bodies.watches[slot as usize].is_still() && !state.is_moving()
}

/// Why the dynamic body in `slot` is awake; `None` if it is not. `rule` is `None` where sleep is off.
pub(crate) fn why_awake(
    bodies: &Bodies,
    contacts: &Contacts,
    joints: &Joints,
    slot: u32,
    rule: Option<RestRule>,
) -> Option<Awake> {
    if !bodies.is_awake(slot) || !bodies.is_dynamic(slot) {
        return None;
    }
    let Some(rule) = rule.filter(|_| bodies.motions[slot as usize].may_sleep) else {
        return Some(Awake::MayNotSleep);
    };
    Some(if !is_at_rest(bodies, slot, rule) {
        Awake::Moves
    } else if !stops_by_itself(bodies, slot) && !is_held(bodies, contacts, joints, slot) {
        Awake::NotHeld
    } else {
        Awake::Others
    })
}

impl Sleepers {
    /// How many islands sleep.
    pub(crate) fn len(&self) -> usize {
        self.groups.len()
    }

    /// Gives up places of islands that woke, and scratch.
    pub(crate) fn trim(&mut self) {
        let mut groups = std::mem::take(&mut self.groups);
        groups.trim();
        *self = Self { groups, ..Self::default() };
    }

    /// Deepest overlap of the contacts that sleep, m.
    pub(crate) fn penetration(&self) -> f32 {
        self.groups.iter().map(|(_, island)| island.penetration).fold(0.0, f32::max)
    }

    /// Puts every island to sleep that is in equilibrium.
    pub(crate) fn put_to_sleep(&mut self, tables: &mut SleepTables<'_>, rule: SleepRule) {
        self.seen.clear();
        self.resting.clear();
        for row in 1..tables.bodies.row_count() {
            let slot = tables.bodies.slot_of_row(row);
            let is_candidate = tables.bodies.is_dynamic(slot) && is_at_rest(tables.bodies, slot, rule.rest);
            if is_candidate && !self.seen.contains(slot) {
                self.look_at_island(slot, tables, rule);
            }
        }
        let resting = std::mem::take(&mut self.resting);
        for island in resting.iter() {
            self.lay_down(tables, island.to_vec());
        }
        self.resting = resting;
    }

    /// Finds the island of the body in `slot`, and whether it is in equilibrium: it is at rest and held there, and what it
    /// touches is at rest.
    fn look_at_island(&mut self, slot: u32, tables: &SleepTables<'_>, rule: SleepRule) {
        let bodies = &*tables.bodies;
        let (mut rests, mut stands) = (true, false);
        self.island.clear();
        let all = Connections { contacts: &*tables.contacts, joints: tables.joints };
        find_island(slot, bodies, all, &mut self.seen, &mut self.island, |_, contact| {
            // What a moving kinematic body touches stays awake.
            let moves = |&slot: &u32| bodies.is_awake(slot) && !is_at_rest(tables.bodies, slot, rule.rest);
            rests &= !contact.slots.iter().any(moves);
            stands |= contact.is_loaded() && !contact.slots.iter().all(|&slot| bodies.is_dynamic(slot));
        });
        // Joints carry as contacts do: what hangs on something that does not move stands.
        let joints = tables.joints;
        if joints.len() > 0 {
            rests &= self
                .island
                .iter()
                .all(|&slot| is_at_rest(tables.bodies, slot, rule.rest) && !joints.is_led(slot, bodies));
            stands |= self.island.iter().any(|&slot| joints.holds_to_ground(slot, bodies));
        }
        let stays = |&slot: &u32| {
            let stays =
                stops_by_itself(bodies, slot) || stands && is_held(bodies, tables.contacts, joints, slot);
            stays && !tables.tiers.is_to_change(slot, rule.tick, tables.graph.tier(slot))
        };
        if rests && self.island.iter().all(stays) {
            self.island.sort_unstable();
            self.resting.push(&self.island);
        }
    }

    /// Puts the bodies in `slots` to sleep as one group.
    pub(crate) fn lay_down(&mut self, tables: &mut SleepTables<'_>, slots: Vec<u32>) {
        for &slot in &slots {
            tables.bodies.take_row(slot);
        }
        let mut penetration = 0.0;
        for &slot in &slots {
            let of_body: Vec<u32> = tables.contacts.of_body(tables.bodies, slot).collect();
            for index in of_body {
                penetration = tables.contacts[index].penetration().max(penetration);
                tables.graph.leave(tables.contacts, index);
                let other = tables.contacts[index].other(slot);
                if !tables.bodies.is_awake(other) {
                    tables.contacts.set_asleep(index);
                }
            }
        }
        let key = self.groups.insert(SleepingIsland { slots, penetration });
        for &slot in &self.groups[key.index()].slots {
            tables.bodies.records[slot].sleep_group = key.index();
        }
    }

    /// Wakes the body in `slot` and its whole island, if it sleeps.
    pub(crate) fn wake(&mut self, tables: &mut SleepTables<'_>, slot: u32) {
        tables.bodies.motions[slot as usize].is_watched = false;
        let group = tables.bodies.records[slot].sleep_group;
        if group == NONE {
            return;
        }
        let Some(SleepingIsland { slots, .. }) = self.groups.remove(self.groups.key_at(group)) else {
            return;
        };
        for &slot in &slots {
            tables.bodies.give_row(slot);
            tables.bodies.motions[slot as usize].is_watched = false;
            tables.bodies.records[slot].sleep_group = NONE;
        }
        for &slot in &slots {
            let of_body: Vec<u32> = tables.contacts.of_body(tables.bodies, slot).collect();
            for index in of_body {
                tables.contacts.set_awake(index);
                if tables.contacts[index].manifold.points().is_empty() {
                    continue;
                }
                let other = tables.contacts[index].other(slot);
                let other_group = tables.bodies.records[other].sleep_group;
                if other_group == NONE {
                    tables.graph.enter(tables.contacts, tables.bodies, index);
                }
            }
        }
    }

    /// Wakes everything.
    pub(crate) fn wake_all(&mut self, tables: &mut SleepTables<'_>) {
        let firsts: Vec<u32> =
            self.groups.iter().filter_map(|(_, island)| island.slots.first().copied()).collect();
        for slot in firsts {
            self.wake(tables, slot);
        }
        for motion in &mut tables.bodies.motions {
            motion.is_watched = false;
        }
    }

    /// Wakes every body that the body in `slot` is close to.
    pub(crate) fn wake_neighbours(&mut self, tables: &mut SleepTables<'_>, slot: u32) {
        let neighbours: Vec<u32> = tables
            .contacts
            .of_body(tables.bodies, slot)
            .map(|index| tables.contacts[index].other(slot))
            .chain(tables.joints.of_body(slot).map(|index| tables.joints.all[index].other(slot)))
            .filter(|&other| other != NONE)
            .collect();
        for neighbour in neighbours {
            self.wake(tables, neighbour);
        }
    }
}
