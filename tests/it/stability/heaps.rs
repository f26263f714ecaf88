//! Heaps of bodies of every size and material: light ones under heavy ones.

use std::f64::consts::TAU;
use std::ops::Range;

use rustycs::prelude::*;
use rustycs_cases::chance::Chance;

/// Of the contacts of a heap at rest, how many are deeper than 1 cm, and how many there are.
fn deep_contacts(seed: u64) -> [usize; 2] {
    let scene = rustycs_scenes::find("pile").expect("it is the first scene");
    let mut world = scene.build(seed, Settings::default());
    (0..600).for_each(|_| world.step());
    let deepest =
        |contact: ContactRef<'_>| contact.points().iter().map(|point| -point.separation).fold(0.0, f32::max);
    [world.contacts().filter(|&contact| deepest(contact) > 0.01).count(), world.contacts().count()]
}

/// Densities are 78 : 1 and masses up to 1460 : 1. If contacts yielded to all that they bear, one in five would be deeper than
/// 1 cm: a light box of 0.2 m under a hundred times its mass by 34 mm. One in 700 is, on average of fifty heaps; up to nine of one heap are, so
/// that of twelve heaps more than one in 250 would be hardly by chance.
#[test]
fn light_bodies_do_not_sink_into_heavy_ones() {
    let heaps: Vec<[usize; 2]> = (21..33).map(deep_contacts).collect();
    let [deep, all] = [0, 1].map(|index| heaps.iter().map(|heap| heap[index]).sum::<usize>());
    assert!(deep <= all / 250, "{deep} of {all} contacts are deeper than 1 cm: {heaps:?}");
}

/// The substeps of a world are as many as are asked for, but while light bodies bear great loads in a heap too large for the direct solve.
#[test]
fn a_step_takes_more_substeps_only_while_a_heap_needs_them() {
    let scene = rustycs_scenes::find("pile").expect("it is the first scene");
    let mut world = scene.build(21, Settings::default());
    let asked = Settings::default().substeps;
    let substeps = |world: &World| world.profile().counters().substeps;
    world.step();
    assert_eq!(substeps(&world), asked, "what falls bears nothing yet");
    (0..600).for_each(|_| world.step());
    assert!(substeps(&world) > asked);
    let mut with_joints = world.clone();
    for number in 0..33 {
        let mut put = |y: f32| {
            let body = Body::dynamic(Shape::circle(0.1)).at([100.0 + number as f32, y]).gravity_scale(0.0);
            with_joints.add(body.velocity([0.0, 1.0])).unwrap()
        };
        let pair = [put(0.0), put(1.0)];
        with_joints.add_joint(Joint::rope(pair[0], pair[1]).max_length(2.0)).unwrap();
    }
    (0..100).for_each(|_| with_joints.step());
    assert_eq!(substeps(&with_joints), asked, "joints would take too long");
    world.retain(|body| body.body_type() != BodyType::Dynamic);
    world.add(Body::dynamic(Shape::obb(1.0, 1.0)).at([0.0, 50.0])).unwrap();
    (0..100).for_each(|_| world.step());
    assert_eq!(substeps(&world), asked, "the heap is gone");
}

/// A pit 8 m wide.
fn pit() -> World {
    let mut world = World::default();
    world.add_force(Force::EARTH_GRAVITY);
    world.add(Body::fixed(Shape::aabb(8.0, 1.0)).at([0.0, -0.5])).unwrap();
    for side in [-1.0, 1.0] {
        world.add(Body::fixed(Shape::aabb(1.0, 20.0)).at([side * 4.5, 10.0])).unwrap();
    }
    world
}

/// Eighty boxes of one density in it.
fn pit_of_boxes(seed: u64) -> World {
    let mut world = pit();
    let mut chance = Chance(seed);
    for index in 0..80 {
        let [column, row] = [index % 8, index / 8].map(f64::from);
        let sides = [(); 2].map(|()| chance.between(0.3, 0.65) as f32);
        let body = Body::dynamic(Shape::obb(sides[0], sides[1])).at([column - 3.5, row + 1.0]);
        world.add(body.angle(chance.between(-3.0, 3.0) as f32)).unwrap();
    }
    world
}

/// While contacts come and go, the direct solve takes tens of times as long as sweeps, and in heaps of one density it saves no more than a
/// few millimetres. What it may take beyond its worth is gone after ten steps, and is had again a few times as the heap settles.
#[test]
fn heaps_of_one_density_are_soon_left_to_sweeps() {
    let mut direct = 0;
    for seed in 1..=3 {
        let mut world = pit_of_boxes(seed);
        for _ in 0..600 {
            world.step();
            direct += usize::from(world.profile().counters().direct_bodies > 40);
        }
    }
    assert!(direct <= 3 * 30, "solved directly in {direct} of 1800 steps");
}

/// A few bodies that are struck are solved directly for some steps. What they fall on, and what falls on them, is not for that reason: its
/// loads are small.
#[test]
fn a_heap_is_not_solved_directly_for_what_strikes_it() {
    let scene = rustycs_scenes::find("pool").expect("it is a scene");
    for seed in 1..=3 {
        let mut world = scene.build(seed, Settings::default());
        let mut most = 0;
        for _ in 0..120 {
            world.step();
            most = most.max(world.profile().counters().direct_bodies);
        }
        let count = world.body_count();
        assert!(most <= count / 4, "seed {seed}: {most} of {count} bodies");
    }
}

/// A hundred discs and boxes in it, of densities up to 1000 : 1.
fn pit_of_all_masses(seed: u64) -> World {
    let mut world = pit();
    let mut chance = Chance(seed);
    for index in 0..100 {
        let half = chance.between(0.08, 0.4) as f32;
        let shape = match chance.one_of(2) {
            0 => Shape::circle(half),
            _ => Shape::obb(2.0 * half, chance.between(0.1, 0.6) as f32),
        };
        let place = [chance.between(-3.0, 3.0), 1.0 + 0.15 * f64::from(index)];
        let density = 10.0_f64.powf(chance.between(0.0, 3.0)) as f32;
        world
            .add(Body::dynamic(shape).at(place).angle(chance.between(0.0, 6.0) as f32).density(density))
            .unwrap();
    }
    world
}

/// Where substeps are refined, a direct solve takes as many times as long, and where it comes to no end its sweeps count too: a heap that is still
/// moving is left to sweeps within three steps of 32 substeps, or twice as many of 16, and tried four times. It was solved so for nearly half of
/// all steps.
#[test]
fn heaps_of_all_masses_are_soon_left_to_refined_sweeps() {
    let (mut direct, mut refined) = (0, 0);
    for seed in 1..=4 {
        let mut world = pit_of_all_masses(seed);
        for _ in 0..450 {
            world.step();
            let counters = world.profile().counters();
            refined += usize::from(counters.substeps > 4);
            if counters.substeps > 4 && counters.direct_bodies > 40 {
                direct += counters.substeps;
            }
        }
    }
    assert!(refined > 900, "refined in {refined} of 1800 steps");
    assert!(direct <= 4 * 4 * 3 * 32, "solved directly in {direct} substeps, of {refined} steps");
}

/// Three hundred discs, boxes and regular polygons of 0.3 to 0.84 m, of densities up to 20 : 1, that fall into a pit 14 m wide.
fn heap_of_all_shapes(seed: u64) -> World {
    let mut world = World::new(Settings { sleep: false, ..Settings::default() });
    world.add_force(Force::EARTH_GRAVITY);
    world.add(Body::fixed(Shape::aabb(18.0, 2.0)).at([0.0, -1.0])).unwrap();
    for side in [-1.0, 1.0] {
        world.add(Body::fixed(Shape::aabb(2.0, 44.0)).at([side * 8.0, 20.0])).unwrap();
    }
    let mut chance = Chance(seed);
    for index in 0..300 {
        let [column, row] = [index % 14, index / 14].map(f64::from);
        let shape = any_shape(&mut chance, 0.15..0.42);
        let density = 20.0_f64.powf(chance.between(0.0, 1.0)) as f32;
        let place = [0.95 * (column - 6.5), 1.5 + 0.95 * row];
        world
            .add(Body::dynamic(shape).at(place).angle(chance.between(0.0, TAU) as f32).density(density))
            .unwrap();
    }
    world
}

/// A disc, box or regular polygon of a radius within these, m.
fn any_shape(chance: &mut Chance, radii: Range<f64>) -> Shape {
    let reach = chance.between(radii.start, radii.end);
    let sides = chance.between(0.6, 0.9);
    let corners = 3 + chance.one_of(4);
    let corner = |number: u32| {
        let (y, x) = (TAU * f64::from(number) / f64::from(corners)).sin_cos();
        [reach * x, reach * y].map(|part| part as f32)
    };
    match chance.one_of(3) {
        0 => Shape::circle(reach as f32),
        1 => Shape::obb(2.0 * (reach * sides) as f32, 2.0 * (reach * (1.0 - sides * sides).sqrt()) as f32),
        _ => Shape::polygon((0..corners).map(corner).collect::<Vec<_>>()).unwrap(),
    }
}

/// A load that lasts is borne with 5 mm of overlap, and a tenth of what would be more: with 15 mm where it would be 10 cm. What is shaken by its load
/// goes in deeper, by 30 mm in one of these heaps if moments of inertia were not scaled.
#[test]
fn light_bodies_are_not_shaken_by_what_lies_on_them() {
    for seed in 1..=24 {
        let mut world = heap_of_all_shapes(seed);
        (0..20 * 60).for_each(|_| world.step());
        let deepest = world.error().penetration;
        assert!(deepest < 0.015, "seed {seed}: {deepest} m deep");
    }
}

/// Sixty stones of a centimetre, without discs, on a flat ground: as the cases of gravel, of which each is one draw. Whether such a heap has come to rest
/// is chance: stones that lean on each other at the limit of friction creep for seconds, and slip. But most have, and none is shaken for as long as it
/// is watched: what slips comes to rest within half a second.
#[test]
fn most_heaps_of_gravel_are_at_rest_after_nine_seconds() {
    let mut moving = 0;
    for seed in 1..=16 {
        let mut world = World::new(Settings::default());
        world.add_force(Force::EARTH_GRAVITY);
        world.add(Body::fixed(Shape::aabb(100.0, 100.0)).at([0.0, -50.0])).unwrap();
        let mut chance = Chance(seed);
        for index in 0..60 {
            let [column, row] = [index % 6, index / 6].map(f64::from);
            let shape = match any_shape(&mut chance, 0.005..0.005) {
                Shape::Circle(_) => Shape::obb(0.007, 0.007),
                other => other,
            };
            let stone =
                Body::dynamic(shape).at([0.012 * (column - 2.5 + 0.1 * (row % 2.0)), 0.012 * row + 0.0075]);
            world.add(stone.angle(chance.between(0.0, TAU) as f32).friction(0.6).restitution(0.0)).unwrap();
        }
        let (mut fast_ticks, mut moves) = (0, false);
        for tick in 0..600 {
            world.step();
            let fastest = world.bodies().map(|(_, body)| body.velocity().length()).fold(0.0, f32::max);
            fast_ticks += u32::from(tick >= 300 && fastest > 1e-3);
            moves |= tick >= 540 && fastest > 1e-4;
        }
        assert!(fast_ticks <= 90, "seed {seed}: shaken for {fast_ticks} of 300 ticks");
        moving += u32::from(moves);
    }
    assert!(moving <= 8, "{moving} of 16 heaps still move");
}
