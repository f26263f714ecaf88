//! Laws of shapes: closed formulas, and counting random points.

use crate::math::{Point, Pose, Rot, Vec2};
use crate::shape::testing::{random_outline, random_polygon, random_shapes, random_solids, rng};
use crate::shape::{Shape, ShapeError};

const PI: f32 = core::f32::consts::PI;

/// Relative to a few epsilons: each figure is rounded once from `f64`, the expected one a few times.
#[track_caller]
fn assert_close(value: f32, expected: f32, tolerance: f32) {
    assert!((value - expected).abs() <= tolerance * expected.abs(), "{value}, expected {expected}");
}

fn regular(count: usize, radius: f32) -> Vec<Vec2> {
    (0..count)
        .map(|i| Rot::from_angle(2.0 * PI * i as f32 / count as f32).rotate(Vec2::new(radius, 0.0)))
        .collect()
}

#[test]
fn mass_and_inertia_follow_the_closed_formulas() {
    let disc = Shape::circle(0.5).mass_properties(2.0);
    assert_close(disc.mass, 2.0 * PI * 0.25, 4e-7);
    assert_close(disc.inertia, 0.5 * disc.mass * 0.25, 4e-7);
    for rectangle in [Shape::aabb(3.0, 2.0), Shape::obb(3.0, 2.0)] {
        let box_ = rectangle.mass_properties(0.5);
        assert_close(box_.mass, 3.0, 4e-7);
        assert_close(box_.inertia, 3.0 * (9.0 + 4.0) / 12.0, 4e-7);
    }
    // Regular n-gon of circumradius R: area n/2 R² sin(2π/n), inertia m R²/6 (2 + cos(2π/n)). Its corners are
    // rounded to 6e-8, and the inertia goes with the fourth power.
    for n in 3..=8 {
        let polygon = Shape::polygon(regular(n, 2.0)).unwrap().mass_properties(1.0);
        let step = Rot::from_angle(2.0 * PI / n as f32);
        assert_close(polygon.mass, 0.5 * n as f32 * 4.0 * step.s, 1e-6);
        assert_close(polygon.inertia, polygon.mass * 4.0 / 6.0 * (2.0 + step.c), 1e-6);
    }
}

#[test]
fn a_box_and_the_same_box_as_a_polygon_are_alike() {
    let rectangle = Shape::obb(3.0, 0.5);
    let polygon = Shape::polygon([[7.0, 2.0], [10.0, 2.0], [10.0, 2.5], [7.0, 2.5]]).unwrap();
    assert_eq!(rectangle.vertices(), polygon.vertices());
    assert_eq!(rectangle.mass_properties(1.5), polygon.mass_properties(1.5));
    assert_eq!(rectangle.thickness(), polygon.thickness());
    assert_eq!(rectangle.extent(), polygon.extent());
    let (a, b) = (rectangle.hull().unwrap(), polygon.hull().unwrap());
    assert_eq!((a.normals(), a.planes, a.inradius), (b.normals(), b.planes, b.inradius));
}

/// N points in a box of area B: the count that falls in the shape has a standard deviation below √N/2, so the
/// area is within 5·B/(2√N) of the truth in all but one case of a million; N = 40 000 gives B/80. The sum of r²
/// is bounded by the extent squared.
#[test]
fn area_centroid_and_inertia_agree_with_counting_random_points() {
    let mut rng = rng(1);
    for _ in 0..4 {
        for shape in random_shapes(&mut rng) {
            let samples = 40_000;
            let reach = shape.extent();
            let (mut inside, mut sum, mut squares) = (0.0, Vec2::ZERO, 0.0);
            for _ in 0..samples {
                let p = Vec2::new(rng.random_range(-reach..reach), rng.random_range(-reach..reach));
                if shape.contains(Pose::default(), p) {
                    inside += 1.0;
                    sum += p;
                    squares += p.length_squared();
                }
            }
            let per_sample = 4.0 * reach * reach / samples as f32;
            let tolerance = 4.0 * reach * reach / 80.0;
            assert!((inside * per_sample - shape.area()).abs() < tolerance);
            assert!((sum * per_sample).length() < 1.5 * tolerance * reach);
            let inertia = shape.mass_properties(1.0).inertia;
            assert!((squares * per_sample - inertia).abs() < tolerance * reach * reach);
        }
    }
}

#[test]
fn a_polygon_keeps_its_place_when_put_at_the_centroid_of_its_input() {
    let mut rng = rng(2);
    for _ in 0..200 {
        let count = rng.random_range(3..=8);
        let shift = Vec2::new(rng.random_range(-50.0..50.0), rng.random_range(-50.0..50.0));
        let mut points: Vec<Vec2> = random_outline(&mut rng, count).iter().map(|&p| p + shift).collect();
        let Ok(Shape::Polygon(polygon)) = Shape::polygon(&points) else { panic!("convex") };
        for (vertex, point) in polygon.vertices().iter().zip(&points) {
            // Rounding of coordinates up to 52 m: two halves of 4e-6.
            assert!((*vertex + polygon.centroid_of_input() - *point).length() < 8e-6);
        }
        // First moment zero: the centroid of the triangles about the origin, each weighted by its area.
        let moment = polygon.vertices().iter().enumerate().fold(Vec2::ZERO, |sum, (i, &p)| {
            let q = polygon.vertices()[(i + 1) % count];
            sum + (p + q) * (p.cross(q) / 6.0)
        });
        assert!(moment.length() < 1e-6, "{moment:?}");
        // The other way round it is the same outline.
        points.reverse();
        let reversed = Shape::polygon(&points).unwrap();
        assert_close(reversed.area(), Shape::Polygon(polygon).area(), 1e-6);
        assert!(reversed.hull().unwrap().planes[..count].iter().all(|&plane| plane > 0.0));
    }
}

#[test]
fn normals_point_outward_and_every_corner_is_behind_every_edge() {
    let mut rng = rng(3);
    for _ in 0..500 {
        let shape = random_polygon(&mut rng);
        let hull = shape.hull().unwrap();
        for (normal, plane) in hull.normals().iter().zip(&hull.planes) {
            assert!((normal.length() - 1.0).abs() < 2e-7);
            assert!(hull.vertices().iter().all(|v| normal.dot(*v) <= plane + 2e-7));
        }
        assert!(shape.thickness() <= 2.0 * shape.extent());
        assert!(shape.thickness() >= hull.inradius);
    }
}

#[test]
fn repeated_and_collinear_points_are_welded_away() {
    let square = Shape::polygon([[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]]).unwrap();
    let with_repeats =
        [[0.0, 0.0], [0.0, 0.0], [2.0, 0.0], [2.0, 1e-6], [2.0, 2.0], [0.0, 2.0], [0.0, 1e-6], [0.0, 0.0]];
    let welded = Shape::polygon(with_repeats).unwrap();
    assert_eq!(welded.vertices().len(), 4);
    assert_close(welded.area(), 4.0, 1e-5);
    // Twelve points, of which eight lie on the sides.
    let mut points = Vec::new();
    for (start, step) in [
        ([0.0, 0.0], [1.0, 0.0]),
        ([3.0, 0.0], [0.0, 1.0]),
        ([3.0, 3.0], [-1.0, 0.0]),
        ([0.0, 3.0], [0.0, -1.0]),
    ] {
        points.extend((0..3).map(|i| [start[0] + step[0] * i as f32, start[1] + step[1] * i as f32]));
    }
    let welded = Shape::polygon(&points).unwrap();
    assert_eq!(welded.vertices(), Shape::obb(3.0, 3.0).vertices());
    // A list that begins in the middle of a side.
    points.rotate_left(1);
    assert_eq!(Shape::polygon(&points).unwrap().vertices().len(), 4);
    assert_eq!(square.vertices().len(), 4);
}

#[test]
fn polygons_that_cannot_be_are_refused_with_their_reason() {
    let error = |points: &[[f32; 2]]| Shape::polygon(points).unwrap_err();
    assert_eq!(error(&[]), ShapeError::TooFewPoints { count: 0 });
    assert_eq!(error(&[[0.0, 0.0], [1.0, 0.0]]), ShapeError::TooFewPoints { count: 2 });
    assert_eq!(error(&[[1.0, 1.0]; 5]), ShapeError::TooFewPoints { count: 1 });
    assert_eq!(error(&[[0.0, 0.0], [1.0, 1.0], [3.0, 3.0]]), ShapeError::Collinear);
    assert_eq!(error(&[[0.0, 0.0], [3.0, 0.0], [1.0, 0.0], [2.0, 1e-6]]), ShapeError::Collinear);
    let not_finite = error(&[[0.0, 0.0], [1.0, f32::INFINITY], [0.0, 1.0]]);
    assert_eq!(not_finite, ShapeError::NotFinite { index: 1, point: [1.0, f32::INFINITY] });
    assert!(matches!(
        error(&[[f32::NAN, 0.0], [1.0, 0.0], [0.0, 1.0]]),
        ShapeError::NotFinite { index: 0, .. }
    ));
    assert_eq!(error(&[[0.0, 0.0], [2.0, 1.0], [0.0, 2.0], [1.0, 1.0]]), ShapeError::Concave { index: 3 });
    // Out along the line and back again: not a corner, and not to be welded either.
    assert!(matches!(error(&[[0.0, 0.0], [2.0, 0.0], [1.0, 0.0], [1.0, 1.0]]), ShapeError::Concave { .. }));
    // A bow tie turns both ways.
    assert!(matches!(error(&[[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]]), ShapeError::Concave { .. }));
    // A pentagram turns the same way at every corner, but twice round.
    let pentagon = regular(5, 1.0);
    let pentagram: Vec<Vec2> = (0..5).map(|i| pentagon[i * 2 % 5]).collect();
    assert_eq!(Shape::polygon(&pentagram), Err(ShapeError::SelfIntersecting));
    let triangle_twice = [regular(3, 1.0), regular(3, 1.0)].concat();
    assert_eq!(Shape::polygon(&triangle_twice), Err(ShapeError::SelfIntersecting));
    assert!(Shape::polygon(regular(8, 1.0)).is_ok());
    assert_eq!(Shape::polygon(regular(9, 1.0)), Err(ShapeError::TooManyPoints { count: 9 }));
    assert!(matches!(Shape::polygon(core::iter::repeat([0.0, 0.0])), Err(ShapeError::TooManyPoints { .. })));
    let tiny = [[0.0, 0.0], [1e-6, 0.0], [0.0, 1e-6]];
    assert!(matches!(error(&tiny), ShapeError::Size { what: "polygon's size", .. }));
    assert!(matches!(error(&[[0.0, 0.0], [1e9, 0.0], [0.0, 1e9]]), ShapeError::Size { .. }));
}

#[test]
fn sizes_out_of_range_are_refused_and_named() {
    for bad in [0.0, -1.0, 1e-6, 2e8, f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        assert!(
            matches!(Shape::circle(bad).validate(), Err(ShapeError::Size { what: "radius", .. })),
            "{bad}"
        );
        assert!(
            matches!(Shape::aabb(bad, 1.0).validate(), Err(ShapeError::Size { what: "width", .. })),
            "{bad}"
        );
        assert!(
            matches!(Shape::obb(1.0, bad).validate(), Err(ShapeError::Size { what: "height", .. })),
            "{bad}"
        );
    }
    for good in [1e-5, 1.0, 1e8] {
        for shape in [Shape::circle(good), Shape::aabb(good, good), Shape::obb(good, good)] {
            assert_eq!(shape.validate(), Ok(()));
            let mass = shape.mass_properties(1.0);
            assert!((1.0 / mass.inertia).is_finite() && mass.inertia.is_finite() && mass.inertia > 0.0);
        }
    }
    let text = Shape::circle(-1.0).validate().unwrap_err().to_string();
    assert_eq!(text, "the radius is -1 m: choose a finite one from 0.00001 m to 100000000 m");
}

#[test]
fn the_bounding_box_holds_the_shape_and_is_no_larger_than_rounding_asks() {
    let mut rng = rng(4);
    for _ in 0..500 {
        for shape in random_shapes(&mut rng) {
            let pose = Pose::new(
                [rng.random_range(-3.0..3.0f64), rng.random_range(-3.0..3.0)],
                rng.random_range(-9.0..9.0),
            );
            let bounds = shape.bounding_box(pose);
            let rotation = shape.rotation_at(pose.rotation);
            let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
            let radius = f64::from(shape.corner_radius());
            let corners = if shape.radius().is_some() { &[Vec2::ZERO][..] } else { shape.vertices() };
            for v in corners {
                let (c, s) = (f64::from(rotation.c), f64::from(rotation.s));
                let (x, y) = (f64::from(v.x), f64::from(v.y));
                let place = [pose.center.x + c * x - s * y, pose.center.y + s * x + c * y];
                for k in 0..2 {
                    low[k] = low[k].min(place[k] - radius);
                    high[k] = high[k].max(place[k] + radius);
                }
            }
            let (min, max): ([f32; 2], [f32; 2]) = (bounds.min.into(), bounds.max.into());
            for k in 0..2 {
                // Slack of two epsilons of the size, rounding of coordinates up to 5 m.
                assert!(f64::from(min[k]) <= low[k] && f64::from(min[k]) > low[k] - 4e-6);
                assert!(f64::from(max[k]) >= high[k] && f64::from(max[k]) < high[k] + 4e-6);
            }
        }
    }
    // Not turned, a box is exact.
    let floor = Shape::aabb(20.0, 1.0).bounding_box(Pose::new([0.0, -0.5], 1.0));
    assert_eq!((floor.min, floor.max), (Vec2::new(-10.0, -1.0), Vec2::new(10.0, 0.0)));
}

#[test]
fn a_shape_contains_its_border_and_nothing_beyond() {
    let pose = Pose::at([1e6, -1e6]);
    for shape in [
        Shape::aabb(2.0, 1.0),
        Shape::obb(2.0, 1.0),
        Shape::polygon(Shape::obb(2.0, 1.0).vertices()).unwrap(),
    ] {
        for &vertex in shape.vertices() {
            assert!(shape.contains(pose, pose.center + vertex));
            assert!(!shape.contains(pose, pose.center + vertex * 1.000_001));
        }
        assert!(shape.contains(pose, pose.center + Vec2::new(0.3, 0.5)));
    }
    let disc = Shape::circle(0.5);
    assert!(disc.contains(pose, pose.center + Vec2::new(0.0, 0.5)));
    assert!(!disc.contains(pose, pose.center + Vec2::new(0.0, 0.500_001)));
    assert!(!disc.contains(pose, [f64::NAN, 0.0]));
    // The axis-aligned box does not turn.
    assert!(Shape::aabb(2.0, 1.0).contains(Pose::new([0.0, 0.0], 1.0), [0.99, 0.49]));
}

/// The reference steps along the ray and asks `contains`: the first place inside is at most one step past the hit.
#[test]
fn a_ray_hits_where_stepping_along_it_first_comes_inside() {
    let mut rng = rng(5);
    let (mut hits, steps) = (0, 1000);
    for _ in 0..150 {
        for shape in random_solids(&mut rng) {
            let pose = Pose::new([1e5, rng.random_range(-1.0..1.0f64)], rng.random_range(-9.0..9.0));
            let origin = pose.center + Vec2::new(rng.random_range(-3.0..3.0), rng.random_range(-3.0..3.0));
            // Aimed roughly at the shape.
            let aim = Vec2::new(rng.random_range(-0.8..0.8), rng.random_range(-0.8..0.8));
            let along = ((pose.center - origin) + aim) * rng.random_range(0.5..2.0);
            let place = |fraction: f32| origin + along * fraction;
            let stepped =
                (0..=steps).map(|i| i as f32 / steps as f32).find(|&f| shape.contains(pose, place(f)));
            let hit = shape.ray_cast(pose, origin, along, 1.0);
            match (stepped, hit) {
                (Some(inside), Some(hit)) => {
                    hits += 1;
                    assert!(hit.fraction <= inside + 1e-6 && hit.fraction >= inside - 1.001 / steps as f32);
                    if hit.fraction > 0.0 {
                        assert!((hit.normal.length() - 1.0).abs() < 1e-6);
                        assert!(hit.normal.dot(along) < 0.0);
                        // A little further in the shape begins, unless the ray only grazes it.
                        let beyond = place(hit.fraction) + hit.normal * -1e-4;
                        assert!(shape.contains(pose, beyond));
                        assert!(!shape.contains(pose, place(hit.fraction) + hit.normal * 1e-4));
                    } else {
                        assert_eq!(hit.normal, Vec2::ZERO);
                    }
                }
                // A chord shorter than a step.
                (None, Some(hit)) => {
                    let inward = hit.normal.dot(along) / along.length();
                    assert!(
                        inward > -0.2
                            || hit.fraction > 0.998
                            || near_corner(&shape, pose, place(hit.fraction))
                    );
                }
                (Some(_), None) => panic!("the ray came inside and reported no hit"),
                (None, None) => {}
            }
        }
    }
    assert!(hits > 100);
}

fn near_corner(shape: &Shape, pose: Pose, place: Point) -> bool {
    let rotation = shape.rotation_at(pose.rotation);
    shape.vertices().iter().any(|&v| (place - (pose.center + rotation.rotate(v))).length() < 0.02)
}

#[test]
fn a_ray_stops_at_its_longest_fraction_and_needs_a_length() {
    let disc = Shape::circle(1.0);
    let pose = Pose::at([5.0, 0.0]);
    let hit = disc.ray_cast(pose, [0.0, 0.0], [8.0, 0.0], 1.0).unwrap();
    assert_eq!((hit.fraction, hit.normal), (0.5, Vec2::new(-1.0, 0.0)));
    assert!(disc.ray_cast(pose, [0.0, 0.0], [8.0, 0.0], 0.4).is_none());
    assert!(disc.ray_cast(pose, [0.0, 0.0], [-8.0, 0.0], 1.0).is_none());
    for shape in [disc, Shape::obb(1.0, 1.0)] {
        assert!(shape.ray_cast(pose, [0.0, 0.0], [0.0, 0.0], 1.0).is_none());
        assert!(shape.ray_cast(pose, [0.0, 0.0], [f32::NAN, 0.0], 1.0).is_none());
        assert_eq!(shape.ray_cast(pose, [5.0, 0.0], [0.0, 0.0], 1.0).unwrap().fraction, 0.0);
    }
    // A grain of 1e-3 m seen from 1e4 m: in f32 the difference of squares would be noise.
    let far = Shape::circle(1e-3).ray_cast(Pose::at([1e4, 0.0]), [0.0, 0.0], [2e4, 0.0], 1.0).unwrap();
    assert_close(far.fraction, 0.5 * (1.0 - 1e-7), 1e-7);
}
