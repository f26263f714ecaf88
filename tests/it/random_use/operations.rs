//! What can be done to a world, and a player that does it.

use proptest::prelude::*;
use rustycs::prelude::*;

use super::roles::{RoleChange, change_role, role_change};
use super::values::{
    attractor, body, coordinate, coordinate_near, extreme_body, extreme_settings, factor, great_strength,
    magnitude, narrow, place, settings, strength, usual_body, vector,
};

/// One use of the API. Bodies, forces and attractors are named by a number, modulo how many there were.
#[derive(Clone, Debug)]
pub(crate) enum Operation {
    Add(Body),
    /// Several copies of a body in one point.
    AddPile(Body, u8),
    Remove(usize),
    Change(usize, Change),
    Role(usize, RoleChange),
    AddForce([f32; 2]),
    RemoveForce(usize),
    AddAttractor(Attractor),
    ReplaceAttractor(usize, Attractor),
    RemoveAttractor(usize),
    Set(Settings),
    Step(u8),
    Advance(f32),
    /// Goes on with a clone, which has no room but for what it holds.
    Clone,
    /// Goes on with the world of the last such time, into which this one is cloned.
    CloneFrom,
    WakeAll,
    Ask([f64; 2], [f32; 2]),
}

/// A change to one body.
#[derive(Clone, Debug)]
pub(crate) enum Change {
    Position([f64; 2]),
    Angle(f32),
    Pose([f64; 2], f32),
    Velocity([f32; 2]),
    Spin(f32),
    Impulse([f32; 2], [f64; 2]),
    AngularImpulse(f32),
    Force([f32; 2], [f64; 2]),
    Torque(f32),
    QuietPush([f32; 2], [f32; 2]),
    MoveTo([f64; 2], f32),
    Surface(f32, f32),
    GravityScale(f32),
    Damping(f32, f32),
    Type(BodyType),
    Mass(Option<f32>),
    /// Shape, material and fixed rotation of another body.
    Likeness(Box<Body>),
    Sleep,
    Wake,
}

fn change() -> impl Strategy<Value = Change> {
    prop_oneof![
        place().prop_map(Change::Position),
        strength().prop_map(Change::Angle),
        vector().prop_map(Change::Velocity),
        strength().prop_map(Change::Spin),
        (vector(), place()).prop_map(|(impulse, at)| Change::Impulse(impulse, at)),
        strength().prop_map(Change::AngularImpulse),
        (vector(), place()).prop_map(|(force, at)| Change::Force(force, at)),
        strength().prop_map(Change::Torque),
        (factor(), narrow(0.0, 1.0))
            .prop_map(|(friction, restitution)| Change::Surface(friction, restitution)),
        factor().prop_map(|scale| Change::GravityScale(-scale)),
        (factor(), factor()).prop_map(|(linear, angular)| Change::Damping(linear, angular)),
        (place(), narrow(-7.0, 7.0)).prop_map(|(at, angle)| Change::Pose(at, angle)),
        (vector(), vector()).prop_map(|(force, impulse)| Change::QuietPush(force, impulse)),
        (place(), narrow(-7.0, 7.0)).prop_map(|(at, angle)| Change::MoveTo(at, angle)),
        become_another(body()),
        become_another(body()),
        Just(Change::Wake),
    ]
}

/// Another type, mass or shape, or sleep.
fn become_another(bodies: impl Strategy<Value = Body>) -> impl Strategy<Value = Change> {
    let body_type = prop_oneof![
        2 => Just(BodyType::Dynamic),
        1 => Just(BodyType::Fixed),
        1 => Just(BodyType::Kinematic),
    ];
    prop_oneof![
        2 => body_type.prop_map(Change::Type),
        1 => prop_oneof![1 => Just(None), 2 => magnitude(-3.0, 3.0).prop_map(Some)].prop_map(Change::Mass),
        2 => bodies.prop_map(|body| Change::Likeness(Box::new(body))),
        1 => Just(Change::Sleep),
    ]
}

pub(crate) fn operation() -> impl Strategy<Value = Operation> {
    let acceleration = prop_oneof![narrow(-10.0, 10.0), narrow(-1e12, 1e12)];
    prop_oneof![
        10 => body().prop_map(Operation::Add),
        1 => (body(), 2_u8..6).prop_map(|(body, count)| Operation::AddPile(body, count)),
        3 => any::<usize>().prop_map(Operation::Remove),
        8 => (any::<usize>(), change()).prop_map(|(body, change)| Operation::Change(body, change)),
        2 => [acceleration.clone(), acceleration].prop_map(Operation::AddForce),
        1 => any::<usize>().prop_map(Operation::RemoveForce),
        1 => attractor().prop_map(Operation::AddAttractor),
        1 => (any::<usize>(), attractor()).prop_map(|(which, by)| Operation::ReplaceAttractor(which, by)),
        1 => any::<usize>().prop_map(Operation::RemoveAttractor),
        2 => settings().prop_map(Operation::Set),
        12 => (1_u8..5).prop_map(Operation::Step),
        1 => Just(Operation::Step(60)),
        1 => narrow(0.0, 0.1).prop_map(Operation::Advance),
        1 => Just(Operation::Clone),
        1 => Just(Operation::CloneFrom),
        1 => Just(Operation::WakeAll),
        2 => ([coordinate(), coordinate()], vector()).prop_map(|(at, along)| Operation::Ask(at, along)),
    ]
}

/// The same with filters, sensors, one-way floors and surfaces that move.
pub(crate) fn operation_with_roles() -> impl Strategy<Value = Operation> {
    prop_oneof![
        3 => operation(),
        1 => (any::<usize>(), role_change()).prop_map(|(body, change)| Operation::Role(body, change)),
    ]
}

/// What a game does, with these.
pub(crate) fn usual_operation_with_roles() -> impl Strategy<Value = Operation> {
    prop_oneof![
        2 => usual_operation(),
        1 => (any::<usize>(), role_change()).prop_map(|(body, change)| Operation::Role(body, change)),
    ]
}

/// The extremes of all that is accepted, with bodies of all sizes about one place.
pub(crate) fn extreme_operation(base: f64) -> impl Strategy<Value = Operation> {
    let acceleration = prop_oneof![narrow(-10.0, 10.0), narrow(-1e12, 1e12)];
    let push = prop_oneof![
        [great_strength(), great_strength()].prop_map(Change::Velocity),
        great_strength().prop_map(Change::Spin),
        [coordinate_near(base), coordinate_near(base)].prop_map(Change::Position),
        ([great_strength(), great_strength()], [coordinate_near(base), coordinate_near(base)])
            .prop_map(|(impulse, at)| Change::Impulse(impulse, at)),
        ([great_strength(), great_strength()], [coordinate_near(base), coordinate_near(base)])
            .prop_map(|(force, at)| Change::Force(force, at)),
        great_strength().prop_map(Change::Torque),
        factor().prop_map(|scale| Change::GravityScale(-scale)),
    ];
    prop_oneof![
        12 => extreme_body(base).prop_map(Operation::Add),
        2 => (extreme_body(base), 2_u8..6).prop_map(|(body, count)| Operation::AddPile(body, count)),
        1 => any::<usize>().prop_map(Operation::Remove),
        5 => (any::<usize>(), push).prop_map(|(body, change)| Operation::Change(body, change)),
        1 => [acceleration.clone(), acceleration].prop_map(Operation::AddForce),
        1 => (attractor(), coordinate_near(base)).prop_map(|(attractor, _)| Operation::AddAttractor(attractor)),
        1 => any::<usize>().prop_map(Operation::RemoveAttractor),
        3 => extreme_settings().prop_map(Operation::Set),
        8 => (1_u8..4).prop_map(Operation::Step),
        1 => Just(Operation::WakeAll),
    ]
}

/// What a game does: bodies come, go and are pushed, and the pile comes to rest in between.
pub(crate) fn usual_operation() -> impl Strategy<Value = Operation> {
    let push = prop_oneof![
        [narrow(-5.0, 5.0), narrow(0.0, 5.0)].prop_map(Change::Velocity),
        [narrow(-4.0, 4.0), narrow(0.0, 6.0)].prop_map(|[x, y]| Change::Position([x.into(), y.into()])),
        narrow(-3.0, 3.0).prop_map(Change::Angle),
        narrow(-10.0, 10.0).prop_map(Change::Torque),
        (factor(), narrow(0.0, 1.0))
            .prop_map(|(friction, restitution)| Change::Surface(friction, restitution)),
        become_another(usual_body()),
        become_another(usual_body()),
        ([narrow(-4.0, 4.0), narrow(0.0, 6.0)], narrow(-3.0, 3.0))
            .prop_map(|([x, y], angle)| Change::MoveTo([x.into(), y.into()], angle)),
        Just(Change::Wake),
    ];
    prop_oneof![
        6 => usual_body().prop_map(Operation::Add),
        2 => any::<usize>().prop_map(Operation::Remove),
        3 => (any::<usize>(), push).prop_map(|(body, change)| Operation::Change(body, change)),
        6 => (1_u8..30).prop_map(Operation::Step),
        2 => Just(Operation::Step(250)),
        1 => Just(Operation::Clone),
        1 => Just(Operation::CloneFrom),
    ]
}

/// A world and the ids that were ever given out for it.
pub(crate) struct Player {
    world: World,
    /// To clone it into.
    other: World,
    bodies: Vec<BodyId>,
    forces: Vec<ForceId>,
    attractors: Vec<AttractorId>,
    lanes: Lanes,
    threads: usize,
}

impl Player {
    pub(crate) fn new() -> Self {
        let mut world = World::new(Settings::default());
        let gravity = world.add_force(Force::EARTH_GRAVITY);
        let forces = vec![gravity];
        let other = World::default();
        Self {
            world,
            other,
            bodies: Vec::new(),
            forces,
            attractors: Vec::new(),
            lanes: Lanes::Auto,
            threads: 1,
        }
    }

    /// The same with contacts solved so many at a time, whatever settings are played.
    /// The same on so many threads, however little there is to do.
    pub(crate) fn with_threads(mut self, threads: usize) -> Self {
        self.threads = threads;
        self.world.divide_all_work();
        self.other.divide_all_work();
        self.world
            .set_settings(Settings { threads, ..self.world.settings().clone() })
            .expect("good settings");
        self
    }

    pub(crate) fn with_lanes(mut self, lanes: Lanes) -> Self {
        self.lanes = lanes;
        self.world.set_settings(Settings { lanes, ..self.world.settings().clone() }).expect("good settings");
        self
    }

    /// Every bit of the state, and how far the last step was from perfect.
    pub(crate) fn bits(&self) -> (u64, [u32; 2]) {
        let StepError { penetration, velocity_residual, .. } = self.world.error();
        (self.world.state_hash(), [penetration.to_bits(), velocity_residual.to_bits()])
    }

    /// With a floor and two walls that cannot be removed.
    pub(crate) fn in_a_pool() -> Self {
        let mut player = Self::new();
        for (at, size) in [([0.0, -2.0], [20.0, 4.0]), ([-7.0, 3.0], [4.0, 8.0]), ([7.0, 3.0], [4.0, 8.0])] {
            player.world.add(Body::fixed(Shape::aabb(size[0], size[1])).at(at)).expect("a good wall");
        }
        player
    }

    /// The tables agree, and every number that can be asked for is finite.
    pub(crate) fn check(&self) -> Result<(), String> {
        self.world.validate()?;
        let world = &self.world;
        let error = world.error();
        let (momentum, penetration) = (world.momentum(), error.penetration);
        let numbers = [world.energy(), world.angular_momentum(), f64::from(error.velocity_residual)];
        if !momentum.is_finite() || !penetration.is_finite() || !numbers.iter().all(|n| n.is_finite()) {
            return Err(format!("momentum {momentum:?}, {error:?}, energy, angular momentum: {numbers:?}"));
        }
        let Settings { max_speed, max_spin, .. } = *world.settings();
        for (id, body) in world.bodies() {
            let Vec2 { x, y } = body.velocity();
            let spin = body.angular_velocity();
            if x.abs().max(y.abs()) > max_speed || spin.abs() > max_spin {
                return Err(format!("{id:?} moves at ({x}, {y}) m/s and {spin} rad/s"));
            }
            if !body.position_f64().iter().all(|coordinate| coordinate.abs() <= 1e12) {
                return Err(format!("{id:?} is at {:?}", body.position_f64()));
            }
            let Rot { c, s } = body.rotation();
            if (c * c + s * s - 1.0).abs() > 1e-5 {
                return Err(format!("the rotation of {id:?} is ({c}, {s})"));
            }
        }
        for event in world.events().hits() {
            if !event.speed.is_finite() {
                return Err(format!("{event:?}"));
            }
        }
        Ok(())
    }

    pub(crate) fn play(&mut self, operation: &Operation) {
        let world = &mut self.world;
        match operation {
            Operation::Add(body) => self.bodies.extend(world.add(body.clone())),
            Operation::AddPile(body, count) => {
                self.bodies.extend((0..*count).filter_map(|_| world.add(body.clone()).ok()));
            }
            Operation::Remove(which) => {
                if let Some(body) = pick(&self.bodies, *which).and_then(|id| world.remove(id)) {
                    // What is given back can be added again, wherever it has flown to.
                    let again = world.clone().add(body.clone());
                    assert!(again.is_ok(), "{body:?}: {again:?}");
                }
            }
            Operation::Change(which, change) => {
                if let Some(body) = pick(&self.bodies, *which).and_then(|id| world.body_mut(id)) {
                    apply(body, change).expect("the numbers are within the limits");
                }
            }
            Operation::Role(which, change) => {
                if let Some(id) = pick(&self.bodies, *which) {
                    change_role(world, id, change, &self.bodies);
                }
            }
            Operation::AddForce(acceleration) => {
                self.forces.push(world.add_force(Force::new("push", *acceleration)));
            }
            Operation::RemoveForce(which) => {
                pick(&self.forces, *which).map(|id| world.remove_force(id));
            }
            Operation::AddAttractor(attractor) => {
                self.attractors.push(world.add_attractor(attractor.clone()));
            }
            Operation::ReplaceAttractor(which, by) => {
                pick(&self.attractors, *which).map(|id| world.replace_attractor(id, by.clone()));
            }
            Operation::RemoveAttractor(which) => {
                pick(&self.attractors, *which).map(|id| world.remove_attractor(id));
            }
            Operation::Set(settings) => {
                // A split kick without a relax sweep is refused.
                _ = world.set_settings(Settings {
                    lanes: self.lanes,
                    threads: self.threads,
                    ..settings.clone()
                });
            }
            Operation::Step(count) => (0..*count).for_each(|_| world.step()),
            Operation::Advance(seconds) => _ = world.advance(*seconds),
            Operation::Clone => {
                self.world = world.clone();
                self.world.shrink_to_fit();
            }
            Operation::CloneFrom => {
                self.other.clone_from(world);
                std::mem::swap(world, &mut self.other);
            }
            Operation::WakeAll => world.wake_all(),
            Operation::Ask(at, along) => ask(world, *at, *along),
        }
    }
}

fn pick<T: Copy>(all: &[T], which: usize) -> Option<T> {
    all.get(which % all.len().max(1)).copied()
}

fn apply(mut body: BodyMut<'_>, change: &Change) -> Result<(), BodyError> {
    match *change {
        Change::Position(at) => return body.set_position(at),
        Change::Angle(angle) => return body.set_angle(angle),
        Change::Pose(at, angle) => return body.set_pose(Pose::new(at, angle)),
        Change::Velocity(velocity) => _ = body.set_velocity(velocity),
        Change::Spin(spin) => _ = body.set_angular_velocity(spin),
        Change::Impulse(impulse, at) => _ = body.apply_impulse_at(impulse, at),
        Change::AngularImpulse(impulse) => _ = body.apply_angular_impulse(impulse),
        Change::Force(force, at) => _ = body.apply_force_at(force, at),
        Change::Torque(torque) => _ = body.apply_torque(torque),
        Change::QuietPush(force, impulse) => {
            _ = body.without_waking().apply_force(force).apply_impulse(impulse);
        }
        Change::MoveTo(at, angle) => {
            if body.body_type() == BodyType::Kinematic {
                body.move_to(Pose::new(at, angle));
            }
        }
        Change::Surface(friction, restitution) => {
            return body.set_friction(friction).and_then(|()| body.set_restitution(restitution));
        }
        Change::GravityScale(scale) => return body.set_gravity_scale(scale),
        Change::Damping(linear, angular) => {
            return body.set_linear_damping(linear).and_then(|()| body.set_angular_damping(angular));
        }
        // Another shape or mass, or to be dynamic, may be refused for what comes of it.
        Change::Type(body_type) => _ = body.set_body_type(body_type),
        Change::Mass(mass) => _ = body.set_mass(mass),
        Change::Likeness(ref other) => {
            _ = body.set_shape(*other.get_shape());
            _ = body.set_material(other.get_material());
            body.set_fixed_rotation(other.get_fixed_rotation());
        }
        Change::Sleep => _ = body.sleep(),
        Change::Wake => _ = body.wake(),
    }
    Ok(())
}

fn ask(world: &World, at: [f64; 2], along: [f32; 2]) {
    for id in world.bodies_at(at) {
        assert!(world.body(id).expect("found, so there").contains(at));
    }
    let corner = [at[0] + f64::from(along[0].abs()), at[1] + f64::from(along[1].abs())];
    assert!(world.bodies_in(at, corner).iter().all(|&id| world.body(id).is_some()));
    let (first, all) = (world.ray_cast(at, along), world.ray_cast_all(at, along));
    assert_eq!(first.map(|hit| hit.body), all.first().map(|hit| hit.body), "{first:?} {all:?}");
    for hit in all {
        assert!(hit.point.is_finite() && hit.normal.is_finite() && (0.0..=1.0).contains(&hit.fraction));
    }
}
