//! Two copies of a scene side by side: what each is set to, and how far each is from perfect.

use macroquad::math::Rect;
use rustycs::{BodyType, Vec2, World};

use crate::canvas::{Canvas, Face, Style};
use crate::knob;
use crate::quantity::{milliseconds, with_unit};
use crate::run::Run;
use crate::theme;

const TITLE: Style = Style::new(Face::Strong, 14, theme::TEXT);
const WORDS: Style = Style::new(Face::Regular, 12, theme::MUTED);
const FIGURE: Style = Style::new(Face::Mono, 12, theme::TEXT);

/// Width of a caption, and room around it, px.
const WIDTH: f32 = 224.0;
const MARGIN: f32 = 8.0;
/// Height of a caption of no lines, and of a line, px.
const HEAD: f32 = 38.0;
const LINE: f32 = 17.0;
/// Part of the height of a scene that captions take at most.
const SHARE: f32 = 0.3;

/// Lines of a caption in a scene of a height, px: all six, or the first of them.
fn lines(scene_height: f32) -> usize {
    (((SHARE * scene_height - 2.0 * MARGIN - HEAD) / LINE) as usize).clamp(1, 6)
}

fn height(lines: usize) -> f32 {
    HEAD + LINE * lines as f32
}

/// Height that is left for a caption above each copy, px.
pub(crate) fn room_for_caption(scene_height: f32) -> f32 {
    height(lines(scene_height)) + 2.0 * MARGIN
}

/// A caption above each copy, and a line between the copies.
pub(crate) fn draw_captions(canvas: &mut Canvas, runs: &[Run], areas: &[Rect], chosen: usize) {
    let lines = lines(areas[0].bottom());
    for (copy, (run, area)) in runs.iter().zip(areas).enumerate() {
        if copy > 0 {
            let top = Vec2::new(area.x - 1.0, 0.0);
            canvas.batch().rectangle(top, Vec2::new(area.x + 1.0, area.bottom()), theme::BORDER.rgba(255));
        }
        let width = WIDTH.min(area.w - 2.0 * MARGIN);
        let min = Vec2::new((area.center().x - 0.5 * width).round(), MARGIN);
        canvas.batch().card(min, min + Vec2::new(width, height(lines)));
        if copy == chosen {
            let max = min + Vec2::new(width, 2.0);
            canvas.batch().rectangle(min, max, theme::ACCENT.rgba(255));
        }
        let settings = run.world.settings();
        let name = ["A", "B"][copy.min(1)];
        let scheme = knob::scheme_name(settings);
        let title = format!("{name}   {scheme}, {} × {}", settings.substeps, settings.iterations);
        let title = canvas.fitting(&title, width - 16.0, TITLE);
        canvas.text(title, min + Vec2::new(12.0, 24.0), TITLE);
        let other = &runs[runs.len() - 1 - copy].world;
        for (line, (word, figure)) in rows(run, other).into_iter().take(lines).enumerate() {
            let y = min.y + 46.0 + LINE * line as f32;
            canvas.text(word, Vec2::new(min.x + 12.0, y), WORDS);
            canvas.text_up_to(figure, Vec2::new(min.x + width - 12.0, y), FIGURE);
        }
    }
}

fn rows(run: &Run, other: &World) -> [(&'static str, String); 6] {
    let error = run.world.error();
    let gained = run.world.energy() - run.gauges.first_energy.unwrap_or_else(|| run.world.energy());
    [
        ("penetration", with_unit(f64::from(error.penetration), "m")),
        ("deepest so far", with_unit(run.gauges.deepest, "m")),
        ("residual", with_unit(f64::from(error.velocity_residual), "m/s")),
        ("energy gained", with_unit(gained, "J")),
        ("apart (rms)", with_unit(distance(&run.world, other), "m")),
        ("step", milliseconds(run.gauges.step)),
    ]
}

/// How far bodies are from their twins in the other world: root of the mean square, m.
fn distance(world: &World, other: &World) -> f64 {
    let mut sum = 0.0;
    let mut count = 0.0;
    for (id, body) in world.bodies().filter(|(_, body)| body.body_type() != BodyType::Fixed) {
        if let Some(twin) = other.body(id) {
            let apart = body.pose().center - twin.pose().center;
            sum += f64::from(apart.length_squared());
            count += 1.0;
        }
    }
    (sum / f64::max(count, 1.0)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn captions_leave_most_of_a_scene() {
        assert_eq!([lines(720.0), lines(390.0), lines(200.0)], [6, 3, 1]);
        assert!([720.0, 480.0, 390.0].iter().all(|height| room_for_caption(*height) <= SHARE * height + 1.0));
    }
}
