//! Problems whose outcome is known: by a closed form, or by integrating their equation in `f64` until it no longer
//! changes.

mod bounces;
mod collisions;
mod flight;
mod friction;
mod orbits;
mod rolling;
mod run;
mod stacks;
mod toppling;

use rustycs::report::Unit;

use crate::scene::{G, Scene, block, disc, floor, on_earth, rectangle};

pub(crate) use run::{Run, ticks};

/// A scene, and how far a run of it is from the truth.
pub(crate) struct Problem {
    /// In lower case, without spaces.
    pub(crate) name: String,
    /// What happens, and the closed form of it.
    pub(crate) statement: String,
    /// What the error is, as an axis says it.
    pub(crate) measure: &'static str,
    /// How errors are written.
    pub(crate) unit: Unit,
    pub(crate) class: Class,
    /// What stands firm comes first, then what moves on it, as people build scenes: of two faces that fit equally well,
    /// engines take that of the body that was there first.
    pub(crate) scene: Scene,
    /// s; a whole number of thirtieths.
    pub(crate) duration: f64,
    /// Runs the scene and returns its error.
    pub(crate) error: Box<dyn Fn(&mut Run) -> f64>,
    pub(crate) range: Range,
    /// The error at default settings that we hold ourselves to, whatever the peers have.
    pub(crate) goal: Option<f64>,
    /// What the figures do not say by themselves: why we fall short here, where we do. May be empty.
    pub(crate) note: &'static str,
}

/// What kind of problem it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Class {
    /// Nothing is sudden but a start or a stop: errors should fall with the square of the step.
    Smooth,
    /// Decided in moments.
    Impact,
    /// Rest under load, and what `f32` makes hard.
    Hard,
}

/// At which settings a problem is run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Range {
    /// All of them.
    Full,
    /// Up to 240 Hz: it is dear.
    Short,
    /// A few around the default, and not in a quick run: it is very dear.
    Few,
}

/// All problems, in the order of the page.
pub(crate) fn all() -> Vec<Problem> {
    let lists = [
        flight::problems(),
        friction::problems(),
        rolling::problems(),
        orbits::problems(),
        bounces::problems(),
        collisions::problems(),
        toppling::problems(),
        stacks::problems(),
        flight::far_problems(),
    ];
    lists.into_iter().flatten().collect()
}

fn distance(one: [f64; 2], other: [f64; 2]) -> f64 {
    (one[0] - other[0]).hypot(one[1] - other[1])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_unique_and_durations_are_whole_ticks_at_every_rate() {
        let problems = all();
        for (index, problem) in problems.iter().enumerate() {
            assert!(problems[..index].iter().all(|other| other.name != problem.name), "{}", problem.name);
            let ticks = problem.duration * 30.0;
            assert!((ticks - ticks.round()).abs() < 1e-9 && ticks >= 1.0, "{}", problem.name);
        }
    }
}
