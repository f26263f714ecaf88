//! What shapes are to what they meet, apart from their material: filter, sensor, belt, rolling resistance, rules of mixing, one-way floor. Most
//! have the default.
//!
//! Kept in tables of their own, which end with the last shape that had a role: a world in which none ever had keeps nothing, and asks
//! nothing but whether there is one.

use crate::body::{Filter, Mix};
use crate::math::Vec2;

/// Coefficient of rolling resistance where neither of two shapes was told one, no unit: that of hard wheels on hard ground. A disc at 1 m/s comes 25 m
/// far, and stays on slopes below 3 mrad. Of 36 heaps of 300 and 1,000 bodies of every shape 31 sleep after twenty seconds; 5 with
/// none, as what rolls does so for ever, 18 with a fourth of it, and 27 with five times as much, as some creep on.
const USUAL_ROLLING_RESISTANCE: f32 = 0.002;

/// What a body is to what it meets.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Role {
    pub(crate) filter: Filter,
    /// Whether it only takes note of what overlaps it.
    pub(crate) is_sensor: bool,
    /// Speed of its surface against itself, m/s; positive takes what lies on top to the right.
    pub(crate) surface_speed: f32,
    /// Coefficient of rolling resistance, no unit, if it was told one.
    pub(crate) rolling_resistance: Option<f32>,
    /// Rules of its own by which its friction and its restitution mix with those of others.
    pub(crate) friction_mix: Option<Mix>,
    pub(crate) restitution_mix: Option<Mix>,
    /// Of a one-way floor, the direction in which bodies pass it, in its frame; length 1.
    pub(crate) one_way: Option<Vec2>,
}

/// What of the role of its body a shape overrides; the rest it inherits.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct OwnRole {
    pub(crate) filter: Option<Filter>,
    pub(crate) is_sensor: Option<bool>,
    pub(crate) surface_speed: Option<f32>,
    pub(crate) rolling_resistance: Own<f32>,
    pub(crate) friction_mix: Own<Mix>,
    pub(crate) restitution_mix: Own<Mix>,
    pub(crate) one_way: Own<Vec2>,
}

/// What a shape may have, or not have, in the place of its body.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) enum Own<T> {
    /// What the body has.
    #[default]
    Inherit,
    /// This, or none.
    Set(Option<T>),
}

impl<T> Own<T> {
    fn or(self, of_body: Option<T>) -> Option<T> {
        match self {
            Self::Inherit => of_body,
            Self::Set(own) => own,
        }
    }
}

impl Role {
    /// Coefficient of rolling resistance, no unit: its own, or the usual one.
    pub(crate) fn rolling_resistance_or_usual(self) -> f32 {
        self.rolling_resistance.unwrap_or(USUAL_ROLLING_RESISTANCE)
    }

    /// Whether it chooses with what the shape collides.
    fn is_choosy(&self) -> bool {
        self.is_sensor || self.filter != Filter::default()
    }
}

impl OwnRole {
    /// The role of a shape that overrides so much, on a body of a role.
    pub(crate) fn on(self, of_body: Role) -> Role {
        Role {
            filter: self.filter.unwrap_or(of_body.filter),
            is_sensor: self.is_sensor.unwrap_or(of_body.is_sensor),
            surface_speed: self.surface_speed.unwrap_or(of_body.surface_speed),
            rolling_resistance: self.rolling_resistance.or(of_body.rolling_resistance),
            friction_mix: self.friction_mix.or(of_body.friction_mix),
            restitution_mix: self.restitution_mix.or(of_body.restitution_mix),
            one_way: self.one_way.or(of_body.one_way),
        }
    }
}

impl From<Role> for OwnRole {
    /// Overrides all.
    fn from(role: Role) -> Self {
        Self {
            filter: Some(role.filter),
            is_sensor: Some(role.is_sensor),
            surface_speed: Some(role.surface_speed),
            rolling_resistance: Own::Set(role.rolling_resistance),
            friction_mix: Own::Set(role.friction_mix),
            restitution_mix: Own::Set(role.restitution_mix),
            one_way: Own::Set(role.one_way),
        }
    }
}

/// The roles of all bodies, and the pairs that were parted.
#[derive(Debug, Default)]
pub(crate) struct Roles {
    /// By slot; what is beyond the end has the default.
    by_slot: Vec<Role>,
    /// Slots of bodies that do not collide with each other, whatever their filters: each pair both ways round, sorted, so that
    /// those of one body are found together.
    parted: Vec<(u32, u32)>,
    /// The slots of sensors, ascending.
    sensors: Vec<u32>,
    /// The slots of bodies whose surface moves, ascending.
    belts: Vec<u32>,
    /// How many shapes choose with what they collide.
    choosy_count: usize,
    /// How many one-way floors there are.
    one_way_count: usize,
}

clone_into_buffers!(Roles { by_slot, parted, sensors, belts, choosy_count, one_way_count });

impl Roles {
    /// The role of the shape in `slot`.
    #[inline(always)]
    pub(crate) fn of(&self, slot: u32) -> Role {
        self.by_slot.get(slot as usize).copied().unwrap_or_default()
    }

    /// Gives the shape in `slot` a role.
    pub(crate) fn set(&mut self, slot: u32, role: Role) {
        let place = slot as usize;
        if place >= self.by_slot.len() {
            if role == Role::default() {
                return;
            }
            self.by_slot.resize(place + 1, Role::default());
        }
        let before = std::mem::replace(&mut self.by_slot[place], role);
        list(&mut self.sensors, slot, role.is_sensor);
        list(&mut self.belts, slot, role.surface_speed != 0.0);
        self.choosy_count += usize::from(role.is_choosy());
        self.choosy_count -= usize::from(before.is_choosy());
        self.one_way_count += usize::from(role.one_way.is_some());
        self.one_way_count -= usize::from(before.one_way.is_some());
    }

    /// The slots of sensors, ascending.
    pub(crate) fn sensors(&self) -> &[u32] {
        &self.sensors
    }

    /// Forgets the shape in `slot`, which is removed; of a body's own slot, the bodies that it was parted from too.
    pub(crate) fn forget(&mut self, slot: u32) {
        self.set(slot, Role::default());
        while let Some(&(_, other)) = self.pairs_of(slot).first() {
            self.join(slot, other);
        }
    }

    /// Drops the entries from `end` on: there are no such slots any more.
    pub(crate) fn trim(&mut self, end: usize) {
        self.by_slot.truncate(end);
    }

    /// The bodies that the body in `slot` is parted from.
    pub(crate) fn parted_from(&self, slot: u32) -> impl Iterator<Item = u32> {
        self.pairs_of(slot).iter().map(|&(_, other)| other)
    }

    /// The same, as the pairs of both.
    fn pairs_of(&self, slot: u32) -> &[(u32, u32)] {
        let first = self.parted.partition_point(|&(a, _)| a < slot);
        let of_slot = &self.parted[first..];
        &of_slot[..of_slot.partition_point(|&(a, _)| a == slot)]
    }

    /// The pairs that were parted, each once.
    pub(crate) fn parted(&self) -> impl Iterator<Item = (u32, u32)> {
        self.parted.iter().copied().filter(|(a, b)| a < b)
    }

    /// Whether two bodies were parted.
    pub(crate) fn are_parted(&self, a: u32, b: u32) -> bool {
        self.parted.binary_search(&(a, b)).is_ok()
    }

    /// Has two bodies not collide with each other.
    pub(crate) fn part(&mut self, a: u32, b: u32) {
        for pair in [(a, b), (b, a)] {
            if let Err(place) = self.parted.binary_search(&pair) {
                self.parted.insert(place, pair);
            }
        }
    }

    /// Leaves it to their filters again whether two bodies collide.
    pub(crate) fn join(&mut self, a: u32, b: u32) {
        for pair in [(a, b), (b, a)] {
            if let Ok(place) = self.parted.binary_search(&pair) {
                self.parted.remove(place);
            }
        }
    }

    /// Whether the roles of two shapes, of these bodies, let them collide.
    #[inline(always)]
    pub(crate) fn may_collide(&self, colliders: [u32; 2], bodies: [u32; 2]) -> bool {
        let are_usual = self.choosy_count == 0 && self.parted.is_empty();
        bodies[0] != bodies[1]
            && (are_usual
                || self.may_meet(colliders, bodies)
                    && !colliders.into_iter().any(|slot| self.of(slot).is_sensor))
    }

    /// Whether one of two bodies is a one-way floor.
    #[inline(always)]
    pub(crate) fn are_one_way(&self, slots: [u32; 2]) -> bool {
        self.one_way_count > 0 && slots.into_iter().any(|slot| self.of(slot).one_way.is_some())
    }

    /// Speed of the surface of the second of two bodies against that of the first, beside how these move, along the tangent of
    /// their contact, m/s; `None` where neither surface moves. Both surfaces go round their bodies clockwise, and past each other
    /// in opposite directions: their speeds add up.
    #[inline(always)]
    pub(crate) fn surface_speed(&self, [a, b]: [u32; 2]) -> Option<f32> {
        if self.belts.is_empty() {
            return None;
        }
        let speed = self.of(a).surface_speed + self.of(b).surface_speed;
        (speed != 0.0).then_some(speed)
    }

    /// Whether two shapes, of these bodies, are anything to each other: by their filters, and as the bodies were not parted.
    pub(crate) fn may_meet(&self, [a, b]: [u32; 2], bodies: [u32; 2]) -> bool {
        bodies[0] != bodies[1]
            && self.of(a).filter.collides_with(self.of(b).filter)
            && !self.are_parted(bodies[0], bodies[1])
    }
}

/// Coefficient of rolling resistance of two shapes, no unit: the greater of those that were told.
pub(crate) fn rolling_resistance_between(roles: [Role; 2]) -> f32 {
    let told = roles.into_iter().filter_map(|role| role.rolling_resistance);
    told.reduce(f32::max).unwrap_or(USUAL_ROLLING_RESISTANCE)
}

/// Has a slot be in an ascending list or not.
fn list(slots: &mut Vec<u32>, slot: u32, is_listed: bool) {
    match (slots.binary_search(&slot), is_listed) {
        (Err(place), true) => slots.insert(place, slot),
        (Ok(place), false) => _ = slots.remove(place),
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::{Role, Roles};
    use crate::body::Filter;

    #[test]
    fn parted_pairs_agree_with_an_ordered_set_under_random_edits() {
        let (mut roles, mut reference) = (Roles::default(), BTreeSet::new());
        let mut state = 3_u64;
        for _ in 0..5_000 {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            let (a, b) = ((state >> 40) as u32 % 12, (state >> 50) as u32 % 12);
            if a == b {
                roles.forget(a);
                reference.retain(|&(one, other)| one != a && other != a);
            } else if state >> 33 & 1 == 0 {
                roles.part(a, b);
                reference.insert((a.min(b), a.max(b)));
            } else {
                roles.join(a, b);
                reference.remove(&(a.min(b), a.max(b)));
            }
            assert!(roles.parted().eq(reference.iter().copied()));
            assert_eq!(roles.are_parted(b, a), reference.contains(&(a.min(b), a.max(b))));
        }
    }

    #[test]
    fn a_role_lasts_until_its_body_is_removed() {
        let mut roles = Roles::default();
        roles.set(7, Role::default());
        assert!(roles.by_slot.is_empty(), "the default needs no room");
        let filter = Filter { category: 4, ..Filter::DEFAULT };
        roles.set(7, Role { filter, is_sensor: true, ..Role::default() });
        assert_eq!(roles.sensors(), [7]);
        assert_eq!(
            (roles.of(7).filter, roles.of(6), roles.of(8)),
            (filter, Role::default(), Role::default())
        );
        roles.forget(7);
        assert_eq!((roles.of(7), roles.sensors().len()), (Role::default(), 0));
    }
}
