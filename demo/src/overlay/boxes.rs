//! Bounding boxes, and the tree that the broad phase sorts them into.

use rustycs::{Aabb, World};

use crate::batch::{Batch, Rgba};
use crate::camera::Camera;
use crate::theme;

/// Width of lines, px.
const HAIRLINE: f32 = 1.0;

/// The box of every body, and the fat box that the broad phase keeps around it.
pub(super) fn draw_boxes(batch: &mut Batch, world: &World, camera: Camera) {
    for (aabb, _, _) in world.tree_boxes().into_iter().filter(|&(_, _, is_leaf)| is_leaf) {
        draw_box(batch, aabb, camera, theme::FAT_BOX.rgba(170));
    }
    for (_, body) in world.bodies() {
        draw_box(batch, body.aabb(), camera, theme::BODY_BOX.rgba(170));
    }
}

/// The boxes of the tree that hold others: the deeper, the paler. What lies deeper is drawn first, so that the
/// outer boxes stay whole.
pub(super) fn draw_tree(batch: &mut Batch, world: &World, camera: Camera) {
    let mut inner: Vec<(u32, Aabb)> = world
        .tree_boxes()
        .into_iter()
        .filter(|&(_, _, is_leaf)| !is_leaf)
        .map(|(aabb, depth, _)| (depth, aabb))
        .collect();
    inner.sort_by_key(|&(depth, _)| core::cmp::Reverse(depth));
    for (depth, aabb) in inner {
        let share = (depth as f32 / 10.0).min(1.0);
        let tone = theme::TREE.mixed(theme::FAT_BOX, share);
        draw_box(batch, aabb, camera, tone.rgba((230.0 - 150.0 * share) as u8));
    }
}

fn draw_box(batch: &mut Batch, aabb: Aabb, camera: Camera, color: Rgba) {
    if camera.sees(aabb) {
        let (min, max) = camera.corners(aabb);
        batch.rectangle_outline(min, max, HAIRLINE, color);
    }
}
