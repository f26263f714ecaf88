//! Which contacts sag, told at the end of each step.
//!
//! A load is told by the overlap that sweeps leave under it at rest, see [`sag`], as a share of the width of the thinner
//! body.

use crate::body::Bodies;
use crate::collision::Contact;
use crate::resolution::softness::sag;

/// Overlap at rest, as a share of the width of the thinner body, from which an island is solved directly.
pub(super) const DIRECT_SHARE: f32 = 0.0125;

/// Substeps per second that sags are told for, if there are no fewer, 1/s: told for more, stacks at high rates lean until
/// they fall.
pub(super) const USUAL_RATE: f32 = 240.0;

/// What a step says of how the islands are to be solved in the next.
#[derive(Clone, Debug, Default)]
pub(crate) struct Loads {
    /// Indices of the contacts that would sag too far under sweeps.
    pub(crate) sagging: Vec<u32>,
    /// Contacts that begin between bodies at rest, see [`begins_at_rest`].
    pub(crate) begun_at_rest: Vec<u32>,
    /// Slots of the bodies of islands that the direct solve could not solve.
    pub(crate) unsolved: Vec<u32>,
}

impl Loads {
    /// Forgets what is beyond so many contacts and slots of bodies.
    pub(crate) fn trim(&mut self, contacts: usize, slots: usize) {
        self.sagging.retain(|&index| (index as usize) < contacts);
        self.begun_at_rest.retain(|&index| (index as usize) < contacts);
        self.unsolved.retain(|&slot| (slot as usize) < slots);
    }

    /// Begins a step.
    pub(crate) fn clear(&mut self) {
        self.sagging.clear();
        self.begun_at_rest.clear();
        self.unsolved.clear();
    }
}

/// How loads are told.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LoadMeasure {
    /// One over the length of the substep that sags are told for, 1/s.
    per_substep: f32,
    /// How many substeps of now that one takes, no unit; 0 where loads do not matter.
    factor: f32,
}

impl LoadMeasure {
    /// For substeps of length 1/`per_substep`, s. More of them than usual do not make an island less worth its direct
    /// solve: they are asked for to have less error. Nothing counts as a load unless `loads_matter`.
    pub(crate) fn new(loads_matter: bool, per_substep: f32) -> Self {
        let usual = per_substep.min(USUAL_RATE);
        Self { per_substep: usual, factor: if loads_matter { per_substep / usual } else { 0.0 } }
    }

    /// Whether a contact, whose greatest k λ is `speed`, m/s, would sag too far under sweeps. What slides or turns has no
    /// lasting load.
    #[inline(always)]
    pub(crate) fn sags(self, contact: &Contact, speed: f32) -> bool {
        contact.holds_still && sag(self.factor * speed, self.per_substep) > DIRECT_SHARE * contact.thickness
    }
}

/// Whether a contact has borne nothing yet, and neither body moves: so begins what is set up at rest.
pub(crate) fn begins_at_rest(contact: &Contact, bodies: &Bodies) -> bool {
    let stands = |slot: u32| !bodies.state(slot).is_moving();
    contact.manifold.points().iter().all(|point| point.normal_impulse == 0.0)
        && contact.slots.into_iter().all(stands)
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
    fn more_substeps_do_not_change_what_sags() {
        let contact = contact();
        for factor in [1.0, 2.0, 10.0] {
            let measure = LoadMeasure::new(true, factor * USUAL_RATE);
            for (share, sags) in [(0.99, false), (1.01, true)] {
                let speed = speed_for(share * DIRECT_SHARE) / factor;
                assert_eq!(measure.sags(&contact, speed), sags, "{share} with {factor} times the substeps");
            }
        }
    }

    #[test]
    fn nothing_sags_that_moves_or_where_loads_do_not_matter() {
        let (mut contact, great) = (contact(), speed_for(2.0 * DIRECT_SHARE));
        assert!(!LoadMeasure::new(false, USUAL_RATE).sags(&contact, great));
        contact.holds_still = false;
        assert!(!LoadMeasure::new(true, USUAL_RATE).sags(&contact, great));
    }
}
