//! What a character meets, and where that leaves it.

use crate::body::BodyId;
use crate::collision::{Manifold, detect, free_side_of};
use crate::math::{Point, Pose, Vec2};
use crate::world::character::trip::{ALONG, Trip};
use crate::world::{BodyRef, ColliderRef, QueryFilter, RayHit, ShapeHit};

/// What overlaps by less than so many gaps is met like a wall by what moves into it; what is deeper has caught the character, and
/// is passed, so that it can leave.
const SHALLOW: f32 = 4.0;

/// Rounds in which a character is pushed out of what overlaps it: two things beside each other take two.
const ROUNDS: usize = 4;

/// Out of a wedge a way is at most so many times as long as the overlap is deep, no unit: a slope of 75° and a wall need as much. Out of a
/// press that closes on it a character is not squeezed far along.
const LONGEST_WAY: f32 = 4.0;

impl Trip<'_> {
    /// The first thing on a way, m; what carries the character is none.
    pub(super) fn cast(&self, way: Vec2) -> Option<ShapeHit> {
        let filter = self.all_but_ignored().ignore_all(self.carrier.as_slice());
        let pose = Pose::at(self.at);
        self.world.shape_cast_where(&self.character.shape, pose, way, &filter, |hit| self.meets(hit, way))
    }

    /// All but the body that it is told to ignore. Filters, which shapes have each for itself, are asked of what is found.
    pub(super) fn all_but_ignored(&self) -> QueryFilter<'_> {
        self.character.ignored.map_or(QueryFilter::new(), |body| QueryFilter::new().ignore(body))
    }

    /// What a hit on a way is to the character; `None` if it passes.
    fn meets(&self, hit: ShapeHit, way: Vec2) -> Option<ShapeHit> {
        let collider = self.world.collider(hit.collider)?;
        if !self.collides_with(collider) {
            return None;
        }
        let hit = if hit.normal == Vec2::ZERO { self.overlap_as_hit(hit, collider, way)? } else { hit };
        // The side of a piece of ground is gone along, just above a seam, and is in the way of nothing.
        let is_ahead = way.dot(hit.normal) < -ALONG * way.length();
        (is_ahead && self.is_borne_side(collider, hit.normal, way)).then_some(hit)
    }

    fn collides_with(&self, collider: ColliderRef<'_>) -> bool {
        self.character.filter.collides_with(collider.filter())
    }

    /// The place of a body that a ray finds, with nothing solid before it.
    pub(super) fn sees(&self, body: BodyId, from: Point, way: Vec2) -> Option<RayHit> {
        self.first_solid(from, way, Some(body)).filter(|hit| hit.body == body)
    }

    /// The first solid thing along a ray, or this body: one-way floors are not solid.
    pub(super) fn first_solid(&self, from: Point, way: Vec2, or: Option<BodyId>) -> Option<RayHit> {
        let is_solid = |other: BodyRef<'_>| {
            let is_solid =
                |collider: ColliderRef<'_>| self.collides_with(collider) && collider.one_way().is_none();
            Some(other.id()) == or || other.colliders().any(is_solid)
        };
        let filter = self.all_but_ignored().predicate(&is_solid);
        self.world.ray_cast_with(from, way, &filter)
    }

    /// Whether a thing is solid on the side of this normal for what moves along a way: one-way floors are on one.
    fn is_borne_side(&self, collider: ColliderRef<'_>, normal: Vec2, way: Vec2) -> bool {
        let Some(direction) = collider.one_way() else { return true };
        let free = collider.pose().rotation.rotate(direction);
        // A chain is no floor to drop through.
        let may_bear = !self.passes_one_way || collider.shape().link().is_some();
        may_bear && normal.dot(free) >= free_side_of(collider.shape()) && way.dot(free) <= 0.0
    }

    /// What overlaps the character a little as it moves into it.
    fn overlap_as_hit(&self, hit: ShapeHit, collider: ColliderRef<'_>, way: Vec2) -> Option<ShapeHit> {
        let manifold = self.manifold_with(collider)?;
        let (depth, normal) = (depth_of(&manifold), -manifold.normal);
        let is_met = depth <= SHALLOW * self.skin && way.dot(normal) < 0.0;
        let point = self.at + manifold.points().first()?.anchor_a;
        is_met.then_some(ShapeHit { point, normal, ..hit })
    }

    fn manifold_with(&self, collider: ColliderRef<'_>) -> Option<Manifold> {
        detect(&self.character.shape, Pose::at(self.at), collider.shape(), collider.pose())
    }

    /// Gets out of what has moved into the character. If there is no room for that it stays where it is, and what is the deepest in
    /// it is returned.
    pub(super) fn get_out(&mut self) -> Option<BodyId> {
        let (start, mut before) = (self.at, Vec2::ZERO);
        for _ in 0..ROUNDS {
            let (depth, normal, _) = self.deepest_overlap()?;
            // What would push it back into the one before is left along that: out of a wedge.
            let along = if normal.dot(before) < 0.0 { before.perp() } else { normal };
            let share = along.dot(normal);
            let out = if share.abs() * LONGEST_WAY > 1.0 { along / share } else { normal };
            self.at += out * (depth + self.skin);
            before = normal;
        }
        let (depth, _, body) = self.deepest_overlap()?;
        if depth <= self.skin {
            return None;
        }
        self.at = start;
        Some(body)
    }

    /// How deep the deepest overlap is, m, in which direction it is left, and which body it is with.
    fn deepest_overlap(&self) -> Option<(f32, Vec2, BodyId)> {
        let mut deepest: Option<(f32, Vec2, BodyId)> = None;
        let (shape, pose) = (&self.character.shape, Pose::at(self.at));
        self.world.overlapping_each(shape, pose, &self.all_but_ignored(), |collider| {
            let body = collider.body();
            let is_met = self.collides_with(collider) && collider.one_way().is_none();
            if is_met && let Some(manifold) = self.manifold_with(collider) {
                let depth = depth_of(&manifold);
                // Among equals the smallest id, whatever order they come in.
                let rank = |depth: f32, body| (-depth, body);
                if depth > 0.0 && deepest.is_none_or(|(best, _, of)| rank(depth, body) < rank(best, of)) {
                    deepest = Some((depth, -manifold.normal, body));
                }
            }
        });
        deepest
    }
}

fn depth_of(manifold: &Manifold) -> f32 {
    manifold.points().iter().map(|point| -point.separation).fold(f32::NEG_INFINITY, f32::max)
}
