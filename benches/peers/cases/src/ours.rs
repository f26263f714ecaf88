//! rustycs.

use std::sync::LazyLock;
use std::time::Instant;

use rustycs::prelude::*;

use crate::engine::{Engine, Fineness, Simulation, State};
use crate::scene::{BodySpec, Kind, Outline, Pull, SOFTENING, Scene};

/// rustycs at its defaults, with the mixing rules of Box2D.
#[derive(Debug, Default)]
pub struct Rustycs {
    /// Whether it reads a clock between the stages of a step, which takes time too.
    pub times_stages: bool,
    /// Whether continuous collision is switched off.
    pub is_discrete: bool,
}

/// Seconds since the first call.
fn clock() -> f64 {
    static START: LazyLock<Instant> = LazyLock::new(Instant::now);
    START.elapsed().as_secs_f64()
}

impl Engine for Rustycs {
    fn name(&self) -> &'static str {
        if self.is_discrete { "rustycs, off" } else { "rustycs" }
    }

    fn version(&self) -> String {
        format!("rustycs {}, f32 with centres in f64", env!("CARGO_PKG_VERSION"))
    }

    fn simulate(&self, scene: &Scene, fineness: Fineness) -> Box<dyn Simulation> {
        let settings = Settings {
            tick_rate: fineness.tick_rate as f32,
            substeps: fineness.substeps,
            sleep: scene.sleeps,
            continuous: !self.is_discrete,
            ..Settings::default()
        };
        let (mut world, bodies) = build(scene, &settings);
        world.set_clock(self.times_stages.then(|| Clock::new(clock)));
        Box::new(RustycsWorld { world, bodies })
    }
}

impl Rustycs {
    /// A world of the scene with some settings, but for the rules by which materials mix.
    ///
    /// # Panics
    /// If the engine does not take the settings or one of the bodies.
    #[must_use]
    pub fn world(scene: &Scene, settings: &Settings) -> World {
        build(scene, settings).0
    }
}

fn build(scene: &Scene, settings: &Settings) -> (World, Vec<BodyId>) {
    let mut world = World::new(Settings {
        friction_mix: Mix::GeometricMean,
        restitution_mix: Mix::Max,
        ..settings.clone()
    });
    if scene.gravity != [0.0; 2] {
        world.add_force(Force::new("gravity", scene.gravity.map(|g| g as f32)));
    }
    if let Some(Pull { center, strength }) = scene.pull {
        // The gravitational constant is 1 by default.
        let attractor = Attractor::global(center, strength as f32).with_min_distance(SOFTENING as f32);
        world.add_attractor(attractor.expect("the distance is one that attractors take"));
    }
    let add = |spec| world.add(body(spec)).unwrap_or_else(|error| panic!("{spec:?}: {error}"));
    let bodies = scene.bodies.iter().map(add).collect();
    (world, bodies)
}

fn body(spec: &BodySpec) -> Body {
    let shape = match &spec.outline {
        Outline::Circle { radius } => Shape::circle(*radius as f32),
        Outline::Box { width, height } => Shape::obb(*width as f32, *height as f32),
        Outline::Polygon(corners) => Shape::polygon(corners.iter().map(|corner| corner.map(|x| x as f32)))
            .unwrap_or_else(|error| panic!("{spec:?}: {error}")),
    };
    let body = match spec.kind {
        Kind::Fixed => Body::fixed(shape),
        Kind::Kinematic => Body::kinematic(shape),
        Kind::Dynamic => Body::dynamic(shape),
    };
    body.at(spec.position)
        .angle(spec.angle as f32)
        .velocity(spec.velocity.map(|v| v as f32))
        .angular_velocity(spec.spin as f32)
        .density(spec.density as f32)
        .friction(spec.friction as f32)
        .restitution(spec.restitution as f32)
        // As the others have.
        .rolling_resistance(0.0)
        .angular_damping(spec.angular_damping as f32)
}

#[derive(Debug)]
struct RustycsWorld {
    world: World,
    bodies: Vec<BodyId>,
}

impl RustycsWorld {
    fn body(&self, index: usize) -> BodyRef<'_> {
        self.world.body(self.bodies[index]).expect("nobody removes a body")
    }
}

impl Simulation for RustycsWorld {
    fn step(&mut self) {
        self.world.step();
    }

    fn state(&self, body: usize) -> State {
        let body = self.body(body);
        let velocity = body.velocity();
        State {
            position: body.position_f64(),
            angle: f64::from(body.angle()),
            velocity: [velocity.x, velocity.y].map(f64::from),
            spin: f64::from(body.angular_velocity()),
        }
    }

    fn set_velocity(&mut self, body: usize, velocity: [f64; 2]) {
        let mut body = self.world.body_mut(self.bodies[body]).expect("nobody removes a body");
        body.set_velocity(velocity.map(|v| v as f32));
    }

    fn mass(&self, body: usize) -> [f64; 2] {
        let body = self.body(body);
        [body.mass(), body.inertia()].map(f64::from)
    }

    fn contact_points(&self) -> usize {
        self.world.contacts().map(|contact| contact.points().len()).sum()
    }

    fn stages(&self) -> Vec<(&'static str, f64)> {
        let stages = self.world.profile().stages();
        stages.map(|(stage, report)| (stage.name(), report.seconds.unwrap_or(0.0))).collect()
    }
}
