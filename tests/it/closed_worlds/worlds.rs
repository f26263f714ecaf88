//! Closed worlds by chance: some bodies of every shape that fly at each other, and nothing else.

use rand::rngs::Xoshiro256PlusPlus;
use rand::{RngExt, SeedableRng};
use rustycs::prelude::*;

/// A body, in numbers that a shift, a turn by a quarter, and a mirror image are exact for.
#[derive(Clone, Debug)]
struct Member {
    outline: Outline,
    turns: bool,
    center: [f64; 2],
    /// Of an angle: its quarter turns, and what is more, rad.
    angle: f32,
    velocity: [f32; 2],
    spin: f32,
    density: f32,
    friction: f32,
    restitution: f32,
    /// Further shapes: each with its place on the body, and its angle, rad.
    further: Vec<(Outline, [f32; 2], f32)>,
}

#[derive(Clone, Debug)]
enum Outline {
    Circle(f32),
    Aabb(f32, f32),
    Obb(f32, f32),
    Polygon(Vec<[f32; 2]>),
    /// With its radius.
    Rounded(Vec<[f32; 2]>, f32),
}

/// What is set in mid-run: after so many ticks, rate and substeps and the switches.
#[derive(Clone, Debug)]
struct Change {
    after: u32,
    settings: Settings,
}

/// A world that nothing acts on from outside.
#[derive(Clone, Debug)]
pub(super) struct ClosedWorld {
    members: Vec<Member>,
    settings: Settings,
    changes: Vec<Change>,
    ticks: u32,
}

/// How the same world is looked at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum View {
    AsItIs,
    /// By 10⁶ m.
    Shifted,
    /// By 90°.
    Turned,
    /// Left and right exchanged.
    Mirrored,
}

impl View {
    /// A vector as seen so.
    fn see<T: Copy + std::ops::Neg<Output = T>>(self, [x, y]: [T; 2]) -> [T; 2] {
        match self {
            Self::AsItIs | Self::Shifted => [x, y],
            Self::Turned => [-y, x],
            Self::Mirrored => [-x, y],
        }
    }

    /// What turns one way seen so.
    fn handed(self, value: f32) -> f32 {
        if self == Self::Mirrored { -value } else { value }
    }

    /// An angle as seen so, rad. A box in a mirror is the same box.
    fn angle(self, angle: f32) -> f32 {
        if self == Self::Turned { angle + std::f32::consts::FRAC_PI_2 } else { self.handed(angle) }
    }

    fn place(self, center: [f64; 2]) -> [f64; 2] {
        let [x, y] = self.see(center);
        if self == Self::Shifted { [x + 1e6, y - 1e6] } else { [x, y] }
    }
}

fn settings(random: &mut Xoshiro256PlusPlus) -> Settings {
    let rate = [30.0, 60.0, 60.0, 60.0, 120.0, 240.0, 1000.0][random.random_range(0..7)];
    let substeps = [1, 2, 4, 4, 4, 8, 16][random.random_range(0..7)];
    let base = Settings { tick_rate: rate, substeps, sleep: false, ..Settings::default() };
    Settings {
        adaptive: random.random_bool(0.8),
        recycling: random.random_bool(0.8),
        block_solve: random.random_bool(0.8),
        restitution_threshold: [0.0, 0.1, 1.0][random.random_range(0..3)],
        ..base
    }
}

fn power(random: &mut Xoshiro256PlusPlus, low: f32, high: f32) -> f32 {
    10.0_f64.powf(f64::from(random.random_range(low..high))) as f32
}

fn member(random: &mut Xoshiro256PlusPlus, speed: f32, radius: f32, masses: f32, all_turn: bool) -> Member {
    let mut size = || random.random_range(0.2_f32..1.0);
    let (width, height) = (2.0 * size(), 2.0 * size());
    let outline = match random.random_range(0..4) {
        1 if all_turn => Outline::Obb(width, height),
        0 => Outline::Circle(0.5 * width),
        1 => Outline::Aabb(width, height),
        2 => Outline::Obb(width, height),
        _ => {
            let corners = random.random_range(3..9_u32);
            let corner = |i: u32| {
                let Rot { c, s } = Rot::from_angle(std::f32::consts::TAU * i as f32 / corners as f32);
                [0.5 * width * c, 0.5 * height * s]
            };
            Outline::Polygon((0..corners).map(corner).collect())
        }
    };
    let mut direction = || random.random_range(-1.0_f32..1.0);
    let [x, y] = [radius * direction(), radius * direction()];
    // Most of them towards the middle, so that they meet.
    let [vx, vy] = [0.6 * direction() - x / radius, 0.6 * direction() - y / radius];
    let (center, velocity, spin) =
        ([f64::from(x), f64::from(y)], [speed * vx, speed * vy], 0.2 * speed * direction());
    let friction = match random.random_range(0..3) {
        0 => 0.0,
        1 => random.random_range(0.0..1.0),
        _ => power(random, -1.0, 2.0),
    };
    let restitution = [0.0, 1.0, random.random_range(0.0..1.0)][random.random_range(0..3)];
    Member {
        turns: all_turn || random.random_bool(0.7),
        angle: random.random_range(-3.0..3.0),
        density: power(random, 0.0, masses),
        center,
        velocity,
        spin,
        friction,
        restitution,
        outline,
        further: Vec::new(),
    }
}

impl ClosedWorld {
    /// The world of a seed.
    pub(super) fn new(seed: u64) -> Self {
        let random = &mut Xoshiro256PlusPlus::seed_from_u64(seed);
        let count = random.random_range(2..16);
        let speed = power(random, 0.0, 2.0);
        let masses = [1e-3, 2.0, 3.4][random.random_range(0..3)];
        let radius = (count as f32).sqrt() * random.random_range(1.5..3.0);
        let all_turn = random.random_bool(0.5);
        let settings_at_first = settings(random);
        let mut members: Vec<Member> = Vec::new();
        for _ in 0..count * 8 {
            let new = member(random, speed, radius, masses, all_turn);
            let is_apart = |other: &Member| {
                let [x, y] = [0, 1].map(|axis| other.center[axis] - new.center[axis]);
                let reach = other.reach() + new.reach() + 0.05;
                x * x + y * y > reach * reach
            };
            if members.len() < count && members.iter().all(is_apart) {
                members.push(new);
            }
        }
        let ticks = random.random_range(30..120);
        let changes = (0..random.random_range(0..3))
            .map(|_| Change { after: random.random_range(1..ticks), settings: settings(random) })
            .collect();
        Self { members, settings: settings_at_first, changes, ticks }
    }

    /// The world of a seed, in which most bodies have several shapes, no farther out than their first.
    pub(super) fn of_compounds(seed: u64) -> Self {
        let mut world = Self::new(seed);
        let random = &mut Xoshiro256PlusPlus::seed_from_u64(!seed);
        for member in &mut world.members {
            // What never turns has its shapes along the axes of every view.
            if matches!(member.outline, Outline::Aabb(..)) {
                continue;
            }
            let reach = member.reach() as f32;
            for _ in 0..random.random_range(0..4) {
                let size = reach * random.random_range(0.2_f32..0.5);
                let outline = match random.random_range(0..3) {
                    0 => Outline::Circle(0.5 * size),
                    1 => Outline::Obb(0.7 * size, 0.5 * size),
                    _ => Outline::Polygon(vec![
                        [0.5 * size, 0.0],
                        [-0.3 * size, 0.4 * size],
                        [-0.2 * size, -0.4 * size],
                    ]),
                };
                let Rot { c, s } = Rot::from_angle(random.random_range(-3.0..3.0));
                let out = reach - 0.5 * size;
                member.further.push((outline, [out * c, out * s], random.random_range(-3.0..3.0)));
            }
        }
        world
    }

    /// The world of a seed, in which most bodies are capsules or have round corners, and reach no farther out.
    pub(super) fn of_rounded(seed: u64) -> Self {
        let mut world = Self::new(seed);
        let random = &mut Xoshiro256PlusPlus::seed_from_u64(seed.rotate_left(32));
        for member in &mut world.members {
            if matches!(member.outline, Outline::Aabb(..)) || random.random_bool(0.2) {
                continue;
            }
            let reach = member.reach() as f32;
            let radius = reach * random.random_range(0.1_f32..0.6);
            let corners = random.random_range(2..9_u32);
            let flat = random.random_range(0.3_f32..1.0);
            let corner = |i: u32| {
                let Rot { c, s } = Rot::from_angle(std::f32::consts::TAU * i as f32 / corners as f32);
                [(reach - radius) * c, flat * (reach - radius) * s]
            };
            member.outline = Outline::Rounded((0..corners).map(corner).collect(), radius);
        }
        world
    }

    /// Whether every body can be turned. What holds one that cannot takes angular momentum.
    pub(super) fn all_turn(&self) -> bool {
        self.members.iter().all(|member| member.turns && !matches!(member.outline, Outline::Aabb(..)))
    }

    /// How many ticks it is watched for.
    pub(super) fn ticks(&self) -> u32 {
        self.ticks
    }

    /// The world at the start.
    pub(super) fn build(&self, view: View) -> World {
        let mut world = World::new(self.settings.clone());
        for member in &self.members {
            world.add(member.body(view)).expect("a good body");
        }
        world
    }

    /// Sets what is to be set before a tick.
    pub(super) fn before_tick(&self, tick: u32, world: &mut World) {
        for change in self.changes.iter().filter(|change| change.after == tick) {
            world.set_settings(change.settings.clone()).expect("good settings");
        }
    }
}

impl Outline {
    fn shape(&self, view: View) -> Shape {
        let sides = |width: f32, height: f32| {
            if view == View::Turned { (height, width) } else { (width, height) }
        };
        match self {
            Self::Circle(radius) => Shape::circle(*radius),
            Self::Aabb(width, height) => {
                let (width, height) = sides(*width, *height);
                Shape::aabb(width, height)
            }
            Self::Obb(width, height) => Shape::obb(*width, *height),
            Self::Polygon(corners) => {
                let seen = corners.iter().map(|&[x, y]| [view.handed(x), y]);
                Shape::polygon(seen.collect::<Vec<_>>()).expect("convex corners")
            }
            Self::Rounded(corners, radius) => {
                let seen = corners.iter().map(|&[x, y]| [view.handed(x), y]);
                Shape::rounded(seen.collect::<Vec<_>>(), *radius).expect("convex corners")
            }
        }
    }
}

impl Member {
    /// No point of the outline is farther from the centre, m.
    fn reach(&self) -> f64 {
        let corner = |[x, y]: [f32; 2]| f64::from(x).hypot(f64::from(y));
        match &self.outline {
            Outline::Circle(radius) => f64::from(*radius),
            Outline::Aabb(width, height) | Outline::Obb(width, height) => corner([0.5 * width, 0.5 * height]),
            Outline::Polygon(corners) => corners.iter().map(|&at| corner(at)).fold(0.0, f64::max),
            Outline::Rounded(corners, radius) => {
                corners.iter().map(|&at| corner(at)).fold(0.0, f64::max) + f64::from(*radius)
            }
        }
    }

    fn body(&self, view: View) -> Body {
        let further = self.further.iter().map(|(outline, [x, y], angle)| {
            // Polygons are about their centres of mass.
            Collider::new(outline.shape(view)).at([view.handed(*x), *y]).angle(view.handed(*angle))
        });
        further
            .fold(Body::dynamic(self.outline.shape(view)), Body::with)
            .at(view.place(self.center))
            .angle(view.angle(self.angle))
            .velocity(view.see(self.velocity))
            // What cannot be turned by others is not to turn by itself either: it would be a motor.
            .angular_velocity(if self.turns { view.handed(self.spin) } else { 0.0 })
            .fixed_rotation(!self.turns)
            .density(self.density)
            .friction(self.friction)
            .restitution(self.restitution)
    }
}
