//! Boxes on boxes, and heavy on light.

use crate::engine::{DEFAULT, Fineness};
use crate::scene::{BodySpec, Scene, block, disc, floor, rectangle};
use crate::stability::case::{Case, Check, Group, SHARE};
use crate::stability::rest::{STANDS, Scale, apart, calm, stack, stands, tower};
use crate::stability::run::Lab;
use crate::stability::{G, on_earth};

pub(super) fn cases() -> Vec<Case> {
    let mut cases: Vec<Case> = [10, 20, 50, 100, 200].map(high).into();
    cases.extend([10, 100, 1000, 10_000].map(heavy_on_light));
    cases.extend([100, 1000].map(heavy_on_ten));
    cases.push(upward());
    cases.extend(plates());
    cases.push(bridge());
    cases
}

fn high(count: usize) -> Case {
    let statement = format!(
        "A stack of {count} boxes of 1 m, set without gaps. Statics: each centre is above the middle of the face below, \
         so every box stays where it was set. Each {STANDS}; and with four times as many substeps it does not stand worse, \
         but for the rounding of each height to f32."
    );
    let case =
        Case::new(format!("stack-{count}"), Group::Stacks, statement, stack(count), move |lab, scene| {
            let mut run = lab.run(scene);
            let mut checks = stands(&mut run, 10.0, Scale::of_height(count as f64));
            lab.picture(&run);
            let off_place = |run: &crate::stability::Run| run.most(|body, _| run.shift(body)[1].abs());
            let coarse = off_place(&run);
            let mut run = lab.run_at(scene, Fineness { substeps: 4 * DEFAULT.substeps, ..DEFAULT });
            run.until(10.0);
            // Each height is rounded to a half of 2^-23 of itself at most, and the errors add up.
            let rounding = (count * count) as f64 / f64::from(1 << 24);
            checks.push(Check::at_most("worse with 16 substeps by", off_place(&run) - coarse, rounding, "m"));
            checks
        });
    if count == 20 { case.seen() } else { case }
}

fn settled(lab: &mut Lab<'_>, scene: &Scene, height: f64) -> Vec<Check> {
    let mut run = lab.run(scene);
    let mut checks = stands(&mut run, 10.0, Scale::of_height(height));
    checks.push(apart(&run, Scale::of_height(height)));
    lab.picture(&run);
    checks
}

fn heavy_on_light(ratio: u32) -> Case {
    let statement = format!(
        "A box of 1 m and {ratio} kg on one of 1 kg. Statics does not ask for the masses: each {STANDS}; they overlap by \
         less than 1 cm."
    );
    let boxes = tower([(1.0, 1.0), (1.0, f64::from(ratio))]);
    let scene = on_earth([floor()].into_iter().chain(boxes));
    Case::new(format!("mass-{ratio}"), Group::Stacks, statement, scene, |lab, scene| settled(lab, scene, 2.0))
}

fn heavy_on_ten(ratio: u32) -> Case {
    let statement = format!(
        "A box of 1 m and {ratio} kg on ten of 1 kg. Statics: it stands. Each {STANDS}; no two overlap by more than 1 cm."
    );
    let boxes = (0..11).map(|index| (1.0, if index == 10 { f64::from(ratio) } else { 1.0 }));
    let scene = on_earth([floor()].into_iter().chain(tower(boxes)));
    let name = format!("heavy-{ratio}-on-ten");
    Case::new(name, Group::Stacks, statement, scene, |lab, scene| settled(lab, scene, 11.0)).seen()
}

fn upward() -> Case {
    let statement = format!(
        "Boxes of 1 m and 1, 10, 100, 1000 and 10,000 kg on each other, the heaviest on top. Statics: they stand. Each \
         {STANDS}; no two overlap by more than 1 cm."
    );
    let boxes = tower((0..5).map(|power| (1.0, 10.0_f64.powi(power))));
    let scene = on_earth([floor()].into_iter().chain(boxes));
    Case::new("densities-upward", Group::Stacks, statement, scene, |lab, scene| settled(lab, scene, 5.0))
        .seen()
}

/// Radius of the balls under the plate, m.
const BALL: f64 = 0.1;

/// 200 balls in so many layers between walls, under a plate.
fn plate(name: &str, layers: u32, statement: &str) -> Case {
    let row = 200 / layers;
    // Each layer is set off by half a ball from the one below.
    let offset = if layers > 1 { 1.0 } else { 0.0 };
    let width = (2.0 * f64::from(row) + offset) * BALL;
    let pitch = 3.0_f64.sqrt() * BALL;
    let wall = |side: f64| BodySpec { position: [side * (0.5 * width + 0.5), 1.5], ..block(1.0, 3.0) };
    let ball = |index: u32| {
        let (layer, column) = (index / row, f64::from(index % row));
        let x = (2.0 * column + 1.0 + f64::from(layer % 2)) * BALL - 0.5 * width;
        BodySpec { position: [x, BALL + f64::from(layer) * pitch], ..disc(BALL) }
    };
    let height = 2.0 * BALL + f64::from(layers - 1) * pitch;
    let top = BodySpec { position: [0.0, height + 0.25], density: 100.0, ..rectangle(width - 0.01, 0.5) };
    let ground = BodySpec { position: [0.0, -1.0], ..block(60.0, 2.0) };
    let bodies = [ground, wall(-1.0), wall(1.0)].into_iter().chain((0..200).map(ball)).chain([top]);
    Case::new(name, Group::Stacks, statement, on_earth(bodies), move |lab, scene| {
        let scale = Scale { size: 2.0 * BALL, ..Scale::of_height(height) };
        let mut run = lab.run(scene);
        let calm = calm(&mut run, 10.0, scale);
        lab.picture(&run);
        vec![apart(&run, scale), calm]
    })
    .seen()
}

fn plates() -> [Case; 2] {
    let row = "200 balls of 0.2 m and 0.03 kg in a row between two walls, each touching the next, under a plate of 2 t. \
               Statics: each carries a two-hundredth of it straight down and has nowhere to go. No two overlap by more than a \
               hundredth of a ball, and all are at rest in the last second.";
    let heap = "200 such balls in four layers between walls, the upper ones in the hollows of the lower, under a plate of 500 \
                kg. Statics: there are forces, all of them pressing, that carry it (P down on every ball of a layer, handed on \
                at 30° to the two below and to the walls), and no motion brings all balls nearer together at once, so it \
                stands. No two overlap by more than a hundredth of a ball, and all are at rest in the last second.";
    [plate("plate-on-balls", 1, row), plate("plate-on-heap", 4, heap)]
}

fn bridge() -> Case {
    let statement = "A ball of 785 kg falls from 2 m onto the middle of a plank of 2 kg, which lies on two piers of three \
                     boxes of 1 kg. Everything is symmetric, nothing bounces, and what is rigid passes the blow straight \
                     down: the plank stays level on its piers. In the end it has sunk by no more than 1 % of its height \
                     and tilts by less than that share, no two bodies overlap by more than 1 cm, and the energy is never \
                     more than at the start.";
    let piers = [-2.0, 2.0].into_iter().flat_map(|x| {
        tower([(1.0, 1.0); 3])
            .into_iter()
            .map(move |spec| BodySpec { position: [x, spec.position[1]], ..spec })
    });
    let plank = BodySpec { position: [0.0, 3.2], ..rectangle(5.0, 0.4) };
    let ball = BodySpec { position: [0.0, 5.9], density: 1000.0, ..disc(0.5) };
    let bodies = [floor()].into_iter().chain(piers).chain([plank, ball]);
    Case::new("ball-on-bridge", Group::Stacks, statement, on_earth(bodies), |lab, scene| {
        let scale = Scale::of_height(3.4);
        let mut run = lab.run(scene);
        let energy = run.largest(10.0, crate::stability::Run::energy_gained);
        let plank = 7;
        lab.picture(&run);
        vec![
            Check::at_most(
                "sinking of the plank / height",
                run.shift(plank)[1].abs() / scale.height,
                0.01,
                SHARE,
            ),
            Check::at_most("its tilt", run.state(plank).angle.abs(), 0.01, "rad"),
            apart(&run, scale),
            // The least that f32 can tell from the fall of the ball.
            Check::at_most("energy gained / that of the fall", energy / (785.4 * G * 2.0), 1e-5, SHARE),
        ]
    })
    .seen()
}
