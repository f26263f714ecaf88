use core::cmp::Ordering;

use super::orientation::turn;
use crate::collision::detect;
use crate::math::{Pose, Rot, Vec2};
use crate::shape::testing::rng;
use crate::shape::{MAX_OUTLINE_POINTS, MAX_VERTICES, Ring, RingPlace, Shape, ShapeError};
use crate::testing::Random;

/// Area (m²), centre (m) and second moment about the centre (m⁴) of what a ring goes round, by the closed form, in `f64`: with
/// D = p × q for each edge, area D/2, first moment D/6 · (p + q), second moment D/12 · (p·p + p·q + q·q).
fn moments_of_ring(points: &[Vec2]) -> [f64; 4] {
    let mut sums = [0.0; 4];
    for (index, p) in points.iter().enumerate() {
        let q = points[(index + 1) % points.len()];
        let [px, py, qx, qy] = [p.x, p.y, q.x, q.y].map(f64::from);
        let cross = px * qy - py * qx;
        let second = px * px + py * py + px * qx + py * qy + qx * qx + qy * qy;
        let of_edge = [cross / 2.0, cross / 6.0 * (px + qx), cross / 6.0 * (py + qy), cross / 12.0 * second];
        for (sum, part) in sums.iter_mut().zip(of_edge) {
            *sum += part;
        }
    }
    if sums[0] < 0.0 { sums.map(|sum| -sum) } else { sums }
}

fn moments_of_area(outline: &[Vec2], holes: &[Vec<Vec2>]) -> [f64; 4] {
    let mut sums = moments_of_ring(outline);
    for hole in holes {
        for (sum, part) in sums.iter_mut().zip(moments_of_ring(hole)) {
            *sum -= part;
        }
    }
    sums
}

/// The same of pieces where they were cut from, each by what the engine knows of it.
fn moments_of_pieces(pieces: &[Shape]) -> [f64; 4] {
    let mut sums = [0.0; 4];
    for piece in pieces {
        let Vec2 { x, y } = center_of(piece);
        let [x, y] = [x, y].map(f64::from);
        let of_piece = piece.mass_properties(1.0);
        let [area, inertia] = [of_piece.mass, of_piece.inertia].map(f64::from);
        let parts = [area, area * x, area * y, inertia + area * (x * x + y * y)];
        for (sum, part) in sums.iter_mut().zip(parts) {
            *sum += part;
        }
    }
    sums
}

fn center_of(piece: &Shape) -> Vec2 {
    match piece {
        Shape::Polygon(polygon) => polygon.centroid_of_input(),
        _ => panic!("{piece:?} is no polygon"),
    }
}

/// Counter-clockwise.
fn ordered(mut points: Vec<Vec2>) -> Vec<Vec2> {
    let cross: f64 = (0..points.len())
        .map(|i| {
            let (p, q) = (points[i], points[(i + 1) % points.len()]);
            f64::from(p.x) * f64::from(q.y) - f64::from(p.y) * f64::from(q.x)
        })
        .sum();
    if cross < 0.0 {
        points.reverse();
    }
    points
}

/// A division needs half a cut for each reflex corner, and pieces of at most eight corners for all the corners there are: those of
/// n points are n - 2 triangles, a piece has at most six.
fn fewest_pieces(outline: &[Vec2]) -> usize {
    let points = ordered(outline.to_vec());
    let count = points.len();
    let turns = |index: usize| turn(points[index], points[(index + 1) % count], points[(index + 2) % count]);
    let reflex = (0..count).filter(|&index| turns(index) == Ordering::Less).count();
    let corners = (0..count).filter(|&index| turns(index) != Ordering::Equal).count();
    let by_reflex = if reflex == 0 { 1 } else { reflex.div_ceil(2) + 1 };
    by_reflex.max((corners - 2).div_ceil(MAX_VERTICES - 2))
}

/// Checks all that pieces have to be. Coordinates are rounded to 6e-8 of the farthest, and corners that are nearer to a straight line
/// than 1e-5 of the size of their piece are left out.
fn check(outline: &[Vec2], holes: &[Vec<Vec2>], pieces: &[Shape]) {
    let size = outline.iter().map(|point| point.length()).fold(0.0, f32::max);
    let (expected, found) = (moments_of_area(outline, holes), moments_of_pieces(pieces));
    for (power, (expected, found)) in [2, 3, 3, 4].into_iter().zip(expected.into_iter().zip(found)) {
        let tolerance = if power == 2 {
            1e-5 * expected
        } else {
            1e-5 * f64::from(size).powi(power - 2) * moments_of_area(outline, holes)[0]
        };
        assert!((found - expected).abs() < tolerance, "{found}, not {expected}");
    }
    for piece in pieces {
        let corners = piece.vertices();
        assert!((3..=MAX_VERTICES).contains(&corners.len()));
        for index in 0..corners.len() {
            let [a, b, c] = [0, 1, 2].map(|step| corners[(index + step) % corners.len()]);
            assert_eq!(turn(a, b, c), Ordering::Greater, "convex");
            let corner = a + center_of(piece);
            let nearest = outline.iter().chain(holes.iter().flatten()).map(|point| point.distance(corner));
            assert!(nearest.fold(f32::INFINITY, f32::min) < 1e-6 * size, "{corner:?} is none of the points");
        }
    }
    for (index, one) in pieces.iter().enumerate() {
        for other in &pieces[..index] {
            let [at, other_at] = [one, other].map(|piece| Pose::at(center_of(piece)));
            let depth = detect(one, at, other, other_at)
                .map_or(0.0, |manifold| -manifold.points().iter().map(|p| p.separation).fold(0.0, f32::min));
            assert!(depth < 1e-6 * size, "they overlap by {depth} m");
        }
    }
}

/// Around a middle, at random distances, turned by steps of an even angle.
fn random_star(rng: &mut Random, count: usize) -> Vec<Vec2> {
    let step = core::f32::consts::TAU / count as f32;
    (0..count)
        .map(|i| {
            let Rot { c, s } = Rot::from_angle(step * (i as f32 + rng.random_range(0.0_f32..0.7)));
            Vec2::new(c, s) * rng.random_range(0.2_f32..2.0)
        })
        .collect()
}

/// Random points in random order, untangled: of two edges that cross the ways between are turned round, which makes the outline
/// shorter each time, so that it ends.
fn untangled(rng: &mut Random, count: usize) -> Vec<Vec2> {
    let mut coordinate = || rng.random_range(-2.0_f32..2.0);
    let mut points: Vec<Vec2> = (0..count).map(|_| Vec2::new(coordinate(), coordinate())).collect();
    'again: loop {
        for i in 0..count {
            for j in i + 2..count {
                let [a, b, c, d] = [i, i + 1, j, (j + 1) % count].map(|index| points[index]);
                let is_crossing = turn(a, b, c) != turn(a, b, d) && turn(c, d, a) != turn(c, d, b);
                if d != a && is_crossing {
                    points[i + 1..=j].reverse();
                    continue 'again;
                }
            }
        }
        return points;
    }
}

/// Towers of whole heights above and below a line: edges on lines with others, points above each other.
fn towers(rng: &mut Random, count: usize) -> Vec<Vec2> {
    let mut side = |sign: f32| {
        let mut points = Vec::new();
        for tower in 0..count {
            let height = sign * (1 + rng.below(4)) as f32;
            points.push(Vec2::new(tower as f32, height));
            points.push(Vec2::new((tower + 1) as f32, height));
        }
        points.dedup();
        points
    };
    let (below, mut above) = (side(-1.0), side(1.0));
    above.reverse();
    [below, above].concat()
}

#[test]
fn a_thousand_random_outlines_are_divided_exactly_into_few_convex_pieces() {
    let mut rng = rng(11);
    let (mut pieces_of_all, mut fewest_of_all) = (0, 0);
    for round in 0..1_000 {
        let count = 3 + round % 38;
        let mut outline = match round % 3 {
            0 => random_star(&mut rng, count.max(5)),
            1 => untangled(&mut rng, count),
            _ => towers(&mut rng, 1 + count / 3),
        };
        if round % 2 == 0 {
            outline.reverse();
        }
        if round % 5 == 0 {
            outline = outline.into_iter().map(|Vec2 { x, y }| Vec2::new(-y, x)).collect();
        }
        let pieces = Shape::concave(outline.iter().copied()).unwrap();
        check(&outline, &[], &pieces);
        let fewest = fewest_pieces(&outline);
        assert!(pieces.len() <= 4 * fewest, "{} pieces, {fewest} are enough", pieces.len());
        pieces_of_all += pieces.len();
        fewest_of_all += fewest;
    }
    // The bound is rarely met, so that this is an upper bound of what the division costs.
    println!("{pieces_of_all} pieces, at least {fewest_of_all} are needed");
    assert!(pieces_of_all < 2 * fewest_of_all);
}

#[test]
fn outlines_with_holes_are_divided_exactly() {
    let mut rng = rng(12);
    for round in 0..300 {
        let outline = random_star(&mut rng, 5 + round % 20);
        let shrunk =
            |middle: Vec2, scale: f32| outline.iter().map(|&p| middle + p * scale).collect::<Vec<_>>();
        // One of the same form around the middle, or three small ones within 0.2 m of it, where the outline never is.
        let holes = if round % 2 == 0 {
            vec![shrunk(Vec2::ZERO, 0.7)]
        } else {
            [[0.07, 0.0], [-0.05, 0.05], [-0.05, -0.05]].map(|at| shrunk(at.into(), 0.02)).to_vec()
        };
        let pieces = Shape::with_holes(outline.iter().copied(), holes.clone()).unwrap();
        check(&outline, &holes, &pieces);
    }
}

fn regular(count: usize, radius: f32) -> Vec<Vec2> {
    let corner = |i: usize| Rot::from_angle(core::f32::consts::TAU * i as f32 / count as f32);
    (0..count).map(corner).map(|Rot { c, s }| Vec2::new(c, s) * radius).collect()
}

fn gear(teeth: usize) -> Vec<Vec2> {
    let rim = regular(4 * teeth, 1.0);
    rim.into_iter().enumerate().map(|(i, point)| if i % 4 < 2 { point } else { point * 0.8 }).collect()
}

#[test]
fn known_outlines_are_divided_into_few_pieces() {
    let star: Vec<Vec2> =
        regular(10, 1.0).into_iter().enumerate().map(|(i, p)| if i % 2 == 0 { p } else { p * 0.4 }).collect();
    let letter_c = [[0, 0], [3, 0], [3, 1], [1, 1], [1, 3], [3, 3], [3, 4], [0, 4]];
    let letter_c: Vec<Vec2> = letter_c.map(|[x, y]| Vec2::new(x as f32, y as f32)).to_vec();
    // The star is a pentagon and five tips, and the C three bars. Of a gear each tooth may be a piece, and what is between two teeth a
    // part of another.
    for (name, outline, most) in [("star", star, 6), ("C", letter_c, 3), ("gear", gear(12), 24)] {
        let pieces = Shape::concave(outline.iter().copied()).unwrap();
        check(&outline, &[], &pieces);
        assert!(pieces.len() <= most, "{name}: {} pieces", pieces.len());
    }
    let (rim, hole) = (regular(24, 1.0), regular(24, 0.5));
    let donut = Shape::with_holes(rim.iter().copied(), [hole.iter().copied()]).unwrap();
    check(&rim, &[hole], &donut);
    assert!(donut.len() <= 24, "{} pieces", donut.len());
}

/// Neither an outline of thousands of points nor one far away is anything else.
#[test]
fn long_outlines_and_far_ones_are_divided_exactly() {
    let long = gear(1_000);
    let pieces = Shape::concave(long.iter().copied()).unwrap();
    let [expected, found] = [moments_of_ring(&long), moments_of_pieces(&pieces)];
    assert!((found[0] - expected[0]).abs() < 1e-5 * expected[0]);
    assert!(pieces.len() <= 4 * fewest_pieces(&long));

    let far: Vec<Vec2> = gear(8).into_iter().map(|p| p * 16.0 + Vec2::new(4096.0, -8192.0)).collect();
    let pieces = Shape::concave(far.iter().copied()).unwrap();
    let area = pieces.iter().map(|piece| f64::from(piece.area())).sum::<f64>();
    let expected = moments_of_ring(&far.iter().map(|&p| p - far[0]).collect::<Vec<_>>())[0];
    assert!((area - expected).abs() < 1e-5 * expected, "{area}, not {expected}");
}

fn refused<const N: usize>(outline: [[f32; 2]; N]) -> ShapeError {
    Shape::concave(outline).unwrap_err()
}

fn at(ring: Ring, index: usize) -> RingPlace {
    RingPlace { ring, index }
}

#[test]
fn what_is_no_outline_is_refused_by_the_name_of_its_edges() {
    use Ring::{Hole, Outline};
    let of_outline = |indices: [usize; 2]| indices.map(|index| at(Outline, index));
    let bow_tie = refused([[0.0, 0.0], [2.0, 2.0], [2.0, 0.0], [0.0, 2.0]]);
    assert_eq!(bow_tie, ShapeError::OutlineCrosses { edges: of_outline([0, 2]) });
    let touching = refused([[0.0, 0.0], [4.0, 0.0], [4.0, 2.0], [2.0, 0.0], [0.0, 2.0]]);
    assert_eq!(touching, ShapeError::OutlineCrosses { edges: of_outline([0, 2]) });
    let running_back = refused([[0.0, 0.0], [4.0, 0.0], [2.0, 0.0], [2.0, 2.0]]);
    assert_eq!(running_back, ShapeError::OutlineCrosses { edges: of_outline([0, 1]) });
    let closed = refused([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.0, 0.0]]);
    assert_eq!(closed, ShapeError::OutlineRepeats { points: of_outline([0, 3]) });
    assert!(closed.to_string().contains("point 3 of the outline is at the same place as point 0"));
    let pinched = refused([[0.0, 0.0], [1.0, 1.0], [2.0, 0.0], [2.0, 2.0], [1.0, 1.0], [0.0, 2.0]]);
    assert_eq!(pinched, ShapeError::OutlineRepeats { points: of_outline([1, 4]) });
    assert_eq!(refused([[0.0, 0.0], [1.0, 0.0]]), ShapeError::OutlineTooShort { ring: Outline, count: 2 });
    assert!(matches!(refused([[0.0, 0.0], [1.0, 0.0], [2.0, 1e-6]]), ShapeError::OutlineTooSmall { .. }));
    let not_finite = refused([[0.0, 0.0], [1.0, 0.0], [f32::NAN, 1.0]]);
    assert!(matches!(not_finite, ShapeError::OutlineNotFinite { place, .. } if place == at(Outline, 2)));
    let tiny = refused([[0.0, 0.0], [1e-7, 0.0], [0.0, 1e-7]]);
    assert_eq!(tiny, ShapeError::Size { what: "outline's size", value: 1e-7 });
    let endless = Shape::concave(std::iter::repeat([0.0, 0.0])).unwrap_err();
    assert_eq!(endless, ShapeError::OutlineTooLong { count: MAX_OUTLINE_POINTS + 1 });

    let square =
        |half: f32, x: f32| [[x - half, -half], [x + half, -half], [x + half, half], [x - half, half]];
    let with_holes = |holes: &[[[f32; 2]; 4]]| Shape::with_holes(square(2.0, 0.0), holes.iter().copied());
    assert_eq!(with_holes(&[square(0.5, 3.0)]), Err(ShapeError::HoleOutside { hole: 0 }));
    let in_hole = with_holes(&[square(1.0, 0.0), square(0.5, 0.0)]);
    assert_eq!(in_hole, Err(ShapeError::HoleInHole { hole: 1, other: 0 }));
    let edges = [at(Outline, 1), at(Hole(0), 0)];
    assert_eq!(with_holes(&[square(0.5, 2.0)]), Err(ShapeError::OutlineCrosses { edges }));
    // The lower edges of both lie on one line.
    let edges = [at(Hole(0), 0), at(Hole(1), 0)];
    let overlapping = with_holes(&[square(0.5, 0.0), square(0.5, 0.75)]);
    assert_eq!(overlapping, Err(ShapeError::OutlineCrosses { edges }));
    for error in [bow_tie, touching, running_back, closed, pinched, not_finite, tiny, endless] {
        assert!(error.to_string().len() > 30, "{error}");
    }
}

/// Points in few places, so that many are on lines with others: either they are refused, or the pieces are exact.
#[test]
fn tangled_points_are_refused_or_divided_exactly() {
    let mut rng = rng(13);
    let (mut refused, mut divided) = (0, 0);
    for _ in 0..20_000 {
        let count = rng.random_range(3..8_usize);
        let outline: Vec<Vec2> =
            (0..count).map(|_| Vec2::new(rng.below(5) as f32, rng.below(5) as f32)).collect();
        match Shape::concave(outline.iter().copied()) {
            Ok(pieces) => {
                check(&outline, &[], &pieces);
                divided += 1;
            }
            Err(_) => refused += 1,
        }
    }
    assert!(refused > 1_000 && divided > 1_000, "{refused} refused, {divided} divided");
}
