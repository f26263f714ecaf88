//! Boxes at rest on each other.

use rustycs::report::Unit;

use crate::problems::{Class, Problem, Range, Run, distance, floor, on_earth, rectangle};
use crate::scene::{BodySpec, Scene};

pub(super) fn problems() -> Vec<Problem> {
    let stacks = [10, 20, 50, 100].map(stack);
    let ratios = [1, 2, 3, 4].map(ratio);
    stacks.into_iter().chain(ratios).collect()
}

/// Boxes of 1 m with these densities, from the bottom up, and the floor.
fn pile(densities: impl Iterator<Item = f64>) -> Scene {
    let boxes = densities.enumerate().map(|(index, density)| BodySpec {
        position: [0.0, index as f64 + 0.5],
        density,
        ..rectangle(1.0, 1.0)
    });
    on_earth([floor()].into_iter().chain(boxes))
}

/// Largest distance of one of the boxes from its place during the last second, m; at most what it is when the pile
/// has fallen.
fn off_place(run: &mut Run, count: usize, fallen: f64) -> f64 {
    while run.time() < run.duration() - 1.0 {
        run.tick();
    }
    let error = |run: &Run, index: usize| distance(run.state(index).position, [0.0, index as f64 + 0.5]);
    run.largest(|run| (0..count).map(|index| error(run, index)).fold(0.0, f64::max)).min(fallen)
}

fn stack(count: usize) -> Problem {
    let height = count as f64;
    Problem {
        name: format!("stack-{count}"),
        statement: format!(
            "A stack of {count} boxes of 1 m is set up without gaps: after 9 to 10 s all are where they were set, the top \
             one at {:.1} m.",
            height - 0.5
        ),
        measure: "largest distance of a box from its place; fallen: the height",
        unit: Unit::Of("m".into()),
        class: Class::Hard,
        scene: pile(std::iter::repeat_n(1.0, count)),
        duration: 10.0,
        error: Box::new(move |run| off_place(run, count, height)),
        range: if count < 50 { Range::Full } else { Range::Short },
        goal: None,
        note: "Higher stacks are solved directly, which takes a few times as long as sweeps. The contacts of rustycs \
               yield in proportion to the length of a substep, those of the peers alike from 1/240 s (Box2D) or 1/120 s \
               (Rapier) down: with few substeps at 30 and 60 Hz ours are the softer ones.",
    }
}

fn ratio(exponent: i32) -> Problem {
    let ratio = 10.0_f64.powi(exponent);
    Problem {
        name: format!("mass-1e{exponent}"),
        statement: format!(
            "A box of 1 m and {ratio} kg is set on one of 1 kg: after 9 to 10 s both are where they were set, without \
             overlap."
        ),
        measure: "largest distance from the place / side; fallen: 1",
        unit: Unit::Part,
        class: Class::Hard,
        scene: pile([1.0, ratio].into_iter()),
        duration: 10.0,
        error: Box::new(|run| off_place(run, 2, 1.0)),
        range: Range::Full,
        goal: None,
        note: "",
    }
}
