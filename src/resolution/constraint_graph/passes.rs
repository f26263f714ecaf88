//! What is done to all contacts, colour by colour: made into constraints, swept over, written back.
//!
//! The contacts of a colour move no body in common, so that several threads may each have some of its blocks.

use core::ops::Range;
use std::sync::Mutex;

use crate::collision::{Contacts, SharedContacts};
use crate::compute::{self, BodyState, COLUMN, Column, Crew, Job, Lane, Shared, Width, lock};
use crate::resolution::constraint::StepResidual;
use crate::resolution::constraint_graph::{Colour, ConstraintGraph, OVERFLOW, Used};
use crate::resolution::contact_block::{Beginning, BlockEnd, BlockStart, ContactBlock, ContactEnds};
use crate::resolution::follow::Followers;
use crate::resolution::follower::Follower;
use crate::resolution::kernel::Kernel;
use crate::resolution::load::{LoadMeasure, Loads};

/// What it costs to make sixteen constraints, to sweep over them once, and to write them back, ns.
const PREPARE_COST: usize = 300;
const SWEEP_COST: usize = 60;
const FINISH_COST: usize = 200;

impl ConstraintGraph {
    /// Makes the constraints of a step, and takes up those that follow the surface.
    pub(crate) fn prepare(
        &mut self,
        crew: &Crew,
        width: Width,
        from: Beginning<'_>,
        followers: &mut Followers,
    ) {
        followers.reset(self.colours.iter().map(|colour| colour.blocks_with_followers().len()).sum());
        let (followers, mut first_name) = (&followers.shared(), 0);
        for colour in &mut self.colours {
            let count = colour.contacts.len().div_ceil(COLUMN);
            if count == 0 && colour.blocks.is_empty() {
                continue;
            }
            // Made only where there are not as many yet: a block is large.
            colour.blocks.resize_with(count, ContactBlock::default);
            colour.starts.resize_with(count, BlockStart::default);
            colour.ends.resize_with(count, BlockEnd::default);
            let names = Names { first_name, blocks: colour.blocks_with_followers() };
            first_name += names.blocks.len();
            let (of_colour, names) = (&colour.contacts, &names);
            let places = (0..count, (&mut colour.blocks[..], &mut colour.starts[..]));
            crew.run(places, PREPARE_COST, |(numbers, (blocks, starts))| {
                let first = numbers.start;
                compute::run(width, Prepare { first, of_colour, blocks, starts, from, names, followers });
            });
        }
    }

    /// Writes impulses and separations back into the contacts; returns what is left wrong.
    pub(crate) fn finish(
        &mut self,
        crew: &Crew,
        width: Width,
        states: &[BodyState],
        contacts: &mut Contacts,
        (measure, loads): (LoadMeasure, &mut Loads),
    ) -> StepResidual {
        let residual = Mutex::new(StepResidual::default());
        for colour in self.colours.iter_mut().filter(|colour| !colour.is_empty()) {
            let count = colour.blocks.len();
            let (of_colour, contacts) = (&colour.contacts, &contacts.shared());
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
        for colour in self.colours.iter().filter(|colour| !colour.is_empty()) {
            for (number, end) in colour.ends.iter().enumerate() {
                let indices = part(&colour.contacts, number);
                end.lasting.for_each(|place| loads.lasting.push(indices[place]));
                end.changing.for_each(|place| contacts.note_change(indices[place]));
            }
        }
        *lock(&residual)
    }

    /// Does something to every constraint that is swept over, colour by colour: as many at a time as the width says, but
    /// for the overflow, whose contacts may share bodies.
    pub(crate) fn for_each_swept(&mut self, crew: &Crew, width: Width, kernel: &impl Kernel) {
        self.for_each_of(self.used.swept(), crew, width, kernel);
    }

    /// Does something to every constraint that moves no body: contacts that are solved directly may share bodies.
    pub(crate) fn for_each(&mut self, crew: &Crew, width: Width, kernel: &impl Kernel) {
        self.for_each_of(self.used, crew, width, kernel);
    }

    fn for_each_of(&mut self, used: Used, crew: &Crew, width: Width, kernel: &impl Kernel) {
        if crew.is_alone() {
            return pass_over((&mut self.colours, used), width, kernel);
        }
        if used.has_overflow() {
            BlockPass::over(&mut self.colours[OVERFLOW], kernel).run::<f32>();
        }
        for colour in used.colours() {
            let colour = &mut self.colours[colour];
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
pub(super) fn pass_over((colours, used): (&mut [Colour], Used), width: Width, kernel: &impl Kernel) {
    compute::run(width, Pass { colours, used, kernel });
}

/// A pass over the contacts of some colours.
struct Pass<'a, K> {
    colours: &'a mut [Colour],
    used: Used,
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
        let Self { colours, used, kernel } = self;
        if used.has_overflow() {
            BlockPass::over(&mut colours[OVERFLOW], kernel).run::<f32>();
        }
        // One of its own stays in registers, whatever is written through it.
        let kernel = &kernel.clone();
        for colour in used.colours() {
            BlockPass::over(&mut colours[colour], kernel).run::<L>();
        }
    }
}

impl<K: Kernel> Job for BlockPass<'_, K> {
    #[inline(always)]
    fn run<L: Lane>(self) {
        if L::WIDTH == 1 { one_by_one(self) } else { self.in_lanes::<L>() }
    }
}

impl<'a, K: Kernel> BlockPass<'a, K> {
    #[inline(always)]
    fn over(Colour { contacts, blocks, .. }: &'a mut Colour, kernel: &'a K) -> Self {
        Self { contacts: contacts.len(), blocks, kernel }
    }

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

/// Those of a colour's contacts that are in its block of a number.
fn part(contacts: &[u32], block: usize) -> &[u32] {
    let from_block = from_block(contacts, block);
    &from_block[..from_block.len().min(COLUMN)]
}

/// These, and those in the blocks after it.
fn from_block(contacts: &[u32], block: usize) -> &[u32] {
    &contacts[block * COLUMN..]
}

/// Makes the constraints of some blocks of a colour.
struct Prepare<'a> {
    /// Number of the first block.
    first: usize,
    /// Indices of the contacts of the colour.
    of_colour: &'a [u32],
    blocks: &'a mut [ContactBlock],
    starts: &'a mut [BlockStart],
    from: Beginning<'a>,
    names: &'a Names,
    followers: &'a Shared<'a, Follower<Column>>,
}

/// What the blocks of a colour call those of their contacts that follow the surface.
struct Names {
    first_name: usize,
    /// Numbers of the blocks with some.
    blocks: Range<usize>,
}

impl Names {
    fn of(&self, block: usize) -> Option<usize> {
        self.blocks.contains(&block).then(|| self.first_name + block - self.blocks.start)
    }
}

impl Job for Prepare<'_> {
    #[inline(always)]
    fn run<L: Lane>(self) {
        for (number, (block, start)) in (self.first..).zip(self.blocks.iter_mut().zip(self.starts)) {
            let indices = part(self.of_colour, number);
            *start = block.fill(from_block(self.of_colour, number), self.from);
            if let Some(name) = self.names.of(number) {
                start.found_anew = self.followers.change(name, |followers| {
                    block.take_up_followers((name as u32, followers), indices, self.from)
                });
            } else {
                let mut contacts = indices.iter().map(|&index| &self.from.contacts[index]);
                debug_assert!(!contacts.any(|contact| contact.follows), "sorted by kind");
            }
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
            for place in (0..part(self.of_colour, number).len()).step_by(L::WIDTH) {
                block.end::<L>(place, self.states, &mut ends);
            }
            *end = write_back(block, &ends, from_block(self.of_colour, number), self.contacts, self.measure);
        }
        let mut residual = lock(self.residual);
        *residual = residual.max(ends.residual());
    }
}

/// Writes the ends of the contacts of a block back into them, the first of a `list`. Compiled once, and not within every
/// width.
#[inline(never)]
fn write_back(
    block: &ContactBlock,
    ends: &ContactEnds,
    list: &[u32],
    contacts: &SharedContacts<'_>,
    measure: LoadMeasure,
) -> BlockEnd {
    let mut end = BlockEnd::default();
    for (place, &index) in list.iter().take(COLUMN).enumerate() {
        contacts.prefetch_solved(list, place);
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
