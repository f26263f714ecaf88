//! Chains of one-sided lines: smooth where links meet, solid from the left, nothing from the right.

use rustycs::prelude::*;

use crate::support::{G, add, assert_near, earth_with, place, run, space, velocity};

/// Greatest upward speed that a corner between links in line may give, m/s.
const KICK: f64 = 1e-3;

/// Largest difference of speed at the end, as a share of the speed at the beginning.
const LOSS: f64 = 1e-4;

fn octagon() -> Shape {
    let corner = |number: u8| {
        let Rot { c, s } = Rot::from_angle((f32::from(number) + 0.5) * core::f32::consts::FRAC_PI_4);
        [0.5 * c, 0.5 * s]
    };
    Shape::polygon((0..8).map(corner)).unwrap()
}

pub(super) fn shapes() -> [(&'static str, Shape); 5] {
    [
        ("disc", Shape::circle(0.5)),
        ("box", Shape::rectangle(1.0, 1.0)),
        ("upright box", Shape::aabb(1.0, 1.0)),
        ("capsule", Shape::capsule([-0.5, 0.0], [0.5, 0.0], 0.25)),
        ("octagon", octagon()),
    ]
}

/// Half the height of a shape, m.
pub(super) fn height_of(shape: &Shape) -> f64 {
    f64::from(-shape.bounding_box(Pose::at([0.0, 0.0])).min.y)
}

/// A thousand links of 0.1 m in line, from -10 m on.
fn in_line() -> Body {
    Ground::chain((0_u16..=1000).map(|number| [0.1 * f32::from(number) - 10.0, 0.0])).unwrap()
}

#[derive(Clone, Copy, Debug)]
struct Run {
    rate: f32,
    restitution: f32,
    speed: f32,
}

/// One of 140 m, its middle at 50 m.
fn one_segment() -> Body {
    Body::fixed(Shape::segment([-20.0, 0.0], [120.0, 0.0])).at([50.0, 0.0])
}

fn runs() -> impl Iterator<Item = Run> {
    let all = [60.0, 240.0].into_iter().flat_map(|rate| [0.0, 0.5].map(|restitution| (rate, restitution)));
    all.flat_map(|(rate, restitution)| [0.5, 5.0, 20.0].map(|speed| Run { rate, restitution, speed }))
}

/// Lets a body slide without friction for 40 m or 6 s. Returns its greatest upward speed, and its speed at the end, m/s.
fn slide(shape: Shape, floor: Body, run: Run) -> [f64; 2] {
    let Run { rate, restitution, speed } = run;
    let mut world = earth_with(Settings { tick_rate: rate, ..Settings::default() });
    add(&mut world, floor.friction(0.0).restitution(restitution));
    let body = Body::dynamic(shape).at([0.23, height_of(&shape)]).velocity([speed, 0.0]).density(1.0);
    let id = add(&mut world, body.friction(0.0).restitution(restitution));
    let mut kick = 0.0_f64;
    for _ in 0..((40.0 / speed).min(6.0) * rate) as u32 {
        world.step();
        kick = kick.max(velocity(&world, id)[1]);
    }
    [kick, velocity(&world, id)[0]]
}

#[test]
fn what_slides_over_links_in_line_does_not_feel_where_they_meet() {
    for (name, shape) in shapes() {
        for run in runs() {
            let [kick, left] = slide(shape, in_line(), run);
            let [_, on_one] = slide(shape, one_segment(), run);
            assert!(kick <= KICK, "{name} {run:?}: kicked up at {kick:e} m/s");
            let loss = (left - on_one).abs() / f64::from(run.speed);
            assert!(loss <= LOSS, "{name} {run:?}: {left} m/s, on one segment {on_one}");
        }
    }
}

/// A hill and valley every 2π m, of links of a length, m.
fn hills_of_links(length: f32) -> Body {
    let count = (80.0 / length) as u32;
    Ground::chain((0..=count).map(|number| hill(length * number as f32))).unwrap()
}

fn hill(x: f32) -> [f32; 2] {
    [x, 0.5 * Rot::from_angle(x).s]
}

/// The same as columns of 2 m.
fn hills_of_columns(length: f32) -> Body {
    let count = (80.0 / length) as u32;
    let column = |number: u32| {
        let ([left, y], [right, z]) = (hill(length * number as f32), hill(length * (number + 1) as f32));
        Shape::polygon([[left, y - 2.0], [right, z - 2.0], [right, z], [left, y]]).unwrap()
    };
    Body::fixed_pieces((0..count).map(column))
}

/// A disc of 1 kg on frictionless ground that gives nothing back, from a crest on at 1 m/s for 20 s: the energy that it loses, J, and
/// that which it would by closed form.
///
/// Where the ground rises by an angle δ from one piece to the next, the part of the velocity into the next is lost: m (v δ)²/2. Over
/// pieces of length l on a curve of curvature κ it is δ = κ l, once every l.
fn losses(ground: Body, length: f64, rate: f32) -> [f64; 2] {
    let mut world = earth_with(Settings { tick_rate: rate, ..Settings::default() });
    add(&mut world, ground.friction(0.0).restitution(0.0));
    let ball = Body::dynamic(Shape::circle(0.2)).at([core::f64::consts::FRAC_PI_2, 0.7]).velocity([1.0, 0.0]);
    let ball = add(&mut world, ball.mass(1.0).friction(0.0).restitution(0.0));
    let energy = |world: &World| {
        let ([_, y], [vx, vy]) = (place(world, ball), velocity(world, ball));
        G * y + 0.5 * (vx * vx + vy * vy)
    };
    let (start, mut expected) = (energy(&world), 0.0);
    for _ in 0..20 * rate as u32 {
        world.step();
        let [x, y] = place(&world, ball);
        let [vx, vy] = velocity(&world, ball);
        // Below the middle line the ground is hollow; the ball is nearly over where it touches.
        let slope = 0.5 * x.cos();
        let curvature = (0.5 * x.sin() / (1.0 + slope * slope).powf(1.5)).min(0.0);
        let way = f64::hypot(vx, vy) / f64::from(rate);
        let touches = (y - 0.5 * x.sin()).abs() < 0.25;
        expected +=
            if touches { 0.5 * (vx * vx + vy * vy) * curvature * curvature * length * way } else { 0.0 };
    }
    [start - energy(&world), expected]
}

/// The greatest speed of that disc, m/s: 1 m/s at the crest, and 1 m lower.
const FASTEST: f64 = 4.55;

#[test]
fn a_disc_keeps_its_energy_over_hills_of_links() {
    for length in [0.1, 0.02] {
        for rate in [60.0, 240.0] {
            let [lost, expected] = losses(hills_of_links(length), f64::from(length), rate);
            let [on_columns, _] = losses(hills_of_columns(length), f64::from(length), rate);
            assert!(lost <= on_columns, "{length} m, {rate} Hz: {lost} J, over columns {on_columns} J");
            // Over n links in a step the whole turn n δ is lost at once, n² of what one takes in the place of n; and where a step
            // ends within a link it is one more.
            let links = 1.0 + FASTEST / (f64::from(rate) * f64::from(length));
            assert!(lost <= links * expected, "{length} m, {rate} Hz: {lost} J, expected {expected} J");
        }
    }
}

/// From the right everything passes as if nothing were there; from the left nothing does.
#[test]
fn a_chain_is_solid_from_the_left_only() {
    for (name, shape) in shapes() {
        for speed in [1.0, 3.0, 10.0, 30.0, 100.0, 300.0] {
            for x in [0.03, 0.5, 0.77, 1.0] {
                let [y, ..] = thrown_at_waves(shape, x, speed, 1.0);
                assert!(y > 0.0, "{name} at {speed} m/s, {x} m: from the left it came to {y} m");
                let [y, vx, vy] = thrown_at_waves(shape, x, speed, -1.0);
                let moves_on = y > 2.0 && (vx, vy) == (0.0, f64::from(speed));
                assert!(
                    moves_on,
                    "{name} at {speed} m/s, {x} m: from the right it came to {y} m, at {vx}, {vy} m/s"
                );
            }
        }
    }
}

/// Throws a body at low waves from 3 m above or below. Returns its height, m, and its velocity, m/s, when it would be 3 m beyond.
fn thrown_at_waves(shape: Shape, x: f32, speed: f32, side: f32) -> [f64; 3] {
    let mut world = space();
    let wave = |x: f32| [x, 0.1 * Rot::from_angle(3.0 * x).s];
    let waves = Ground::chain((0_u16..=40).map(|number| wave(0.5 * f32::from(number) - 10.0))).unwrap();
    add(&mut world, waves.friction(0.0).restitution(0.0));
    let body = Body::dynamic(shape).at([x, 3.0 * side]).velocity([0.0, -side * speed]).density(1.0);
    let id = add(&mut world, body.friction(0.0).restitution(0.0));
    for _ in 0..(6.0 / speed * 60.0) as u32 + 20 {
        world.step();
    }
    let ([_, y], [vx, vy]) = (place(&world, id), velocity(&world, id));
    [y, vx, vy]
}

/// It sinks in by the sag of its contacts, which is less where more of them bear.
#[test]
fn a_body_rests_on_lines_as_on_a_box() {
    let box_top = || Body::fixed(Shape::aabb(40.0, 1.0)).at([0.0, -0.5]);
    for (name, shape) in shapes() {
        let rest = |floor: Body| {
            let mut world = earth_with(Settings::default());
            add(&mut world, floor.friction(0.5).restitution(0.0));
            let body = Body::dynamic(shape).at([0.23, height_of(&shape)]).density(1.0);
            let id = add(&mut world, body.friction(0.5).restitution(0.0));
            run(&mut world, 5.0);
            assert_near(velocity(&world, id)[1], 0.0, 1e-6, name);
            place(&world, id)
        };
        let [on_box, on_segment, on_chain] = [box_top(), one_segment(), in_line()].map(rest);
        for found in [on_segment, on_chain] {
            assert_near(found[1], on_box[1], 3e-4, name);
            assert_near(found[0], on_box[0], 1e-3, name);
        }
    }
}

/// The corners of a star with spikes, m, counter-clockwise.
fn star(outer: f32, inner: f32) -> Vec<[f32; 2]> {
    let corner = |number: u8| {
        let Rot { c, s } = Rot::from_angle(f32::from(number) * core::f32::consts::TAU / 10.0);
        let radius = if number.is_multiple_of(2) { outer } else { inner };
        [radius * c, radius * s]
    };
    (0..10).map(corner).collect()
}

fn small(number: u8) -> Shape {
    match number % 4 {
        0 => Shape::circle(0.2),
        1 => Shape::rectangle(0.4, 0.4),
        2 => Shape::capsule([-0.2, 0.0], [0.2, 0.0], 0.1),
        _ => Shape::polygon([[0.0, 0.3], [-0.25, -0.15], [0.25, -0.15]]).unwrap(),
    }
}

/// Throws forty bodies about between a room and an island in it for 10 s, turned by some angle, rad. Returns how many got into the island,
/// or out of the room.
fn escaped(speed: f32, turned: f32, restitution: f32, meet_each_other: bool) -> [usize; 2] {
    let mut world = space();
    let around = [[-8.0, -8.0], [8.0, -8.0], [8.0, 8.0], [-8.0, 8.0]];
    let ring = |points: &[[f32; 2]]| Ground::ring(points.iter().copied()).unwrap().friction(0.0);
    add(&mut world, ring(&around).restitution(restitution));
    let mut island = star(4.0, 1.5);
    island.reverse();
    add(&mut world, ring(&island).restitution(restitution));
    let group = if meet_each_other { 0 } else { -1 };
    let mut bodies: Vec<BodyId> = (0..40_u8)
        .map(|number| {
            let angle = 0.157 * f32::from(number);
            let (at, way) = (Vec2::from_angle(angle) * 6.0, Vec2::from_angle(7.3 * angle + 1.0 + turned));
            let body =
                Body::dynamic(small(number)).at([at.x, at.y]).velocity(way * speed).angular_velocity(1.0);
            let body = body.filter(Filter { group, ..Filter::DEFAULT }).density(1.0);
            add(&mut world, body.friction(0.0).restitution(restitution))
        })
        .collect();
    let mut escaped = [0, 0];
    for _ in 0..600 {
        world.step();
        bodies.retain(|&id| {
            let [x, y] = place(&world, id);
            let [is_in, is_out] = [is_within(&island, [x, y]), x.abs() > 8.0 || y.abs() > 8.0];
            escaped = [escaped[0] + usize::from(is_in), escaped[1] + usize::from(is_out)];
            !is_in && !is_out
        });
    }
    escaped
}

/// Whether a place is within an outline: a ray from there crosses it an odd number of times.
fn is_within(outline: &[[f32; 2]], [x, y]: [f64; 2]) -> bool {
    let crosses = |index: usize| {
        let [[from, below], [to, above]] =
            [outline[index], outline[(index + 1) % outline.len()]].map(|point| point.map(f64::from));
        (below > y) != (above > y) && x < (to - from) * (y - below) / (above - below) + from
    };
    (0..outline.len()).filter(|&index| crosses(index)).count() % 2 == 1
}

/// What is in a room stays in it, and what is out of an island stays out, however sharp the corners are.
#[test]
fn a_ring_holds_what_is_within_and_keeps_out_what_is_around() {
    for speed in [3.0, 30.0, 300.0] {
        for restitution in [0.0, 1.0] {
            for turned in [0.0, 0.01, 0.02, 0.03, 0.04, 0.05, 0.06, 0.07] {
                let escaped = escaped(speed, turned, restitution, false);
                assert_eq!(escaped, [0, 0], "{speed} m/s, restitution {restitution}, {turned} rad");
            }
            // Where they press each other over spikes, some get through these at such speeds.
            let [_, is_out] = escaped(speed, 0.0, restitution, true);
            assert_eq!(is_out, 0, "{speed} m/s, restitution {restitution}, among others");
        }
    }
}
