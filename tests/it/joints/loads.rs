//! Chains, heavy ends, and joints that break.

use rustycs::prelude::*;

use crate::support::{G, add, assert_relative, earth, run, space, velocity};

/// A rope of `links` capsule-sized boxes of 1 m and `mass` each, that hangs from the world with a weight at its end; returns its
/// joints from the top on.
fn heavy_rope(world: &mut World, links: u32, mass: f32, weight: f32) -> Vec<JointId> {
    let mut joints = Vec::new();
    let mut before = None;
    for link in 0..links {
        let top = -f64::from(link);
        let body = Body::dynamic(Shape::obb(0.2, 1.0)).at([0.0, top - 0.5]).mass(mass);
        let body = add(world, body);
        joints.push(world.add_joint(Joint::revolute(body, before).at([0.0, top])).unwrap());
        before = Some(body);
    }
    let end = -f64::from(links);
    let ball = add(world, Body::dynamic(Shape::circle(2.0)).at([0.0, end - 2.0]).mass(weight));
    joints.push(world.add_joint(Joint::revolute(ball, before).at([0.0, end])).unwrap());
    joints
}

/// Each pin bears what hangs below it, and stretches by less than a millimetre: far less, as poses in `f32` let it.
#[test]
fn a_rope_with_a_weight_of_1800_links_does_not_stretch() {
    let mut world = earth();
    let joints = heavy_rope(&mut world, 18, 0.5, 900.0);
    run(&mut world, 2.0);
    for (number, joint) in joints.iter().enumerate() {
        let joint = world.joint(*joint).unwrap();
        assert!(joint.error().distance < 1e-4, "pin {number}: {:?}", joint.error());
        let below = 900.0 + 0.5 * (18 - number) as f64;
        assert_relative(f64::from(joint.force().length()), below * G, 1e-3, "force in a pin");
    }
}

/// The same of 50,000 links.
#[test]
fn a_rope_with_a_weight_of_50000_links_does_not_stretch() {
    let mut world = earth();
    let joints = heavy_rope(&mut world, 18, 0.5, 25_000.0);
    run(&mut world, 2.0);
    for joint in joints {
        assert!(world.joint(joint).unwrap().error().distance < 1e-3);
    }
}

/// A chain of ten links that swings down from the side with a ball of 10 links at its end, and one of 672. Under so much tension
/// a light link swings faster than a substep can follow: there its bodies go through the substep in several steps. The chain
/// does not part, and gains no energy; a hundredth is what a symplectic method, whose steps are up to a radian of the fastest
/// swing, wavers by.
#[test]
fn a_light_chain_with_a_heavy_ball_swings_without_parting() {
    for weight in [10.0_f32, 672.0] {
        let mut world = earth();
        // Links that would meet pass each other: what is looked at are the joints.
        let ghost = Filter { group: -1, ..Filter::DEFAULT };
        let (mut joints, mut before) = (Vec::new(), None);
        for link in 0..10_u8 {
            let left = f64::from(link);
            let body = Body::dynamic(Shape::obb(1.0, 0.2)).at([left + 0.5, 0.0]).mass(6.0);
            let body = add(&mut world, body.filter(ghost));
            joints.push(world.add_joint(Joint::revolute(body, before).at([left, 0.0])).unwrap());
            before = Some(body);
        }
        let ball = Body::dynamic(Shape::circle(2.0)).at([12.0, 0.0]).mass(6.0 * weight);
        let ball = add(&mut world, ball.filter(ghost));
        joints.push(world.add_joint(Joint::revolute(ball, before).at([10.0, 0.0])).unwrap());
        let start = world.energy();
        // What the ball and the links fall by, at most.
        let scale = 6.0 * G * (12.0 * f64::from(weight) + 10.0 * 5.0);
        for tick in 0..1_200 {
            world.step();
            for joint in &joints {
                let gap = world.joint(*joint).unwrap().error().distance;
                assert!(gap < 1e-5, "{weight} links, tick {tick}: {gap} m");
            }
            let gained = world.energy() - start;
            assert!(gained < 0.01 * scale, "{weight} links, tick {tick}: {gained} J of {scale} J");
        }
    }
}

/// The same of ten discs on massless rods, which do not turn but go to the side.
#[test]
fn a_string_of_light_discs_with_a_heavy_one_swings_without_parting() {
    for weight in [10.0_f32, 672.0] {
        let mut world = earth();
        let ghost = Filter { group: -1, ..Filter::DEFAULT };
        let (mut joints, mut before) = (Vec::new(), None);
        for number in 1..=10_u8 {
            let x = 0.5 * f64::from(number);
            let mass = if number == 10 { 6.0 * weight } else { 6.0 };
            let disc = Body::dynamic(Shape::circle(0.1)).at([x, 0.0]).mass(mass).filter(ghost);
            let disc = add(&mut world, disc);
            let rod = match before {
                Some(before) => Joint::distance(before, disc),
                None => Joint::distance(disc, None).between([x, 0.0], [0.0, 0.0]),
            };
            joints.push(world.add_joint(rod).unwrap());
            before = Some(disc);
        }
        let start = world.energy();
        // What the discs fall by, at most.
        let scale = 6.0 * G * (5.0 * f64::from(weight) + 9.0 * 2.5);
        for tick in 0..1_200 {
            world.step();
            for joint in &joints {
                let gap = world.joint(*joint).unwrap().error().distance;
                assert!(gap < 1e-5, "{weight} discs, tick {tick}: {gap} m");
            }
            let gained = world.energy() - start;
            assert!(gained < 0.01 * scale, "{weight} discs, tick {tick}: {gained} J of {scale} J");
        }
    }
}

/// A joint that breaks above 100 N holds 10 kg and does not hold 10.4 kg.
#[test]
fn a_joint_breaks_above_its_force_and_not_below() {
    for (mass, breaks) in [(10.0_f32, false), (10.4, true)] {
        let mut world = earth();
        let body = add(&mut world, Body::dynamic(Shape::circle(0.5)).at([0.0, 0.0]).mass(mass));
        let joint = Joint::weld(body, None).break_at(100.0, f32::INFINITY);
        let joint = world.add_joint(joint).unwrap();
        world.step();
        assert_eq!(world.events().broken() == [joint], breaks, "{mass} kg");
        assert_eq!(world.joint(joint).is_none(), breaks, "{mass} kg");
    }
}

/// A disc of 5 kg strikes a plank that is welded to the world, in any part of a step. What the weld bears in all takes the momentum that
/// the disc loses, and it breaks by the greatest force of a step, and by no other.
#[test]
fn a_blow_is_borne_and_breaks_whenever_it_comes() {
    let struck = |offset: f64, most: f32| {
        let mut world = space();
        let plank = add(&mut world, Body::dynamic(Shape::obb(0.2, 2.0)).mass(10.0));
        let weld = world.add_joint(Joint::weld(plank, None).break_at(most, f32::INFINITY)).unwrap();
        let disc = Body::dynamic(Shape::circle(0.2)).at([-2.0 - offset, 0.0]).mass(5.0).velocity([30.0, 0.0]);
        let disc = add(&mut world, disc);
        let (mut borne, mut greatest) = (0.0, 0.0_f32);
        for _ in 0..30 {
            world.step();
            let force = world.joint(weld).map_or(f32::INFINITY, |weld| weld.force().length());
            (borne, greatest) = (borne + f64::from(force) / 60.0, greatest.max(force));
        }
        (borne, greatest, 5.0 * (30.0 - velocity(&world, disc)[0]))
    };
    for number in 0..20_u8 {
        let offset = 0.027 * f64::from(number);
        let (borne, greatest, lost) = struck(offset, f32::INFINITY);
        assert!(lost > 100.0, "{offset} m: {lost} N s");
        // Roundings of `f32`, some ten.
        assert_relative(borne, lost, 1e-6, "what the weld bears");
        assert!(struck(offset, 1.01 * greatest).1.is_finite(), "{offset} m: it holds {greatest} N");
        assert!(struck(offset, 0.99 * greatest).1.is_infinite(), "{offset} m: it breaks below {greatest} N");
    }
}

/// A disc strikes crates that are welded to all their neighbours, more welds than they need. None ever bears more than the disc
/// gives in a step.
#[test]
fn welds_in_rings_bear_no_more_than_a_blow_gives() {
    for (side, rate) in [(2_usize, 60.0), (2, 240.0), (3, 60.0), (3, 240.0)] {
        let mut world = World::new(Settings { tick_rate: rate, ..Settings::default() });
        let place = |column: usize, row: usize| [column as f64, row as f64];
        let mut crates = Vec::new();
        for number in 0..side * side {
            let body = Body::dynamic(Shape::obb(1.0, 1.0)).at(place(number % side, number / side));
            crates.push(add(&mut world, body.mass(10.0)));
        }
        for number in 0..side * side {
            let [x, y] = place(number % side, number / side);
            if number % side > 0 {
                let weld = Joint::weld(crates[number - 1], crates[number]).at([x - 0.5, y]);
                world.add_joint(weld).unwrap();
            }
            if number >= side {
                let weld = Joint::weld(crates[number - side], crates[number]).at([x, y - 0.5]);
                world.add_joint(weld).unwrap();
            }
        }
        let disc = Body::dynamic(Shape::circle(0.3)).at([-6.0, 0.7]).mass(20.0).velocity([20.0, 0.0]);
        let disc = add(&mut world, disc);
        let (mut before, mut given) = (velocity(&world, disc), 0.0_f64);
        for tick in 0..120 {
            world.step();
            let now = velocity(&world, disc);
            given = given.max(20.0 * (now[0] - before[0]).hypot(now[1] - before[1]) * f64::from(rate));
            before = now;
            for (_, joint) in world.joints() {
                let borne = f64::from(joint.force().length());
                assert!(borne <= given, "{side}, {rate} Hz, tick {tick}: {borne} N of {given} N");
            }
        }
        assert!(given > 100.0 * f64::from(rate), "the disc misses");
    }
}

/// A disc goes round the end of a rod by 0.9 rad in each step. What the rod bears in the step is what turns the momentum of the disc.
#[test]
fn the_force_of_a_step_turns_the_momentum_also_where_the_joint_turns() {
    let mut world = space();
    let disc =
        add(&mut world, Body::dynamic(Shape::circle(0.2)).at([2.0, 0.0]).mass(3.0).velocity([0.0, 108.0]));
    let rod = world.add_joint(Joint::distance(disc, None).between([2.0, 0.0], [0.0, 0.0])).unwrap();
    let mut before = velocity(&world, disc);
    for tick in 0..60 {
        world.step();
        let (now, force) = (velocity(&world, disc), world.joint(rod).unwrap().force());
        for (axis, on_world) in [force.x, force.y].into_iter().enumerate() {
            let missing = 3.0 * (now[axis] - before[axis]) + f64::from(on_world) / 60.0;
            // Of 324 N s, four substeps of roundings of `f32`.
            assert!(missing.abs() < 1e-6 * 324.0, "tick {tick}: {missing} N s");
        }
        before = now;
    }
}

/// No forces but those of joints, which are equal and opposite: roundings of `f32` are left.
#[test]
fn bodies_joined_in_space_keep_momentum_and_angular_momentum() {
    let mut world = space();
    let mut before: Option<BodyId> = None;
    for number in 0..6_u8 {
        let body = Body::dynamic(Shape::obb(1.0, 0.2)).at([f64::from(number), 0.0]).mass(1.0);
        let body = add(&mut world, body.velocity([0.0, f32::from(number % 3)]));
        if let Some(before) = before {
            world.add_joint(Joint::revolute(before, body).at([f64::from(number) - 0.5, 0.0])).unwrap();
        }
        before = Some(body);
    }
    let sum =
        |world: &World| world.bodies().map(|(id, _)| velocity(world, id)[1]).fold(0.0, |sum, v| sum + v);
    let at_first = (sum(&world), world.angular_momentum());
    run(&mut world, 10.0);
    assert_relative(sum(&world), at_first.0, 1e-4, "momentum");
    let [found, expected] =
        [world.angular_momentum(), at_first.1].map(|l| format!("{l:?}").parse::<f64>().unwrap());
    assert_relative(found, expected, 1e-3, "angular momentum");
}

/// A straight bridge of hinged planks of a mass, kg, and 0.5 m, pinned at both ends, the last pin nearer by a share of the length than
/// that, or farther. Returns its joints.
fn straight_bridge(world: &mut World, planks: u32, mass: f32, short: f64) -> Vec<JointId> {
    let (mut before, mut joints) = (None, Vec::new());
    for plank in 0..planks {
        let left = 0.5 * f64::from(plank);
        let body = Body::dynamic(Shape::obb(0.48, 0.12)).at([left + 0.25, 0.0]).mass(mass);
        let body = add(world, body.restitution(0.0));
        joints.push(world.add_joint(Joint::revolute(body, before).at([left, 0.0])).unwrap());
        before = Some(body);
    }
    let length = 0.5 * f64::from(planks);
    let pin = Joint::revolute(before.unwrap(), None).between([length, 0.0], [(1.0 - short) * length, 0.0]);
    joints.push(world.add_joint(pin).unwrap());
    joints
}

/// A gap along the line of a bridge that does not fit could close only by great ways across it. Closing it takes the energy to lift the
/// weight by as much, and that of a plank that is as fast as the gap closes, within a substep; no more. Where it cannot close, the pins
/// share it. Where it can, it does, but for what the pins yield. They bear T = W L/(8 s) with a sag s, each opens by ε (2/m) (T h/2) h in a
/// substep, and of a gap g the part (4 s/L)²/c closes. With s² = 3 L N g/8 for N pins that is in balance at
/// g^(5/2) = ε c W h² L^(3/2)/(128 m (3 N/8)^(3/2)), 5 µm for 24 planks. It comes to
/// no more than twice that within 20 s.
#[test]
fn a_straight_bridge_whose_ends_do_not_fit_gains_no_energy() {
    for planks in [2, 3, 4, 10, 24_u32] {
        for short in [0.0, 1e-5, 1e-4, 1e-3, 1e-2, -1e-3] {
            let mut world = earth();
            let joints = straight_bridge(&mut world, planks, 1.0, short);
            let gap = 0.5 * f64::from(planks) * short.abs();
            let closing = (240.0 * gap).min(3.0);
            let most = G * f64::from(planks) * gap + 0.5 * closing * closing + 1e-3;
            let (mut widest, widest_most) = (f64::INFINITY, if short < 0.0 { gap } else { 1e-5 });
            for tick in 0..1200 {
                world.step();
                let energy = world.energy();
                assert!(energy <= most, "{planks} planks, {short}: {energy} J at tick {tick}, not {most}");
                let gaps = joints.iter().map(|&joint| world.joint(joint).unwrap().error().distance);
                widest = f64::from(gaps.fold(0.0, f32::max));
                if tick >= 180 && widest <= widest_most {
                    break;
                }
            }
            assert!(widest <= widest_most, "{planks} planks, {short}: {widest} m, not {widest_most}");
        }
    }
}

/// Crates from the weight of a plank to a hundred times that are put onto a straight bridge of light planks. Nothing drives it. Overlaps
/// of 1 mm that are pushed apart may lift what lies there.
#[test]
fn a_straight_bridge_with_a_crate_gains_no_energy() {
    for planks in [10, 24_u32] {
        for mass in [0.07, 0.7, 7.0_f32] {
            let mut world = earth();
            straight_bridge(&mut world, planks, 0.07, 0.0);
            let crate_ = Body::dynamic(Shape::rectangle(0.6, 0.6)).at([0.25 * f64::from(planks), 0.36]);
            add(&mut world, crate_.mass(mass).restitution(0.0));
            let most = world.energy() + f64::from(mass) * G * 1e-3;
            for tick in 0..180 {
                world.step();
                let energy = world.energy();
                assert!(energy <= most, "{planks} planks, {mass} kg: {energy} J at tick {tick}, not {most}");
            }
        }
    }
}
