//! A settled step allocates nothing: buffers live in their owners and are used again.

use rustycs::{Body, Character, Ground, Lanes, Mover, Settings, Shape, World};

/// Steps a scene until it has settled, then counts the allocations of some more steps, but for those in which a body
/// falls asleep or wakes: such a step is not settled.
fn allocations(name: &str, settings: Settings) -> u64 {
    let scene = rustycs_scenes::find(name).unwrap();
    let mut world = scene.build(1, settings);
    world.divide_all_work();
    // A drum comes to its most contacts late.
    for _ in 0..1500 {
        scene.before_tick(&mut world);
        world.step();
    }
    let awake = |world: &World| world.profile().counters().awake_bodies;
    let mut count = 0;
    for _ in 0..60 {
        let before = awake(&world);
        let allocations = allocation_counter::measure(|| world.step()).count_total;
        if awake(&world) == before {
            count += allocations;
        }
    }
    count
}

#[test]
fn a_settled_step_allocates_nothing() {
    for name in ["tower", "pyramid", "card_house", "cradle", "orbit", "pile", "tumbler"] {
        for sleep in [true, false] {
            let settings = Settings { sleep, ..Settings::default() };
            assert_eq!(allocations(name, settings), 0, "{name}, sleep {sleep}");
        }
    }
}

/// Handing work over takes no memory either. Debug builds note who writes what.
#[test]
#[cfg(not(debug_assertions))]
fn a_settled_step_allocates_nothing_on_two_threads() {
    for name in ["pyramid", "pile", "tumbler"] {
        let settings = Settings { sleep: false, threads: 2, ..Settings::default() };
        assert_eq!(allocations(name, settings), 0, "{name}");
    }
}

/// A world cloned into one like it takes no memory: the state of a tick for rollback costs a copy. Then it steps as the
/// original, and, once it has settled, without allocating.
#[test]
fn a_world_cloned_into_one_like_it_allocates_nothing() {
    let scenes = ["tower", "pyramid", "card_house", "cradle", "orbit", "pile", "tumbler", "pool"];
    let joined = ["double_pendulum", "gears", "scissor_lift", "car", "radial_engine"];
    for name in scenes.into_iter().chain(joined) {
        let scene = rustycs_scenes::find(name).unwrap();
        let mut world = scene.build(1, Settings { lanes: Lanes::Eight, ..Settings::default() });
        for _ in 0..400 {
            scene.before_tick(&mut world);
            world.step();
        }
        let mut saved = world.clone();
        for _ in 0..8 {
            scene.before_tick(&mut world);
            world.step();
        }
        let ahead = world.state_hash();
        // Back by eight ticks, and there again; and all of it once more.
        for _ in 0..2 {
            let restore = allocation_counter::measure(|| world.clone_from(&saved));
            let save = allocation_counter::measure(|| saved.clone_from(&world));
            assert_eq!((restore.count_total, save.count_total), (0, 0), "{name}");
            for _ in 0..8 {
                scene.before_tick(&mut world);
                world.step();
            }
            assert_eq!(world.state_hash(), ahead, "{name}");
        }
    }
}

/// A character walks over tiles, up a step, against a crate that it pushes, and falls: without allocating.
#[test]
fn a_move_of_a_character_allocates_nothing() {
    let mut world = World::new(Settings { sleep: false, ..Settings::default() });
    world.add(Ground::from_tiles(&[true; 40], 40, 0.5).at([-10.0, -0.5])).unwrap();
    world.add(Body::fixed(Shape::rectangle(2.0, 0.2)).at([3.0, 0.1])).unwrap();
    world.add(Body::dynamic(Shape::rectangle(0.5, 0.5)).at([7.0, 0.25])).unwrap();
    let hero = Character::new(Shape::rectangle(0.5, 1.0)).at([0.0, 0.6]).step_height(0.25).push_force(100.0);
    let mut hero = Mover::new(hero).unwrap();
    let (mut count, mut walls) = (0, 0);
    for _ in 0..400 {
        world.step();
        let mut moved = None;
        let allocations =
            allocation_counter::measure(|| moved = Some(hero.move_by(&mut world, [0.04, -0.05])));
        // A force that is given is taken note of: room for the first of them.
        let pushes = moved.and_then(|moved| moved.wall).is_some();
        walls += u32::from(pushes);
        count += if pushes && walls == 1 { 0 } else { allocations.count_total };
    }
    assert!(walls > 10 && hero.position().y < 0.0, "{walls}, {:?}", hero.position());
    assert_eq!(count, 0);
}
