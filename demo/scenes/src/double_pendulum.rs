//! A double pendulum, and where its equations say that it is.

use rustycs::{Body, BodyId, BodyType, Filter, Joint, Settings, Shape, World};

use crate::joined::join;
use crate::mark::{Label, Mark};
use crate::parts::{put, world_with_gravity};
use crate::{Scene, View};

/// A double pendulum, and where its equations say that it is.
pub const SCENE: Scene = Scene {
    name: "double_pendulum",
    group: "joints",
    summary: "Two rods from the side: a disc moves as their equations say, the lower rod as the engine makes it.",
    view: View::above(-2.4, 0.0, 6.0, 4.4),
    build,
    before_tick: Some(show_exact),
    readout: Some(readout),
    ends_after: Some(SECONDS),
    is_about_paths: true,
    is_about_names: true,
    labels: &[Label::text("by its equations")],
    ..Scene::PLAIN
};

/// What is shown, s: later, what is a billionth at first has grown to metres.
const SECONDS: f32 = 12.0;
/// Length and width of a rod of 1 kg, m.
const LENGTH: f64 = 1.0;
const WIDTH: f64 = 0.1;
/// Acceleration of gravity, m/s².
const G: f64 = 9.81;

/// Both rods stand out to the right at first.
fn build(_seed: u64, settings: Settings) -> World {
    let mut world = world_with_gravity(settings);
    let mut above = None;
    for number in 0..2_u8 {
        let left = f32::from(number);
        let rod = Body::dynamic(Shape::obb(LENGTH as f32, WIDTH as f32)).at([left + 0.5, 0.0]).mass(1.0);
        let rod = put(&mut world, Mark::part(number.into()).on(rod));
        join(&mut world, Joint::revolute(rod, above).at([left, 0.0]));
        above = Some(rod);
    }
    let disc = Body::kinematic(Shape::circle(0.06)).at([1.5, 0.0]);
    put(&mut world, Mark::label(0).on(disc).filter(Filter { mask: 0, ..Filter::DEFAULT }));
    world
}

/// Directions of the rods, as vectors of length 1, and how fast they turn, rad/s.
#[derive(Clone, Copy)]
struct Motion {
    direction: [[f64; 2]; 2],
    spin: [f64; 2],
}

impl Motion {
    /// How fast all that changes. With the angles θ from straight down, δ = θ1 - θ2, a rod of mass 1 and I = (l² + b²)/12:
    ///
    /// ```text
    /// (I + 5/4 l²) θ1'' + l²/2 cos δ θ2'' = -l²/2 sin δ θ2'² - 3/2 g l sin θ1
    /// l²/2 cos δ θ1'' + (I + l²/4) θ2'' = l²/2 sin δ θ1'² - g l/2 sin θ2
    /// ```
    fn rate(&self) -> Self {
        let [[x1, y1], [x2, y2]] = self.direction;
        let [w1, w2] = self.spin;
        let inertia = (LENGTH * LENGTH + WIDTH * WIDTH) / 12.0;
        // sin θ is x and cos θ is -y.
        let (sin, cos) = (x2 * y1 - x1 * y2, x1 * x2 + y1 * y2);
        let half = 0.5 * LENGTH * LENGTH;
        let (a, b, d) = (inertia + 2.5 * half, half * cos, inertia + 0.5 * half);
        let first = -half * sin * w2 * w2 - 1.5 * G * LENGTH * x1;
        let second = half * sin * w1 * w1 - 0.5 * G * LENGTH * x2;
        let determinant = a * d - b * b;
        let spin = [(d * first - b * second) / determinant, (a * second - b * first) / determinant];
        Self { direction: [[-w1 * y1, w1 * x1], [-w2 * y2, w2 * x2]], spin }
    }

    fn plus(&self, rate: &Self, time: f64) -> Self {
        let mut sum = *self;
        for rod in 0..2 {
            sum.spin[rod] += time * rate.spin[rod];
            for axis in 0..2 {
                sum.direction[rod][axis] += time * rate.direction[rod][axis];
            }
        }
        sum
    }

    /// The same after a time, s, by the rule of Runge and Kutta.
    fn after(mut self, seconds: f64) -> Self {
        let steps = (1_200.0 * seconds).round().max(1.0);
        let h = seconds / steps;
        for _ in 0..steps as u32 {
            let one = self.rate();
            let two = self.plus(&one, 0.5 * h).rate();
            let three = self.plus(&two, 0.5 * h).rate();
            let four = self.plus(&three, h).rate();
            for (rate, share) in [(one, 1.0), (two, 2.0), (three, 2.0), (four, 1.0)] {
                self = self.plus(&rate, h * share / 6.0);
            }
        }
        self
    }
}

/// Where the middle of the lower rod is by the equations after a time, m.
fn exact(seconds: f64) -> [f64; 2] {
    let start = Motion { direction: [[1.0, 0.0]; 2], spin: [0.0; 2] };
    let [[x1, y1], [x2, y2]] = start.after(seconds).direction;
    [LENGTH * (x1 + 0.5 * x2), LENGTH * (y1 + 0.5 * y2)]
}

fn find(world: &World, is_it: impl Fn(Mark) -> bool) -> Option<BodyId> {
    world.bodies().find(|(_, body)| is_it(Mark::of(*body))).map(|(id, _)| id)
}

/// Puts the disc where the rod should be after the tick.
fn show_exact(world: &mut World) {
    let time = world.time() + world.settings().tick_seconds();
    let Some(id) = find(world, |mark| mark.label == Some(0)) else { return };
    if time <= f64::from(SECONDS)
        && let Some(mut disc) = world.body_mut(id)
        && disc.view().body_type() == BodyType::Kinematic
    {
        // Numbers of a scene are within what a body can be given.
        _ = disc.set_position(exact(time));
    }
}

/// How far the rod is off, m.
fn distance(world: &World) -> Option<f32> {
    let rod = world.body(find(world, |mark| mark.part == Some(1))?)?;
    let disc = world.body(find(world, |mark| mark.label == Some(0))?)?;
    Some((rod.position() - disc.position()).length())
}

fn readout(world: &World) -> String {
    distance(world).map_or_else(String::new, |off| {
        format!(
            "{:.1} s: {:.3} mm off its equations, energy {:+.6} J",
            world.time(),
            1e3 * off,
            world.energy()
        )
    })
}

#[cfg(test)]
mod tests {
    use rustycs::Vec2;

    use super::*;
    use crate::testing::run;

    /// Angles after three seconds, of an integration to ten digits: 1.0429351221 and 0.4442594614 rad.
    #[test]
    fn the_equations_are_those_of_the_reference() {
        let start = Motion { direction: [[1.0, 0.0]; 2], spin: [0.0; 2] };
        let [upper, lower] = start.after(3.0).direction.map(|[x, y]| Vec2::new(-y as f32, x as f32).angle());
        assert!((upper - 1.042_935_1).abs() < 1e-5, "{upper}");
        assert!((lower - 0.444_259_46).abs() < 1e-5, "{lower}");
    }

    /// Of second order with h = 1/240 s: an error of the phase of (ω h)²/24, with ω to 12 rad/s, is 1e-4 of the 20 rad that
    /// they turn through in two seconds, and grows as the motion is chaotic.
    #[test]
    fn the_rod_stays_with_its_equations_for_two_seconds() {
        let mut world = SCENE.build(1, Settings::default());
        run(&SCENE, &mut world, 120);
        let off = distance(&world).expect("both are there");
        assert!(off < 5e-3, "{off} m");
    }
}
