//! What is done to all contacts of an effort, colour by colour: made into constraints, swept over, written back.
//!
//! The contacts of a colour move no body in common, so that several threads may each have some of its blocks.

use std::sync::Mutex;

use crate::body::{Bodies, Effort};
use crate::collision::{Contact, Contacts, SharedContacts};
use crate::compute::{self, BodyState, COLUMN, Crew, Job, Lane, Width, all_lines, lock};
use crate::resolution::constraint::StepResidual;
use crate::resolution::constraint_graph::{COLOURS, Colour, ConstraintGraph};
use crate::resolution::contact_block::{BlockEnd, ContactBlock, ContactEnds};
use crate::resolution::kernel::Kernel;
use crate::resolution::load::{LoadMeasure, Loads};

/// What it costs to make sixteen constraints, to sweep over them once, and to write them back, ns.
const PREPARE_COST: usize = 300;
const SWEEP_COST: usize = 40;
const FINISH_COST: usize = 200;

impl ConstraintGraph {
    /// Makes the constraints of a step from the contacts; stored impulses are multiplied by `scale`.
    pub(crate) fn prepare(
        &mut self,
        crew: &Crew,
        (effort, width): (Effort, Width),
        contacts: &Contacts,
        bodies: &Bodies,
        scale: f32,
    ) {
        for colour in self.section_mut(effort) {
            let count = colour.contacts.len().div_ceil(COLUMN);
            if count == 0 && colour.blocks.is_empty() {
                continue;
            }
            // Made only where there are not as many yet: a block is large.
            colour.blocks.resize_with(count, ContactBlock::default);
            colour.ends.resize_with(count, BlockEnd::default);
            let of_colour = &colour.contacts;
            crew.run((0..count, &mut colour.blocks[..]), PREPARE_COST, |(numbers, blocks)| {
                let first = numbers.start;
                compute::run(width, Prepare { first, of_colour, blocks, contacts, bodies, scale });
            });
        }
    }

    /// Writes impulses and separations back into the contacts; returns what is left wrong.
    pub(crate) fn finish(
        &mut self,
        crew: &Crew,
        (effort, width): (Effort, Width),
        states: &[BodyState],
        contacts: &mut Contacts,
        loads: &mut Loads,
    ) -> StepResidual {
        let residual = Mutex::new(StepResidual::default());
        for colour in self.section_mut(effort).iter_mut().filter(|colour| !colour.is_empty()) {
            let count = colour.blocks.len();
            let (of_colour, measure, contacts) = (&colour.contacts, loads.measure(), &contacts.shared());
            let places = ((0..count), (&colour.blocks[..], &mut colour.ends[..]));
            crew.run(places, FINISH_COST, |(numbers, (blocks, ends))| {
                let first = numbers.start;
                let residual = &residual;
                compute::run(
                    width,
                    Finish { first, of_colour, blocks, ends, states, contacts, measure, residual },
                );
            });
        }
        for colour in self.section(effort).iter().filter(|colour| !colour.is_empty()) {
            for (number, end) in colour.ends.iter().enumerate() {
                let indices = part(&colour.contacts, number);
                end.lasting.for_each(|place| loads.lasting.push(indices[place]));
                end.changing.for_each(|place| contacts.note_change(indices[place]));
            }
        }
        *lock(&residual)
    }

    /// Does something to every constraint of an effort, colour by colour: as many at a time as the width says, but
    /// for the overflow, whose contacts may share bodies.
    pub(crate) fn for_each(&mut self, crew: &Crew, (effort, width): (Effort, Width), kernel: &impl Kernel) {
        let section = self.section_mut(effort);
        if crew.is_alone() {
            return pass_over(section, width, kernel);
        }
        let (colours, overflow) = section.split_at_mut(COLOURS);
        for colour in overflow {
            BlockPass { contacts: colour.contacts.len(), blocks: &mut colour.blocks, kernel }.run::<f32>();
        }
        for colour in colours.iter_mut().filter(|colour| !colour.is_empty()) {
            let places = (0..colour.blocks.len(), &mut colour.blocks[..]);
            crew.run(places, SWEEP_COST, |(numbers, blocks)| {
                let contacts = colour.contacts.len().min(numbers.end * COLUMN) - numbers.start * COLUMN;
                compute::run(width, BlockPass { contacts, blocks, kernel });
            });
        }
    }
}

/// Does something to every constraint of some colours and their overflow. Compiled once for each kernel, which is large.
#[inline(never)]
pub(super) fn pass_over(section: &mut [Colour], width: Width, kernel: &impl Kernel) {
    compute::run(width, Pass { section, kernel });
}

/// A pass over all contacts of an effort.
struct Pass<'a, K> {
    section: &'a mut [Colour],
    kernel: &'a K,
}

/// A pass over some blocks of a colour, that have so many contacts.
struct BlockPass<'a, K> {
    contacts: usize,
    blocks: &'a mut [ContactBlock],
    kernel: &'a K,
}

impl<K: Kernel> Job for Pass<'_, K> {
    #[inline(always)]
    fn run<L: Lane>(self) {
        let (colours, overflow) = self.section.split_at_mut(COLOURS);
        for Colour { contacts, blocks, .. } in overflow.iter_mut().filter(|colour| !colour.is_empty()) {
            BlockPass { contacts: contacts.len(), blocks, kernel: self.kernel }.run::<f32>();
        }
        // One of its own stays in registers, whatever is written through it.
        let kernel = &self.kernel.clone();
        for Colour { contacts, blocks, .. } in colours.iter_mut().filter(|colour| !colour.is_empty()) {
            BlockPass { contacts: contacts.len(), blocks, kernel }.run::<L>();
        }
    }
}

impl<K: Kernel> Job for BlockPass<'_, K> {
    #[inline(always)]
    fn run<L: Lane>(self) {
        if L::WIDTH == 1 { one_by_one(self) } else { self.in_lanes::<L>() }
    }
}

impl<K: Kernel> BlockPass<'_, K> {
    #[inline(always)]
    fn in_lanes<L: Lane>(self) {
        let kernel = self.kernel.clone();
        for place in (0..self.contacts).step_by(L::WIDTH) {
            kernel.run::<L>(&mut self.blocks[place / COLUMN], place % COLUMN);
        }
    }
}

/// Compiled once for each kernel, and not within every width, which need it for the overflow.
#[inline(never)]
fn one_by_one(pass: BlockPass<'_, impl Kernel>) {
    pass.in_lanes::<f32>();
}

/// Those of a colour's contacts that are in its block of a number; none where there is no such block.
pub(super) fn part(contacts: &[u32], block: usize) -> &[u32] {
    contacts.chunks(COLUMN).nth(block).unwrap_or_default()
}

/// Makes the constraints of some blocks of a colour.
struct Prepare<'a> {
    /// Number of the first block.
    first: usize,
    /// Indices of the contacts of the colour.
    of_colour: &'a [u32],
    blocks: &'a mut [ContactBlock],
    contacts: &'a Contacts,
    bodies: &'a Bodies,
    scale: f32,
}

impl Job for Prepare<'_> {
    #[inline(always)]
    fn run<L: Lane>(self) {
        for (number, block) in (self.first..).zip(self.blocks) {
            for &index in part(self.of_colour, number + 2) {
                self.contacts.prefetch(index);
            }
            for &index in part(self.of_colour, number + 1) {
                self.contacts.prefetch_bodies(index, self.bodies);
            }
            let indices = part(self.of_colour, number);
            block.fill(indices, self.contacts, self.bodies, self.scale);
            for place in (0..indices.len()).step_by(L::WIDTH) {
                block.find_masses::<L>(place);
            }
        }
    }
}

/// Writes a step back into the contacts of some blocks of a colour.
struct Finish<'a> {
    /// Number of the first block.
    first: usize,
    /// Indices of the contacts of the colour.
    of_colour: &'a [u32],
    blocks: &'a [ContactBlock],
    ends: &'a mut [BlockEnd],
    states: &'a [BodyState],
    contacts: &'a SharedContacts<'a>,
    measure: LoadMeasure,
    /// What is left wrong.
    residual: &'a Mutex<StepResidual>,
}

impl Job for Finish<'_> {
    #[inline(always)]
    fn run<L: Lane>(self) {
        let mut ends = ContactEnds::default();
        for (number, (block, end)) in (self.first..).zip(self.blocks.iter().zip(self.ends)) {
            for &index in part(self.of_colour, number + 1) {
                self.contacts.prefetch(index, all_lines::<Contact>());
            }
            let indices = part(self.of_colour, number);
            for place in (0..indices.len()).step_by(L::WIDTH) {
                block.end::<L>(place, self.states, &mut ends);
            }
            *end = write_back(block, &ends, indices, self.contacts, self.measure);
        }
        let mut residual = lock(self.residual);
        *residual = residual.max(ends.residual());
    }
}

/// Writes the ends of the contacts of a block back into them. Compiled once, and not within every width.
#[inline(never)]
fn write_back(
    block: &ContactBlock,
    ends: &ContactEnds,
    indices: &[u32],
    contacts: &SharedContacts<'_>,
    measure: LoadMeasure,
) -> BlockEnd {
    let mut end = BlockEnd::default();
    for (place, &index) in indices.iter().enumerate() {
        contacts.change(index, |contact| {
            block.finish(place, ends, contact);
            end.lasting.set(place, measure.is_lasting(contact, ends.load.get(place)));
            let touches = contact.has_bounced || ends.touching.get(place);
            debug_assert_eq!(touches, contact.has_touched());
            end.changing.set(place, touches != contact.is_touching);
        });
    }
    end
}
