//! How many substeps a step takes: as many as are asked for, or two or four times as many where sweeps over those would press light
//! bodies flat.
//!
//! The overlap that sweeps leave under a load is in proportion to the length of a substep, see [`sag`]. So
//! the loads that the last step has told say how short the substeps of the next have to be. What is solved directly does not sag.
//! All islands take as many substeps, as their bodies may meet within a step.
//!
//! [`sag`]: super::softness::sag

use crate::joint::Joints;
use crate::resolution::constraint_graph::ConstraintGraph;
use crate::resolution::load::{CALM_SHARE, Loads, USUAL_RATE};
use crate::resolution::tiers::TierRule;

/// Substeps are shorter where a contact would sag by more than this share of the width of the thinner body, no unit. In piles
/// of bodies of one density none does by more than 0.5, and they come to rest without: a tenth of it would have most of them take
/// four times as many substeps. In a pile of densities 78 : 1 some sag by 1 to 5, rattle, and are pushed out.
const LARGEST_SAG: f32 = 0.7;

/// A step takes no more than so many times the substeps that are asked for, which is a power of two. With 2, twice as many bodies of a
/// pile still move after ten seconds; 8 leave half of the overlap where masses differ 10,000 : 1, for another half of the time.
const LARGEST_FACTOR: u32 = 4;

/// Fewer substeps must have been enough for so many steps in a row before a step takes fewer.
const CALM_STEPS: u8 = 30;

/// A joint takes as much time in a substep as so many contacts. Where joints take more than contacts substeps are not refined: a step of
/// 335 bodies with 90 joints would take three times as long, and be seen to.
const CONTACTS_PER_JOINT: usize = 25;

/// How many substeps there are for one that is asked for.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Refinement {
    factor: u32,
    /// For how many steps half of that would have been enough.
    calm_steps: u8,
}

impl Default for Refinement {
    fn default() -> Self {
        Self { factor: 1, calm_steps: 0 }
    }
}

impl Refinement {
    pub(crate) fn factor(self) -> u32 {
        self.factor
    }

    /// Decides for the next step, from the loads of the last.
    pub(crate) fn decide(&mut self, rule: TierRule, loads: &Loads, graph: &ConstraintGraph, joints: &Joints) {
        if !rule.adapts {
            *self = Self::default();
            return;
        }
        let has_many_joints = CONTACTS_PER_JOINT * joints.len() > graph.len();
        let sag = if has_many_joints { 0.0 } else { largest_sag(rule, loads, graph) };
        if factor_for(sag) > self.factor {
            *self = Self { factor: factor_for(sag), calm_steps: 0 };
        } else if factor_for(sag / CALM_SHARE) < self.factor {
            self.calm_steps += 1;
            if self.calm_steps == CALM_STEPS {
                *self = Self { factor: self.factor / 2, calm_steps: 0 };
            }
        } else {
            self.calm_steps = 0;
        }
    }
}

/// How many times as many substeps let a sag, as a share of the thinner body, not be too large.
fn factor_for(sag: f32) -> u32 {
    let mut factor = 1;
    while factor < LARGEST_FACTOR && sag > LARGEST_SAG * factor as f32 {
        factor *= 2;
    }
    factor
}

/// The largest sag of what is swept over, with as many substeps as are asked for, as a share of the width of the thinner body.
fn largest_sag(rule: TierRule, loads: &Loads, graph: &ConstraintGraph) -> f32 {
    let is_swept = |index: &&u32| graph.home(**index).is_some_and(|home| !home.is_solved_directly());
    let sags = loads.lasting.iter().filter(is_swept).map(|&index| loads.of_contact[index as usize].sag);
    // They are told for no more substeps than usual.
    sags.fold(0.0, f32::max) * rule.substep_rate.min(USUAL_RATE) / rule.substep_rate
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Sag is in proportion to the length of a substep: with the factor it is below the limit, with half of it above.
    #[test]
    fn substeps_are_as_short_as_the_sag_asks_for_and_no_shorter() {
        for step in 1..200 {
            let sag = 0.01 * step as f32;
            let factor = factor_for(sag);
            assert!(sag / factor as f32 <= LARGEST_SAG, "{sag}: {factor}");
            assert!(factor == 1 || sag / (factor / 2) as f32 > LARGEST_SAG, "{sag}: {factor}");
        }
        assert_eq!(
            [factor_for(100.0), factor_for(f32::INFINITY), factor_for(f32::NAN)],
            [LARGEST_FACTOR, LARGEST_FACTOR, 1]
        );
    }
}
