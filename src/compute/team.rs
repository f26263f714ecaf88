//! The threads of a crew: woken once per step, then without rest until its end.
//!
//! Own threads and no library's, as the colours of a sweep are short: two threads do 3 µs of work in 1.9 µs, where
//! `rayon::join` takes 2.9 µs, and 0.8 µs of it in 0.6 µs. Nothing is allocated, and a thread gets the same parts of
//! each sweep, which it has in its cache.

use core::any::Any;
use core::cell::UnsafeCell;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::atomic::{AtomicBool, AtomicU8, AtomicU64, AtomicUsize, Ordering};
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

/// What one thread is to do: all of it comes in the cache line that it looks at.
struct Post {
    /// Whether its part is there to be taken up.
    is_unclaimed: AtomicBool,
    /// What that is a part of. It is there as long as the part is not done.
    task: UnsafeCell<Task>,
}

// SAFETY: `task` is written by `Board::run` while the part of this post is neither unclaimed nor undone, and read by the
// one who has claimed it and not done it yet; what it points at is `Sync`.
unsafe impl Sync for Post {}
// SAFETY: as above.
unsafe impl Send for Post {}

impl Post {
    fn new() -> Self {
        let nothing: &'static Work = &|_| ();
        Self {
            is_unclaimed: AtomicBool::new(false),
            task: UnsafeCell::new(Task { work: nothing, number: 0 }),
        }
    }

    fn has_part(&self) -> bool {
        self.is_unclaimed.load(Ordering::Relaxed)
    }

    /// Takes up its part, if nobody has.
    fn claim(&self) -> bool {
        self.has_part() && self.is_unclaimed.swap(false, Ordering::Acquire)
    }
}

/// What the threads share.
struct Board {
    /// By thread, the caller's first.
    posts: Box<[Apart<Post>]>,
    /// How many parts are not done.
    undone: Apart<AtomicUsize>,
    /// Counts the stretches of work.
    stretches: Apart<AtomicU64>,
    /// `RESTING`, `AT_WORK` or `DISMISSED`.
    duty: Apart<AtomicU8>,
    /// How a part failed.
    panic: Apart<Mutex<Option<Box<dyn Any + Send>>>>,
}

impl Board {
    /// For so many threads.
    fn new(threads: usize) -> Self {
        Self {
            posts: (0..threads).map(|_| Apart(Post::new())).collect(),
            undone: Apart(AtomicUsize::new(0)),
            stretches: Apart(AtomicU64::new(0)),
            duty: Apart(AtomicU8::new(RESTING)),
            panic: Apart(Mutex::new(None)),
        }
    }

    /// Does work on each of some parts, at most one for each thread; returns when all of them are done.
    fn run(&self, parts: usize, work: &(dyn Fn(usize) + Sync)) {
        let posts = &self.posts[..parts];
        let is_free = self.undone.0.compare_exchange(0, parts, Ordering::Acquire, Ordering::Relaxed).is_ok();
        assert!(is_free, "one stretch of work at a time");
        let number = self.stretches.0.fetch_add(1, Ordering::Relaxed);
        // SAFETY: only the lifetime changes. The work is used by those who have claimed a part and not done it yet, and this
        // function returns when all parts are done.
        let work = unsafe { core::mem::transmute::<&(dyn Fn(usize) + Sync), &'static Work>(work) };
        // The caller's last: it will look there at once, the others are to come.
        for Apart(post) in posts.iter().rev() {
            debug_assert!(!post.has_part());
            // SAFETY: all parts of stretches before this one are done, as `undone` said, and that of this one is not here
            // yet.
            unsafe {
                *post.task.get() = Task { work, number };
            }
            post.is_unclaimed.store(true, Ordering::Release);
        }
        self.help(0);
        let mut looks = 0;
        while self.undone.0.load(Ordering::Acquire) > 0 {
            wait(&mut looks, LOOKS_FOR_END);
        }
        if let Some(panic) = lock(&self.panic.0).take() {
            resume_unwind(panic);
        }
    }

    /// Does the part of a thread, and then those that the others have not taken up.
    fn help(&self, thread: usize) {
        let posts = self.posts.iter().enumerate();
        for (part, Apart(post)) in posts.clone().skip(thread).chain(posts.take(thread)) {
            if post.claim() {
                // SAFETY: this part has been claimed and is not done, so that the task and its work are there.
                let (work, number) = unsafe {
                    let Task { work, number } = *post.task.get();
                    (&*work, number)
                };
                if let Err(panic) =
                    catch_unwind(AssertUnwindSafe(|| owners::in_part(number, part, || work(part))))
                {
                    *lock(&self.panic.0) = Some(panic);
                }
                self.undone.0.fetch_sub(1, Ordering::Release);
            }
        }
    }

    /// The life of a thread.
    fn work_until_dismissed(&self, thread: usize) {
        let (mut looks, mut rested) = (0, 0);
        loop {
            match self.duty.0.load(Ordering::Acquire) {
                DISMISSED => return,
                AT_WORK if self.posts[thread].0.has_part() => {
                    self.help(thread);
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
        for number in 1..threads {
            let board = Arc::clone(&self.board);
            let thread = thread::Builder::new().name("rustycs".into());
            // Where there are no more threads to be had, as on the web, the caller does all there is to do.
            let Ok(hired) = thread.spawn(move || board.work_until_dismissed(number)) else { break };
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
