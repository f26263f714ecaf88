//! Card houses.

use std::f64::consts::FRAC_PI_2;

use crate::scene::{BodySpec, Scene, floor, rectangle};
use crate::stability::case::{Case, Group};
use crate::stability::on_earth;
use crate::stability::rest::{BEARS, Scale, bears};

/// Length and thickness of a card, m.
const LENGTH: f64 = 1.0;
const THICKNESS: f64 = 0.04;
/// How far a card leans from upright, degrees.
const LEAN: f64 = 20.0;
/// From one tent to the next, m: a little more than a card, so that the cards that lie on them do not meet.
const PITCH: f64 = LENGTH + 0.02;
const FRICTION: f64 = 0.8;

pub(super) fn cases() -> Vec<Case> {
    [5, 8].map(house).into()
}

/// Height of the house, and the house.
fn build(levels: u32) -> (f64, Scene) {
    let lean = LEAN.to_radians();
    let half_height = 0.5 * (LENGTH * lean.cos() + THICKNESS * lean.sin());
    let half_width = 0.5 * (LENGTH * lean.sin() + THICKNESS * lean.cos());
    let card =
        |position, angle| BodySpec { position, angle, friction: FRICTION, ..rectangle(THICKNESS, LENGTH) };
    let mut bodies = vec![BodySpec { friction: FRICTION, ..floor() }];
    for level in 0..levels {
        let bottom = f64::from(level) * (2.0 * half_height + THICKNESS);
        let tents = levels - level;
        for tent in 0..tents {
            let apex = (f64::from(tent) - 0.5 * f64::from(tents - 1)) * PITCH;
            for side in [-1.0, 1.0] {
                bodies.push(card([apex + side * half_width, bottom + half_height], side * lean));
            }
        }
        // The cards that lie across this level carry the tents of the next.
        for across in 1..tents {
            let x = (f64::from(across) - 0.5 * f64::from(tents)) * PITCH;
            bodies.push(card([x, bottom + 2.0 * half_height + 0.5 * THICKNESS], FRAC_PI_2));
        }
    }
    (f64::from(levels) * (2.0 * half_height + THICKNESS), on_earth(bodies))
}

fn house(levels: u32) -> Case {
    let statement = format!(
        "A house of cards of {levels} levels. The cards are 1 m long and 4 cm thick and lean at {LEAN}° from upright, with \
         friction {FRICTION}. Statics: a foot under the load of a card that leans on another needs friction up to tan \
         {LEAN}° = {:.2}, and the weights above come down through the tops, so it stands. Each card {BEARS}.",
        LEAN.to_radians().tan()
    );
    let (height, scene) = build(levels);
    Case::new(format!("card-house-{levels}"), Group::Structures, statement, scene, move |lab, scene| {
        let mut run = lab.run(scene);
        let checks = bears(&mut run, 10.0, Scale::of_height(height));
        lab.picture(&run);
        checks
    })
    .seen()
}
