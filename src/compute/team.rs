//! The threads of a crew: woken once per step, then without rest until its end.
//!
//! Own threads and no library's, as the colours of a sweep are short: two threads do 3 µs of work in 1.9 µs, where
//! `rayon::join` takes 2.9 µs, and 0.8 µs of it in 0.6 µs. Nothing is allocated, and a thread gets the same parts of
//! each sweep, which it has in its cache.

use core::any::Any;
use core::cell::UnsafeCell;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::atomic::{AtomicU8, AtomicU64, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};
use std::thread::{self, JoinHandle};

use crate::compute::crew::lock;
use crate::compute::owners;

/// So often a thread looks for work before it lets others have the processor, about 0.2 ms: longer than a step does
/// anything that is not divided.
const LOOKS_FOR_WORK: u32 = 10_000;

/// So often the caller looks whether the parts of others are done: they are soon, or their thread has been interrupted.
const LOOKS_FOR_END: u32 = 1000;

/// What the threads do.
const RESTING: u8 = 0;
const AT_WORK: u8 = 1;
const DISMISSED: u8 = 2;

type Work = dyn Fn(usize) + Sync + 'static;

/// What one thread writes and another reads again and again: two cache lines of its own, as they are fetched in pairs.
#[repr(align(128))]
#[derive(Debug)]
struct Apart<T>(T);

/// What the threads share.
struct Board {
    /// One bit for each part that nobody has taken up.
    unclaimed: Apart<AtomicU64>,
    /// How many parts are not done.
    undone: Apart<AtomicUsize>,
    /// The work on a part. It is there as long as a part is not done.
    work: UnsafeCell<*const Work>,
    /// Counts the stretches of work.
    stretch: AtomicU64,
    /// `RESTING`, `AT_WORK` or `DISMISSED`.
    duty: Apart<AtomicU8>,
    /// How a part failed.
    panic: Mutex<Option<Box<dyn Any + Send>>>,
}

// SAFETY: all but `work` is made for several threads. `work` is written by `Board::run` while no part is unclaimed or
// undone, and read by those who have claimed a part and not done it yet; what it points at is `Sync`.
unsafe impl Sync for Board {}
// SAFETY: as above.
unsafe impl Send for Board {}

impl Board {
    fn new() -> Self {
        let nothing: &'static Work = &|_| ();
        Self {
            unclaimed: Apart(AtomicU64::new(0)),
            undone: Apart(AtomicUsize::new(0)),
            work: UnsafeCell::new(nothing),
            stretch: AtomicU64::new(0),
            duty: Apart(AtomicU8::new(RESTING)),
            panic: Mutex::new(None),
        }
    }

    /// Does work on each of some parts; returns when all of them are done.
    fn run(&self, parts: usize, work: &(dyn Fn(usize) + Sync), own: u64) {
        let is_free = self.undone.0.compare_exchange(0, parts, Ordering::Acquire, Ordering::Relaxed).is_ok();
        assert!(is_free && (1..=64).contains(&parts), "one stretch of work at a time, in 1 to 64 parts");
        debug_assert_eq!(self.unclaimed.0.load(Ordering::Relaxed), 0);
        self.stretch.fetch_add(1, Ordering::Relaxed);
        // SAFETY: of the type only the lifetime changes. The work is used by those who have claimed a part and not done
        // it yet, and this function returns when all parts are done. No part is unclaimed or undone, as the two checks
        // above say, so nobody reads it now.
        unsafe {
            *self.work.get() = core::mem::transmute::<&(dyn Fn(usize) + Sync), &'static Work>(work);
        }
        self.unclaimed.0.store(u64::MAX >> (64 - parts), Ordering::Release);
        self.help(own);
        let mut looks = 0;
        while self.undone.0.load(Ordering::Acquire) > 0 {
            wait(&mut looks, LOOKS_FOR_END);
        }
        if let Some(panic) = lock(&self.panic).take() {
            resume_unwind(panic);
        }
    }

    /// Does parts until all are taken, those in `own` first.
    fn help(&self, own: u64) {
        while let Some(part) = self.claim(own) {
            // SAFETY: this part has been claimed and is not done, so that the work is there.
            let work = unsafe { &**self.work.get() };
            let stretch = self.stretch.load(Ordering::Relaxed);
            if let Err(panic) =
                catch_unwind(AssertUnwindSafe(|| owners::in_part(stretch, part, || work(part))))
            {
                *lock(&self.panic) = Some(panic);
            }
            self.undone.0.fetch_sub(1, Ordering::Release);
        }
    }

    /// Takes up a part: one of `own`, or else the last one of another thread.
    fn claim(&self, own: u64) -> Option<usize> {
        let mut left = self.unclaimed.0.load(Ordering::Relaxed);
        while left != 0 {
            let part = if left & own != 0 { (left & own).trailing_zeros() } else { left.ilog2() };
            let before = self.unclaimed.0.fetch_and(!(1 << part), Ordering::Acquire);
            if before & 1 << part != 0 {
                return Some(part as usize);
            }
            left = before;
        }
        None
    }

    /// The life of a thread.
    fn work_until_dismissed(&self, own: u64) {
        let mut looks = 0;
        loop {
            match self.duty.0.load(Ordering::Acquire) {
                DISMISSED => return,
                AT_WORK if self.unclaimed.0.load(Ordering::Relaxed) != 0 => {
                    self.help(own);
                    looks = 0;
                }
                AT_WORK => wait(&mut looks, LOOKS_FOR_WORK),
                _ => thread::park(),
            }
        }
    }
}

/// Waits for a moment, and lets others have the processor after so many looks in vain.
fn wait(looks: &mut u32, limit: u32) {
    *looks += 1;
    if *looks < limit {
        core::hint::spin_loop();
    } else {
        thread::yield_now();
    }
}

/// The threads beside the caller.
pub(super) struct Team {
    board: Arc<Board>,
    threads: Vec<JoinHandle<()>>,
    /// How many threads were asked for, the caller's among them: there may be fewer.
    asked_for: usize,
    /// The parts that are for the caller.
    own: u64,
    is_at_work: bool,
}

impl Default for Team {
    fn default() -> Self {
        Self { board: Arc::new(Board::new()), threads: Vec::new(), asked_for: 1, own: 0, is_at_work: false }
    }
}

impl Clone for Team {
    /// A team of its own, that has no threads yet.
    fn clone(&self) -> Self {
        Self::default()
    }
}

impl core::fmt::Debug for Team {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Team").field("threads", &self.threads.len()).finish_non_exhaustive()
    }
}

impl Drop for Team {
    fn drop(&mut self) {
        self.dismiss();
    }
}

impl Team {
    /// Wakes so many threads, the caller's among them; starts them where they are not there yet.
    pub(super) fn begin(&mut self, threads: usize) {
        if self.asked_for != threads {
            self.dismiss();
            self.hire(threads);
        }
        self.is_at_work = !self.threads.is_empty();
        owners::expect_parts(self.is_at_work);
        self.set_duty(AT_WORK);
    }

    /// Lets them sleep.
    pub(super) fn rest(&mut self) {
        if self.is_at_work {
            self.is_at_work = false;
            owners::expect_parts(false);
            self.board.duty.0.store(RESTING, Ordering::Release);
        }
    }

    /// How many threads are at work, the caller's among them.
    #[inline(always)]
    pub(super) fn threads(&self) -> usize {
        if self.is_at_work { 1 + self.threads.len() } else { 1 }
    }

    /// Does work on each of some parts. Of as many as there are threads or more, each thread gets neighbours.
    pub(super) fn run(&self, parts: usize, work: &(dyn Fn(usize) + Sync)) {
        let threads = self.threads();
        let (each, own) = (parts / threads, self.own);
        if each > 1 && parts.is_multiple_of(threads) {
            self.board.run(parts, &|part| work(part % threads * each + part / threads), own);
        } else {
            self.board.run(parts, work, own);
        }
    }

    /// The parts that are for the thread with a number: every so many-th.
    fn parts_for(&self, number: usize) -> u64 {
        (number..64).step_by(self.asked_for).map(|part| 1 << part).sum()
    }

    fn hire(&mut self, threads: usize) {
        self.asked_for = threads;
        self.own = self.parts_for(0);
        for number in 1..threads {
            let (board, own) = (Arc::clone(&self.board), self.parts_for(number));
            let thread = thread::Builder::new().name("rustycs".into());
            // Where there are no more threads to be had, as on the web, the caller does all there is to do.
            let Ok(hired) = thread.spawn(move || board.work_until_dismissed(own)) else { break };
            self.threads.push(hired);
        }
    }

    fn dismiss(&mut self) {
        self.set_duty(DISMISSED);
        for thread in self.threads.drain(..) {
            // Nothing of a thread's own can fail: what it works on is caught.
            _ = thread.join();
        }
        self.board.duty.0.store(RESTING, Ordering::Release);
    }

    fn set_duty(&self, duty: u8) {
        self.board.duty.0.store(duty, Ordering::Release);
        for thread in &self.threads {
            thread.thread().unpark();
        }
    }
}
