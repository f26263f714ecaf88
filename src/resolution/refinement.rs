//! How many substeps a step takes: as many as are asked for, or two, four or eight times as many where those would let heavy bodies press light
//! ones flat. There are at most 256: where that leaves no room for the factor, it is the largest whole one that fits, which may be another number,
//! such as 3 where 80 are asked for.
//!
//! Under a load F a light body of mass m and width L rocks with ω² = F/(m L). Where a substep h is too long to follow that, it is shaken, and its
//! load never lasts. The overlap that sweeps would leave is a measure of the load, see [`sag`]: so the loads of the last step say how fast bodies
//! rock, and how short the substeps of the next have to be. What is solved directly does not matter: there nothing rocks that does not in truth. All
//! islands take as many substeps, as their bodies may meet within a step.
//!
//! [`sag`]: super::softness::sag

use crate::body::Bodies;
use crate::collision::Contacts;
use crate::joint::Joints;
use crate::resolution::constraint_graph::ConstraintGraph;
use crate::resolution::islands::Connections;
use crate::resolution::load::{CALM_SHARE, CALM_STEPS, ContactLoad, Loads};
use crate::resolution::squeezes::Squeezes;
use crate::resolution::tier_rule::TierRule;

/// Substeps are refined where a body rocks faster than this, ω h, no unit. In piles of densities 78 : 1 it comes to 3 without, and bodies rattle. With
/// 1.1 the worst of ten piles of 300 bodies with densities 4 : 1 is 68 mm deep after ten seconds, for 17; with 0.75 it is 13, and piles of one
/// density take more substeps for most of the time.
const FASTEST_ROCKING: f32 = 0.9;

/// The same where a light body is crushed by a heavy one. With 0.8 piles of 200 bodies with densities 20 : 1 are 15 mm deep after ten seconds, for
/// 7; with 0.4 6, and they take a third longer.
const FASTEST_ROCKING_OF_CRUSHED: f32 = 0.6;

/// Substeps for one that is asked for, at most; a power of two. Of twenty piles of 450 bodies with densities 78 : 1 the worst is 76 mm deep after
/// ten seconds with 4, and 7 mm with this, which takes a third longer.
const LARGEST_FACTOR: u32 = 8;

/// A body is crushed by one of more than so many times its mass, no unit. With 1, washers and drums take 1.6 times as long for nothing, as bodies of
/// one kind that are thrown about bear as much at times. With 1000, one in ten heaps of densities 78 : 1 is ten centimetres deep.
const CRUSHING_RATIO: f32 = 32.0;

/// Substeps that a step may have, asked for or refined. Settings that ask for more are refused.
pub(crate) const MOST_SUBSTEPS: u32 = 256;

/// Where more joints are awake, substeps are not refined: with 90 of them in a heap of 335 bodies they take three quarters of a step, and this
/// would take three times as long. With few, as of what is dragged, it is not seen.
const MOST_JOINTS: usize = 32;

/// How much finer substeps are than asked for.
#[derive(Debug)]
pub(crate) struct Refinement {
    /// Substeps for one that is asked for: a power of two, up to [`LARGEST_FACTOR`].
    factor: u32,
    /// For how many steps in a row half of that would have been enough.
    calm_steps: u8,
    /// Scratch.
    squeezes: Squeezes,
}

clone_into_buffers!(Refinement { factor, calm_steps } scratch { squeezes });

impl Default for Refinement {
    fn default() -> Self {
        Self { factor: 1, calm_steps: 0, squeezes: Squeezes::default() }
    }
}

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
        asked * self.factor.min(MOST_SUBSTEPS / asked)
    }

    /// Decides for the next step, from the loads of the last: for more substeps at once, for half as many after [`CALM_STEPS`].
    pub(crate) fn decide(&mut self, rule: TierRule<'_>, tables: RefinementTables<'_>) {
        if !rule.adapts {
            (self.factor, self.calm_steps) = (1, 0);
            return;
        }
        self.squeezes.clear();
        let excess = tables.largest_excess(rule, &mut self.squeezes);
        let needed = |excess| if tables.has_many_joints(excess) { 1 } else { factor_for(excess) };
        if needed(excess) > self.factor {
            (self.factor, self.calm_steps) = (needed(excess), 0);
        } else if needed(excess / CALM_SHARE) < self.factor {
            self.calm_steps += 1;
            if self.calm_steps == CALM_STEPS {
                (self.factor, self.calm_steps) = (self.factor / 2, 0);
            }
        } else {
            self.calm_steps = 0;
        }
    }
}

impl RefinementTables<'_> {
    /// The excess of a contact is (ω h)² with as many substeps as are asked for, in units of what it may be. This is the largest of what is swept
    /// over.
    fn largest_excess(&self, rule: TierRule<'_>, squeezes: &mut Squeezes) -> f32 {
        let Self { loads, graph, .. } = self;
        let is_swept = |index: &u32| graph.home(*index).is_some_and(|home| !home.is_solved_directly());
        let mut largest = 0.0_f32;
        for index in loads.notable.iter().copied().filter(is_swept) {
            let load = loads.of_contact[index as usize];
            let fastest = if self.is_crushing(index, load) {
                FASTEST_ROCKING_OF_CRUSHED
            } else if load.lasts() || load.is_heavy() {
                FASTEST_ROCKING
            } else {
                continue;
            };
            let excess = load.rocking_square(rule.substep_rate) / (fastest * rule.substep_rate).powi(2);
            // The island is only looked at where something is asked for.
            if excess > largest && (excess <= CALM_SHARE || !self.is_squeezed(index, squeezes, rule)) {
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
            .any(|slot| squeezes.contain(slot, self.bodies, connections, rule))
    }

    /// Whether there are too many joints for what this excess asks for. They are counted only if it asks for something.
    fn has_many_joints(&self, excess: f32) -> bool {
        excess > 1.0 && self.joints.awake(self.bodies).nth(MOST_JOINTS).is_some()
    }
}

/// The least factor that makes up for an excess, as (ω h)² goes with the square of the length of a substep.
fn factor_for(excess: f32) -> u32 {
    let mut factor = 1;
    while factor < LARGEST_FACTOR && excess > (factor * factor) as f32 {
        factor *= 2;
    }
    factor
}

#[cfg(test)]
mod tests {
    use super::*;

    /// (ω h)² goes with the square of the length of a substep: with the factor it is below the limit, with half of it above.
    #[test]
    fn substeps_are_as_short_as_the_load_asks_for_and_no_shorter() {
        for step in 1..200 {
            let excess = 0.3 * step as f32;
            let factor = factor_for(excess);
            let square = (factor * factor) as f32;
            assert!(excess / square <= 1.0, "{excess}: {factor}");
            assert!(factor == 1 || excess / (0.25 * square) > 1.0, "{excess}: {factor}");
        }
        assert_eq!(
            [factor_for(100.0), factor_for(f32::INFINITY), factor_for(f32::NAN)],
            [LARGEST_FACTOR, LARGEST_FACTOR, 1]
        );
    }

    #[test]
    fn there_are_never_more_substeps_than_may_be_asked_for() {
        let refined = Refinement { factor: LARGEST_FACTOR, ..Refinement::default() };
        assert_eq!(
            [1, 4, 64, 100, 128, 256].map(|asked| refined.substeps(asked)),
            [8, 32, 256, 200, 256, 256]
        );
    }
}
