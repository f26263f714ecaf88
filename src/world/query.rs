//! Questions about where bodies are. All of them see every edit at once, also before the first step.

use crate::body::BodyId;
use crate::collision::detect;
use crate::math::{Aabb, Point, Pose, Vec2};
use crate::shape::{MIN_SIZE, Shape};
use crate::world::World;

/// Where a ray met a body.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct RayHit {
    /// The body.
    pub body: BodyId,
    /// Where on the outline, m.
    pub point: Point,
    /// Normal of the outline there, length 1; zero where the ray began inside the body.
    pub normal: Vec2,
    /// How far along the ray, as a fraction of its length, 0 to 1.
    pub fraction: f32,
}

impl World {
    /// The bodies at a place (m), their outlines included, by ascending id. None for a place that is not
    /// finite.
    pub fn bodies_at(&self, place: impl Into<Point>) -> Vec<BodyId> {
        let place = place.into();
        let mut found = Vec::new();
        if !place.is_finite() {
            return found;
        }
        let at_place = Aabb::around(place, Vec2::ZERO, Vec2::ZERO);
        self.broad_phase.query(at_place, |slot| {
            let body = &self.bodies.motions[slot as usize];
            if self.bodies.shapes[slot as usize].contains(body.pose, place) {
                found.push(self.id_of(slot));
            }
            true
        });
        found.sort_unstable();
        found
    }

    /// The bodies that share a point with a box given by two corners (m), by ascending id. None for a box
    /// that is not finite or has its corners the wrong way round.
    pub fn bodies_in(&self, min: impl Into<Point>, max: impl Into<Point>) -> Vec<BodyId> {
        let (min, max) = (min.into(), max.into());
        let mut found = Vec::new();
        if !(min.is_finite() && max.is_finite() && min.x <= max.x && min.y <= max.y) {
            return found;
        }
        let corner = |place| Aabb::around(place, Vec2::ZERO, Vec2::ZERO);
        self.broad_phase.query(Aabb::new(corner(min).min, corner(max).max), |slot| {
            if self.shares_a_point(slot, min, max) {
                found.push(self.id_of(slot));
            }
            true
        });
        found.sort_unstable();
        found
    }

    /// The first body on the way from `origin` (m) along `translation` (m). A ray that begins in a body hits
    /// it at once. `None` where there is nothing, or the ray is not finite or has no length.
    pub fn ray_cast(&self, origin: impl Into<Point>, translation: impl Into<Vec2>) -> Option<RayHit> {
        let (origin, translation) = (origin.into(), translation.into());
        let mut nearest: Option<RayHit> = None;
        if !is_ray(origin, translation) {
            return None;
        }
        self.broad_phase.ray_cast(origin, translation, 1.0, |slot, max_fraction| {
            let Some(hit) = self.ray_cast_body(slot, origin, translation, max_fraction) else {
                return max_fraction;
            };
            // Among equals the smallest id, whatever order the tree is searched in.
            if nearest.is_none_or(|best| (hit.fraction, hit.body) < (best.fraction, best.body)) {
                nearest = Some(hit);
            }
            // Just beyond the hit, so that equals are still found.
            max_fraction.min(hit.fraction + f32::MIN_POSITIVE + hit.fraction * f32::EPSILON)
        });
        nearest
    }

    /// All bodies on the way from `origin` (m) along `translation` (m), nearest first. None where the ray is
    /// not finite or has no length.
    pub fn ray_cast_all(&self, origin: impl Into<Point>, translation: impl Into<Vec2>) -> Vec<RayHit> {
        let (origin, translation) = (origin.into(), translation.into());
        let mut hits = Vec::new();
        if is_ray(origin, translation) {
            self.broad_phase.ray_cast(origin, translation, 1.0, |slot, max_fraction| {
                hits.extend(self.ray_cast_body(slot, origin, translation, 1.0));
                max_fraction
            });
        }
        hits.sort_unstable_by(|one, other| {
            one.fraction.total_cmp(&other.fraction).then(one.body.cmp(&other.body))
        });
        hits
    }

    fn ray_cast_body(
        &self,
        slot: u32,
        origin: Point,
        translation: Vec2,
        max_fraction: f32,
    ) -> Option<RayHit> {
        let (pose, shape) = (self.bodies.motions[slot as usize].pose, &self.bodies.shapes[slot as usize]);
        let hit = shape.ray_cast(pose, origin, translation, max_fraction)?;
        let point = origin + translation * hit.fraction;
        Some(RayHit { body: self.id_of(slot), point, normal: hit.normal, fraction: hit.fraction })
    }

    /// Whether the body in `slot` shares a point with a box, to `MIN_SIZE`. The box is cut to where the body
    /// is first, so that a box of any size anywhere is met as exactly as a small one.
    fn shares_a_point(&self, slot: u32, min: Point, max: Point) -> bool {
        let (pose, shape) = (self.bodies.motions[slot as usize].pose, &self.bodies.shapes[slot as usize]);
        let Point { x, y } = pose.center;
        let reach = 2.0 * f64::from(shape.extent());
        let (left, right) = (min.x.max(x - reach), max.x.min(x + reach));
        let (bottom, top) = (min.y.max(y - reach), max.y.min(y + reach));
        if !(left <= right && bottom <= top) {
            return false;
        }
        // A box without width is a line; the narrow phase wants one that has some.
        let size = [right - left, top - bottom].map(|side| (side as f32).max(MIN_SIZE));
        let region = Shape::aabb(size[0], size[1]);
        detect(&region, Pose::at([0.5 * (left + right), 0.5 * (bottom + top)]), shape, pose).is_some()
    }

    fn id_of(&self, slot: u32) -> BodyId {
        BodyId(self.bodies.records.key_at(slot))
    }
}

/// Whether a ray has a place and a direction.
fn is_ray(origin: Point, translation: Vec2) -> bool {
    origin.is_finite() && translation.normalized().is_some()
}
