//! A game loop: what comes of it does not depend on how many frames a second has.

use rustycs::prelude::*;

use crate::support::{add, assert_near, assert_relative, earth_with, place, velocity};

const FRAME_RATES: [u32; 5] = [20, 30, 60, 75, 144];
const SECONDS: u32 = 4;

/// All that was reported, in order.
#[derive(Debug, Default, PartialEq)]
struct Log {
    began: Vec<ContactEvent>,
    ended: Vec<ContactEvent>,
    hits: Vec<HitEvent>,
    left: Vec<BodyId>,
    entered: Vec<SensorEvent>,
    left_zone: Vec<SensorEvent>,
}

impl Log {
    fn take(&mut self, events: &Events) {
        self.began.extend_from_slice(events.began());
        self.ended.extend_from_slice(events.ended());
        self.hits.extend_from_slice(events.hits());
        self.entered.extend_from_slice(events.sensor_began());
        self.left_zone.extend_from_slice(events.sensor_ended());
        self.left.extend_from_slice(events.left());
    }
}

/// A ship that rises out of bounds by a thrust that is given once per frame, a player that jumps twice a second and a ball that is shot every
/// fifth of one, in a pit of balls.
struct Game {
    world: World,
    ship: BodyId,
    player: BodyId,
    log: Log,
}

impl Game {
    fn new() -> Self {
        let bounds = Some(Aabb::new(Vec2::splat(-10.0), Vec2::new(10.0, 6.5)));
        let mut world = World::new(Settings { bounds, ..Settings::default() });
        world.add_force(Force::EARTH_GRAVITY);
        for (at, width, height) in [([0.0, -0.5], 12.0, 1.0), ([-6.0, 3.0], 1.0, 8.0), ([6.0, 3.0], 1.0, 8.0)]
        {
            add(&mut world, Body::fixed(Shape::aabb(width, height)).at(at));
        }
        for i in 0..20 {
            let ball = Body::dynamic(Shape::circle(0.3))
                .at([-4.0 + 0.8 * f64::from(i % 10), 2.0 + f64::from(i / 10)]);
            add(&mut world, ball);
        }
        add(&mut world, Body::fixed(Shape::circle(1.0)).at([0.0, 1.5]).sensor(true));
        let ship = add(&mut world, Body::dynamic(Shape::obb(1.0, 0.5)).at([0.0, 5.0]).mass(2.0));
        let player = Body::dynamic(Shape::obb(0.6, 1.0)).at([-3.0, 0.5]).fixed_rotation(true).mass(1.0);
        let player = add(&mut world, player);
        Self { world, ship, player, log: Log::default() }
    }

    fn frame(&mut self, seconds: f64) {
        let thrust = [7.3, 21.1];
        if let Some(mut ship) = self.world.body_mut(self.ship) {
            ship.apply_force(thrust);
        }
        let player = self.player;
        self.world.advance_with(seconds, |world| {
            if world.ticks() % 30 == 10 {
                world.body_mut(player).unwrap().apply_impulse([0.5, 4.0]);
            }
            if world.ticks() % 12 == 0 {
                let shot = Body::dynamic(Shape::circle(0.1)).at([-5.0, 4.0]).velocity([14.0, 3.0]);
                add(world, shot.density(2.0));
            }
        });
        self.log.take(self.world.events());
    }
}

#[test]
fn a_game_comes_to_the_same_at_any_frame_rate() {
    let mut stepped = Game::new();
    for _ in 0..60 * SECONDS {
        stepped.frame(1.0 / 60.0);
    }
    let Log { hits, left, ended, entered, left_zone, .. } = &stepped.log;
    assert!(hits.len() > 50 && !ended.is_empty() && !left.is_empty(), "a dull game");
    assert!(!entered.is_empty() && !left_zone.is_empty(), "nothing passes the zone");
    for rate in FRAME_RATES {
        let mut game = Game::new();
        for _ in 0..rate * SECONDS {
            game.frame(1.0 / f64::from(rate));
        }
        assert_eq!(game.world.ticks(), stepped.world.ticks(), "{rate} frames per second");
        assert!(game.log == stepped.log, "other events at {rate} frames per second");
        assert_eq!(game.world.state_hash(), stepped.world.state_hash(), "{rate} frames per second");
    }
}

/// v = F t / m, to the bit: 1 m/s in each of 60 ticks.
#[test]
fn a_thrust_given_in_each_frame_gives_the_same_speed_at_any_frame_rate() {
    for rate in FRAME_RATES {
        let mut world = World::new(Settings::default());
        let ship = add(&mut world, Body::dynamic(Shape::obb(1.0, 1.0)).mass(1.0));
        for _ in 0..rate {
            world.body_mut(ship).unwrap().apply_force([60.0, 0.0]);
            world.advance(1.0 / f64::from(rate));
        }
        assert_eq!(velocity(&world, ship), [60.0, 0.0], "{rate} frames per second");
    }
}

/// m v = Σ F t over frames of any length, with forces in some of them: also in those that have no tick.
#[test]
fn a_force_of_one_frame_acts_for_the_time_of_that_frame() {
    let mut world = World::new(Settings::default());
    let ship = add(&mut world, Body::dynamic(Shape::obb(1.0, 1.0)).mass(2.0).fixed_rotation(true));
    // Thirtieths of a tick; together 300, ten ticks.
    let frames =
        [(7, 3.0), (40, 0.0), (2, 500.0), (9, -4.0), (95, 1.5), (12, 0.0), (30, 8.0), (45, -2.0), (60, 1.0)];
    let (mut impulse, mut ticks) = (0.0, 0);
    for (length, force) in frames {
        let seconds = f64::from(length) / 30.0 / 60.0;
        world.body_mut(ship).unwrap().apply_force([0.5 * force, 0.0]);
        world.body_mut(ship).unwrap().apply_force([0.5 * force, force]);
        ticks += world.advance(seconds);
        impulse += f64::from(force) * seconds;
    }
    assert_eq!(ticks, 10);
    // Ten roundings of forces and of speeds of up to 0.3 m/s.
    assert_near(velocity(&world, ship)[0], impulse / 2.0, 3e-7, "speed");
    assert_near(velocity(&world, ship)[1], impulse / 2.0, 3e-7, "speed");
    // And nothing is left of it.
    world.advance(0.1);
    assert_near(velocity(&world, ship)[0], impulse / 2.0, 3e-7, "speed");
}

/// Half a frame of torque over I = m (1 + 1)/12.
#[test]
fn a_torque_of_a_frame_without_a_tick_waits_for_the_next() {
    let mut world = World::new(Settings::default());
    let wheel = add(&mut world, Body::dynamic(Shape::obb(1.0, 1.0)).mass(6.0));
    world.body_mut(wheel).unwrap().apply_torque(60.0);
    assert_eq!(world.advance(0.5 / 60.0), 0);
    assert_eq!(world.advance(0.5 / 60.0), 1);
    assert_relative(f64::from(world.body(wheel).unwrap().angular_velocity()), 0.5, 1e-6, "spin");
}

/// Three ticks are taken of the time of twelve, and so much of the force acts.
#[test]
fn time_that_is_dropped_takes_its_forces_along() {
    let mut world = World::new(Settings { max_ticks_per_advance: 3, ..Settings::default() });
    let ship = add(&mut world, Body::dynamic(Shape::obb(1.0, 1.0)).mass(1.0));
    world.body_mut(ship).unwrap().apply_force([60.0, 0.0]);
    assert_eq!(world.advance(12.0 / 60.0), 3);
    assert_relative(world.dropped_seconds(), 9.0 / 60.0, 1e-12, "dropped");
    assert_eq!(world.advance(1.0 / 60.0), 1);
    assert_eq!(velocity(&world, ship), [3.0, 0.0]);
}

/// A body that comes to the slot of one that was pushed is not.
#[test]
fn a_force_that_waits_goes_with_its_body() {
    let mut world = World::new(Settings::default());
    let body = || Body::dynamic(Shape::obb(1.0, 1.0)).mass(1.0);
    let gone = add(&mut world, body());
    world.body_mut(gone).unwrap().apply_force([60.0, 0.0]);
    world.advance(0.5 / 60.0);
    world.remove(gone);
    let other = add(&mut world, body());
    world.advance(0.5 / 60.0);
    assert_eq!(velocity(&world, other), [0.0, 0.0]);
    // Nor is one that comes to it before the frame ends.
    world.body_mut(other).unwrap().apply_force([60.0, 0.0]);
    world.remove(other);
    let last = add(&mut world, body());
    world.advance(1.0 / 60.0);
    assert_eq!(velocity(&world, last), [0.0, 0.0]);
}

/// Four ticks of both, and the half frame that is left of the first.
#[test]
fn a_force_given_before_each_tick_is_that_of_the_tick() {
    let mut world = World::new(Settings::default());
    let ship = add(&mut world, Body::dynamic(Shape::obb(1.0, 1.0)).mass(1.0));
    world.body_mut(ship).unwrap().apply_force([60.0, 0.0]);
    let ticks = world.advance_with(4.5 / 60.0, |world| {
        world.body_mut(ship).unwrap().apply_force([0.0, 60.0]);
    });
    assert_eq!((ticks, velocity(&world, ship)), (4, [4.0, 4.0]));
    world.advance(0.5 / 60.0);
    assert_relative(velocity(&world, ship)[0], 4.5, 1e-7, "of the frame");
    assert_eq!(velocity(&world, ship)[1], 4.0);
}

/// Of a ball that bounces through a zone, in frames of eight ticks: each event has the number of its tick, and so all can be put in order.
#[test]
fn events_of_one_frame_can_be_ordered_by_their_ticks() {
    let mut world = earth_with(Settings { hit_threshold: 0.1, ..Settings::default() });
    add(&mut world, Body::fixed(Shape::rectangle(9.0, 1.0)).at([0.0, -0.5]).restitution(1.0));
    add(&mut world, Body::fixed(Shape::rectangle(9.0, 0.1)).at([0.0, 0.5]).sensor(true));
    add(&mut world, Body::dynamic(Shape::circle(0.1)).at([0.0, 1.0]).restitution(1.0));
    let mut stepped = world.clone();
    let listed = |events: &Events| {
        let contacts =
            |name, events: &[ContactEvent]| events.iter().map(move |event| (event.tick, name)).collect();
        let sensors =
            |name, events: &[SensorEvent]| events.iter().map(move |event| (event.tick, name)).collect();
        let all: [Vec<(u64, &str)>; 5] = [
            contacts("touches", events.began()),
            contacts("parts", events.ended()),
            sensors("enters", events.sensor_began()),
            sensors("leaves", events.sensor_ended()),
            events.hits().iter().map(|hit| (hit.tick, "hits")).collect(),
        ];
        let mut all = all.concat();
        all.sort_unstable();
        all
    };
    let (mut of_frames, mut of_steps) = (Vec::new(), Vec::new());
    for _ in 0..20 {
        assert_eq!(
            world.advance_then(8.0 / 60.0, |world| {
                let last = world.ticks();
                assert!(listed(world.events()).iter().all(|&(tick, _)| tick > last - 8 && tick <= last));
            }),
            8
        );
        of_frames.extend(listed(world.events()));
        for _ in 0..8 {
            stepped.step();
            let events = listed(stepped.events());
            assert!(events.iter().all(|&(tick, _)| tick == stepped.ticks()), "{events:?}");
            of_steps.extend(events);
        }
    }
    assert_eq!(of_frames, of_steps);
    let in_one_frame =
        of_frames.windows(2).filter(|pair| pair[0].0 < pair[1].0 && pair[0].0 / 8 == pair[1].0 / 8);
    assert!(in_one_frame.count() > 5, "{of_frames:?}");
}

#[test]
fn a_frame_without_a_tick_reports_nothing() {
    let mut world = World::new(Settings::default());
    add(&mut world, Body::fixed(Shape::aabb(9.0, 1.0)));
    add(&mut world, Body::dynamic(Shape::circle(0.5)).at([0.0, 1.05]).velocity([0.0, -9.0]));
    assert_eq!((world.advance(2.0 / 60.0), world.events().hits().len()), (2, 1));
    assert_eq!((world.advance(0.1 / 60.0), world.events().hits().len()), (0, 0));
}

#[test]
fn what_is_called_before_a_tick_sees_each_and_may_change_the_rate() {
    let mut world = World::new(Settings::default());
    let mut seen = Vec::new();
    world.advance_with(0.1, |world| {
        seen.push(world.ticks());
        if world.ticks() == 2 {
            world.set_settings(Settings { tick_rate: 120.0, ..Settings::default() }).unwrap();
        }
    });
    // Two ticks of 1/60 s, and eight of 1/120 s.
    assert_eq!(seen, (0..8).collect::<Vec<_>>());
    assert_eq!(world.advance(2.0 / 120.0), 2);
}

/// 30 ticks at 60 per second, 60 at 240, 5 at 20: half a second, a fourth, a fourth.
#[test]
fn time_is_the_sum_of_ticks_as_long_as_they_were() {
    let mut world = World::new(Settings::default());
    let mut before = 0.0;
    for (tick_rate, ticks, time) in [(60.0, 30, 0.5), (240.0, 60, 0.75), (20.0, 5, 1.0), (20.0, 0, 1.0)] {
        world.set_settings(Settings { tick_rate, ..Settings::default() }).unwrap();
        assert_near(world.time(), before, 1e-12, "a change of the rate takes no time");
        (0..ticks).for_each(|_| world.step());
        assert_near(world.time(), time, 1e-12, "time");
        before = time;
    }
}

/// At 144 frames per second a body at 6 m/s is seen to move by 6/144 m in each, a tick late.
#[test]
fn a_body_is_drawn_between_the_poses_of_its_last_two_ticks() {
    let mut world = World::new(Settings::default());
    let ship = Body::dynamic(Shape::obb(1.0, 0.5)).velocity([6.0, 0.0]).angular_velocity(3.0);
    let ship = add(&mut world, ship);
    for frame in 1..=144_i16 {
        world.advance(1.0 / 144.0);
        let Pose { center, rotation } = world.body(ship).unwrap().interpolated_pose(world.alpha());
        let shown = (f64::from(frame) / 144.0 - 1.0 / 60.0).max(0.0);
        assert_near(center.x, 6.0 * shown, 1e-5, "place");
        assert_near(f64::from(rotation.angle()), 3.0 * shown, 1e-5, "angle");
    }
    let before = world.body(ship).unwrap().pose();
    world.step();
    let view = world.body(ship).unwrap();
    assert_eq!(view.previous_pose(), before);
    assert_eq!((view.interpolated_pose(0.0), view.interpolated_pose(1.0)), (before, view.pose()));
}

/// What is put somewhere is there, and not on its way; what it did besides goes on.
#[test]
fn what_is_put_somewhere_is_not_drawn_on_its_way_there() {
    let mut world = World::new(Settings::default());
    let body = Body::dynamic(Shape::obb(1.0, 0.5)).velocity([6.0, 0.0]).angular_velocity(3.0);
    let ids = [(); 3].map(|()| add(&mut world, body.clone()));
    world.step();
    let [of_centre, of_angle, added] = ids;
    world.body_mut(of_centre).unwrap().set_position([50.0, 0.0]).unwrap();
    world.body_mut(of_angle).unwrap().set_angle(2.0).unwrap();
    world.remove(added);
    let added = add(&mut world, body.at([7.0, 7.0]));
    let shown = |id| world.body(id).unwrap().interpolated_pose(0.5);
    assert_eq!(shown(of_centre).center, Point::new(50.0, 0.0));
    assert_near(f64::from(shown(of_centre).rotation.angle()), 3.0 * 0.5 / 60.0, 1e-6, "it turns on");
    assert_near(f64::from(shown(of_angle).rotation.angle()), 2.0, 1e-6, "angle");
    assert_near(shown(of_angle).center.x, 6.0 * 0.5 / 60.0, 1e-6, "it moves on");
    assert_eq!(shown(added).center, Point::new(7.0, 7.0));
}

/// A body that falls asleep, wakes or never moves is drawn where it is.
#[test]
fn what_sleeps_is_drawn_where_it_is() {
    let mut world = World::new(Settings::default());
    world.add_force(Force::EARTH_GRAVITY);
    let floor = add(&mut world, Body::fixed(Shape::aabb(20.0, 1.0)));
    let box_ = add(&mut world, Body::dynamic(Shape::obb(1.0, 1.0)).at([0.0, 1.0]));
    while !world.body(box_).unwrap().is_sleeping() {
        world.step();
    }
    for wake in [false, true] {
        if wake {
            world.body_mut(box_).unwrap().wake();
        }
        for id in [floor, box_] {
            let view = world.body(id).unwrap();
            assert_eq!((view.previous_pose(), view.interpolated_pose(0.25)), (view.pose(), view.pose()));
        }
    }
    assert!(place(&world, box_)[1] > 0.99);
}
