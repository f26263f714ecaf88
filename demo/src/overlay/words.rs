//! Names, the grid with units, energy and momentum.

use macroquad::math::Rect;
use rustycs::{BodyId, Shape, Vec2, World};

use crate::camera::Camera;
use crate::canvas::{Canvas, Face, Style};
use crate::quantity::{with_unit, without_prefix};
use crate::run::Run;
use crate::scenery::grid_pitch;
use crate::theme;

const NAME: Style = Style::new(Face::Regular, 12, theme::TEXT);
const FIGURE: Style = Style::new(Face::Mono, 12, theme::MUTED);
const WORDS: Style = Style::new(Face::Regular, 12, theme::MUTED);

/// Names in sight at most: more could not be read.
const MOST_NAMES: usize = 160;

/// The name of every body that the scene names. A name that would lie on another, or on other words that have `taken`
/// a place, is left out.
pub(crate) fn draw_names(
    canvas: &mut Canvas,
    run: &Run,
    labels: &[(BodyId, &'static str)],
    camera: Camera,
    mut taken: Vec<Rect>,
) {
    let area = camera.area();
    if labels.is_empty() {
        let left = area.x + 20.0;
        canvas.tag("Nothing has a name in this scene.", Vec2::new(left, area.bottom() - 12.0), WORDS);
    }
    for (id, body, pose) in run.bodies() {
        let Some(&(_, name)) = labels.iter().find(|(named, _)| *named == id) else { continue };
        let reach = (body.shape().extent() * camera.scale()).min(60.0);
        let place = camera.to_screen(pose.center) + Vec2::new(0.0, -reach - 6.0);
        let width = canvas.width_of(name, NAME);
        let space = Rect::new(place.x - 0.5 * width - 5.0, place.y - 12.0, width + 10.0, 17.0);
        let is_free = taken.iter().all(|other| !other.overlaps(&space));
        let is_inside = space.x >= area.x && space.right() <= area.right() && space.y >= area.y + 64.0;
        if is_free && is_inside && space.bottom() <= area.bottom() {
            canvas.tag(name, Vec2::new(place.x - 0.5 * width, place.y), NAME);
            taken.push(space);
        }
        if taken.len() == MOST_NAMES {
            return;
        }
    }
}

/// What a shape is called.
pub(crate) fn shape_name(shape: &Shape) -> &'static str {
    match shape {
        Shape::Circle(_) => "circle",
        Shape::Aabb(_) => "upright box",
        Shape::Obb(_) => "box",
        Shape::Polygon(_) => "polygon",
        Shape::Rounded(rounded) if rounded.is_capsule() => "capsule",
        Shape::Rounded(_) => "rounded polygon",
        Shape::Segment(_) => "segment",
        _ => "shape",
    }
}

/// The axes of the world, and the coordinates of the lines of the grid along the lower and the left border.
pub(super) fn draw_axes(canvas: &mut Canvas, camera: Camera) {
    let Rect { x, y, w, h } = camera.area();
    let (low, high) = (camera.to_world(Vec2::new(x, y + h)), camera.to_world(Vec2::new(x + w, y)));
    let origin = camera.to_screen([0.0, 0.0].into());
    let (axis, line) = (theme::AXIS.rgba(255), theme::GRID_STRONG.rgba(255));
    // A figure needs room: every line that is a multiple of this has one.
    let pitch = [1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0]
        .map(|multiple| multiple * grid_pitch(camera.scale()))
        .into_iter()
        .find(|pitch| pitch * f64::from(camera.scale()) >= 72.0)
        .unwrap_or(1.0);
    let lines = |from: f64, to: f64| ((from / pitch).ceil() as i64)..=((to / pitch).floor() as i64);
    for index in lines(low.x, high.x) {
        let value = index as f64 * pitch;
        let at = camera.to_screen([value, 0.0].into()).x.round();
        let color = if index == 0 { axis } else { line };
        canvas.batch().rectangle(Vec2::new(at, y), Vec2::new(at + 1.0, y + h), color);
        if at > x + 60.0 && at < x + w - 30.0 {
            canvas.text_around(coordinate(value, pitch), Vec2::new(at, y + h - 8.0), FIGURE);
        }
    }
    for index in lines(low.y, high.y) {
        let value = index as f64 * pitch;
        let at = camera.to_screen([0.0, value].into()).y.round();
        let color = if index == 0 { axis } else { line };
        canvas.batch().rectangle(Vec2::new(x, at), Vec2::new(x + w, at + 1.0), color);
        if at > y + 56.0 && at < y + h - 30.0 {
            canvas.text(coordinate(value, pitch), Vec2::new(x + 8.0, at - 4.0), FIGURE);
        }
    }
    canvas.text("m", Vec2::new(x + 8.0, y + h - 8.0), FIGURE);
    canvas.batch().dot(origin, 2.5, axis);
}

/// A coordinate with as many decimals as its grid needs.
fn coordinate(value: f64, pitch: f64) -> String {
    let decimals = (0..6).find(|&decimals| pitch * 10_f64.powi(decimals) >= 0.999).unwrap_or(6) as usize;
    format!("{value:.decimals$}")
}

/// Energy and momentum of all bodies, on a card whose upper right corner is at a place, px.
pub(crate) fn draw_sums(canvas: &mut Canvas, world: &World, corner: Vec2) {
    const SIZE: Vec2 = Vec2::new(248.0, 146.0);
    let min = corner - Vec2::new(SIZE.x, 0.0);
    canvas.batch().card(min, min + SIZE);
    let momentum = world.momentum();
    let rows = [
        ("kinetic", with_unit(world.kinetic_energy(), "J")),
        ("potential", with_unit(world.potential_energy(), "J")),
        ("energy", with_unit(world.energy(), "J")),
        ("momentum x", without_prefix(f64::from(momentum.x), "kg m/s")),
        ("momentum y", without_prefix(f64::from(momentum.y), "kg m/s")),
        ("angular", without_prefix(world.angular_momentum(), "kg m²/s")),
    ];
    for (index, (word, figure)) in rows.into_iter().enumerate() {
        let y = min.y + 25.0 + 21.0 * index as f32;
        canvas.text(word, Vec2::new(min.x + 14.0, y), WORDS);
        canvas.text_up_to(figure, Vec2::new(min.x + SIZE.x - 14.0, y), FIGURE.toned(theme::TEXT));
    }
}
