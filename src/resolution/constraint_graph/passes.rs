//! What is done to all contacts, colour by colour: made into constraints, swept over, written back.
//!
//! The contacts of a colour move no body in common, so that several threads may each have some of its blocks.

use std::sync::Mutex;

use crate::collision::{ChosenContacts, Contacts};
use crate::compute::{
    self, BlocksOver, BodyState, ByColumn, COLUMN, Chosen, Executor, Job, Lane, RowPairs, lock,
};
use crate::resolution::constraint::StepResidual;
use crate::resolution::constraint_graph::colour::{Colour, DIRECT, GraphIndex, OVERFLOW};
use crate::resolution::constraint_graph::{ConstraintGraph, Used};
use crate::resolution::contact_block::{Beginning, ContactBlock, Residuals};
use crate::resolution::kernel::Kernel;
use crate::resolution::load::{ContactLoad, LoadMeasure, Loads};

/// What it costs to make sixteen constraints, to sweep over them once, and to write them back, ns.
const PREPARE_COST: usize = 300;
const SWEEP_COST: usize = 60;
const FINISH_COST: usize = 200;

impl ConstraintGraph {
    /// Makes the constraints of a step.
    pub(crate) fn prepare(&mut self, executor: Executor<'_>, from: Beginning<'_>) {
        let Self { colours, row_marks, .. } = self;
        for colour in colours {
            let count = colour.contacts.len().div_ceil(COLUMN);
            if count == 0 && colour.blocks.len() == 0 {
                continue;
            }
            // Made only where there are not as many yet: a block is large.
            colour.blocks.resize(count);
            let parts = (ByColumn(&colour.contacts[..]), colour.blocks.all_mut());
            executor.run(parts, PREPARE_COST, |(contacts, (rows, blocks))| Prepare {
                contacts: contacts.0,
                rows,
                blocks,
                from,
            });
            colour.blocks.seal((!executor.pool.is_alone()).then_some(&mut *row_marks));
        }
    }

    /// Writes impulses and separations back into the contacts; returns what is left wrong.
    pub(crate) fn finish(
        &mut self,
        executor: Executor<'_>,
        states: &[BodyState],
        contacts: &mut Contacts,
        measure: LoadMeasure,
        loads: &mut Loads,
    ) -> StepResidual {
        let residual = Mutex::new(StepResidual::default());
        for colour in self.colours.iter_mut().filter(|colour| !colour.is_empty()) {
            let residual = &residual;
            let contacts = ByColumn(contacts.chosen(&colour.contacts));
            let loads = ByColumn(Chosen::new(&mut loads.of_contact, &colour.contacts));
            let parts = ((contacts, loads), colour.blocks.all_mut());
            executor.run(parts, FINISH_COST, |((contacts, loads), (rows, blocks))| {
                let (contacts, loads) = (contacts.0, loads.0);
                Finish { contacts, loads, rows, blocks, states, measure, residual }
            });
        }
        for colour in self.colours.iter().filter(|colour| !colour.is_empty()) {
            for (number, block) in colour.blocks.all().1.iter().enumerate() {
                let indices = &colour.contacts[number * COLUMN..];
                block.marks.notably_loaded.for_each(|place| loads.notable.push(indices[place]));
                block.marks.changing.for_each(|place| contacts.note_change(indices[place]));
            }
        }
        *lock(&residual)
    }

    /// Does something to every constraint that is swept over: first to the overflow, whose contacts may share bodies, one
    /// at a time; then colour by colour.
    pub(crate) fn for_each_swept(
        &mut self,
        executor: Executor<'_>,
        states: &mut [BodyState],
        kernel: &impl Kernel,
    ) {
        let (colours, used) = (&mut self.colours, self.used.swept());
        if executor.pool.is_alone() {
            return compute::run(executor.width, Pass { colours, used, states, kernel });
        }
        if used.has_overflow() {
            one_by_one(BlockPass::over(&mut colours[OVERFLOW], states, kernel));
        }
        for colour in used.colours() {
            let Colour { contacts, blocks, .. } = &mut colours[colour];
            let parts = (ByColumn(0..contacts.len()), blocks.over(states));
            executor.run(parts, SWEEP_COST, |(contacts, blocks)| {
                let count = contacts.0.len();
                BlockPass { count, blocks, kernel }
            });
        }
    }

    /// Does something to the contact at a place of the graph.
    pub(crate) fn run_at(&mut self, at: GraphIndex, states: &mut [BodyState], kernel: &impl Kernel) {
        let mut blocks = self.colours[at.colour as usize].blocks.over(states);
        let (block, mut states) = blocks.get_mut(at.block().block as usize);
        kernel.run::<f32>(block, &mut states, at.place());
    }

    /// Does something that moves no body to every constraint: what is solved directly may share bodies.
    pub(crate) fn for_each(
        &mut self,
        executor: Executor<'_>,
        states: &mut [BodyState],
        kernel: &impl Kernel,
    ) {
        self.for_each_swept(executor, states, kernel);
        if self.solves_directly() {
            compute::run(executor.width, BlockPass::over(&mut self.colours[DIRECT], states, kernel));
        }
    }
}

/// A pass over all that is swept over, in one go: small worlds have few contacts in many colours.
struct Pass<'a, K> {
    colours: &'a mut [Colour],
    used: Used,
    states: &'a mut [BodyState],
    kernel: &'a K,
}

impl<K: Kernel> Job for Pass<'_, K> {
    #[inline(always)]
    fn run<L: Lane>(self) {
        let Self { colours, used, states, kernel } = self;
        if used.has_overflow() {
            one_by_one(BlockPass::over(&mut colours[OVERFLOW], states, kernel));
        }
        for colour in used.colours() {
            BlockPass::over(&mut colours[colour], states, kernel).run::<L>();
        }
    }
}

/// A pass over some blocks of a colour, that have so many contacts.
struct BlockPass<'a, K> {
    count: usize,
    blocks: BlocksOver<'a, ContactBlock>,
    kernel: &'a K,
}

impl<'a, K: Kernel> BlockPass<'a, K> {
    /// Over all contacts of a colour.
    #[inline(always)]
    fn over(colour: &'a mut Colour, states: &'a mut [BodyState], kernel: &'a K) -> Self {
        Self { count: colour.contacts.len(), blocks: colour.blocks.over(states), kernel }
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
    fn in_lanes<L: Lane>(mut self) {
        // One of its own stays in registers, whatever is written through it.
        let kernel = self.kernel.clone();
        // One loop: it is compiled into a faster program than one over blocks, and one within each.
        for place in (0..self.count).step_by(L::WIDTH) {
            let (block, mut states) = self.blocks.get_mut(place / COLUMN);
            kernel.run::<L>(block, &mut states, place % COLUMN);
        }
    }
}

/// Compiled once for each kernel, and not within every width, which need it for the overflow.
#[inline(never)]
fn one_by_one<K: Kernel>(pass: BlockPass<'_, K>) {
    pass.in_lanes::<f32>();
}

/// Makes the constraints of some blocks of a colour.
struct Prepare<'a> {
    /// Indices of the contacts.
    contacts: &'a [u32],
    rows: &'a mut [RowPairs],
    blocks: &'a mut [ContactBlock],
    from: Beginning<'a>,
}

impl Job for Prepare<'_> {
    #[inline(always)]
    fn run<L: Lane>(self) {
        for (number, (rows, block)) in self.rows.iter_mut().zip(self.blocks).enumerate() {
            let list = &self.contacts[number * COLUMN..];
            block.fill(rows, list, self.from);
            for place in (0..list.len().min(COLUMN)).step_by(L::WIDTH) {
                block.find_masses::<L>(rows, place);
            }
        }
    }
}

/// Writes a step back into the contacts of some blocks of a colour.
struct Finish<'a> {
    contacts: ChosenContacts<'a>,
    loads: Chosen<'a, ContactLoad>,
    rows: &'a [RowPairs],
    blocks: &'a mut [ContactBlock],
    states: &'a [BodyState],
    measure: LoadMeasure,
    /// What is left wrong.
    residual: &'a Mutex<StepResidual>,
}

impl Job for Finish<'_> {
    #[inline(always)]
    fn run<L: Lane>(mut self) {
        let mut residuals = Residuals::default();
        for (number, (rows, block)) in self.rows.iter().zip(self.blocks).enumerate() {
            let contacts = self.contacts.skipping(number * COLUMN);
            let loads = self.loads.skipping(number * COLUMN);
            for place in (0..COLUMN.min(contacts.len())).step_by(L::WIDTH) {
                block.end::<L>(place, &rows.gather(self.states, place), &mut residuals);
            }
            write_back(block, &residuals, contacts, loads, self.measure);
        }
        let mut residual = lock(self.residual);
        *residual = residual.max(residuals.greatest());
    }
}

/// Writes the end of the step back into the contacts of a block, which are the first. Compiled once, and not within every
/// width.
#[inline(never)]
fn write_back(
    block: &mut ContactBlock,
    residuals: &Residuals,
    mut contacts: ChosenContacts<'_>,
    mut loads: Chosen<'_, ContactLoad>,
    measure: LoadMeasure,
) {
    for place in 0..COLUMN.min(contacts.len()) {
        contacts.prefetch_written(place);
        let contact = contacts.get_mut(place);
        let load = residuals.load.get(place);
        block.write_back(place, contact, load, measure.dt);
        let is_notable = measure.note_load(contact, loads.get_mut(place), load);
        block.marks.notably_loaded.set(place, is_notable);
        let touches = contact.has_bounced || residuals.touching.get(place);
        debug_assert_eq!(touches, contact.has_touched());
        block.marks.changing.set(place, touches != contact.is_touching);
    }
}
