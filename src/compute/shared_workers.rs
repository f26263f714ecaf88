//! Threads that the worlds of a process share: a world has some for a step, and gives them back at its end.
//!
//! So there are as many as steps take at the same time, however many worlds there are. Worlds that ask for the same
//! number of threads share them; the first step that is worth it starts them, and they end with the last of these worlds,
//! or when it asks for another number.

// Not those of `sync`: loom has no `Weak`, and nothing else is behind them.
use std::sync::{Arc, PoisonError, Weak};

use crate::compute::sync::Mutex;
pub(crate) use crate::compute::workers::AtWork;
use crate::compute::workers::Workers;
use crate::compute::{MOST_THREADS, lock};

/// By number of threads: the workers of that size, as long as a world has a part in them.
static ALL: std::sync::Mutex<[Weak<IdleWorkers>; MOST_THREADS + 1]> =
    std::sync::Mutex::new([const { Weak::new() }; MOST_THREADS + 1]);

/// Workers of one size that no step has now.
struct IdleWorkers {
    threads: usize,
    idle: Mutex<Vec<Workers>>,
}

impl IdleWorkers {
    fn new(threads: usize) -> Self {
        Self { threads, idle: Mutex::new(Vec::new()) }
    }

    /// Those of so many threads, at most [`MOST_THREADS`].
    fn of(threads: usize) -> Arc<Self> {
        let shared = &mut lock(&ALL)[threads];
        shared.upgrade().unwrap_or_else(|| {
            let first = Arc::new(Self::new(threads));
            *shared = Arc::downgrade(&first);
            first
        })
    }

    /// The workers that rested last, or new ones.
    fn take(&self) -> Workers {
        let idle = self.idle.lock().unwrap_or_else(PoisonError::into_inner).pop();
        idle.filter(Workers::are_here).unwrap_or_else(|| Workers::start(self.threads))
    }

    fn give_back(&self, workers: Workers) {
        self.idle.lock().unwrap_or_else(PoisonError::into_inner).push(workers);
    }
}

/// The part of a world in the workers of all. A clone has none until it is stepped.
#[derive(Default)]
pub(super) struct SharedWorkers {
    shared: Option<Arc<IdleWorkers>>,
    /// Those that the step has.
    workers: Option<Workers>,
}

impl Clone for SharedWorkers {
    fn clone(&self) -> Self {
        Self::default()
    }
}

impl core::fmt::Debug for SharedWorkers {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let threads = self.shared.as_ref().map_or(1, |shared| shared.threads);
        f.debug_struct("SharedWorkers").field("threads", &threads).finish_non_exhaustive()
    }
}

impl SharedWorkers {
    /// Gives up the part in workers of any other number of threads.
    pub(super) fn keep_only(&mut self, threads: usize) {
        self.shared.take_if(|shared| shared.threads != threads);
    }

    /// Wakes so many threads, the caller's among them, for a step.
    pub(super) fn begin(&mut self, threads: usize) -> AtWork {
        self.keep_only(threads);
        let shared = self.shared.get_or_insert_with(|| IdleWorkers::of(threads));
        self.workers.insert(shared.take()).wake()
    }

    /// Lets them go, for the next step of any world.
    pub(super) fn end(&mut self, at_work: AtWork) {
        drop(at_work);
        if let (Some(shared), Some(workers)) = (&self.shared, self.workers.take()) {
            shared.give_back(workers);
        }
    }

    /// How many threads are at work, the caller's among them.
    #[inline(always)]
    pub(super) fn threads(&self) -> usize {
        self.workers.as_ref().map_or(1, Workers::threads)
    }

    /// Does work on each of some parts, at most one for each thread.
    ///
    /// # Panics
    /// If no threads are at work.
    pub(super) fn run(&self, parts: usize, work: &(dyn Fn(usize) + Sync)) {
        self.workers.as_ref().expect("threads are at work").run(parts, work);
    }
}

/// Each with a number of threads that no other test has.
#[cfg(all(test, not(loom)))]
mod tests {
    use super::{ALL, SharedWorkers, lock};

    /// How many workers of so many threads rest; `None` where they have ended.
    fn idle(threads: usize) -> Option<usize> {
        let shared = lock(&ALL)[threads].upgrade()?;
        Some(shared.idle.lock().unwrap().len())
    }

    #[test]
    fn a_hundred_worlds_that_step_in_turn_share_the_threads_of_one() {
        let mut worlds: Vec<SharedWorkers> = (0..100).map(|_| SharedWorkers::default()).collect();
        for _ in 0..2 {
            for world in &mut worlds {
                let at_work = world.begin(5);
                assert_eq!((world.threads(), idle(5)), (5, Some(0)));
                world.end(at_work);
                assert_eq!((world.threads(), idle(5)), (1, Some(1)));
            }
        }
        // Two that step at the same time have their own.
        let [a, b, ..] = &mut worlds[..] else { unreachable!() };
        let at_work = (a.begin(5), b.begin(5));
        assert_eq!((a.threads(), b.threads()), (5, 5));
        a.end(at_work.0);
        b.end(at_work.1);
        assert_eq!(idle(5), Some(2));
        drop(worlds);
        assert_eq!(idle(5), None);
    }

    #[test]
    fn threads_end_with_the_last_world_that_asks_for_them() {
        let mut worlds = [SharedWorkers::default(), SharedWorkers::default()];
        for world in &mut worlds {
            let at_work = world.begin(6);
            world.end(at_work);
        }
        let [first, second] = &mut worlds;
        first.keep_only(1);
        assert_eq!(idle(6), Some(1));
        let at_work = second.begin(7);
        second.end(at_work);
        assert_eq!((idle(6), idle(7)), (None, Some(1)));
    }

    #[cfg(all(target_os = "linux", not(miri)))]
    mod processes {
        use super::SharedWorkers;

        // SAFETY: as the standard of POSIX declares them.
        unsafe extern "C" {
            safe fn fork() -> i32;
            fn waitpid(child: i32, status: *mut i32, options: i32) -> i32;
            safe fn alarm(seconds: u32) -> u32;
            safe fn _exit(status: i32) -> !;
        }

        /// A forked process has no threads but the one that forked it: to wait for the others failed with a panic.
        #[test]
        fn what_has_threads_can_be_dropped_in_a_forked_process() {
            let mut world = SharedWorkers::default();
            let at_work = world.begin(8);
            world.end(at_work);
            let child = fork();
            if child == 0 {
                // Ended by a signal, if it waits for what another thread of its parent held.
                alarm(10);
                let dropped = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| drop(world)));
                _exit(i32::from(dropped.is_err()));
            }
            let mut status = -1;
            // SAFETY: the status is written while it is borrowed.
            assert_eq!(unsafe { waitpid(child, &raw mut status, 0) }, child);
            assert_eq!(status, 0, "the child panicked or was ended");
        }
    }
}

/// Every order in which threads may run, see `sync`.
#[cfg(all(loom, test))]
mod loom_tests {
    use super::IdleWorkers;
    use crate::compute::sync::{Arc, AtomicU8, Ordering, thread};

    /// Two worlds on two threads, which may have the same workers one after the other, or different ones.
    #[test]
    fn loom_worlds_that_step_on_two_threads_share_workers() {
        let mut builder = loom::model::Builder::new();
        builder.preemption_bound = Some(1);
        builder.check(|| {
            let shared = Arc::new(IdleWorkers::new(2));
            let step = |shared: &IdleWorkers| {
                let workers = shared.take();
                let at_work = workers.wake();
                let done = AtomicU8::new(0);
                workers.run(2, &|_| _ = done.fetch_add(1, Ordering::Relaxed));
                assert_eq!(done.load(Ordering::Relaxed), 2);
                drop(at_work);
                shared.give_back(workers);
            };
            let other = Arc::clone(&shared);
            let there = thread::spawn(move || step(&other));
            step(&shared);
            there.join().unwrap();
        });
    }
}
