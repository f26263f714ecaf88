//! Every lane against `f32`, bit for bit.

#[cfg(feature = "parallel")]
use crate::compute::ThreadPool;
use crate::compute::{
    BodyState, COLUMN, Column, GROUND_ROW, Job, Lane, LaneRot, LaneVec2, Lanes, PairBlocks, RowPairs, Width,
    portable, run,
};
use crate::math::trig;

#[test]
fn a_pair_knows_which_bodies_it_moves() {
    for (a_moves, b_moves) in [(false, true), (true, false), (true, true)] {
        let mut rows = [[3; COLUMN]; 2];
        (rows[0][14], rows[1][14]) = (7, 5);
        let mut pairs = RowPairs::new(rows);
        pairs.set_moves::<f32>(14, [a_moves, b_moves].map(|moves| f32::from(u8::from(moves))));
        assert_eq!((pairs.get(14), pairs.get(13)), ([7, 5], [3, 3]));
        assert_eq!(pairs.moves::<1>(14), [u32::from(a_moves), u32::from(b_moves)]);
        assert_eq!(pairs.moves::<16>(0), [a_moves, b_moves].map(|moves| u32::from(moves) << 14));
        pairs.set_moves::<f32>(14, [0.0, -1.0]);
        assert_eq!(pairs.moves::<8>(8), [0, 0]);
    }
}

/// Numbers on which operations differ if they differ at all.
const SPECIAL: [f32; 16] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    1.5,
    -3.25,
    1e-42,
    -1e-42,
    f32::MIN_POSITIVE,
    f32::MAX,
    f32::MIN,
    f32::INFINITY,
    f32::NEG_INFINITY,
    f32::NAN,
    16_777_217.0,
    0.1,
];

/// Does the work at every width there is on this processor; a width that it has not is done at a smaller one.
fn at_every_width(job: impl Job + Copy) {
    for lanes in [Lanes::One, Lanes::Four, Lanes::Eight, Lanes::Sixteen, Lanes::Auto] {
        run(lanes.width(), job);
    }
    job.run::<portable::F32x4>();
}

fn column(numbers: [f32; COLUMN]) -> Column {
    let mut column = Column::default();
    for (place, number) in numbers.into_iter().enumerate() {
        column.set(place, number);
    }
    column
}

/// Whether two numbers are the same in every bit, or both not a number: which NaN an operation gives is not
/// defined.
#[track_caller]
fn assert_same(found: f32, expected: f32, what: &str) {
    let are_same = found.to_bits() == expected.to_bits() || (found.is_nan() && expected.is_nan());
    assert!(are_same, "{what}: {found:?} is not {expected:?}");
}

/// What every operation gives for two numbers.
#[inline(always)]
fn operations<L: Lane>(x: L, y: L) -> [(&'static str, L); 11] {
    let both = L::both(x.greater(L::splat(0.0)), y.greater(L::splat(0.0)));
    [
        ("+", x + y),
        ("-", x - y),
        ("*", x * y),
        ("/", x / y),
        ("negation", -x),
        ("min", x.min(y)),
        ("max", x.max(y)),
        ("root", x.sqrt()),
        ("greater", L::select(x.greater(y), x, y)),
        ("select", L::select(x.greater(y), L::splat(1.0), -L::splat(0.0))),
        ("both", L::select(both, x, y)),
    ]
}

/// Compares all pairs of special numbers, in every place of a lane.
#[derive(Clone, Copy)]
struct Operations;

impl Job for Operations {
    #[inline(always)]
    fn run<L: Lane>(self) {
        for shift in 0..SPECIAL.len() {
            for start in (0..SPECIAL.len()).step_by(COLUMN) {
                let a = column(core::array::from_fn(|place| SPECIAL[start + place]));
                let b =
                    column(core::array::from_fn(|place| SPECIAL[(start + place + shift) % SPECIAL.len()]));
                for first in (0..COLUMN).step_by(L::WIDTH) {
                    let found = operations(L::load(&a, first), L::load(&b, first));
                    let bits = L::bits(L::load(&a, first).greater(L::load(&b, first)));
                    for place in 0..L::WIDTH {
                        let is_greater = a.get(first + place) > b.get(first + place);
                        assert_eq!(bits >> place & 1, u32::from(is_greater), "bits");
                    }
                    assert_eq!(u64::from(bits) >> L::WIDTH, 0, "bits");
                    for (number, (what, lane)) in found.into_iter().enumerate() {
                        let mut result = Column::default();
                        lane.store(&mut result, first);
                        for place in first..first + L::WIDTH {
                            let expected = operations(a.get(place), b.get(place))[number].1;
                            let (x, y) = (a.get(place), b.get(place));
                            assert_same(result.get(place), expected, &format!("{what} of {x} and {y}"));
                        }
                    }
                }
            }
        }
    }
}

#[test]
fn every_operation_gives_the_same_bits_in_lanes_as_alone() {
    at_every_width(Operations);
}

/// `max` and `min` are those of SSE: the second number where neither is larger, which `f32::max` leaves open.
#[test]
fn max_and_min_of_zeros_and_of_nan_are_the_second() {
    assert_same(Lane::max(0.0_f32, -0.0), -0.0, "max");
    assert_same(Lane::min(-0.0_f32, 0.0), 0.0, "min");
    assert_same(Lane::max(f32::NAN, 1.0), 1.0, "max");
    assert!(Lane::max(1.0, f32::NAN).is_nan());
}

/// Angles in every part of the turn, and the special numbers.
#[derive(Clone, Copy)]
struct SinCos;

impl Job for SinCos {
    #[inline(always)]
    fn run<L: Lane>(self) {
        let turn = |number: usize| (number as f32 - 2000.0) * 0.001_9;
        let angles: Vec<f32> = (0..4000).map(turn).chain(SPECIAL).collect();
        for part in angles.chunks(COLUMN) {
            let angles = column(core::array::from_fn(|place| part[place]));
            for first in (0..COLUMN).step_by(L::WIDTH) {
                let (sin, cos) = L::load(&angles, first).sin_cos();
                let (mut sines, mut cosines) = (Column::default(), Column::default());
                sin.store(&mut sines, first);
                cos.store(&mut cosines, first);
                for place in first..first + L::WIDTH {
                    let (sin, cos) = trig::sin_cos(angles.get(place));
                    assert_same(sines.get(place), sin, &format!("sine of {}", angles.get(place)));
                    assert_same(cosines.get(place), cos, &format!("cosine of {}", angles.get(place)));
                }
            }
        }
    }
}

#[test]
fn sine_and_cosine_are_the_same_bits_in_lanes_as_alone() {
    at_every_width(SinCos);
}

/// States whose numbers all differ.
fn states() -> Vec<BodyState> {
    (0..40_u8)
        .map(f32::from)
        .map(|row| BodyState {
            velocity: LaneVec2 { x: row + 0.1, y: row + 0.2 },
            angular_velocity: row + 0.3,
            padding: 0.0,
            delta_position: LaneVec2 { x: row + 0.4, y: row + 0.5 },
            delta_rotation: LaneRot { c: row + 0.6, s: row + 0.7 },
        })
        .collect()
}

fn numbers(state: &BodyState) -> [f32; 7] {
    let BodyState { velocity, angular_velocity, delta_position, delta_rotation, .. } = *state;
    let (c, s) = (delta_rotation.c, delta_rotation.s);
    [velocity.x, velocity.y, angular_velocity, delta_position.x, delta_position.y, c, s]
}

/// Pairs of rows, and which of them they move.
fn rows(rows: [([u32; 2], [bool; 2]); COLUMN]) -> RowPairs {
    let mut pairs = RowPairs::default();
    for (place, (pair, moves)) in rows.into_iter().enumerate() {
        pairs.set_one(place, pair, moves);
    }
    pairs
}

#[inline(always)]
fn lanes_of<L: Lane>(state: &BodyState<L>) -> [L; 7] {
    let BodyState { velocity, angular_velocity, delta_position, delta_rotation, .. } = *state;
    let (c, s) = (delta_rotation.c, delta_rotation.s);
    [velocity.x, velocity.y, angular_velocity, delta_position.x, delta_position.y, c, s]
}

/// Gathers rows, some of them twice, and compares with the rows themselves.
#[derive(Clone, Copy)]
struct Gather;

impl Job for Gather {
    #[inline(always)]
    fn run<L: Lane>(self) {
        let states = states();
        let first_eight = [[3, 2], [0, 18], [19, 0], [7, 4], [7, 5], [1, 0], [12, 11], [0, 10]];
        let rows = rows(core::array::from_fn(|place| {
            (first_eight[place % 8].map(|row| row + 2 * (place / 8) as u32), [false; 2])
        }));
        for first in (0..COLUMN).step_by(L::WIDTH) {
            let all = rows.gather::<L>(&states, first);
            let half = rows.gather_velocities::<L>(&states, first);
            for (body, number) in (0..2).flat_map(|body| (0..7).map(move |number| (body, number))) {
                let (mut found, mut velocities) = (Column::default(), Column::default());
                lanes_of(&all[body])[number].store(&mut found, first);
                lanes_of(&half[body])[number].store(&mut velocities, first);
                for place in first..first + L::WIDTH {
                    let state = &states[rows.get(place)[body] as usize];
                    let still = numbers(&BodyState::REST)[number];
                    let velocity = if number < 3 { numbers(state)[number] } else { still };
                    assert_same(found.get(place), numbers(state)[number], "gathered");
                    assert_same(velocities.get(place), velocity, "gathered velocity");
                }
            }
        }
    }
}

#[test]
fn a_gathered_state_is_that_of_its_row() {
    at_every_width(Gather);
}

#[test]
fn the_greatest_number_of_a_column_is_found_wherever_it_stands() {
    for place in 0..COLUMN {
        let mut column = Column::default();
        column.set((place + 5) % COLUMN, 1.0);
        column.set(place, 2.0);
        assert_eq!(column.greatest(), 2.0, "at {place}");
    }
}

/// Turns rows into lanes and back.
#[derive(Clone, Copy)]
struct Rows;

impl Job for Rows {
    #[inline(always)]
    fn run<L: Lane>(self) {
        let states = states();
        for first in 0..=states.len() - L::WIDTH {
            let loaded = L::load_rows(&states, first);
            for (number, lane) in lanes_of(&loaded).into_iter().enumerate() {
                let mut found = Column::default();
                lane.store(&mut found, 0);
                for place in 0..L::WIDTH {
                    assert_same(found.get(place), numbers(&states[first + place])[number], "loaded");
                }
            }
            let mut copy = vec![BodyState::REST; states.len()];
            L::store_rows(&mut copy, first, &loaded);
            for (row, (found, state)) in copy.iter().zip(&states).enumerate() {
                let is_written = (first..first + L::WIDTH).contains(&row);
                let expected = if is_written { state } else { &BodyState::REST };
                assert_eq!(numbers(found), numbers(expected), "row {row}");
            }
            copy.fill(BodyState::REST);
            L::store_velocities(&mut copy, first, &loaded);
            for (row, (found, state)) in copy.iter().zip(&states).enumerate() {
                let is_written = (first..first + L::WIDTH).contains(&row);
                let BodyState { velocity, angular_velocity, .. } =
                    *if is_written { state } else { &BodyState::REST };
                let expected = BodyState { velocity, angular_velocity, ..BodyState::REST };
                assert_eq!(numbers(found), numbers(&expected), "row {row}");
            }
        }
    }
}

#[test]
fn rows_are_loaded_and_stored_as_they_are() {
    at_every_width(Rows);
}

/// Scatters velocities with every pattern of eight bodies that move, beside eight others of which none, some, or all do;
/// those that do not being the ground or the same more than once. Compares with what `f32` does.
#[derive(Clone, Copy)]
struct Scatter;

impl Job for Scatter {
    #[inline(always)]
    fn run<L: Lane>(self) {
        // 7 and 32 have no common divisor.
        let distinct = |place: usize, body: usize| 5 + (7 * (2 * place + body) % 32) as u32;
        for pattern in
            (0..256_u32).flat_map(|eight| [0, (89 * eight) & 0xFF, 0xFF].map(|other| other << 8 | eight))
        {
            // Those of b move in another pattern.
            let moves = |place: usize| [pattern & 1 << place != 0, (pattern * 37) & (1 << (15 - place)) != 0];
            let kinematic = |place: usize| if place.is_multiple_of(2) { GROUND_ROW } else { 4 };
            let row = |place: usize, body: usize| {
                if moves(place)[body] { distinct(place, body) } else { kinematic(place) }
            };
            let pair = |place| ([row(place, 0), row(place, 1)], moves(place));
            assert_scattered_like_alone::<L>(&rows(core::array::from_fn(pair)));
        }
    }
}

/// What a contact might do to its bodies.
#[inline(always)]
fn push<L: Lane>([a, b]: &mut [BodyState<L>; 2]) {
    a.velocity = a.velocity * L::splat(2.0);
    a.angular_velocity = -a.angular_velocity;
    b.velocity = b.velocity * L::splat(-3.0);
    b.angular_velocity = b.angular_velocity + L::splat(1.0);
}

#[inline(always)]
fn push_all<L: Lane>(rows: &RowPairs) -> Vec<BodyState> {
    let (mut states, mut blocks) = (states(), PairBlocks::<()>::default());
    blocks.resize(1);
    blocks.all_mut().0[0] = *rows;
    let mut over = blocks.over(&mut states);
    let ((), mut of_block) = over.get_mut(0);
    for first in (0..COLUMN).step_by(L::WIDTH) {
        let mut pair = of_block.gather::<L>(first);
        push(&mut pair);
        of_block.scatter_velocities(first, &pair);
    }
    states
}

#[inline(always)]
fn assert_scattered_like_alone<L: Lane>(rows: &RowPairs) {
    let (found, expected) = (push_all::<L>(rows), push_all::<f32>(rows));
    for (found, expected) in found.iter().zip(&expected) {
        assert_eq!(numbers(found), numbers(expected));
        assert_eq!(found.padding, 0.0);
    }
}

#[test]
fn velocities_are_scattered_to_the_bodies_that_move_and_to_no_other() {
    at_every_width(Scatter);
}

/// A row that is not there is refused, in release as well.
#[derive(Clone, Copy)]
struct Refuse;

impl Job for Refuse {
    #[inline(always)]
    fn run<L: Lane>(self) {
        for row in [40, 41, u32::MAX, 1 << 31] {
            for (place, pair) in (0..COLUMN).flat_map(|place| [(place, [row, 1]), (place, [1, row])]) {
                let mut rows = RowPairs::default();
                rows.set_one(place, pair, [true; 2]);
                let first = place / L::WIDTH * L::WIDTH;
                let gather = || _ = rows.gather::<L>(&states(), first);
                assert!(std::panic::catch_unwind(gather).is_err(), "row {row} was gathered");
                let gather = || _ = rows.gather_velocities::<L>(&states(), first);
                assert!(std::panic::catch_unwind(gather).is_err(), "row {row} was gathered");
                let scatter = || {
                    let (mut states, mut blocks) = (states(), PairBlocks::<()>::default());
                    blocks.resize(1);
                    blocks.all_mut().0[0] = rows;
                    let mut over = blocks.over(&mut states);
                    over.get_mut(0).1.scatter_velocities::<L>(first, &[BodyState::at_rest(); 2]);
                };
                assert!(std::panic::catch_unwind(scatter).is_err(), "row {row} was scattered to");
            }
        }
    }
}

#[test]
fn a_row_that_is_not_there_is_refused() {
    at_every_width(Refuse);
}

#[test]
fn a_width_is_never_more_than_was_asked_for() {
    let width_of = |width: Width| {
        #[derive(Clone, Copy)]
        struct Measure<'a>(&'a core::cell::Cell<usize>);
        impl Job for Measure<'_> {
            fn run<L: Lane>(self) {
                self.0.set(L::WIDTH);
            }
        }
        let found = core::cell::Cell::new(0);
        run(width, Measure(&found));
        found.get()
    };
    assert_eq!(width_of(Lanes::One.width()), 1);
    assert_eq!(width_of(Lanes::One.width()), 1);
    assert_eq!(width_of(Lanes::Four.width()), 4);
    assert!([4, 8].contains(&width_of(Lanes::Eight.width())));
    assert!(width_of(Lanes::Sixteen.width()) >= width_of(Lanes::Eight.width()));
    assert_eq!(width_of(Lanes::Sixteen.width()), width_of(Lanes::Auto.width()));
    for size in 1..100 {
        // None of half the width would do, or the processor has none wider.
        let fastest = width_of(Lanes::Auto.width_for([size].into_iter()));
        assert!(fastest == 4 || fastest / 2 < size, "{fastest} lanes for {size}");
        assert!(fastest >= size.min(8).min(Lanes::Auto.count()), "{fastest} lanes for {size}");
        for asked in [Lanes::One, Lanes::Four, Lanes::Eight, Lanes::Sixteen] {
            assert_eq!(width_of(asked.width_for([size].into_iter())), asked.count());
        }
    }
    // Lanes that are half full, and full ones.
    assert_eq!(width_of(Lanes::Auto.width_for([8; 20].into_iter())), Lanes::Eight.count());
    assert_eq!(width_of(Lanes::Auto.width_for([16; 20].into_iter())), Lanes::Auto.count());
    for lanes in [Lanes::One, Lanes::Four, Lanes::Eight, Lanes::Sixteen, Lanes::Auto] {
        assert_eq!(lanes.count(), width_of(lanes.width()));
    }
}

/// Every item is in one part, whatever the number of threads.
#[test]
#[cfg(feature = "parallel")]
fn work_is_divided_into_parts_that_share_nothing() {
    // Items that cost nothing, so that work is divided however little it is, and some that do, ns.
    for (threads, cost) in [1, 2, 3, 4, 16].into_iter().flat_map(|threads| [(threads, 1), (threads, 150)]) {
        let mut pool = ThreadPool::default();
        if cost == 1 {
            pool.divide_all();
        }
        let _at_work = pool.begin_step(threads, usize::MAX / 1000);
        for count in [0, 1, 2, 3, 7, 31, 32, 33, 1000] {
            let mut visits = vec![0; count];
            pool.run((0..count, &mut visits[..]), cost, |(numbers, visits)| {
                assert_eq!(numbers.len(), visits.len());
                visits.iter_mut().zip(numbers).for_each(|(visits, number)| *visits += number + 1);
            });
            assert!(visits.iter().copied().eq(1..=count), "{count} items of {cost} ns on {threads} threads");
        }
    }
}

#[test]
#[cfg(feature = "parallel")]
fn a_part_that_fails_fails_the_work_and_the_next_work_is_done() {
    let mut pool = ThreadPool::default();
    pool.divide_all();
    let at_work = pool.begin_step(2, 0);
    let fail = || pool.run(0..100, 1, |numbers| assert!(!numbers.contains(&70), "part with 70"));
    assert!(std::panic::catch_unwind(std::panic::AssertUnwindSafe(fail)).is_err());
    let done = std::sync::atomic::AtomicUsize::new(0);
    pool.run(0..100, 1, |numbers| _ = done.fetch_add(numbers.len(), std::sync::atomic::Ordering::Relaxed));
    assert_eq!(done.into_inner(), 100);
    drop(at_work);
    assert!(pool.is_alone());
}

#[test]
#[cfg(feature = "parallel")]
fn threads_rest_after_a_panic_in_a_step_and_work_in_the_next() {
    let mut pool = ThreadPool::default();
    pool.divide_all();
    for _ in 0..3 {
        let mut step = || {
            let _at_work = pool.begin_step(2, 0);
            assert!(!pool.is_alone());
            panic!("beside all parts");
        };
        assert!(std::panic::catch_unwind(std::panic::AssertUnwindSafe(&mut step)).is_err());
        assert!(pool.is_alone());
    }
}
