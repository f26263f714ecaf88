//! A world as an SVG picture: one user unit is a metre, drawn on the same palette as the window.

use std::fmt::{self, Write};

use rustycs::{BodyRef, Vec2, World};
use rustycs_scenes::View;

use crate::theme::{self, BodyStyle};

/// Height of the scene, pixels, where a viewer does not scale the picture.
const HEIGHT: f32 = 720.0;
/// Height of the strip below it that holds the caption, pixels.
const CAPTION: f32 = 40.0;

/// The picture of what `view` shows of a world, with a caption.
pub(crate) fn picture(world: &World, view: View, caption: &str) -> String {
    let mut picture = String::new();
    write_picture(&mut picture, world, view, caption).expect("writing to a string does not fail");
    picture
}

fn write_picture(out: &mut String, world: &World, view: View, caption: &str) -> fmt::Result {
    let View { center, width, height } = view;
    // SVG counts y downward: the world's y is written with its sign changed.
    let (left, top) = (center.x - 0.5 * width, -center.y - 0.5 * height);
    let pixel = height / HEIGHT;
    let whole = height + CAPTION * pixel;
    writeln!(
        out,
        r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="{left} {top} {width} {whole}" width="{:.0}" height="{:.0}">"#,
        width / pixel,
        whole / pixel
    )?;
    writeln!(out, "<title>{caption}</title>")?;
    writeln!(
        out,
        r#"<rect x="{left}" y="{top}" width="{width}" height="{height}" fill="{}"/>"#,
        theme::BACKGROUND
    )?;
    write_grid(out, view, pixel)?;
    writeln!(out, r#"<g stroke-width="{:.4}" stroke-linejoin="round">"#, 1.4 * pixel)?;
    let mut bodies: Vec<(BodyStyle, BodyRef<'_>)> =
        world.bodies().map(|(_, body)| (theme::style_of(&body, None), body)).collect();
    // Bodies of one style share their attributes.
    bodies.sort_by_key(|(style, _)| style.fill.rgba(255));
    for group in bodies.chunk_by(|(one, _), (other, _)| one == other) {
        let BodyStyle { fill, outline } = group[0].0;
        writeln!(out, r#"<g fill="{fill}" stroke="{outline}">"#)?;
        for (_, body) in group {
            write_body(out, body)?;
        }
        writeln!(out, "</g>")?;
    }
    writeln!(out, "</g>")?;
    let bottom = top + height;
    writeln!(
        out,
        r#"<rect x="{left}" y="{bottom}" width="{width}" height="{:.3}" fill="{}"/>"#,
        // Beyond the edge, so that rounding leaves no gap there.
        2.0 * CAPTION * pixel,
        theme::PANEL
    )?;
    writeln!(
        out,
        r#"<text x="{:.3}" y="{:.3}" font-family="Inter, system-ui, sans-serif" font-size="{:.3}" fill="{}">{caption}</text>"#,
        left + 16.0 * pixel,
        bottom + 25.0 * pixel,
        14.0 * pixel,
        theme::MUTED
    )?;
    writeln!(out, "</svg>")
}

/// A line every metre.
fn write_grid(out: &mut String, view: View, pixel: f32) -> fmt::Result {
    let half = Vec2::new(0.5 * view.width, 0.5 * view.height);
    let (min, max) = (view.center - half, view.center + half);
    write!(out, r#"<path fill="none" stroke="{}" stroke-width="{pixel:.4}" d=""#, theme::GRID)?;
    for x in (min.x.ceil() as i32)..=(max.x.floor() as i32) {
        write!(out, "M{x} {:.2}V{:.2}", -min.y, -max.y)?;
    }
    for y in (min.y.ceil() as i32)..=(max.y.floor() as i32) {
        write!(out, "M{:.2} {}H{:.2}", min.x, -y, max.x)?;
    }
    writeln!(out, r#""/>"#)
}

/// A body: a circle with the radius that shows how it is turned, or a polygon.
fn write_body(out: &mut String, body: &BodyRef<'_>) -> fmt::Result {
    let pose = body.pose();
    if let Some(radius) = body.shape().radius() {
        let (center, rim) = (pose.center, pose.to_world(Vec2::new(radius, 0.0)));
        return writeln!(
            out,
            r#"<circle cx="{:.3}" cy="{:.3}" r="{radius:.3}"/><path d="M{:.3} {:.3}L{:.3} {:.3}"/>"#,
            center.x, -center.y, center.x, -center.y, rim.x, -rim.y
        );
    }
    out.write_str(r#"<path d=""#)?;
    for (index, &vertex) in body.shape().vertices().iter().enumerate() {
        let corner = pose.to_world(vertex);
        write!(out, "{}{:.3} {:.3}", if index == 0 { 'M' } else { 'L' }, corner.x, -corner.y)?;
    }
    writeln!(out, r#"Z"/>"#)
}

#[cfg(test)]
mod tests {
    use super::*;
    use rustycs::Settings;

    #[test]
    fn a_picture_shows_every_body_once() {
        let scene = rustycs_scenes::find("bounce").unwrap();
        let world = scene.build(1, Settings::default());
        let picture = picture(&world, scene.view, "bounce");
        assert!(picture.starts_with("<svg ") && picture.ends_with("</svg>\n"));
        assert_eq!(picture.matches("<circle ").count(), 9);
        assert_eq!(picture.matches("Z\"/>").count(), 9);
        assert_eq!(picture.matches("<g ").count(), picture.matches("</g>").count());
    }
}
