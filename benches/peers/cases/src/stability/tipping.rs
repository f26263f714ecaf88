//! What is about to tip or to slide.

use crate::engine::State;
use crate::scene::{BodySpec, Kind, Scene, block, disc, floor, rectangle};
use crate::stability::case::{COUNT, Case, Check, Group, SHARE, Seen};
use crate::stability::rest::{STANDS, Scale, stands};
use crate::stability::{G, on_earth};

pub(super) fn cases() -> Vec<Case> {
    vec![leaning(false), leaning(true), tipped(), dominoes(), rocking(), ramp(true), ramp(false)]
}

/// Boxes of the leaning stack.
const BOXES: u32 = 10;

/// Each box is set off from the one below by the same step d. The centre of the upper k is (k + 1) d / 2 from that of
/// the box they stand on, and must not be beyond its edge at 1/2: with k = 9 above the lowest, d = 1/10.
fn stairs(step: f64) -> Scene {
    let boxes = (0..BOXES).map(|index| BodySpec {
        position: [step * (f64::from(index) - 4.5), f64::from(index) + 0.5],
        ..rectangle(1.0, 1.0)
    });
    on_earth([floor()].into_iter().chain(boxes))
}

fn leaning(is_outside: bool) -> Case {
    let rule = "Ten boxes of 1 m, each set off from the one below by d. Statics: the centre of the upper nine is 5 d from \
                the middle of the lowest box, so they tip over its edge from d = 10 cm on.";
    if is_outside {
        let statement =
            format!("{rule} With 10.2 cm, in 10 s, the top box falls to below half of its height.");
        return Case::new("leaning-outside", Group::Structures, statement, stairs(0.102), |lab, scene| {
            let mut run = lab.run(scene);
            run.until(10.0);
            lab.picture(&run);
            vec![Check::at_most("height of the top box", run.state(BOXES as usize).position[1], 5.0, "m")]
        })
        .seen();
    }
    let statement = format!("{rule} With 9.8 cm each {STANDS}.");
    Case::new("leaning-inside", Group::Structures, statement, stairs(0.098), |lab, scene| {
        let mut run = lab.run(scene);
        let checks = stands(&mut run, 10.0, Scale::of_height(f64::from(BOXES)));
        lab.picture(&run);
        checks
    })
    .seen()
}

/// How many dominoes there are, how thick and high they are and how far apart, m.
const DOMINOES: u32 = 100;
const DOMINO: [f64; 2] = [0.06, 0.5];
const APART: f64 = 0.25;
const FRICTION: f64 = 0.4;

fn domino() -> BodySpec {
    let [width, height] = DOMINO;
    BodySpec { position: [0.0, 0.5 * height], friction: FRICTION, ..rectangle(width, height) }
}

fn tipped() -> Case {
    let statement = "A domino, 50 cm high and 6 cm thick, turns about its lower edge with 1.2 times the energy that lifts its \
                     centre over the edge. Conservation: nothing takes energy at an edge that neither slides nor bounces \
                     (it would take friction of 0.09, and has 0.4), so it goes over, and lies flat after 3 s.";
    let [width, height] = DOMINO;
    let barrier = G * 0.5 * (width.hypot(height) - height);
    // About the edge, per mass: (w² + h²)/3.
    let spin = (2.0 * 1.2 * barrier / ((width * width + height * height) / 3.0)).sqrt();
    let velocity = [0.5 * height * spin, 0.5 * width * spin];
    let domino = BodySpec { spin: -spin, velocity, ..domino() };
    let ground = BodySpec { friction: FRICTION, ..floor() };
    let scene = on_earth([ground, domino]);
    Case::new("domino-tips", Group::Structures, statement, scene, move |lab, scene| {
        let mut run = lab.run(scene);
        run.until(3.0);
        vec![Check::at_most("height of the centre", run.state(1).position[1], 0.5 * width + 0.005, "m")]
    })
    .lasting(3.0)
}

fn dominoes() -> Case {
    let [width, height] = DOMINO;
    let lean = 10.0_f64.to_radians();
    let tipping = (width / height).atan();
    let statement = "A hundred dominoes, 50 cm high and 6 cm thick, 25 cm apart; the first leans by 10°, beyond the 6.8° \
                     where it tips. Statics: it meets the next at 22°, where its weight pushes with 0.145 m g at 46 cm, and \
                     0.065 m g are enough to tip the next; so all fall. After 30 s each leans by more than 6.8°, from where it \
                     cannot come back, and the energy was never more than at the start.";
    let ground = BodySpec { position: [0.0, -1.0], friction: FRICTION, ..block(60.0, 2.0) };
    let upright = |index: u32| BodySpec { position: [place(index), 0.5 * height], ..domino() };
    let mut bodies: Vec<BodySpec> = [ground].into_iter().chain((0..DOMINOES).map(upright)).collect();
    // The centre, about the lower right edge.
    let (sin, cos) = lean.sin_cos();
    let [x, y] = [-0.5 * width * cos + 0.5 * height * sin, 0.5 * width * sin + 0.5 * height * cos];
    bodies[1].position = [place(0) + 0.5 * width + x, y];
    bodies[1].angle = -lean;
    let case = Case::new("dominoes", Group::Structures, statement, on_earth(bodies), move |lab, scene| {
        let mut run = lab.run(scene);
        let energy = run.largest(30.0, crate::stability::Run::energy_gained);
        lab.picture(&run);
        let fallen = run.moving().iter().filter(|&&body| run.state(body).angle.abs() > tipping).count();
        // The least that f32 can tell from the height of all.
        let whole = run.mass() * G * height;
        vec![
            Check::at_least("dominoes that fell", fallen as f64, f64::from(DOMINOES), COUNT),
            Check::at_most("energy gained / m g h of all", energy / whole, 1e-5, SHARE),
        ]
    });
    Case { seen: Seen::Part([[-12.8, -0.3], [-7.8, 0.8]]), ..case }.lasting(30.0)
}

/// Where a domino stands, m.
fn place(index: u32) -> f64 {
    APART * (f64::from(index) - 0.5 * f64::from(DOMINOES))
}

fn rocking() -> Case {
    let statement = "A plank, 1 m long and 10 cm thick, leans by 3° on a fixed drum with a radius of 50 cm, on which it has \
                     rolled aside. It rocks, as the radius is more than half its thickness, and conservation: nothing gives \
                     it energy, so in 20 s it never leans by 1 % more than at first.";
    let (radius, half, lean) = (0.5, 0.05, 3.0_f64.to_radians());
    let (sin, cos) = lean.sin_cos();
    let (up, along) = (radius + half, radius * lean);
    let drum = BodySpec { kind: Kind::Fixed, friction: 1.0, ..disc(radius) };
    let position = [up * sin - along * cos, up * cos + along * sin];
    let plank = BodySpec { position, angle: -lean, friction: 1.0, ..rectangle(1.0, 2.0 * half) };
    let scene = on_earth([drum, plank]);
    Case::new("plank-on-drum", Group::Structures, statement, scene, move |lab, scene| {
        let mut run = lab.run(scene);
        let most = run.largest(20.0, |run| run.state(1).angle.abs());
        lab.picture(&run);
        vec![Check::at_most("largest lean / first", most / lean, 1.01, SHARE)]
    })
    .lasting(20.0)
    .seen()
}

fn ramp(sticks: bool) -> Case {
    let angle = 20.0_f64.to_radians();
    let share = if sticks { 1.01 } else { 0.99 };
    let friction = share * angle.tan();
    // The surface goes through the origin.
    let (sin, cos) = angle.sin_cos();
    let on_ramp = |along: f64, above: f64| [along * cos - above * sin, along * sin + above * cos];
    let slope = BodySpec { position: on_ramp(0.0, -1.0), angle, friction, ..block(40.0, 2.0) };
    let cube = BodySpec { position: on_ramp(5.0, 0.5), angle, friction, ..rectangle(1.0, 1.0) };
    let down = move |run: &crate::stability::Run| {
        let State { position: [x, y], .. } = run.state(1);
        5.0 - (x * cos + y * sin)
    };
    if sticks {
        let statement = "A box on a slope of 20° with friction 1.01 tan 20°. Coulomb: it sticks. In 10 s it creeps by less \
                         than 1 mm.";
        return Case::new(
            "ramp-sticks",
            Group::Structures,
            statement,
            on_earth([slope, cube]),
            move |lab, scene| {
                let mut run = lab.run(scene);
                let creep = run.largest(10.0, |run| down(run).abs());
                vec![Check::at_most("creep", creep, 1e-3, "m")]
            },
        );
    }
    let way = 0.5 * G * (sin - friction * cos) * 100.0;
    let statement = format!(
        "A box on a slope of 20° with friction 0.99 tan 20°. Coulomb: it slides, by g (sin 20° - µ cos 20°) t²/2 = {way:.3} \
         m in 10 s, within 1 %."
    );
    Case::new("ramp-slides", Group::Structures, statement, on_earth([slope, cube]), move |lab, scene| {
        let mut run = lab.run(scene);
        run.until(10.0);
        vec![Check::at_most("error of the way / the way", (down(&run) / way - 1.0).abs(), 0.01, SHARE)]
    })
}
