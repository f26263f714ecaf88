//! Bodies on one corner: how far they have turned about it, and whether they may come to others that their manifold does not have.

use crate::collision::refresh::{Frozen, Offset, Pair};
use crate::collision::{Contact, ManifoldPoint};
use crate::math::{Rot, Vec2};
use crate::shape::Shape;

impl Pair<'_> {
    /// How far any point of b has moved at most as a sees it since their manifold was found, and may move until the end of the step,
    /// together, m. What the manifold does not have was farther than [`near`](Self::near) then.
    pub(super) fn strayed(&self, then: &Frozen) -> f32 {
        let seen = |offset: Offset, a: Rot, b: Rot| (a.unrotate(offset.near), a.inverse() * b);
        let (offset, rotation) = seen(self.offset, self.rotation_a, self.rotation_b);
        let (offset_then, rotation_then) = seen(then.offset, then.rotation_a, then.rotation_b);
        let turned = rotation * rotation_then.inverse();
        if turned.c <= 0.0 {
            return f32::INFINITY;
        }
        let [state_a, state_b] = self.states();
        let turning = state_b.angular_velocity - state_a.angular_velocity;
        let velocity = self.velocity() - self.offset.near.perp() * state_a.angular_velocity;
        (offset - offset_then).length()
            + velocity.length() * self.dt
            + (turned.s.abs() + turning.abs() * self.dt) * self.motion_b.extent
    }

    /// Whether one corner bears all, and the body may tip onto a corner that the manifold lacks: of three all but in line it has two.
    pub(super) fn may_turn_to_another_corner(&self, contact: &Contact) -> bool {
        let bears = |point: &&ManifoldPoint| point.normal_impulse > 0.0;
        let normal = contact.manifold.normal;
        contact.manifold.points().iter().filter(bears).count() == 1
            && (self.has_three_near(self.shape_a, self.rotation_a.unrotate(normal))
                || self.has_three_near(self.shape_b, self.rotation_b.unrotate(-normal)))
    }

    /// Whether a shape has three corners within [`near`](Self::near) of the farthest in a direction, in its frame.
    fn has_three_near(&self, shape: &Shape, direction: Vec2) -> bool {
        // A box never has three.
        let (Shape::Polygon(_) | Shape::Rounded(_), Some((hull, _))) = (shape, shape.core()) else {
            return false;
        };
        let reaches = hull.vertices().iter().map(|corner| direction.dot(*corner));
        let farthest = reaches.clone().fold(f32::NEG_INFINITY, f32::max);
        reaches.filter(|reach| farthest - reach < self.near()).count() > 2
    }
}
