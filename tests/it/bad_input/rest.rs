//! Settings, forces, attractors, polygons, queries.

use rustycs::prelude::*;

use super::{NOT_NUMBERS, assert_refused, lived_in};

/// A field of the settings, how to set it, and what is bad for it beside what is no number at all.
type Field = (&'static str, fn(f32) -> Settings, &'static [f32]);

fn base() -> Settings {
    Settings::default()
}

const FIELDS: [Field; 8] = [
    ("tick_rate", |v| Settings { tick_rate: v, ..base() }, &[0.0, -0.0, -60.0, 0.01, 1e7]),
    ("sleep_speed", |v| Settings { sleep_speed: v, ..base() }, &[-1e-9, 2e6]),
    ("sleep_time", |v| Settings { sleep_time: v, ..base() }, &[-0.1, 3601.0]),
    ("restitution_threshold", |v| Settings { restitution_threshold: v, ..base() }, &[-0.1, 1e30]),
    ("hit_threshold", |v| Settings { hit_threshold: v, ..base() }, &[-0.1, 1e30]),
    ("gravitational_constant", |v| Settings { gravitational_constant: v, ..base() }, &[-1.0, 1e30]),
    ("max_speed", |v| Settings { max_speed: v, ..base() }, &[0.0, -1.0, 1e30]),
    ("max_spin", |v| Settings { max_spin: v, ..base() }, &[0.0, -1.0, 1e30]),
];

fn bad_settings() -> Vec<(&'static str, Settings)> {
    let mut bad = Vec::new();
    for (field, set, others) in FIELDS {
        bad.extend(NOT_NUMBERS.iter().chain(others).map(|&value| (field, set(value))));
    }
    let projection = |iterations| PositionCorrection::Projection { iterations };
    bad.extend([
        ("max_ticks_per_advance", Settings { max_ticks_per_advance: 0, ..base() }),
        ("max_ticks_per_advance", Settings { max_ticks_per_advance: 1_000_001, ..base() }),
        ("substeps", Settings { substeps: 0, ..base() }),
        ("substeps", Settings { substeps: 257, ..base() }),
        ("substeps", Settings { substeps: u32::MAX, ..base() }),
        ("iterations", Settings { iterations: 0, ..base() }),
        ("iterations", Settings { iterations: 1001, ..base() }),
        ("relax_iterations", Settings { relax_iterations: 1001, ..base() }),
        ("relax_iterations", Settings { relax_iterations: 0, ..base() }),
        ("bounds", Settings { bounds: Some(Aabb::new(Vec2::ZERO, Vec2::new(1.0, 0.0))), ..base() }),
        ("bounds", Settings { bounds: Some(Aabb::new(Vec2::ZERO, Vec2::new(f32::NAN, 1.0))), ..base() }),
        ("bounds", Settings { bounds: Some(Aabb::new(Vec2::splat(2.0), Vec2::ZERO)), ..base() }),
        ("position_correction", Settings { position_correction: projection(0), ..base() }),
        ("position_correction", Settings { position_correction: projection(1001), ..base() }),
    ]);
    bad
}

#[test]
fn settings_refuse_every_number_they_cannot_compute_with() {
    for (field, settings) in bad_settings() {
        let what = format!("{settings:?}");
        assert_refused(&what, field, |_, _| World::try_new(settings.clone()).err());
        assert_refused(&what, field, |world, _| world.set_settings(settings.clone()).err());
        assert!(settings.validate().is_err());
        let (mut world, _) = lived_in();
        let before = world.settings().clone();
        assert!(world.set_settings(settings).is_err());
        assert_eq!(world.settings(), &before, "{what}");
    }
    assert_eq!(Settings::default().validate(), Ok(()));
    assert_eq!(Settings::classic().validate(), Ok(()));
}

/// `World::new` has no error to give: it panics with the same text.
#[test]
fn a_new_world_panics_as_documented() {
    let refused = std::panic::catch_unwind(|| World::new(Settings { tick_rate: f32::NAN, ..base() }));
    let text = refused.unwrap_err().downcast::<String>().unwrap();
    assert!(text.contains("tick_rate") && text.contains("give"), "{text}");
}

#[test]
fn forces_refuse_what_is_no_acceleration() {
    for value in NOT_NUMBERS.into_iter().chain([1e13, -1e13]) {
        for acceleration in [[value, 0.0], [0.0, value]] {
            assert_refused(&format!("{acceleration:?}"), "wind", |_, _| {
                Force::try_new("wind", acceleration).err()
            });
        }
        let panicked = std::panic::catch_unwind(|| Force::new("wind", [value, 0.0]));
        assert!(panicked.unwrap_err().downcast::<String>().unwrap().contains("acceleration"));
    }
}

#[test]
fn attractors_refuse_what_would_pull_to_infinity() {
    let good = || Attractor::global([0.0, 0.0], 1.0);
    for value in NOT_NUMBERS.into_iter().chain([1e30, -1e30]) {
        let what = value.to_string();
        for at in [[value, 0.0], [0.0, value]] {
            assert_refused(&what, "position", |_, _| Attractor::try_new(at, 1.0, None).err());
        }
        assert_refused(&what, "mass", |_, _| Attractor::try_new([0.0, 0.0], value, None).err());
    }
    for value in NOT_NUMBERS.into_iter().chain([0.0, -1.0, 1e-6, 1e30]) {
        let what = value.to_string();
        assert_refused(&what, "range", |_, _| Attractor::try_new([0.0, 0.0], 1.0, Some(value)).err());
        assert_refused(&what, "minimum distance", |_, _| good().with_min_distance(value).err());
    }
    for panicking in [
        || Attractor::global([0.0, 0.0], f32::NAN),
        || Attractor::global([f32::NAN, 0.0], 1.0),
        || Attractor::local([0.0, 0.0], 1.0, 0.0),
    ] {
        let text = std::panic::catch_unwind(panicking).unwrap_err().downcast::<String>().unwrap();
        assert!(text.contains("attractor cannot have"), "{text}");
    }
}

/// The strongest attractors, on top of each other and opposed, add up to nothing that is not finite.
#[test]
fn a_thousand_of_the_strongest_attractors_stay_finite() {
    let mut world = World::new(Settings { gravitational_constant: 1e12, ..base() });
    let id = world.add(Body::dynamic(Shape::circle(0.5))).unwrap();
    for i in 0..1000 {
        let mass = if i % 2 == 0 { 1e18 } else { -1e18 };
        let side = if i % 4 < 2 { 1e-3 } else { -1e-3 };
        world.add_attractor(Attractor::global([side, side], mass).with_min_distance(1e-3).unwrap());
    }
    for _ in 0..10 {
        world.step();
        world.validate().unwrap();
    }
    assert!(world.energy().is_finite() && world.body(id).is_some());
}

/// What is told is how many points there are, and not how many were looked at.
#[test]
fn an_outline_of_thousands_of_points_is_told_their_number() {
    for (points, told) in
        [(257, "257 corners,"), (5000, "5000 corners,"), (100_000, "65537 corners or more,")]
    {
        let outline = ring(points, 1);
        for refused in [Shape::polygon(outline.clone()), Shape::rounded(outline.clone(), 0.1)] {
            let text = refused.unwrap_err().to_string();
            assert!(text.contains(told) && text.contains("use fewer"), "{points} points: {text}");
        }
    }
    assert!(Shape::polygon(std::iter::repeat([0.0_f32, 0.0])).is_err(), "an endless outline ends");
}

const ARROW: &[[f32; 2]] = &[[0.0, 0.0], [2.0, 1.0], [0.0, 2.0], [1.0, 1.0]];
const BOW_TIE: &[[f32; 2]] = &[[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]];
const LINE: &[[f32; 2]] = &[[0.0, 0.0], [1.0, 1.0], [2.0, 2.0], [5.0, 5.0]];

/// Corners on a circle; with a step of two, those of a star.
fn ring(corners: usize, step: usize) -> Vec<[f32; 2]> {
    (0..corners)
        .map(|corner| {
            let angle = std::f64::consts::TAU * (corner * step) as f64 / corners as f64;
            [angle.cos() as f32, angle.sin() as f32]
        })
        .collect()
}

#[test]
fn polygons_that_are_none_are_refused() {
    let refused: [(&str, &str, Vec<[f32; 2]>); 13] = [
        ("an arrow", "not convex", ARROW.to_vec()),
        ("a bow tie", "not convex", BOW_TIE.to_vec()),
        ("a pentagram", "crosses itself", ring(5, 2)),
        ("a line", "on one line", LINE.to_vec()),
        ("nothing", "0 distinct points", vec![]),
        ("a point", "1 distinct points", vec![[1.0, 1.0]]),
        ("two points", "2 distinct points", vec![[0.0, 0.0], [1.0, 0.0]]),
        ("the same point", "1 distinct points", vec![[1.0, 1.0]; 5]),
        ("nine corners", "9 corners", ring(9, 1)),
        ("a thousand corners", "corners", ring(1000, 1)),
        ("no number", "point 2", vec![[0.0, 0.0], [1.0, 0.0], [f32::NAN, 1.0]]),
        ("an infinite corner", "point 0", vec![[f32::INFINITY, 0.0], [1.0, 0.0], [0.0, 1.0]]),
        ("a giant", "polygon's size", vec![[0.0, 0.0], [1e9, 0.0], [0.0, 1e9]]),
    ];
    for (what, quantity, points) in refused {
        assert_refused(what, quantity, |_, _| Shape::polygon(points.clone()).err());
        let backward: Vec<[f32; 2]> = points.into_iter().rev().collect();
        assert!(Shape::polygon(backward).is_err(), "{what}, the other way round");
    }
    for corners in 3..=8 {
        assert!(Shape::polygon(ring(corners, 1)).is_ok(), "{corners} corners");
    }
}

/// A place that is none is told as such, and not by a length of 0 m that would follow from it.
#[test]
fn points_of_shapes_that_are_no_places_are_named() {
    type Make = fn([f32; 2]) -> Result<Shape, ShapeError>;
    let shapes: [(&str, Make); 8] = [
        ("end 0 of the capsule", |p| valid(Shape::capsule(p, [1.0, 0.0], 0.5))),
        ("end 1 of the capsule", |p| valid(Shape::capsule([1.0, 0.0], p, 0.5))),
        ("end 0 of the segment", |p| valid(Shape::segment(p, [1.0, 0.0]))),
        ("end 1 of the segment", |p| valid(Shape::segment([1.0, 0.0], p))),
        ("point 1 of the polygon", |p| Shape::polygon([[0.0, 0.0], p, [0.0, 1.0]])),
        ("point 1 of the polygon", |p| Shape::rounded([[0.0, 0.0], p], 0.5)),
        ("point 2 of the outline", |p| Ok(Shape::concave([[0.0, 0.0], [1.0, 0.0], p, [0.0, 1.0]])?[0])),
        ("point 1 of the chain", |p| Ground::chain([[0.0, 0.0], p]).map(|_| Shape::circle(1.0))),
    ];
    for (place, make) in shapes {
        for value in NOT_NUMBERS {
            for point in [[value, 0.25], [0.25, value], [value, value]] {
                let [x, y] = point;
                let text = make(point).unwrap_err().to_string();
                assert_eq!(text, format!("{place} is ({x}, {y}): give it finite coordinates"));
            }
        }
    }
    let ring = |points: [[f32; 2]; 4]| Ground::ring(points).map(|_| ());
    assert_refused("a ring on a line", "ring", |_, _| ring([0.0, 1.0, 3.0, 2.0].map(|x| [x, 2.0 * x])).err());
    assert_eq!(ring([[0.0, 0.0], [1.0, 0.0], [3.0, 0.0], [2.0, 0.01]]), Ok(()));
}

fn valid(shape: Shape) -> Result<Shape, ShapeError> {
    shape.validate().map(|()| shape)
}

/// A polygon too thin to be simulated is refused, by its constructor or when it is added.
#[test]
fn a_splinter_is_refused() {
    let points = [[0.0, 0.0], [0.1, 0.0], [0.1, 3e-6], [0.0, 3e-6]];
    if let Ok(splinter) = Shape::polygon(points) {
        assert_refused("a splinter", "thickness", |world, _| world.add(Body::dynamic(splinter)).err());
    }
}

#[test]
fn questions_about_no_place_find_nothing() {
    let (world, _) = lived_in();
    let hash = world.state_hash();
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for at in [[bad, 0.0], [0.0, bad]] {
            assert!(world.bodies_at(at).is_empty());
            assert!(
                world.bodies_in(at, [9.0, 9.0]).is_empty() && world.bodies_in([-9.0, -9.0], at).is_empty()
            );
            assert!(
                world.ray_cast(at, [1.0, 0.0]).is_none() && world.ray_cast_all(at, [1.0, 0.0]).is_empty()
            );
            let along = at.map(|coordinate| coordinate as f32);
            let from = [0.0, 0.5];
            assert!(world.ray_cast(from, along).is_none() && world.ray_cast_all(from, along).is_empty());
        }
    }
    // A ray of no length from within a body, and a box with its corners the wrong way round.
    for nothing in [[0.0_f32, 0.0], [-0.0, 0.0]] {
        assert!(world.ray_cast([0.0, 0.5], nothing).is_none());
        assert!(world.ray_cast_all([0.0, 0.5], nothing).is_empty());
    }
    assert!(world.bodies_in([1.0, 1.0], [-1.0, -1.0]).is_empty());
    assert_eq!(world.state_hash(), hash);
}

/// Numbers that are none give no manifold either.
#[test]
fn detection_without_a_world_survives_bad_poses_and_shapes() {
    let good = Shape::obb(1.0, 1.0);
    for bad in [f64::NAN, f64::INFINITY] {
        let pose = Pose::at([bad, 0.0]);
        assert!(rustycs::collision::detect(&good, pose, &good, Pose::default()).is_none());
        assert!(rustycs::collision::detect(&good, Pose::default(), &good, pose).is_none());
    }
    for shape in [Shape::circle(f32::NAN), Shape::circle(-1.0), Shape::obb(0.0, 0.0), Shape::aabb(-1.0, 1.0)]
    {
        for other in [good, Shape::circle(1.0), Shape::aabb(1.0, 1.0)] {
            // Whatever it says, it says so without a panic.
            _ = rustycs::collision::detect(&shape, Pose::default(), &other, Pose::at([0.1, 0.2]));
        }
    }
}

/// Constructors that panic name the line of their caller.
#[test]
fn panics_of_constructors_name_the_line_of_the_caller() {
    use crate::support::place_of_panic;
    let first = line!();
    let constructors: [(u32, fn()); 4] = [
        (2, || _ = World::new(Settings { tick_rate: f32::NAN, ..Settings::default() })),
        (3, || _ = Force::new("wind", [f32::NAN, 0.0])),
        (4, || _ = Attractor::global([0.0, 0.0], f32::NAN)),
        (5, || _ = Attractor::local([0.0, 0.0], 1.0, -1.0)),
    ];
    for (line, construct) in constructors {
        assert_eq!(place_of_panic(construct), Some((file!().to_owned(), first + line)));
    }
    assert_eq!(place_of_panic(|| ()), None);
}
