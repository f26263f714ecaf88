//! Islands that are squeezed: walls leave their bodies less room than they need, as a press does that closes on a heap.
//!
//! What lies on walls presses with what forces give to it. What is squeezed presses from wall to wall, by far more than that, and no solve makes
//! room for it: with more effort bodies are pressed through walls, or shot out. So such islands are swept, in as many substeps as were asked
//! for: their contacts yield, and share the overlap.

use crate::body::Bodies;
use crate::math::Vec2;
use crate::resolution::islands::{Connections, find_island};
use crate::resolution::softness::DEEP_SHARE;
use crate::store::BitSet;

/// An island is squeezed if a wall bears so many times what forces give to all of its bodies, no unit, and any are deep in each other. Levers
/// and wedges press as hard, but keep their bodies apart. In presses it is 10 to 1,000, and with 50 ten times as many bodies leave them; with 2
/// no fewer do.
const MOST_THRUST: f32 = 5.0;

/// Asks whether the island of the body in a slot is squeezed.
pub(crate) type AskSqueezed<'a> = dyn FnMut(u32, Connections<'_>) -> bool + 'a;

/// Which of the islands that were asked for in this step are squeezed.
#[derive(Clone, Debug, Default)]
pub(crate) struct Squeezes {
    /// Bodies of the islands that were looked at, and those of them that are squeezed.
    seen: BitSet,
    squeezed: BitSet,
    /// Scratch.
    island: Vec<u32>,
}

impl Squeezes {
    /// Begins a step. What it returns answers by the impulses of the last substep, of length `h`, s, and by how forces accelerate the bodies in
    /// their slots, m/s².
    pub(crate) fn begin<'a>(
        &'a mut self,
        bodies: &'a Bodies,
        h: f32,
        acceleration: impl Fn(u32) -> Vec2 + 'a,
    ) -> impl FnMut(u32, Connections<'_>) -> bool + 'a {
        self.seen.clear();
        self.squeezed.clear();
        move |slot, connections| {
            if !self.seen.contains(slot) {
                self.island.clear();
                find_island(slot, bodies, connections, &mut self.seen, &mut self.island, |_, _| ());
                let given = |slot: u32| h * mass_times_acceleration(bodies, slot, acceleration(slot));
                let given = self.island.iter().map(|&slot| given(slot)).sum();
                if is_squeezed(&self.island, bodies, connections, given) {
                    self.island.iter().for_each(|&slot| _ = self.squeezed.insert(slot));
                }
            }
            self.squeezed.contains(slot)
        }
    }
}

/// The force on the body in `slot`, N, and what turns it about with a wheel that it rides on, m ω × v.
fn mass_times_acceleration(bodies: &Bodies, slot: u32, by_forces: Vec2) -> f32 {
    let state = bodies.state(slot);
    let by_turning = state.velocity.to_vec2() * state.angular_velocity;
    (by_forces.length() + by_turning.length()) / bodies.motions[slot as usize].inverse_mass
}

/// Whether an island is squeezed to whose bodies forces have given so much in the last substep, N s. Joints press too, and what by is not known
/// here: what is joined is not squeezed.
fn is_squeezed(
    island: &[u32],
    bodies: &Bodies,
    Connections { contacts, joints }: Connections<'_>,
    given: f32,
) -> bool {
    let (mut greatest, mut is_deep) = (0.0_f32, false);
    for contact in
        island.iter().flat_map(|&slot| contacts.of_body(bodies, slot)).map(|index| &contacts[index])
    {
        is_deep |= contact.penetration() > DEEP_SHARE * contact.thickness;
        if contact.slots.into_iter().any(|slot| !bodies.is_dynamic(slot)) {
            greatest = greatest.max(contact.manifold.points().iter().map(|point| point.normal_impulse).sum());
        }
    }
    is_deep && greatest > MOST_THRUST * given && !island.iter().any(|&slot| joints.hold(slot))
}
