//! Joints: from the centres of the bodies to the anchors, in the colour of the force; and how far they are off.

use rustycs::{JointKind, JointRef, Point, Vec2, World};

use crate::camera::Camera;
use crate::canvas::Canvas;
use crate::overlay::legend::{Legend, Scale};
use crate::quantity::with_unit;
use crate::theme;

/// Every joint that acts: a ring at each anchor, and lines to the centres of its bodies, the redder the more it bears.
pub(super) fn draw_joints(
    canvas: &mut Canvas,
    world: &World,
    camera: Camera,
    scale: &mut Scale,
    legend: &mut Legend,
) {
    let acting = || world.joints().map(|(_, joint)| joint).filter(JointRef::is_enabled);
    scale.follow(acting().map(|joint| joint.force().length()).fold(0.0, f32::max));
    let batch = canvas.batch();
    for joint in acting() {
        let share =
            if scale.unit() > 0.0 { (joint.force().length() / (2.5 * scale.unit())).min(1.0) } else { 0.0 };
        let color = theme::JOINT.mixed(theme::DEEP, share).rgba(220);
        let [a, b] = joint.anchors().map(|place| camera.to_screen(place));
        let center = |id| world.body(id).map(|body| camera.to_screen(body.pose().center));
        for (body, anchor) in [(Some(joint.body_a()), a), (joint.body_b(), b)] {
            if let Some(center) = body.and_then(center) {
                batch.line(center, anchor, 1.5, color);
            }
            batch.ring(anchor, 4.0, 1.5, color);
        }
        for [from, to] in lines(&joint, camera) {
            batch.line(from, to, 1.5, color);
        }
    }
    let gap = acting().map(|joint| joint.error().distance).fold(0.0, f32::max);
    let text = format!("{} joints, largest gap {}", world.joint_count(), with_unit(f64::from(gap), "m"));
    legend.swatches(canvas, &[theme::JOINT], text);
    let text = format!("red from {} on", with_unit(f64::from(2.5 * scale.unit()), "N"));
    legend.swatches(canvas, &[theme::DEEP], text);
}

/// From one anchor to the other; of a pulley by way of its wheels.
pub(crate) fn places(joint: &JointRef<'_>) -> impl Iterator<Item = [Point; 2]> + use<> {
    let [a, b] = joint.anchors();
    let ends = joint.wheels().map_or([a, b, b, b], |[wheel_a, wheel_b]| [a, wheel_a, wheel_b, b]);
    let count = if joint.wheels().is_some() { 3 } else { 1 };
    (0..count).map(move |number| [ends[number], ends[number + 1]])
}

/// The same on the screen.
fn lines(joint: &JointRef<'_>, camera: Camera) -> impl Iterator<Item = [Vec2; 2]> + use<> {
    places(joint).map(move |ends| ends.map(|place| camera.to_screen(place)))
}

/// What there is of a joint to see where nothing is laid over the scene: rods, ropes and springs, and pins.
pub(super) fn draw_parts(canvas: &mut Canvas, world: &World, camera: Camera) {
    let batch = canvas.batch();
    for (_, joint) in world.joints() {
        let [a, b] = joint.anchors().map(|place| camera.to_screen(place));
        let area = camera.area();
        let mut ends = lines(&joint, camera).flatten();
        if !ends.any(|at: Vec2| area.contains([at.x, at.y].into())) {
            continue;
        }
        match joint.kind() {
            JointKind::Distance => batch.line(a, b, 2.0, theme::JOINT.rgba(200)),
            JointKind::Pulley => {
                for [from, to] in lines(&joint, camera) {
                    batch.line(from, to, 2.0, theme::JOINT.rgba(200));
                }
            }
            JointKind::Revolute | JointKind::Wheel => batch.dot(b, 2.0, theme::JOINT.rgba(200)),
            _ => {}
        }
    }
}
