//! Adding, changing and removing joints; sleep, clones, and what is refused.

use rustycs::prelude::*;

use crate::support::{G, add, assert_near, earth, earth_with, place, run, space};

fn two_boxes(world: &mut World) -> [BodyId; 2] {
    [0.0, 0.8].map(|x| add(world, Body::dynamic(Shape::obb(1.0, 1.0)).at([x, 0.0])))
}

/// What a sentence names as a bound is accepted, though 10⁻⁶ is a little more than the `f32` next to it.
#[test]
fn the_bounds_of_what_is_accepted_are_accepted() {
    let mut world = space();
    let [a, b] = two_boxes(&mut world);
    let rod = world.add_joint(Joint::distance(a, b).length(1e-6)).unwrap();
    let mut rod = world.joint_mut(rod).unwrap();
    rod.set_spring(1e-6, 0.0).unwrap();
    rod.set_spring(1e6, 1e6).unwrap();
    rod.set_length(1e12).unwrap();
    assert!(rod.set_length(0.999e-6).is_err());
    world.add_joint(Joint::rope(a, b).max_length(1e-6)).unwrap();
}

/// A rope is as long as it is told, when it is added and later; no shorter than its least length, and a sentence names the bounds.
#[test]
fn the_length_of_a_rope_is_set() {
    let mut world = earth();
    let load = add(&mut world, Body::dynamic(Shape::circle(0.2)).at([0.0, -5.0]));
    let rope = world.add_joint(Joint::rope(load, None).between([0.0, -5.0], [0.0, 0.0])).unwrap();
    run(&mut world, 1.0);
    world.joint_mut(rope).unwrap().set_length(3.0).unwrap();
    assert_eq!(world.joint(rope).unwrap().length(), Some(3.0));
    run(&mut world, 2.0);
    assert_near(place(&world, load)[1], -3.0, 1e-6, "height of the load");
    let mut rope = world.joint_mut(rope).unwrap();
    rope.set_limits(2.0..=3.0).unwrap();
    assert_eq!(rope.set_length(1.0), Err(JointError::LimitsCrossed { lower: 2.0, upper: 1.0 }));
    let error = rope.set_length(1.1e12).unwrap_err().to_string();
    assert!(error.contains("from 1e-6 to 1e12 m"), "{error}");
}

#[test]
fn a_joint_that_makes_no_sense_is_refused_with_a_sentence_and_nothing_changes() {
    let mut world = earth();
    let [a, b] = two_boxes(&mut world);
    let gone = add(&mut world, Body::dynamic(Shape::circle(1.0)));
    world.remove(gone);
    let floor = add(&mut world, Body::fixed(Shape::rectangle(9.0, 1.0)).at([0.0, -9.0]));
    let lift = add(&mut world, Body::kinematic(Shape::rectangle(2.0, 0.2)).at([0.0, -5.0]));
    let bad = [
        (Joint::revolute(gone, b), "the first body of the joint has been removed"),
        (Joint::revolute(a, gone), "the second body of the joint has been removed"),
        (Joint::weld(a, a), "a joint cannot join a body to itself"),
        (Joint::revolute(a, b).limits(1.0..=-1.0), "the lower limit 1 is above the upper limit -1"),
        (Joint::revolute(a, b).at([f64::NAN, 0.0]), "the anchor is NaN"),
        (Joint::revolute(a, b).motor(f32::NAN, 1.0), "the speed of the motor is NaN"),
        (Joint::distance(a, b).length(-1.0), "the length is -1 m"),
        (Joint::rope(a, b).max_length(0.0), "the greatest length is 0 m; give a number of 1e-6 m or more"),
        (
            Joint::rope(a, b).break_at(-1.0, 0.0),
            "the force at which it breaks is -1 N; give a number of 0 N or more",
        ),
        (Joint::friction(a, b), "a friction joint without a greatest force or torque resists nothing"),
        (Joint::distance(a, b).spring(0.0, 0.0), "the frequency of the spring is 0 Hz"),
        (Joint::prismatic(a, b).axis([0.0, 0.0]), "the axis has no direction"),
        (
            Joint::weld(a, b).motor(1.0, 1.0),
            "a weld joint has no motor; leave it out, or take one of these kinds: revolute, prismatic, distance, wheel, ratchet",
        ),
        (
            Joint::prismatic(a, b).suspension(4.0, 0.7),
            "a prismatic joint has no suspension; leave it out, or take one of these kinds: wheel",
        ),
        (Joint::gear(a, b, 0.0), "the size of the ratio is 0"),
        (
            Joint::revolute(a, b).limits(0.0..=1e300),
            "the upper limit is 1e300 rad; give a finite number from -1e9 to 1e9 rad",
        ),
        (Joint::revolute(a, b).limits(-2e9..=0.0), "the lower limit is -2e9 rad; give a finite number"),
        (Joint::prismatic(a, b).limits(0.0..=1e13), "the upper limit is 1e13 m; give a finite number from"),
        (Joint::rope(a, b).max_length(1e13), "the greatest length is "),
        (Joint::prismatic(a, b).limits(NEVER), "the lower limit is inf m; give a number of 1e12 m or less"),
        (Joint::prismatic(a, b).limits(-f64::INFINITY..=-f64::INFINITY), "the upper limit is -inf m; give"),
        (
            Joint::revolute(a, None).limits(NEVER),
            "the lower limit is inf rad; give a number of 1e9 rad or less",
        ),
        (Joint::wheel(a, b).axis([0.0, 1.0]).travel(NEVER), "the lower limit is inf m; give"),
        (Joint::distance(a, b).limits(NEVER), "the least length is inf m; give a finite number from 0 to"),
        (Joint::prismatic(a, b).limits(f64::NAN..=1.0), "the lower limit is NaN m; give"),
        (Joint::weld(floor, lift), "a joint moves dynamic bodies only; give one that is dynamic"),
        (Joint::weld(lift, floor), "a joint moves dynamic bodies only; give one that is dynamic"),
        (Joint::drag(floor, [0.0, 0.0]), "a joint moves dynamic bodies only; give one that is dynamic"),
    ];
    let before = world.state_hash();
    for (joint, sentence) in bad {
        let error = world.add_joint(joint.clone()).expect_err(sentence).to_string();
        assert!(error.starts_with(sentence), "{error}, expected {sentence}");
    }
    assert_eq!((world.joint_count(), world.state_hash()), (0, before));
}

fn over_wheels(a: BodyId, b: BodyId) -> Joint {
    Joint::pulley(a, b, [-1.0, 5.0], [1.0, 5.0])
}

/// An option by its name, what gives it, and the kinds that have it.
type JointOption = (&'static str, fn(Joint) -> Joint, &'static [JointKind]);

/// All options of joints.
fn options() -> [JointOption; 21] {
    use JointKind::{
        Distance, Drag, Friction, Gear, Motor, Prismatic, Pulley, Ratchet, Revolute, Weld, Wheel,
    };
    const ALL: &[JointKind] =
        &[Revolute, Prismatic, Distance, Weld, Wheel, Motor, Drag, Friction, Gear, Ratchet, Pulley];
    const SPRINGS: &[JointKind] = &[Revolute, Prismatic, Distance, Wheel, Weld, Motor, Drag, Ratchet];
    [
        ("limits", |joint| joint.limits(0.0..=1.0), &[Revolute, Prismatic, Distance, Wheel]),
        ("travel", |joint| joint.travel(0.0..=1.0), &[Wheel]),
        ("greatest length", |joint| joint.max_length(1.0), &[Distance]),
        ("motor", |joint| joint.motor(1.0, 1.0), &[Revolute, Prismatic, Distance, Wheel, Ratchet]),
        ("spring", |joint| joint.spring(1.0, 1.0), SPRINGS),
        ("suspension", |joint| joint.suspension(1.0, 1.0), &[Wheel]),
        ("rest of its spring", |joint| joint.rest(0.5), &[Revolute, Prismatic, Wheel, Motor, Ratchet]),
        ("axis", |joint| joint.axis([1.0, 0.0]), &[Prismatic, Wheel]),
        ("length", |joint| joint.length(1.0), &[Distance, Pulley]),
        ("ratio", |joint| joint.ratio(2.0), &[Gear, Pulley]),
        ("target", |joint| joint.target([1.0, 0.0]), &[Drag]),
        ("greatest force", |joint| joint.max_force(1.0), &[Drag, Motor, Friction]),
        ("greatest torque", |joint| joint.max_torque(1.0), &[Motor, Friction]),
        ("place", |joint| joint.at([1.0, 0.0]), ALL),
        ("anchors", |joint| joint.anchors([1.0, 0.0], [0.0, 1.0]), ALL),
        ("local anchors", |joint| joint.local_anchors([1.0, 0.0], [0.0, 1.0]), ALL),
        ("two places", |joint| joint.between([1.0, 0.0], [0.0, 1.0]), ALL),
        ("strength", |joint| joint.break_at(1.0, 1.0), ALL),
        ("contact", |joint| joint.collide_connected(true), ALL),
        ("pause", |joint| joint.enabled(false), ALL),
        ("number", |joint| joint.user_data(1), ALL),
    ]
}

/// Each option on each kind: what a kind has is taken, and what it does not have is refused by its name. A limit of 0 to 1 rad is not what the
/// greatest length of a hinge would be.
#[test]
fn a_joint_takes_the_options_of_its_kind_and_no_others() {
    let mut world = World::new(Settings::default());
    let [a, b] = two_boxes(&mut world);
    let joints = [
        Joint::revolute(a, b),
        Joint::prismatic(a, b),
        Joint::distance(a, b),
        Joint::rope(a, b),
        Joint::weld(a, b),
        Joint::wheel(a, b),
        Joint::motor_to(a, b),
        Joint::drag(a, [0.0, 0.0]),
        Joint::friction(a, b).max_force(1.0).max_torque(1.0),
        Joint::gear(a, b, 2.0),
        Joint::ratchet(a, b, 0.1),
        over_wheels(a, b),
    ];
    for joint in joints {
        for (name, give, kinds_that_have_it) in options() {
            let given = give(joint.clone());
            match world.add_joint(given) {
                Ok(id) => {
                    let kind = world.joint(id).unwrap().kind();
                    assert!(kinds_that_have_it.contains(&kind), "a {kind} joint takes a {name}");
                    assert!(world.add_joint(world.joint(id).unwrap().describe()).is_ok());
                }
                Err(JointError::NoSuchOption { kind, option, kinds }) => {
                    assert!(!kinds_that_have_it.contains(&kind), "a {kind} joint takes no {name}");
                    assert_eq!(option, name, "a {kind} joint");
                    assert!(kinds.iter().all(|kind| kinds_that_have_it.contains(kind)));
                    assert_eq!(kinds.len(), kinds_that_have_it.len(), "{name}");
                }
                Err(error) => panic!("{name}: {error}"),
            }
        }
    }
    world.validate().unwrap();
}

/// A rope is as long as its anchors are apart. Between anchors in one place it is 1 µm, which is as short as may be asked for: what is made of it
/// later is checked again.
#[test]
fn a_rope_between_anchors_in_one_place_can_be_changed_as_any() {
    let mut world = earth();
    let body = add(&mut world, Body::dynamic(Shape::circle(0.5)));
    let rope = world.add_joint(Joint::rope(body, None).at([0.0, 0.5])).unwrap();
    world.joint_mut(rope).unwrap().set_enabled(false);
    assert!(!world.joint(rope).unwrap().is_enabled());
    world.joint_mut(rope).unwrap().set_enabled(true);
    let again = world.joint(rope).unwrap().describe();
    assert!(world.add_joint(again).is_ok());
    run(&mut world, 1.0);
    assert!(world.body(body).unwrap().position().length() < 1e-3, "it hangs on");
}

/// A limit of infinity leaves a distance open. Only a rope that is told no length has that of now, and what it has is what it tells of itself.
#[test]
fn a_distance_without_a_greatest_length_is_open() {
    let mut world = space();
    let mut fly = |y: f64, joint: fn(BodyId) -> Joint| {
        let body = add(&mut world, Body::dynamic(Shape::circle(0.1)).at([1.0, y]).velocity([1.0, 0.0]));
        (body, world.add_joint(joint(body).between([1.0, y], [0.0, y])).unwrap())
    };
    let (open, limits) = fly(0.0, |body| Joint::distance(body, None).limits(0.5..=f64::INFINITY));
    let (rope, _) = fly(1.0, |body| Joint::rope(body, None));
    let (opened, longer) = fly(2.0, |body| Joint::rope(body, None));
    world.joint_mut(longer).unwrap().set_limits(0.0..=f64::INFINITY).unwrap();
    for joint in [limits, longer] {
        let again = world.joint(joint).unwrap().describe();
        world.add_joint(again).unwrap();
    }
    run(&mut world, 2.0);
    for body in [open, opened] {
        assert_near(place(&world, body)[0], 3.0, 1e-5, "what is open");
    }
    assert_near(place(&world, rope)[0], 1.0, 1e-5, "what a rope holds");
}

/// A hinge that is to be 100 rad from where it is turns there, no faster than gaps close, 3 rad/s, and its pin holds on the way, to what a
/// turn of 0.0125 rad in a substep leaves of half a metre.
#[test]
fn a_limit_far_away_is_come_to_without_haste() {
    let mut world = space();
    let rods = [0.5, -0.5].map(|x| add(&mut world, Body::dynamic(Shape::obb(1.0, 0.2)).at([x, 0.0])));
    let hinge = Joint::revolute(rods[0], rods[1]).at([0.0, 0.0]).limits(100.0..=100.0);
    let hinge = world.add_joint(hinge).unwrap();
    for tick in 0..2000 {
        world.step();
        let gap = world.joint(hinge).unwrap().error();
        assert!(gap.distance < 0.5 * 0.0125 * 0.0125, "{gap:?} at tick {tick}");
        assert_near(f64::from(gap.angle), 100.0 - 0.05 * f64::from(tick + 1), 0.01, "angle that is left");
    }
}

/// Limits that leave no place: what they let pass is nowhere.
const NEVER: std::ops::RangeInclusive<f64> = f64::INFINITY..=f64::INFINITY;

/// Of two infinite limits one does nothing, and both may.
#[test]
fn a_limit_may_be_infinite_on_its_own_side() {
    let mut world = earth();
    let body = add(&mut world, Body::dynamic(Shape::circle(0.5)));
    let slide = Joint::prismatic(body, None).axis([0.0, 1.0]);
    for limits in [f64::NEG_INFINITY..=f64::INFINITY, f64::NEG_INFINITY..=0.0, -0.25..=f64::INFINITY] {
        let joint = world.add_joint(slide.clone().limits(limits)).unwrap();
        assert!(world.joint_mut(joint).unwrap().set_limits(NEVER).is_err());
    }
    run(&mut world, 1.0);
    assert!(world.body(body).unwrap().position().y.abs() < 0.251, "the last of them holds it");
    world.validate().unwrap();
}

/// A bridge that is held until it is let go: a joint outlives that its bodies are fixed, and may be changed meanwhile.
#[test]
fn a_joint_rests_while_its_bodies_are_fixed() {
    let mut world = earth();
    let plank = add(&mut world, Body::dynamic(Shape::rectangle(1.0, 0.1)).at([0.5, 0.0]));
    let hinge = world.add_joint(Joint::revolute(plank, None).at([0.0, 0.0])).unwrap();
    world.body_mut(plank).unwrap().set_body_type(BodyType::Fixed).unwrap();
    world.joint_mut(hinge).unwrap().set_limits(-0.5..=0.5).unwrap();
    run(&mut world, 1.0);
    assert_eq!(world.joint(hinge).unwrap().angle(), 0.0);
    world.body_mut(plank).unwrap().set_body_type(BodyType::Dynamic).unwrap();
    run(&mut world, 3.0);
    let turned = world.joint(hinge).unwrap().angle().abs();
    assert!((turned - 0.5).abs() < 1e-3, "it hangs at its limit: {turned}");
}

/// What a joint is off by is found where it acts: none of its bodies being dynamic, it does not, and tells what it was.
#[test]
fn a_joint_between_bodies_that_it_does_not_move_tells_no_new_gap() {
    let mut world = earth();
    let [a, b] = two_boxes(&mut world);
    let weld = world.add_joint(Joint::weld(a, b)).unwrap();
    run(&mut world, 0.1);
    world.body_mut(a).unwrap().set_body_type(BodyType::Fixed).unwrap();
    world.body_mut(b).unwrap().set_body_type(BodyType::Kinematic).unwrap();
    let before = world.joint(weld).unwrap().error();
    world.body_mut(b).unwrap().set_position([5.0, 0.0]).unwrap();
    run(&mut world, 0.1);
    assert_eq!(world.joint(weld).unwrap().error(), before);
    let [on_a, on_b] = world.joint(weld).unwrap().anchors();
    assert!(before.distance < 1e-6 && on_a.distance(on_b) > 4.0);
}

/// The motor turns b, or the world, counter-clockwise as seen from a; it moves b, or the world, along the axis.
#[test]
fn a_motor_moves_the_second_body_ahead_and_the_first_one_back() {
    let body = || Body::dynamic(Shape::rectangle(1.0, 1.0));
    for (second, sign) in [(false, -1.0), (true, 1.0)] {
        let mut world = World::new(Settings::default());
        let (wall, moved) = (add(&mut world, Body::fixed(Shape::circle(0.1))), add(&mut world, body()));
        let slid = add(&mut world, body().at([9.0, 0.0]));
        let ends = |body| if second { (wall, Some(body)) } else { (body, None) };
        let (a, b) = ends(moved);
        let hinge = world.add_joint(Joint::revolute(a, b).at([0.0, 0.0]).motor(2.0, f32::INFINITY)).unwrap();
        let (a, b) = ends(slid);
        let slide = Joint::prismatic(a, b).at([9.0, 0.0]).axis([0.0, 1.0]).motor(2.0, f32::INFINITY);
        let slide = world.add_joint(slide).unwrap();
        run(&mut world, 0.5);
        assert!((world.body(moved).unwrap().angular_velocity() - sign * 2.0).abs() < 1e-3);
        assert!((world.body(slid).unwrap().velocity().y - sign * 2.0).abs() < 1e-3);
        let [hinge, slide] = [hinge, slide].map(|joint| world.joint(joint).unwrap());
        assert!((hinge.speed() - 2.0).abs() < 1e-3 && hinge.angle() > 0.9 && hinge.translation() < 1e-5);
        assert!(
            (slide.speed() - 2.0).abs() < 1e-3 && slide.translation() > 0.9 && slide.angle().abs() < 1e-5
        );
    }
}

#[test]
fn joined_bodies_do_not_touch_unless_told_and_do_when_parted() {
    for (collides, touch) in [(false, false), (true, true)] {
        let mut world = World::new(Settings { sleep: false, ..Settings::default() });
        let [a, b] = two_boxes(&mut world);
        let joint = world.add_joint(Joint::weld(a, b).collide_connected(collides)).unwrap();
        world.step();
        assert_eq!(world.contacts().count() > 0, touch);
        world.joint_mut(joint).unwrap().set_collide_connected(!collides);
        world.step();
        assert_eq!(world.contacts().count() > 0, !touch);
        world.remove_joint(joint);
        world.step();
        assert!(world.contacts().count() > 0, "parted");
    }
}

#[test]
fn removing_a_body_removes_and_reports_its_joints() {
    let mut world = earth();
    let [a, b] = two_boxes(&mut world);
    let joint = world.add_joint(Joint::revolute(a, b)).unwrap();
    let other = world.add_joint(Joint::distance(a, None).between([0.0, 0.0], [0.0, 3.0])).unwrap();
    assert_eq!((world.joints_of(a), world.joints_of(b)), (vec![joint, other], vec![joint]));
    world.remove(b);
    assert!(world.joint(joint).is_none() && world.joint(other).is_some());
    world.step();
    assert_eq!(world.events().removed_joints(), [joint]);
    world.step();
    assert!(world.events().removed_joints().is_empty());
}

#[test]
fn what_hangs_at_rest_sleeps_together_and_a_motor_wakes_it() {
    let mut world = earth_with(Settings::default());
    world.set_settings(Settings { sleep: true, ..Settings::default() }).unwrap();
    let upper = add(&mut world, Body::dynamic(Shape::obb(0.1, 1.0)).at([0.0, -0.5]));
    let lower = add(&mut world, Body::dynamic(Shape::obb(0.1, 1.0)).at([0.0, -1.5]));
    let hinge = world.add_joint(Joint::revolute(upper, None).at([0.0, 0.0])).unwrap();
    world.add_joint(Joint::revolute(lower, upper).at([0.0, -1.0])).unwrap();
    assert_eq!(world.islands().len(), 1);
    run(&mut world, 3.0);
    assert_eq!((world.awake_count(), world.sleeping_islands()), (0, 1));
    let borne = |world: &World| world.joint(hinge).unwrap().force();
    let asleep = borne(&world);
    let weight: f64 = [upper, lower].map(|id| G * f64::from(world.body(id).unwrap().mass())).iter().sum();
    assert_near(f64::from(asleep.y.abs()), weight, 1e-4 * weight, "what bears two rods");
    let other = add(&mut world, Body::dynamic(Shape::circle(0.1)).at([50.0, 0.0]));
    run(&mut world, 0.1);
    assert_eq!((world.awake_count(), borne(&world)), (1, asleep), "whoever else is awake");
    world.remove(other);
    world.joint_mut(hinge).unwrap().set_motor(1.0, 100.0);
    assert_eq!(world.awake_count(), 2);
    run(&mut world, 0.5);
    assert!(world.joint(hinge).unwrap().angle() > 0.1, "it turns");
}

#[test]
fn clones_with_joints_go_on_with_the_same_bits() {
    let mut world = earth();
    let [a, b] = two_boxes(&mut world);
    world.add_joint(Joint::revolute(a, None).at([-0.5, 0.5])).unwrap();
    world.add_joint(Joint::weld(a, b).spring(3.0, 0.1)).unwrap();
    run(&mut world, 0.5);
    let mut clone = world.clone();
    let mut other = earth();
    other.clone_from(&world);
    for world in [&mut world, &mut clone, &mut other] {
        run(world, 1.0);
    }
    assert_eq!(world.state_hash(), clone.state_hash());
    assert_eq!(world.state_hash(), other.state_hash());
}
