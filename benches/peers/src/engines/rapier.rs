//! Rapier: the crate `rapier2d` with its default features.

use rapier2d::prelude::*;

use crate::engine::{Engine, Fineness, Simulation, State};
use crate::scene::{BodySpec, Kind, Outline, Pull, Scene};

/// Rapier at its defaults, with the mixing rules of Box2D.
#[derive(Debug, Default)]
pub(crate) struct Rapier {
    /// Whether all that moves is swept.
    pub(crate) has_ccd: bool,
}

impl Engine for Rapier {
    fn name(&self) -> &'static str {
        if self.has_ccd { "Rapier, CCD" } else { "Rapier" }
    }

    fn version(&self) -> String {
        format!("Rapier {}, default features, f32", env!("RAPIER_VERSION"))
    }

    fn simulate(&self, scene: &Scene, fineness: Fineness) -> Box<dyn Simulation> {
        let mut world = PhysicsWorld::new();
        world.gravity = vector(scene.gravity);
        world.integration_parameters.dt = (1.0 / fineness.tick_rate) as f32;
        world.integration_parameters.num_solver_iterations = fineness.substeps as usize;
        let insert = |spec| {
            world.insert(body(spec).can_sleep(scene.sleeps).ccd_enabled(self.has_ccd), collider(spec)).0
        };
        let bodies: Vec<_> = scene.bodies.iter().map(insert).collect();
        // Otherwise they have no mass before the first step.
        for &handle in &bodies {
            world.bodies[handle].recompute_mass_properties_from_colliders(&world.colliders);
        }
        Box::new(RapierWorld { world, bodies, pull: scene.pull })
    }
}

fn vector(v: [f64; 2]) -> Vector {
    Vector::from(v.map(|x| x as f32))
}

fn body(spec: &BodySpec) -> RigidBodyBuilder {
    let body = match spec.kind {
        Kind::Fixed => return RigidBodyBuilder::fixed().pose(pose(spec)),
        Kind::Kinematic => RigidBodyBuilder::kinematic_velocity_based(),
        Kind::Dynamic => RigidBodyBuilder::dynamic(),
    };
    body.pose(pose(spec))
        .linvel(vector(spec.velocity))
        .angvel(spec.spin as f32)
        .angular_damping(spec.angular_damping as f32)
}

fn pose(spec: &BodySpec) -> Pose {
    Pose::new(vector(spec.position), spec.angle as f32)
}

fn collider(spec: &BodySpec) -> ColliderBuilder {
    let collider = match &spec.outline {
        Outline::Circle { radius } => ColliderBuilder::ball(*radius as f32),
        Outline::Box { width, height } => {
            ColliderBuilder::cuboid((0.5 * width) as f32, (0.5 * height) as f32)
        }
        Outline::Polygon(corners) => {
            ColliderBuilder::convex_polyline(corners.iter().copied().map(vector).collect())
                .unwrap_or_else(|| panic!("Rapier takes no such polygon: {corners:?}"))
        }
    };
    collider
        .density(spec.density as f32)
        .friction(spec.friction as f32)
        .friction_combine_rule(CoefficientCombineRule::GeometricMean)
        .restitution(spec.restitution as f32)
        .restitution_combine_rule(CoefficientCombineRule::Max)
}

struct RapierWorld {
    world: PhysicsWorld,
    bodies: Vec<RigidBodyHandle>,
    pull: Option<Pull>,
}

impl RapierWorld {
    fn body(&self, index: usize) -> &RigidBody {
        &self.world.bodies[self.bodies[index]]
    }

    /// A force stays on a body until it is taken off again.
    fn apply_pull(&mut self, pull: Pull) {
        for &handle in &self.bodies {
            let body = &mut self.world.bodies[handle];
            if body.is_dynamic() {
                let center: [f32; 2] = body.center_of_mass().into();
                let force = vector(pull.acceleration(center.map(f64::from))) * body.mass();
                body.reset_forces(true);
                body.add_force(force, true);
            }
        }
    }
}

impl Simulation for RapierWorld {
    fn step(&mut self) {
        if let Some(pull) = self.pull {
            self.apply_pull(pull);
        }
        self.world.step();
    }

    fn state(&self, body: usize) -> State {
        let body = self.body(body);
        let numbers = |v: Vector| [v.x, v.y].map(f64::from);
        State {
            position: numbers(body.center_of_mass()),
            angle: f64::from(body.rotation().angle()),
            velocity: numbers(body.linvel()),
            spin: f64::from(body.angvel()),
        }
    }

    fn set_velocity(&mut self, body: usize, velocity: [f64; 2]) {
        self.world.bodies[self.bodies[body]].set_linvel(vector(velocity), true);
    }

    fn mass(&self, body: usize) -> [f64; 2] {
        let body = self.body(body);
        if !body.is_dynamic() {
            return [f64::INFINITY; 2];
        }
        let properties = body.mass_properties().local_mprops;
        [properties.mass(), properties.principal_inertia()].map(f64::from)
    }

    fn contact_points(&self) -> usize {
        let manifolds = self.world.narrow_phase.contact_pairs().flat_map(ContactPair::manifolds);
        manifolds.map(|manifold| manifold.data.num_active_contacts()).sum()
    }
}
