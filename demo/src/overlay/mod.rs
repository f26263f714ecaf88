//! What can be drawn over a scene to show what the engine does.
//!
//! | file | overlays |
//! |---|---|
//! | `boxes` | bounding boxes, tree of the broad phase |
//! | `contacts` | contact points with impulses, penetration, colours of the constraint graph |
//! | `motion` | velocity and spin, centres of mass, trails |
//! | `joints` | joints, by what they bear |
//! | `groups` | islands, sleeping bodies, what is solved directly |
//! | `words` | names, grid with units, energy and momentum |
//! | `legend` | what lengths mean |

mod boxes;
mod contacts;
mod groups;
pub(crate) mod joints;
mod legend;
mod motion;
mod words;

use macroquad::input::KeyCode;
use macroquad::math::Rect;

use crate::camera::Camera;
use crate::canvas::Canvas;
use crate::overlay::legend::{Legend, Scales};
use crate::run::Run;

pub(crate) use groups::Paint;
pub(crate) use words::{draw_names, draw_sums, shape_name};

/// Something that can be drawn over a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Overlay {
    Boxes,
    Tree,
    Contacts,
    Penetration,
    Velocity,
    Centres,
    Islands,
    Colours,
    Sleeping,
    Direct,
    Names,
    Grid,
    Trails,
    Sums,
    Joints,
}

impl Overlay {
    /// Every overlay, in the order in which they are listed.
    pub(crate) const ALL: [Self; 15] = [
        Self::Boxes,
        Self::Tree,
        Self::Contacts,
        Self::Penetration,
        Self::Velocity,
        Self::Centres,
        Self::Islands,
        Self::Colours,
        Self::Sleeping,
        Self::Direct,
        Self::Names,
        Self::Grid,
        Self::Trails,
        Self::Sums,
        Self::Joints,
    ];

    /// Short name, as typed on a command line.
    pub(crate) fn name(self) -> &'static str {
        self.row().0
    }

    /// What it shows.
    pub(crate) fn meaning(self) -> &'static str {
        self.row().1
    }

    /// The key that switches it, and how that is written.
    pub(crate) fn key(self) -> (KeyCode, &'static str) {
        let (_, _, key, letter) = self.row();
        (key, letter)
    }

    fn row(self) -> (&'static str, &'static str, KeyCode, &'static str) {
        match self {
            Self::Boxes => ("boxes", "Bounding boxes", KeyCode::B, "B"),
            Self::Tree => ("tree", "Broad-phase tree", KeyCode::T, "T"),
            Self::Contacts => ("contacts", "Contacts, impulses", KeyCode::C, "C"),
            Self::Penetration => ("penetration", "Penetration", KeyCode::D, "D"),
            Self::Velocity => ("velocity", "Velocity, spin", KeyCode::V, "V"),
            Self::Centres => ("centres", "Centres of mass", KeyCode::M, "M"),
            Self::Islands => ("islands", "Islands", KeyCode::I, "I"),
            Self::Colours => ("colours", "Graph colours", KeyCode::O, "O"),
            Self::Sleeping => ("sleeping", "Sleeping bodies", KeyCode::Z, "Z"),
            Self::Direct => ("direct", "Solved directly", KeyCode::F6, "F6"),
            Self::Names => ("names", "Names", KeyCode::L, "L"),
            Self::Grid => ("grid", "Grid with units", KeyCode::G, "G"),
            Self::Trails => ("trails", "Trails", KeyCode::J, "J"),
            Self::Sums => ("sums", "Energy, momentum", KeyCode::E, "E"),
            Self::Joints => ("joints", "Joints, forces", KeyCode::F7, "F7"),
        }
    }
}

/// Which overlays are shown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Overlays {
    bits: u16,
}

impl Overlays {
    pub(crate) fn of(overlays: impl IntoIterator<Item = Overlay>) -> Self {
        let bits = overlays.into_iter().fold(0, |bits, overlay| bits | 1 << overlay as u16);
        Self { bits }
    }

    /// What a scene is about.
    pub(crate) fn of_scene(scene: &rustycs_scenes::Scene) -> Self {
        let names = Some(Overlay::Names).filter(|_| scene.is_about_names);
        let trails = Some(Overlay::Trails).filter(|_| scene.is_about_paths);
        Self::of(names.into_iter().chain(trails))
    }

    pub(crate) fn with(self, other: Self) -> Self {
        Self { bits: self.bits | other.bits }
    }

    pub(crate) fn without(self, other: Self) -> Self {
        Self { bits: self.bits & !other.bits }
    }

    pub(crate) fn has(self, overlay: Overlay) -> bool {
        self.bits & (1 << overlay as u16) != 0
    }

    pub(crate) fn toggle(&mut self, overlay: Overlay) {
        self.bits ^= 1 << overlay as u16;
    }

    /// The names of those shown, or a dash.
    pub(crate) fn names(self) -> String {
        let shown: Vec<&str> =
            Overlay::ALL.into_iter().filter(|&overlay| self.has(overlay)).map(Overlay::name).collect();
        if shown.is_empty() { "-".to_owned() } else { shown.join(",") }
    }
}

/// Draws overlays; keeps their scales from frame to frame, so that lengths do not dance.
#[derive(Debug, Default)]
pub(crate) struct Drawer {
    scales: Scales,
}

impl Drawer {
    /// What lies beneath the bodies.
    pub(crate) fn draw_below(canvas: &mut Canvas, run: &Run, shown: Overlays, camera: Camera) {
        if shown.has(Overlay::Grid) {
            words::draw_axes(canvas, camera);
        }
        if shown.has(Overlay::Trails) {
            motion::draw_trails(canvas.batch(), run, camera);
        }
    }

    /// What lies over the bodies; returns where there are words.
    pub(crate) fn draw_above(
        &mut self,
        canvas: &mut Canvas,
        run: &Run,
        shown: Overlays,
        camera: Camera,
    ) -> Vec<Rect> {
        let mut legend = Legend::new(camera, shown.has(Overlay::Grid));
        joints::draw_parts(canvas, &run.world, camera);
        if shown.has(Overlay::Joints) {
            joints::draw_joints(canvas, &run.world, camera, &mut self.scales.force, &mut legend);
        }
        if shown.has(Overlay::Tree) {
            boxes::draw_tree(canvas.batch(), &run.world, camera);
        }
        if shown.has(Overlay::Boxes) {
            boxes::draw_boxes(canvas.batch(), &run.world, camera);
        }
        if shown.has(Overlay::Colours) {
            contacts::draw_colours(canvas, &run.world, camera, &mut legend);
        }
        if shown.has(Overlay::Contacts) {
            let scale = &mut self.scales.impulse;
            contacts::draw_impulses(canvas, &run.world, camera, scale, &mut legend);
        }
        if shown.has(Overlay::Penetration) {
            let scale = &mut self.scales.depth;
            contacts::draw_penetration(canvas, &run.world, camera, scale, &mut legend);
        }
        if shown.has(Overlay::Centres) {
            motion::draw_centres(canvas.batch(), run, camera);
        }
        if shown.has(Overlay::Velocity) {
            motion::draw_velocities(canvas, run, camera, &mut self.scales.speed, &mut legend);
        }
        if shown.has(Overlay::Islands) {
            groups::explain_islands(canvas, &run.world, &mut legend);
        }
        if shown.has(Overlay::Sleeping) {
            groups::draw_sleeping(canvas, run, camera, &mut legend);
        }
        if shown.has(Overlay::Direct) {
            groups::draw_direct(canvas, run, camera, &mut legend);
        }
        legend.places()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_keys_are_distinct() {
        for (index, overlay) in Overlay::ALL.into_iter().enumerate() {
            assert_eq!(overlay as usize, index);
            for other in &Overlay::ALL[..index] {
                assert!(overlay.name() != other.name() && overlay.key().0 != other.key().0);
            }
        }
    }

    #[test]
    fn overlays_are_switched_one_by_one() {
        let mut shown = Overlays::of([Overlay::Boxes, Overlay::Sums]);
        assert_eq!(shown.names(), "boxes,sums");
        shown.toggle(Overlay::Boxes);
        assert!(!shown.has(Overlay::Boxes) && shown.has(Overlay::Sums));
    }
}
