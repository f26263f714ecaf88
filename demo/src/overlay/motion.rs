//! How bodies move: velocity and spin, centres of mass, trails.

use rustycs::math::trig::sin_cos;
use rustycs::{BodyType, Vec2};

use crate::batch::Batch;
use crate::camera::Camera;
use crate::canvas::Canvas;
use crate::overlay::legend::{LENGTH, Legend, Scale};
use crate::run::Run;
use crate::theme;

/// Radius of the arc that shows a spin, px.
const ARC: f32 = 11.0;
/// Spin whose arc is as long as the line in the legend, rad/s.
const ARC_SPIN: f32 = 20.0;
/// Time whose turn the arc shows, s.
const ARC_TIME: f32 = LENGTH / (ARC * ARC_SPIN);
/// Slower than this is not drawn, m/s and rad/s.
const STILL: f32 = 1e-3;

/// The velocity of every body as an arrow, to scale, and its spin as the arc that it turns by in about a fifth
/// of a second.
pub(super) fn draw_velocities(
    canvas: &mut Canvas,
    run: &Run,
    camera: Camera,
    scale: &mut Scale,
    legend: &mut Legend,
) {
    let speeds = run.world.bodies().map(|(_, body)| body.velocity().length());
    let fastest = speeds.filter(|speed| *speed > STILL).fold(0.0, f32::max);
    scale.follow(fastest);
    let batch = canvas.batch();
    for (_, body, pose) in run.bodies().filter(|(_, body, _)| body.body_type() != BodyType::Fixed) {
        let at = camera.to_screen(pose.center);
        if !camera.area().contains([at.x, at.y].into()) {
            continue;
        }
        let velocity = body.velocity();
        if let Some(direction) = velocity.normalized().filter(|_| velocity.length() > STILL) {
            let length = scale.length(velocity.length());
            batch.arrow(at, Vec2::new(direction.x, -direction.y) * length, 1.5, theme::VELOCITY.rgba(230));
        }
        if body.angular_velocity().abs() > STILL {
            draw_spin(batch, at, body.angular_velocity());
        }
    }
    legend.scale(canvas, theme::VELOCITY, *scale, "m/s");
    legend.scale(canvas, theme::SPIN, Scale::fixed(ARC_SPIN), "rad/s");
}

/// An arc from the right of a place, counter-clockwise for a positive spin, with a head.
fn draw_spin(batch: &mut Batch, at: Vec2, spin: f32) {
    const PIECES: usize = 14;
    let turn = (spin * ARC_TIME).clamp(-5.5, 5.5);
    let place = |share: f32| {
        let (sin, cos) = sin_cos(turn * share);
        at + Vec2::new(cos, -sin) * ARC
    };
    let color = theme::SPIN.rgba(230);
    let mut from = place(0.0);
    for piece in 1..PIECES {
        let to = place(piece as f32 / PIECES as f32);
        batch.line(from, to, 1.5, color);
        from = to;
    }
    let end = place(1.0);
    if let Some(along) = (end - from).normalized() {
        batch.arrow(end - along * 5.0, along * 5.0, 1.5, color);
    }
}

/// The centre of mass of every body that moves, as a disc in quarters.
pub(super) fn draw_centres(batch: &mut Batch, run: &Run, camera: Camera) {
    const RADIUS: f32 = 4.5;
    for (_, body, pose) in run.bodies().filter(|(_, body, _)| body.body_type() != BodyType::Fixed) {
        if !camera.sees(body.aabb()) {
            continue;
        }
        let at = camera.to_screen(pose.center);
        batch.dot(at, RADIUS, theme::TEXT.rgba(255));
        let inner = RADIUS - 1.0;
        let dark = theme::BACKGROUND.rgba(255);
        for (x, y) in [(1.0, 1.0), (-1.0, -1.0)] {
            let (side, up) = (Vec2::new(x * inner, 0.0), Vec2::new(0.0, y * inner));
            batch.polygon(&[at, at + side, at + (side + up) * 0.7, at + up], dark);
        }
    }
}

/// Where bodies have been, fading with age.
pub(super) fn draw_trails(batch: &mut Batch, run: &Run, camera: Camera) {
    run.trails.pieces(|from, to, age| {
        let (from, to) = (camera.to_screen(from), camera.to_screen(to));
        let area = camera.area();
        if area.contains([from.x, from.y].into()) || area.contains([to.x, to.y].into()) {
            batch.line(from, to, 1.5, theme::TRAIL.rgba((190.0 * (1.0 - age)) as u8));
        }
    });
}
