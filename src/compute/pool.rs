//! Several threads for one step.
//!
//! A step has hundreds of tasks of work that can be divided, each a few microseconds long: every colour of every
//! sweep is one. Starting or waking a thread takes longer than that, so threads are woken once per step, and look for
//! parts without rest until it ends. A part that no thread has taken up is done by the caller: it never waits for a
//! thread to come.
//!
//! No bit of a result depends on how work is divided, on which thread does a part, or in what order: parts write to
//! different places, which what is divided sees to, and what has an order is put in order afterwards.

use core::cell::UnsafeCell;
use core::ops::Range;

use crate::compute::shared_workers::{AtWork, SharedWorkers};
use crate::compute::{COLUMN, Job, Width, run};

/// A part is worth a thread if it takes so long, ns: twice as long as another thread takes to begin it.
const LEAST_PART: usize = 1000;

/// The other threads begin so much later than the caller, ns: they have to see that there is work, and what. The caller
/// does more of it. Without a head start, or with one of 0.8 µs, two threads take 1 % longer for a large pyramid.
const HEAD_START: usize = 300;

/// A step is worth more than one thread if it takes so long, ns. Waking a thread takes the caller 5 to 15 µs, and the
/// thread comes 5 to 60 µs later: a pile of 1000, in 1.1 ms, gains a tenth, and one of 300, in 0.2 ms, is left to one.
const LEAST_STEP: usize = 200_000;

/// A step with a body or a contact more takes longer by about so much, ns.
const STEP_COST: usize = 100;

/// Most threads that work on one step.
pub(crate) const MOST_THREADS: usize = 16;

/// The threads that work on the steps of one world.
#[derive(Clone, Debug, Default)]
pub(crate) struct ThreadPool {
    workers: SharedWorkers,
    /// Whether work is divided however little it is: for tests.
    divides_all: bool,
}

/// Who does the work of a step, and how many numbers at a time.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Executor<'a> {
    pub(crate) pool: &'a ThreadPool,
    pub(crate) width: Width,
}

impl Executor<'_> {
    /// Does the job that `job_of` makes of the whole, or of parts of consecutive items if that is worth it. An item costs
    /// about so many ns.
    #[inline(always)]
    pub(crate) fn run<D: Divide, J: Job>(self, whole: D, item_cost: usize, job_of: impl Fn(D) -> J + Sync) {
        self.pool.run(whole, item_cost, |part| run(self.width, job_of(part)));
    }
}

/// Something that can be divided among threads: so many items, of which each belongs to one part.
pub(crate) trait Divide: Sized + Send {
    /// How many items there are.
    fn count(&self) -> usize;
    /// Those before an item, and those from it on.
    fn divide(self, at: usize) -> (Self, Self);
}

impl ThreadPool {
    /// Begins a step with up to so many threads, the caller's among them, on so many bodies and contacts. They work until
    /// the step ends, or until what is returned goes, as where the step panics.
    pub(crate) fn begin_step(&mut self, threads: usize, size: usize) -> AtWork {
        let threads = threads.min(MOST_THREADS);
        self.workers.keep_only(threads);
        let is_worth_it = self.divides_all || size * STEP_COST >= LEAST_STEP;
        if threads > 1 && is_worth_it { self.workers.begin(threads) } else { AtWork::ALONE }
    }

    /// Lets the threads of a step go: they rest until the next step of any world.
    pub(crate) fn end_step(&mut self, at_work: AtWork) {
        self.workers.end(at_work);
    }

    /// Divides work from now on however little it is.
    pub(crate) fn divide_all(&mut self) {
        self.divides_all = true;
    }

    /// Whether nothing is divided in this step.
    #[inline(always)]
    pub(crate) fn is_alone(&self) -> bool {
        self.workers.threads() == 1
    }

    /// Does work on all of it, in parts of consecutive items if that is worth it. An item costs about so many ns.
    #[inline(always)]
    pub(crate) fn run<D: Divide>(&self, whole: D, item_cost: usize, work: impl Fn(D) + Sync) {
        if self.is_alone() {
            return work(whole);
        }
        let count = whole.count();
        let worth = if self.divides_all { count } else { count * item_cost / LEAST_PART };
        let parts = worth.min(self.workers.threads());
        if parts > 1 {
            let head_start = if self.divides_all { 0 } else { HEAD_START / item_cost };
            self.run_parts(whole, Parts { count: parts, items: count, head_start }, &work);
        } else {
            work(whole);
        }
    }

    #[inline(never)]
    fn run_parts<D: Divide>(&self, whole: D, parts: Parts, work: &(impl Fn(D) + Sync)) {
        let mut places = [const { Place(UnsafeCell::new(None)) }; MOST_THREADS];
        let mut rest = whole;
        for (part, place) in places[..parts.count].iter_mut().enumerate().skip(1).rev() {
            let (first, last) = rest.divide(parts.start_of(part));
            *place.0.get_mut() = Some(last);
            rest = first;
        }
        *places[0].0.get_mut() = Some(rest);
        let places = &places;
        self.workers.run(parts.count, &|part| {
            // SAFETY: the workers does each part once, so that this is the only one who looks at its place.
            if let Some(part) = unsafe { (*places[part].0.get()).take() } {
                work(part);
            }
        });
    }
}

/// Where a part is handed over, in cache lines of its own.
#[repr(align(128))]
struct Place<D>(UnsafeCell<Option<D>>);

// SAFETY: what is in it is taken out by one thread, see `ThreadPool::run_parts`.
unsafe impl<D: Send> Sync for Place<D> {}

/// How work is divided: into a part for each thread.
#[derive(Clone, Copy)]
struct Parts {
    count: usize,
    items: usize,
    /// How many items the caller has done when the others begin.
    head_start: usize,
}

impl Parts {
    /// Number of the first item of a part. The first part is the caller's.
    fn start_of(self, part: usize) -> usize {
        let others = (self.items - self.head_start) * part / self.count;
        if part == 0 { 0 } else { self.head_start + others }
    }
}

/// What is behind a lock, whatever has happened to those who held it.
pub(crate) fn lock<T>(mutex: &std::sync::Mutex<T>) -> std::sync::MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(std::sync::PoisonError::into_inner)
}

impl Divide for Range<usize> {
    fn count(&self) -> usize {
        self.len()
    }

    fn divide(self, at: usize) -> (Self, Self) {
        let middle = self.start + at;
        (self.start..middle, middle..self.end)
    }
}

impl<T: Sync> Divide for &[T] {
    fn count(&self) -> usize {
        self.len()
    }

    fn divide(self, at: usize) -> (Self, Self) {
        self.split_at(at)
    }
}

impl<T: Send> Divide for &mut [T] {
    fn count(&self) -> usize {
        self.len()
    }

    fn divide(self, at: usize) -> (Self, Self) {
        self.split_at_mut(at)
    }
}

/// The items of something in columns: of [`COLUMN`] items, but for the last.
#[derive(Debug)]
pub(crate) struct ByColumn<D>(pub(crate) D);

impl<D: Divide> Divide for ByColumn<D> {
    fn count(&self) -> usize {
        self.0.count().div_ceil(COLUMN)
    }

    fn divide(self, at: usize) -> (Self, Self) {
        let (first, last) = self.0.divide(at * COLUMN);
        (Self(first), Self(last))
    }
}

/// Items side by side: as many of the second as of the first.
impl<A: Divide, B: Divide> Divide for (A, B) {
    fn count(&self) -> usize {
        debug_assert_eq!(self.0.count(), self.1.count());
        self.0.count()
    }

    fn divide(self, at: usize) -> (Self, Self) {
        let (first_a, last_a) = self.0.divide(at);
        let (first_b, last_b) = self.1.divide(at);
        ((first_a, first_b), (last_a, last_b))
    }
}
