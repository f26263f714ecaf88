//! Cold contacts: those that begin to bear load, without impulses to warm start them. They are swept a few times more
//! than the others.

use crate::compute::{BodyState, COLUMN, Width};
use crate::resolution::constraint_graph::passes::pass_over;
use crate::resolution::constraint_graph::{BlockPlace, Colour, ConstraintGraph, DIRECT, Used};
use crate::resolution::kernel::Kernel;

/// A contact of two points and with friction that begins to bear load is relaxed so many times more: without impulses
/// to start from, one sweep lets friction turn the body instead of stopping it, and a box set on a slope keeps 7 mm/s
/// too much for as long as it slides. Two leave a tenth of that, four nothing.
const COLD_SWEEPS: u32 = 4;

/// The contacts of two points and with friction, that bear no load yet as the step begins.
#[derive(Clone, Debug, Default)]
pub(crate) struct ColdContacts {
    /// Blocks of the graph with some of them, by colour and number in it, in the order in which they are solved.
    blocks: Vec<BlockPlace>,
    /// Scratch: places of those that begin to in this substep, in the same order.
    loaded: Vec<(u32, u32)>,
    /// Scratch: copies of them, colour by colour, so that lanes are full of them. What a colour names its contacts by is
    /// their place in the colour that they are copied from.
    copies: Vec<Colour>,
}

impl ColdContacts {
    pub(crate) fn clear(&mut self) {
        self.blocks.clear();
    }

    /// Takes up a block of the graph, which has some.
    pub(crate) fn take_up(&mut self, place: BlockPlace) {
        self.blocks.push(place);
    }

    /// Sweeps over those that the last sweep has found to begin to bear load. What friction does now is this `part` of what it
    /// is to do in the substep, no unit: before the move a half, as the warm start after it does as much again.
    pub(crate) fn sweep(
        &mut self,
        graph: &mut ConstraintGraph,
        (width, part): (Width, f32),
        states: &mut [BodyState],
        kernel: &impl Kernel,
    ) {
        self.loaded.clear();
        for &block in &self.blocks {
            graph.newly_loaded(block, |place| self.loaded.push(place));
        }
        if !self.loaded.is_empty() {
            let used = self.copy_loaded(graph);
            for _ in 0..COLD_SWEEPS {
                pass_over((&mut self.copies, used), width, states, kernel);
            }
            self.give_back(graph, part);
        }
    }

    /// Copies them; returns which colours have some.
    fn copy_loaded(&mut self, graph: &ConstraintGraph) -> Used {
        self.copies.resize(DIRECT, Colour::default());
        for colour in &mut self.copies {
            colour.contacts.clear();
            colour.blocks.resize(0);
        }
        let mut used = Used::default();
        for &(colour, place) in &self.loaded {
            let (from_rows, from, from_place) = graph.block((colour, place));
            used.set(colour as usize, true);
            let Colour { contacts, blocks, .. } = &mut self.copies[colour as usize];
            let (number, to_place) = (contacts.len() / COLUMN, contacts.len() % COLUMN);
            if to_place == 0 {
                blocks.resize(number + 1);
            }
            let (to_rows, to) = blocks.all_mut();
            to_rows[number].copy(to_place, from_rows, from_place);
            to[number].copy(to_place, from, from_place);
            contacts.push(place);
        }
        used
    }

    /// Gives the contacts the impulses of their copies, of which those along the tangent are this `part`.
    fn give_back(&self, graph: &mut ConstraintGraph, part: f32) {
        for (colour, Colour { contacts, blocks, .. }) in (0_u32..).zip(&self.copies) {
            for (number, &place) in contacts.iter().enumerate() {
                let (block, place) = graph.block_mut((colour, place));
                let (_, copy) = blocks.get(number / COLUMN);
                block.copy_impulses(place, copy, number % COLUMN, part.recip());
            }
        }
    }
}
