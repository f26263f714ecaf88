//! Triangles, collected over a frame and handed to the graphics card a few thousand at a time.
//!
//! A draw call per body costs more than the body's triangles. Buffers are kept from frame to frame. Coordinates
//! are pixels, y downward.

use macroquad::math::{Vec2 as ScreenPoint, Vec3, Vec4};
use macroquad::models::{Mesh, Vertex, draw_mesh};
use rustycs::{Rot, Vec2};

use crate::theme;

/// Corners of triangles in one draw call, at most; indices are 16 bits wide.
pub(crate) const MOST_VERTICES: usize = 30_000;
/// Indices of triangles in one draw call, at most.
pub(crate) const MOST_INDICES: usize = 90_000;

/// A colour: red, green, blue, opacity.
pub(crate) type Rgba = [u8; 4];

/// Triangles in the order in which they cover each other.
#[derive(Default)]
pub(crate) struct Batch {
    meshes: Vec<Mesh>,
    /// Meshes in use in this frame; those beyond keep their memory for later frames.
    used: usize,
}

impl Batch {
    /// Forgets the triangles, keeps the memory.
    pub(crate) fn clear(&mut self) {
        for mesh in &mut self.meshes {
            mesh.vertices.clear();
            mesh.indices.clear();
        }
        self.used = 0;
    }

    /// Draws everything.
    pub(crate) fn draw(&self) {
        self.meshes[..self.used].iter().for_each(draw_mesh);
    }

    /// A convex polygon, filled.
    pub(crate) fn polygon(&mut self, corners: &[Vec2], color: Rgba) {
        let (mesh, first) = self.room_for(corners.len(), 3 * corners.len());
        mesh.vertices.extend(corners.iter().map(|&corner| vertex(corner, color)));
        for corner in 2..corners.len() as u16 {
            mesh.indices.extend([first, first + corner - 1, first + corner]);
        }
    }

    /// The band between two outlines of the same number of corners.
    pub(crate) fn band(&mut self, outer: &[Vec2], inner: &[Vec2], color: Rgba) {
        let count = outer.len().min(inner.len());
        let (mesh, first) = self.room_for(2 * count, 6 * count);
        for (&outside, &inside) in outer.iter().zip(inner) {
            mesh.vertices.extend([vertex(outside, color), vertex(inside, color)]);
        }
        for corner in 0..count as u16 {
            let (here, next) = (first + 2 * corner, first + 2 * ((corner + 1) % count as u16));
            mesh.indices.extend([here, next, here + 1, here + 1, next, next + 1]);
        }
    }

    /// A straight line of a width, px.
    pub(crate) fn line(&mut self, from: Vec2, to: Vec2, width: f32, color: Rgba) {
        if let Some(direction) = (to - from).normalized() {
            let side = Vec2::new(-direction.y, direction.x) * (0.5 * width);
            self.polygon(&[from + side, to + side, to - side, from - side], color);
        }
    }

    /// A box, filled.
    pub(crate) fn rectangle(&mut self, min: Vec2, max: Vec2, color: Rgba) {
        self.polygon(&rectangle_corners(min, max), color);
    }

    /// The outline of a box, inside its border.
    pub(crate) fn rectangle_outline(&mut self, min: Vec2, max: Vec2, width: f32, color: Rgba) {
        let inset = Vec2::splat(width);
        self.band(&rectangle_corners(min, max), &rectangle_corners(min + inset, max - inset), color);
    }

    /// An arrow with a head of a few pixels, which takes its length from the shaft's.
    pub(crate) fn arrow(&mut self, from: Vec2, way: Vec2, width: f32, color: Rgba) {
        const HEAD: f32 = 7.0;
        let Some(direction) = way.normalized() else { return };
        let length = way.length();
        let head = HEAD.min(length);
        let (tip, side) = (from + way, Vec2::new(-direction.y, direction.x));
        let neck = tip - direction * head;
        self.line(from, neck, width, color);
        self.polygon(&[tip, neck + side * (0.42 * head), neck - side * (0.42 * head)], color);
    }

    /// A circle as a line, px.
    pub(crate) fn ring(&mut self, center: Vec2, radius: f32, width: f32, color: Rgba) {
        const CORNERS: usize = 64;
        let turn = Rot::from_angle(core::f32::consts::TAU / CORNERS as f32);
        let mut arm = Vec2::new(1.0, 0.0);
        let directions: [Vec2; CORNERS] = core::array::from_fn(|_| {
            arm = turn.rotate(arm);
            arm
        });
        let outer = directions.map(|direction| center + direction * (radius + 0.5 * width));
        let inner = directions.map(|direction| center + direction * (radius - 0.5 * width));
        self.band(&outer, &inner, color);
    }

    /// The ground of a card: text on it hides what is beneath.
    pub(crate) fn card(&mut self, min: Vec2, max: Vec2) {
        self.rectangle(min, max, theme::PANEL.rgba(248));
        self.rectangle_outline(min, max, 1.0, theme::BORDER.rgba(255));
    }

    /// A dot of a few pixels.
    pub(crate) fn dot(&mut self, center: Vec2, radius: f32, color: Rgba) {
        const CORNERS: usize = 12;
        let turn = Rot::from_angle(core::f32::consts::TAU / CORNERS as f32);
        let mut arm = Vec2::new(radius, 0.0);
        let corners: [Vec2; CORNERS] = core::array::from_fn(|_| {
            arm = turn.rotate(arm);
            center + arm
        });
        self.polygon(&corners, color);
    }

    /// A mesh with room for so many more vertices and indices, and the index of the first of them.
    fn room_for(&mut self, vertices: usize, indices: usize) -> (&mut Mesh, u16) {
        let is_full = |mesh: &Mesh| {
            mesh.vertices.len() + vertices >= MOST_VERTICES || mesh.indices.len() + indices >= MOST_INDICES
        };
        if self.used == 0 || is_full(&self.meshes[self.used - 1]) {
            if self.used == self.meshes.len() {
                self.meshes.push(Mesh { vertices: Vec::new(), indices: Vec::new(), texture: None });
            }
            self.used += 1;
        }
        let mesh = &mut self.meshes[self.used - 1];
        let first = mesh.vertices.len() as u16;
        (mesh, first)
    }
}

fn rectangle_corners(min: Vec2, max: Vec2) -> [Vec2; 4] {
    [min, Vec2::new(max.x, min.y), max, Vec2::new(min.x, max.y)]
}

fn vertex(place: Vec2, color: Rgba) -> Vertex {
    let (position, uv) = (Vec3::new(place.x, place.y, 0.0), ScreenPoint::ZERO);
    Vertex { position, uv, color, normal: Vec4::ZERO }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn meshes_stay_within_a_draw_call_and_point_at_their_own_vertices() {
        let mut batch = Batch::default();
        for _ in 0..20_000 {
            batch.rectangle(Vec2::ZERO, Vec2::new(1.0, 1.0), [255; 4]);
        }
        assert!(batch.used > 1);
        for mesh in &batch.meshes {
            assert!(mesh.vertices.len() < MOST_VERTICES && mesh.indices.len() < MOST_INDICES);
            assert!(mesh.indices.iter().all(|&index| usize::from(index) < mesh.vertices.len()));
        }
        let triangles: usize = batch.meshes.iter().map(|mesh| mesh.indices.len() / 3).sum();
        assert_eq!(triangles, 40_000);
    }
}
