//! Which bodies belong together: islands, those that sleep, and those that the solver works harder on.

use rustycs::{BodyId, Tier, Vec2, World};

use crate::camera::Camera;
use crate::canvas::{Canvas, Face, Style};
use crate::overlay::legend::Legend;
use crate::overlay::{Overlay, Overlays};
use crate::run::Run;
use crate::theme::{self, Tone};

const SLEEP_MARK: Style = Style::new(Face::Strong, 11, theme::SLEEP);
const DIRECT_MARK: Style = Style::new(Face::Strong, 11, theme::PALETTE[0]);

/// Colours of bodies that take the place of those of their materials, by ascending id.
#[derive(Debug, Default)]
pub(crate) struct Paint {
    tones: Vec<(BodyId, Tone)>,
}

impl Paint {
    /// The colours of islands where they are shown, otherwise those that the scene gives.
    pub(crate) fn of(world: &World, colours: &[(BodyId, [u8; 3])], shown: Overlays) -> Self {
        let mut tones: Vec<(BodyId, Tone)> = if shown.has(Overlay::Islands) {
            world
                .islands()
                .into_iter()
                .flat_map(|island| {
                    // A body on its own is an island that needs no colour.
                    let tone = match island.len() {
                        1 => theme::ALONE,
                        _ => theme::PALETTE[island[0].to_bits() as usize % theme::PALETTE.len()],
                    };
                    island.into_iter().map(move |id| (id, tone))
                })
                .collect()
        } else {
            colours.iter().map(|&(id, [r, g, b])| (id, Tone::rgb(r, g, b))).collect()
        };
        tones.sort_unstable_by_key(|&(id, _)| id);
        Self { tones }
    }

    /// The colour of a body.
    pub(crate) fn get(&self, id: BodyId) -> Option<Tone> {
        let place = self.tones.binary_search_by_key(&id, |&(id, _)| id).ok()?;
        Some(self.tones[place].1)
    }
}

/// How many islands there are.
pub(super) fn explain_islands(canvas: &mut Canvas, world: &World, legend: &mut Legend) {
    let islands = world.islands();
    let largest = islands.iter().map(Vec::len).max().unwrap_or(0);
    let text = format!("{} islands, largest {largest}", islands.len());
    legend.swatches(canvas, &theme::PALETTE[..3], text);
}

/// A mark on every body that sleeps.
pub(super) fn draw_sleeping(canvas: &mut Canvas, run: &Run, camera: Camera, legend: &mut Legend) {
    let mut count = 0;
    for (_, body, pose) in run.bodies().filter(|(_, body, _)| body.is_sleeping()) {
        count += 1;
        if !camera.sees(body.aabb()) {
            continue;
        }
        let at = camera.to_screen(pose.center);
        let across = body.shape().thickness() * camera.scale();
        if across < 16.0 {
            canvas.batch().dot(at, (0.2 * across).clamp(1.0, 3.0), theme::SLEEP.rgba(255));
        } else {
            canvas.text_around("z", at + Vec2::new(0.0, 4.0), SLEEP_MARK);
        }
    }
    let islands = run.world.sleeping_islands();
    legend.swatches(canvas, &[theme::SLEEP], format!("{count} asleep in {islands} islands"));
}

/// A D on every body of an island whose contacts are all solved at once.
pub(super) fn draw_direct(canvas: &mut Canvas, run: &Run, camera: Camera, legend: &mut Legend) {
    for (_, body, pose) in run.bodies() {
        if body.tier() == Tier::Direct && camera.sees(body.aabb()) {
            let at = camera.to_screen(pose.center);
            canvas.text_around("D", at + Vec2::new(0.0, 4.0), DIRECT_MARK);
        }
    }
    let counters = run.world.profile().counters();
    let (bodies, direct) = (counters.direct_bodies, counters.direct_islands);
    let text = format!("{bodies} bodies in {direct} islands solved directly");
    legend.swatches(canvas, &theme::PALETTE[..1], text);
}
