//! Contacts: points with normals and impulses, penetration, colours of the constraint graph.

use macroquad::math::Rect;
use rustycs::{ContactRef, Point, Vec2, World};

use crate::camera::Camera;
use crate::canvas::Canvas;
use crate::overlay::legend::{Legend, Scale, WORDS};
use crate::quantity::with_unit;
use crate::theme;

/// Length of a normal, px.
const NORMAL: f32 = 9.0;
const WIDTH: f32 = 1.5;

/// Calls `draw` for every point of every contact that is in sight: place in the window, px.
fn for_each_point<'w>(
    contacts: impl Iterator<Item = ContactRef<'w>>,
    camera: Camera,
    mut draw: impl FnMut(ContactRef<'w>, usize, Vec2),
) {
    for contact in contacts {
        for (index, place) in contact.positions().enumerate() {
            let at = camera.to_screen(place);
            if camera.area().contains([at.x, at.y].into()) {
                draw(contact, index, at);
            }
        }
    }
}

/// A direction of the world in the window, where y points down.
fn flipped(direction: Vec2) -> Vec2 {
    Vec2::new(direction.x, -direction.y)
}

/// Every touching point: a short normal, and the impulses along and across it, to scale.
pub(super) fn draw_impulses(
    canvas: &mut Canvas,
    world: &World,
    camera: Camera,
    scale: &mut Scale,
    legend: &mut Legend,
) {
    let touching = || world.contacts().filter(ContactRef::is_touching);
    let points = touching().flat_map(|contact| contact.points().iter());
    scale.follow(points.map(|point| point.normal_impulse).fold(0.0, f32::max));
    let batch = canvas.batch();
    for_each_point(touching(), camera, |contact, index, at| {
        let normal = flipped(contact.normal());
        let point = contact.points()[index];
        batch.line(at, at + normal * NORMAL, 1.0, theme::MUTED.rgba(150));
        let along = normal * scale.length(point.normal_impulse);
        let across = flipped(contact.normal().perp()) * scale.length(point.tangent_impulse);
        batch.line(at, at + across, WIDTH, theme::TANGENT.rgba(220));
        batch.line(at, at + along, WIDTH, theme::CONTACT.rgba(220));
        batch.dot(at, 2.5, theme::CONTACT.rgba(255));
    });
    legend.scale(canvas, theme::CONTACT, *scale, "N s");
}

/// Every overlap as a line along the normal, its length magnified to scale; the deepest with its depth.
pub(super) fn draw_penetration(
    canvas: &mut Canvas,
    world: &World,
    camera: Camera,
    scale: &mut Scale,
    legend: &mut Legend,
) {
    let depths = world.contacts().flat_map(|contact| contact.points().iter().map(|point| -point.separation));
    scale.follow(depths.fold(0.0, f32::max));
    let mut deepest: Option<(f32, Vec2)> = None;
    let batch = canvas.batch();
    for_each_point(world.contacts(), camera, |contact, index, at| {
        let depth = -contact.points()[index].separation;
        if depth <= 0.0 {
            return;
        }
        let half = flipped(contact.normal()) * (0.5 * scale.length(depth)).max(1.0);
        let share = (depth / (2.5 * scale.unit())).min(1.0);
        let color = theme::CONTACT.mixed(theme::DEEP, share).rgba(255);
        batch.line(at - half, at + half, 3.0, color);
        if deepest.is_none_or(|(most, _)| depth > most) {
            deepest = Some((depth, at));
        }
    });
    if let Some((depth, at)) = deepest {
        batch.ring(at, 13.0, 1.5, theme::DEEP.rgba(255));
        // To the side on which there is room.
        let area = camera.area();
        let text = with_unit(f64::from(depth), "m");
        let width = canvas.width_of(&text, WORDS) + 18.0;
        let left = if at.x + width > area.x + area.w { at.x - width } else { at.x + 18.0 };
        legend.reserve(Rect::new(left - 5.0, at.y - 9.0, width, 18.0));
        canvas.tag(text, Vec2::new(left, at.y + 4.0), WORDS.toned(theme::TEXT));
    }
    legend.scale(canvas, theme::DEEP, *scale, "m deep");
}

/// Every contact in the colour of the constraint graph that it is solved in, as a line between the two centres.
/// Contacts of one colour share no body that moves.
pub(super) fn draw_colours(canvas: &mut Canvas, world: &World, camera: Camera, legend: &mut Legend) {
    let batch = canvas.batch();
    for contact in world.contacts() {
        let Some(colour) = contact.colour() else { continue };
        let center = |id| world.body(id).map(|body| body.pose().center);
        let (Some(a), Some(b)) = (center(contact.a()), center(contact.b())) else { continue };
        let tone = theme::PALETTE[colour as usize % theme::PALETTE.len()];
        for place in contact.positions() {
            let [a, at, b] = [near(a, place), place, near(b, place)].map(|place| camera.to_screen(place));
            batch.line(a, at, WIDTH, tone.rgba(210));
            batch.line(at, b, WIDTH, tone.rgba(210));
            batch.dot(at, 3.0, tone.rgba(255));
        }
    }
    let used = world.profile().counters().colours;
    let tones = &theme::PALETTE[..used.min(theme::PALETTE.len())];
    legend.swatches(canvas, tones, format!("{used} colours"));
}

/// The centre of a body, or the way toward it where it is far: the middle of a long floor is nowhere near.
fn near(center: Point, place: Point) -> Point {
    const FAR: f32 = 0.7;
    let away = center - place;
    match away.normalized() {
        Some(direction) if away.length() > FAR => place + direction * FAR,
        _ => center,
    }
}
