//! What the contacts of an island bear, told at the end of each step.
//!
//! A load is told by the overlap that sweeps leave under it, see [`sag`], as a share of the width
//! of the thinner body. Contacts without a great load cost one comparison.

use crate::body::Bodies;
use crate::collision::Contact;
use crate::resolution::softness::{DEEP_SHARE, sag};

/// Overlap at rest, as a share of the width of the thinner body, from which an island is solved directly.
pub(super) const DIRECT_SHARE: f32 = 0.0125;

/// Substeps per second that sags are told for, if there are no fewer, 1/s.
pub(super) const USUAL_RATE: f32 = 240.0;

/// A load lasts that is there for so many steps: a blow is over sooner. In small islands a blow counts as well.
pub(super) const LASTING_STEPS: u8 = 4;

/// An island goes back to sweeps only when the load is below this share of what asked for more, so that it does not go
/// to and fro.
pub(super) const CALM_SHARE: f32 = 0.7;

/// An island goes back to sweeps only when its load was small for so many steps in a row, lest the bodies that a change moves ask for
/// the next.
pub(super) const CALM_STEPS: u8 = 30;

/// A load is heavy if it is great for so many steps, whether its bodies move or not. With half of it, pits into which heavy balls sink take
/// 1.5 times as many substeps; with twice as much the same, as the balls have sunk in deeper by then.
const HEAVY_STEPS: u8 = 30;

/// The load of a contact.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct ContactLoad {
    /// For how many steps it has been great; 1 where the bodies move against each other, between which none lasts.
    steps: u8,
    /// Whether they do.
    pub(super) is_passing: bool,
    /// The overlap that sweeps would leave under it, as a share of the width of the thinner body.
    pub(super) sag: f32,
    /// For how many steps it has been great, whether they do or not.
    borne_steps: u8,
    /// Whether its bodies are deep in each other.
    is_deep: bool,
}

impl ContactLoad {
    /// Whether sweeps would leave its bodies deep in each other under it, for long. What trembles bears no load that lasts, but may bear one that is
    /// heavy.
    pub(super) fn is_heavy(self) -> bool {
        self.borne_steps >= HEAVY_STEPS && self.sag > DEEP_SHARE
    }

    /// Whether it has been great for long.
    pub(super) fn lasts(self) -> bool {
        self.steps >= LASTING_STEPS
    }

    /// Whether it lasts, or is a blow. Bodies that are deep in each other are pushed apart, which is no blow: taken for one, crosses
    /// that are set into each other fly apart.
    pub(super) fn counts(self) -> bool {
        self.lasts() || self.steps > 0 && !self.is_deep
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
    /// The overlap that sweeps would leave in the island under what has pushed its bodies apart, as a share of the width of the thinner body:
    /// beside the load this is what squeezes them.
    pub(crate) sag: f32,
}

/// The contacts under great load, and how direct solves went, as the last step has found them.
#[derive(Debug, Default)]
pub(crate) struct Loads {
    /// By index of a contact.
    pub(crate) of_contact: Vec<ContactLoad>,
    /// Indices of the contacts whose load counts, or is heavy.
    pub(crate) great: Vec<u32>,
    /// Contacts that begin between bodies at rest, see [`begins_at_rest`].
    pub(crate) begun_at_rest: Vec<u32>,
    /// Of the bodies of islands that were solved directly.
    pub(crate) of_direct: Vec<DirectOutcome>,
}

clone_into_buffers!(Loads { of_contact, great, begun_at_rest, of_direct });

impl Loads {
    /// Forgets the load of a contact, which begins, or has lost its points; there is room for it then.
    pub(crate) fn forget_contact(&mut self, index: u32) {
        let end = index as usize + 1;
        self.of_contact.resize(self.of_contact.len().max(end), ContactLoad::default());
        self.of_contact[index as usize] = ContactLoad::default();
    }

    /// Forgets the body in a slot, which is removed, or not dynamic any more.
    pub(crate) fn forget_body(&mut self, slot: u32) {
        self.of_direct.retain(|outcome| outcome.slot != slot);
    }

    /// Forgets what is beyond so many contacts and slots of bodies.
    pub(crate) fn trim(&mut self, contacts: usize, slots: usize) {
        self.of_contact.truncate(contacts);
        self.great.retain(|&index| (index as usize) < contacts);
        self.begun_at_rest.retain(|&index| (index as usize) < contacts);
        self.of_direct.retain(|outcome| (outcome.slot as usize) < slots);
    }

    /// Begins a step.
    pub(crate) fn clear(&mut self) {
        self.great.clear();
        self.begun_at_rest.clear();
        self.of_direct.clear();
    }
}

/// How loads are told.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LoadMeasure {
    /// Length of the step, s.
    pub(crate) dt: f32,
    /// Substeps per second that sags are told for, 1/s.
    usual_rate: f32,
    /// How many times as many there are, no unit: an impulse of a substep is as many times smaller. 0 where loads do not matter.
    factor: f32,
}

impl LoadMeasure {
    /// For a step of length `dt`, s, of so many `substeps`, `refinement` of them for one that is asked for. Sags are told for those asked
    /// for, as more of them do not make the load less; but for no more than usual, as those who ask for more want less error, and no other
    /// tier. Nothing counts as a load unless `loads_matter`.
    pub(crate) fn new(loads_matter: bool, dt: f32, substeps: u32, refinement: u32) -> Self {
        let substep_rate = substeps as f32 / dt;
        let usual_rate = (substep_rate / refinement as f32).min(USUAL_RATE);
        Self { dt, usual_rate, factor: if loads_matter { substep_rate / usual_rate } else { 0.0 } }
    }

    /// The overlap that sweeps leave under a load whose k λ is `speed`, m/s: m.
    pub(crate) fn sag(self, speed: f32) -> f32 {
        sag(self.factor * speed, self.usual_rate)
    }

    /// Takes note of the load of a contact, whose greatest k λ is `speed`, m/s. Returns whether it counts, or is heavy.
    #[inline(always)]
    pub(crate) fn note_load(self, contact: &Contact, load: &mut ContactLoad, speed: f32) -> bool {
        let sag = self.sag(speed);
        if sag <= CALM_SHARE * DIRECT_SHARE * contact.thickness {
            (load.steps, load.borne_steps) = (0, 0);
            return false;
        }
        let steps_before = if load.is_passing { 0 } else { load.steps };
        let steps = if contact.holds_still { steps_before.saturating_add(1) } else { 1 };
        *load = ContactLoad {
            steps,
            is_passing: !contact.holds_still,
            sag: sag / contact.thickness,
            borne_steps: load.borne_steps.saturating_add(1),
            is_deep: contact.penetration() > DEEP_SHARE * contact.thickness,
        };
        load.counts() || load.is_heavy()
    }
}

/// The load of the contacts of an island.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Load {
    /// Largest sag under what lasts, and of all that is great, as a share of the thickness.
    pub(super) lasting: f32,
    pub(super) greatest: f32,
    /// The same between bodies that pass each other.
    pub(super) passing: f32,
}

impl Load {
    pub(super) fn add(&mut self, load: ContactLoad) {
        if load.counts() {
            let greatest = if load.is_passing { &mut self.passing } else { &mut self.greatest };
            *greatest = greatest.max(load.sag);
        }
        if load.lasts() {
            self.lasting = self.lasting.max(load.sag);
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
    use crate::body::Body;
    use crate::collision::Contacts;
    use crate::shape::Shape;

    /// Two boxes 1 m thick, in contact and at rest.
    fn contact() -> Contact {
        let mut bodies = Bodies::default();
        let slots =
            [0.0, 1.0].map(|y| bodies.insert(&Body::dynamic(Shape::obb(1.0, 1.0)).at([0.0, y])).0.index());
        let mut contacts = Contacts::default();
        let index = contacts.begin(&mut bodies, slots, 0.5, 0.0);
        contacts[index].holds_still = true;
        contacts[index].clone()
    }

    /// The k λ, m/s per substep at 240 Hz, under which a contact sags by so much.
    fn speed_for(wanted: f32) -> f32 {
        wanted / sag(1.0, USUAL_RATE)
    }

    #[test]
    fn a_load_is_heavy_after_some_steps_though_its_bodies_move() {
        let (measure, mut contact) = (LoadMeasure::new(true, 1.0 / 60.0, 4, 1), contact());
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
            (LoadMeasure::new(true, 1.0 / 60.0, 4, 1), contact(), ContactLoad::default());
        let great = speed_for(DIRECT_SHARE);
        for step in 1..=6 {
            assert!(measure.note_load(&contact, &mut load, great), "step {step}");
            let mut island = Load::default();
            island.add(load);
            let sags = [island.greatest, island.lasting].map(|sag| sag / DIRECT_SHARE);
            let lasts = f32::from(u8::from(step >= LASTING_STEPS));
            assert!(
                (sags[0] - 1.0).abs() < 1e-6 && (sags[1] - lasts).abs() < 1e-6,
                "step {step}: {island:?}"
            );
        }
        assert!(!measure.note_load(&contact, &mut load, speed_for(0.5 * CALM_SHARE * DIRECT_SHARE)));
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
            for refinement in [1, factor] {
                let measure = LoadMeasure::new(true, 1.0 / 60.0, 4 * factor, refinement);
                let mut load = ContactLoad::default();
                measure.note_load(&contact, &mut load, great / factor as f32);
                assert!((load.sag / DIRECT_SHARE - 1.0).abs() < 1e-6, "{load:?}, {factor}, {refinement}");
            }
        }
    }
}
