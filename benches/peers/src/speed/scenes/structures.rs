//! What stands or falls by how loads are passed on: rustycs solves such islands directly.

use rustycs_cases::stability;

use super::{Course, CourseKind, dynamic, fixed};
use crate::scene::{BodySpec, Outline, Scene, on_earth};

/// Cases of the page of stability.
const CASES: [&str; 3] = ["card-house-5", "stack-50", "dominoes"];

pub(super) fn courses() -> Vec<Course> {
    let structure = |name: &str, statement: &str, scene| Course {
        kind: CourseKind::Structure,
        ..Course::race(name, statement, scene, 300)
    };
    let cases = stability::all();
    let of_name = |name: &&str| cases.iter().find(|case| case.name == **name).expect("it is a case");
    let of_case = |name: &&str| {
        let case = of_name(name);
        structure(name, "As on the page of stability.", case.scene.clone())
    };
    let mut courses: Vec<Course> = CASES.iter().map(of_case).collect();
    courses.push(structure("rods-50", "Fifty rods of 4 m and 10 cm, one on the other.", rods()));
    courses.push(structure("plate", "A plate of 40 m and 2.5 t on 180 balls of 3 kg.", plate()));
    courses
}

fn rods() -> Scene {
    let rod = Outline::Box { width: 4.0, height: 0.1 };
    let rods = (0..50).map(|number| dynamic(rod.clone(), [0.0, 0.1 * f64::from(number) + 0.05]));
    on_earth(std::iter::once(ground()).chain(rods))
}

fn plate() -> Scene {
    let ball = |number: i32| BodySpec {
        density: 100.0,
        ..dynamic(Outline::Circle { radius: 0.1 }, [0.22 * f64::from(number) - 19.69, 0.1])
    };
    let plate = Outline::Box { width: 40.0, height: 0.5 };
    let plate = BodySpec { density: 125.0, ..dynamic(plate, [0.0, 0.45]) };
    on_earth([ground()].into_iter().chain((0..180).map(ball)).chain([plate]))
}

fn ground() -> BodySpec {
    fixed(60.0, 2.0, [0.0, -1.0])
}
