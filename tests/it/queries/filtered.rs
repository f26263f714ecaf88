//! Queries with a filter, shapes on their way, and the nearest body, against looking at all bodies.

use rand::{RngExt, SeedableRng};
use rustycs::collision::detect;
use rustycs::prelude::*;

use super::{Random, random_shape};
use crate::support::{add, assert_near};

/// Bodies of every shape, type and filter within 10 m of a middle.
fn crowd(random: &mut Random, middle: [f64; 2]) -> (World, Vec<BodyId>) {
    let mut world = World::new(Settings::default());
    let ids = (0..120_u64).map(|number| {
        let shape = random_shape(random);
        let body = match number % 5 {
            0 => Body::fixed(shape),
            1 => Body::kinematic(shape),
            _ if shape.thickness() == 0.0 => Body::kinematic(shape),
            _ => Body::dynamic(shape),
        };
        let filter = Filter { category: 1 << (number % 4), mask: random.random_range(1..16), group: 0 };
        let pose = random_pose(random, middle, 10.0);
        let body = body.at(pose.center).angle(pose.rotation.angle()).filter(filter).user_data(number);
        world.add(body).unwrap()
    });
    let ids = ids.collect();
    (world, ids)
}

fn random_pose(random: &mut Random, [x, y]: [f64; 2], reach: f64) -> Pose {
    let at = [x + random.random_range(-reach..reach), y + random.random_range(-reach..reach)];
    Pose::new(Point::from(at), random.random_range(-3.0..3.0_f32))
}

/// A filter in its parts, and the same asked of a body.
#[derive(Debug)]
struct Question {
    mask: u64,
    category: u64,
    ignored: BodyId,
    all_ignored: Vec<BodyId>,
    divisor: u64,
}

impl Question {
    fn random(random: &mut Random, ids: &[BodyId]) -> Self {
        let mut any = || ids[random.random_range(0..ids.len())];
        let (ignored, all_ignored) = (any(), (0..10).map(|_| any()).collect());
        let (mask, category) = (random.random_range(1..16), random.random_range(1..16));
        Self { mask, category, ignored, all_ignored, divisor: random.random_range(2..5) }
    }

    fn is_about(&self, id: BodyId, body: BodyRef<'_>) -> bool {
        let Filter { category, mask, .. } = body.filter();
        category & self.mask != 0
            && mask & self.category != 0
            && id != self.ignored
            && !self.all_ignored.contains(&id)
            && !body.user_data().is_multiple_of(self.divisor)
    }

    /// Asks a world by the filter.
    fn ask<T>(&self, ask: impl FnOnce(&QueryFilter<'_>) -> T) -> T {
        let is_wanted = |body: BodyRef<'_>| !body.user_data().is_multiple_of(self.divisor);
        let filter = QueryFilter::new().mask(self.mask).category(self.category).predicate(&is_wanted);
        ask(&filter.ignore(self.ignored).ignore_all(&self.all_ignored))
    }

    fn bodies<'w>(&self, world: &'w World) -> Vec<(BodyId, BodyRef<'w>)> {
        world.bodies().filter(|&(id, body)| self.is_about(id, body)).collect()
    }
}

fn compare_rays(world: &World, question: &Question, from: Point, along: Vec2) -> usize {
    let ray = |(id, body): (BodyId, BodyRef<'_>)| {
        body.shape().ray_cast(body.pose(), from, along, 1.0).map(|hit| (hit.fraction, id))
    };
    let mut expected: Vec<(f32, BodyId)> = question.bodies(world).into_iter().filter_map(ray).collect();
    expected.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let all = question.ask(|filter| world.ray_cast_all_with(from, along, filter));
    assert_eq!(all.iter().map(|hit| (hit.fraction, hit.body)).collect::<Vec<_>>(), expected);
    assert_eq!(question.ask(|filter| world.ray_cast_with(from, along, filter)), all.first().copied());
    let mut visited = 0;
    question.ask(|filter| {
        world.ray_cast_each(from, along, filter, |_| {
            visited += 1;
            visited < 2
        });
    });
    assert_eq!(visited, all.len().min(2), "it stops when it is told to");
    all.len()
}

fn compare_overlaps(world: &World, question: &Question, shape: &Shape, pose: Pose) -> usize {
    let touches = |body: BodyRef<'_>| detect(shape, pose, body.shape(), body.pose()).is_some();
    let mut expected: Vec<BodyId> =
        question.bodies(world).into_iter().filter(|&(_, body)| touches(body)).map(|(id, _)| id).collect();
    expected.sort_unstable();
    assert_eq!(question.ask(|filter| world.overlaps(shape, pose, filter)), expected);
    expected.len()
}

/// Distance of a place from a body, m, by its corners and its radius.
fn distance_to(body: BodyRef<'_>, place: Point) -> f64 {
    let Pose { center, rotation } = body.pose();
    if body.contains(place) {
        return 0.0;
    }
    if let Some(radius) = body.shape().radius() {
        return place.distance(center) - f64::from(radius);
    }
    let rotation = if body.shape().can_rotate() { rotation } else { Rot::IDENTITY };
    let corners: Vec<Point> =
        body.shape().vertices().iter().map(|&vertex| center + rotation.rotate(vertex)).collect();
    let edges = corners.iter().zip(corners.iter().cycle().skip(1));
    let to_edge = |(start, end): (&Point, &Point)| {
        let (edge, to) = ([end.x - start.x, end.y - start.y], [place.x - start.x, place.y - start.y]);
        let part = (edge[0] * to[0] + edge[1] * to[1]) / (edge[0] * edge[0] + edge[1] * edge[1]);
        let part = part.clamp(0.0, 1.0);
        (to[0] - part * edge[0]).hypot(to[1] - part * edge[1])
    };
    edges.map(to_edge).fold(f64::INFINITY, f64::min) - f64::from(body.shape().corner_radius())
}

/// Corners are turned by rotations of `f32` here, a few 1e-7 of 2 m off; centres round by a digit of where they are.
fn compare_closest(world: &World, question: &Question, place: Point, max_distance: f32) -> usize {
    let distances = question.bodies(world).into_iter().map(|(id, body)| (distance_to(body, place), id));
    let noise = 2e-6 + 4.0 * f64::EPSILON * (place.x.abs() + place.y.abs());
    let nearest = distances.min_by(|a, b| a.0.total_cmp(&b.0));
    let found = question.ask(|filter| world.closest(place, max_distance, filter));
    let Some((distance, _)) = nearest.filter(|nearest| nearest.0 <= f64::from(max_distance) - noise) else {
        assert!(found.is_none_or(|hit| f64::from(hit.distance) >= f64::from(max_distance) - noise));
        return 0;
    };
    let found = found.expect("there is one");
    assert_near(f64::from(found.distance), distance, noise + 1e-6 * distance, "distance of the nearest");
    assert_near(found.point.distance(place), distance, noise + 1e-6 * distance, "its point");
    let body = world.body(found.body).unwrap();
    assert!(question.is_about(found.body, body) && distance_to(body, place) <= distance + noise);
    1
}

/// The cast ends where it says, and nothing is on the way there: looked at in 300 places.
fn compare_casts(world: &World, question: &Question, shape: &Shape, pose: Pose, along: Vec2) -> usize {
    let hit = question.ask(|filter| world.shape_cast(shape, pose, along, filter));
    let bodies = question.bodies(world);
    let placed = |fraction: f32, aside: Vec2| Pose {
        center: Point::new(
            pose.center.x + f64::from(fraction) * f64::from(along.x),
            pose.center.y + f64::from(fraction) * f64::from(along.y),
        ) + aside,
        ..pose
    };
    let touches = |body: BodyRef<'_>, at: Pose| detect(shape, at, body.shape(), body.pose()).is_some();
    let end = hit.map_or(1.0, |hit| hit.fraction);
    // Rounding of the shape's place, and of the corners.
    let noise = 1e-5 + 8.0 * f64::EPSILON as f32 * (pose.center.x.abs() + pose.center.y.abs()) as f32;
    for number in 0..300_u16 {
        let fraction = f32::from(number) / 300.0 * end;
        if (end - fraction) * along.length() < 10.0 * noise && hit.is_some() {
            break;
        }
        for &(id, body) in &bodies {
            assert!(!touches(body, placed(fraction, Vec2::ZERO)), "{id:?} at {fraction} before {hit:?}");
        }
    }
    let Some(hit) = hit else { return 0 };
    let body = world.body(hit.body).unwrap();
    assert!(question.is_about(hit.body, body));
    if hit.normal == Vec2::ZERO {
        assert!(hit.fraction == 0.0 && touches(body, pose));
        return 1;
    }
    // The way is an f32: its fraction rounds by this, and the shape overlaps by as much.
    let aside = 10.0 * noise + 2.0 * f32::EPSILON * along.length();
    assert!(touches(body, placed(hit.fraction, hit.normal * -aside)), "{hit:?}");
    assert!(!touches(body, placed(hit.fraction, hit.normal * aside)), "{hit:?}");
    assert!(hit.normal.dot(along) < 0.0, "{hit:?}");
    assert_near(distance_to(body, hit.point), 0.0, 10.0 * f64::from(aside), "the point is on the body");
    1
}

fn compare_all(world: &World, ids: &[BodyId], random: &mut Random, middle: [f64; 2]) -> [usize; 4] {
    let mut found = [0; 4];
    for _ in 0..100 {
        let question = Question::random(random, ids);
        let (shape, pose) = (random_shape(random), random_pose(random, middle, 12.0));
        let along = random_pose(random, [0.0, 0.0], 15.0).center.to_vec2();
        let max_distance = [0.0, 0.5, 3.0, 1e9, f32::INFINITY][random.random_range(0..5)];
        found[0] += compare_rays(world, &question, pose.center, along);
        found[1] += compare_overlaps(world, &question, &shape, pose);
        found[2] += compare_closest(world, &question, pose.center, max_distance);
        found[3] += compare_casts(world, &question, &shape, pose, along);
    }
    found
}

fn compare_through_a_life(middle: [f64; 2]) {
    let mut random = Random::seed_from_u64(11);
    let (mut world, ids) = crowd(&mut random, middle);
    // Before the first step.
    let found = compare_all(&world, &ids, &mut random, middle);
    assert!(found.iter().all(|&count| count > 15), "{found:?} found: a test of nothing");
    for _ in 0..20 {
        world.step();
    }
    compare_all(&world, &ids, &mut random, middle);
    for &id in ids.iter().step_by(2) {
        world.remove(id);
    }
    compare_all(&world, &ids, &mut random, middle);
}

#[test]
fn filtered_queries_agree_with_looking_at_all_bodies() {
    compare_through_a_life([0.0, 0.0]);
}

#[test]
fn filtered_queries_agree_a_thousand_kilometres_from_the_origin() {
    compare_through_a_life([-1e6, 1e6]);
}

#[test]
fn what_is_no_shape_place_or_way_finds_nothing() {
    let mut world = World::default();
    assert_eq!(world.closest([0.0, 0.0], f32::INFINITY, &QueryFilter::new()), None, "of no bodies");
    add(&mut world, Body::fixed(Shape::circle(1.0)));
    let (all, nan) = (QueryFilter::new(), f32::NAN);
    let here = Pose::at([0.0, 0.0]);
    let (nowhere, unturned) = (Pose::at([f64::NAN, 0.0]), Pose { rotation: Rot { c: nan, s: 0.0 }, ..here });
    for (shape, pose) in
        [(Shape::circle(nan), here), (Shape::circle(1.0), nowhere), (Shape::obb(1.0, 1.0), unturned)]
    {
        assert!(world.overlaps(&shape, pose, &all).is_empty());
        assert_eq!(world.shape_cast(&shape, pose, [1.0, 0.0], &all), None);
    }
    for along in [[nan, 0.0], [0.0, f32::INFINITY]] {
        assert_eq!(world.shape_cast(&Shape::circle(1.0), here, along, &all), None);
    }
    // A way of no length is a question about the place.
    assert_eq!(world.shape_cast(&Shape::circle(1.0), here, [0.0, 0.0], &all).unwrap().fraction, 0.0);
    for (place, distance) in [([0.0, 0.0], nan), ([0.0, 0.0], -1.0), ([f64::INFINITY, 0.0], 1.0)] {
        assert_eq!(world.closest(place, distance, &all), None);
    }
}

/// A box 1 m above a floor, cast down by 1,000 km; one that stands on it, cast along, away and down.
#[test]
fn a_cast_shape_ends_where_geometry_says() {
    let mut world = World::default();
    let floor = add(&mut world, Body::fixed(Shape::aabb(100.0, 2.0)).at([0.0, -1.0]));
    let (crate_, all) = (Shape::obb(1.0, 1.0), QueryFilter::new());
    let hit = world.shape_cast(&crate_, Pose::at([3.0, 1.5]), [0.0, -1e6], &all).unwrap();
    assert_eq!((hit.body, hit.normal), (floor, Vec2::Y));
    assert_near(f64::from(hit.fraction), 1e-6, 1e-12, "1 m of 1,000 km");
    // Between the floor's corners, 50 m away.
    let rounding = 50.0 * f64::from(f32::EPSILON);
    assert_near(hit.point.x, 3.0, rounding, "the middle of the edge");
    assert_near(hit.point.y, 0.0, rounding, "its height");
    let standing = Pose::at([3.0, 0.5]);
    for along in [[5.0, 0.0], [-5.0, 0.0], [5.0, 5.0]] {
        assert_eq!(world.shape_cast(&crate_, standing, along, &all), None);
    }
    let down = world.shape_cast(&crate_, standing, [0.0, -1.0], &all).unwrap();
    assert_eq!((down.fraction, down.normal), (0.0, Vec2::Y));
    let within = world.shape_cast(&crate_, Pose::at([3.0, 0.4]), [0.0, 1.0], &all).unwrap();
    assert_eq!((within.fraction, within.normal), (0.0, Vec2::ZERO));
}

#[test]
fn visitors_and_single_answers_allocate_nothing() {
    let mut random = Random::seed_from_u64(12);
    let (world, ids) = crowd(&mut random, [0.0, 0.0]);
    let question = Question::random(&mut random, &ids);
    let mut found = 0;
    let allocations = allocation_counter::measure(|| {
        question.ask(|filter| {
            world.ray_cast_each([-10.0, 0.0], [20.0, 1.0], filter, |_| {
                found += 1;
                true
            });
            world.overlaps_each(&Shape::circle(4.0), Pose::at([0.0, 0.0]), filter, |_| {
                found += 1;
                true
            });
            found += usize::from(world.ray_cast_with([-10.0, 0.0], [20.0, 1.0], filter).is_some());
            let cast = world.shape_cast(&Shape::circle(0.5), Pose::at([-10.0, 0.0]), [20.0, 1.0], filter);
            found += usize::from(cast.is_some());
            found += usize::from(world.closest([0.0, 0.0], 5.0, filter).is_some());
        });
    });
    assert_eq!(allocations.count_total, 0);
    assert!(found > 4, "{found}");
}
