//! Capsules and shapes with round corners: they slide, roll, bounce and stand by the laws that hold for all bodies.

use std::f64::consts::TAU;

use rustycs::prelude::*;

use crate::support::{
    G, add, add_floor, assert_near, assert_relative, earth, earth_with, place, run, space, spin, unit_box,
    velocity,
};

/// Half the length of the core of a capsule, and its radius, m.
const HALF: f64 = 0.5;
const RADIUS: f64 = 0.25;

/// A capsule along x, in its own frame.
fn lying() -> Shape {
    Shape::capsule([-HALF as f32, 0.0], [HALF as f32, 0.0], RADIUS as f32)
}

fn upright() -> Shape {
    Shape::capsule([0.0, -HALF as f32], [0.0, HALF as f32], RADIUS as f32)
}

/// A square of 1 m with round corners of 10 cm.
fn tile() -> Shape {
    Shape::rounded([[-0.4, -0.4], [0.4, -0.4], [0.4, 0.4], [-0.4, 0.4]], 0.1).unwrap()
}

fn body(shape: Shape) -> Body {
    Body::dynamic(shape).density(1.0).friction(0.6).restitution(0.0)
}

/// On a slope of 20 degrees, tan 20° = 0.364: v = g (sin - µ cos) t where µ is less, and it stays where µ is more. Nor does what
/// lies on its side roll.
#[test]
fn it_slides_down_a_slope_that_exceeds_the_friction_angle_and_sticks_below_it() {
    let angle = 20.0_f64.to_radians();
    let (sin, cos) = angle.sin_cos();
    for (shape, height) in [(lying(), RADIUS), (tile(), 0.5)] {
        for friction in [0.0, 0.2, 0.5] {
            let mut world = earth();
            let ramp = Body::fixed(Shape::obb(100.0, 2.0)).angle(angle as f32).at([sin, -cos]);
            add(&mut world, ramp.friction(friction).restitution(0.0));
            let at = [20.0 * cos - height * sin, 20.0 * sin + height * cos];
            let id = add(&mut world, body(shape).at(at).angle(angle as f32).friction(friction));
            run(&mut world, 2.0);
            let [x, y] = place(&world, id);
            let way = (at[0] - x) * cos + (at[1] - y) * sin;
            let acceleration = (G * (sin - f64::from(friction) * cos)).max(0.0);
            // Where it sticks, the first substep finds friction to within 14 %: 8 µm.
            assert_near(way, 2.0 * acceleration, 1e-3 * 2.0 * acceleration + 1e-5, "way in 2 s");
            assert_near(spin(&world, id), 0.0, 1e-4, "spin");
        }
    }
}

/// The deceleration is µ g. What lies on its side does not roll, however it is braked.
#[test]
fn a_capsule_on_its_side_slides_to_a_halt() {
    let mut world = earth();
    add_floor(&mut world, 0.4);
    let id = add(&mut world, body(lying()).at([0.0, RADIUS]).velocity([5.0, 0.0]).friction(0.4));
    run(&mut world, 4.0);
    assert_relative(place(&world, id)[0], 25.0 / (2.0 * 0.4 * G), 1e-3, "way");
    assert_near(velocity(&world, id)[0], 0.0, 1e-4, "speed after it stopped");
    assert_near(f64::from(world.body(id).unwrap().angle()), 0.0, 1e-3, "angle");
}

/// The speed falls by e per bounce, the height by e²: on a side, on an end and on a face.
#[test]
fn it_reaches_e_squared_of_its_height() {
    for (shape, height) in [(lying(), RADIUS), (upright(), HALF + RADIUS), (tile(), 0.5)] {
        for e in [0.5_f32, 1.0] {
            let mut world = earth();
            let floor = Body::fixed(Shape::aabb(20.0, 2.0)).at([0.0, -1.0]);
            add(&mut world, floor.friction(0.5).restitution(e));
            let id = add(&mut world, body(shape).at([0.0, height + 2.0]).restitution(e));
            let (mut bounces, mut before) = (0, 0.0);
            while bounces < 4 {
                world.step();
                let speed = velocity(&world, id)[1];
                if before > 0.0 && speed <= 0.0 {
                    bounces += 1;
                    let apex = place(&world, id)[1] - height + speed * speed / (2.0 * G);
                    assert_relative(apex, 2.0 * f64::from(e).powi(2 * bounces), 5e-3, "height");
                }
                before = speed;
                assert!(world.ticks() < 10_000, "no more than {bounces} bounces");
            }
        }
    }
}

/// It rolls over its end without slipping: the centre of the end is r φ from where it was, and of the energy that falls through
/// l (cos φ₀ - cos φ) per weight, l half the length of the core, nothing is lost:
/// ω² (k² + (r + l cos φ)² + l² sin² φ) = 2 g l (cos φ₀ - cos φ).
///
/// Friction of a whole contact gives 10 % compliance; the end sinks in by 1e-4 m of 0.5 m.
#[test]
fn a_capsule_topples_by_rolling_over_its_end() {
    let lean_at_first = 0.1_f64;
    let mut world = earth();
    add_floor(&mut world, 5.0);
    let at = [HALF * lean_at_first.sin(), RADIUS + HALF * lean_at_first.cos()];
    let id = add(&mut world, body(upright()).at(at).angle(-lean_at_first as f32).friction(5.0));
    let square = {
        let body = world.body(id).unwrap();
        f64::from(body.inertia()) / f64::from(body.mass())
    };
    let mut looked = 0;
    for _ in 0..300 {
        world.step();
        let lean = -f64::from(world.body(id).unwrap().angle());
        if !(0.3..1.4).contains(&lean) {
            continue;
        }
        looked += 1;
        let end = place(&world, id)[0] - HALF * lean.sin();
        assert_near(end, RADIUS * (lean - lean_at_first), 2e-3, "way of the end");
        let arm = (RADIUS + HALF * lean.cos()).powi(2) + (HALF * lean.sin()).powi(2);
        let expected = 2.0 * G * HALF * (lean_at_first.cos() - lean.cos()) / (square + arm);
        assert_relative(spin(&world, id).powi(2), expected, 2e-2, "square of the spin");
    }
    assert!(looked > 10, "{looked}");
}

/// A capsule that is heavy below the centre of its lower end, by d, rocks about it: ω² = m g d/(I + m (r - d)²), for small swings.
/// The period of one of 0.05 rad is longer by less than 0.05², and it loses less than a tenth of its height in 20 s.
#[test]
fn a_capsule_with_a_heavy_end_rocks_at_its_frequency() {
    let mut world = earth();
    add_floor(&mut world, 2.0);
    let weight = Collider::new(Shape::circle(0.1)).at([0.0, -0.64]).density(200.0);
    let light = body(upright()).friction(2.0).density(0.5).at([0.0, HALF + RADIUS]);
    let id = add(&mut world, light.with(weight));
    let below = (RADIUS + f64::EPSILON) - place(&world, id)[1];
    assert!(below > 0.05, "{below}");
    world.body_mut(id).unwrap().set_angular_velocity(0.2);
    let (mass, inertia) = {
        let body = world.body(id).unwrap();
        (f64::from(body.mass()), f64::from(body.inertia()))
    };
    let frequency = (mass * G * below / (inertia + mass * (RADIUS - below).powi(2))).sqrt();
    // It rolls from the start.
    world.body_mut(id).unwrap().set_velocity([-0.2 * (RADIUS - below) as f32, 0.0]);
    let (mut crossings, mut before, mut peaks) = (Vec::new(), 0.0, Vec::new());
    let mut peak = 0.0_f64;
    for tick in 1..=1200 {
        world.step();
        let angle = f64::from(world.body(id).unwrap().angle());
        peak = peak.max(angle.abs());
        if before < 0.0 && angle >= 0.0 {
            crossings.push((f64::from(tick) - angle / (angle - before)) / 60.0);
            peaks.push(std::mem::take(&mut peak));
        }
        before = angle;
    }
    let periods = (crossings.len() - 1) as f64;
    let period = (crossings[crossings.len() - 1] - crossings[0]) / periods;
    assert_relative(period, TAU / frequency, 3e-3, "period");
    let kept = (peaks[peaks.len() - 1] / peaks[0]).powi(2);
    assert!((0.9..1.01).contains(&kept), "{kept} of its energy is kept over {periods} swings");
}

/// It falls flat on its side, and lies still there, sunk in by less than the slop of 5 mm.
#[test]
fn what_falls_comes_to_rest_on_its_side() {
    for (shape, height, lean) in [(lying(), RADIUS, 0.4), (upright(), RADIUS, 0.3), (tile(), 0.5, 0.3)] {
        let mut world = earth();
        add_floor(&mut world, 0.6);
        let id = add(&mut world, body(shape).at([0.0, 1.0]).angle(lean));
        run(&mut world, 10.0);
        let [vx, vy] = velocity(&world, id);
        assert!(vx.hypot(vy) < 1e-4 && spin(&world, id).abs() < 1e-4, "{shape:?}: {vx} {vy}");
        assert_near(place(&world, id)[1], height - 0.0025, 0.0026, "height");
        let contact = world.contacts().next().expect("it stands on the floor");
        assert_eq!(contact.points().len(), 2, "on both ends");
    }
}

/// Boxes with round corners and capsules in towers of ten: none leans, and with sleep they fall asleep.
#[test]
fn towers_of_what_has_round_corners_stand() {
    for (shape, height) in [(tile(), 1.0), (lying(), 2.0 * RADIUS)] {
        for sleep in [false, true] {
            let mut world = earth();
            world.set_settings(Settings { sleep, ..world.settings().clone() }).unwrap();
            add_floor(&mut world, 0.6);
            let ids: Vec<_> = (0..10)
                .map(|row| add(&mut world, body(shape).at([0.0, height * (f64::from(row) + 0.5)])))
                .collect();
            run(&mut world, 20.0);
            for (row, &id) in ids.iter().enumerate() {
                let [x, y] = place(&world, id);
                assert_near(x, 0.0, 1e-3, "to the side");
                // Each joint is sunk in by less than 5 mm.
                assert_near(y, height * (row as f64 + 0.5), 5e-3 * (row + 1) as f64, "height");
                assert!(!sleep || world.body(id).unwrap().is_sleeping());
            }
        }
    }
}

/// A mixed heap: all of them come to rest above the floor, and no two overlap by more than 1 cm.
#[test]
fn a_heap_of_every_kind_comes_to_rest() {
    let mut world = earth_with(Settings { sleep: true, ..Settings::default() });
    add_floor(&mut world, 0.6);
    for side in [-1.0, 1.0] {
        let wall =
            Body::fixed(Shape::rounded([[-0.2, -4.0], [0.2, -4.0], [0.2, 4.0], [-0.2, 4.0]], 0.1).unwrap());
        add(&mut world, wall.at([4.0 * side, 4.0]).friction(0.6));
    }
    let hexagon =
        Shape::polygon([[0.5, 0.0], [0.25, 0.43], [-0.25, 0.43], [-0.5, 0.0], [-0.25, -0.43], [0.25, -0.43]]);
    let kinds = [lying(), tile(), Shape::circle(0.4), Shape::obb(0.8, 0.6), hexagon.unwrap(), upright()];
    for number in 0..48_u8 {
        let at = [-2.5 + 1.25 * f64::from(number % 5), 1.0 + 1.1 * f64::from(number / 5)];
        let shape = kinds[usize::from(number) % kinds.len()];
        add(&mut world, body(shape).at(at).angle(0.7 * f32::from(number)));
    }
    run(&mut world, 30.0);
    for (_, body) in world.bodies().filter(|(_, body)| body.body_type() == BodyType::Dynamic) {
        let [x, y] = body.position_f64();
        assert!(x.abs() < 4.0 && y > 0.2 && y < 12.0, "it has left: {x} {y}");
        assert!(body.velocity().length() < 0.02, "{:?} still moves at {:?}", body.shape(), body.velocity());
    }
    for contact in world.contacts() {
        let deepest = contact.points().iter().map(|point| point.separation).fold(0.0, f32::min);
        assert!(deepest > -0.01, "{deepest}");
    }
}

/// Thrown at 100 m/s and turning, it is not found behind a wall of 2 cm, nor in it by more than 1 cm.
#[test]
fn what_is_thrown_does_not_pass_a_thin_wall() {
    for (number, shape) in (0_u8..).zip([lying(), upright(), tile(), lying(), upright(), tile()]) {
        for wall in [Shape::aabb(0.02, 20.0), Shape::capsule([0.0, -10.0], [0.0, 10.0], 0.01)] {
            let mut world = space();
            add(&mut world, Body::fixed(wall).restitution(0.0));
            let thrown = body(shape).at([-3.0 - 0.13 * f64::from(number), 0.0]).velocity([100.0, 3.0]);
            let id = add(&mut world, thrown.angle(0.5 * f32::from(number)).angular_velocity(20.0));
            for _ in 0..60 {
                world.step();
                let body = world.body(id).unwrap();
                let beyond = f64::from(body.shape().bounding_box(body.pose()).max.x);
                assert!(beyond < 0.02, "{shape:?} is {beyond} m beyond {wall:?}");
            }
        }
    }
}

/// The greater one of two shapes of one body is a capsule: it stands on both of them.
#[test]
fn a_capsule_is_a_collider_of_a_compound() {
    let mut world = earth();
    add_floor(&mut world, 0.6);
    // A bench: two feet below a board.
    let feet = [-0.6, 0.6].map(|x| Collider::new(upright()).at([x, -0.8]));
    let bench = feet.into_iter().fold(unit_box(0.0, 1.56).with(Collider::new(lying())), Body::with);
    let id = add(&mut world, bench);
    run(&mut world, 5.0);
    let pose = world.body(id).unwrap().pose();
    assert_near(f64::from(pose.rotation.s), 0.0, 1e-3, "lean");
    assert_near(velocity(&world, id)[1], 0.0, 1e-4, "speed");
    assert_eq!(world.contacts().filter(ContactRef::is_touching).count(), 2);
}

/// A sensor and a query see what is round as it is: a corner of its box is not part of it.
#[test]
fn its_corners_are_round_to_queries_too() {
    let mut world = space();
    let id = add(&mut world, Body::fixed(tile()).at([3.0, 0.0]));
    let all = QueryFilter::new();
    // The corner of the square is 0.1 (√2 - 1) = 0.0414 m away from the arc.
    let corner = [3.5, 0.5];
    assert!(world.bodies_at(corner).is_empty());
    let nearest = world.closest(corner, 1.0, &all).unwrap();
    assert_near(f64::from(nearest.distance), 0.1 * (2.0_f64.sqrt() - 1.0), 1e-6, "distance");
    // A ray along the diagonal meets it there.
    let hit = world.ray_cast_with([4.0, 1.0], [-1.0, -1.0], &all).unwrap();
    assert_eq!(hit.body, id);
    let way = 2.0_f64.sqrt() * 0.6 - 0.1;
    assert_near(f64::from(hit.fraction), way / 2.0_f64.sqrt(), 1e-6, "fraction");
    assert!((hit.normal - Vec2::splat(0.5_f32.sqrt())).length() < 1e-6);
    // And a disc on the same way a radius sooner.
    let disc = Shape::circle(0.25);
    let hit = world.shape_cast(&disc, Pose::at([4.0, 1.0]), [-1.0, -1.0], &all).unwrap();
    assert_near(f64::from(hit.fraction), (way - 0.25) / 2.0_f64.sqrt(), 1e-5, "fraction");
    assert!(world.overlaps(&Shape::circle(0.04), Pose::at(corner), &all).is_empty());
    assert_eq!(world.overlaps(&Shape::circle(0.042), Pose::at(corner), &all), [id]);
}
