//! What is on the way of a ray.

use crate::body::{BodyId, ColliderId};
use crate::math::{Point, Vec2};
use crate::world::{QueryFilter, World};

/// Where a ray met a body.
///
/// ```
/// use rustycs::prelude::*;
///
/// let mut world = World::new(Settings::default());
/// let mirror = world.add(Body::fixed(Shape::rectangle(1.0, 4.0)).at([5.0, 0.0]).angle(0.5))?;
/// let light = Vec2::new(9.0, 0.0);
/// let hit: RayHit = world.ray_cast([0.0, 0.0], light).unwrap();
/// assert_eq!(hit.body, mirror);
/// let rest = (1.0 - hit.fraction) * light; // what is left of the way is thrown back
/// let thrown_back = rest - 2.0 * rest.dot(hit.normal) * hit.normal;
/// assert!(world.ray_cast(hit.point + 1e-3 * hit.normal, thrown_back).is_none());
/// # Ok::<(), BodyError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct RayHit {
    /// The body.
    pub body: BodyId,
    /// Which of its shapes.
    pub collider: ColliderId,
    /// Where on the outline, m.
    pub point: Point,
    /// Normal of the outline there, length 1; zero where the ray began inside the body.
    pub normal: Vec2,
    /// How far along the ray, as a fraction of its length, 0 to 1.
    pub fraction: f32,
}

impl RayHit {
    /// The nearer comes first, and of equals the smaller ids.
    fn rank(&self) -> (f32, (BodyId, ColliderId)) {
        (self.fraction, (self.body, self.collider))
    }
}

impl World {
    /// The first body on the way from `origin` (m) along `translation` (m) that is no sensor. A ray that begins in a body hits
    /// it at once. `None` where there is nothing, or the ray is not finite or has no length.
    pub fn ray_cast(&self, origin: impl Into<Point>, translation: impl Into<Vec2>) -> Option<RayHit> {
        self.ray_cast_with(origin, translation, &QueryFilter::new())
    }

    /// The same of the bodies that a filter lets through, as the example at [`QueryFilter`] shows.
    pub fn ray_cast_with(
        &self,
        origin: impl Into<Point>,
        translation: impl Into<Vec2>,
        filter: &QueryFilter<'_>,
    ) -> Option<RayHit> {
        let (origin, translation) = (origin.into(), translation.into());
        let mut nearest: Option<RayHit> = None;
        if !is_ray(origin, translation) {
            return None;
        }
        self.broad_phase.ray_cast(origin, translation, 1.0, |slot, max_fraction| {
            let Some(hit) = self.ray_cast_body(slot, origin, translation, max_fraction, filter) else {
                return max_fraction;
            };
            // Among equals the smallest id, whatever order the tree is searched in.
            if nearest.is_none_or(|best| hit.rank() < best.rank()) {
                nearest = Some(hit);
            }
            just_beyond(hit.fraction).min(max_fraction)
        });
        nearest
    }

    /// All bodies but sensors on the way from `origin` (m) along `translation` (m), nearest first; one of several shapes once
    /// for each of them. None where the ray is
    /// not finite or has no length.
    pub fn ray_cast_all(&self, origin: impl Into<Point>, translation: impl Into<Vec2>) -> Vec<RayHit> {
        self.ray_cast_all_with(origin, translation, &QueryFilter::new())
    }

    /// The same of the bodies that a filter lets through.
    pub fn ray_cast_all_with(
        &self,
        origin: impl Into<Point>,
        translation: impl Into<Vec2>,
        filter: &QueryFilter<'_>,
    ) -> Vec<RayHit> {
        let mut hits = Vec::new();
        self.ray_cast_each(origin, translation, filter, |hit| {
            hits.push(hit);
            true
        });
        hits.sort_unstable_by(|one, other| {
            one.fraction.total_cmp(&other.fraction).then(one.rank().1.cmp(&other.rank().1))
        });
        hits
    }

    /// Calls `visit` with each body on the way from `origin` (m) along `translation` (m) that a filter lets through, until it
    /// returns false. They come in no order of distance, but in the same order in every run. It allocates nothing.
    ///
    /// ```
    /// # use rustycs::prelude::*;
    /// # let world = World::new(Settings::default());
    /// let mut count = 0;
    /// world.ray_cast_each([0.0, 0.0], [10.0, 0.0], &QueryFilter::new(), |_| {
    ///     count += 1;
    ///     count < 3 // more than two need not be found
    /// });
    /// ```
    pub fn ray_cast_each(
        &self,
        origin: impl Into<Point>,
        translation: impl Into<Vec2>,
        filter: &QueryFilter<'_>,
        mut visit: impl FnMut(RayHit) -> bool,
    ) {
        let (origin, translation) = (origin.into(), translation.into());
        if !is_ray(origin, translation) {
            return;
        }
        self.broad_phase.ray_cast(origin, translation, 1.0, |slot, max_fraction| {
            let goes_on = self.ray_cast_body(slot, origin, translation, 1.0, filter).is_none_or(&mut visit);
            if goes_on { max_fraction } else { 0.0 }
        });
    }

    fn ray_cast_body(
        &self,
        slot: u32,
        origin: Point,
        translation: Vec2,
        max_fraction: f32,
        filter: &QueryFilter<'_>,
    ) -> Option<RayHit> {
        if !self.is_asked_about(filter, slot) {
            return None;
        }
        let (pose, shape) = (self.bodies.motions[slot as usize].pose, &self.bodies.shapes[slot as usize]);
        let hit = shape.ray_cast(pose, origin, translation, max_fraction)?;
        let point = origin + translation * hit.fraction;
        let (body, collider) = (self.id_of(slot), self.collider_id(slot));
        let hit = RayHit { body, collider, point, normal: hit.normal, fraction: hit.fraction };
        self.satisfies(filter, slot).then_some(hit)
    }
}

/// A fraction just beyond that of a hit, so that equals are still found.
pub(super) fn just_beyond(fraction: f32) -> f32 {
    fraction + f32::MIN_POSITIVE + fraction * f32::EPSILON
}

/// Whether a ray has a place and a direction.
fn is_ray(origin: Point, translation: Vec2) -> bool {
    origin.is_finite() && translation.normalized().is_some()
}
