//! Segments: lines without thickness, for ground. Alone a segment is solid on both sides; as a link of a chain it knows where
//! the chain comes from and goes on to.
//!
//! It is what a capsule is without its radius: a core of two corners, whose two edges are its two sides.

use crate::math::Vec2;
use crate::shape::hull::Hull;
use crate::shape::polygon::are_on_a_line;
use crate::shape::{MAX_SIZE, MIN_SIZE, ShapeError};

/// A line between two points, without thickness and without mass, about its middle.
///
/// ```
/// use rustycs::prelude::*;
///
/// let shelf = Shape::segment([1.0, 2.0], [4.0, 6.0]);
/// let Shape::Segment(segment) = shelf else { panic!() };
/// assert_eq!(segment.length(), 5.0);
/// assert_eq!(segment.centroid_of_input(), Vec2::new(2.5, 4.0)); // where to put it
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment {
    core: Hull,
    centroid_of_input: Vec2,
    link: Option<Link>,
}

/// What a link of a chain knows of its neighbours.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Link {
    /// Unit vector along the link before, and along the one after; `None` at an open end.
    along: [Option<Vec2>; 2],
}

impl Segment {
    /// The line from `a` to `b`, m. Any numbers will do; they are checked later.
    pub(super) fn new(a: Vec2, b: Vec2) -> Self {
        let (core, centroid_of_input) = Hull::line(a, b);
        Self { core, centroid_of_input, link: None }
    }

    /// The line from the second to the third of four points of a chain, m, of which the first and the last may not be there.
    pub(super) fn of_chain([before, start, end, after]: [Option<Vec2>; 4]) -> Option<Self> {
        let (start, end) = (start?, end?);
        let direction = |from: Vec2, to: Vec2| {
            let [x, y] = [f64::from(to.x) - f64::from(from.x), f64::from(to.y) - f64::from(from.y)];
            let length = (x * x + y * y).sqrt();
            Vec2::new((x / length) as f32, (y / length) as f32)
        };
        let along = [before.map(|before| direction(before, start)), after.map(|after| direction(end, after))];
        Some(Self { link: Some(Link { along }), ..Self::new(start, end) })
    }

    /// The links of a chain through some points, m; of a ring, which ends where it begins, if it is one.
    ///
    /// # Errors
    /// Refuses coordinates that are not finite, fewer than two points, or three of a ring, links whose length is outside
    /// [`MIN_SIZE`] to [`MAX_SIZE`], and rings all on one line.
    pub(crate) fn chain(points: &[Vec2], is_ring: bool) -> Result<Vec<Self>, ShapeError> {
        let count = points.len();
        if let Some(index) = points.iter().position(|point| !point.is_finite()) {
            return Err(ShapeError::ChainNotFinite { index, point: points[index].into() });
        }
        let least = if is_ring { 3 } else { 2 };
        if count < least {
            return Err(ShapeError::ChainTooShort { count, least });
        }
        // Before the first comes the last, if it is a ring.
        let point = |number: usize| {
            let is_there = is_ring || (1..=count).contains(&number);
            is_there.then(|| points[(number + count - 1) % count])
        };
        let links = (1..if is_ring { count + 1 } else { count }).map(|number| {
            let of_four = [number - 1, number, number + 1, number + 2].map(point);
            let segment = Self::of_chain(of_four).ok_or(ShapeError::ChainTooShort { count, least })?;
            let length = segment.length();
            // NaN is in no range.
            if !(MIN_SIZE..=MAX_SIZE).contains(&length) {
                return Err(ShapeError::ChainLink { index: number - 1, length });
            }
            Ok(segment)
        });
        let links = links.collect::<Result<Vec<_>, _>>()?;
        if is_ring && are_on_a_line(points) {
            return Err(ShapeError::RingOnALine);
        }
        Ok(links)
    }

    /// Its two ends, m from its middle: where it begins, and where it goes.
    pub fn vertices(&self) -> &[Vec2] {
        self.core.vertices()
    }

    /// Its length, m.
    pub fn length(&self) -> f32 {
        2.0 * self.core.extent()
    }

    /// Whether it is a link of a [chain](crate::Ground::chain), which is solid on its left only.
    pub fn is_link(&self) -> bool {
        self.link.is_some()
    }

    /// Where the middle was in the coordinates the segment was made from, m. A body put there, not turned, has the segment
    /// exactly where its points were given.
    pub fn centroid_of_input(&self) -> Vec2 {
        self.centroid_of_input
    }

    #[inline(always)]
    pub(crate) fn core(&self) -> &Hull {
        &self.core
    }

    /// What it knows of its neighbours, if it is a link of a chain.
    pub(crate) fn link(&self) -> Option<Link> {
        self.link
    }

    /// Unit vector to its left, for who walks from its begin to its end.
    pub(crate) fn left(&self) -> Vec2 {
        self.core.normals[Link::FACE]
    }

    /// Whether what lies in a direction from a link of a chain is over an outward corner with the next link, or with the one before: beyond
    /// the end of the one, and not yet before that of the other.
    pub(crate) fn is_over_corner(&self, direction: Vec2) -> bool {
        let Some(Link { along: [before, after] }) = self.link else { return false };
        let along = -self.left().perp();
        let is_over = |first: Vec2, second: Vec2| {
            first.cross(second) < 0.0 && first.dot(direction) >= 0.0 && second.dot(direction) <= 0.0
        };
        before.is_some_and(|before| is_over(before, along))
            || after.is_some_and(|after| is_over(along, after))
    }
}

impl Link {
    /// The side of the core that is to the left: that of the edge from its end back to its begin.
    pub(crate) const FACE: usize = 1;

    /// Unit vectors to the left of the link before, and of the one after; `None` at an open end.
    pub(crate) fn left_of_neighbours(&self) -> [Option<Vec2>; 2] {
        self.along.map(|along| along.map(Vec2::perp))
    }
}

#[cfg(test)]
mod tests {
    use super::{Link, Segment};
    use crate::math::{Pose, Vec2};
    use crate::shape::{Shape, ShapeError};

    /// A hill, walked over from the left: what is over its top, beside it, and below the foot of its slope.
    #[test]
    fn over_an_outward_corner_is_what_is_beyond_one_link_and_not_yet_before_the_other() {
        let points = [[-1.0, 0.0], [0.0, 1.0], [1.0, 0.0], [2.0, 0.0]].map(Vec2::from);
        let [up, down, flat] = Segment::chain(&points, false).unwrap().try_into().unwrap();
        for (direction, over) in [
            ([0.0, 1.0], [true, true, false]),
            ([0.5, 1.0], [true, true, false]),
            ([-0.5, 1.0], [true, true, false]),
            ([1.5, 1.0], [false; 3]),
            ([0.0, -1.0], [false; 3]),
        ] {
            assert_eq!(
                [up, down, flat].map(|link| link.is_over_corner(direction.into())),
                over,
                "{direction:?}"
            );
        }
    }

    #[test]
    fn a_segment_is_a_line_about_its_middle() {
        let segment = Shape::segment([1.0, 2.0], [4.0, 6.0]);
        assert_eq!(segment.vertices(), [[-1.5, -2.0].into(), [1.5, 2.0].into()]);
        assert_eq!((segment.extent(), segment.thickness(), segment.area()), (2.5, 0.0, 0.0));
        let Shape::Segment(line) = segment else { panic!("a segment") };
        assert_eq!((line.centroid_of_input(), line.length()), (Vec2::new(2.5, 4.0), 5.0));
        assert_eq!(segment.bounding_box(Pose::at([2.5, 4.0])).min, [1.0, 2.0].into());
        for bad in [0.0, 1e-6, 4e8] {
            let refused = Shape::segment([0.0, 0.0], [bad, 0.0]).validate();
            assert!(matches!(refused, Err(ShapeError::Size { what: "segment's length", .. })), "{bad}");
        }
    }

    #[test]
    fn rays_meet_a_segment_from_both_sides_and_pass_beyond_its_ends() {
        let (segment, pose) = (Shape::segment([-1.0, 0.0], [1.0, 0.0]), Pose::at([0.0, 1.0]));
        for (side, normal) in [(1.0, Vec2::new(0.0, 1.0)), (-1.0, Vec2::new(0.0, -1.0))] {
            let hit = |x: f64| segment.ray_cast(pose, [x, 1.0 + side], [0.0, -4.0 * side as f32], 1.0);
            let there = hit(0.5).unwrap();
            assert_eq!((there.fraction, there.normal), (0.25, normal));
            assert_eq!((hit(1.01), hit(-1.01)), (None, None));
        }
        assert_eq!(segment.ray_cast(pose, [-3.0, 1.0], [9.0, 0.0], 1.0), None, "along it");
        assert_eq!(segment.closest_point(pose, [3.0, 5.0]), [1.0, 1.0].into());
        assert_eq!(segment.closest_point(pose, [0.5, 5.0]), [0.5, 1.0].into());
        assert!(segment.contains(pose, [0.5, 1.0]) && !segment.contains(pose, [0.5, 1.001]));
    }

    #[test]
    fn links_know_their_neighbours_and_rings_close() {
        let corner = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]].map(Vec2::from);
        let [first, second] = Segment::chain(&corner, false).unwrap()[..] else { panic!("two links") };
        let [right, up] = [Vec2::new(1.0, 0.0), Vec2::new(0.0, 1.0)];
        assert_eq!(first.link(), Some(Link { along: [None, Some(up)] }));
        assert_eq!(second.link(), Some(Link { along: [Some(right), None] }));
        assert_eq!((first.left(), second.left()), (up, -right));
        let ring = Segment::chain(&corner, true).unwrap();
        assert_eq!(ring.len(), 3);
        assert_eq!(ring[2].link(), Some(Link { along: [Some(up), Some(right)] }));
    }

    #[test]
    fn a_chain_that_is_none_is_refused_with_its_reason() {
        let chain = |points: &[[f32; 2]], is_ring| {
            let points: Vec<Vec2> = points.iter().copied().map(Vec2::from).collect();
            Segment::chain(&points, is_ring).unwrap_err().to_string()
        };
        assert_eq!(chain(&[], false), "the chain has 0 points: give at least 2");
        assert_eq!(chain(&[[0.0, 0.0], [1.0, 0.0]], true), "the chain has 2 points: give at least 3");
        let text = "point 1 of the chain is (NaN, 0): give it finite coordinates";
        assert_eq!(chain(&[[0.0, 0.0], [f32::NAN, 0.0]], false), text);
        let twice = chain(&[[0.0, 0.0], [1.0, 0.0], [1.0, 0.0], [2.0, 0.0]], false);
        assert!(twice.starts_with("the link of the chain from point 1 to the next is 0 m long"), "{twice}");
        let closed = chain(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 0.0]], true);
        assert!(closed.starts_with("the link of the chain from point 3 to the next is 0 m long"), "{closed}");
        let flat = chain(&[[0.0, 0.0], [1.0, 0.5], [4.0, 2.0], [3.0, 1.5]], true);
        assert!(
            flat.starts_with("all points of the ring lie on one line: move one of them off it"),
            "{flat}"
        );
        // A figure of eight goes round as much one way as the other, and yet round something.
        let eight = [[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]].map(Vec2::from);
        assert!(Segment::chain(&eight, true).is_ok());
    }
}
