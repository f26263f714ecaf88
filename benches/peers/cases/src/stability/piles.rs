//! Pyramids.

use crate::scene::{BodySpec, block, rectangle};
use crate::stability::case::{Case, Group};
use crate::stability::on_earth;
use crate::stability::rest::{STANDS, Scale, stands};

pub(super) fn cases() -> Vec<Case> {
    [40, 100].map(pyramid).into()
}

fn pyramid(base: u32) -> Case {
    let statement = format!(
        "A pyramid of boxes of 1 m, {base} in the lowest row, one less in each row above. Statics: each box rests with its \
         middle above the gap of two others that carry it evenly, all forces straight down, so it stands. Each {STANDS}."
    );
    let ground = BodySpec { position: [0.0, -1.0], ..block(3.0 * f64::from(base), 2.0) };
    let boxes = (0..base).flat_map(move |row| {
        (0..base - row).map(move |column| {
            let x = 1.1 * (f64::from(column) - 0.5 * f64::from(base - row - 1));
            BodySpec { position: [x, f64::from(row) + 0.5], ..rectangle(1.0, 1.0) }
        })
    });
    let scene = on_earth([ground].into_iter().chain(boxes));
    let case =
        Case::new(format!("pyramid-{base}"), Group::Structures, statement, scene, move |lab, scene| {
            let mut run = lab.run(scene);
            let checks = stands(&mut run, 10.0, Scale::of_height(f64::from(base)));
            lab.picture(&run);
            checks
        });
    if base > 50 { case.long() } else { case.seen() }
}
