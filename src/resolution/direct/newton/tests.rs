//! What the solve finds, against solutions in closed form and the complementarity conditions themselves.

use super::*;
use crate::testing::Random;

/// A contact that presses with whatever it takes.
const PRESSES: Kind = Kind::Normal { most: f64::INFINITY };

/// Movers of these masses, kg, at rest, that can be turned as easily as moved.
fn movers(masses: &[f64]) -> Newton {
    let masses: Vec<Triple> = masses.iter().map(|&mass| [mass; 3]).collect();
    Newton { free: vec![[0.0; 3]; masses.len()], masses, ..Newton::default() }
}

/// Adds a row on the x velocity of one mover, or of the second against the first.
fn add_row(newton: &mut Newton, movers: [Option<u32>; 2], kind: Kind) -> usize {
    newton.add_pair(movers, [kind].into_iter());
    let inverse_masses =
        movers.map(|mover| mover.map_or(0.0, |mover| newton.masses[mover as usize][0].recip()));
    let row = newton.rows.last_mut().unwrap();
    row.jacobian = [[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]];
    row.k = inverse_masses[0] + inverse_masses[1];
    leave_unmoved(row, movers);
    newton.rows.len() - 1
}

/// Nothing of a row is of a body that impulses do not move.
fn leave_unmoved(row: &mut Row, movers: [Option<u32>; 2]) {
    for (jacobian, mover) in row.jacobian.iter_mut().zip(movers) {
        if mover.is_none() {
            *jacobian = [0.0; 3];
        }
    }
}

/// Solves all as one part; it must come to an end.
fn solve(newton: &mut Newton) {
    newton.leftmost.clear();
    let mut part = newton.part_from([0; 3]);
    newton.solve(&mut part);
    assert!(!part.is_unsolved, "{newton:?}");
}

/// The impulse of one row of a mover of 2 kg that moves at `speed`, with nothing else.
fn impulse_alone(kind: Kind, speed: f64) -> f64 {
    let mut newton = movers(&[2.0]);
    newton.free[0][0] = speed;
    add_row(&mut newton, [None, Some(0)], kind);
    // The first solve begins from no impulse and may leave a part of the compliance; the next begins from what it found.
    for _ in 0..3 {
        solve(&mut newton);
    }
    assert!((newton.sought[0][0] - speed - 0.5 * newton.rows[0].impulse).abs() < 1e-12, "momentum");
    newton.rows[0].impulse
}

/// A mover of 2 kg is stopped by -2 kg times its speed, or by as much of that as the bounds allow. The tolerance of 1e-5
/// m/s is 2e-5 N s.
#[test]
fn a_row_stops_its_mover_as_far_as_its_bounds_allow() {
    let (free, motor) = (Kind::Joint([f64::NEG_INFINITY, f64::INFINITY]), Kind::Joint([-1.0, 3.0]));
    for speed in [-4.0, -1.0, -0.01, 0.0, 0.3, 0.5, 4.0_f64] {
        let wanted = -2.0 * speed;
        let expected = [
            (free, wanted),
            (PRESSES, wanted.max(0.0)),
            (motor, wanted.clamp(-1.0, 3.0)),
            (Kind::Joint([0.0; 2]), 0.0),
        ];
        for (kind, expected) in expected {
            let found = impulse_alone(kind, speed);
            assert!(
                (found - expected).abs() <= 2e-5,
                "{found} in the place of {expected} N s, {kind:?} at {speed} m/s"
            );
        }
    }
}

/// A mover of 2 kg falls on the ground at 3 m/s and slides along it: it is stopped by 6 N s, and friction takes no more
/// than µ times as much of 2 kg times the speed along.
#[test]
fn friction_is_bounded_by_the_impulse_of_its_row() {
    for (friction, slip) in [(0.5, 1.0), (0.5, 1.4), (0.5, 1.6), (0.5, -9.0), (0.0, 1.0)] {
        let mut newton = movers(&[2.0]);
        newton.free[0] = [-3.0, slip, 0.0];
        let row = add_row(&mut newton, [None, Some(0)], PRESSES);
        let along = add_row(&mut newton, [None, Some(0)], Kind::Friction { normal: row, friction });
        newton.rows[along].jacobian = [[0.0; 3], [0.0, 1.0, 0.0]];
        for _ in 0..5 {
            solve(&mut newton);
        }
        let (most, wanted): (f64, f64) = (6.0 * friction, -2.0 * slip);
        assert!((newton.rows[row].impulse - 6.0).abs() <= 2e-5);
        let found = newton.rows[along].impulse;
        assert!((found - wanted.clamp(-most, most)).abs() <= 4e-5, "{found} N s, µ {friction}, {slip} m/s");
    }
}

/// A chain of joints pulled at its end moves as one: momentum over mass, 10 movers of 1 kg and 5 N s.
#[test]
fn free_rows_make_a_chain_move_as_one() {
    let mut newton = movers(&[1.0; 10]);
    newton.free[9][0] = 5.0;
    for mover in 1..10 {
        add_row(&mut newton, [Some(mover - 1), Some(mover)], Kind::Joint([f64::NEG_INFINITY, f64::INFINITY]));
    }
    for _ in 0..5 {
        solve(&mut newton);
    }
    for mover in 0..10 {
        let speed = newton.sought[mover][0];
        assert!((speed - 0.5).abs() < 1e-4, "{speed} m/s of {mover}");
    }
}

/// A row of each kind by chance, the friction that of an earlier row that presses.
fn any_kind(random: &mut Random, pressing: Option<usize>) -> Kind {
    match (random.below(4), pressing) {
        (0, _) => Kind::Joint([f64::NEG_INFINITY, f64::INFINITY]),
        (1, _) => Kind::Joint([-0.3, 0.5]),
        (2, Some(row)) => Kind::Friction { normal: row, friction: 0.6 },
        _ => PRESSES,
    }
}

/// Rows of every kind between movers of 0.1 to 10 kg. What is found must be what the bounds ask for, told here from the
/// velocities themselves: inside its bounds a row has no speed left; at the lower one it may only open, at the upper one
/// only close. The bounds of friction are those that held in the solve. From stage to stage a row yields to what changes, so
/// this holds once solving again changes nothing.
#[test]
fn what_is_found_satisfies_the_complementarity_conditions_of_every_kind_of_row() {
    let mut random = Random(5);
    let (mut inside, mut at_bounds) = (0, 0);
    for _ in 0..200 {
        let count = 1 + random.below(5);
        let masses: Vec<f64> = (0..count).map(|_| 10.0_f64.powf(random.random_range(-1.0..1.0))).collect();
        let mut newton = movers(&masses);
        for velocity in &mut newton.free {
            *velocity = [(); 3].map(|()| random.random_range(-2.0..2.0));
        }
        let mut pressing = None;
        for number in 0..count + random.below(count + 1) {
            let (mover, other) = (number % count, random.below(count));
            let other = (other != mover && random.below(3) > 0).then_some(other);
            let kind = any_kind(&mut random, pressing);
            let index = add_row(&mut newton, [other, Some(mover)], kind);
            let jacobian = [(); 2].map(|()| [(); 3].map(|()| random.random_range(-1.0..1.0)));
            let square = |side: usize| jacobian[side].iter().map(|entry: &f64| entry * entry).sum::<f64>();
            let row = &mut newton.rows[index];
            row.jacobian = jacobian;
            row.bias = random.random_range(-0.5..0.5);
            // What is not moved goes past: nothing is pushed apart.
            row.carried = row.bias;
            row.k = square(1) / masses[mover as usize]
                + other.map_or(0.0, |other| square(0) / masses[other as usize]);
            leave_unmoved(row, [other, Some(mover)]);
            if matches!(kind, Kind::Normal { .. }) {
                pressing = Some(index);
            }
        }
        for _ in 0..300 {
            solve(&mut newton);
        }
        let mut momentum = newton.free.clone();
        for (row, pair) in newton.rows.iter().zip(&newton.pairs) {
            let u = speed_of(row, pair.movers, &newton.sought);
            let [least, greatest] = row.range;
            // k times a slack of impulse is a speed.
            let slack = 1e-4 / row.k;
            assert!(row.impulse >= least - slack && row.impulse <= greatest + slack, "{row:?}");
            let (is_at_least, is_at_greatest) =
                (row.impulse <= least + slack, row.impulse >= greatest - slack);
            assert!(u <= 1e-4 || is_at_least, "{u} m/s of {row:?}");
            assert!(u >= -1e-4 || is_at_greatest, "{u} m/s of {row:?}");
            *(if is_at_least || is_at_greatest { &mut at_bounds } else { &mut inside }) += 1;
            for (jacobian, mover) in row.jacobian.iter().zip(pair.movers) {
                for (axis, entry) in jacobian.iter().enumerate() {
                    momentum[mover][axis] += entry * row.impulse / newton.masses[mover][axis];
                }
            }
        }
        for (found, expected) in newton.sought.as_flattened().iter().zip(momentum.as_flattened()) {
            assert!((found - expected).abs() < 1e-9, "{found} in the place of {expected} m/s");
        }
    }
    assert!(inside > 100 && at_bounds > 100, "{inside} inside, {at_bounds} at bounds");
}

/// Discs of 0.1 to 10 kg that meet each other and the ground from all sides, as teeth of wheels do: the loads that the first Newton step
/// sees are many times those that remain. Once a solve has come to an end, friction is no more than µ times what presses then. Of few of
/// these contacts limits still move by more than a tenth when they have followed for as long as they may.
#[test]
fn friction_is_bounded_by_what_presses_in_the_end() {
    const FRICTION: f64 = 0.3;
    let mut random = Random(7);
    let (mut over, mut all) = (0, 0);
    for _ in 0..200 {
        let masses: Vec<f64> = (0..6).map(|_| 10.0_f64.powf(random.random_range(-1.0..1.0))).collect();
        let mut newton = movers(&masses);
        for velocity in &mut newton.free {
            *velocity = [(); 3].map(|()| random.random_range(-2.0..2.0));
        }
        for mover in 0..6 {
            let other = random.below(6);
            let movers = [(other != mover).then_some(other), Some(mover)];
            let angle: f64 = random.random_range(0.0..core::f64::consts::TAU);
            let (normal, tangent) = ([angle.cos(), angle.sin(), 0.0], [-angle.sin(), angle.cos(), 1.0]);
            let row = add_row(&mut newton, movers, PRESSES);
            let along = add_row(&mut newton, movers, Kind::Friction { normal: row, friction: FRICTION });
            for (row, [x, y, turn]) in [(row, normal), (along, tangent)] {
                newton.rows[row].jacobian = [[-x, -y, turn], [x, y, turn]];
                newton.rows[row].k *= 1.0 + turn;
                leave_unmoved(&mut newton.rows[row], movers);
            }
        }
        solve(&mut newton);
        for rows in newton.rows.chunks(2) {
            let (most, slack) = (FRICTION * rows[0].impulse, 1e-3 / rows[1].k);
            over += usize::from(rows[1].impulse.abs() > 1.1 * most + slack);
            all += 1;
        }
    }
    assert!(over * 30 <= all, "{over} of {all} are over the limit of friction");
}

/// J v + bias, told from the definition.
fn speed_of(row: &Row, movers: [usize; 2], velocities: &[Triple]) -> f64 {
    let sides = row.jacobian.iter().zip(movers);
    let of_side = |(jacobian, mover): (&Triple, usize)| -> f64 {
        (0..3).map(|axis| jacobian[axis] * velocities[mover][axis]).sum()
    };
    row.bias + sides.map(of_side).sum::<f64>()
}

/// Sweeps alone come to the same for a row by itself: a mover of 2 kg at -1 m/s is stopped by 2 N s in one.
#[test]
fn the_fall_back_sweeps_satisfy_a_row_by_itself() {
    let mut newton = movers(&[2.0]);
    newton.free[0][0] = -1.0;
    add_row(&mut newton, [None, Some(0)], PRESSES);
    let mut part = newton.part_from([0; 3]);
    part.is_unsolved = true;
    newton.solve(&mut part);
    assert_eq!((newton.rows[0].impulse, newton.sought[0][0]), (2.0, 0.0));
}

/// A lift that goes down at 1 m/s takes the floor away from what rests on it as little as one that stands.
#[test]
fn what_rests_is_held_whatever_the_ground_does() {
    let resting = |carried: f64| {
        let mut row = Row::new(PRESSES);
        (row.bias, row.carried) = (carried, carried);
        row.set_range(0.0, 0.0);
        row
    };
    assert!([0.0, 1.0, -1.0].into_iter().all(|carried| resting(carried).is_held()));
    let mut apart = resting(1.0);
    apart.bias += 1.0;
    assert!(!apart.is_held(), "it may close at 1 m/s");
}
