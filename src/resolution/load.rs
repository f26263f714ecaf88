//! What each contact bears, noted at the end of each step. [`tiers`](super::tiers), [`refinement`](super::refinement) and
//! [`mass_scaling`](super::mass_scaling) read it before the next.
//!
//! A load is measured by the overlap that sweeps would leave under it, see [`sag`]. In a *sag share* that overlap is divided by the width of
//! the thinner body, so that one limit holds for bodies of all sizes. The words for a load, here and there:
//!
//! - it is **great** if its sag share is above [`GREAT_SHARE`];
//! - it is **still** if it is great and its bodies hardly move against each other, and **passing** if it is great and they do;
//! - it **lasts** if it was still for [`LASTING_STEPS`] steps in a row, and is **steady** if it was great for so many, still or passing;
//! - it is a **blow** if it is great, does not last, and its bodies are not deep in each other;
//! - it is **heavy** if it was great for [`HEAVY_STEPS`] steps in a row, still or passing, and would leave the bodies deep in each other;
//! - it is **notable** if it is any of the last three.
//!
//! What pushes bodies apart that overlap in the direct solve is over with the push, and no load of their contacts: it is told of the island, in
//! [`DirectOutcome::sag_share`].
//!
//! Contacts without a great load cost one comparison.

use crate::body::Bodies;
use crate::collision::Contact;
use crate::resolution::softness::{DEEP_SHARE, sag};

/// An island is solved directly from this sag share on, no unit. A box 1 m wide sags by 12.5 mm then. With twice as much a stack of 50 boxes
/// does not come to rest, and a box that falls on another at 7.5 m/s is thrown back at 0.9 m/s. With half of it, 142 of the 503 bodies of the scene
/// `pool` are solved directly in some step as they fall, and a stack of 20 boxes is 13 mm farther off its place with 16 substeps than with four.
pub(super) const DIRECT_SHARE: f32 = 0.0125;

/// Sags are computed for no more substeps per second than these, 1/s: 60 ticks of 4 substeps, as in the default settings. Without this
/// bound more substeps would mean fewer direct solves, and stacks at high rates lean until they fall.
const USUAL_RATE: f32 = 240.0;

/// Substeps per second that sags are computed for where so many are asked for, 1/s.
pub(super) fn sag_rate(substep_rate: f32) -> f32 {
    substep_rate.min(USUAL_RATE)
}

/// A load lasts that was still for so many steps in a row: a blow is over sooner. If one step were enough, a puzzle of boxes would be
/// solved directly at every blow, and take 2.7 times as long.
pub(super) const LASTING_STEPS: u8 = 4;

/// Hysteresis: what was done for a load is undone only below this share of the limit that asked for it, no unit. With one limit for both,
/// islands change their tier again and again, never sleep, and card houses fall.
pub(super) const CALM_SHARE: f32 = 0.7;

/// What is solved directly is calm below this sag share, no unit, and no load below it is looked at.
pub(super) const GREAT_SHARE: f32 = CALM_SHARE * DIRECT_SHARE;

/// Hysteresis: what was done for a load is undone only after so many steps in a row below that, as each change moves bodies, and
/// these may load others. With 10, card houses fall.
pub(super) const CALM_STEPS: u8 = 30;

/// A load is heavy if it was great for so many steps, still or passing. With half of it, pits into which heavy balls sink take
/// 1.5 times as many substeps; with twice as much the same, as the balls have sunk in deeper by then.
const HEAVY_STEPS: u8 = 30;

/// The load of a contact.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct ContactLoad {
    /// For how many steps in a row it has been great.
    great_steps: u8,
    /// For how many steps in a row it has been still; 0 while it passes.
    still_steps: u8,
    /// The sag share when it was last great.
    pub(super) sag_share: f32,
    /// Whether the bodies are deep in each other.
    is_deep: bool,
}

impl ContactLoad {
    /// Whether sweeps would leave the bodies deep in each other under it, for long. What trembles is passing, and so does not last, but may be
    /// heavy.
    pub(super) fn is_heavy(self) -> bool {
        self.great_steps >= HEAVY_STEPS && self.sag_share > DEEP_SHARE
    }

    pub(super) fn lasts(self) -> bool {
        self.still_steps >= LASTING_STEPS
    }

    pub(super) fn is_steady(self) -> bool {
        self.great_steps >= LASTING_STEPS
    }

    /// Of a great load: whether the bodies move against each other.
    pub(super) fn is_passing(self) -> bool {
        self.still_steps == 0
    }

    /// Bodies that are deep in each other are pushed apart, which is no blow: taken for one, crosses that are set into each other fly apart.
    pub(super) fn lasts_or_is_blow(self) -> bool {
        self.lasts() || self.great_steps > 0 && !self.is_deep
    }

    /// ω², 1/s², with which the thinner body rocks under it: F/(m L), see [`refinement`](super::refinement). So many substeps per second are asked
    /// for.
    pub(super) fn rocking_square(self, substep_rate: f32) -> f32 {
        let rate = sag_rate(substep_rate);
        // k λ over the width, 1/s, where k λ = F/(m rate).
        let speed_share = self.sag_share / sag(1.0, rate);
        rate * speed_share
    }

    /// Of a great load: whether the bodies are deep in each other.
    pub(super) fn is_deep(self) -> bool {
        self.great_steps > 0 && self.is_deep
    }

    fn is_notable(self) -> bool {
        self.lasts_or_is_blow() || self.is_heavy()
    }
}

/// How the direct solve of its island went, for a body.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DirectOutcome {
    pub(crate) slot: u32,
    /// Multiplications that factorizations and sweeps took in a substep that was asked for, for each body of the island, on average. Finer
    /// substeps take as many times more.
    pub(crate) work: f32,
    /// Whether it solved the island.
    pub(crate) is_solved: bool,
    /// The greatest sag share in the island under the impulses of the push, which also separate what overlaps.
    pub(crate) sag_share: f32,
}

/// What the last step noted of loads, and of direct solves.
#[derive(Debug, Default)]
pub(crate) struct Loads {
    /// By index of a contact.
    pub(crate) of_contact: Vec<ContactLoad>,
    /// Indices of the contacts with a notable load.
    pub(crate) notable: Vec<u32>,
    /// Indices of the contacts that began between bodies at rest, see [`begins_at_rest`].
    pub(crate) begun_at_rest: Vec<u32>,
    /// One for each body of the islands that were solved directly.
    pub(crate) outcomes: Vec<DirectOutcome>,
}

clone_into_buffers!(Loads { of_contact, notable, begun_at_rest, outcomes });

impl Loads {
    /// Forgets the load of a contact, which begins, or has lost its points; there is room for it then.
    pub(crate) fn forget_contact(&mut self, index: u32) {
        let end = index as usize + 1;
        self.of_contact.resize(self.of_contact.len().max(end), ContactLoad::default());
        self.of_contact[index as usize] = ContactLoad::default();
    }

    /// Forgets the body in a slot, which is removed, or not dynamic any more.
    pub(crate) fn forget_body(&mut self, slot: u32) {
        self.outcomes.retain(|outcome| outcome.slot != slot);
    }

    /// Forgets what is beyond so many contacts and slots of bodies.
    pub(crate) fn trim(&mut self, contacts: usize, slots: usize) {
        self.of_contact.truncate(contacts);
        self.notable.retain(|&index| (index as usize) < contacts);
        self.begun_at_rest.retain(|&index| (index as usize) < contacts);
        self.outcomes.retain(|outcome| (outcome.slot as usize) < slots);
    }

    /// Forgets what the last step noted, but for how long loads have been there.
    pub(crate) fn clear(&mut self) {
        self.notable.clear();
        self.begun_at_rest.clear();
        self.outcomes.clear();
    }
}

/// How loads are measured.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LoadMeasure {
    /// Length of the step, s.
    pub(crate) dt: f32,
    /// Substeps per second that sags are computed for, 1/s.
    sag_rate: f32,
    /// How many times as many there are, no unit: an impulse of a substep is as many times smaller. 0 where loads do not matter.
    factor: f32,
}

impl LoadMeasure {
    /// For a step of length `dt`, s, of so many `substeps`, where `asked` are asked for. Sags are computed for those
    /// asked for, as more of them do not make the load less; but for no more than [`USUAL_RATE`], as those who ask for more want less error, and no
    /// other tier. No load is great unless `loads_matter`.
    pub(crate) fn new(loads_matter: bool, dt: f32, substeps: u32, asked: u32) -> Self {
        let substep_rate = substeps as f32 / dt;
        let sag_rate = sag_rate(asked as f32 / dt);
        Self { dt, sag_rate, factor: if loads_matter { substep_rate / sag_rate } else { 0.0 } }
    }

    /// The sag, m, under a load whose k λ is `speed`, m/s. It is linear: of k λ over a width, 1/s, it makes a sag share.
    pub(crate) fn sag(self, speed: f32) -> f32 {
        sag(self.factor * speed, self.sag_rate)
    }

    /// Takes note of the load of a contact, whose greatest k λ is `speed`, m/s. Returns whether it is notable.
    #[inline(always)]
    pub(crate) fn note_load(self, contact: &Contact, load: &mut ContactLoad, speed: f32) -> bool {
        let sag = self.sag(speed);
        if sag <= GREAT_SHARE * contact.thickness {
            (load.great_steps, load.still_steps) = (0, 0);
            return false;
        }
        *load = ContactLoad {
            great_steps: load.great_steps.saturating_add(1),
            still_steps: if contact.holds_still { load.still_steps.saturating_add(1) } else { 0 },
            sag_share: sag / contact.thickness,
            is_deep: contact.penetration() > DEEP_SHARE * contact.thickness,
        };
        load.is_notable()
    }
}

/// The greatest sag shares of the contacts of an island, no unit.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct IslandLoad {
    /// Of loads that last.
    pub(super) lasting: f32,
    /// Of loads that last, and of blows that are still.
    pub(super) still: f32,
    /// Of blows that are passing.
    pub(super) passing: f32,
    /// Whether any bodies are deep in each other.
    pub(super) is_deep: bool,
}

impl IslandLoad {
    pub(super) fn add(&mut self, load: ContactLoad) {
        if load.lasts_or_is_blow() {
            let greatest = if load.is_passing() { &mut self.passing } else { &mut self.still };
            *greatest = greatest.max(load.sag_share);
        }
        self.is_deep |= load.is_deep();
        if load.lasts() {
            self.lasting = self.lasting.max(load.sag_share);
        }
    }
}

/// Whether a contact has borne nothing yet, and its bodies move alike and do not turn: so begins what is set up at rest, on the ground or
/// on a lift.
pub(crate) fn begins_at_rest(contact: &Contact, bodies: &Bodies) -> bool {
    let [a, b] = contact.slots.map(|slot| bodies.state(slot));
    contact.manifold.points().iter().all(|point| point.normal_impulse == 0.0)
        && a.velocity.to_vec2() == b.velocity.to_vec2()
        && [a, b].iter().all(|state| state.angular_velocity == 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::{Body, Mixed};
    use crate::collision::Contacts;
    use crate::shape::Shape;

    /// Two boxes 1 m thick, in contact and at rest.
    fn contact() -> Contact {
        let mut bodies = Bodies::default();
        let slots =
            [0.0, 1.0].map(|y| bodies.insert(&Body::dynamic(Shape::obb(1.0, 1.0)).at([0.0, y])).0.index());
        let mut contacts = Contacts::default();
        let index = contacts.begin(&mut bodies, slots, Mixed::default());
        contacts[index].holds_still = true;
        contacts[index].clone()
    }

    /// The k λ, m/s per substep at 240 Hz, under which a contact sags by so much.
    fn speed_for(wanted: f32) -> f32 {
        wanted / sag(1.0, USUAL_RATE)
    }

    #[test]
    fn a_load_is_heavy_after_some_steps_though_its_bodies_move() {
        let (measure, mut contact) = (LoadMeasure::new(true, 1.0 / 60.0, 4, 4), contact());
        contact.holds_still = false;
        let is_heavy = |sag: f32, steps: u8| {
            let mut load = ContactLoad::default();
            (0..steps).for_each(|_| _ = measure.note_load(&contact, &mut load, speed_for(sag)));
            assert!(!load.lasts());
            load.is_heavy()
        };
        assert!(is_heavy(1.1 * DEEP_SHARE, HEAVY_STEPS));
        assert!(!is_heavy(1.1 * DEEP_SHARE, HEAVY_STEPS - 1), "a blow");
        assert!(!is_heavy(0.9 * DEEP_SHARE, HEAVY_STEPS));
    }

    #[test]
    fn a_load_lasts_when_it_was_great_for_some_steps_and_ends_at_once() {
        let (measure, contact, mut load) =
            (LoadMeasure::new(true, 1.0 / 60.0, 4, 4), contact(), ContactLoad::default());
        let great = speed_for(DIRECT_SHARE);
        for step in 1..=6 {
            assert!(measure.note_load(&contact, &mut load, great), "step {step}");
            let mut island = IslandLoad::default();
            island.add(load);
            let sags = [island.still, island.lasting].map(|sag| sag / DIRECT_SHARE);
            let lasts = f32::from(u8::from(step >= LASTING_STEPS));
            assert!(
                (sags[0] - 1.0).abs() < 1e-6 && (sags[1] - lasts).abs() < 1e-6,
                "step {step}: {island:?}"
            );
        }
        assert!(!measure.note_load(&contact, &mut load, speed_for(0.5 * GREAT_SHARE)));
        assert!(
            measure.note_load(&contact, &mut load, great) && !load.lasts(),
            "a new load has to last anew"
        );
    }

    /// Whether they are asked for, or refined from those asked for.
    #[test]
    fn more_substeps_do_not_change_what_a_load_is() {
        let (contact, great) = (contact(), speed_for(DIRECT_SHARE));
        for factor in [1, 2, 8] {
            for asked in [4, 4 * factor] {
                let measure = LoadMeasure::new(true, 1.0 / 60.0, 4 * factor, asked);
                let mut load = ContactLoad::default();
                measure.note_load(&contact, &mut load, great / factor as f32);
                assert!((load.sag_share / DIRECT_SHARE - 1.0).abs() < 1e-6, "{load:?}, {factor}, {asked}");
            }
        }
    }
}
