//! What a shape would touch: where it is, or on a way; and what is nearest to a place.

use crate::body::{BodyId, ColliderId};
use crate::collision::{Swept, detect, detect_within, time_of_impact};
use crate::math::{Point, Pose, Vec2};
use crate::shape::Shape;
use crate::world::query::ray::just_beyond;
use crate::world::{ColliderRef, QueryFilter, World};

/// Far enough that the nearest points of two shapes are found, wherever they are, m.
const ANY_DISTANCE: f32 = f32::INFINITY;

/// Points touch together whose gaps differ by no more than this share of the width of the thinner shape, no unit: rounding is
/// far less, and what leans by as much is seen to.
const FLAT_WITHIN: f32 = 1e-3;

/// Where a shape that moves meets a body.
///
/// ```
/// use rustycs::prelude::*;
///
/// let mut world = World::new(Settings::default());
/// let wall = world.add(Body::fixed(Shape::rectangle(1.0, 4.0)).at([5.0, 0.0]))?;
/// // How far can a crate be pushed?
/// let crate_ = Shape::rectangle(1.0, 1.0);
/// let hit: ShapeHit = world.shape_cast(&crate_, Pose::default(), [8.0, 0.0], &QueryFilter::new()).unwrap();
/// assert_eq!((hit.body, hit.normal), (wall, Vec2::new(-1.0, 0.0)));
/// assert!((hit.fraction * 8.0 - 4.0).abs() < 1e-3);
/// # Ok::<(), BodyError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct ShapeHit {
    /// The body.
    pub body: BodyId,
    /// Which of its shapes.
    pub collider: ColliderId,
    /// Where they touch, m; between the ends where they touch along an edge. The centre of the shape where it began within
    /// the body.
    pub point: Point,
    /// Normal of the body there, towards the shape, length 1; zero where the shape began within the body.
    pub normal: Vec2,
    /// How far along the way, as a fraction of its length, 0 to 1.
    pub fraction: f32,
}

/// The nearest body.
///
/// ```
/// use rustycs::prelude::*;
///
/// let mut world = World::new(Settings::default());
/// let coin = world.add(Body::fixed(Shape::circle(0.3)).at([2.0, 0.0]))?;
/// // What lies within reach of a hand, nearest first:
/// let found: ClosestHit = world.closest([0.0, 0.0], 5.0, &QueryFilter::new()).unwrap();
/// assert_eq!(found.body, coin);
/// assert!((found.distance - 1.7).abs() < 1e-6 && found.point.distance([1.7, 0.0]) < 1e-6);
/// # Ok::<(), BodyError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct ClosestHit {
    /// The body.
    pub body: BodyId,
    /// Which of its shapes.
    pub collider: ColliderId,
    /// Its nearest point, m: the place itself where that lies in the body.
    pub point: Point,
    /// How far away that is, m; 0 within the body.
    pub distance: f32,
}

/// A shape on its way, which is straight and without a turn.
struct Caster<'a> {
    shape: &'a Shape,
    pose: Pose,
    translation: Vec2,
}

impl World {
    /// The first body that a shape would meet which begins in `pose` and moves along `translation` (m) without turning, of
    /// those that a filter lets through. One that it overlaps as it begins is met at once; one that it touches is met if it
    /// moves into it. `None` where there is nothing, or the shape or its way is not finite or of no size.
    ///
    /// The fraction is never too large but for rounding: the shape can be put there.
    ///
    /// ```
    /// # use rustycs::prelude::*;
    /// # let mut world = World::new(Settings::default());
    /// world.add(Body::fixed(Shape::aabb(20.0, 1.0)))?;
    /// // How far does a ball fall?
    /// let hit = world.shape_cast(&Shape::circle(0.5), Pose::at([0.0, 5.0]), [0.0, -10.0], &QueryFilter::new());
    /// assert!((10.0 * hit.unwrap().fraction - 4.0).abs() < 1e-5);
    /// # Ok::<(), BodyError>(())
    /// ```
    pub fn shape_cast(
        &self,
        shape: &Shape,
        pose: Pose,
        translation: impl Into<Vec2>,
        filter: &QueryFilter<'_>,
    ) -> Option<ShapeHit> {
        self.shape_cast_where(shape, pose, translation.into(), filter, Some)
    }

    /// The same of what is left of each hit: nothing, or what stands in its place at the same part of the way.
    pub(in crate::world) fn shape_cast_where(
        &self,
        shape: &Shape,
        pose: Pose,
        translation: Vec2,
        filter: &QueryFilter<'_>,
        see: impl Fn(ShapeHit) -> Option<ShapeHit>,
    ) -> Option<ShapeHit> {
        let caster = Caster { shape, pose, translation };
        if !can_be_placed(shape, pose) || !caster.translation.is_finite() {
            return None;
        }
        let mut nearest: Option<ShapeHit> = None;
        let visit = |slot: u32, max_fraction: f32| {
            let Some(hit) = self.cast_at_body(&caster, slot, max_fraction, filter).and_then(&see) else {
                return max_fraction;
            };
            // Among equals the smallest id, whatever order the tree is searched in.
            let rank = |hit: &ShapeHit| (hit.fraction, hit.body, hit.collider);
            if nearest.is_none_or(|best| rank(&hit) < rank(&best)) {
                nearest = Some(hit);
            }
            just_beyond(hit.fraction).min(max_fraction)
        };
        self.broad_phase.cast(pose.center, shape.extent(), caster.translation, 1.0, visit);
        nearest
    }

    /// The bodies that a shape in `pose` would touch or overlap, of those that a filter lets through, by ascending id. None if
    /// the shape or its place is not finite or of no size.
    ///
    /// ```
    /// # use rustycs::prelude::*;
    /// # let mut world = World::new(Settings::default());
    /// # let crate_ = world.add(Body::dynamic(Shape::obb(1.0, 1.0)).at([2.0, 0.0]))?;
    /// let blast = Shape::circle(3.0);
    /// for id in world.overlaps(&blast, Pose::at([0.0, 0.0]), &QueryFilter::new()) {
    ///     let away = world.body(id).unwrap().position().normalized_or_zero();
    ///     world.body_mut(id).unwrap().apply_impulse(away * 5.0);
    /// }
    /// # assert!(world.body(crate_).unwrap().velocity().x > 0.0);
    /// # Ok::<(), BodyError>(())
    /// ```
    pub fn overlaps(&self, shape: &Shape, pose: Pose, filter: &QueryFilter<'_>) -> Vec<BodyId> {
        let mut found = Vec::new();
        self.overlaps_each(shape, pose, filter, |id| {
            found.push(id);
            true
        });
        found.sort_unstable();
        found.dedup();
        found
    }

    /// Calls `visit` with each of the bodies that [`overlaps`](Self::overlaps) finds, one of several shapes for each that
    /// overlaps, until it returns false. They come in the
    /// same order in every run. It allocates nothing.
    pub fn overlaps_each(
        &self,
        shape: &Shape,
        pose: Pose,
        filter: &QueryFilter<'_>,
        mut visit: impl FnMut(BodyId) -> bool,
    ) {
        if !can_be_placed(shape, pose) {
            return;
        }
        self.broad_phase.query(shape.bounding_box(pose), |slot| {
            let overlaps = self.is_asked_about(filter, slot) && self.overlaps_body(shape, pose, slot);
            !(overlaps && self.satisfies(filter, slot)) || visit(self.id_of(slot))
        });
    }

    /// Calls `visit` with each shape that a shape in `pose` touches or overlaps.
    pub(in crate::world) fn overlapping_each(
        &self,
        shape: &Shape,
        pose: Pose,
        filter: &QueryFilter<'_>,
        mut visit: impl FnMut(ColliderRef<'_>),
    ) {
        self.broad_phase.query(shape.bounding_box(pose), |slot| {
            if self.is_asked_about(filter, slot) && self.overlaps_body(shape, pose, slot) {
                visit(ColliderRef::new(self, slot));
            }
            true
        });
    }

    /// The body nearest to a place (m), of those that a filter lets through, if it is not farther away than `max_distance`, m,
    /// which may be infinite. Among equals it is the one with the smallest id. `None` where there is none, or the place is not
    /// finite.
    ///
    /// ```
    /// # use rustycs::prelude::*;
    /// # let mut world = World::new(Settings::default());
    /// # world.add(Body::fixed(Shape::aabb(2.0, 2.0)))?;
    /// let nearest = world.closest([3.0, 0.5], 10.0, &QueryFilter::new()).unwrap();
    /// assert_eq!((nearest.distance, nearest.point), (2.0, [1.0, 0.5].into()));
    /// # Ok::<(), BodyError>(())
    /// ```
    pub fn closest(
        &self,
        place: impl Into<Point>,
        max_distance: f32,
        filter: &QueryFilter<'_>,
    ) -> Option<ClosestHit> {
        let place = place.into();
        // NaN is no distance.
        if !place.is_finite() || !(max_distance >= 0.0) {
            return None;
        }
        let mut nearest: Option<(f64, ClosestHit)> = None;
        self.broad_phase.nearest(place, f64::from(max_distance), |slot, limit| {
            if !self.is_asked_about(filter, slot) {
                return limit;
            }
            let pose = self.bodies.motions[slot as usize].pose;
            let point = self.bodies.shapes[slot as usize].closest_point(pose, place);
            let (distance, body, collider) =
                (place.distance(point), self.id_of(slot), self.collider_id(slot));
            let is_nearer =
                nearest.is_none_or(|(best, hit)| (distance, body, collider) < (best, hit.body, hit.collider));
            if distance <= limit && is_nearer && self.satisfies(filter, slot) {
                nearest = Some((distance, ClosestHit { body, collider, point, distance: distance as f32 }));
                return distance;
            }
            limit
        });
        nearest.map(|(_, hit)| hit)
    }

    /// Whether a shape touches or overlaps the body in `slot`.
    pub(in crate::world) fn overlaps_body(&self, shape: &Shape, pose: Pose, slot: u32) -> bool {
        let of_body = self.bodies.motions[slot as usize].pose;
        detect(shape, pose, &self.bodies.shapes[slot as usize], of_body).is_some()
    }

    /// Where a shape on its way meets the body in `slot`, if not beyond `max_fraction`.
    fn cast_at_body(
        &self,
        caster: &Caster<'_>,
        slot: u32,
        max_fraction: f32,
        filter: &QueryFilter<'_>,
    ) -> Option<ShapeHit> {
        if !self.is_asked_about(filter, slot) {
            return None;
        }
        let Meets { time, point, normal } = caster.meets(
            &self.bodies.shapes[slot as usize],
            self.bodies.motions[slot as usize].pose,
            max_fraction,
        )?;
        let (body, collider) = (self.id_of(slot), self.collider_id(slot));
        let hit = ShapeHit { body, collider, point, normal, fraction: time as f32 };
        self.satisfies(filter, slot).then_some(hit)
    }
}

/// Where a shape on its way meets another: the part of the way until then, and where.
struct Meets {
    time: f64,
    point: Point,
    normal: Vec2,
}

impl Caster<'_> {
    /// Where it meets a shape in a pose, if not beyond `max_fraction`.
    fn meets(&self, shape: &Shape, pose: Pose, max_fraction: f32) -> Option<Meets> {
        // From where the circles around the two touch: what is left of the way is short, and has all its digits.
        let from = self.circles_meet(shape.extent(), pose.center)?;
        let until = f64::from(max_fraction) - from;
        if until < 0.0 {
            return None;
        }
        let start = self.center_after(from);
        let [a, b] = [(self.shape, self.pose), (shape, pose)].map(|(shape, pose)| Swept {
            shape,
            rotation: pose.rotation,
            spin: 0.0,
            arm: Vec2::ZERO,
        });
        let left = time_of_impact(a, b, pose.center - start, -self.translation, until as f32, 0.0)?;
        let time = from + f64::from(left);
        let center = self.center_after(time);
        let offset = pose.center - center;
        let manifold = detect_within(a.shape, a.rotation, shape, b.rotation, offset, ANY_DISTANCE)?;
        let (points, normal) = (manifold.points(), manifold.normal);
        let depth = points.iter().map(|point| -point.separation).fold(f32::NEG_INFINITY, f32::max);
        if time == 0.0 {
            // Less is rounding: they touch.
            let noise = 8.0 * f32::EPSILON * (self.shape.extent() + shape.extent());
            if depth > noise {
                return Some(Meets { time, point: center, normal: Vec2::ZERO });
            }
            if normal.dot(self.translation) <= 0.0 {
                return None;
            }
        }
        // Of an edge that leans only one end touches.
        let near = FLAT_WITHIN * self.shape.width_between(shape) - depth;
        let touching = points.iter().filter(|point| point.separation <= near);
        let (sum, count) =
            touching.fold((Vec2::ZERO, 0.0), |(sum, count), point| (sum + point.anchor_a, count + 1.0_f32));
        Some(Meets { time, point: center + sum / count, normal: -normal })
    }

    /// Where the centre is after a part of the way.
    fn center_after(&self, part: f64) -> Point {
        let Point { x, y } = self.pose.center;
        [x + part * f64::from(self.translation.x), y + part * f64::from(self.translation.y)].into()
    }

    /// After which part of the way the circle around the shape touches that of another around `center`, 0 where it does as it
    /// begins; `None` if it does not at all.
    fn circles_meet(&self, extent: f32, center: Point) -> Option<f64> {
        // A little more, for rounding.
        let reach = (f64::from(self.shape.extent()) + f64::from(extent)) * (1.0 + 1e-6);
        let (x, y) = (self.pose.center.x - center.x, self.pose.center.y - center.y);
        let (along_x, along_y) = (f64::from(self.translation.x), f64::from(self.translation.y));
        if x * x + y * y <= reach * reach {
            return Some(0.0);
        }
        let (length_squared, approach) =
            (along_x * along_x + along_y * along_y, -(x * along_x + y * along_y));
        // The distance of the centre from the line by a cross product: no difference of large squares.
        let across = x * along_y - y * along_x;
        let discriminant = reach * reach * length_squared - across * across;
        (approach > 0.0 && discriminant >= 0.0).then(|| (approach - discriminant.sqrt()) / length_squared)
    }
}

/// Whether a shape is one, and its place too.
fn can_be_placed(shape: &Shape, pose: Pose) -> bool {
    let is_turn = (pose.rotation.c * pose.rotation.c + pose.rotation.s * pose.rotation.s - 1.0).abs() < 1e-3;
    shape.validate().is_ok() && pose.center.is_finite() && is_turn
}
