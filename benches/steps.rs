//! How long a step takes, by scene, and how long one detection takes.
//!
//! `cargo bench --bench steps`

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use rustycs::collision::detect;
use rustycs::prelude::*;

fn settings() -> Settings {
    Settings { sleep: false, ..Settings::default() }
}

/// A step of each scene after two seconds: bodies have met and none sleeps.
fn step_of_each_scene(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("step");
    group.sample_size(20);
    for scene in rustycs_scenes::all() {
        let mut world = scene.build(1, settings());
        for _ in 0..120 {
            scene.before_tick(&mut world);
            world.step();
        }
        let mut tick = || {
            scene.before_tick(&mut world);
            world.step();
        };
        group.bench_function(scene.name, |bencher| bencher.iter(&mut tick));
    }
    group.finish();
}

/// One detection per pair of shapes, overlapping by a little.
fn detection_of_each_pair(criterion: &mut Criterion) {
    let polygon = Shape::polygon([[0.5, 0.0], [0.2, 0.5], [-0.4, 0.3], [-0.4, -0.3], [0.2, -0.5]])
        .expect("a convex pentagon");
    let shapes = [
        ("circle", Shape::circle(0.5)),
        ("aabb", Shape::aabb(1.0, 1.0)),
        ("obb", Shape::obb(1.0, 1.0)),
        ("polygon", polygon),
    ];
    let mut group = criterion.benchmark_group("detect");
    for (index, (name_a, a)) in shapes.iter().enumerate() {
        for (name_b, b) in &shapes[index..] {
            let (pose_a, pose_b) = (Pose::at([0.0, 0.0]), Pose::new([0.1, 0.85], 0.1));
            group.bench_function(format!("{name_a}-{name_b}"), |bencher| {
                bencher.iter(|| detect(black_box(a), pose_a, black_box(b), black_box(pose_b)));
            });
        }
    }
    group.finish();
}

fn clone_of_a_world(criterion: &mut Criterion) {
    let mut world = rustycs_scenes::pile::build_with(1000, 1, settings());
    for _ in 0..300 {
        world.step();
    }
    criterion.bench_function("clone of a pile of 1000", |bencher| bencher.iter(|| black_box(world.clone())));
}

criterion_group!(benches, step_of_each_scene, detection_of_each_pair, clone_of_a_world);
criterion_main!(benches);
