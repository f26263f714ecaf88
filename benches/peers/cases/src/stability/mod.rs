//! Stiff and extreme cases, each with what must hold in it.
//!
//! No bound is taken from what an engine does. Each follows from statics (what stands must stand where it was put, what
//! cannot must fall), from a law of conservation, or from a closed form; the statement of a case says which. Where
//! rest is asked for, these are the allowances, the same for all cases and engines:
//!
//! | | for bodies of 1 m under 9.81 m/s² | and of size s under gravity g |
//! |---|---|---|
//! | sinking | 1 % of the height | the same |
//! | drifting, where all forces are straight down | 1 mm | s / 1000 |
//! | drifting, where sinking turns into it (what leans, or stands by thrust) | 1 % of the height | the same |
//! | overlap | 1 cm | s / 100 |
//! | speed at rest | 1 mm/s | times √(s g / 9.81 m²/s²) |

mod arches;
mod case;
mod causes;
mod confined;
mod far;
mod figures;
mod forces;
mod houses;
mod long;
mod piles;
mod random;
mod rest;
mod run;
mod sizes;
mod speeds;
mod stacks;
mod tipping;
mod walls;

pub use case::{COUNT, Case, Check, Group, Judge, Limit, Play, PlayOurs, SHARE, Seen};
pub use rest::SPEED_AT_REST;
pub use run::{Lab, Run, Snapshot};

use crate::scene::{G, on_earth};

/// All cases, in the order of the page.
#[must_use]
pub fn all() -> Vec<Case> {
    let lists = [
        stacks::cases(),
        piles::cases(),
        houses::cases(),
        arches::cases(),
        tipping::cases(),
        confined::cases(),
        sizes::cases(),
        speeds::cases(),
        walls::cases(),
        far::cases(),
        forces::cases(),
        long::cases(),
        random::cases(),
    ];
    lists.into_iter().flatten().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_unique_and_fit_for_files() {
        let cases = all();
        for (index, case) in cases.iter().enumerate() {
            assert!(cases[..index].iter().all(|other| other.name != case.name), "{}", case.name);
            let is_plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
            assert!(case.name.chars().all(is_plain), "{}", case.name);
        }
    }
}
