//! A card about the body under the mouse.

use macroquad::math::Rect;
use rustycs::{BodyId, BodyType, Vec2, World};

use crate::canvas::{Canvas, Face, Style};
use crate::quantity::{with_unit, without_prefix};
use crate::theme;

const TITLE: Style = Style::new(Face::Strong, 14, theme::TEXT);
const WORDS: Style = Style::new(Face::Regular, 13, theme::MUTED);
const FIGURE: Style = Style::new(Face::Mono, 12, theme::TEXT);

const WIDTH: f32 = 250.0;
const LINE: f32 = 19.0;

/// What there is to say about a body: a title, then words with figures.
pub(crate) fn rows(world: &World, id: BodyId, name: Option<&str>) -> Option<Vec<(&'static str, String)>> {
    let body = world.body(id)?;
    let [x, y] = body.position_f64();
    let velocity = body.velocity();
    let kind = match body.body_type() {
        BodyType::Dynamic => "dynamic",
        BodyType::Fixed => "fixed",
        BodyType::Kinematic => "kinematic",
    };
    let touching =
        world.contacts().filter(|contact| contact.is_touching() && (contact.a() == id || contact.b() == id));
    let material = body.material();
    let named = theme::MATERIALS.iter().find(|(other, ..)| other.density == material.density);
    let is_compound = body.colliders().nth(1).is_some();
    let shape = if is_compound { "several shapes" } else { crate::overlay::shape_name(body.shape()) };
    let state = if body.is_sleeping() { "asleep" } else { kind };
    let finite = |value: f32, unit| {
        if value.is_finite() { without_prefix(f64::from(value), unit) } else { "infinite".to_owned() }
    };
    Some(vec![
        (shape, name.map_or_else(|| state.to_owned(), |name| format!("{name}, {state}"))),
        ("position", format!("{x:.3}, {y:.3} m")),
        ("angle", format!("{:.3} rad", body.angle())),
        ("velocity", format!("{:.3}, {:.3} m/s", velocity.x, velocity.y)),
        ("speed", with_unit(f64::from(velocity.length()), "m/s")),
        ("spin", with_unit(f64::from(body.angular_velocity()), "rad/s")),
        ("mass", finite(body.mass(), "kg")),
        ("inertia", finite(body.inertia(), "kg m²")),
        ("material", named.map_or("own", |(_, name, _)| name).to_owned()),
        ("density", without_prefix(f64::from(material.density), "kg/m²")),
        ("friction", format!("{:.2}", material.friction)),
        ("restitution", format!("{:.2}", material.restitution)),
        ("contacts", touching.count().to_string()),
    ])
}

/// Draws the card beside the mouse, within an area.
pub(crate) fn draw(canvas: &mut Canvas, area: Rect, mouse: Vec2, rows: &[(&'static str, String)]) {
    let size = Vec2::new(WIDTH, 20.0 + LINE * rows.len() as f32);
    // Where there is no room to the right of the mouse, to its left.
    let left = if mouse.x + 20.0 + size.x <= area.right() { mouse.x + 20.0 } else { mouse.x - 20.0 - size.x };
    let top = (mouse.y + 20.0).min(area.bottom() - size.y - 8.0).max(area.y + 8.0);
    let min = Vec2::new(left.max(area.x + 8.0).round(), top.round());
    canvas.batch().card(min, min + size);
    for (line, (word, figure)) in rows.iter().enumerate() {
        let y = min.y + 22.0 + LINE * line as f32;
        let (words, style) = if line == 0 { (TITLE, TITLE) } else { (WORDS, FIGURE) };
        canvas.text(*word, Vec2::new(min.x + 14.0, y), words);
        let room = size.x - 40.0 - canvas.width_of(word, words);
        let figure = canvas.fitting(figure, room, style);
        canvas.text_up_to(figure, Vec2::new(min.x + size.x - 14.0, y), style);
    }
}
