//! Random use of everything that the public API offers, with the extremes of what it accepts: no panic, no
//! number that is not finite, and tables that agree (`World::validate`) after every operation.
//!
//! `PROPTEST_CASES=20000 cargo test --release --test it random_use` looks longer than the default does.

mod operations;
mod roles;
mod values;

use proptest::prelude::*;
use proptest::test_runner::{Config, RngSeed};
use rustycs::prelude::*;

use crate::support::{add, earth_with, run, unit_box};
use operations::{
    Operation, Player, extreme_operation, operation, operation_with_roles, usual_operation,
    usual_operation_with_roles,
};
use values::base;

/// The same cases in every run, unless another number of them is asked for.
fn config(cases: u32) -> Config {
    let config = Config { failure_persistence: None, ..Config::default() };
    if std::env::var_os("PROPTEST_CASES").is_some() {
        return config;
    }
    Config { cases, rng_seed: RngSeed::Fixed(2), ..config }
}

proptest! {
    #![proptest_config(config(1000))]

    #[test]
    fn nothing_that_the_api_accepts_breaks_a_world(operations in prop::collection::vec(operation(), 1..40)) {
        try_all(Player::new(), &operations)?;
    }
}

proptest! {
    // A program takes a seventh of a second: most of it are the sweeps of what flies at thousands of its widths in a substep.
    #![proptest_config(config(250))]

    /// A known failure: `PROPTEST_CASES=30000` still finds a program that comes to a place that is not a number. In the one that
    /// was found a needle of 1.2 km by 13 µm is in contact, positions are projected, and the tick takes 0.2 s.
    #[test]
    fn nothing_at_the_extremes_of_what_is_accepted_breaks_a_world(
        operations in base().prop_flat_map(|base| prop::collection::vec(extreme_operation(base), 1..40))
    ) {
        try_all(Player::new(), &operations)?;
    }
}

proptest! {
    #![proptest_config(config(40))]

    #[test]
    fn nothing_that_a_game_does_breaks_a_world(operations in prop::collection::vec(usual_operation(), 1..60)) {
        try_all(Player::in_a_pool(), &operations)?;
    }
}

proptest! {
    #![proptest_config(config(300))]

    #[test]
    fn whatever_the_api_accepts_comes_to_the_same_at_every_width_of_lanes(
        operations in prop::collection::vec(operation(), 1..40)
    ) {
        try_widths(Player::new, &operations)?;
    }
}

proptest! {
    #![proptest_config(config(20))]

    #[test]
    fn whatever_a_game_does_comes_to_the_same_at_every_width_of_lanes(
        operations in prop::collection::vec(usual_operation(), 1..60)
    ) {
        try_widths(Player::in_a_pool, &operations)?;
    }
}

proptest! {
    #![proptest_config(config(100))]

    #[test]
    fn whatever_the_api_accepts_comes_to_the_same_on_any_number_of_threads(
        operations in prop::collection::vec(operation(), 1..40)
    ) {
        try_threads(Player::new, &operations)?;
    }
}

proptest! {
    #![proptest_config(config(10))]

    #[test]
    fn whatever_a_game_does_comes_to_the_same_on_any_number_of_threads(
        operations in prop::collection::vec(usual_operation(), 1..60)
    ) {
        try_threads(Player::in_a_pool, &operations)?;
    }
}

proptest! {
    #![proptest_config(config(300))]

    #[test]
    fn no_role_that_the_api_accepts_breaks_a_world(
        operations in prop::collection::vec(operation_with_roles(), 1..40)
    ) {
        try_all(Player::new(), &operations)?;
    }

    #[test]
    fn roles_come_to_the_same_at_every_width_of_lanes(
        operations in prop::collection::vec(operation_with_roles(), 1..40)
    ) {
        try_widths(Player::new, &operations)?;
    }
}

proptest! {
    #![proptest_config(config(20))]

    #[test]
    fn no_role_that_a_game_gives_breaks_a_world(
        operations in prop::collection::vec(usual_operation_with_roles(), 1..60)
    ) {
        try_all(Player::in_a_pool(), &operations)?;
    }
}

fn try_threads(player: fn() -> Player, operations: &[Operation]) -> Result<(), TestCaseError> {
    let mut players = [1, 3].map(|threads| player().with_threads(threads));
    for operation in operations {
        for player in &mut players {
            player.play(operation);
        }
        let [one, three] = players.each_ref().map(Player::bits);
        prop_assert_eq!(three, one, "three threads, after {:?}", operation);
        prop_assert!(players[1].check().is_ok());
    }
    Ok(())
}

fn try_widths(player: fn() -> Player, operations: &[Operation]) -> Result<(), TestCaseError> {
    let widths = [Lanes::One, Lanes::Four, Lanes::Eight, Lanes::Sixteen];
    let mut players = widths.map(|lanes| player().with_lanes(lanes));
    for operation in operations {
        for player in &mut players {
            player.play(operation);
        }
        let [one, others @ ..] = players.each_ref().map(Player::bits);
        for (lanes, other) in widths[1..].iter().zip(others) {
            prop_assert_eq!(other, one, "{:?} at a time, after {:?}", lanes, operation);
        }
    }
    Ok(())
}

fn try_all(mut player: Player, operations: &[Operation]) -> Result<(), TestCaseError> {
    for (number, operation) in operations.iter().enumerate() {
        player.play(operation);
        if let Err(problem) = player.check() {
            return Err(TestCaseError::fail(format!("after operation {number}, {operation:?}: {problem}")));
        }
    }
    Ok(())
}

/// What random use has found is kept here, and below in words.
fn play_all(operations: &[Operation]) {
    let mut player = Player::new();
    for operation in operations {
        player.play(operation);
        player.check().unwrap();
    }
}

#[test]
fn an_empty_world_takes_every_step() {
    play_all(&[Operation::Step(3), Operation::WakeAll, Operation::Step(1)]);
}

/// A stack a million kilometres from the origin stands as it does at the origin: there a step of `f64` is
/// 1.2e-7 m, a thousandth of how far the boxes sink.
#[test]
fn a_stack_stands_a_million_kilometres_from_the_origin() {
    let far = 1e9;
    let mut world = earth_with(Settings::default());
    add(&mut world, Body::fixed(Shape::aabb(20.0, 2.0)).at([far, far - 1.0]).friction(0.6).restitution(0.0));
    let ids: Vec<BodyId> = (0..5).map(|i| add(&mut world, unit_box(far, far + 0.5 + f64::from(i)))).collect();
    run(&mut world, 10.0);
    world.validate().unwrap();
    for (i, &id) in ids.iter().enumerate() {
        let [x, y] = world.body(id).unwrap().position_f64();
        assert!((x - far).abs() < 1e-3, "box {i} drifted to {x}");
        assert!((y - far - 0.5 - i as f64).abs() < 1e-2, "box {i} is at {y}");
    }
}

/// Bodies that leave at the greatest speed for years of simulated time stay finite, and so does what is near.
#[test]
fn bodies_that_fly_away_stay_finite_and_harm_nothing() {
    let settings = Settings { tick_rate: 0.1, max_speed: 1e6, ..Settings::default() };
    let mut world = World::new(settings);
    let floor = add(&mut world, Body::fixed(Shape::aabb(10.0, 1.0)));
    let leaving: Vec<BodyId> = [(0.0, [1e18_f32, 0.0]), (100.0, [-1e18, 1e18]), (-300.0, [3.0, -1e18])]
        .into_iter()
        .map(|(x, v)| add(&mut world, unit_box(x, 20.0).velocity(v).angular_velocity(1e18)))
        .collect();
    for _ in 0..1000 {
        world.step();
    }
    world.validate().unwrap();
    for id in leaving {
        let [x, y] = world.body(id).unwrap().position_f64();
        // 10⁴ s at 10⁶ m/s.
        assert!(x.abs() <= 1.001e10 && y.abs() <= 1.001e10 && x.abs().max(y.abs()) >= 0.999e10, "({x}, {y})");
    }
    assert_eq!(world.bodies_at([0.0, 0.0]), [floor]);
}
