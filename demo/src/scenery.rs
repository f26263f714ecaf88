//! The world as triangles: grid, bodies, contacts, boxes.

use macroquad::math::Rect;
use rustycs::{Aabb, ContactRef, Pose, Rot, Shape, Vec2, World};

use crate::batch::Batch;
use crate::camera::Camera;
use crate::poses::Poses;
use crate::theme::{self, BodyStyle};

/// Width of outlines, px.
const OUTLINE: f32 = 1.5;
/// Width of lines of the grid and of boxes, px.
const HAIRLINE: f32 = 1.0;

/// Draws worlds; keeps the memory for outlines from body to body.
#[derive(Debug, Default)]
pub(crate) struct Scenery {
    outer: Vec<Vec2>,
    inner: Vec<Vec2>,
}

impl Scenery {
    /// Every body that is in sight, with an outline that lies inside its border: bodies that touch do not hide
    /// each other's.
    pub(crate) fn draw_bodies(&mut self, batch: &mut Batch, world: &World, poses: &Poses, camera: Camera) {
        for (body, pose) in poses.bodies(world) {
            let shape = body.shape();
            if !is_in_sight(camera, shape.bounding_box(pose)) {
                continue;
            }
            let BodyStyle { fill, outline } = theme::style_of(&body);
            let across = shape.thickness() * camera.scale();
            self.trace(shape, pose, camera);
            if across < 3.0 * OUTLINE {
                batch.polygon(&self.outer, outline.rgba(255));
                continue;
            }
            inset(&self.outer, OUTLINE, &mut self.inner);
            batch.polygon(&self.inner, fill.rgba(255));
            batch.band(&self.outer, &self.inner, outline.rgba(255));
            if let Some(radius) = shape.radius() {
                let rim = pose.to_world(Vec2::new(radius, 0.0));
                batch.line(camera.to_screen(pose.center), camera.to_screen(rim), OUTLINE, outline.rgba(255));
            }
        }
    }

    /// Puts the outline of a shape into `outer`, px: circles with as many corners as it takes to look round.
    fn trace(&mut self, shape: &Shape, pose: Pose, camera: Camera) {
        self.outer.clear();
        let Some(radius) = shape.radius() else {
            self.outer.extend(shape.vertices().iter().map(|&at| camera.to_screen(pose.to_world(at))));
            return;
        };
        let radius = radius * camera.scale();
        // The middle of a side is r (1 - cos(π / n)) ≈ 5 r / n² inside the circle: a tenth of a pixel here.
        let corners = (50.0 * radius).sqrt().clamp(12.0, 128.0) as usize;
        let turn = Rot::from_angle(core::f32::consts::TAU / corners as f32);
        let center = camera.to_screen(pose.center);
        let mut arm = Vec2::new(radius, 0.0);
        self.outer.extend((0..corners).map(|_| {
            arm = turn.rotate(arm);
            center + arm
        }));
    }
}

/// The outline moved inward by a width, px, whichever way round it goes. A corner moves along its bisector, by
/// at most four widths where it is sharp.
fn inset(outline: &[Vec2], width: f32, inner: &mut Vec<Vec2>) {
    inner.clear();
    let count = outline.len();
    let at = |index: usize| outline[index % count];
    // Twice the area, positive where the corners go one way round, negative the other way.
    let area: f32 = (1..count - 1).map(|i| (at(i) - at(0)).cross(at(i + 1) - at(0))).sum();
    let side = if area > 0.0 { 1.0 } else { -1.0 };
    let inward = |from: Vec2, to: Vec2| {
        (to - from).normalized().map_or(Vec2::ZERO, |along| Vec2::new(-along.y, along.x) * side)
    };
    inner.extend((0..count).map(|index| {
        let (before, here, next) = (at(index + count - 1), at(index), at(index + 1));
        let (one, other) = (inward(before, here), inward(here, next));
        here + (one + other) * (width / (1.0 + one.dot(other)).max(0.125))
    }));
}

/// A line at every metre, a stronger one at every tenth; further apart where they would be dense.
pub(crate) fn draw_grid(batch: &mut Batch, camera: Camera) {
    let Rect { x, y, w, h } = camera.area();
    let (low, high) = (camera.to_world(Vec2::new(x, y + h)), camera.to_world(Vec2::new(x + w, y)));
    let pitch = grid_pitch(camera.scale());
    let lines = |from: f64, to: f64| ((from / pitch).ceil() as i64)..=((to / pitch).floor() as i64);
    for strong in [false, true] {
        let color = if strong { theme::GRID_STRONG } else { theme::GRID }.rgba(255);
        let is_wanted = |line: &i64| (line % 10 == 0) == strong;
        for line in lines(low.x, high.x).filter(is_wanted) {
            let at = camera.to_screen([line as f64 * pitch, 0.0].into()).x.round();
            batch.rectangle(Vec2::new(at, y), Vec2::new(at + HAIRLINE, y + h), color);
        }
        for line in lines(low.y, high.y).filter(is_wanted) {
            let at = camera.to_screen([0.0, line as f64 * pitch].into()).y.round();
            batch.rectangle(Vec2::new(x, at), Vec2::new(x + w, at + HAIRLINE), color);
        }
    }
}

/// Distance between lines of the grid, m: a power of ten that is 16 px or more at this scale, px/m.
pub(crate) fn grid_pitch(scale: f32) -> f64 {
    let mut pitch = 0.001;
    while pitch * f64::from(scale) < 16.0 {
        pitch *= 10.0;
    }
    pitch
}

/// Length of the normal at a contact with an impulse of 1 N s, px, and its limit.
const NORMAL_LENGTH: [f32; 2] = [100.0, 80.0];

/// Every touching point with its normal. The line grows with the square root of the impulse, so that the
/// lightest contact and the one that carries the pile are both seen.
pub(crate) fn draw_contacts(batch: &mut Batch, world: &World, camera: Camera) {
    let color = theme::CONTACT.rgba(255);
    for contact in world.contacts().filter(ContactRef::is_touching) {
        let normal = Vec2::new(contact.normal().x, -contact.normal().y);
        for (place, point) in contact.positions().zip(contact.points()) {
            let at = camera.to_screen(place);
            if !camera.area().contains([at.x, at.y].into()) {
                continue;
            }
            let length = NORMAL_LENGTH[0] * point.normal_impulse.max(0.0).sqrt();
            batch.line(at, at + normal * length.min(NORMAL_LENGTH[1]), OUTLINE, theme::CONTACT.rgba(200));
            batch.dot(at, 2.5, color);
        }
    }
}

/// The box of every body, and the fat box that the broad phase keeps around it.
pub(crate) fn draw_boxes(batch: &mut Batch, world: &World, camera: Camera) {
    for (aabb, _, _) in world.tree_boxes().into_iter().filter(|&(_, _, is_leaf)| is_leaf) {
        draw_box(batch, aabb, camera, theme::FAT_BOX.rgba(170));
    }
    for (_, body) in world.bodies() {
        draw_box(batch, body.aabb(), camera, theme::BODY_BOX.rgba(170));
    }
}

fn draw_box(batch: &mut Batch, aabb: Aabb, camera: Camera, color: [u8; 4]) {
    if is_in_sight(camera, aabb) {
        let (min, max) = corners_on_screen(camera, aabb);
        batch.rectangle_outline(min, max, HAIRLINE, color);
    }
}

/// The corners of a box, px: the upper left one and the lower right one.
fn corners_on_screen(camera: Camera, aabb: Aabb) -> (Vec2, Vec2) {
    let (low, high) = (camera.to_screen(aabb.min.into()), camera.to_screen(aabb.max.into()));
    (Vec2::new(low.x, high.y), Vec2::new(high.x, low.y))
}

fn is_in_sight(camera: Camera, aabb: Aabb) -> bool {
    let (min, max) = corners_on_screen(camera, aabb);
    let Rect { x, y, w, h } = camera.area();
    min.x <= x + w && max.x >= x && min.y <= y + h && max.y >= y
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_outline_moves_inward_whichever_way_round_it_goes() {
        let mut square = [[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0]].map(Vec2::from);
        let mut inner = Vec::new();
        inset(&square, 1.0, &mut inner);
        assert_eq!(inner, [[1.0, 1.0], [9.0, 1.0], [9.0, 9.0], [1.0, 9.0]].map(Vec2::from));
        square.reverse();
        inset(&square, 1.0, &mut inner);
        assert_eq!(inner, [[1.0, 9.0], [9.0, 9.0], [9.0, 1.0], [1.0, 1.0]].map(Vec2::from));
    }

    #[test]
    fn lines_of_the_grid_keep_their_distance() {
        for scale in [0.5, 3.0, 16.0, 47.0, 900.0, 50_000.0] {
            let pixels = grid_pitch(scale) * f64::from(scale);
            assert!((16.0..=160.1).contains(&pixels), "{pixels} px at {scale} px/m");
        }
    }
}
