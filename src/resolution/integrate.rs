//! Integration: the kick (velocity) and the drift (position) of the substep.
//!
//! A substep kicks half before the drift and half after it (velocity Verlet; L. Verlet, 1967). It costs what
//! one kick costs, as the accelerations of the second half serve the first half of the next substep, and is
//! of second order: bodies under constant forces fall exactly.

use core::ops::Range;

use crate::compute::{
    self, BodyState, COLUMN, Column, Columns, Divide, Job, Lane, LaneVec2, ThreadPool, Width, columns,
};
use crate::math::Vec2;

/// What acts on a body, or on as many as a lane holds.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Kick<C> {
    /// Acceleration of the centre where the body is now, m/s².
    pub(crate) acceleration: LaneVec2<C>,
    /// What rounding has kept out of the velocity so far, m/s. At 240 Hz and four substeps half a kick of
    /// gravity is 5e-3 m/s; a velocity of 20 m/s in `f32` would lose up to 1e-6 of it, each time to the
    /// same side.
    pub(crate) compensation: LaneVec2<C>,
    /// Angular acceleration, rad/s².
    pub(crate) angular_acceleration: C,
}

columns!(Kick { acceleration, compensation, angular_acceleration });

/// What acts on the bodies, by row.
#[derive(Clone, Debug, Default)]
pub(crate) struct Kicks {
    columns: Vec<Kick<Column>>,
}

impl Kicks {
    /// Makes room for so many rows; nothing acts on them.
    pub(crate) fn reset(&mut self, rows: usize) {
        self.columns.clear();
        self.columns.resize(rows.div_ceil(COLUMN), Kick::default());
    }

    /// Writes what acts on the bodies in some rows.
    pub(crate) fn fill(
        &mut self,
        pool: &ThreadPool,
        rows: Range<usize>,
        kick_of: impl Fn(usize) -> Kick<f32> + Sync,
    ) {
        self.for_each(pool, rows, FILL_COST, |row, column, place| {
            let kick = kick_of(row);
            column.acceleration.store(place, kick.acceleration);
            column.compensation.store(place, kick.compensation);
            column.angular_acceleration.set(place, kick.angular_acceleration);
        });
    }

    /// Writes the accelerations, m/s², of those of the bodies in some rows that have one.
    pub(crate) fn accelerate(
        &mut self,
        pool: &ThreadPool,
        rows: Range<usize>,
        acceleration_of: impl Fn(usize) -> Option<Vec2> + Sync,
    ) {
        self.for_each(pool, rows, ACCELERATE_COST, |row, column, place| {
            if let Some(acceleration) = acceleration_of(row) {
                column.acceleration.store(place, acceleration.into());
            }
        });
    }

    /// Calls `change` with each of some rows, its column and its place there.
    fn for_each(
        &mut self,
        pool: &ThreadPool,
        rows: Range<usize>,
        cost: usize,
        change: impl Fn(usize, &mut Kick<Column>, usize) + Sync,
    ) {
        let numbers = rows.start / COLUMN..rows.end.div_ceil(COLUMN);
        pool.run((numbers.clone(), &mut self.columns[numbers]), cost, |(numbers, columns)| {
            for (number, column) in numbers.zip(columns) {
                let first = number * COLUMN;
                for row in rows.start.max(first)..rows.end.min(first + COLUMN) {
                    change(row, column, row - first);
                }
            }
        });
    }

    /// Acceleration of the body of a row, m/s².
    pub(crate) fn acceleration(&self, row: u32) -> Vec2 {
        self.columns[row as usize / COLUMN].acceleration.load::<f32>(row as usize % COLUMN).into()
    }

    /// What rounding has kept out of the velocity of the body of a row, m/s.
    pub(crate) fn compensation(&self, row: usize) -> Vec2 {
        self.columns[row / COLUMN].compensation.load::<f32>(row % COLUMN).into()
    }
}

/// Speeds beyond which velocities are cut, far above use: they keep numbers finite, whatever comes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SpeedLimits {
    /// Per component of the velocity, m/s.
    pub(crate) speed: f32,
    /// Angular velocity, rad/s.
    pub(crate) spin: f32,
}

/// What moves bodies on, in this order.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Advance {
    /// How long they drift, s.
    pub(crate) drift: Option<f32>,
    /// How long the forces act, s.
    pub(crate) kick: Option<f32>,
    pub(crate) limits: SpeedLimits,
}

/// What it costs to move sixteen bodies on, to find what acts on them, and to find how a place accelerates them, ns.
const COST: usize = 30;
const FILL_COST: usize = 120;
const ACCELERATE_COST: usize = 200;

/// Moves the bodies in `rows` on, without damping: their states and what acts on them, by row; states in whole columns.
pub(crate) fn integrate(
    pool: &ThreadPool,
    width: Width,
    rows: Range<usize>,
    states: &mut [BodyState],
    kicks: &mut Kicks,
    advance: Advance,
) {
    debug_assert!(states.len().is_multiple_of(COLUMN), "{} rows", states.len());
    if advance.drift.is_none() && advance.kick.is_none() {
        return;
    }
    let first = rows.start / COLUMN;
    let (states, columns) = (&mut states[first * COLUMN..], &mut kicks.columns[first..]);
    let rows = rows.start - first * COLUMN..rows.end - first * COLUMN;
    let pass = Integrate { rows, states, columns, advance };
    pool.run(pass, COST, |part| compute::run(width, part));
}

/// So many rows are moved on one by one rather than with a lane of which the others stay.
const FEW: usize = 2;

/// A pass over some rows; the first of all stands in the first place of its column.
struct Integrate<'a> {
    rows: Range<usize>,
    states: &'a mut [BodyState],
    columns: &'a mut [Kick<Column>],
    advance: Advance,
}

impl Divide for Integrate<'_> {
    fn count(&self) -> usize {
        self.rows.end.div_ceil(COLUMN)
    }

    fn divide(self, at: usize) -> (Self, Self) {
        let Self { rows, states, columns, advance } = self;
        let row = at * COLUMN;
        let (first_states, last_states) = states.split_at_mut(row.min(states.len()));
        let (first_columns, last_columns) = columns.split_at_mut(at);
        let first_rows = rows.start.min(row)..rows.end.min(row);
        let last_rows = rows.start.max(row) - row..rows.end.max(row) - row;
        let part = |rows, states, columns| Self { rows, states, columns, advance };
        (part(first_rows, first_states, first_columns), part(last_rows, last_states, last_columns))
    }
}

impl Integrate<'_> {
    /// Moves some rows of a lane on; the others stay as they are.
    #[inline(always)]
    fn together<L: Lane>(&mut self, rows: Range<usize>) {
        // Asked for once, so that nothing is read and written but velocities where bodies do not drift.
        match self.advance.drift {
            Some(h) => self.advance_rows::<L>(rows, Some(h)),
            None => self.advance_rows::<L>(rows, None),
        }
    }

    #[inline(always)]
    fn advance_rows<L: Lane>(&mut self, rows: Range<usize>, drift_time: Option<f32>) {
        let first = rows.start / L::WIDTH * L::WIDTH;
        let (column, place) = (&mut self.columns[first / COLUMN], first % COLUMN);
        let before = L::load_rows(self.states, first);
        let mut state = before;
        if let Some(h) = drift_time {
            drift(&mut state, h);
        }
        let mut this = column.load::<L>(place);
        let compensation_before = this.compensation;
        if let Some(t) = self.advance.kick {
            kick(&mut state, &mut this, t, self.advance.limits);
        }
        if rows.len() < L::WIDTH {
            // Halfway between a row's place and that before it.
            let edge = |row: usize| L::splat((place + row - first) as f32 - 0.5);
            let places = L::load(&Column::PLACES, place);
            let moves = L::both(places.greater(edge(rows.start)), edge(rows.end).greater(places));
            state = BodyState::select(moves, &state, &before);
            this.compensation = LaneVec2::select(moves, this.compensation, compensation_before);
        }
        if self.advance.kick.is_some() {
            column.compensation.store(place, this.compensation);
        }
        if drift_time.is_some() {
            L::store_rows(self.states, first, &state);
        } else {
            L::store_velocities(self.states, first, &state);
        }
    }

    /// Compiled once, and not within every width.
    #[inline(never)]
    fn one_by_one(&mut self, rows: Range<usize>) {
        rows.for_each(|row| self.together::<f32>(row..row + 1));
    }
}

impl Job for Integrate<'_> {
    #[inline(always)]
    fn run<L: Lane>(mut self) {
        let Range { mut start, end } = self.rows;
        while start < end {
            let rows = start..end.min((start / L::WIDTH + 1) * L::WIDTH);
            start = rows.end;
            if rows.len() < L::WIDTH && rows.len() <= FEW {
                self.one_by_one(rows);
            } else {
                self.together::<L>(rows);
            }
        }
    }
}

/// v + gain + compensation; what rounding loses of it is the new compensation (Kahan, 1965; sum by Knuth's two-sum).
#[inline(always)]
fn add_compensated<L: Lane>(
    v: LaneVec2<L>,
    gain: LaneVec2<L>,
    compensation: &mut LaneVec2<L>,
) -> LaneVec2<L> {
    let (zero, infinity) = (L::splat(0.0), L::splat(f32::INFINITY));
    let gain = gain + *compensation;
    let sum = v + gain;
    let gained = sum - v;
    let lost = (v - (sum - gained)) + (gain - gained);
    // A speed so great that the sum overflows leaves nothing to compensation.
    let is_finite = L::both(infinity.greater(lost.x.abs()), infinity.greater(lost.y.abs()));
    *compensation = LaneVec2 { x: L::select(is_finite, lost.x, zero), y: L::select(is_finite, lost.y, zero) };
    sum
}

/// v += t·a, with what rounding loses carried to the next kick.
#[inline(always)]
fn kick<L: Lane>(state: &mut BodyState<L>, kick: &mut Kick<L>, t: f32, limits: SpeedLimits) {
    let sum = add_compensated(state.velocity, kick.acceleration * L::splat(t), &mut kick.compensation);
    state.velocity = LaneVec2 { x: clamp(sum.x, limits.speed), y: clamp(sum.y, limits.speed) };
    let w = state.angular_velocity + kick.angular_acceleration * L::splat(t);
    state.angular_velocity = clamp(w, limits.spin);
}

/// x += h·v, and the rotation turns by exactly h·w.
#[inline(always)]
pub(crate) fn drift<L: Lane>(state: &mut BodyState<L>, h: f32) {
    let h = L::splat(h);
    state.delta_position = state.delta_position + state.velocity * h;
    turn(state, state.angular_velocity * h);
}

/// Moves a body whose velocity has changed at `time`, s, into the substep by what its drift will miss: until then it
/// went on with the velocity `before`.
pub(crate) fn drift_until(time: f32, before: &BodyState, state: &mut BodyState) {
    state.delta_position = state.delta_position + (before.velocity - state.velocity) * time;
    let missed_turn = (before.angular_velocity - state.angular_velocity) * time;
    turn(state, missed_turn);
}

/// Turns the body by `angle`, rad. What does not turn stays as it is, to the bit.
#[inline(always)]
pub(crate) fn turn<L: Lane>(state: &mut BodyState<L>, angle: L) {
    let turns = angle.abs().greater(L::splat(0.0));
    if L::bits(turns) == 0 {
        return;
    }
    let (sin, cos) = angle.sin_cos();
    let q = state.delta_rotation;
    state.delta_rotation.c = L::select(turns, q.c * cos - q.s * sin, q.c);
    state.delta_rotation.s = L::select(turns, q.s * cos + q.c * sin, q.s);
}

/// `value` cut to [-limit, limit]; 0 for NaN.
#[inline(always)]
fn clamp<L: Lane>(value: L, limit: f32) -> L {
    let (zero, limit) = (L::splat(0.0), L::splat(limit));
    let beyond = L::select(value.greater(zero), limit, L::select(zero.greater(value), -limit, zero));
    L::select(L::both(limit.greater(value), value.greater(-limit)), value, beyond)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::{LaneRot, Lanes};

    #[test]
    fn rows_in_lanes_move_as_one_by_one_and_others_stay() {
        // One by one, parts of lanes and whole ones, up to the last body's row and not so far.
        let parts = [(1..2, 2), (1..9, 9), (1..16, 16), (1..50, 50), (2..50, 50), (1..41, 50)];
        let all = parts.into_iter().flat_map(|part| [Some(0.01), None].map(|drift| (part.clone(), drift)));
        for ((rows, count), drift) in all {
            let moved = [Lanes::One, Lanes::Four, Lanes::Eight, Lanes::Sixteen].map(|lanes| {
                let of_row = |row: usize| match row {
                    row if row == 0 || row >= count => BodyState::REST,
                    _ => BodyState {
                        velocity: Vec2::new(row as f32, -3.0).into(),
                        angular_velocity: 0.1 * row as f32,
                        ..BodyState::REST
                    },
                };
                let mut states: Vec<_> = (0..count.next_multiple_of(COLUMN)).map(of_row).collect();
                let before = states.clone();
                let (pool, mut kicks) = (ThreadPool::default(), Kicks::default());
                kicks.reset(count);
                let acceleration = Vec2::new(0.0, -9.81).into();
                kicks.fill(&pool, rows.clone(), |_| Kick { acceleration, ..Kick::default() });
                let limits = SpeedLimits { speed: 1e6, spin: 1e6 };
                let advance = Advance { drift, kick: Some(0.005), limits };
                integrate(&pool, lanes.width(), rows.clone(), &mut states, &mut kicks, advance);
                let compensations: Vec<_> = (0..count).map(|row| kicks.compensation(row)).collect();
                for row in (0..states.len()).filter(|row| !rows.contains(row)) {
                    let stays = |states: &[BodyState]| format!("{:?}", states[row]);
                    assert_eq!(stays(&states), stays(&before), "row {row}");
                    assert!(
                        compensations.get(row).is_none_or(|&compensation| compensation == Vec2::ZERO),
                        "row {row}"
                    );
                }
                let BodyState { velocity, delta_rotation: LaneRot { s, .. }, .. } = states[rows.end - 1];
                assert!(velocity.y < -3.0, "the last row has got its kick");
                assert_eq!(s > 0.0, drift.is_some(), "the last row has turned");
                format!("{states:?} {compensations:?}")
            });
            assert!(moved.iter().all(|other| *other == moved[0]), "rows {rows:?}");
        }
    }
}
