//! The scenes: large ones as engines race on them, piles that grow, and such as people have.

mod everyday;
mod materials;
mod piles;
mod structures;
mod turning;

use crate::scene::{BodySpec, Kind, Outline, Scene};

/// A scene, and how long it is run.
#[derive(Clone)]
pub(crate) struct Course {
    /// In lower case, without spaces.
    pub(crate) name: String,
    pub(crate) statement: String,
    pub(crate) scene: Scene,
    /// What all kinematic bodies are parts of.
    pub(crate) drum: Option<Drum>,
    /// Ticks before those that are timed: 1, in which tables are made, or as many as it takes to fall asleep.
    pub(crate) warm_up: u32,
    /// Ticks that are timed.
    pub(crate) ticks: u32,
    pub(crate) kind: CourseKind,
    /// Whether it is left out of quick runs.
    pub(crate) is_dear: bool,
}

/// What kind of scene it is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum CourseKind {
    /// One of those that engines race on.
    Race,
    /// One of a row that grows.
    Size,
    /// One as people have.
    Everyday,
    /// One that stands or falls by how loads are passed on.
    Structure,
    /// Another one with other materials.
    Material {
        /// Its name.
        of: String,
    },
}

impl Course {
    fn race(name: &str, statement: &str, scene: Scene, ticks: u32) -> Self {
        Self {
            name: name.into(),
            statement: statement.into(),
            scene,
            drum: None,
            warm_up: 1,
            ticks,
            kind: CourseKind::Race,
            is_dear: false,
        }
    }
}

/// Kinematic bodies that go round an axis together. Before each step they are told the velocity that brings them to
/// their next place, in all engines alike: not every engine has bodies of several shapes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Drum {
    /// m.
    pub(crate) axis: [f64; 2],
    /// rad/s, counter-clockwise.
    pub(crate) spin: f64,
}

impl Drum {
    /// The place of a part after so many seconds, m.
    pub(crate) fn place(&self, start: [f64; 2], seconds: f64) -> [f64; 2] {
        let (sin, cos) = (self.spin * seconds).sin_cos();
        let [x, y] = [start[0] - self.axis[0], start[1] - self.axis[1]];
        [self.axis[0] + cos * x - sin * y, self.axis[1] + sin * x + cos * y]
    }

    /// A part that lies like this at the start.
    fn part(&self, outline: Outline, position: [f64; 2], angle: f64) -> BodySpec {
        BodySpec { position, angle, spin: self.spin, ..BodySpec::new(Kind::Kinematic, outline) }
    }
}

/// All scenes, in the order of the page.
pub(crate) fn all() -> Vec<Course> {
    let mut all = piles::races();
    all.extend(turning::races());
    all.extend(piles::sizes());
    all.extend(everyday::courses());
    all.extend(structures::courses());
    let materials = materials::courses(&all);
    all.extend(materials);
    all
}

/// The pile of so many bodies alone, without the memory that all scenes take.
pub(crate) fn pile(count: usize) -> Scene {
    piles::mixed_pile(count)
}

fn dynamic(outline: Outline, position: [f64; 2]) -> BodySpec {
    BodySpec { position, ..BodySpec::new(Kind::Dynamic, outline) }
}

fn fixed(width: f64, height: f64, position: [f64; 2]) -> BodySpec {
    BodySpec { position, ..BodySpec::new(Kind::Fixed, Outline::Box { width, height }) }
}

fn square(side: f64) -> Outline {
    Outline::Box { width: side, height: side }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_unique_and_scenes_have_bodies_that_move() {
        let all = all();
        for (index, course) in all.iter().enumerate() {
            assert!(all[..index].iter().all(|other| other.name != course.name), "{}", course.name);
            assert!(course.scene.bodies.iter().any(|body| body.kind == Kind::Dynamic), "{}", course.name);
            let turns = course.scene.bodies.iter().any(|body| body.kind == Kind::Kinematic);
            assert_eq!(turns, course.drum.is_some(), "{}", course.name);
        }
    }
}
