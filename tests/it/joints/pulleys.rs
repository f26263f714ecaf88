//! Two bodies on one rope over two wheels.
//!
//! ```text
//! |r_a| + ρ |r_b| ≤ L      r from the wheel to the anchor
//! T u_a and ρ T u_b        the forces, u towards the wheels
//! s″ = g (m_b - ρ m_a)/(m_b + ρ² m_a)      how b comes down where both hang straight, and a goes up ρ times as fast
//! T  = g m_a m_b (1 + ρ)/(m_b + ρ² m_a)
//! ```

use rustycs::prelude::*;

use crate::support::{
    G, add, add_floor, assert_near, assert_relative, earth, earth_with, place, run, space, velocity,
};

/// Wheels 2 m apart, where `a` and `b` hang straight.
const WHEELS: [[f64; 2]; 2] = [[-1.0, 10.0], [1.0, 10.0]];

fn disc(x: f64, y: f64, mass: f32) -> Body {
    Body::dynamic(Shape::circle(0.2)).at([x, y]).mass(mass).restitution(0.0)
}

/// Two discs that hang straight, `a` at height 0 and `b` at `height`, m, and the pulley.
fn machine(world: &mut World, masses: [f32; 2], ratio: f64, height: f64) -> (BodyId, BodyId, JointId) {
    let [a, b] =
        [(-1.0, 0.0, masses[0]), (1.0, height, masses[1])].map(|(x, y, mass)| add(world, disc(x, y, mass)));
    let joint = world.add_joint(Joint::pulley(a, b, WHEELS[0], WHEELS[1]).ratio(ratio)).unwrap();
    (a, b, joint)
}

/// How b comes down, m/s², and the tension, N.
fn atwood([a, b]: [f64; 2], ratio: f64) -> (f64, f64) {
    let inertia = b + ratio * ratio * a;
    (G * (b - ratio * a) / inertia, G * a * b * (1.0 + ratio) / inertia)
}

/// The scheme is exact under a constant force. Left is rounding: 6e-8 of up to 10 m/s, in 192 substeps.
#[test]
fn an_atwood_machine_gains_speed_by_its_closed_form() {
    for (a, b, ratio) in
        [(1.0_f32, 2.0_f32, 1.0), (3.0, 1.0, 1.0), (1.0, 4.0, 3.0), (2.0, 1.0, 0.25), (5.0, 5.0, 2.0)]
    {
        let mut world = earth();
        let (id_a, id_b, joint) = machine(&mut world, [a, b], ratio, 0.0);
        let start = world.joint(joint).unwrap().translation();
        assert_near(start, 10.0 + ratio * 10.0, 1e-12, "rope in use");
        run(&mut world, 0.8);
        let (down, tension) = atwood([a, b].map(f64::from), ratio);
        let way = 0.5 * down * 0.64;
        let what = format!("{a} kg, {b} kg, ratio {ratio}");
        assert_near(place(&world, id_b)[1], -way, 1e-5 * way.abs() + 1e-6, &what);
        assert_near(place(&world, id_a)[1], ratio * way, 1e-5 * ratio * way.abs() + 1e-6, &what);
        assert_near(velocity(&world, id_b)[1], -0.8 * down, 1e-5 * down.abs(), &what);
        assert_near(velocity(&world, id_a)[1], 0.8 * ratio * down, 1e-5 * ratio * down.abs(), &what);
        let view = world.joint(joint).unwrap();
        assert_relative(f64::from(view.force().y), ratio * tension, 1e-5, &what);
        assert_near(f64::from(view.force().x), 0.0, 1e-6 * tension, &what);
        assert_near(view.speed(), 0.0, 1e-6 * (1.0 + ratio), &what);
        assert_relative(view.translation(), start, 1e-7, &what);
        assert_eq!((view.length(), view.torque(), view.kind()), (Some(start), 0.0, JointKind::Pulley));
        assert_eq!(view.wheels(), Some(WHEELS.map(Point::from)));
    }
}

/// ρ m_a = m_b: nothing moves, however long, and it falls asleep: wheels are as good as ground. What it bears it goes on to tell.
#[test]
fn a_machine_in_balance_rests_and_sleeps() {
    for ratio in [1.0, 3.0, 0.5] {
        let mut world = earth_with(Settings::default());
        let (a, b, joint) = machine(&mut world, [2.0, 2.0 * ratio as f32], ratio, 1.0);
        run(&mut world, 20.0);
        for (id, [x, y]) in [(a, [-1.0, 0.0]), (b, [1.0, 1.0])] {
            let found = place(&world, id);
            assert!((found[0] - x).abs() + (found[1] - y).abs() < 1e-6, "ratio {ratio}: {found:?}");
        }
        world.set_settings(Settings::default()).unwrap();
        run(&mut world, 2.0);
        assert_eq!((world.awake_count(), world.sleeping_islands()), (0, 1), "ratio {ratio}");
        assert_relative(
            f64::from(world.joint(joint).unwrap().force().y),
            2.0 * ratio * G,
            1e-5,
            "force on b",
        );
        world.body_mut(b).unwrap().set_velocity([0.0, -1.0]);
        assert_eq!(world.awake_count(), 2, "ratio {ratio}");
        run(&mut world, 0.5);
        assert!(velocity(&world, a)[1] > 0.1 * ratio, "ratio {ratio}: b moves a");
    }
}

/// The swinging machine: r″ = (m r θ′² + m g cos θ - M g)/(M + m) and r θ″ = -2 r′ θ′ - g sin θ, for m that swings and M that
/// hangs straight; by Runge and Kutta with steps of 0.1 ms, which are off by 1e-12. Returns r, m, and θ, rad.
fn swinging(heavy: f64, light: f64, [r, theta]: [f64; 2], seconds: f64) -> [f64; 2] {
    let rate = |[r, theta, dr, dtheta]: [f64; 4]| {
        let ddr = (light * (r * dtheta * dtheta + G * theta.cos()) - heavy * G) / (heavy + light);
        [dr, dtheta, ddr, -(2.0 * dr * dtheta + G * theta.sin()) / r]
    };
    let h = 1e-4;
    let mut state = [r, theta, 0.0, 0.0];
    for _ in 0..(seconds / h).round() as u32 {
        let ahead = |by: f64, rate: [f64; 4]| [0, 1, 2, 3].map(|index| state[index] + by * rate[index]);
        let first = rate(state);
        let second = rate(ahead(0.5 * h, first));
        let third = rate(ahead(0.5 * h, second));
        let fourth = rate(ahead(h, third));
        let sum = |index: usize| first[index] + 2.0 * (second[index] + third[index]) + fourth[index];
        state = [0, 1, 2, 3].map(|index| state[index] + h / 6.0 * sum(index));
    }
    [state[0], state[1]]
}

/// 3 kg that hang and 2 kg that swing from a right angle on 4 m.
fn swinging_machine(substeps: u32) -> (World, BodyId, JointId) {
    let mut world = earth_with(Settings { substeps, ..Settings::default() });
    let heavy = add(&mut world, disc(-1.0, 0.0, 3.0));
    let light = add(&mut world, disc(5.0, 10.0, 2.0));
    let joint = world.add_joint(Joint::pulley(heavy, light, WHEELS[0], WHEELS[1])).unwrap();
    (world, light, joint)
}

/// Twice the substeps leave a quarter of the error.
#[test]
fn a_swinging_machine_is_where_its_equations_take_it_to_second_order() {
    let [r, theta] = swinging(3.0, 2.0, [4.0, core::f64::consts::FRAC_PI_2], 1.5);
    let exact = [1.0 + r * theta.sin(), 10.0 - r * theta.cos()];
    let [coarse, fine] = [1, 2].map(|substeps| {
        let (mut world, light, _) = swinging_machine(substeps);
        run(&mut world, 1.5);
        let [x, y] = place(&world, light);
        (x - exact[0]).hypot(y - exact[1])
    });
    assert_near(coarse / fine, 4.0, 0.2, "ratio of errors");
    // (ω h)²/24 of a phase of 3 with ω of 2.5 rad/s at the shortest, 0.43 mm at 2 m, which a swing from a right angle makes up to three times
    // as much.
    assert!(coarse < 1.3e-3, "{coarse} m off");
}

/// Energy wavers by (ω h)² of what there is, and does not drift; the rope stays as long as it is.
#[test]
fn a_swinging_machine_keeps_its_energy_and_its_rope() {
    let (mut world, _, joint) = swinging_machine(4);
    let (start, scale) = (world.energy(), 2.0 * G * 4.0);
    for tick in 0..6_000 {
        world.step();
        assert_near(world.energy(), start, 2e-4 * scale, &format!("energy at tick {tick}"));
        let gap = world.joint(joint).unwrap().error().distance;
        assert!(gap < 1e-6, "{gap} m at tick {tick}");
    }
}

/// Planks that hang by their ends, and by a point beside the middle: what turns them turns them back, and the rope holds on. Energy as
/// above, of 2 kg and 2 m or so.
#[test]
fn planks_that_hang_by_their_ends_swing_and_keep_their_energy() {
    let mut world = earth();
    let [a, b] = [(-1.0, 0.7_f32), (1.0, -1.2)].map(|(x, angle)| {
        let plank = Body::dynamic(Shape::obb(0.2, 2.0)).at([x, 5.0]).angle(angle);
        add(&mut world, plank.mass(2.0).filter(Filter { group: -1, ..Filter::DEFAULT }))
    });
    let rope = Joint::pulley(a, b, WHEELS[0], WHEELS[1]).local_anchors([0.0, 1.0], [0.1, 0.6]);
    let rope = world.add_joint(rope).unwrap();
    let start = world.energy();
    for tick in 0..1_200 {
        world.step();
        assert_near(world.energy(), start, 1e-3 * 2.0 * 2.0 * G, &format!("energy at tick {tick}"));
        let view = world.joint(rope).unwrap();
        assert!(view.error().distance < 1e-6, "{:?} at tick {tick}", view.error());
    }
}

/// Slack by d, both fall freely until (1 + ρ) g t²/2 = d. Then the rope takes the blow: P = (1 + ρ) v/(1/m_a + ρ²/m_b), after which a goes
/// up ρ times as fast as b comes down. ρ m_a v_a - m_b v_b knows nothing of the rope, and changes by (ρ m_a - m_b) g t whatever it bears.
#[test]
fn a_slack_rope_lets_fall_and_takes_the_blow_with_all_momentum() {
    for (m_a, m_b, ratio) in [(1.0_f64, 1.0_f64, 1.0), (1.0, 3.0, 1.0), (2.0, 3.0, 3.0), (4.0, 1.0, 0.5)] {
        let what = format!("{m_a} kg, {m_b} kg, ratio {ratio}");
        let mut world = earth();
        let [a, b] = [(-1.0, m_a), (1.0, m_b)].map(|(x, mass)| add(&mut world, disc(x, 0.0, mass as f32)));
        let fall = 0.5 * G * 0.4 * 0.4;
        let length = ((1.0 + ratio) * (10.0 + fall)) as f32;
        let rope = Joint::pulley(a, b, WHEELS[0], WHEELS[1]).ratio(ratio).length(length);
        let rope = world.add_joint(rope).unwrap();
        let mut borne = 0.0;
        for tick in 1..=30_u8 {
            world.step();
            let t = f64::from(tick) / 60.0;
            let [v_a, v_b] = [a, b].map(|id| -velocity(&world, id)[1]);
            let momentum = ratio * m_a * v_a - m_b * v_b;
            let size = (ratio * m_a + m_b) * G * t;
            assert_near(momentum, (ratio * m_a - m_b) * G * t, 1e-6 * size, &what);
            let view = world.joint(rope).unwrap();
            borne += f64::from(view.force().y) / (60.0 * ratio);
            if tick < 24 {
                assert_near(v_a, G * t, 1e-5, &what);
                assert!(borne == 0.0 && view.translation() < f64::from(length), "{what}: {t} s");
            }
            if tick > 24 {
                assert_near(v_a + ratio * v_b, 0.0, 1e-5, &what);
                assert!(view.error().distance < 1e-6, "{what}: {:?}", view.error());
            }
        }
        let blow = (1.0 + ratio) * 0.4 * G / (1.0 / m_a + ratio * ratio / m_b);
        // Then it bears the tension for 0.1 s; in the substep of the blow by as much more or less as gravity gives.
        let (_, tension) = atwood([m_a, m_b], ratio);
        assert_near(borne, blow + 0.1 * tension, tension / 240.0, &what);
    }
}

/// A load of 1,000 times the mass of its counterweight, and the other way round: no rope stretches by a millionth of its 20 m.
#[test]
fn a_rope_with_a_thousand_to_one_does_not_stretch() {
    for masses in [[1.0_f32, 1000.0], [1000.0, 1.0]] {
        for ratio in [1.0, 2.0] {
            let mut world = earth();
            let (a, _, joint) = machine(&mut world, masses, ratio, 0.0);
            let (down, tension) = atwood(masses.map(f64::from), ratio);
            for _ in 0..45 {
                world.step();
                let view = world.joint(joint).unwrap();
                assert!(f64::from(view.error().distance) < 1e-6 * view.translation());
            }
            assert_relative(velocity(&world, a)[1], 0.75 * ratio * down, 1e-4, "speed of a");
            let force = f64::from(world.joint(joint).unwrap().force().y);
            assert_relative(force, ratio * tension, 1e-3, "force on b");
        }
    }
}

/// Where b does not move, a hangs by what is left of the rope, as by a rope. Each solve ends within 10⁻⁸ of the size of a joint, of 3 m, which
/// in a substep is a velocity of 7e-6 m/s: in 10 s 7e-5 m.
#[test]
fn a_body_hangs_by_the_rope_whose_other_end_is_fixed() {
    let mut world = earth();
    let fixed = add(&mut world, Body::fixed(Shape::circle(0.2)).at([1.0, 8.0]));
    let ghost = Filter { group: -1, ..Filter::DEFAULT };
    let [a, twin] = [(); 2].map(|()| add(&mut world, disc(2.0, 10.0, 1.0).filter(ghost)));
    let pulley = Joint::pulley(a, fixed, WHEELS[0], WHEELS[1]).ratio(2.0);
    let pulley = world.add_joint(pulley).unwrap();
    let rope = world.add_joint(Joint::rope(twin, None).between([2.0, 10.0], WHEELS[0])).unwrap();
    for tick in 0..600 {
        world.step();
        let ([x, y], [u, v]) = (place(&world, a), place(&world, twin));
        assert!((x - u).abs() + (y - v).abs() < 1e-4, "tick {tick}: {x}, {y} and {u}, {v}");
        let [force, like] = [pulley, rope].map(|id| f64::from(world.joint(id).unwrap().force().length()));
        assert_near(force, 2.0 * like, 1e-3 * G, "force on what is fixed, with the ratio");
    }
}

/// A kinematic b that is lowered at 1 m/s hoists a at ρ m/s; lifted, it lets it down.
#[test]
fn a_kinematic_body_hoists_the_other() {
    for (speed, ratio) in [(1.0_f32, 1.0), (1.0, 3.0), (-1.0, 0.5)] {
        let mut world = earth();
        let b = Body::kinematic(Shape::circle(0.2)).at([1.0, 5.0]).velocity([0.0, -speed]);
        let (a, b) = (add(&mut world, disc(-1.0, 0.0, 5.0)), add(&mut world, b));
        let joint = world.add_joint(Joint::pulley(a, b, WHEELS[0], WHEELS[1]).ratio(ratio)).unwrap();
        run(&mut world, 2.0);
        let speed = f64::from(speed);
        // It begins at rest, and is at speed after the first substep: 1/240 s or less of it is missing.
        assert_near(place(&world, a)[1], 2.0 * ratio * speed, 1e-5 + ratio / 240.0, "height");
        assert_near(velocity(&world, a)[1], ratio * speed, 1e-5, "speed");
        assert_relative(f64::from(world.joint(joint).unwrap().force().y), 5.0 * ratio * G, 1e-4, "force");
    }
}

/// Of 2 kg and 3 kg the rope bears 23.5 N. It breaks below that, and both fall.
#[test]
fn a_rope_breaks_above_its_force_on_b_and_not_below() {
    let (_, tension) = atwood([2.0, 3.0], 1.0);
    for (most, breaks) in [(0.99 * tension, true), (1.01 * tension, false)] {
        let mut world = earth();
        let [a, b] = [(-1.0, 2.0), (1.0, 3.0)].map(|(x, mass)| add(&mut world, disc(x, 0.0, mass)));
        let rope = Joint::pulley(a, b, WHEELS[0], WHEELS[1]).break_at(most as f32, f32::INFINITY);
        let rope = world.add_joint(rope).unwrap();
        world.step();
        assert_eq!(world.events().broken() == [rope], breaks);
        assert_eq!(world.joint(rope).is_none(), breaks);
        let before = velocity(&world, a)[1];
        run(&mut world, 1.0);
        assert_eq!((velocity(&world, a)[1] - before + G).abs() < 1e-4, breaks, "it falls freely");
    }
}

/// The heavier one comes down to the floor, a goes on for a while on a slack rope, falls back into it, and lifts b a little, again and again. In
/// the end b stands, pressed by what a does not bear: m_b g - ρ m_a g.
#[test]
fn the_heavier_one_comes_to_stand_on_the_floor() {
    for ratio in [1.0, 2.0] {
        let mut world = earth_with(Settings { sum_impulses: true, ..Settings::default() });
        add_floor(&mut world, 0.5);
        let box_ = Body::dynamic(Shape::rectangle(1.0, 1.0)).at([1.0, 2.5]).mass(10.0).restitution(0.0);
        let (a, b) = (add(&mut world, disc(-1.0, 1.0, 3.0)), add(&mut world, box_));
        let joint = world.add_joint(Joint::pulley(a, b, WHEELS[0], WHEELS[1]).ratio(ratio)).unwrap();
        let mut is_slack = false;
        for _ in 0..1_200 {
            world.step();
            let view = world.joint(joint).unwrap();
            is_slack |= view.translation() < view.length().unwrap() - 0.01;
            assert!(view.error().distance < 1e-5, "{:?}", view.error());
        }
        assert!(is_slack);
        assert_near(place(&world, b)[1], 0.5, 1e-3, "height of the box");
        assert_near(place(&world, a)[1], 1.0 + 2.0 * ratio, 2e-3 * ratio, "height of the disc");
        let on_b = world.contacts_of(b).filter_map(|contact| contact.impulse_on(b));
        let pressed: f64 = on_b.map(|impulse| 60.0 * f64::from(impulse.y)).sum();
        let tension = f64::from(world.joint(joint).unwrap().force().y);
        assert_relative(tension, 3.0 * ratio * G, 1e-3, "pull on the box");
        assert_relative(pressed, 10.0 * G - 3.0 * ratio * G, 1e-2, "load of the floor");
    }
}

/// A stack in a car feels the counterweight by way of the rope: all that hangs has the acceleration of the machine, and the car is pressed by
/// m (g - s″), though the upper crate is 50 times heavier than the car, and 500 times the lower.
#[test]
fn a_stack_in_a_car_is_pressed_by_its_mass_less_what_it_is_let_down_by() {
    for (top, weight) in [(5.0_f32, 30.0_f32), (500.0, 300.0), (500.0, 700.0)] {
        let mut world = earth_with(Settings { sum_impulses: true, ..Settings::default() });
        let plate = |y: f64, height: f32, mass: f32| {
            let body = Body::dynamic(Shape::aabb(2.0, height)).at([1.0, y]).mass(mass);
            body.restitution(0.0)
        };
        let car = add(&mut world, plate(0.0, 0.2, 10.0));
        let lower = add(&mut world, plate(0.6, 1.0, 1.0));
        add(&mut world, plate(1.6, 1.0, top));
        let hung = add(&mut world, disc(-1.0, 3.0, weight));
        world.add_joint(Joint::pulley(hung, car, [-1.0, 30.0], [1.0, 30.0])).unwrap();
        run(&mut world, 1.0);
        let all = f64::from(11.0 + top);
        let (down, tension) = atwood([f64::from(weight), all], 1.0);
        let what = format!("{top} kg, {weight} kg");
        assert_near(velocity(&world, car)[1], -down, 2e-3 * G, &what);
        let pressed = world.contact_between(lower, car).and_then(|contact| contact.impulse_on(car));
        let pressed = -60.0 * f64::from(pressed.expect("it stands on it").y);
        assert_relative(pressed, (all - 10.0) * (G - down), 5e-3, &what);
        let view = world.joints().next().unwrap().1;
        assert_relative(f64::from(view.force().y), tension, 5e-3, &what);
        assert!(world.error().penetration < 2e-3, "{what}: {} m", world.error().penetration);
    }
}

/// Side by side under one wheel they lie against each other, unless told not to; nothing then parts them but the slope of the ropes.
#[test]
fn bodies_on_one_rope_touch_each_other_unless_told_not_to() {
    for touches in [true, false] {
        let mut world = earth();
        let [a, b] = [-0.2, 0.2].map(|x| add(&mut world, disc(x, 0.0, 2.0).friction(0.0)));
        let rope = Joint::pulley(a, b, [0.0, 5.0], [0.0, 5.0]);
        let rope = if touches { rope } else { rope.collide_connected(false) };
        world.add_joint(rope).unwrap();
        run(&mut world, 1.0);
        assert_eq!(world.contacts_of(a).any(|contact| contact.is_touching()), touches);
        let apart = place(&world, b)[0] - place(&world, a)[0];
        assert_eq!(apart > 0.39, touches, "{apart} m apart");
    }
}

/// An anchor that begins on its wheel, or beside it, and one that is drawn through it or past it, and turns about it at hundreds of rad/s, where
/// steps are short: nothing gains a thousandth of its energy, and the rope stretches by less than a millimetre.
#[test]
fn an_anchor_at_its_wheel_breaks_nothing() {
    for [y_a, y_b] in [[10.0, 5.0], [9.5, 5.0], [9.999_999, 2.0], [0.0, 5.0]] {
        for (m_a, x) in [(0.1_f32, -1.0), (0.1, -1.01), (0.1, -1.3), (1.0, -1.0), (1.0, -1.01), (1.0, -1.3)] {
            let what = format!("from {x}, {y_a} m, {m_a} kg");
            let mut world = earth();
            let [a, b] =
                [(x, y_a, m_a), (1.0, y_b, 4.0)].map(|(x, y, mass)| add(&mut world, disc(x, y, mass)));
            let joint = world.add_joint(Joint::pulley(a, b, WHEELS[0], WHEELS[1])).unwrap();
            let start = world.energy();
            for tick in 0..240 {
                world.step();
                let energy = world.energy();
                assert!(energy < 1.001 * start, "{what}, tick {tick}: {energy} J, not {start} J");
                let gap = world.joint(joint).unwrap().error().distance;
                assert!(gap < 1e-3, "{what}, tick {tick}: {gap} m");
            }
        }
    }
}

/// Two anchors that both are on their wheels, by a rope of 10⁻⁶ m: they stay there.
#[test]
fn two_anchors_on_their_wheels_stay_there() {
    let mut world = earth();
    let [a, b] = [(-1.0, 1.0), (1.0, 4.0)].map(|(x, mass)| add(&mut world, disc(x, 10.0, mass)));
    let joint = world.add_joint(Joint::pulley(a, b, WHEELS[0], WHEELS[1])).unwrap();
    assert_eq!(world.joint(joint).unwrap().length(), Some(1e-6));
    run(&mut world, 1.0);
    for (id, x) in [(a, -1.0), (b, 1.0)] {
        let [px, py] = place(&world, id);
        assert!((px - x).hypot(py - 10.0) < 1e-5, "{px}, {py}");
    }
    let view = world.joint(joint).unwrap();
    assert!(view.force().length().is_finite() && view.speed().is_finite());
}

/// A winch: the rope is taken in and let out while the load hangs.
#[test]
fn a_rope_is_taken_in_and_let_out() {
    let mut world = earth();
    let hook = add(&mut world, Body::fixed(Shape::circle(0.1)).at([1.0, 9.0]));
    let load = add(&mut world, disc(-1.0, 0.0, 50.0));
    let rope = world.add_joint(Joint::pulley(load, hook, WHEELS[0], WHEELS[1])).unwrap();
    for (length, height) in [(8.0_f32, 3.0), (10.5, 0.5)] {
        world.joint_mut(rope).unwrap().set_length(length).unwrap();
        run(&mut world, 3.0);
        assert_near(place(&world, load)[1], height, 1e-3, "height of the load");
        assert_eq!(world.joint(rope).unwrap().length(), Some(f64::from(length)));
    }
    world.joint_mut(rope).unwrap().set_enabled(false);
    run(&mut world, 1.0);
    assert!(place(&world, load)[1] < -4.0, "it is let go");
}

/// Of an elevator whose weight is removed the car falls.
#[test]
fn without_its_counterweight_a_car_falls() {
    let mut world = earth();
    let (a, b, joint) = machine(&mut world, [1.0, 1.0], 1.0, 0.0);
    assert_eq!((world.joints_of(a), world.joints_of(b)), (vec![joint], vec![joint]));
    world.remove(b);
    world.step();
    assert_eq!(world.events().removed_joints(), [joint]);
    assert_near(velocity(&world, a)[1], -G / 60.0, 1e-6, "speed");
}

/// What is too far apart for the rope comes together at 3 m/s, whatever the ratio, and is not thrown.
#[test]
fn bodies_beyond_the_rope_come_to_it_without_haste() {
    for ratio in [1.0, 0.05, 20.0] {
        let mut world = space();
        let (a, b, joint) = machine(&mut world, [1.0, 1.0], ratio, 0.0);
        let length = 10.0 + ratio * 10.0 - (1.0 + ratio);
        world.joint_mut(joint).unwrap().set_length(length as f32).unwrap();
        // 21 m in 7 s at the ratio of 20.
        for tick in 0..480 {
            world.step();
            let fastest = [a, b].map(|id| velocity(&world, id)[1].abs()).into_iter().fold(0.0, f64::max);
            assert!(fastest < 3.001, "ratio {ratio}, tick {tick}: {fastest} m/s");
        }
        let gap = world.joint(joint).unwrap().error().distance;
        assert!(f64::from(gap) < 1e-6 * length, "ratio {ratio}: {gap} m");
    }
}

#[test]
fn a_pulley_that_makes_no_sense_is_refused_with_a_sentence_and_nothing_changes() {
    let mut world = earth();
    let [a, b] = [0.0, 2.0].map(|x| add(&mut world, disc(x, 0.0, 1.0)));
    let fixed = add(&mut world, Body::fixed(Shape::circle(0.1)));
    let lift = add(&mut world, Body::kinematic(Shape::circle(0.1)));
    let rope = |a, b| Joint::pulley(a, b, WHEELS[0], WHEELS[1]);
    let bad = [
        (Joint::pulley(a, b, [0.0, 5.0], [f64::NAN, 5.0]), "the second wheel is NaN m; give a finite number"),
        (Joint::pulley(a, b, [0.0, 5e12], [0.0, 5.0]), "the first wheel is 5e12 m; give a finite number"),
        (rope(a, b).ratio(0.0), "the ratio is 0; give a finite number from 1e-6 to 1e6"),
        (rope(a, b).ratio(-1.0), "the ratio is -1; give a finite number from 1e-6 to 1e6"),
        (rope(a, b).ratio(f64::INFINITY), "the ratio is inf; give a finite number from 1e-6 to 1e6"),
        (rope(a, b).length(0.0), "the length is 0 m; give a finite number from 1e-6 to 1e12 m"),
        (rope(a, a), "a joint cannot join a body to itself"),
        (rope(fixed, lift), "a joint moves dynamic bodies only; give one that is dynamic"),
        (
            rope(a, b).limits(0.0..=1.0),
            "a pulley joint has no limits; leave it out, or take one of these kinds",
        ),
        (
            Joint::revolute(a, b).ratio(2.0),
            "a revolute joint has no ratio; leave it out, or take one of these",
        ),
    ];
    let before = world.state_hash();
    for (joint, sentence) in bad {
        let error = world.add_joint(joint).expect_err(sentence).to_string();
        assert!(error.starts_with(sentence), "{error}, expected {sentence}");
    }
    assert_eq!((world.joint_count(), world.state_hash()), (0, before));
}
