//! The scenes: crowds of bodies that fly about in a box, and variants of them.

use std::sync::LazyLock;
use std::time::Instant;

use rustycs::prelude::*;

pub(crate) type Build = fn() -> World;

/// An optional thing.
pub(crate) struct Row {
    pub(crate) name: &'static str,
    /// What "set out" and "in use" are.
    pub(crate) statement: &'static str,
    pub(crate) absent: Build,
    pub(crate) set_out: Option<Build>,
    pub(crate) in_use: Option<Build>,
}

/// A scene by the kernel that leaves nothing out, and by those that fit.
pub(crate) struct Kernel {
    pub(crate) name: &'static str,
    /// What is left out.
    pub(crate) statement: &'static str,
    pub(crate) general: Build,
    pub(crate) fitted: Build,
}

/// Discs and boxes of about 0.2 m, every second one of either kind.
#[derive(Clone)]
struct Crowd {
    settings: Settings,
    shape: fn(usize) -> Shape,
    body: fn(Body, usize) -> Body,
    /// What is alone and at rest, far off.
    lone: fn(Body) -> Body,
    /// Of the middles of two neighbours, m.
    spacing: f32,
}

/// Nothing of what is optional, but that bodies rub and turn.
fn crowd() -> Crowd {
    let mixed =
        |index: usize| if index.is_multiple_of(2) { Shape::circle(0.1) } else { Shape::obb(0.18, 0.18) };
    Crowd {
        settings: Settings {
            sleep: false,
            adaptive: false,
            hit_threshold: 1e18,
            friction_mix: Mix::Min,
            ..Settings::default()
        },
        shape: mixed,
        body: |body, _| body.friction(0.4),
        lone: |body| body,
        spacing: 0.28,
    }
}

/// Discs that neither rub nor bounce.
fn smooth_discs() -> Crowd {
    Crowd { shape: |_| Shape::circle(0.1), body: |body, _| body.friction(0.0), ..crowd() }
}

/// Boxes that cannot turn and do not rub.
fn smooth_boxes() -> Crowd {
    Crowd { shape: |_| Shape::aabb(0.2, 0.2), body: |body, _| body.friction(0.0), ..crowd() }
}

/// Discs that bounce and do not rub, and so never rest.
fn elastic_gas() -> Crowd {
    Crowd { body: |body, _| body.friction(0.0).restitution(1.0), spacing: 0.5, ..smooth_discs() }
}

fn put(world: &mut World, body: Body) {
    world.add(body).expect("a body that a world takes");
}

impl Crowd {
    fn build(self) -> World {
        const COLUMNS: usize = 30;
        let Self { settings, shape, body, lone, spacing } = self;
        let mut world = World::new(settings);
        let half = 0.5 * COLUMNS as f32 * spacing;
        let long = 2.0 * half + 2.0;
        for (x, y, width, height) in
            [(-1.0, 0.0, 1.0, long), (1.0, 0.0, 1.0, long), (0.0, -1.0, long, 1.0), (0.0, 1.0, long, 1.0)]
        {
            let place = [x, y].map(|side| side * (half + 0.5));
            put(&mut world, body(Body::fixed(Shape::aabb(width, height)).at(place), 0));
        }
        for index in 0..COLUMNS * COLUMNS {
            let place = [index % COLUMNS, index / COLUMNS].map(|cell| (cell as f32 + 0.5) * spacing - half);
            let Rot { c, s } = Rot::from_angle(2.4 * index as f32);
            let crowded = Body::dynamic(shape(index)).at(place).velocity([2.0 * c, 2.0 * s]);
            put(&mut world, body(crowded.restitution(0.0), index));
        }
        put(
            &mut world,
            lone(Body::dynamic(Shape::aabb(1.0, 1.0)).at([200.0, 0.0]).friction(0.0).restitution(0.0)),
        );
        world
    }
}

/// 600 boxes in stacks of three on a floor, at rest.
fn stacks(settings: Settings, middle: f32, world: Option<World>) -> World {
    let mut world = world.unwrap_or_else(|| World::new(settings));
    if world.forces().next().is_none() {
        world.add_force(Force::EARTH_GRAVITY);
    }
    put(&mut world, Body::fixed(Shape::aabb(600.0, 1.0)).at([middle, -0.5]));
    for index in 0..600_i16 {
        let place = [middle + 1.5 * f32::from(index % 200 - 100), 0.5 + f32::from(index / 200)];
        put(&mut world, Body::dynamic(Shape::obb(1.0, 1.0)).at(place));
    }
    world
}

/// A crowd that falls onto its floor, for scenes with others that rest.
fn falling() -> Crowd {
    Crowd { settings: Settings { sleep: true, ..crowd().settings }, ..elastic_gas() }
}

fn with_gravity(mut world: World) -> World {
    world.add_force(Force::EARTH_GRAVITY);
    world
}

/// Seconds since the first call.
fn clock() -> f64 {
    static START: LazyLock<Instant> = LazyLock::new(Instant::now);
    START.elapsed().as_secs_f64()
}

fn with_clock(clock: Option<Clock>) -> World {
    let mut world = crowd().build();
    world.set_clock(Clock::new(self::clock));
    world.set_clock(clock);
    world
}

fn with_force(acceleration: [f32; 2]) -> World {
    let mut world = crowd().build();
    world.add_force(Force::new("wind", acceleration));
    world
}

fn with_attractor(stays: bool) -> World {
    let mut world = crowd().build();
    let id = world.add_attractor(Attractor::global([0.0, 0.0], 0.01));
    if !stays {
        world.remove_attractor(id);
    }
    world
}

/// One that can turn, in the place of the one that cannot.
fn with_lone_disc(crowd: Crowd) -> World {
    let mut world = crowd.build();
    let last = world.bodies().last().map(|(id, _)| id).expect("there are bodies");
    let place = world.remove(last).map(|_| [200.0, 0.0]).expect("it is there");
    put(&mut world, Body::dynamic(Shape::circle(0.5)).at(place).friction(0.0));
    world
}

fn with_settings(mut crowd: Crowd, change: fn(Settings) -> Settings) -> World {
    crowd.settings = change(crowd.settings);
    crowd.build()
}

/// Fixed bodies that nobody is near.
fn with_distant_ground() -> World {
    let mut world = crowd().build();
    for index in 0..5000_i16 {
        put(&mut world, Body::fixed(Shape::aabb(1.0, 1.0)).at([100.0 + f32::from(index), 50.0]));
    }
    world
}

fn with_kinematic(spin: f32) -> World {
    let mut world = crowd().build();
    put(&mut world, Body::kinematic(Shape::obb(4.0, 0.1)).at([100.0, 50.0]).angular_velocity(spin));
    world
}

const FAR: Aabb = Aabb { min: Vec2::new(-1e4, -1e4), max: Vec2::new(1e4, 1e4) };

/// What is optional.
pub(crate) const ROWS: &[Row] = &[
    Row {
        name: "world forces",
        statement: "a force of 0; one of 0.1 m/s²",
        absent: || crowd().build(),
        set_out: Some(|| with_force([0.0; 2])),
        in_use: Some(|| with_force([0.1, 0.0])),
    },
    Row {
        name: "attractors",
        statement: "one that was removed again; one",
        absent: || crowd().build(),
        set_out: Some(|| with_attractor(false)),
        in_use: Some(|| with_attractor(true)),
    },
    Row {
        name: "damping",
        statement: "of one body; of all",
        absent: || crowd().build(),
        set_out: Some(|| Crowd { lone: |body| body.linear_damping(1.0), ..crowd() }.build()),
        in_use: Some(|| Crowd { body: |body, _| body.friction(0.4).linear_damping(0.01), ..crowd() }.build()),
    },
    Row {
        name: "restitution, impacts",
        statement: "of one body that meets nobody; of all",
        absent: || smooth_discs().build(),
        set_out: Some(|| Crowd { lone: |body| body.restitution(1.0), ..smooth_discs() }.build()),
        in_use: Some(|| {
            Crowd { body: |body, _| body.friction(0.0).restitution(0.1), ..smooth_discs() }.build()
        }),
    },
    Row {
        name: "friction",
        statement: "of one body that meets nobody; of all",
        absent: || smooth_discs().build(),
        set_out: Some(|| Crowd { lone: |body| body.friction(1.0), ..smooth_discs() }.build()),
        in_use: Some(|| Crowd { body: |body, _| body.friction(0.4), ..smooth_discs() }.build()),
    },
    Row {
        name: "rotation",
        statement: "of one body that meets nobody; of all",
        absent: || smooth_boxes().build(),
        set_out: Some(|| with_lone_disc(smooth_boxes())),
        in_use: Some(|| Crowd { shape: |_| Shape::obb(0.2, 0.2), ..smooth_boxes() }.build()),
    },
    Row {
        name: "sleep, nobody at rest",
        statement: "switched on",
        absent: || elastic_gas().build(),
        set_out: Some(|| with_settings(elastic_gas(), |settings| Settings { sleep: true, ..settings })),
        in_use: None,
    },
    Row {
        name: "others that sleep",
        statement: "600 boxes far off",
        absent: || with_gravity(falling().build()),
        set_out: Some(|| stacks(Settings::default(), 1000.0, Some(with_gravity(falling().build())))),
        in_use: None,
    },
    Row {
        name: "sleep, all at rest",
        statement: "switched on, 600 boxes",
        absent: || stacks(Settings { sleep: false, ..Settings::default() }, 0.0, None),
        set_out: None,
        in_use: Some(|| stacks(Settings::default(), 0.0, None)),
    },
    Row {
        name: "direct solve",
        statement: "switched on, no great load",
        absent: || stacks(Settings { sleep: false, adaptive: false, ..Settings::default() }, 0.0, None),
        set_out: Some(|| stacks(Settings { sleep: false, ..Settings::default() }, 0.0, None)),
        in_use: None,
    },
    Row {
        name: "bounds",
        statement: "far around",
        absent: || crowd().build(),
        set_out: Some(|| with_settings(crowd(), |settings| Settings { bounds: Some(FAR), ..settings })),
        in_use: None,
    },
    Row {
        name: "hit events",
        statement: "of hits faster than there are; of all",
        absent: || crowd().build(),
        set_out: Some(|| with_settings(crowd(), |settings| Settings { hit_threshold: 100.0, ..settings })),
        in_use: Some(|| with_settings(crowd(), |settings| Settings { hit_threshold: 0.0, ..settings })),
    },
    Row {
        name: "clock of the profile",
        statement: "given and taken away; given",
        absent: || crowd().build(),
        set_out: Some(|| with_clock(None)),
        in_use: Some(|| with_clock(Some(Clock::new(clock)))),
    },
    Row {
        name: "fixed bodies",
        statement: "5000 far off",
        absent: || crowd().build(),
        set_out: Some(with_distant_ground),
        in_use: None,
    },
    Row {
        name: "kinematic bodies",
        statement: "one at rest; one that turns",
        absent: || crowd().build(),
        set_out: Some(|| with_kinematic(0.0)),
        in_use: Some(|| with_kinematic(1.0)),
    },
];

fn general(crowd: Crowd) -> World {
    let mut world = crowd.build();
    world.use_general_kernels();
    world
}

fn rough_discs() -> Crowd {
    Crowd { body: |body, _| body.friction(0.4), ..smooth_discs() }
}

fn rough_boxes() -> Crowd {
    Crowd { body: |body, _| body.friction(0.4), ..smooth_boxes() }
}

fn turning_boxes() -> Crowd {
    Crowd { shape: |_| Shape::obb(0.2, 0.2), ..rough_boxes() }
}

/// What kernels leave out.
pub(crate) const KERNELS: &[Kernel] = &[
    Kernel {
        name: "discs without friction",
        statement: "second point, friction",
        general: || general(smooth_discs()),
        fitted: || smooth_discs().build(),
    },
    Kernel {
        name: "discs with friction",
        statement: "second point",
        general: || general(rough_discs()),
        fitted: || rough_discs().build(),
    },
    Kernel {
        name: "upright boxes without friction",
        statement: "friction, rotation",
        general: || general(smooth_boxes()),
        fitted: || smooth_boxes().build(),
    },
    Kernel {
        name: "upright boxes with friction",
        statement: "rotation",
        general: || general(rough_boxes()),
        fitted: || rough_boxes().build(),
    },
    Kernel {
        name: "boxes with friction that turn",
        statement: "nothing but what the kind of sweep does not ask for",
        general: || general(turning_boxes()),
        fitted: || turning_boxes().build(),
    },
];

fn in_lanes(lanes: Lanes) -> World {
    let crowd = crowd();
    Crowd { settings: Settings { lanes, ..crowd.settings.clone() }, ..crowd }.build()
}

/// Ten boxes in five towers of two. A box is in one contact below and at most one above: five are solved at a time, those
/// with the floor and those between boxes.
fn towers(lanes: Lanes) -> World {
    let mut world =
        with_gravity(World::new(Settings { lanes, sleep: false, adaptive: false, ..Settings::default() }));
    put(&mut world, Body::fixed(Shape::aabb(20.0, 1.0)).at([0.0, -0.5]));
    for index in 0..10_i16 {
        let place = [1.5 * f32::from(index % 5 - 2), 0.5 + f32::from(index / 5)];
        put(&mut world, Body::dynamic(Shape::obb(1.0, 1.0)).at(place));
    }
    world
}

/// Widths of lanes, one first, in a small world.
pub(crate) const FEW_LANES: &[(&str, Build)] = &[
    ("towers: one", || towers(Lanes::One)),
    ("towers: four", || towers(Lanes::Four)),
    ("towers: eight", || towers(Lanes::Eight)),
    ("towers: sixteen", || towers(Lanes::Sixteen)),
    ("towers: found at run time", || towers(Lanes::Auto)),
];

/// Widths of lanes, one first.
pub(crate) const LANES: &[(&str, Build)] = &[
    ("one", || in_lanes(Lanes::One)),
    ("four", || in_lanes(Lanes::Four)),
    ("eight", || in_lanes(Lanes::Eight)),
    ("sixteen", || in_lanes(Lanes::Sixteen)),
    ("found at run time", || in_lanes(Lanes::Auto)),
];
