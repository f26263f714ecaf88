//! Bodies: what `World::add` refuses, and every setter.

use rustycs::prelude::*;

use super::{NOT_NUMBERS, assert_refused, refusal};

const BEYOND: [f32; 2] = [1e30, -1e30];

fn crate_() -> Body {
    Body::dynamic(Shape::obb(1.0, 1.0)).at([3.0, 3.0])
}

#[track_caller]
fn assert_add_refused(what: &str, quantity: &str, body: Body) {
    assert_refused(what, quantity, |world, _| world.add(body).err());
}

/// A field of the description: its name in the error, how to set it, and what is bad for it beside what is no
/// number at all.
type Field = (&'static str, fn(f32) -> Body, &'static [f32]);

#[test]
fn add_refuses_every_number_it_cannot_compute_with() {
    let fields: [Field; 15] = [
        ("x of the position", |v| crate_().at([v, 0.0]), &BEYOND),
        ("y of the position", |v| crate_().at([0.0, v]), &BEYOND),
        ("angle", |v| crate_().angle(v), &BEYOND),
        ("velocity", |v| crate_().velocity([v, 0.0]), &BEYOND),
        ("velocity", |v| crate_().velocity([0.0, v]), &BEYOND),
        ("angular velocity", |v| crate_().angular_velocity(v), &BEYOND),
        ("density", |v| crate_().density(v), &[0.0, -0.0, -1.0, 1e30]),
        ("friction", |v| crate_().friction(v), &[-0.1, 1e30]),
        ("restitution", |v| crate_().restitution(v), &[-0.1, 1.1]),
        ("mass", |v| crate_().mass(v), &[0.0, -0.0, -1.0, 1e30]),
        ("gravity scale", |v| crate_().gravity_scale(v), &BEYOND),
        ("linear damping", |v| crate_().linear_damping(v), &[-0.1, 1e30]),
        ("angular damping", |v| crate_().angular_damping(v), &[-0.1, 1e30]),
        ("density", |v| crate_().material(Material { density: v, ..Material::STONE }), &[0.0]),
        ("friction", |v| crate_().material(Material { friction: v, ..Material::STONE }), &[-1.0]),
    ];
    for (quantity, describe, others) in fields {
        for &value in NOT_NUMBERS.iter().chain(others) {
            assert_add_refused(&format!("{quantity} {value}"), quantity, describe(value));
        }
    }
    for value in [f64::NAN, f64::INFINITY, 1.1e12] {
        assert_add_refused("an f64 too far", "position", crate_().at([value, 0.0]));
    }
}

#[test]
fn a_dynamic_body_with_a_segment_is_refused_also_later() {
    let line = Shape::segment([-1.0, 0.0], [1.0, 0.0]);
    let refused = Err(BodyError::DynamicSegment);
    let mut world = World::new(Settings::default());
    assert_eq!(world.add(Body::dynamic(line).mass(1.0)), refused);
    assert_eq!(world.add(crate_().with(Collider::new(line))), refused);
    let [fixed, moved] = [Body::fixed(line), crate_()].map(|body| world.add(body).unwrap());
    let hash = world.state_hash();
    assert_eq!(world.body_mut(fixed).unwrap().set_body_type(BodyType::Dynamic).map(|()| moved), refused);
    assert_eq!(world.body_mut(moved).unwrap().set_shape(line).map(|()| moved), refused);
    assert_eq!(world.state_hash(), hash);
    let text = BodyError::DynamicSegment.to_string();
    assert!(text.starts_with("a segment has no thickness and no mass"), "{text}");
    assert!(Mover::new(Character::new(line)).is_err());
}

/// A shape one of whose lengths is given.
type OfLength = fn(f32) -> Shape;

#[test]
fn add_refuses_sizes_that_are_none() {
    let shapes: [(&str, OfLength); 5] = [
        ("radius", Shape::circle),
        ("width", |v| Shape::aabb(v, 1.0)),
        ("height", |v| Shape::aabb(1.0, v)),
        ("width", |v| Shape::obb(v, 1.0)),
        ("height", |v| Shape::obb(1.0, v)),
    ];
    for (quantity, shape) in shapes {
        for value in NOT_NUMBERS.into_iter().chain([0.0, -0.0, -1.0, 1e-6, 1e9]) {
            for body in [Body::dynamic, Body::fixed, Body::kinematic] {
                assert_add_refused(&format!("{quantity} {value}"), quantity, body(shape(value)));
            }
        }
    }
}

/// A density that is allowed with a size that is allowed may still weigh nothing, or too much.
#[test]
fn add_refuses_products_out_of_range() {
    let speck = || Body::dynamic(Shape::circle(1e-5));
    assert_add_refused("a speck of nothing", "mass", speck().density(1e-12));
    assert_add_refused("a speck of air", "mass", speck().density(1e-3));
    assert_add_refused("a heavy moon", "mass", Body::dynamic(Shape::circle(1e8)).density(1e12));
    assert_add_refused("a long wire", "inertia", Body::dynamic(Shape::obb(1e8, 1.0)).mass(1e15));
    assert_add_refused("a tiny wheel", "inertia", speck().mass(1e-9));
}

/// The bounds that the errors name are in range themselves.
#[test]
fn the_bounds_named_by_errors_are_accepted() {
    let mut world = World::new(Settings::default());
    for body in [
        crate_().at([1e12, -1e12]).angle(1e18).velocity([1e18, -1e18]).angular_velocity(-1e18),
        crate_().mass(1e-12),
        crate_().mass(1e15),
        crate_().density(1e-12),
        crate_().density(1e12),
        crate_().friction(0.0).restitution(0.0),
        crate_().friction(1e6).restitution(1.0).gravity_scale(-1e6).linear_damping(1e6).angular_damping(1e6),
    ] {
        world.add(body).unwrap();
    }
    world.step();
    world.validate().unwrap();
}

/// An error shows the number as it was written.
#[test]
fn errors_show_numbers_as_they_were_written() {
    let mut world = World::new(Settings::default());
    let error = world.add(crate_().friction(-0.1)).unwrap_err();
    let expected = "the friction is -0.1; give a finite number from 0 to 1e6";
    assert_eq!(error.to_string(), expected);
    let error = world.add(crate_().velocity([f32::INFINITY, 0.0])).unwrap_err();
    assert_eq!(error.to_string(), "the velocity is inf m/s; give a finite number from -1e18 to 1e18 m/s");
    let error = World::try_new(Settings { tick_rate: 1e30, ..Settings::default() }).unwrap_err();
    assert_eq!(error.to_string(), "Settings::tick_rate is 1e30; give a number from 0.1 to 1e6");
    let error = World::try_new(Settings { substeps: 0, ..Settings::default() }).unwrap_err();
    assert_eq!(error.to_string(), "Settings::substeps is 0; give a number from 1 to 256");
}

/// A number that a body of its kind ignores is refused all the same, if it is none.
#[test]
fn what_is_ignored_is_checked_as_well() {
    let (fixed, shape) = (Body::fixed, Shape::rectangle(1.0, 1.0));
    for (quantity, body) in [
        ("velocity", fixed(shape).velocity([f32::NAN, 0.0])),
        ("angular velocity", fixed(shape).angular_velocity(f32::INFINITY)),
        ("mass", fixed(shape).mass(-1.0)),
        ("mass", fixed(shape).mass(f32::NAN)),
        ("density", fixed(shape).density(-1.0)),
        ("gravity scale", fixed(shape).gravity_scale(f32::NAN)),
        ("angle", fixed(Shape::aabb(1.0, 1.0)).angle(f32::NAN)),
        ("mass", Body::kinematic(shape).mass(0.0)),
    ] {
        assert_add_refused("of a body that ignores it", quantity, body);
    }
}

/// The mass of what nothing moves is no matter: a planet may be a floor, and a wall weigh nothing.
#[test]
fn fixed_and_kinematic_bodies_may_weigh_anything() {
    let mut world = World::new(Settings::default());
    for body in [Body::fixed, Body::kinematic] {
        world.add(body(Shape::circle(1e8)).density(1e12)).unwrap();
        let id = world.add(body(Shape::circle(1.0)).density(0.0)).unwrap();
        let error = world.body_mut(id).unwrap().set_body_type(BodyType::Dynamic).unwrap_err();
        let expected = "the density is 0 kg/m²; give a finite number from 1e-12 to 1e12 kg/m²";
        assert_eq!(error.to_string(), expected);
    }
    world.step();
    world.validate().unwrap();
}

type Setter = fn(&mut BodyMut<'_>, f32) -> Result<(), BodyError>;

#[test]
fn setters_refuse_every_number_they_cannot_compute_with() {
    let setters: [(&str, Setter, &[f32]); 21] = [
        ("x of the position", |body, v| body.set_position([v, 0.0]), &BEYOND),
        ("y of the position", |body, v| body.set_position([0.0, v]), &BEYOND),
        ("angle", |body, v| body.set_angle(v), &BEYOND),
        ("position", |body, v| body.set_pose(Pose::at([v, 0.0])), &BEYOND),
        ("rotation", |body, v| body.set_pose(turned(v)), &[0.0, 1.1, 1e30]),
        ("friction", |body, v| body.set_friction(v), &[-0.1, 1e30]),
        ("restitution", |body, v| body.set_restitution(v), &[-0.1, 1.1]),
        ("density", |body, v| body.set_density(v), &[0.0, -1.0, 1e30]),
        ("density", |body, v| body.set_material(Material { density: v, ..Material::STONE }), &[0.0]),
        ("friction", |body, v| body.set_material(Material { friction: v, ..Material::STONE }), &[-1.0]),
        ("mass", |body, v| body.set_mass(v), &[0.0, -0.0, -1.0, 1e30]),
        ("radius", |body, v| body.set_shape(Shape::circle(v)), &[0.0, -1.0, 1e9]),
        ("width", |body, v| body.set_shape(Shape::obb(v, 1.0)), &[0.0, 1e9]),
        ("inertia", |body, _| body.set_shape(Shape::circle(1e-5)), &[]),
        ("mass", |body, _| body.set_shape(Shape::circle(1e8)), &[]),
        ("gravity scale", |body, v| body.set_gravity_scale(v), &BEYOND),
        ("linear damping", |body, v| body.set_linear_damping(v), &[-0.1, 1e30]),
        ("angular damping", |body, v| body.set_angular_damping(v), &[-0.1, 1e30]),
        ("position", |body, v| body.set_position([1e13 + f64::from(v), 0.0]), &[0.0]),
        ("position", |body, v| body.set_pose(Pose::at([0.0, -1e13 + f64::from(v)])), &[0.0]),
        ("height", |body, v| body.set_shape(Shape::aabb(1.0, v)), &[0.0, -1.0]),
    ];
    for (quantity, set, others) in setters {
        for &value in NOT_NUMBERS.iter().chain(others) {
            assert_refused(&format!("{quantity} {value}"), quantity, |world, id| {
                set(&mut world.body_mut(id).unwrap(), value).err()
            });
        }
    }
}

/// What a game does to a body every frame.
type Push = fn(&mut BodyMut<'_>, f32);

#[test]
fn what_is_done_every_frame_refuses_every_number_it_cannot_compute_with() {
    let pushes: [(&str, Push, &[f32]); 14] = [
        ("velocity", |body, v| _ = body.set_velocity([v, 0.0]), &BEYOND),
        ("velocity", |body, v| _ = body.set_velocity([0.0, v]), &BEYOND),
        ("angular velocity", |body, v| _ = body.set_angular_velocity(v), &BEYOND),
        ("impulse", |body, v| _ = body.apply_impulse([v, 0.0]), &BEYOND),
        ("impulse", |body, v| _ = body.apply_impulse([0.0, v]), &BEYOND),
        ("impulse", |body, v| _ = body.apply_impulse_at([v, 0.0], [0.0, 0.0]), &BEYOND),
        ("position", |body, v| _ = body.apply_impulse_at([1.0, 0.0], [v, 0.0]), &BEYOND),
        ("angular impulse", |body, v| _ = body.apply_angular_impulse(v), &BEYOND),
        ("force", |body, v| _ = body.apply_force([v, 0.0]), &BEYOND),
        ("force", |body, v| _ = body.apply_force([0.0, v]), &BEYOND),
        ("force", |body, v| _ = body.apply_force_at([v, 0.0], [0.0, 0.0]), &BEYOND),
        ("position", |body, v| _ = body.apply_force_at([1.0, 0.0], [0.0, v]), &BEYOND),
        ("torque", |body, v| _ = body.apply_torque(v), &BEYOND),
        ("pose", |body, v| _ = body.move_to(turned(v)), &[1.0]),
    ];
    for (quantity, push, others) in pushes {
        for &value in NOT_NUMBERS.iter().chain(others) {
            assert_refused(&format!("{quantity} {value}"), quantity, |world, id| {
                refusal(world, id, |body| push(body, value))
            });
        }
    }
}

/// A pose whose rotation is one only if `c` is 1.
fn turned(c: f32) -> Pose {
    Pose { center: Point::ORIGIN, rotation: Rot { c, s: 0.0 } }
}

/// A refused change does not even wake the body.
#[test]
fn a_refused_change_wakes_nothing() {
    let (mut world, id) = super::lived_in();
    for _ in 0..600 {
        world.step();
    }
    assert!(world.body(id).unwrap().is_sleeping());
    let mut body = world.body_mut(id).unwrap();
    assert!(body.set_position([f32::NAN, 0.0]).is_err() && body.set_friction(-1.0).is_err());
    assert!(body.set_mass(-1.0).is_err() && body.set_shape(Shape::circle(0.0)).is_err());
    assert!(refusal(&mut world, id, |body| _ = body.set_velocity([f32::NAN, 0.0])).is_some());
    assert!(refusal(&mut world, id, |body| _ = body.apply_force([f32::NAN, 0.0])).is_some());
    assert!(world.body(id).unwrap().is_sleeping());
}

/// Any finite angle is a direction, however many turns it is.
#[test]
fn an_angle_of_any_size_is_a_rotation() {
    for angle in [0.0_f32, 1e3, -1e6, 1e9, 1e12, -1e16, 1e18] {
        let mut world = World::new(Settings::default());
        let id = world.add(Body::fixed(Shape::obb(1.0, 1.0)).angle(angle)).unwrap();
        let Rot { c, s } = world.body(id).unwrap().rotation();
        assert!((c * c + s * s - 1.0).abs() < 1e-6, "{angle}: ({c}, {s})");
        let size = world.body(id).unwrap().aabb().size();
        assert!(size.x < 1.415 && size.y < 1.415, "{angle}: {size:?}");
        assert_eq!(world.body_mut(id).unwrap().set_angle(angle), Ok(()));
    }
}
