//! Ghosts: contacts with what neighbours cover. A shape is met for itself first; then it is asked whether its [`Exposure`] allows
//! the normal. If not, the contact is looked for on the faces that are exposed, and there is none where none of them is in front.
//!
//! It runs where a manifold is found with a shape that neighbours cover somewhere; others cost a comparison.

use crate::collision::detection::on_face;
use crate::collision::{Corner, Manifold, ManifoldPoint, Touch};
use crate::math::{Rot, Vec2};
use crate::shape::{Exposure, Shape};

/// Two shapes as detection sees them.
#[derive(Clone, Copy)]
pub(crate) struct Placed<'a> {
    pub(crate) shapes: [&'a Shape; 2],
    pub(crate) rotations: [Rot; 2],
    /// Centre of b from that of a, m.
    pub(crate) offset: Vec2,
    /// Points farther apart than this are none, m.
    pub(crate) margin: f32,
}

impl Placed<'_> {
    /// Centre of the other of the two shapes from that of one, m.
    fn other_center(&self, side: usize) -> Vec2 {
        if side == 0 { self.offset } else { -self.offset }
    }

    /// A place of the other shape that is behind its surface, m from the centre of one, where that is met along a normal out of the one. A line
    /// has none but behind itself.
    fn inside_other(&self, side: usize, outward: Vec2) -> Vec2 {
        let other = self.shapes[1 - side];
        let behind = if matches!(other, Shape::Segment(_)) { other.extent() } else { 0.0 };
        self.other_center(side) + outward * behind
    }
}

/// The manifold that was found, or what there is in its place if it is a ghost.
pub(crate) fn without_ghosts(
    found: Manifold,
    exposures: [Option<&Exposure>; 2],
    placed: Placed<'_>,
) -> Option<Manifold> {
    let is_ghost = |manifold: &Manifold, side: usize| {
        exposures[side].is_some_and(|exposure| !is_allowed(manifold, side, exposure, placed))
    };
    let are_ghosts = [0, 1].map(|side| is_ghost(&found, side));
    if are_ghosts == [false; 2] {
        return Some(found);
    }
    // What is found for one must be no ghost of the other.
    let replacement = |side: usize| {
        let exposure = exposures[side].filter(|_| are_ghosts[side])?;
        in_place_of(&found, side, exposure, placed).filter(|manifold| !is_ghost(manifold, 1 - side))
    };
    replacement(0).or_else(|| replacement(1)).or_else(|| match are_ghosts {
        [true, false] => of_bare_corners(&found, 0, exposures[0]?, placed),
        [false, true] => of_bare_corners(&found, 1, exposures[1]?, placed),
        _ => None,
    })
}

/// What is left of a ghost of one shape that is none of the other: its normal is one of the other, and holds for the corners of the one that
/// its neighbours leave alone. The far end of a leg that comes down with its side nearly flat, the near end of which is covered.
fn of_bare_corners(
    found: &Manifold,
    side: usize,
    exposure: &Exposure,
    placed: Placed<'_>,
) -> Option<Manifold> {
    let (hull, rotation) = (placed.shapes[side].hull()?, placed.rotations[side]);
    let rotation = placed.shapes[side].rotation_at(rotation);
    found.filtered(|point| {
        let half = found.normal * (0.5 * point.separation);
        let place = if side == 0 { point.anchor_a - half } else { point.anchor_b + half };
        exposure.is_bare(hull, rotation.unrotate(place))
    })
}

/// What there is in the place of a ghost of one of the two shapes.
fn in_place_of(found: &Manifold, side: usize, exposure: &Exposure, placed: Placed<'_>) -> Option<Manifold> {
    let is_circle = placed.shapes[1 - side].core().is_none();
    let on_plane =
        if is_circle || found.is_of_corners() { of_round(found, side, exposure, placed) } else { None };
    // A circle has no corner to put onto a face.
    on_plane.or_else(|| on_exposed_face(side, exposure, placed))
}

/// Whether the exposure of one of the two shapes allows a manifold.
fn is_allowed(manifold: &Manifold, side: usize, exposure: &Exposure, placed: Placed<'_>) -> bool {
    let shape = placed.shapes[side];
    let Some(hull) = shape.hull() else { return true };
    let rotation = shape.rotation_at(placed.rotations[side]);
    let outward = if side == 0 { manifold.normal } else { -manifold.normal };
    let places =
        manifold.points().iter().map(|point| if side == 0 { point.anchor_a } else { point.anchor_b });
    let is_of_corners = manifold.is_of_corners();
    let (outward, center) =
        (rotation.unrotate(outward), rotation.unrotate(placed.inside_other(side, outward)));
    // Where the face goes on from a corner, the normal of a round corner there would turn within the step, though the ground is flat.
    if is_of_corners && exposure.face_beyond(hull, outward, center).is_some() {
        return false;
    }
    let is_exact = is_of_corners || placed.shapes[1 - side].core().is_none();
    let places = places.map(|place| rotation.unrotate(place));
    exposure.allows(hull, outward, places, center, is_exact)
}

/// The manifold with the exposed face that is the farthest out in front, of one of the two shapes, and where it is exposed.
fn on_exposed_face(side: usize, exposure: &Exposure, placed: Placed<'_>) -> Option<Manifold> {
    let Placed { shapes, rotations, margin, .. } = placed;
    let [own, other] = [side, 1 - side];
    let (hull, (other_hull, radius)) = (shapes[own].hull()?, shapes[other].core()?);
    let [rotation, other_rotation] = [own, other].map(|index| shapes[index].rotation_at(rotations[index]));
    let offset = placed.other_center(side);
    let on = |face| {
        let mut found = on_face(hull, rotation, other_hull, other_rotation, offset, face, margin + radius)?;
        if radius > 0.0 {
            found.take_off([0.0, radius]);
        }
        // Behind the plane of a face, but past its end, is beside the shape.
        let normal = found.normal;
        let found = found.filtered(|point| {
            let deepest = point.anchor_a + normal * (0.5 * point.separation);
            point.separation >= 0.0 || exposure.holds(hull, rotation.unrotate(deepest))
        })?;
        let gap = found.points().iter().map(|point| point.separation).fold(f32::INFINITY, f32::min);
        let manifold = if side == 0 { found } else { found.flipped() };
        // The points may be over a part of the face that is covered.
        is_allowed(&manifold, side, exposure, placed).then_some((gap, manifold))
    };
    let faces = (0..hull.normals().len()).filter(|&face| exposure.is_exposed(face));
    let farthest = faces.filter_map(on).max_by(|(one, _), (next, _)| one.total_cmp(next));
    farthest.map(|(_, manifold)| manifold)
}

/// The manifold with a circle or a round corner that is beyond an end of a face, over neighbours that do not fall away from it:
/// with the plane of the face. There the neighbours are as high or higher, so that nothing is held up in the air.
fn of_round(found: &Manifold, side: usize, exposure: &Exposure, placed: Placed<'_>) -> Option<Manifold> {
    let Placed { shapes, rotations, margin, .. } = placed;
    let hull = shapes[side].hull()?;
    let (round, rotation) = (shapes[1 - side], shapes[side].rotation_at(rotations[side]));
    let found = if side == 0 { *found } else { found.flipped() };
    let offset = placed.other_center(side);
    let face = exposure.face_beyond(hull, rotation.unrotate(found.normal), rotation.unrotate(offset))?;
    let normal = rotation.rotate(hull.normals[face]);
    // Farther beyond the end than it is high above the face, it may be before something else: over the hole below a plank.
    if found.normal.dot(normal) < core::f32::consts::FRAC_1_SQRT_2 {
        return None;
    }
    let (radius, point) = (round.corner_radius(), found.points().first()?);
    let is_circle = round.core().is_none();
    let center = if is_circle { offset } else { offset + found.corner_centers(point, [0.0, radius])[1] };
    let height = hull.normals[face].dot(rotation.unrotate(center)) - hull.planes[face];
    let separation = height - radius;
    // A line has no inside: what is behind it is not in it.
    if hull.is_segment() && height <= 0.0 || separation.is_nan() || separation > margin {
        return None;
    }
    let manifold = if is_circle {
        Touch::new(normal, center - normal * radius, offset, separation).manifold()
    } else {
        let anchor = center - normal * (radius + 0.5 * separation);
        let at = ManifoldPoint::new(anchor, offset, separation, point.feature);
        Manifold::of_one(normal, ManifoldPoint { corner: Corner::OfB, ..at })
    };
    Some(if side == 0 { manifold } else { manifold.flipped() })
}
