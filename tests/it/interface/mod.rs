//! The public API as it is promised: every line of it compiles and does what it says.

mod change;
mod contacts;
mod draw;
mod edit;
mod frames;
mod hits;
mod time;

use rustycs::prelude::*;

use crate::support::{assert_near, assert_relative, place, velocity};

const POINTS: [[f32; 2]; 6] = [[1.0, 0.0], [0.5, 0.9], [-0.5, 0.9], [-1.0, 0.0], [-0.5, -0.9], [0.5, -0.9]];

/// A world can be sent to another thread, and an id costs no more where it may be missing.
#[test]
fn worlds_are_clone_and_send_and_optional_ids_are_free() {
    fn is_clone_and_send<T: Clone + Send + 'static>() {}
    is_clone_and_send::<World>();
    is_clone_and_send::<Body>();
    assert_eq!(size_of::<Option<BodyId>>(), size_of::<BodyId>());
    assert_eq!(size_of::<Option<ForceId>>(), size_of::<ForceId>());
    assert_eq!(size_of::<Option<AttractorId>>(), size_of::<AttractorId>());
    assert_eq!(size_of::<Vec2>(), 2 * size_of::<f32>());
}

/// The contract, read from the top.
#[test]
fn the_contract_compiles_and_does_what_it_says() -> Result<(), Box<dyn std::error::Error>> {
    let world = World::new(Settings::default());
    assert_eq!((world.settings().tick_rate, world.settings().substeps), (60.0, 4));
    assert_eq!((world.body_count(), world.acceleration()), (0, Vec2::ZERO));
    let mut world =
        World::new(Settings { tick_rate: 120.0, substeps: 8, sleep: false, ..Settings::default() });
    world.add_force(Force::EARTH_GRAVITY);
    assert_eq!(world.acceleration(), Vec2::new(0.0, -9.81));
    world.add_force(Force::new("wind", [2.0, 0.0]));
    assert_eq!(world.acceleration(), Vec2::new(2.0, -9.81));

    let floor = world.add(Body::fixed(Shape::aabb(20.0, 1.0)).at([0.0, -0.5]))?;
    let ball = world.add(Body::dynamic(Shape::circle(0.5)).at([0.0, 5.0]).material(Material::RUBBER))?;
    let crate_ = world.add(
        Body::dynamic(Shape::obb(1.0, 1.0))
            .at([3.0, 2.0])
            .angle(0.3)
            .velocity([1.0, 0.0])
            .angular_velocity(2.0),
    )?;
    let hexagon = Body::dynamic(Shape::polygon(POINTS)?).density(2.0).friction(0.4).restitution(0.1);
    let hexagon = world.add(hexagon.at([-5.0, 3.0]))?;
    let paddle = world.add(Body::kinematic(Shape::obb(4.0, 0.2)).angular_velocity(1.0).at([9.0, 9.0]))?;
    let mass = 10.0;
    let range = 3.0;
    world.add_attractor(Attractor::global([0.0, 100.0], mass));
    world.add_attractor(Attractor::local([5.0, 50.0], mass, range));

    world.step();
    let body = world.body(crate_).unwrap();
    let tick = 1.0 / 120.0;
    assert_near(body.position_f64()[0], 3.0 + tick, 1e-3, "x after a tick");
    assert_near(f64::from(body.angle()), 0.3 + 2.0 * tick, 1e-6, "angle after a tick");
    assert_near(f64::from(body.velocity().y), -9.81 * tick, 1e-4, "vy after a tick");
    assert_eq!((body.angular_velocity(), body.body_type()), (2.0, BodyType::Dynamic));
    assert_eq!(body.position(), Point::from(body.position_f64()).to_vec2());
    assert_relative(f64::from(body.mass()), 0.1, 1e-6, "density × area");
    assert_relative(f64::from(body.inertia()), 0.1 / 6.0, 1e-6, "m (w² + h²) / 12");
    assert_eq!(body.shape(), &Shape::obb(1.0, 1.0));
    let width = 0.3_f64.cos() + 0.3_f64.sin();
    assert_near(f64::from(body.aabb().size().x), width, 0.02, "width of the box around it");
    assert_near(f64::from(world.body(paddle).unwrap().angle()), tick, 1e-6, "the paddle turns as told");
    assert_eq!(world.body(floor).unwrap().mass(), f32::INFINITY);

    act_on_bodies(&mut world, [floor, ball, crate_, paddle], hexagon)?;
    let fork = world.clone();
    assert_eq!(fork.state_hash(), world.state_hash());
    Ok(())
}

/// The second half of the contract: what is done to bodies, and asked of the world.
fn act_on_bodies(world: &mut World, kept: [BodyId; 4], hexagon: BodyId) -> Result<(), BodyError> {
    let ball = kept[1];
    let ticks = world.advance(0.1);
    assert_eq!((ticks, world.ticks()), (8, 9));
    let mut b = world.body_mut(ball).unwrap();
    b.set_velocity([0.0, 1.0]);
    b.apply_impulse([1.0, 0.0]);
    b.apply_force([0.0, 1.0]);
    b.apply_torque(0.1);
    b.set_position([0.0, 6.0])?;
    assert_eq!(place(world, ball), [0.0, 6.0]);
    let ball_mass = f64::from(world.body(ball).unwrap().mass());
    assert_relative(velocity(world, ball)[0], 1.0 / ball_mass, 1e-6, "impulse / mass");

    assert!(world.remove(hexagon).is_some_and(|body| body != Body::dynamic(Shape::circle(0.5))));
    assert!(world.body(hexagon).is_none() && world.body(ball).is_some());
    let listed: Vec<BodyId> = world.bodies().map(|(id, body)| (id, body).0).collect();
    assert_eq!(listed, kept);
    for contact in world.contacts() {
        assert_ne!(contact.a(), contact.b());
    }
    assert!(world.energy() > 0.0 && world.momentum().is_finite() && world.angular_momentum().is_finite());
    assert!(world.error().penetration >= 0.0 && world.error().velocity_residual >= 0.0);
    Ok(())
}

/// Detection without a world.
#[test]
fn detect_needs_no_world() {
    let (shape_a, shape_b) = (Shape::aabb(2.0, 2.0), Shape::circle(0.5));
    let (pose_a, pose_b) = (Pose::at([0.0, 0.0]), Pose::at([0.0, 1.25]));
    let m: Option<Manifold> = rustycs::collision::detect(&shape_a, pose_a, &shape_b, pose_b);
    let m = m.expect("they overlap");
    assert_eq!((m.normal, m.points().len(), m.points()[0].separation), (Vec2::new(0.0, 1.0), 1, -0.25));
    assert_eq!(rustycs::collision::detect(&shape_a, pose_a, &shape_b, Pose::at([0.0, 1.75])), None);
}

#[test]
fn materials_have_the_promised_constants() {
    let expected = [
        (Material::DEFAULT, [0.1, 0.6, 0.5]),
        (Material::RUBBER, [0.9, 0.8, 0.6]),
        (Material::PLASTIC, [1.2, 0.6, 0.5]),
        (Material::STONE, [2.5, 0.4, 0.2]),
        (Material::METAL, [7.8, 0.2, 0.1]),
    ];
    for (Material { density, friction, restitution }, numbers) in expected {
        assert_eq!([density, friction, restitution], numbers);
    }
    assert_eq!(Material::default(), Material::DEFAULT);
}

type Rule = fn(f32, f32) -> f32;

/// The rules, and that contacts use the one of the settings, also when it is changed in flight.
#[test]
fn coefficients_mix_by_the_rule_of_the_settings() {
    let rules: [(Mix, Rule); 5] = [
        (Mix::Average, |a, b| 0.5 * (a + b)),
        (Mix::GeometricMean, |a, b| (a * b).sqrt()),
        (Mix::Min, f32::min),
        (Mix::Max, f32::max),
        (Mix::Multiply, |a, b| a * b),
    ];
    for mix in [Mix::Average, Mix::GeometricMean, Mix::Min, Mix::Multiply] {
        assert_eq!([mix.mix(0.0, 0.6), mix.mix(0.6, 0.0)], [0.0; 2], "{mix:?} keeps nothing at nothing");
    }
    assert_eq!(Settings::default().friction_mix, Mix::Average);
    assert_eq!(Settings::default().restitution_mix, Mix::Average);
    let mut world = World::new(Settings::default());
    world.add(Body::fixed(Shape::aabb(4.0, 1.0)).friction(0.9).restitution(0.25)).unwrap();
    let ball = Body::dynamic(Shape::circle(0.5)).at([0.0, 1.0]).friction(0.4).restitution(1.0);
    let ball = world.add(ball).unwrap();
    world.step();
    for (mix, rule) in rules {
        assert_eq!(mix.mix(0.9, 0.4), rule(0.9, 0.4), "{mix:?}");
        assert_eq!(mix.mix(0.4, 0.9), rule(0.9, 0.4), "{mix:?} does not mind the order");
        let settings = Settings { friction_mix: mix, restitution_mix: mix, ..Settings::default() };
        world.set_settings(settings).unwrap();
        let contact = world.contacts().next().unwrap();
        assert_eq!((contact.friction(), contact.restitution()), (rule(0.9, 0.4), rule(0.25, 1.0)), "{mix:?}");
    }
    world.set_settings(Settings::default()).unwrap();
    world.body_mut(ball).unwrap().set_friction(0.1).unwrap();
    world.body_mut(ball).unwrap().set_restitution(0.75).unwrap();
    let contact = world.contacts().next().unwrap();
    assert_eq!((contact.friction(), contact.restitution()), (0.5, 0.5));
}

/// Energy and momenta of one body in closed form.
#[test]
fn energy_and_momenta_are_those_of_the_textbook() {
    let mut world = World::new(Settings::default());
    world.add_force(Force::EARTH_GRAVITY);
    let body = Body::dynamic(Shape::obb(2.0, 1.0)).at([3.0, 4.0]).velocity([1.0, -2.0]).angular_velocity(3.0);
    let id = world.add(body.mass(2.0)).unwrap();
    let inertia = 2.0 * (4.0 + 1.0) / 12.0;
    assert_relative(world.kinetic_energy(), 0.5 * 2.0 * 5.0 + 0.5 * inertia * 9.0, 1e-6, "½mv² + ½Iw²");
    assert_relative(world.potential_energy(), 2.0 * 9.81 * 4.0, 1e-6, "mgh");
    let driven = world.add(Body::kinematic(Shape::circle(1.0)).velocity([7.0, 0.0])).unwrap();
    let of = |id| world.body(id).unwrap().kinetic_energy();
    assert_eq!((of(id), of(driven)), (world.kinetic_energy(), 0.0));
    assert_relative(world.energy(), world.kinetic_energy() + world.potential_energy(), 1e-12, "sum");
    assert_eq!(world.momentum(), Vec2::new(2.0, -4.0));
    let about_origin = 2.0 * (3.0 * -2.0 - 4.0) + inertia * 3.0;
    assert_relative(world.angular_momentum(), about_origin, 1e-6, "m x × v + I w");
}
