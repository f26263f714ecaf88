//! A world as an SVG picture, drawn on the same palette as the window.

use std::fmt::{self, Write};

use rustycs::{BodyRef, JointKind, Pose, Shape, Vec2, World};
use rustycs_scenes::{Scene, View};

use crate::overlay::{Overlays, Paint, joints};
use crate::theme::{self, BodyStyle};

/// Height of the scene, px, and width at least.
const HEIGHT: f32 = 720.0;
const LEAST_WIDTH: f32 = 480.0;
/// Height of the strip below it that holds the caption, px.
const CAPTION: f32 = 40.0;

/// The picture of what a scene shows of its world, with a caption.
pub(crate) fn picture(world: &World, scene: &Scene, caption: &str) -> String {
    let mut picture = String::new();
    write_picture(&mut picture, world, scene, caption).expect("writing to a string does not fail");
    picture
}

fn write_picture(out: &mut String, world: &World, scene: &Scene, caption: &str) -> fmt::Result {
    let view = scene.view;
    // Pixels of a metre. The scene is drawn in metres with y upward, the rest in pixels.
    let scale = (HEIGHT / view.height).max(LEAST_WIDTH / view.width);
    let (width, height) = (scale * view.width, scale * view.height);
    let whole = height + CAPTION;
    writeln!(
        out,
        r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:.0} {whole:.0}" width="{width:.0}" height="{whole:.0}">"#
    )?;
    writeln!(out, "<title>{caption}</title>")?;
    writeln!(out, r#"<rect width="100%" height="100%" fill="{}"/>"#, theme::BACKGROUND)?;
    let (x, y) = (0.5 * width - scale * view.center.x, 0.5 * height + scale * view.center.y);
    writeln!(out, r#"<g transform="translate({x:.3} {y:.3}) scale({scale:.5} -{scale:.5})">"#)?;
    write_grid(out, view, 1.0 / scale)?;
    writeln!(out, r#"<g stroke-width="{:.5}" stroke-linejoin="round">"#, 1.4 / scale)?;
    write_bodies(out, world, scene)?;
    writeln!(out, "</g>")?;
    write_joints(out, world, 1.0 / scale)?;
    for (_, attractor) in world.attractors() {
        let at = attractor.position();
        writeln!(
            out,
            r#"<circle cx="{:.4}" cy="{:.4}" r="{:.5}" fill="{}"/>"#,
            at.x,
            at.y,
            5.0 / scale,
            theme::ATTRACTOR
        )?;
    }
    writeln!(out, "</g>")?;
    writeln!(out, r#"<rect y="{height:.0}" width="100%" height="{CAPTION}" fill="{}"/>"#, theme::PANEL)?;
    writeln!(
        out,
        r#"<text x="16" y="{:.0}" font-family="Inter, system-ui, sans-serif" font-size="14" fill="{}">{caption}</text>"#,
        height + 25.0,
        theme::MUTED
    )?;
    writeln!(out, "</svg>")
}

/// Bodies in the colours that the window gives them; those of one style share their attributes.
fn write_bodies(out: &mut String, world: &World, scene: &Scene) -> fmt::Result {
    let paint = Paint::of(world, &scene.colours(world), Overlays::default());
    let mut bodies: Vec<(BodyStyle, BodyRef<'_>)> =
        world.bodies().map(|(id, body)| (theme::style_of(&body, paint.get(id)), body)).collect();
    bodies.sort_by_key(|(style, _)| [style.fill.rgba(255), style.outline.rgba(255)]);
    for group in bodies.chunk_by(|(one, _), (other, _)| one == other) {
        let BodyStyle { fill, outline } = group[0].0;
        writeln!(out, r#"<g fill="{fill}" stroke="{outline}">"#)?;
        for (_, body) in group {
            for collider in body.colliders() {
                write_shape(out, collider.shape(), collider.pose())?;
            }
        }
        writeln!(out, "</g>")?;
    }
    Ok(())
}

/// Rods, ropes and springs, and pins, as the window shows them.
fn write_joints(out: &mut String, world: &World, pixel: f32) -> fmt::Result {
    writeln!(out, r#"<g stroke="{0}" fill="{0}" stroke-width="{1:.5}">"#, theme::JOINT, 2.0 * pixel)?;
    for (_, joint) in world.joints() {
        match joint.kind() {
            JointKind::Distance | JointKind::Pulley => {
                for [from, to] in joints::places(&joint) {
                    writeln!(out, r#"<path d="M{:.3} {:.3}L{:.3} {:.3}"/>"#, from.x, from.y, to.x, to.y)?;
                }
            }
            JointKind::Revolute | JointKind::Wheel => {
                let [_, at] = joint.anchors();
                let radius = 2.0 * pixel;
                writeln!(
                    out,
                    r#"<circle cx="{:.3}" cy="{:.3}" r="{radius:.5}" stroke="none"/>"#,
                    at.x, at.y
                )?;
            }
            _ => {}
        }
    }
    writeln!(out, "</g>")
}

/// A line every metre.
fn write_grid(out: &mut String, view: View, pixel: f32) -> fmt::Result {
    let half = Vec2::new(0.5 * view.width, 0.5 * view.height);
    let (min, max) = (view.center - half, view.center + half);
    write!(out, r#"<path fill="none" stroke="{}" stroke-width="{pixel:.5}" d=""#, theme::GRID)?;
    for x in (min.x.ceil() as i32)..=(max.x.floor() as i32) {
        write!(out, "M{x} {:.2}V{:.2}", min.y, max.y)?;
    }
    for y in (min.y.ceil() as i32)..=(max.y.floor() as i32) {
        write!(out, "M{:.2} {y}H{:.2}", min.x, max.x)?;
    }
    writeln!(out, r#""/>"#)
}

/// A shape: a circle with the radius that shows how it is turned, or a polygon.
fn write_shape(out: &mut String, shape: &Shape, pose: Pose) -> fmt::Result {
    if let Some(radius) = shape.radius() {
        let (center, rim) = (pose.center, pose.to_world(Vec2::new(radius, 0.0)));
        return writeln!(
            out,
            r#"<circle cx="{:.3}" cy="{:.3}" r="{radius:.3}"/><path d="M{:.3} {:.3}L{:.3} {:.3}"/>"#,
            center.x, center.y, center.x, center.y, rim.x, rim.y
        );
    }
    out.write_str(r#"<path d=""#)?;
    let mut write_corner = |(index, vertex): (usize, Vec2)| {
        let corner = pose.to_world(vertex);
        write!(out, "{}{:.3} {:.3}", if index == 0 { 'M' } else { 'L' }, corner.x, corner.y)
    };
    match shape {
        Shape::Rounded(rounded) => rounded.outline().enumerate().try_for_each(&mut write_corner)?,
        _ => shape.vertices().iter().copied().enumerate().try_for_each(&mut write_corner)?,
    }
    writeln!(out, r#"Z"/>"#)
}

#[cfg(test)]
mod tests {
    use super::*;
    use rustycs::Settings;

    /// Two ropes of three lines each.
    #[test]
    fn a_picture_shows_ropes_by_way_of_their_wheels() {
        let scene = rustycs_scenes::find("elevator").unwrap();
        let world = scene.build(1, Settings::default());
        let picture = picture(&world, scene, "elevator");
        let joints = picture.split("<g ").last().unwrap();
        assert_eq!(joints.matches("<path ").count(), 6);
        assert_eq!(picture.matches("<g ").count(), picture.matches("</g>").count());
    }

    #[test]
    fn a_picture_shows_every_body_once() {
        let scene = rustycs_scenes::find("bounce").unwrap();
        let world = scene.build(1, Settings::default());
        let picture = picture(&world, scene, "bounce");
        assert!(picture.starts_with("<svg ") && picture.ends_with("</svg>\n"));
        assert_eq!(picture.matches("<circle ").count(), 9);
        assert_eq!(picture.matches("Z\"/>").count(), 9);
        assert_eq!(picture.matches("<g ").count(), picture.matches("</g>").count());
    }
}
