//! Time of impact: when do two shapes first come near, of which each moves and turns evenly.
//!
//! For fast pairs only, so that nothing passes through anything. Two shapes are as far apart as the widest strip between
//! them. Until a strip along a fixed normal has shrunk to the target they are farther apart: a step by that time is never
//! too long (conservative advancement: B. Mirtich, 1996). The strip lies between corners. Each moves along the normal as fast
//! as it does now, and farther by a t²/2 at most, for the bound a of its acceleration; the step is the first time at which
//! a corner of one may so meet a corner of the other. A strip along an edge turns with that edge, so that the far end of a
//! needle that turns comes no nearer to what lies beside its middle. Where nothing turns, the distance is a convex function of
//! how far one has moved, and the step is Newton's.

use crate::collision::detection::closest::Closest;
use crate::collision::detection::polygon_polygon::best_face;
use crate::collision::detection::{detect_within, within};
use crate::math::{Rot, Vec2};
use crate::shape::{Hull, MAX_VERTICES, Shape};

/// Newton's method doubles the digits at each step, but where the shapes only graze it gains one bit: after
/// 40 steps the time has all the bits that `f32` has, either way. What turns may not have come near by then.
const MAX_STEPS: usize = 40;

/// What turns is near its target within this part of the width of the thinner shape, no unit: the bound of the acceleration keeps each
/// step a little short, and the steps would not end.
const TOLERANCE: f32 = 1e-3;

/// A shape that turns evenly.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Swept<'a> {
    pub(crate) shape: &'a Shape,
    /// As it begins.
    pub(crate) rotation: Rot,
    /// rad/s. What is round about its centre does not turn.
    pub(crate) spin: f32,
    /// Its centre from that about which it turns, as it begins, m.
    pub(crate) arm: Vec2,
}

impl Swept<'_> {
    /// As it is after `time`, s.
    fn rotation_after(&self, time: f32) -> Rot {
        if self.spin == 0.0 { self.rotation } else { Rot::from_angle(self.spin * time) * self.rotation }
    }

    /// How far its centre has gone round after `time`, s, m.
    fn swung_after(&self, time: f32) -> Vec2 {
        if self.spin == 0.0 || self.arm == Vec2::ZERO {
            return Vec2::ZERO;
        }
        Rot::from_angle(self.spin * time).rotate(self.arm) - self.arm
    }

    /// How fast the shape turns, rad/s: a box along the axes goes round, but does not.
    fn turn(&self) -> f32 {
        if self.shape.can_rotate() { self.spin } else { 0.0 }
    }

    /// Bound of the acceleration of its corners about what it turns about, m/s², as seen from what turns with `spin`, rad/s.
    fn most_acceleration(&self, spin: f32) -> f32 {
        let (around, turn) = (self.spin - spin, self.turn() - spin);
        around * around * self.arm.length() + turn * turn * self.shape.core_extent()
    }

    /// Its corners after `time`, s, as seen along a direction that turns with `spin`, rad/s.
    fn corners_along(&self, direction: Vec2, time: f32, spin: f32) -> CornersAlong {
        let around = (self.spin - spin) * direction.dot((self.arm + self.swung_after(time)).perp());
        let rotation = self.shape.rotation_at(self.rotation_after(time));
        let direction = rotation.unrotate(direction);
        let vertices = self.shape.core().map_or(&[Vec2::ZERO][..], |(hull, _)| hull.vertices());
        let mut corners =
            CornersAlong { behind: [0.0; MAX_VERTICES], speeds: [0.0; MAX_VERTICES], len: vertices.len() };
        let mut foremost = f32::NEG_INFINITY;
        for (index, vertex) in vertices.iter().enumerate() {
            corners.behind[index] = direction.dot(*vertex);
            corners.speeds[index] = around + (self.turn() - spin) * direction.dot(vertex.perp());
            foremost = foremost.max(corners.behind[index]);
        }
        for behind in &mut corners.behind[..vertices.len()] {
            *behind = foremost - *behind;
        }
        corners
    }
}

/// The corners of a shape, or the centre of a circle, as seen along a direction.
struct CornersAlong {
    /// By corner, how far it is behind the foremost, m, and how fast turning moves it on, m/s.
    behind: [f32; MAX_VERTICES],
    speeds: [f32; MAX_VERTICES],
    len: usize,
}

impl CornersAlong {
    fn iter(&self) -> impl Iterator<Item = (f32, f32)> {
        self.behind.into_iter().zip(self.speeds).take(self.len)
    }
}

/// When two shapes first come within `target`, m, of each other, s, if not later than `until`: the centre of b starts at
/// `offset`, m, from that of a, and what b turns about moves with `velocity`, m/s, against what a turns about. 0 where they
/// already are.
///
/// A negative target asks for an overlap of that depth. Never late: at the time returned the distance is the target or, by
/// rounding and the tolerance of what turns, a little more; more than that where 40 steps were not enough.
pub(crate) fn time_of_impact(
    a: Swept<'_>,
    b: Swept<'_>,
    offset: Vec2,
    velocity: Vec2,
    until: f32,
    target: f32,
) -> Option<f32> {
    let turns = a.spin != 0.0 || b.spin != 0.0;
    let tolerance = if turns { TOLERANCE * a.shape.width_between(b.shape) } else { 0.0 };
    let mut time = 0.0;
    for _ in 0..MAX_STEPS {
        let place = offset + velocity * time + (b.swung_after(time) - a.swung_after(time));
        let gap = gap_of(a.shape, a.rotation_after(time), b.shape, b.rotation_after(time), place)?;
        let left = gap.distance - target;
        if left <= noise_of(place) + tolerance {
            return Some(time);
        }
        // How fast the strip shrinks: the gradient of the distance is the normal.
        let approach = -gap.normal.dot(velocity);
        let step = if turns {
            let spin = match gap.edge {
                Edge::None => 0.0,
                Edge::OfA => a.turn(),
                Edge::OfB => b.turn(),
            };
            // From what a turns about to what b does, m.
            let between = place + (a.arm + a.swung_after(time)) - (b.arm + b.swung_after(time));
            let approach = approach + spin * gap.normal.dot(between.perp());
            let corners = [a.corners_along(gap.normal, time, spin), b.corners_along(-gap.normal, time, spin)];
            let rest = until - time;
            let farthest = between.length() + velocity.length() * rest;
            // Seen from what turns, what goes straight is bent: the centrifugal and the Coriolis acceleration.
            let of_centers = spin.abs() * (spin.abs() * farthest + 2.0 * velocity.length());
            let acceleration = a.most_acceleration(spin) + b.most_acceleration(spin) + of_centers;
            first_closing(left, approach, &corners, acceleration, rest)?
        } else if approach > 0.0 {
            left / approach
        } else {
            return None;
        };
        if time + step == time {
            return Some(time);
        }
        time += step;
        if !within(time, until) {
            return None;
        }
    }
    Some(time)
}

/// When a strip may first have shrunk by what is `left`, m, if within the time `rest`, s. Its sides approach each other at the speed
/// `approach`, m/s, beside the corners' own; `acceleration` bounds that of two corners against each other, m/s².
fn first_closing(
    left: f32,
    approach: f32,
    [a, b]: &[CornersAlong; 2],
    acceleration: f32,
    rest: f32,
) -> Option<f32> {
    let mut first = None;
    // Two corners that are still apart at the limit meet later: their gap is a concave function of time.
    let mut limit = rest;
    for (behind_a, speed_a) in a.iter() {
        for (behind_b, speed_b) in b.iter() {
            let (gap, speed) = (left + behind_a + behind_b, approach + speed_a + speed_b);
            if gap - limit * (speed + 0.5 * acceleration * limit) > 0.0 {
                continue;
            }
            // gap - speed t - acceleration t²/2 = 0, in the form that does not cancel.
            let root = (speed * speed + 2.0 * acceleration * gap).sqrt();
            limit = if speed >= 0.0 { 2.0 * gap / (speed + root) } else { (root - speed) / acceleration };
            first = Some(limit);
        }
    }
    first
}

/// The distance of two shapes as they begin, m, negative where they overlap.
pub(crate) fn gap_between(a: Swept<'_>, b: Swept<'_>, offset: Vec2) -> Option<f32> {
    gap_of(a.shape, a.rotation, b.shape, b.rotation, offset).map(|gap| gap.distance)
}

/// A strip between two shapes.
#[derive(Clone, Copy)]
struct Gap {
    /// Its width, m, negative where the shapes overlap.
    distance: f32,
    /// Unit vector across, from a to b.
    normal: Vec2,
    edge: Edge,
}

/// Which shape a strip turns with: that whose edge it is along, or none if it is across from corner to corner. Any will do; with the right one
/// it takes fewer steps.
#[derive(Clone, Copy)]
enum Edge {
    None,
    OfA,
    OfB,
}

fn gap_of(shape_a: &Shape, rotation_a: Rot, shape_b: &Shape, rotation_b: Rot, offset: Vec2) -> Option<Gap> {
    if let (Some((a, radius_a)), Some((b, radius_b))) = (shape_a.core(), shape_b.core()) {
        let (rotation_a, rotation_b) = (shape_a.rotation_at(rotation_a), shape_b.rotation_at(rotation_b));
        let gap = gap_of_hulls(a, rotation_a, b, rotation_b, offset);
        // A strip between the cores is narrower by the radii between what is round them.
        return Some(Gap { distance: gap.distance - (radius_a + radius_b), ..gap });
    }
    // With a circle the manifold has the exact distance. Without a margin, it is always there.
    let manifold = detect_within(shape_a, rotation_a, shape_b, rotation_b, offset, f32::INFINITY)?;
    let distance = manifold.points().first()?.separation;
    let edge = match (shape_a.core(), shape_b.core()) {
        (Some(_), None) => Edge::OfA,
        (None, Some(_)) => Edge::OfB,
        _ => Edge::None,
    };
    Some(Gap { distance, normal: manifold.normal, edge })
}

/// The widest strip between two hulls: along an edge, or across from corner to corner.
///
/// Unlike in the manifold no shape's faces are preferred, and the direction between two corners, which is vague when
/// they are near, counts only by the strip that is truly free along it: a strip is never wider than the distance, and
/// shrinks evenly, so that a step by it never goes too far.
fn gap_of_hulls(a: &Hull, rotation_a: Rot, b: &Hull, rotation_b: Rot, offset: Vec2) -> Gap {
    let rotation = rotation_a.inverse() * rotation_b;
    let center = rotation_a.unrotate(offset);
    let face_a = best_face(a, b, rotation, center);
    let face_b = best_face(b, a, rotation.inverse(), rotation.unrotate(-center));
    let mut widest = if face_b.separation > face_a.separation {
        Gap {
            distance: face_b.separation,
            normal: -rotation.rotate(b.normals[face_b.index]),
            edge: Edge::OfB,
        }
    } else {
        Gap { distance: face_a.separation, normal: a.normals[face_a.index], edge: Edge::OfA }
    };
    let noise = noise_of(center);
    // Lines, one behind the other, have no strip along an edge between them.
    let may_be_in_line = a.is_segment() && b.is_segment();
    if (widest.distance > noise || may_be_in_line)
        && let Some(Closest { normal, .. }) = Closest::find(a, b, rotation, center, noise, f32::INFINITY)
    {
        let reach_a = reach(a, normal);
        let reach_b = reach(b, rotation.unrotate(-normal));
        let across = Gap { distance: normal.dot(center) - reach_a - reach_b, normal, edge: Edge::None };
        // A corner before an edge is as far from it either way.
        if across.distance > widest.distance + noise {
            widest = across;
        }
    }
    Gap { normal: rotation_a.rotate(widest.normal), ..widest }
}

/// How far a hull reaches along `normal` from its centre, m.
fn reach(hull: &Hull, normal: Vec2) -> f32 {
    hull.vertices().iter().map(|v| normal.dot(*v)).fold(f32::NEG_INFINITY, f32::max)
}

/// Distances round by a few half epsilons of the lengths they are taken from, m.
pub(crate) fn noise_of(offset: Vec2) -> f32 {
    4.0 * f32::EPSILON * (offset.x.abs() + offset.y.abs())
}
