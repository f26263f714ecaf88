//! One-way floors: a body that comes from the free side is borne, any other passes.
//!
//! It is decided as the two come near, from where the body is and how it moves, and holds until they part: a body that
//! passes is not touched before it has left, and one that is borne stays so, until it slips off the end. Each contact
//! decides for itself, so that one body stands on a floor which another jumps through. A contact that passes has no points, and
//! so is none to whatever comes after: the solver, islands, sleep, events.
//!
//! It runs on contacts with a one-way floor, where manifolds are brought up to date; others cost a comparison.

use crate::body::Bodies;
use crate::collision::{Contact, Manifold, Swept, gap_between};
use crate::math::{Pose, Vec2};
use crate::shape::Shape;

/// A body is on the free side if the normal is within 60° of the direction, this being the cosine: beyond, it is at the end of
/// the floor, and would be stopped by it as by a wall.
const FREE_SIDE: f32 = 0.5;

/// The links of a chain have the whole side, up to their ends, as their neighbours go on from there; less is rounding of a normal
/// that lies along the link.
const FREE_SIDE_OF_LINK: f32 = 1e-3;

/// Along a normal this near to the direction, by its cosine, a body above the floor is there however it moves: it stands or
/// leaves. Farther off, about 8°, one that rises has not been above yet, and meets a corner.
const FACE: f32 = 0.99;

/// A body that overlaps by up to this share of the width of the thinner of the two is still on the surface, no unit: as deep
/// as a load sags before it is solved directly. Deeper, it is within the floor.
const ON_SURFACE: f32 = 0.0125;

/// A body that overlaps a link of a chain by up to this share of the width of the body, no unit, and has not come through it, is
/// before it: the middle of a triangle is a third of its height from its sides, that of all else farther.
const BEFORE_LINK: f32 = 0.25;

/// Slower along the direction, m/s, is how what stands and slides trembles: as slow as a manifold without load is kept. What is
/// about to come out of a floor is faster until it is all but at its highest point, where it is borne as well.
const STANDS_BELOW: f32 = 0.02;

/// What a contact with a one-way floor does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum OneWay {
    /// They are not near each other: it is still to be decided.
    Apart,
    /// The body came from the free side.
    Bears,
    /// The body passes, or is beside or below.
    Passes,
}

/// Decides what the contact does, and takes its points away where the body passes.
pub(super) fn decide(contact: &mut Contact, before: OneWay, bodies: &Bodies) {
    let gap = contact.manifold.points().iter().map(|point| point.separation).fold(f32::INFINITY, f32::min);
    let [a, b] = contact.colliders.map(|slot| bodies.state(slot).velocity.to_vec2());
    let bears = match before {
        _ if contact.manifold.points().is_empty() => return contact.one_way = Some(OneWay::Apart),
        // What has slid off another floor of this height came by its end, and is on the surface now.
        OneWay::Passes if gap <= 0.0 => {
            is_on_free_side(bodies, contact.colliders, &contact.manifold, b - a)
                && leans(bodies, contact.colliders, &contact.manifold)
                    .all(|Lean { up, .. }| !rises(up, b - a))
        }
        OneWay::Bears => leans(bodies, contact.colliders, &contact.manifold)
            .all(|Lean { cosine, is_over_corner, .. }| cosine > 0.0 || is_over_corner),
        _ => {
            is_on_free_side(bodies, contact.colliders, &contact.manifold, b - a) || {
                let poses = contact.colliders.map(|slot| bodies.previous_pose(slot));
                // What was put there has not come through it, however it moves now.
                let is_put = poses == contact.colliders.map(|slot| bodies.motions[slot as usize].pose);
                let moves = if is_put { Vec2::ZERO } else { b - a };
                was_before_links(bodies, contact.colliders, &contact.manifold, moves, poses)
            }
        }
    };
    if !bears {
        contact.clear();
    }
    contact.one_way = Some(if bears { OneWay::Bears } else { OneWay::Passes });
}

/// Whether two shapes with this manifold, of which the body of b moves with `velocity` against a, m/s, are on the free sides of those of
/// them that are one-way floors, or come from there.
pub(crate) fn is_on_free_side(
    bodies: &Bodies,
    colliders: [u32; 2],
    manifold: &Manifold,
    velocity: Vec2,
) -> bool {
    let gap = manifold.points().iter().map(|point| point.separation).fold(f32::INFINITY, f32::min);
    let [a, b] = colliders.map(|slot| bodies.motions[slot as usize].thickness);
    let is_outside = gap >= -ON_SURFACE * a.min(b);
    is_outside
        && leans(bodies, colliders, manifold)
            .all(|lean| lean.cosine >= FACE || lean.comes_from_before(velocity))
}

/// Whether a shape that is found to overlap a link of a chain, as fast corners do that swing into it, or what was put there, was
/// before it when both were in some poses: a link has no inside by which that shows later.
pub(crate) fn was_before_links(
    bodies: &Bodies,
    colliders: [u32; 2],
    manifold: &Manifold,
    velocity: Vec2,
    poses: [Pose; 2],
) -> bool {
    let still = |side: usize| Swept {
        shape: &bodies.shapes[colliders[side] as usize],
        rotation: poses[side].rotation,
        spin: 0.0,
        arm: Vec2::ZERO,
    };
    let offset = poses[1].center - poses[0].center;
    let [a, b] = colliders.map(|slot| bodies.motions[slot as usize].thickness);
    let Some(gap) = gap_between(still(0), still(1), offset) else { return false };
    // What was apart there has not come through it, whichever way it bounces now.
    let comes_from_before =
        |lean: &Lean| if gap > 0.0 { lean.is_before() } else { lean.comes_from_before(velocity) };
    leans(bodies, colliders, manifold)
        .all(|lean| lean.is_link && comes_from_before(&lean) && lean.up.dot(offset) > 0.0)
        && gap >= -BEFORE_LINK * a.min(b)
}

/// Least cosine between the direction of a one-way floor of this shape and the normal towards what is on its free side.
pub(crate) fn free_side_of(shape: &Shape) -> f32 {
    if shape.link().is_some() { FREE_SIDE_OF_LINK } else { FREE_SIDE }
}

/// Whether a body with this velocity, m/s, moves along the direction.
fn rises(up: Vec2, velocity: Vec2) -> bool {
    up.dot(velocity) > STANDS_BELOW
}

/// How a one-way floor leans towards what is on it.
#[derive(Clone, Copy)]
struct Lean {
    /// The cosine between its direction and the normal towards the other body.
    cosine: f32,
    /// Whether it is a link of a chain.
    is_link: bool,
    /// Up to this cosine the other body is at its end.
    least: f32,
    /// The direction in which b moves against a when the other body moves along that of the floor.
    up: Vec2,
    /// Whether the other body is over an outward corner between two links: in front of the chain, whichever of them it comes to.
    is_over_corner: bool,
}

impl Lean {
    /// Whether the other body is on the free side.
    fn is_before(&self) -> bool {
        self.is_over_corner || self.cosine >= self.least
    }

    /// Whether it comes from there, with this velocity of b against a, m/s.
    fn comes_from_before(&self, velocity: Vec2) -> bool {
        self.is_before() && (self.is_over_corner || !rises(self.up, velocity))
    }
}

/// Of each of two bodies that is a one-way floor.
fn leans<'a>(
    bodies: &'a Bodies,
    colliders: [u32; 2],
    manifold: &'a Manifold,
) -> impl Iterator<Item = Lean> + 'a {
    colliders.into_iter().zip([1.0, -1.0]).filter_map(move |(slot, sign)| {
        let direction = bodies.roles.of(slot).one_way?;
        let rotation = bodies.motions[slot as usize].pose.rotation;
        let (shape, up) = (&bodies.shapes[slot as usize], rotation.rotate(direction) * sign);
        let towards = rotation.unrotate(manifold.normal * sign);
        let is_over_corner = matches!(shape, Shape::Segment(segment) if segment.is_over_corner(towards));
        let (is_link, least) = (shape.link().is_some(), free_side_of(shape));
        Some(Lean { cosine: up.dot(manifold.normal), is_link, least, up, is_over_corner })
    })
}
