//! The threads of a crew: woken once per step, then without rest until its end.
//!
//! Own threads and no library's, as the colours of a sweep are short: two threads do 3 µs of work in under 2 µs, where
//! `rayon::join` takes 2.9 µs. Nothing is allocated, and a thread gets the same parts of each sweep, which it has in
//! its cache.

use core::any::Any;
use core::cell::UnsafeCell;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::atomic::{AtomicU8, AtomicU64, Ordering};
use std::sync::{Arc, Mutex};
use std::thread::{self, JoinHandle};

use crate::compute::crew::lock;
use crate::compute::owners;

/// So often a thread looks for work before it lets others have the processor, 0.1 to 0.2 ms: about as long as a
/// step does anything that is not divided.
const LOOKS_FOR_WORK: u32 = 10_000;

/// So often a thread looks for the next step before it sleeps, 20 to 40 µs: waking it would take as long, and steps often
/// follow each other, as where a rollback makes up for some.
const LOOKS_FOR_STEP: u32 = 2000;

/// So often the caller looks whether the parts of others are done: they are soon, or their thread has been interrupted.
const LOOKS_FOR_END: u32 = 1000;

/// What the threads do.
const RESTING: u8 = 0;
const AT_WORK: u8 = 1;
const DISMISSED: u8 = 2;

type Work = dyn Fn(usize) + Sync + 'static;

/// What is written again and again, apart from what other threads look at: in two cache lines of its own, as they are
/// fetched in pairs.
#[repr(align(128))]
#[derive(Debug)]
struct Apart<T>(T);

/// A stretch of work, which has a number.
#[derive(Clone, Copy)]
struct Task {
    work: *const Work,
    number: u64,
}

/// What becomes of the part of a thread.
const NO_PART: u8 = 0;
const UNCLAIMED: u8 = 1;
const CLAIMED: u8 = 2;

/// What one thread beside the caller is to do: all of it comes in the cache line that it looks at.
struct Post {
    /// `NO_PART`, `UNCLAIMED` or `CLAIMED`; `NO_PART` again when it is done.
    state: AtomicU8,
    /// What the part is of. It is there as long as the part is not done.
    task: UnsafeCell<Task>,
}

// SAFETY: `task` is written by `Board::run` while there is no part in this post, and read by the one who has claimed the
// part and not done it yet; what it points at is `Sync`.
unsafe impl Sync for Post {}
// SAFETY: as above.
unsafe impl Send for Post {}

impl Post {
    fn new() -> Self {
        let nothing: &'static Work = &|_| ();
        Self { state: AtomicU8::new(NO_PART), task: UnsafeCell::new(Task { work: nothing, number: 0 }) }
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
struct Board {
    /// By thread, those beside the caller.
    posts: Box<[Apart<Post>]>,
    /// Counts the stretches of work, when they begin and when they end: odd within one.
    stretches: Apart<AtomicU64>,
    /// `RESTING`, `AT_WORK` or `DISMISSED`.
    duty: Apart<AtomicU8>,
    /// How a part failed.
    panic: Apart<Mutex<Option<Box<dyn Any + Send>>>>,
}

impl Board {
    /// For so many threads, the caller's among them.
    fn new(threads: usize) -> Self {
        Self {
            posts: (1..threads).map(|_| Apart(Post::new())).collect(),
            stretches: Apart(AtomicU64::new(0)),
            duty: Apart(AtomicU8::new(RESTING)),
            panic: Apart(Mutex::new(None)),
        }
    }

    /// Does work on each of some parts, at most one for each thread, once; returns when all of them are done.
    fn run(&self, parts: usize, work: &(dyn Fn(usize) + Sync)) {
        let posts = &self.posts[..parts - 1];
        let number = self.stretches.0.load(Ordering::Relaxed);
        let begin =
            || self.stretches.0.compare_exchange(number, number + 1, Ordering::Acquire, Ordering::Relaxed);
        assert!(number.is_multiple_of(2) && begin().is_ok(), "one stretch of work at a time");
        // Asked before the first of them is published: from there on nothing may unwind before all parts are done.
        debug_assert!(posts.iter().all(|Apart(post)| post.is_done()));
        // SAFETY: only the lifetime changes. The work is used by those who have claimed a part and not done it yet, and this
        // function returns when all parts are done.
        let shared = unsafe { core::mem::transmute::<&(dyn Fn(usize) + Sync), &'static Work>(work) };
        for Apart(post) in posts {
            // SAFETY: all parts of stretches before this one are done, and that of this one is not here yet.
            unsafe {
                *post.task.get() = Task { work: shared, number };
            }
            post.state.store(UNCLAIMED, Ordering::Release);
        }
        self.do_part(0, number, work);
        self.help(0);
        let mut looks = 0;
        for Apart(post) in posts {
            while !post.is_done() {
                wait(&mut looks, LOOKS_FOR_END);
            }
        }
        self.stretches.0.store(number + 2, Ordering::Release);
        if let Some(panic) = lock(&self.panic.0).take() {
            resume_unwind(panic);
        }
    }

    /// Does the parts that nobody has taken up, that of a post first.
    fn help(&self, first: usize) {
        let posts = self.posts.iter().enumerate();
        for (place, Apart(post)) in posts.clone().skip(first).chain(posts.take(first)) {
            if post.claim() {
                // SAFETY: this part has been claimed and is not done, so that the task and its work are there.
                let (work, number) = unsafe {
                    let Task { work, number } = *post.task.get();
                    (&*work, number)
                };
                self.do_part(place + 1, number, work);
                post.state.store(NO_PART, Ordering::Release);
            }
        }
    }

    fn do_part(&self, part: usize, number: u64, work: &(dyn Fn(usize) + Sync)) {
        if let Err(panic) = catch_unwind(AssertUnwindSafe(|| owners::in_part(number, part, || work(part)))) {
            *lock(&self.panic.0) = Some(panic);
        }
    }

    /// The life of a thread.
    fn work_until_dismissed(&self, place: usize) {
        let (mut looks, mut rested) = (0, 0);
        loop {
            match self.duty.0.load(Ordering::Acquire) {
                DISMISSED => return,
                AT_WORK if self.posts[place].0.has_part() => {
                    self.help(place);
                    (looks, rested) = (0, 0);
                }
                AT_WORK => wait(&mut looks, LOOKS_FOR_WORK),
                _ if rested < LOOKS_FOR_STEP => {
                    core::hint::spin_loop();
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
    is_at_work: bool,
}

impl Default for Team {
    fn default() -> Self {
        Self { board: Arc::new(Board::new(1)), threads: Vec::new(), asked_for: 1, is_at_work: false }
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

    /// Does work on each of some parts, at most one for each thread.
    pub(super) fn run(&self, parts: usize, work: &(dyn Fn(usize) + Sync)) {
        self.board.run(parts, work);
    }

    fn hire(&mut self, threads: usize) {
        self.asked_for = threads;
        self.board = Arc::new(Board::new(threads));
        for place in 0..threads - 1 {
            let board = Arc::clone(&self.board);
            let thread = thread::Builder::new().name("rustycs".into());
            // Where there are no more threads to be had, as on the web, the caller does all there is to do.
            let Ok(hired) = thread.spawn(move || board.work_until_dismissed(place)) else { break };
            self.threads.push(hired);
        }
    }

    fn dismiss(&mut self) {
        self.set_duty(DISMISSED);
        for thread in self.threads.drain(..) {
            // Nothing of a thread's own can fail: what it works on is caught.
            _ = thread.join();
        }
    }

    fn set_duty(&self, duty: u8) {
        self.board.duty.0.store(duty, Ordering::Release);
        for thread in &self.threads {
            thread.thread().unpark();
        }
    }
}
