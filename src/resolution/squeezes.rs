//! Islands that are squeezed: walls leave their bodies less room than they need, as a press does that closes on a heap.
//!
//! What lies on walls presses with what forces give to it. What is squeezed presses from wall to wall, by far more than that, and no solve makes
//! room for it: with more effort bodies are pressed through walls, or shot out. So such islands are swept, those that are solved directly once
//! they have been squeezed for some steps, and ask for no finer substeps: their contacts yield, and share the overlap. Kinematic bodies are walls too.

use crate::body::Bodies;
use crate::math::Vec2;
use crate::resolution::islands::{Connections, find_island};
use crate::resolution::load::{IslandLoad, Loads};
use crate::resolution::tier_rule::TierRule;
use crate::store::BitSet;

/// An island is squeezed if a contact with a wall bears so many times what forces give to all of its bodies, no unit, and any of its contacts with a great load are
/// deep. Levers and wedges press as hard, but their contacts are not deep. Where all walls together give the bodies more than forces do, that counts: it is no squeeze
/// that a kilogram which falls on a stack of 10 g pieces presses the ground by hundreds of times all weight.
const MOST_THRUST: f32 = 5.0;

/// Whether an island that bears a load is squeezed. Joints press too, by how much is not known here: what is joined is taken for not squeezed.
pub(super) fn is_squeezed(
    island: &[u32],
    load: IslandLoad,
    bodies: &Bodies,
    Connections { contacts, joints }: Connections<'_>,
    rule: TierRule<'_>,
) -> bool {
    if !load.is_deep {
        return false;
    }
    let (mut greatest, mut sum) = (0.0_f32, Vec2::ZERO);
    for &slot in island {
        for contact in contacts.of_body(bodies, slot).map(|index| &contacts[index]) {
            if !bodies.is_dynamic(contact.other(slot)) {
                let points = || contact.manifold.points().iter();
                let on_b = points().map(|point| contact.manifold.impulse_on_b(point)).sum::<Vec2>();
                sum += if contact.slots[1] == slot { on_b } else { -on_b };
                greatest = greatest.max(points().map(|point| point.normal_impulse).sum());
            }
        }
    }
    let given = (rule.impulses_of * rule.weight(island)).max(sum.length());
    greatest > MOST_THRUST * given && !island.iter().any(|&slot| joints.hold(slot))
}

/// The islands that were asked for, and which of them are squeezed.
#[derive(Clone, Debug, Default)]
pub(super) struct Squeezes {
    seen: BitSet,
    squeezed: BitSet,
    /// Scratch.
    island: Vec<u32>,
}

impl Squeezes {
    /// Forgets what was asked for in another step.
    pub(super) fn clear(&mut self) {
        self.seen.clear();
        self.squeezed.clear();
    }

    /// Whether the island of the body in a slot is squeezed.
    pub(super) fn contain(
        &mut self,
        slot: u32,
        loads: &Loads,
        bodies: &Bodies,
        connections: Connections<'_>,
        rule: TierRule<'_>,
    ) -> bool {
        if !self.seen.contains(slot) {
            self.island.clear();
            let mut load = IslandLoad::default();
            let look_at = |index: u32, _: &_| load.add(loads.of_contact[index as usize]);
            find_island(slot, bodies, connections, &mut self.seen, &mut self.island, look_at);
            if is_squeezed(&self.island, load, bodies, connections, rule) {
                self.island.iter().for_each(|&slot| _ = self.squeezed.insert(slot));
            }
        }
        self.squeezed.contains(slot)
    }
}
