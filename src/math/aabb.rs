//! An axis-aligned bounding box, in `f32` and rounded outward.

use crate::math::{Point, Reach, Vec2};

/// An axis-aligned box between two corners, m: what the broad phase sorts bodies by.
///
/// Coordinates are `f32` of the world's frame. Boxes made from places in `f64` are rounded outward, so that
/// far from the origin they grow but never miss what they hold.
///
/// ```
/// use rustycs::prelude::*;
///
/// let room = Aabb::new(Vec2::new(0.0, 0.0), Vec2::new(4.0, 3.0)); // m, two corners
/// let table = Shape::rectangle(2.0, 1.0).bounding_box(Pose::at([2.0, 0.5]));
/// assert!(room.grown(0.01).contains(table));
/// assert_eq!(room.size(), Vec2::new(4.0, 3.0));
/// ```
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Aabb {
    /// Lower left corner, m.
    pub min: Vec2,
    /// Upper right corner, m.
    pub max: Vec2,
}

impl Aabb {
    /// The box between two corners, m.
    pub const fn new(min: Vec2, max: Vec2) -> Self {
        Self { min, max }
    }

    /// The box from `center + low` to `center + high`, m, rounded outward.
    pub fn around(center: Point, low: Vec2, high: Vec2) -> Self {
        Self {
            min: Vec2::new(round_down(center.x + f64::from(low.x)), round_down(center.y + f64::from(low.y))),
            max: Vec2::new(round_up(center.x + f64::from(high.x)), round_up(center.y + f64::from(high.y))),
        }
    }

    /// Middle of the box, m.
    pub fn center(self) -> Vec2 {
        (self.min + self.max) * 0.5
    }

    /// Width and height, m.
    pub fn size(self) -> Vec2 {
        self.max - self.min
    }

    /// Length of the outline, m: the cost measure of the bounding-volume tree.
    #[inline(always)]
    pub fn perimeter(self) -> f32 {
        Reach::from(self).perimeter()
    }

    /// The smallest box that holds both.
    #[inline(always)]
    #[must_use]
    pub fn union(self, other: Self) -> Self {
        Reach::from(self).union(other.into()).aabb()
    }

    /// The box grown by `margin`, m, on every side.
    #[inline(always)]
    #[must_use]
    pub fn grown(self, margin: f32) -> Self {
        Self { min: self.min - Vec2::splat(margin), max: self.max + Vec2::splat(margin) }
    }

    /// The box stretched so that it also holds itself moved by `motion`, m.
    #[inline(always)]
    #[must_use]
    pub fn swept(self, motion: Vec2) -> Self {
        Self { min: self.min + motion.min(Vec2::ZERO), max: self.max + motion.max(Vec2::ZERO) }
    }

    /// Whether the two share a point, borders included.
    #[inline(always)]
    pub fn overlaps(self, other: Self) -> bool {
        Reach::from(self).meets(Reach::from(other).opposite())
    }

    /// Whether a place lies within this box, borders included.
    pub fn contains_point(self, place: Point) -> bool {
        f64::from(self.min.x) <= place.x
            && place.x <= f64::from(self.max.x)
            && f64::from(self.min.y) <= place.y
            && place.y <= f64::from(self.max.y)
    }

    /// Whether `other` lies within this box, borders included.
    #[inline(always)]
    pub fn contains(self, other: Self) -> bool {
        Reach::from(self).contains(other.into())
    }
}

/// Largest `f32` that is not above `value`.
///
/// Without a branch: whether the nearest `f32` is above is as good as random.
#[inline(always)]
fn round_down(value: f64) -> f32 {
    let nearest = value as f32;
    // Floats of one sign are ordered as their bits are: the next one below is one less, or one more where the sign
    // is negative. What is rounded up to zero is negative and so is that zero.
    let bits = nearest.to_bits();
    let is_above = u32::from(f64::from(nearest) > value);
    let one_less = is_above.wrapping_sub(2 * is_above * (bits >> 31));
    f32::from_bits(bits.wrapping_sub(one_less))
}

/// Smallest `f32` that is not below `value`.
fn round_up(value: f64) -> f32 {
    -round_down(-value)
}

#[cfg(test)]
mod tests {
    use super::{Aabb, Vec2, round_down, round_up};
    use crate::math::Point;

    /// The two neighbours of a number between two floats are those floats, on both sides of zero and at the ends of
    /// the range; a float is its own.
    #[test]
    fn rounding_down_and_up_gives_the_neighbours() {
        let tiny = f32::from_bits(1);
        for (low, high) in
            [(1.0, 1.0 + f32::EPSILON), (0.0, tiny), (tiny, 2.0 * tiny), (f32::MAX, f32::INFINITY)]
        {
            let middle = f64::from(low) + (f64::from(high).min(1e39) - f64::from(low)) * 0.4;
            for between in [middle, middle + (middle - f64::from(low)) * 0.5] {
                assert_eq!((round_down(between), round_up(between)), (low, high), "{between}");
                assert_eq!((round_down(-between), round_up(-between)), (-high, -low), "{between}");
            }
            for exact in [low, -low, high, -high] {
                let value = f64::from(exact);
                assert_eq!((round_down(value), round_up(value)), (exact, exact), "{exact}");
            }
        }
    }

    /// All boxes with corners on a grid of four by four. What two of them share is a box of that kind, and so is what
    /// holds both: the places of the grid tell all there is to know, borders included.
    #[test]
    fn boxes_answer_as_their_places_do() {
        let coordinates = || (0..4).map(|place| place as f32);
        let places = || coordinates().flat_map(|x| coordinates().map(move |y| Vec2::new(x, y)));
        let boxes = || {
            let all = places().flat_map(|min| places().map(move |max| Aabb::new(min, max)));
            all.filter(|aabb| aabb.min.x <= aabb.max.x && aabb.min.y <= aabb.max.y)
        };
        let has = |aabb: Aabb, place: Vec2| aabb.contains_point(Point::new(place.x.into(), place.y.into()));
        assert_eq!(boxes().count(), 100);
        for a in boxes() {
            assert_eq!(a.perimeter(), 2.0 * (a.size().x + a.size().y), "{a:?}");
            for b in boxes() {
                let mut of_b = places().filter(|&place| has(b, place));
                assert_eq!(a.overlaps(b), of_b.clone().any(|place| has(a, place)), "{a:?} {b:?}");
                assert_eq!(a.contains(b), of_b.all(|place| has(a, place)), "{a:?} {b:?}");
                let union = a.union(b);
                let smallest = boxes().filter(|one| one.contains(a) && one.contains(b));
                let smallest = smallest.min_by(|one, other| one.perimeter().total_cmp(&other.perimeter()));
                assert_eq!(Some(union), smallest, "{a:?} {b:?}");
            }
        }
    }
}
