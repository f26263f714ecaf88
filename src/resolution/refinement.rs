//! How many substeps a step takes: as many as are asked for, or up to eight times as many where those would let heavy bodies press light
//! ones flat. There are at most 256.
//!
//! Under a load F a light body of mass m and width L rocks with ω² = F/(m L). By [mass scaling](super::mass_scaling) it
//! turns no faster than substeps can follow, but it also moves along its contacts, and what lies on it with it. The overlap that sweeps would leave is a
//! measure of the load, see [`sag`]: so the loads of the last step say how fast bodies rock, and how short the substeps of the next have to be. What is solved directly does not matter: there nothing rocks that does not in truth. All
//! islands take as many substeps, as their bodies may meet within a step.
//!
//! [`sag`]: super::softness::sag

use core::cell::LazyCell;

use crate::body::Bodies;
use crate::collision::Contacts;
use crate::joint::Joints;
use crate::resolution::constraint_graph::ConstraintGraph;
use crate::resolution::islands::Connections;
use crate::resolution::load::{CALM_SHARE, CALM_STEPS, ContactLoad, Loads};
use crate::resolution::squeezes::Squeezes;
use crate::resolution::tier_rule::TierRule;

/// Substeps are refined where a body rocks faster than this, ω h, no unit. With 0.9 a pile of 3,000 bodies heaves as a whole, at 40 cm/s after twenty
/// seconds; with 0.6 nothing is calmer, and it takes a tenth longer.
const FASTEST_ROCKING: f32 = 0.75;

/// The same where a light body is crushed by a heavy one. With 0.75 the worst of six piles of 450 bodies with densities 1,000 : 1 is 19 mm deep after twenty
/// seconds, for 11, and they take two thirds of the time. With 0.4 piles with densities 20 : 1 take a third longer.
const FASTEST_ROCKING_OF_CRUSHED: f32 = 0.6;

/// By level: substeps for one that is asked for, rounded up where they come to no whole number. With 4 at most piles of 450 bodies with densities
/// 1,000 : 1 are 17 mm deep after twenty seconds, and with 8, which takes a fifth longer, 10.
const FACTORS: [f32; 7] = [1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0];

/// So many levels up there are twice as many substeps.
const LEVELS_OF_TWICE: usize = 2;

/// A body is crushed by one of more than so many times its mass, no unit. With 1, washers and drums take 1.6 times as long for nothing, as bodies of
/// one kind that are thrown about bear as much at times. With 1000, one in ten heaps of densities 78 : 1 is ten centimetres deep.
const CRUSHING_RATIO: f32 = 32.0;

/// Substeps that a step may have, asked for or refined. Settings that ask for more are refused.
pub(crate) const MOST_SUBSTEPS: u32 = 256;

/// Where more joints are awake, nothing asks for finer substeps: with 90 of them in a heap of 335 bodies they take three quarters of a step, and this
/// would take three times as long. With few, as of what is dragged, it is not seen.
const MOST_JOINTS: usize = 32;

/// How much finer substeps are than asked for.
#[derive(Debug, Default)]
pub(crate) struct Refinement {
    /// Which of the [`FACTORS`].
    level: usize,
    /// For how many steps in a row a lower one would have been enough.
    calm_steps: u8,
    /// Scratch.
    squeezes: Squeezes,
}

clone_into_buffers!(Refinement { level, calm_steps } scratch { squeezes });

/// The tables that say how fine substeps have to be.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RefinementTables<'a> {
    pub(crate) loads: &'a Loads,
    pub(crate) contacts: &'a Contacts,
    pub(crate) graph: &'a ConstraintGraph,
    pub(crate) joints: &'a Joints,
    pub(crate) bodies: &'a Bodies,
}

impl Refinement {
    /// How many substeps there are where so many are asked for.
    pub(crate) fn substeps(&self, asked: u32) -> u32 {
        ((asked as f32 * FACTORS[self.level]).ceil() as u32).min(MOST_SUBSTEPS)
    }

    /// Decides for the next step, from the loads of the last: for more substeps at once, for as few as are needed, but half
    /// as many at least, after [`CALM_STEPS`].
    pub(crate) fn decide(&mut self, rule: TierRule<'_>, tables: RefinementTables<'_>) {
        if !rule.adapts {
            (self.level, self.calm_steps) = (0, 0);
            return;
        }
        self.squeezes.clear();
        let excess = tables.largest_excess(rule, &mut self.squeezes);
        let excess = if tables.has_many_joints(excess / CALM_SHARE) { 0.0 } else { excess };
        let [needed, enough] = [excess, excess / CALM_SHARE].map(level_for);
        if needed > self.level {
            (self.level, self.calm_steps) = (needed, 0);
        } else if enough < self.level {
            self.calm_steps += 1;
            if self.calm_steps == CALM_STEPS {
                let half = self.level.saturating_sub(LEVELS_OF_TWICE);
                (self.level, self.calm_steps) = (half.max(enough), 0);
            }
        } else {
            self.calm_steps = 0;
        }
    }
}

impl RefinementTables<'_> {
    /// The excess of a contact is (ω h)² with as many substeps as are asked for, over the square of its limit. This is the largest of what is swept
    /// over, but [`CALM_SHARE`] at least, which asks for nothing.
    fn largest_excess(&self, rule: TierRule<'_>, squeezes: &mut Squeezes) -> f32 {
        let Self { loads, graph, .. } = self;
        // Islands are only looked at where any may be squeezed.
        let any_is_deep = LazyCell::new(|| loads.of_contact.iter().any(|load| load.is_deep()));
        let mut largest = CALM_SHARE;
        for &index in &loads.notable {
            let load = loads.of_contact[index as usize];
            let square = load.rocking_square(rule.substep_rate);
            let excess = |fastest: f32| square / (fastest * rule.substep_rate).powi(2);
            // Most are below what was found before, whatever else they are.
            let may_ask = excess(FASTEST_ROCKING_OF_CRUSHED) > largest && (load.lasts() || load.is_heavy());
            if !may_ask || !graph.sweeps(index) {
                continue;
            }
            let is_crushing = self.is_crushing(index, load);
            let excess = excess(if is_crushing { FASTEST_ROCKING_OF_CRUSHED } else { FASTEST_ROCKING });
            if excess > largest && !(*any_is_deep && self.is_squeezed(index, squeezes, rule)) {
                largest = excess;
            }
        }
        largest
    }

    /// Whether a contact crushes a light body by a heavy one, whether it trembles or not.
    fn is_crushing(&self, index: u32, load: ContactLoad) -> bool {
        let inverse_mass = |slot: u32| self.bodies.motions[slot as usize].inverse_mass;
        let [a, b] = self.contacts[index].slots.map(inverse_mass);
        let [of_heavy, of_light] = [a.min(b), a.max(b)];
        load.is_heavy() && of_heavy > 0.0 && of_light > CRUSHING_RATIO * of_heavy
    }

    /// Whether a contact is in an island that is squeezed.
    fn is_squeezed(&self, index: u32, squeezes: &mut Squeezes, rule: TierRule<'_>) -> bool {
        let connections = Connections { contacts: self.contacts, joints: self.joints };
        let slots = self.contacts[index].slots.into_iter();
        slots
            .filter(|&slot| self.bodies.is_dynamic(slot))
            .any(|slot| squeezes.contain(slot, self.loads, self.bodies, connections, rule))
    }

    /// Whether there are too many joints for what this excess asks for. They are counted only if it asks for something.
    fn has_many_joints(&self, excess: f32) -> bool {
        excess > 1.0 && self.joints.awake(self.bodies).nth(MOST_JOINTS).is_some()
    }
}

/// The lowest level that makes up for an excess, as (ω h)² goes with the square of the length of a substep; the highest, if none does.
fn level_for(excess: f32) -> usize {
    // Written so that NaN asks for nothing.
    FACTORS[..FACTORS.len() - 1].iter().filter(|&factor| excess > factor * factor).count()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// (ω h)² goes with the square of the length of a substep: with the factor it is below the limit, with half of it above.
    #[test]
    fn substeps_are_as_short_as_the_load_asks_for_and_no_shorter() {
        for step in 1..200 {
            let excess = 0.3 * step as f32;
            let level = level_for(excess);
            let excess_at = |level: usize| excess / FACTORS[level].powi(2);
            assert!(excess_at(level) <= 1.0, "{excess}: {level}");
            assert!(level == 0 || excess_at(level - 1) > 1.0, "{excess}: {level}");
        }
        let highest = FACTORS.len() - 1;
        assert_eq!([100.0, f32::INFINITY, f32::NAN].map(level_for), [highest, highest, 0]);
    }

    #[test]
    fn there_are_never_more_substeps_than_may_be_asked_for() {
        let refined = |level| Refinement { level, ..Refinement::default() };
        let asked = [1, 3, 4, 64, 100, 256];
        let highest = refined(FACTORS.len() - 1);
        assert_eq!(asked.map(|asked| highest.substeps(asked)), [8, 24, 32, 256, 256, 256]);
        assert_eq!(asked.map(|asked| refined(1).substeps(asked)), [2, 5, 6, 96, 150, 256]);
        assert_eq!(asked.map(|asked| refined(0).substeps(asked)), asked);
    }
}
