//! How much sooner a step is done by several threads, and that small worlds do not pay for them.
//!
//! `cargo bench --bench threads`, or `-- --threads 4` for another number than two, `-- --only pyramid` for scenes with
//! that in their name, `-- --long` for five times as many rounds. Worlds of one and of several threads start from
//! clones of one state and step in turn, in this process; of each tick the shortest time of all rounds counts, since
//! other work on the machine only ever adds time. It takes under a minute. The machine should have nothing else to do:
//! a thread that has to share its core is of little help, and the system may put both on the same one.

use std::time::Instant;

use rustycs::prelude::*;

/// Ticks of a round.
const TICKS: usize = 10;

/// A scene, the ticks before the first round, and the rounds.
struct Course {
    name: &'static str,
    build: fn(Settings) -> World,
    warm_up: usize,
    rounds: usize,
}

const COURSES: [Course; 7] = [
    Course { name: "1 ball", build: one_ball, warm_up: 60, rounds: 1000 },
    Course { name: "pile of 50", build: |settings| pile(50, settings), warm_up: 200, rounds: 400 },
    Course { name: "pile of 300", build: |settings| pile(300, settings), warm_up: 200, rounds: 200 },
    Course { name: "pile of 1000", build: |settings| pile(1000, settings), warm_up: 200, rounds: 100 },
    Course { name: "large pyramid", build: large_pyramid, warm_up: 60, rounds: 80 },
    Course { name: "many pyramids", build: many_pyramids, warm_up: 30, rounds: 20 },
    Course { name: "pile of 16000", build: |settings| pile(16_000, settings), warm_up: 300, rounds: 8 },
];

fn heavy(settings: Settings) -> World {
    let mut world = World::new(settings);
    world.add_force(Force::EARTH_GRAVITY);
    world
}

fn put(world: &mut World, body: Body) {
    world.add(body.friction(0.6).restitution(0.0)).expect("a good body");
}

fn one_ball(settings: Settings) -> World {
    let mut world = heavy(settings);
    put(&mut world, Body::fixed(Shape::obb(20.0, 1.0)).at([0.0, -0.5]));
    put(&mut world, Body::dynamic(Shape::circle(0.5)).at([0.0, 0.5]));
    world
}

fn pile(count: usize, settings: Settings) -> World {
    rustycs_scenes::pile::build_with(count, 1, settings)
}

/// Boxes of 1 m without gaps, with their base at the height `bottom`.
fn put_pyramid(world: &mut World, base: u32, middle: f64, bottom: f64) {
    for row in 0..base {
        for column in 0..base - row {
            let x = middle + f64::from(column) - 0.5 * f64::from(base - row - 1);
            put(world, Body::dynamic(Shape::obb(1.0, 1.0)).at([x, bottom + f64::from(row) + 0.5]));
        }
    }
}

/// 5050 boxes.
fn large_pyramid(settings: Settings) -> World {
    let mut world = heavy(settings);
    put(&mut world, Body::fixed(Shape::obb(200.0, 2.0)).at([0.0, -1.0]));
    put_pyramid(&mut world, 100, 0.0, 0.0);
    world
}

/// 20 × 20 pyramids of 55 boxes, each row of them on a floor of its own.
fn many_pyramids(settings: Settings) -> World {
    let mut world = heavy(settings);
    for row in 0..20 {
        let bottom = 12.0 * f64::from(row);
        put(&mut world, Body::fixed(Shape::obb(220.0, 1.0)).at([0.0, bottom - 0.5]));
        for column in 0..20 {
            put_pyramid(&mut world, 10, 11.0 * (f64::from(column) - 9.5), bottom);
        }
    }
    world
}

/// Time per step on one thread and on so many, s.
fn measure(course: &Course, threads: usize, rounds: usize) -> [f64; 2] {
    let settings = Settings { sleep: false, ..Settings::default() };
    let mut start = (course.build)(settings.clone());
    for _ in 0..course.warm_up {
        start.step();
    }
    let mut best = [[f64::INFINITY; TICKS]; 2];
    for _ in 0..rounds {
        let hashes = [0, 1].map(|which| {
            let mut world = start.clone();
            let threads = if which == 0 { 1 } else { threads };
            world.set_settings(Settings { threads, ..settings.clone() }).expect("1 to 16 threads");
            // It starts the threads.
            world.step();
            for best in &mut best[which] {
                let begin = Instant::now();
                world.step();
                *best = best.min(begin.elapsed().as_secs_f64());
            }
            world.state_hash()
        });
        assert_eq!(hashes[0], hashes[1], "{}: the number of threads changes the result", course.name);
    }
    best.map(|best| best.iter().sum::<f64>() / TICKS as f64)
}

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    let after = |name: &str| {
        let at = arguments.iter().position(|argument| argument == name)?;
        arguments.get(at + 1)
    };
    let threads = after("--threads").map_or(2, |number| number.parse().expect("--threads takes a number"));
    let times = if arguments.iter().any(|argument| argument == "--long") { 5 } else { 1 };
    let is_meant = |course: &&Course| after("--only").is_none_or(|part| course.name.contains(part.as_str()));
    println!("scene            µs on 1 thread   µs on {threads}   times as fast");
    for course in COURSES.iter().filter(is_meant) {
        let [one, many] = measure(course, threads, times * course.rounds);
        println!("{:15} {:15.2} {:9.2} {:15.2}", course.name, one * 1e6, many * 1e6, one / many);
    }
}
