//! Threads beside that of a step: woken once per step, then without rest until its end.
//!
//! Own threads and no library's, as the colours of a sweep are short: two threads do 3 µs of work in under 2 µs, where
//! `rayon::join` takes 2.9 µs. Nothing is allocated, and a thread gets the same parts of each sweep, which it has in
//! its cache.
//!
//! A part that panics ends there; the others are done, threads rest, and the caller gets the panic. What is worked on is
//! borrowed: nothing that waits for its end may unwind.

use core::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::PoisonError;

use crate::compute::sync::thread::{self, JoinHandle};
use crate::compute::sync::{Arc, AtomicU8, AtomicU64, Mutex, Ordering, UnsafeCell, spin_loop};

/// So often a thread looks for work before it lets others have the processor, 0.1 to 0.2 ms: about as long as a
/// step does anything that is not divided.
const LOOKS_FOR_WORK: u32 = if cfg!(loom) { 0 } else { 10_000 };

/// So often a thread looks for the next step before it sleeps, 20 to 40 µs: waking it would take as long, and steps often
/// follow each other, as where a rollback makes up for some.
const LOOKS_FOR_STEP: u32 = if cfg!(loom) { 0 } else { 2000 };

/// So often the caller looks whether the parts of others are done: they are soon, or their thread has been interrupted.
const LOOKS_FOR_END: u32 = if cfg!(loom) { 0 } else { 1000 };

/// What the threads do.
const RESTING: u8 = 0;
const AT_WORK: u8 = 1;
const SHUT_DOWN: u8 = 2;

type Work = dyn Fn(usize) + Sync + 'static;

/// What is written again and again, apart from what other threads look at: in two cache lines of its own, as they are
/// fetched in pairs.
#[repr(align(128))]
#[derive(Debug)]
struct Apart<T>(T);

/// What becomes of the part of a thread.
const NO_PART: u8 = 0;
const UNCLAIMED: u8 = 1;
const CLAIMED: u8 = 2;

/// What one thread beside the caller is to do: all of it comes in the cache line that it looks at.
struct TaskSlot {
    /// `NO_PART`, `UNCLAIMED` or `CLAIMED`; `NO_PART` again when it is done.
    state: AtomicU8,
    /// What the part is of. It is there as long as the part is not done.
    task: UnsafeCell<*const Work>,
}

// SAFETY: `task` is written by `TaskQueue::run` while there is no part in this slot, and read by the one who has claimed the
// part and not done it yet; what it points at is `Sync`.
unsafe impl Sync for TaskSlot {}
// SAFETY: as above.
unsafe impl Send for TaskSlot {}

impl TaskSlot {
    fn new() -> Self {
        let nothing: &'static Work = &|_| ();
        Self { state: AtomicU8::new(NO_PART), task: UnsafeCell::new(nothing) }
    }

    fn has_part(&self) -> bool {
        self.state.load(Ordering::Relaxed) == UNCLAIMED
    }

    /// Takes up its part, if nobody has.
    fn claim(&self) -> bool {
        let claim = || self.state.compare_exchange(UNCLAIMED, CLAIMED, Ordering::Acquire, Ordering::Relaxed);
        self.has_part() && claim().is_ok()
    }

    fn is_done(&self) -> bool {
        self.state.load(Ordering::Acquire) == NO_PART
    }
}

/// What the threads share.
struct TaskQueue {
    /// By thread, those beside the caller.
    slots: Box<[Apart<TaskSlot>]>,
    /// Counts the tasks of work, when they begin and when they end: odd within one.
    tasks: Apart<AtomicU64>,
    /// `RESTING`, `AT_WORK` or `SHUT_DOWN`.
    phase: Apart<AtomicU8>,
    /// How a part failed, the first to do so.
    panic: Apart<Mutex<Option<Box<dyn Any + Send>>>>,
}

impl TaskQueue {
    /// For so many threads, the caller's among them.
    fn new(threads: usize) -> Self {
        Self {
            slots: (1..threads).map(|_| Apart(TaskSlot::new())).collect(),
            tasks: Apart(AtomicU64::new(0)),
            phase: Apart(AtomicU8::new(RESTING)),
            panic: Apart(Mutex::new(None)),
        }
    }

    /// Does work on each of some parts, at most one for each thread, once; returns when all of them are done.
    fn run(&self, parts: usize, work: &(dyn Fn(usize) + Sync)) {
        let slots = &self.slots[..parts - 1];
        let number = self.tasks.0.load(Ordering::Relaxed);
        let begin =
            || self.tasks.0.compare_exchange(number, number + 1, Ordering::Acquire, Ordering::Relaxed);
        assert!(number.is_multiple_of(2) && begin().is_ok(), "one task of work at a time");
        // Asked before the first of them is published: from there on nothing may unwind before all parts are done.
        debug_assert!(slots.iter().all(|Apart(slot)| slot.is_done()));
        // SAFETY: only the lifetime changes. The work is used by those who have claimed a part and not done it yet, and this
        // function returns when all parts are done.
        let shared = unsafe { core::mem::transmute::<&(dyn Fn(usize) + Sync), &'static Work>(work) };
        for Apart(slot) in slots {
            // SAFETY: all parts of tasks before this one are done, and that of this one is not here yet.
            slot.task.with_mut(|task| unsafe { *task = shared });
            slot.state.store(UNCLAIMED, Ordering::Release);
        }
        self.do_part(0, work);
        self.help(0);
        let mut looks = 0;
        for Apart(slot) in slots {
            while !slot.is_done() {
                wait(&mut looks, LOOKS_FOR_END);
            }
        }
        self.tasks.0.store(number + 2, Ordering::Release);
        let panic = self.panic.0.lock().unwrap_or_else(PoisonError::into_inner).take();
        if let Some(panic) = panic {
            resume_unwind(panic);
        }
    }

    /// Does the parts that nobody has taken up, that of a slot first.
    fn help(&self, first: usize) {
        let slots = self.slots.iter().enumerate();
        for (place, Apart(slot)) in slots.clone().skip(first).chain(slots.take(first)) {
            if slot.claim() {
                // SAFETY: this part has been claimed and is not done, so that the task and its work are there.
                let work = slot.task.with(|task| unsafe { &**task });
                self.do_part(place + 1, work);
                slot.state.store(NO_PART, Ordering::Release);
            }
        }
    }

    fn do_part(&self, part: usize, work: &(dyn Fn(usize) + Sync)) {
        if let Err(panic) = catch_unwind(AssertUnwindSafe(|| work(part))) {
            let mut first = self.panic.0.lock().unwrap_or_else(PoisonError::into_inner);
            if first.is_none() {
                *first = Some(panic);
            } else {
                // To drop what was thrown could panic as well.
                core::mem::forget(panic);
            }
        }
    }

    /// The life of a thread.
    fn work_until_shut_down(&self, place: usize) {
        let (mut looks, mut rested) = (0, 0);
        loop {
            match self.phase.0.load(Ordering::Acquire) {
                SHUT_DOWN => return,
                AT_WORK if self.slots[place].0.has_part() => {
                    self.help(place);
                    (looks, rested) = (0, 0);
                }
                AT_WORK => wait(&mut looks, LOOKS_FOR_WORK),
                _ if rested < LOOKS_FOR_STEP => {
                    spin_loop();
                    rested += 1;
                }
                _ => thread::park(),
            }
        }
    }
}

/// Waits for a moment, and lets others have the processor after so many looks in vain.
fn wait(looks: &mut u32, limit: u32) {
    *looks += 1;
    if *looks < limit {
        spin_loop();
    } else {
        thread::yield_now();
    }
}

/// Threads beside the caller, for one step at a time.
pub(super) struct Workers {
    queue: Arc<TaskQueue>,
    threads: Vec<JoinHandle<()>>,
    /// The process that has the threads, if there are any. One that was forked from it has none of them.
    process: Option<u32>,
}

/// Lets the threads sleep when it goes, also where that is because of a panic.
#[must_use = "threads are at work as long as it is there"]
pub(crate) struct AtWork(Option<Arc<TaskQueue>>);

impl Drop for AtWork {
    fn drop(&mut self) {
        if let Some(queue) = &self.0 {
            queue.phase.0.store(RESTING, Ordering::Release);
        }
    }
}

impl AtWork {
    /// Nobody beside the caller is.
    pub(super) const ALONE: Self = Self(None);
}

impl core::fmt::Debug for Workers {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Workers").field("threads", &self.threads.len()).finish_non_exhaustive()
    }
}

impl Drop for Workers {
    /// Ends the threads.
    fn drop(&mut self) {
        let are_here = self.are_here();
        self.set_phase(SHUT_DOWN);
        for thread in self.threads.drain(..) {
            if are_here {
                // Nothing of a thread's own can fail: what it works on is caught.
                _ = thread.join();
            } else {
                // There is nothing to wait for, and to give up a thread of another process is no more allowed.
                core::mem::forget(thread);
            }
        }
    }
}

impl Workers {
    /// Starts so many threads but one, the caller's. They sleep until they are woken.
    pub(super) fn start(threads: usize) -> Self {
        let queue = Arc::new(TaskQueue::new(threads));
        let start = |place| {
            let queue = Arc::clone(&queue);
            let thread = thread::Builder::new().name("rustycs".into());
            thread.spawn(move || queue.work_until_shut_down(place))
        };
        // Where there are no more threads to be had, as on the web, the caller does all there is to do.
        let threads: Vec<_> = (0..threads - 1).map_while(|place| start(place).ok()).collect();
        // Asked only where there are threads: on the web there are no processes either.
        let process = (!threads.is_empty()).then(std::process::id);
        Self { queue, threads, process }
    }

    /// Whether this process has the threads.
    pub(super) fn are_here(&self) -> bool {
        self.process.is_none_or(|process| process == std::process::id())
    }

    /// Wakes the threads, for a step.
    pub(super) fn wake(&self) -> AtWork {
        if self.threads.is_empty() {
            return AtWork::ALONE;
        }
        self.set_phase(AT_WORK);
        AtWork(Some(Arc::clone(&self.queue)))
    }

    /// How many threads are at work, the caller's among them.
    #[inline(always)]
    pub(super) fn threads(&self) -> usize {
        let are_at_work = || self.queue.phase.0.load(Ordering::Relaxed) == AT_WORK;
        if !self.threads.is_empty() && are_at_work() { 1 + self.threads.len() } else { 1 }
    }

    /// Does work on each of some parts, at most one for each thread.
    pub(super) fn run(&self, parts: usize, work: &(dyn Fn(usize) + Sync)) {
        self.queue.run(parts, work);
    }

    fn set_phase(&self, phase: u8) {
        self.queue.phase.0.store(phase, Ordering::Release);
        for thread in &self.threads {
            thread.thread().unpark();
        }
    }
}

/// Every order in which two or three threads may run, see `sync`.
#[cfg(all(loom, test))]
mod loom_tests {
    use super::{Arc, AtomicU8, Ordering, TaskQueue, UnsafeCell, Workers, thread};
    use loom::model::Builder;

    /// Written by one part, read by the caller when all are done: loom finds out where that is not in order.
    struct Visits(Vec<UnsafeCell<u32>>);

    // SAFETY: loom checks every use of the cells.
    unsafe impl Sync for Visits {}

    impl Visits {
        fn new(parts: usize) -> Self {
            Self((0..parts).map(|_| UnsafeCell::new(0)).collect())
        }

        fn visit(&self, part: usize) {
            // SAFETY: loom checks that nobody else uses it.
            self.0[part].with_mut(|visits| unsafe { *visits += 1 });
        }

        fn assert_all(&self, expected: u32) {
            for visits in &self.0 {
                // SAFETY: loom checks that nobody writes it.
                assert_eq!(visits.with(|visits| unsafe { *visits }), expected);
            }
        }
    }

    /// Threads are interrupted at most so many times where they need not be.
    fn check(interruptions: usize, model: impl Fn() + Sync + Send + 'static) {
        let mut builder = Builder::new();
        builder.preemption_bound = Some(interruptions);
        builder.check(model);
    }

    #[test]
    fn loom_each_part_is_done_once_before_the_work_ends() {
        check(3, || {
            let workers = Workers::start(2);
            let at_work = workers.wake();
            let visits = Visits::new(2);
            for task in 1..3 {
                workers.run(2, &|part| visits.visit(part));
                visits.assert_all(task);
            }
            drop(at_work);
        });
    }

    /// Without the waiting of the other two, in which loom would have them read that they are at work for ever.
    #[test]
    fn loom_three_threads_share_three_parts_of_which_each_may_take_another_s() {
        check(2, || {
            let queue = Arc::new(TaskQueue::new(3));
            let threads = [0, 1].map(|place| {
                let queue = Arc::clone(&queue);
                thread::spawn(move || queue.help(place))
            });
            let visits = Visits::new(3);
            for task in 1..3 {
                queue.run(3, &|part| visits.visit(part));
                visits.assert_all(task);
            }
            threads.into_iter().for_each(|thread| thread.join().unwrap());
        });
    }

    #[test]
    fn loom_threads_that_rest_come_back_for_the_next_step() {
        check(3, || {
            let workers = Workers::start(2);
            let visits = Visits::new(2);
            for step in 1..3 {
                let at_work = workers.wake();
                workers.run(2, &|part| visits.visit(part));
                visits.assert_all(step);
                drop(at_work);
            }
        });
    }

    #[test]
    fn loom_a_part_that_panics_ends_no_other() {
        check(2, || {
            let workers = Workers::start(2);
            let at_work = workers.wake();
            let done = AtomicU8::new(0);
            let run = || {
                workers.run(2, &|part| {
                    done.fetch_add(1, Ordering::Relaxed);
                    if part == 1 {
                        std::panic::resume_unwind(Box::new("part 1"));
                    }
                });
            };
            let caught = std::panic::catch_unwind(std::panic::AssertUnwindSafe(run));
            assert_eq!(caught.unwrap_err().downcast_ref(), Some(&"part 1"));
            assert_eq!(done.load(Ordering::Relaxed), 2);
            drop(at_work);
        });
    }
}
