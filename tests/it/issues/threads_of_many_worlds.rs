//! Every world had threads of its own, and kept them when it asked for none any more: a thousand worlds had thousands.

use std::process::Command;
use std::time::{Duration, Instant};

use rustycs::prelude::*;

const NAME: &str =
    "issues::threads_of_many_worlds::worlds_share_their_threads_and_end_them_when_none_are_asked_for";
const ON_ITS_OWN: &str = "RUSTYCS_COUNTS_THREADS";

/// How many threads of the library this process has.
fn threads() -> usize {
    let tasks = std::fs::read_dir("/proc/self/task").expect("Linux has it");
    let name = |task: std::io::Result<std::fs::DirEntry>| {
        std::fs::read_to_string(task.ok()?.path().join("comm")).ok()
    };
    tasks.filter_map(name).filter(|name| name.trim() == "rustycs").count()
}

/// A thread that was waited for is listed for a moment longer.
fn assert_threads(expected: usize, when: &str) {
    let start = Instant::now();
    while threads() != expected && start.elapsed() < Duration::from_secs(10) {
        std::thread::yield_now();
    }
    assert_eq!(threads(), expected, "{when}");
}

/// Other tests have threads too: this one counts in a process of its own.
#[test]
fn worlds_share_their_threads_and_end_them_when_none_are_asked_for() {
    if std::env::var_os(ON_ITS_OWN).is_none() {
        let this = std::env::current_exe().expect("the tests are a program");
        let result =
            Command::new(this).args(["--exact", NAME]).env(ON_ITS_OWN, "1").output().expect("it runs");
        let said = String::from_utf8_lossy(&result.stdout);
        assert!(result.status.success() && said.contains("1 passed"), "{said}");
        return;
    }
    let settings = |threads| Settings { threads, ..Settings::default() };
    let mut worlds: Vec<World> = (0..100)
        .map(|_| {
            let mut world = World::new(settings(4));
            world.divide_all_work();
            world.add(Body::dynamic(Shape::circle(0.5))).expect("a good body");
            world
        })
        .collect();
    assert_threads(0, "before the first step");
    worlds.iter_mut().for_each(World::step);
    assert_threads(3, "after a step of each, one after the other");
    for world in &mut worlds {
        world.set_settings(settings(1)).expect("good settings");
        world.step();
    }
    assert_threads(0, "after a step on one thread");
    worlds[0].set_settings(settings(2)).expect("good settings");
    worlds[0].step();
    assert_threads(1, "after a step on two threads");
    drop(worlds);
    assert_threads(0, "after all worlds are gone");
}
