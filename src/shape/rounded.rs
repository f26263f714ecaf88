//! Outlines with a radius: a core of 2 to 8 corners, and all that is within a radius of it. With two corners it is a capsule.
//!
//! ```text
//! area          A = A_core + Σ l r + π r²           l: the length of an edge; a strip of width r lies before it,
//!                                                   and round each corner a sector, which together make a disc
//! of a sector   θ r²/2 about its tip: ∫x = r³/3 (n_2 - n_1) turned by -90°, ∫x² = θ r⁴/4
//! ```
//! θ is the angle between the normals n_1 and n_2 of the two edges that meet there. Moments about another place follow by
//! Steiner's theorem.

use crate::math::trig::atan2_f64;
use crate::math::{Rot, Vec2};
use crate::shape::hull::{Hull, MAX_VERTICES};

/// How many lines the outline is drawn with round a whole turn.
const LINES_OF_TURN: f32 = 24.0;

/// A convex outline whose corners are round: all that is within a radius of a core, which is a line between two points (then
/// it is a capsule), or a convex polygon with 3 to 8 corners. About its centre of mass.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Rounded {
    radius: f32,
    core: Hull,
    centroid_of_input: Vec2,
}

impl Rounded {
    /// All that is within `radius`, m, of the line from `a` to `b`, m. Any numbers will do; they are checked later.
    pub(super) fn capsule(a: Vec2, b: Vec2, radius: f32) -> Self {
        let (core, centroid_of_input) = Hull::line(a, b);
        Self { radius, core, centroid_of_input }
    }

    /// All that is within `radius`, m, of the outline of 3 to 8 `corners`, m, convex and counter-clockwise.
    pub(super) fn polygon(corners: &[[f64; 2]], radius: f32) -> Self {
        let (x, y) = centroid(corners, f64::from(radius));
        let mut vertices = [Vec2::ZERO; MAX_VERTICES];
        for (vertex, corner) in vertices.iter_mut().zip(corners) {
            *vertex = Vec2::new((corner[0] - x) as f32, (corner[1] - y) as f32);
        }
        let core = Hull::new(&vertices[..corners.len()]);
        Self { radius, core, centroid_of_input: Vec2::new(x as f32, y as f32) }
    }

    /// Radius of the corners, m.
    #[inline(always)]
    pub fn radius(&self) -> f32 {
        self.radius
    }

    /// Whether the core is a line.
    pub fn is_capsule(&self) -> bool {
        self.core.is_segment()
    }

    /// The corners of the core, m from the centre of mass, counter-clockwise; of a capsule the two centres of its ends.
    pub fn vertices(&self) -> &[Vec2] {
        self.core.vertices()
    }

    #[inline(always)]
    pub(crate) fn core(&self) -> &Hull {
        &self.core
    }

    /// Where the centre of mass was in the coordinates the shape was made from, m. A body put there, not turned, has the shape
    /// exactly where its points were given.
    pub fn centroid_of_input(&self) -> Vec2 {
        self.centroid_of_input
    }

    /// The outline to draw, m, counter-clockwise, as corners of a polygon: round each corner of the core as many as make 24 of a
    /// circle, and no fewer than two.
    ///
    /// ```
    /// use rustycs::prelude::*;
    ///
    /// let Shape::Rounded(capsule) = Shape::capsule([0.0, -0.5], [0.0, 0.5], 0.25) else { unreachable!() };
    /// assert_eq!(capsule.outline().count(), 26);
    /// assert!(capsule.outline().all(|place| place.length() <= 0.75 + 1e-6));
    /// ```
    pub fn outline(&self) -> impl Iterator<Item = Vec2> + '_ {
        let normals = self.core.normals();
        self.core.vertices().iter().enumerate().flat_map(move |(corner, &vertex)| {
            let angle = turn(wide(normals[self.core.previous(corner)]), wide(normals[corner])) as f32;
            let lines = ((angle * (LINES_OF_TURN / core::f32::consts::TAU)).round() as u32).max(1);
            let first = normals[self.core.previous(corner)] * self.radius;
            (0..=lines)
                .map(move |line| vertex + Rot::from_angle(angle * line as f32 / lines as f32).rotate(first))
        })
    }

    /// Area, m², and its second moment about the centre, m⁴.
    pub(super) fn moments(&self) -> (f64, f64) {
        let corners: Vec<[f64; 2]> = self.core.vertices().iter().map(|&vertex| wide(vertex)).collect();
        let Moments { area, second, .. } = moments(&corners, f64::from(self.radius));
        (area, second)
    }
}

fn wide(v: Vec2) -> [f64; 2] {
    [f64::from(v.x), f64::from(v.y)]
}

fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

/// The angle from one direction to another, counter-clockwise, rad: from 0 to π, as at a corner of a convex outline.
fn turn(from: [f64; 2], to: [f64; 2]) -> f64 {
    atan2_f64(from[0] * to[1] - from[1] * to[0], dot(from, to)).abs()
}

/// Area, its first moment and its second, about the origin.
#[derive(Clone, Copy, Default)]
struct Moments {
    area: f64,
    first: [f64; 2],
    second: f64,
}

impl Moments {
    /// Adds a part of an `area` around a place; `second` is its second moment about there.
    fn add(&mut self, area: f64, place: [f64; 2], second: f64) {
        self.area += area;
        self.first = [0, 1].map(|k| self.first[k] + area * place[k]);
        self.second += second + area * dot(place, place);
    }
}

/// Those of all that is within `radius` of an outline.
fn moments(corners: &[[f64; 2]], radius: f64) -> Moments {
    let mut sum = Moments::default();
    let count = corners.len();
    let edge = |i: usize| {
        let (p, q) = (corners[i], corners[(i + 1) % count]);
        let along = [q[0] - p[0], q[1] - p[1]];
        let length = dot(along, along).sqrt();
        (p, q, length, [along[1] / length, -along[0] / length])
    };
    for i in 0..count {
        let (p, q, length, normal) = edge(i);
        // The triangle of the origin and the edge.
        let doubled = p[0] * q[1] - p[1] * q[0];
        sum.area += 0.5 * doubled;
        sum.first = [0, 1].map(|k| sum.first[k] + doubled / 6.0 * (p[k] + q[k]));
        sum.second += doubled / 12.0 * (dot(p, p) + dot(p, q) + dot(q, q));
        // The strip before it.
        let middle = [0, 1].map(|k| 0.5 * (p[k] + q[k]) + 0.5 * radius * normal[k]);
        let strip = length * radius;
        sum.add(strip, middle, strip * (length * length + radius * radius) / 12.0);
        // The sector round its end: its first moment about the tip moves the place it is at.
        let (.., next) = edge((i + 1) % count);
        let sector = 0.5 * turn(normal, next) * radius * radius;
        let cubed = radius * radius * radius / 3.0;
        let from_tip = [cubed * (next[1] - normal[1]), cubed * (normal[0] - next[0])];
        sum.add(sector, q, 0.5 * sector * radius * radius + 2.0 * dot(q, from_tip));
        sum.first = [0, 1].map(|k| sum.first[k] + from_tip[k]);
    }
    sum
}

/// Centre of area of all that is within `radius` of an outline. Seen from its first corner, so that no digits are lost where it is
/// far from the origin.
fn centroid(corners: &[[f64; 2]], radius: f64) -> (f64, f64) {
    let [x, y] = corners[0];
    let mut near = [[0.0; 2]; MAX_VERTICES];
    for (place, corner) in near.iter_mut().zip(corners) {
        *place = [corner[0] - x, corner[1] - y];
    }
    let Moments { area, first, .. } = moments(&near[..corners.len()], radius);
    (x + first[0] / area, y + first[1] / area)
}

#[cfg(test)]
mod tests {
    use crate::math::{Pose, Rot, Vec2};
    use crate::shape::testing::{random_capsule, random_outline, random_rounded, rng};
    use crate::shape::{Shape, ShapeError};

    const PI: f32 = core::f32::consts::PI;

    #[track_caller]
    fn assert_close(value: f32, expected: f32) {
        // Rounded once from `f64`, the expected one a few times.
        assert!((value - expected).abs() <= 1e-6 * expected.abs(), "{value}, expected {expected}");
    }

    /// A rectangle of length l, and two halves of a disc, whose centres of mass are 4r/3π from their flats:
    /// m_d (r²/2 + l²/4 + l 4r/3π) about the middle.
    #[test]
    fn mass_and_inertia_of_a_capsule_follow_the_closed_formulas() {
        for (l, r) in [(1.0_f32, 0.3_f32), (0.01, 0.5), (20.0, 0.1)] {
            for half in [Vec2::new(0.5 * l, 0.0), Vec2::new(0.3 * l, -0.4 * l)] {
                let capsule = Shape::capsule(-half, half, r).mass_properties(2.0);
                let (of_box, of_disc) = (2.0 * 2.0 * r * l, 2.0 * PI * r * r);
                assert_close(capsule.mass, of_box + of_disc);
                let about_middle = 0.5 * r * r + 0.25 * l * l + l * 4.0 * r / (3.0 * PI);
                let expected = of_box * (l * l + 4.0 * r * r) / 12.0 + of_disc * about_middle;
                assert_close(capsule.inertia, expected);
            }
        }
    }

    /// A box with round corners is a box without its corners: of each a square of side r less a quarter of a disc.
    #[test]
    fn mass_and_inertia_of_a_rounded_box_follow_the_closed_formulas() {
        let (w, h, r) = (3.0_f32, 2.0_f32, 0.25_f32);
        let (x, y) = (0.5 * w - r, 0.5 * h - r);
        let tile = Shape::rounded([[-x, -y], [x, -y], [x, y], [-x, y]], r).unwrap();
        assert_close(tile.area(), w * h - (4.0 - PI) * r * r);
        // Strips of 2x by 2y and r, and a disc in four quarters, whose centres of mass are 4r/3π from both flats.
        let core = 4.0 * x * y * (4.0 * x * x + 4.0 * y * y) / 12.0;
        let strip =
            |length: f32, out: f32| length * r * ((length * length + r * r) / 12.0 + (out + 0.5 * r).powi(2));
        let strips = 2.0 * strip(2.0 * x, y) + 2.0 * strip(2.0 * y, x);
        let corners = PI * r * r * (0.5 * r * r + x * x + y * y + 8.0 * r / (3.0 * PI) * (x + y));
        assert_close(tile.mass_properties(1.0).inertia, core + strips + corners);
        assert_eq!((tile.extent(), tile.thickness()), (Vec2::new(x, y).length() + r, h));
        let bounds = tile.bounding_box(Pose::default());
        assert!((bounds.max - Vec2::new(0.5 * w, 0.5 * h)).length() < 3e-6);
    }

    /// The centre of mass is where the first moment of random points vanishes: see the laws of shapes. Here it is in closed form: a
    /// triangle leans to its blunt side less the more round it is.
    #[test]
    fn the_centre_of_mass_of_a_rounded_triangle_is_where_its_parts_have_it() {
        // A right triangle with legs of 1 m: area 1/2 at 1/3; strips of r; sectors of a quarter and twice three eighths of a turn.
        let r = 0.5_f64;
        let triangle = Shape::rounded([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]], r as f32).unwrap();
        let Shape::Rounded(rounded) = triangle else { panic!("it is rounded") };
        let (slope, pi) = (2.0_f64.sqrt(), std::f64::consts::PI);
        let area = 0.5 + (2.0 + slope) * r + pi * r * r;
        let strips = r * (0.5 + -0.5 * r + slope * (0.5 + 0.5 * r / slope));
        let cubed = r * r * r / 3.0;
        // ∫x over the sectors: round the origin from -x to -y, round (1, 0) from -y to the slope, round (0, 1) on to -x.
        let sectors = -cubed + cubed * (1.0 / slope + 1.0) + 0.375 * pi * r * r + cubed * (0.0 - 1.0 / slope);
        let expected = ((0.5 / 3.0 + strips + sectors) / area) as f32;
        let found = rounded.centroid_of_input();
        assert!((found - Vec2::splat(expected)).length() < 2e-7, "{found:?}, expected {expected}");
    }

    #[test]
    fn a_rounded_shape_keeps_its_place_when_put_at_its_centre() {
        let mut rng = rng(41);
        for _ in 0..200 {
            let count = rng.random_range(3..=8);
            let shift = Vec2::new(rng.random_range(-50.0..50.0), rng.random_range(-50.0..50.0));
            let mut points: Vec<Vec2> =
                random_outline(&mut rng, count).iter().map(|&point| point + shift).collect();
            let Ok(Shape::Rounded(rounded)) = Shape::rounded(&points, 0.2) else { panic!("convex") };
            for (vertex, point) in rounded.vertices().iter().zip(&points) {
                // Rounding of coordinates up to 52 m: two halves of 4e-6.
                assert!((*vertex + rounded.centroid_of_input() - *point).length() < 8e-6);
            }
            points.reverse();
            let Ok(Shape::Rounded(reversed)) = Shape::rounded(&points, 0.2) else { panic!("convex") };
            assert!((reversed.centroid_of_input() - rounded.centroid_of_input()).length() < 8e-6);
        }
        let Shape::Rounded(capsule) = Shape::capsule([1.0, 2.0], [3.0, 2.5], 0.1) else { panic!("rounded") };
        assert_eq!(capsule.centroid_of_input(), Vec2::new(2.0, 2.25));
        assert_eq!(Shape::rounded([[1.0, 2.0], [3.0, 2.5]], 0.1), Ok(Shape::Rounded(capsule)));
    }

    #[test]
    fn what_cannot_be_rounded_is_refused_with_its_reason() {
        let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        for bad in [0.0, -1.0, 1e-6, 2e8, f32::NAN, f32::INFINITY] {
            assert!(matches!(Shape::rounded(square, bad), Err(ShapeError::Size { what: "radius", .. })));
            let capsule = Shape::capsule([0.0, 0.0], [1.0, 0.0], bad);
            assert!(matches!(capsule.validate(), Err(ShapeError::Size { what: "radius", .. })), "{bad}");
        }
        for bad in [0.0, 1e-6, 4e8] {
            let capsule = Shape::capsule([-bad, 0.0], [bad, 0.0], 1.0);
            let refused = capsule.validate();
            assert!(matches!(refused, Err(ShapeError::Size { what: "capsule's length", .. })), "{bad}");
        }
        assert_eq!(Shape::rounded([[0.0, 0.0]; 3], 0.1), Err(ShapeError::TooFewPoints { count: 1 }));
        assert_eq!(Shape::rounded([[0.0, 0.0], [1.0, 1.0], [3.0, 3.0]], 0.1), Err(ShapeError::Collinear));
        assert!(matches!(Shape::rounded([[0.0, 0.0], [1e-7, 0.0]], 0.1), Err(ShapeError::Size { .. })));
        let text = Shape::capsule([0.0, 0.0], [0.0, 0.0], 1.0).validate().unwrap_err().to_string();
        assert_eq!(text, "the capsule's length is 0 m: choose a finite one from 0.00001 m to 100000000 m");
        assert_eq!(Shape::capsule([0.0, 0.0], [2e-5, 0.0], 1.0).validate(), Ok(()));
    }

    /// Between two of its corners a drawn arc of a 24th of a turn is r (1 - cos π/24) inside.
    #[test]
    fn the_drawn_outline_is_that_of_the_shape() {
        let mut rng = rng(42);
        for _ in 0..100 {
            for shape in [random_capsule(&mut rng), random_rounded(&mut rng)] {
                let Shape::Rounded(rounded) = shape else { panic!("it is rounded") };
                let corners: Vec<Vec2> = rounded.outline().collect();
                let inside = |place: Vec2| shape.contains(Pose::default(), [place.x, place.y]);
                for (number, &corner) in corners.iter().enumerate() {
                    let next = corners[(number + 1) % corners.len()];
                    assert!(inside(corner * (1.0 - 1e-5)) && !inside(corner * (1.0 + 1e-5)), "{corner:?}");
                    let middle = (corner + next) * 0.5;
                    let outward = -(next - corner).perp() / (next - corner).length();
                    // An arc is cut into whole lines: at most half as many again as fit.
                    let sag = rounded.radius() * (1.0 - Rot::from_angle(1.5 * PI / 24.0).c);
                    assert!(!inside(middle + outward * (sag + 1e-5)), "{shape:?}: {corner:?} to {next:?}");
                }
                assert!(corners.len() <= 24 + 2 * rounded.vertices().len());
            }
        }
    }
}
