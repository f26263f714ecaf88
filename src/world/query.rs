//! Questions about where bodies are. All of them see every edit at once, also before the first step.

mod filter;
mod ray;
mod shape;

pub use filter::QueryFilter;
pub use ray::RayHit;
pub use shape::{ClosestHit, ShapeHit};

use crate::body::BodyId;
use crate::collision::detect;
use crate::math::{Aabb, Point, Pose, Vec2};
use crate::shape::{MIN_SIZE, Shape};
use crate::world::World;

impl World {
    /// The bodies at a place (m), sensors too, their outlines included, by ascending id. None for a place that is not
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
        found.dedup();
        found
    }

    /// The bodies, sensors too, that share a point with a box given by two corners (m), by ascending id. None for a box
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
        found.dedup();
        found
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

    /// The id of the body that the shape in `slot` is of.
    pub(in crate::world) fn id_of(&self, slot: u32) -> BodyId {
        BodyId(self.bodies.records.key_at(self.bodies.body_of(slot)))
    }
}
