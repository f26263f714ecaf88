//! The same scenes with other materials: what a world pays for what could bounce, and mostly does not.

use rustycs_cases::chance::Chance;

use super::{Course, CourseKind};

/// Names of the scenes that are run with other materials too; on their own, nothing in them bounces.
const SCENES: [&str; 7] = ["tumbler", "washer", "smash", "pool", "pile-1k", "pile-4k", "pile-16k"];

/// Materials for all bodies of a scene.
#[derive(Clone, Copy)]
enum Materials {
    /// Those that a body has which is given none.
    Default,
    /// Each body its own.
    Random,
}

/// The scenes with each of the materials.
pub(super) fn courses(plain: &[Course]) -> Vec<Course> {
    let of_name = |name: &&str| plain.iter().find(|course| course.name == *name).expect("it is a scene");
    let with_each = |course: &Course| [Materials::Default, Materials::Random].map(|of| with(course, of));
    SCENES.iter().map(of_name).flat_map(with_each).collect()
}

fn with(plain: &Course, materials: Materials) -> Course {
    let (suffix, words) = match materials {
        Materials::Default => ("default", "with the default material: restitution 0.5, friction 0.6"),
        Materials::Random => (
            "random",
            "with a material of its own for each body: restitution 0 to 0.4, friction 0.1 to 0.9, density 0.5 to 4",
        ),
    };
    let mut scene = plain.scene.clone();
    let mut chance = Chance(5);
    for body in &mut scene.bodies {
        match materials {
            Materials::Default => (body.restitution, body.friction) = (0.5, 0.6),
            Materials::Random => {
                body.restitution = chance.between(0.0, 0.4);
                body.friction = chance.between(0.1, 0.9);
                body.density = chance.between(0.5, 4.0);
            }
        }
    }
    Course {
        name: format!("{}-{suffix}", plain.name),
        statement: format!("`{}` {words}.", plain.name),
        scene,
        kind: CourseKind::Material { of: plain.name.clone() },
        ..plain.clone()
    }
}
