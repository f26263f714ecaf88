//! Every shortcut beside the long way: two worlds that differ in one setting and must come to the same.

use rustycs::prelude::*;

use crate::support::{
    G, add, add_floor, assert_near, earth_with, place, run, space, spin, unit_box, velocity,
};

/// A world with a shortcut, and the same without.
fn twins(without: Settings, build: impl Fn(&mut World) -> Vec<BodyId>) -> [(World, Vec<BodyId>); 2] {
    [Settings::default(), without].map(|settings| {
        let mut world = earth_with(settings);
        let ids = build(&mut world);
        (world, ids)
    })
}

fn fresh() -> Settings {
    Settings { recycling: false, ..Settings::default() }
}

/// Runs both and compares places (m) and speeds (m/s) of all bodies.
#[track_caller]
fn assert_alike(twins: &mut [(World, Vec<BodyId>); 2], seconds: f64, metres: f64, speed: f64) {
    for (world, _) in twins.iter_mut() {
        run(world, seconds);
        world.validate().unwrap();
    }
    let [(with, ids), (without, others)] = twins;
    for (&id, &other) in ids.iter().zip(others.iter()) {
        for axis in 0..2 {
            assert_near(place(with, id)[axis], place(without, other)[axis], metres, "place");
            assert_near(velocity(with, id)[axis], velocity(without, other)[axis], speed, "velocity");
        }
        assert_near(spin(with, id), spin(without, other), speed, "spin");
    }
}

/// Discs or axis-aligned boxes of 0.2 m that fly about in a box, slow down and touch more and more.
fn crowd(settings: &Settings, shape: impl Fn(usize) -> Shape, change: impl Fn(Body, usize) -> Body) -> World {
    let mut world = World::new(Settings { friction_mix: Mix::Min, sleep: false, ..settings.clone() });
    for (x, y, width, height) in
        [(-3.0, 0.0, 1.0, 7.0), (3.0, 0.0, 1.0, 7.0), (0.0, -3.0, 7.0, 1.0), (0.0, 3.0, 7.0, 1.0)]
    {
        add(&mut world, Body::fixed(Shape::aabb(width, height)).at([x, y]).friction(1.0));
    }
    for index in 0..256_usize {
        let (column, row) = ((index % 16) as f32, (index / 16) as f32);
        let Rot { c, s } = Rot::from_angle(index as f32);
        let body = Body::dynamic(shape(index)).at([0.29 * (column - 7.5), 0.29 * (row - 7.5)]);
        add(&mut world, change(body.velocity([3.0 * c, 3.0 * s]).restitution(0.0), index));
    }
    world
}

type Build<'a> = &'a dyn Fn(&Settings) -> World;

/// Contacts of one point or two, with friction or without, of bodies that turn or do not: alone and mixed, each
/// with a kernel that leaves out what is not there, and with the one that leaves out nothing. Spin that nothing can
/// change, and friction that ceases under way, count too.
#[test]
fn fitted_kernels_change_no_bit() {
    let disc = |_| Shape::circle(0.1);
    let square = |_| Shape::aabb(0.2, 0.2);
    let mixed = |index| match index % 3 {
        0 => Shape::circle(0.1),
        1 => Shape::aabb(0.2, 0.2),
        _ => Shape::obb(0.2, 0.18),
    };
    let smooth = |body: Body, _| body.friction(0.0);
    let rough = |body: Body, _| body.friction(0.5);
    let still = |body: Body, _| body.friction(0.0).fixed_rotation(true);
    let any = |body: Body, index| {
        let spin = if index % 7 == 0 { 2.0 } else { 0.0 };
        let friction = if index % 5 == 0 { 0.5 } else { 0.0 };
        body.friction(friction).fixed_rotation(index % 4 == 0).angular_velocity(spin)
    };
    let default = Settings::default();
    let others = Settings { block_solve: false, relax_iterations: 2, ..default.clone() };
    let worlds: [(&str, Build<'_>); 6] = [
        ("smooth discs", &|settings| crowd(settings, disc, smooth)),
        ("smooth discs that do not turn", &|settings| crowd(settings, disc, still)),
        ("smooth boxes that do not turn", &|settings| crowd(settings, square, smooth)),
        ("rough boxes that do not turn", &|settings| crowd(settings, square, rough)),
        ("rough discs", &|settings| crowd(settings, disc, rough)),
        ("all of it", &|settings| crowd(settings, mixed, any)),
    ];
    for (name, build) in worlds {
        for settings in [&default, &others] {
            let [mut with, mut without] = [build(settings), build(settings)];
            without.use_general_kernels();
            for tick in 0..150 {
                // From 50 on walls rub, from 100 on no longer.
                let mix = if (50..100).contains(&tick) { Mix::Max } else { Mix::Min };
                for world in [&mut with, &mut without] {
                    let settings = Settings { friction_mix: mix, ..world.settings().clone() };
                    world.set_settings(settings).unwrap();
                    world.step();
                }
                assert_eq!(with.state_hash(), without.state_hash(), "{name}, tick {tick}");
            }
        }
    }
}

/// The way is v²/(2µg) = 2.55 m whatever the manifold: each is within 1e-3 of it, so both within 2e-3 of each
/// other.
#[test]
fn a_sliding_box_stops_at_the_same_place_with_recycled_and_with_fresh_manifolds() {
    let mut twins = twins(fresh(), |world| {
        add_floor(world, 0.5);
        let sliding = Body::dynamic(Shape::obb(1.0, 0.5)).at([0.0, 0.25]).velocity([5.0, 0.0]);
        vec![add(world, sliding.friction(0.5).restitution(0.0))]
    });
    assert_alike(&mut twins, 2.0, 2e-3 * 25.0 / G, 1e-4);
}

/// Over a face that does not move, nothing of a ball's contact has to be found anew but the gap, however fast the ball is;
/// where the face ends there is. It drops onto a slope, bounces, rolls down, over the end, and on along a floor. What
/// differs is rounded by half a digit of 8 m for places on either side of the gap, in each of 600 substeps, and a fall of
/// a metre at the end makes no more of it.
#[test]
fn a_ball_rolls_down_and_over_the_end_alike_with_recycled_and_with_fresh_manifolds() {
    for is_ground_first in [true, false] {
        let mut twins = twins(fresh(), |world| {
            let slope = Body::fixed(Shape::obb(6.0, 0.5)).at([0.0, 2.0]).angle(-0.3).restitution(0.0);
            let ball = Body::dynamic(Shape::circle(0.25)).at([-1.5, 3.5]).friction(0.5).restitution(0.4);
            let bodies = if is_ground_first { [slope, ball] } else { [ball, slope] };
            let ids = bodies.map(|body| add(world, body.friction(0.5)));
            add_floor(world, 0.5);
            vec![ids[usize::from(is_ground_first)]]
        });
        let rounding = f64::from(8.0 * f32::EPSILON);
        assert_alike(&mut twins, 2.5, 600.0 * rounding, 600.0 * rounding);
        let [x, y] = place(&twins[0].0, twins[0].1[0]);
        assert!(x > 3.5, "it rolled over the end to {x} m, {y} m");
    }
}

/// A hexagon tips over its corners from side to side: each tip is a new pair of features. It comes to rest on a
/// side; which one is the same, and so the place is, to what each tip adds in rounding of the normal.
#[test]
fn a_rolling_polygon_comes_to_rest_on_the_same_side_with_recycled_and_with_fresh_manifolds() {
    let mut twins = twins(fresh(), |world| {
        add_floor(world, 0.9);
        let corners = (0..6_u8).map(|i| {
            let Rot { c, s } = Rot::from_angle(std::f32::consts::FRAC_PI_3 * f32::from(i));
            [0.5 * c, 0.5 * s]
        });
        let hexagon = Body::dynamic(Shape::polygon(corners).unwrap()).friction(0.9).restitution(0.0);
        let at_rest_height = 0.5 * 0.75_f64.sqrt();
        vec![add(world, hexagon.at([0.0, at_rest_height]).velocity([1.5, 0.0]).angular_velocity(-3.0))]
    });
    // Two tips of 0.5 m; each loses the same share of its energy, whatever the manifold, to a few percent.
    assert_alike(&mut twins, 4.0, 0.05, 1e-3);
    let side = place(&twins[0].0, twins[0].1[0])[0];
    assert!(side > 0.4, "it rolled {side} m");
}

/// Contact k of a stack carries k weights, and overlaps by the same, however its manifold was found.
#[test]
fn a_stack_of_three_stands_alike_with_recycled_and_with_fresh_manifolds() {
    let mut twins = twins(fresh(), |world| {
        add_floor(world, 0.6);
        (0..3).map(|i| add(world, unit_box(0.0, 0.5 + f64::from(i)))).collect()
    });
    assert_alike(&mut twins, 5.0, 1e-4, 1e-4);
}

/// Momentum and angular momentum are the same after a collision, with either; the collision itself takes no
/// time in which a manifold could be recycled.
#[test]
fn a_spinning_collision_is_alike_with_recycled_and_with_fresh_manifolds() {
    let build = |settings: Settings| {
        let mut world = space();
        world.set_settings(Settings { sleep: false, ..settings }).unwrap();
        let spinner = Body::dynamic(Shape::obb(2.0, 0.5)).velocity([2.0, 0.0]).angular_velocity(3.0);
        let target = Body::dynamic(Shape::obb(0.5, 2.0)).at([3.0, 0.3]).angular_velocity(-1.0);
        let ids = vec![
            add(&mut world, spinner.restitution(0.0).density(1.0)),
            add(&mut world, target.restitution(0.0).density(2.0)),
        ];
        (world, ids)
    };
    let mut twins = [build(Settings::default()), build(fresh())];
    let before = (twins[0].0.momentum(), twins[0].0.angular_momentum());
    // A body turns by 3/60 rad within the tick of the blow, and so does the normal that one of them keeps:
    // that share of a change of speed of 1.2 m/s, for the 2.5 s that are left.
    let speed = 0.05 * 1.2;
    assert_alike(&mut twins, 3.0, speed * 2.5, speed);
    for (world, ids) in &twins {
        assert!(velocity(world, ids[1])[0] > 0.2, "they met");
        assert!((world.momentum() - before.0).length() < 1e-5 * before.0.length());
        // Anchors hold still for a tick, in which the bodies move by up to 2/60 m: so much may the arm of the
        // blow, which is the momentum that the target gained, be off.
        let blow = f64::from(world.body(ids[1]).unwrap().mass()) * velocity(world, ids[1])[0];
        assert_near(world.angular_momentum(), before.1, blow * 2.0 / 60.0, "angular momentum");
    }
}

fn build_wall(world: &mut World) -> Vec<BodyId> {
    add_floor(world, 0.6);
    [[0.0, 0.5], [1.05, 0.5], [0.5, 1.5], [-3.0, 0.5], [-3.0, 1.5]]
        .into_iter()
        .map(|[x, y]| add(world, unit_box(x, y)))
        .collect()
}

/// Warm starting is where the search begins, not what is found: five boxes rest at the same places. Without it a
/// sweep finds the load anew each substep, and the overlap that carries it is larger.
#[test]
fn warm_starting_does_not_change_where_things_rest() {
    let cold = Settings { warm_starting: false, iterations: 8, relax_iterations: 8, ..Settings::default() };
    let mut twins = twins(cold, build_wall);
    assert_alike(&mut twins, 5.0, 5e-3, 5e-3);
}

/// The block solve finds both impulses of a contact at once, which sweeps over one after the other come to as
/// well.
#[test]
fn the_block_solve_does_not_change_where_things_rest() {
    let one_by_one = Settings { block_solve: false, ..Settings::default() };
    let mut twins = twins(one_by_one, build_wall);
    assert_alike(&mut twins, 5.0, 1e-3, 1e-3);
}

/// Sleep is a shortcut too.
#[test]
fn sleep_does_not_change_where_things_rest() {
    let mut sleeping = World::new(Settings::default());
    sleeping.add_force(Force::EARTH_GRAVITY);
    let mut awake = earth_with(Settings::default());
    let [ids, others] = [build_wall(&mut sleeping), build_wall(&mut awake)];
    for world in [&mut sleeping, &mut awake] {
        run(world, 5.0);
    }
    assert!(ids.iter().all(|&id| sleeping.body(id).unwrap().is_sleeping()));
    for (&id, &other) in ids.iter().zip(&others) {
        for axis in 0..2 {
            assert_near(place(&sleeping, id)[axis], place(&awake, other)[axis], 1e-4, "place");
        }
    }
}

/// Pairs of touching bodies, by looking at every pair of bodies.
fn touching_by_looking_at_all(world: &World) -> Vec<(BodyId, BodyId)> {
    let bodies: Vec<(BodyId, BodyRef<'_>)> = world.bodies().collect();
    let mut touching = Vec::new();
    for (place, (id_a, a)) in bodies.iter().enumerate() {
        for (id_b, b) in &bodies[place + 1..] {
            let one_is_dynamic = [a, b].iter().any(|body| body.body_type() == BodyType::Dynamic);
            let manifold = rustycs::collision::detect(a.shape(), a.pose(), b.shape(), b.pose());
            // What overlaps by less than rounding may or may not be seen by either.
            let is_deep = manifold.is_some_and(|m| m.points().iter().any(|point| point.separation < -1e-4));
            if one_is_dynamic && is_deep {
                touching.push((*id_a, *id_b));
            }
        }
    }
    touching
}

/// The broad phase misses nothing: every pair that overlaps after a step has a contact in the next, and no
/// contact is of bodies that are far apart.
#[test]
fn every_overlapping_pair_has_a_contact_and_every_contact_is_close() {
    let mut world =
        rustycs_scenes::pile::build_with(120, 9, Settings { sleep: false, ..Settings::default() });
    let mut seen = 0;
    for tick in 0..240 {
        let expected = if tick % 10 == 0 { touching_by_looking_at_all(&world) } else { Vec::new() };
        world.step();
        let pairs: Vec<(BodyId, BodyId)> = world
            .contacts()
            .map(|contact| (contact.a().min(contact.b()), contact.a().max(contact.b())))
            .collect();
        for (a, b) in &expected {
            assert!(pairs.contains(&(*a.min(b), *a.max(b))), "tick {tick}: {a:?} and {b:?} overlap unseen");
        }
        for &(a, b) in &pairs {
            let [a, b] = [a, b].map(|id| world.body(id).unwrap().aabb().grown(0.5));
            assert!(a.overlaps(b), "tick {tick}: a contact of bodies a metre apart");
        }
        seen += expected.len();
    }
    assert!(seen > 500, "only {seen} pairs: a test of nothing");
}

/// The tree against boxes: what a box query finds is what its own bounding boxes say, for boxes.
#[test]
fn a_box_query_over_upright_boxes_is_a_comparison_of_bounds() {
    let mut world = space();
    let boxes: Vec<BodyId> = (0..100)
        .map(|i| {
            let size = 0.3 + 0.01 * i as f32;
            let at = [f64::from(i * 7 % 20), f64::from(i * 13 % 17)];
            add(&mut world, Body::dynamic(Shape::aabb(size, size)).at(at).velocity([1.0, 0.3]))
        })
        .collect();
    for _ in 0..30 {
        world.step();
        for i in 0..10 {
            let corner = 0.01234 + f64::from(i);
            let (low, high) = ([corner, corner], [corner + 3.25, corner + 1.75]);
            let mut expected: Vec<BodyId> = boxes
                .iter()
                .copied()
                .filter(|&id| {
                    let body = world.body(id).unwrap();
                    let half = 0.5 * f64::from(body.shape().extent()) * std::f64::consts::SQRT_2;
                    let at = body.position_f64();
                    (0..2).all(|axis| at[axis] - half <= high[axis] && low[axis] <= at[axis] + half)
                })
                .collect();
            expected.sort_unstable();
            assert_eq!(world.bodies_in(low, high), expected);
        }
    }
}
