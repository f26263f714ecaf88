//! The world as triangles: grid and bodies.

use macroquad::math::Rect;
use rustycs::{Attractor, BodyRef, ColliderRef, Pose, Rot, Shape, Vec2, World};

use crate::batch::Batch;
use crate::camera::Camera;
use crate::overlay::Paint;
use crate::run::Run;
use crate::theme::{self, BodyStyle};

/// Width of outlines, px.
const OUTLINE: f32 = 1.5;
/// Width of lines of the grid, px.
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
    pub(crate) fn draw_bodies(&mut self, batch: &mut Batch, run: &Run, paint: &Paint, camera: Camera) {
        for (id, body, pose) in run.bodies() {
            let is_seen = |collider: ColliderRef<'_>| {
                camera.sees(collider.shape().bounding_box(collider.pose_on(pose)))
            };
            if !body.colliders().any(is_seen) {
                continue;
            }
            let style = theme::style_of(&body, paint.get(id));
            if body.colliders().nth(1).is_none() {
                self.draw_shape(batch, body.shape(), pose, style, camera);
            } else {
                self.draw_compound(batch, &body, pose, style, camera);
            }
        }
    }

    /// A body of several shapes, with one outline around all of them. Sensors are left away.
    fn draw_compound(
        &mut self,
        batch: &mut Batch,
        body: &BodyRef<'_>,
        pose: Pose,
        BodyStyle { fill, outline }: BodyStyle,
        camera: Camera,
    ) {
        let solid = || body.colliders().filter(|collider| !collider.is_sensor());
        for collider in solid() {
            self.trace(collider.shape(), collider.pose_on(pose), camera);
            batch.polygon(&self.outer, outline.rgba(255));
        }
        for collider in solid().filter(|part| part.shape().thickness() * camera.scale() >= 3.0 * OUTLINE) {
            self.trace(collider.shape(), collider.pose_on(pose), camera);
            batch.polygon(&self.inner, fill.rgba(255));
        }
    }

    /// A shape. Its outline is what shows of its border where a smaller copy, in the colour of the filling, lies
    /// on it: two polygons, which is less than a polygon and a band around it.
    pub(crate) fn draw_shape(
        &mut self,
        batch: &mut Batch,
        shape: &Shape,
        pose: Pose,
        style: BodyStyle,
        camera: Camera,
    ) {
        let BodyStyle { fill, outline } = style;
        if let Shape::Segment(segment) = shape {
            let [from, to] = [0, 1].map(|end| camera.to_screen(pose.to_world(segment.vertices()[end])));
            return batch.line(from, to, OUTLINE, outline.rgba(255));
        }
        self.trace(shape, pose, camera);
        batch.polygon(&self.outer, outline.rgba(255));
        if shape.thickness() * camera.scale() < 3.0 * OUTLINE {
            return;
        }
        batch.polygon(&self.inner, fill.rgba(255));
        if let Some(radius) = shape.radius() {
            let rim = pose.to_world(Vec2::new(radius, 0.0));
            batch.line(camera.to_screen(pose.center), camera.to_screen(rim), OUTLINE, outline.rgba(255));
        }
    }

    /// Puts the outline of a shape into `outer`, px, and what lies within it into `inner`.
    fn trace(&mut self, shape: &Shape, pose: Pose, camera: Camera) {
        self.outer.clear();
        let Some(radius) = shape.radius() else {
            let place = |at: Vec2| camera.to_screen(pose.to_world(at));
            match shape {
                Shape::Rounded(rounded) => self.outer.extend(rounded.outline().map(place)),
                _ => self.outer.extend(shape.vertices().iter().copied().map(place)),
            }
            inset(&self.outer, OUTLINE, &mut self.inner);
            return;
        };
        self.inner.clear();
        let radius = radius * camera.scale();
        let share = (1.0 - OUTLINE / radius).max(0.0);
        // The middle of a side is r (1 - cos(π / n)) ≈ 5 r / n² inside the circle: an eighth of a pixel here.
        let corners = (40.0 * radius).sqrt().clamp(8.0, 128.0) as usize;
        let turn = Rot::from_angle(core::f32::consts::TAU / corners as f32);
        let center = camera.to_screen(pose.center);
        let mut arm = Vec2::new(radius, 0.0);
        for _ in 0..corners {
            arm = turn.rotate(arm);
            self.outer.push(center + arm);
            self.inner.push(center + arm * share);
        }
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

/// Every attractor as a small star, and the ring within which a local one pulls.
pub(crate) fn draw_attractors(batch: &mut Batch, world: &World, camera: Camera) {
    for (_, attractor) in world.attractors() {
        draw_attractor(batch, attractor, camera);
    }
}

pub(crate) fn draw_attractor(batch: &mut Batch, attractor: &Attractor, camera: Camera) {
    let at = camera.to_screen(attractor.position());
    let color = theme::ATTRACTOR.rgba(230);
    if let Some(range) = attractor.range() {
        batch.ring(at, range * camera.scale(), HAIRLINE, theme::ATTRACTOR.rgba(110));
    }
    for arm in [[1.0, 0.0], [0.0, 1.0], [0.7, 0.7], [0.7, -0.7]].map(Vec2::from) {
        batch.line(at - arm * 8.0, at + arm * 8.0, 1.5, color);
    }
    batch.dot(at, 3.5, color);
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
