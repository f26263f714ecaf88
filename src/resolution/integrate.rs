//! Integration: the kick (velocity) and the drift (position) of the substep.
//!
//! A substep kicks half before the drift and half after it (velocity Verlet; L. Verlet, 1967). It costs what
//! one kick costs, as the accelerations of the second half serve the first half of the next substep, and is
//! of second order: bodies under constant forces fall exactly.

use crate::compute::{
    BodyState, ByColumn, COLUMN, Column, Columns, Executor, Job, Lane, LaneVec2, ThreadPool, columns,
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

/// What acts on the bodies, by row. The ground's row and those that are no body's have nothing, and so stay at rest.
#[derive(Clone, Debug, Default)]
pub(crate) struct Kicks {
    /// How many rows there are.
    count: usize,
    columns: Vec<Kick<Column>>,
}

impl Kicks {
    /// Writes what acts on the bodies in the first `count` rows, and nothing for the other rows of their columns.
    pub(crate) fn fill(
        &mut self,
        pool: &ThreadPool,
        count: usize,
        kick_of: impl Fn(usize) -> Kick<f32> + Sync,
    ) {
        self.count = count;
        self.columns.clear();
        self.columns.resize(count.div_ceil(COLUMN), Kick::default());
        self.for_each(pool, FILL_COST, |row, column, place| column.store::<f32>(place, kick_of(row)));
    }

    /// Writes the accelerations, m/s², of those bodies that have one.
    pub(crate) fn accelerate(
        &mut self,
        pool: &ThreadPool,
        acceleration_of: impl Fn(usize) -> Option<Vec2> + Sync,
    ) {
        self.for_each(pool, ACCELERATE_COST, |row, column, place| {
            if let Some(acceleration) = acceleration_of(row) {
                column.acceleration.store::<f32>(place, acceleration.into());
            }
        });
    }

    /// Calls `change` with each row, its column and its place there.
    fn for_each(
        &mut self,
        pool: &ThreadPool,
        cost: usize,
        change: impl Fn(usize, &mut Kick<Column>, usize) + Sync,
    ) {
        pool.run((ByColumn(0..self.count), &mut self.columns[..]), cost, |(rows, columns)| {
            let rows = rows.0;
            for row in rows.clone() {
                change(row, &mut columns[(row - rows.start) / COLUMN], row % COLUMN);
            }
        });
    }

    /// Acceleration of the body of a row, m/s².
    pub(crate) fn acceleration(&self, row: u32) -> Vec2 {
        self.columns[row as usize / COLUMN].acceleration.load::<f32>(row as usize % COLUMN).to_vec2()
    }

    /// Angular acceleration of the body of a row, rad/s².
    pub(crate) fn angular_acceleration(&self, row: u32) -> f32 {
        self.columns[row as usize / COLUMN].angular_acceleration.load::<f32>(row as usize % COLUMN)
    }

    /// What rounding has kept out of the velocity of the body of a row, m/s.
    pub(crate) fn compensation(&self, row: usize) -> Vec2 {
        self.columns[row / COLUMN].compensation.load::<f32>(row % COLUMN).to_vec2()
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

impl SpeedLimits {
    /// Cuts the velocities of a body; what is not a number becomes 0.
    #[inline(always)]
    pub(crate) fn cut<L: Lane>(self, state: &mut BodyState<L>) {
        let LaneVec2 { x, y } = state.velocity;
        state.velocity = LaneVec2 { x: clamp(x, self.speed), y: clamp(y, self.speed) };
        state.angular_velocity = clamp(state.angular_velocity, self.spin);
    }

    /// An acceleration, m/s², that acts for `time`, s, at a time, cut to what takes a velocity from one limit to the other: a
    /// greater one would do no more.
    pub(crate) fn cut_acceleration(self, acceleration: Vec2, time: f32) -> Vec2 {
        let limit = 2.0 * self.speed / time;
        Vec2::new(clamp(acceleration.x, limit), clamp(acceleration.y, limit))
    }

    /// The same of an angular acceleration, rad/s².
    pub(crate) fn cut_angular_acceleration(self, acceleration: f32, time: f32) -> f32 {
        clamp(acceleration, 2.0 * self.spin / time)
    }
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

/// Moves all bodies on, without damping.
pub(crate) fn integrate(
    executor: Executor<'_>,
    states: &mut [BodyState],
    kicks: &mut Kicks,
    advance: Advance,
) {
    if advance.drift.is_none() && advance.kick.is_none() {
        return;
    }
    let states = &mut states[..kicks.columns.len() * COLUMN];
    let parts = (ByColumn(0..kicks.count), (ByColumn(states), &mut kicks.columns[..]));
    executor.run(parts, COST, |(rows, (states, columns))| Integrate {
        count: rows.0.len(),
        states: states.0,
        columns,
        advance,
    });
}

/// Moves some bodies on.
struct Integrate<'a> {
    count: usize,
    /// As many, and to whole columns those that are no body's.
    states: &'a mut [BodyState],
    columns: &'a mut [Kick<Column>],
    advance: Advance,
}

impl Job for Integrate<'_> {
    #[inline(always)]
    fn run<L: Lane>(self) {
        let Self { count, states, columns, advance: Advance { drift, kick, limits } } = self;
        for first in (0..count).step_by(L::WIDTH) {
            let (column, place) = (&mut columns[first / COLUMN], first % COLUMN);
            let mut state = L::load_rows(states, first);
            if let Some(h) = drift {
                limits.cut(&mut state);
                self::drift(&mut state, h);
            }
            if let Some(t) = kick {
                let mut kick = column.load::<L>(place);
                self::kick(&mut state, &mut kick, t, limits);
                column.compensation.store::<L>(place, kick.compensation);
            }
            if drift.is_some() {
                L::store_rows(states, first, &state);
            } else {
                L::store_velocities(states, first, &state);
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
    state.velocity = add_compensated(state.velocity, kick.acceleration * L::splat(t), &mut kick.compensation);
    state.angular_velocity = state.angular_velocity + kick.angular_acceleration * L::splat(t);
    limits.cut(state);
}

/// x += h·v, and the rotation turns by exactly h·w.
#[inline(always)]
pub(crate) fn drift<L: Lane>(state: &mut BodyState<L>, h: f32) {
    let h = L::splat(h);
    state.delta_position = state.delta_position + state.velocity * h;
    turn(state, state.angular_velocity * h);
}

/// Moves a body whose velocity has changed at `time`, s, into the substep by what its drift will miss: until then it
/// went on with the velocity `before`. Both are cut, as they are where a body drifts.
pub(crate) fn drift_until(time: f32, before: &BodyState, state: &mut BodyState, limits: SpeedLimits) {
    let mut before = *before;
    limits.cut(&mut before);
    limits.cut(state);
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
    fn rows_in_lanes_move_as_one_by_one_and_what_is_no_body_stays() {
        // Parts of lanes and whole ones, up to the last body's row and not so far.
        let parts = [2, 9, 16, 41, 50].into_iter();
        for (count, drift) in parts.flat_map(|count| [Some(0.01), None].map(|drift| (count, drift))) {
            let is_body = |row: usize| (1..count).contains(&row);
            let moved = [Lanes::One, Lanes::Four, Lanes::Eight, Lanes::Sixteen].map(|lanes| {
                let of_row = |row: usize| {
                    let velocity = Vec2::new(row as f32, -3.0).into();
                    let moving =
                        BodyState { velocity, angular_velocity: 0.1 * row as f32, ..BodyState::REST };
                    if is_body(row) { moving } else { BodyState::REST }
                };
                let mut states: Vec<_> = (0..64).map(of_row).collect();
                let (pool, mut kicks) = (ThreadPool::default(), Kicks::default());
                let acceleration = Vec2::new(0.0, -9.81).into();
                let falling = Kick { acceleration, ..Kick::default() };
                kicks.fill(&pool, count, |row| if is_body(row) { falling } else { Kick::default() });
                let limits = SpeedLimits { speed: 1e6, spin: 1e6 };
                let executor = Executor { pool: &pool, width: lanes.width() };
                integrate(executor, &mut states, &mut kicks, Advance { drift, kick: Some(0.005), limits });
                let stays = format!("{:?}", BodyState::REST);
                for row in (0..states.len()).filter(|&row| !is_body(row)) {
                    assert_eq!(format!("{:?}", states[row]), stays, "row {row} of {count}");
                }
                let BodyState { velocity, delta_rotation: LaneRot { s, .. }, .. } = states[count - 1];
                assert!(velocity.y < -3.0, "the last row has got its kick");
                assert_eq!(s > 0.0, drift.is_some(), "the last row has turned");
                let compensations: Vec<_> = (0..count).map(|row| kicks.compensation(row)).collect();
                format!("{states:?} {compensations:?}")
            });
            assert!(moved.iter().all(|other| *other == moved[0]), "{count} rows");
        }
    }

    /// Where great loads overflow, a velocity may be no number until it is cut.
    #[test]
    fn what_is_struck_at_no_number_stays_where_it_is_a_number() {
        let limits = SpeedLimits { speed: 1e6, spin: 1e6 };
        let at = |speed: f32| BodyState {
            velocity: Vec2::new(speed, -speed).into(),
            angular_velocity: speed,
            ..BodyState::REST
        };
        for wrong in [f32::NAN, f32::INFINITY] {
            for (before, after) in [(wrong, 1.0), (1.0, wrong), (wrong, wrong)] {
                let mut state = at(after);
                drift_until(0.5, &at(before), &mut state, limits);
                let BodyState { delta_position: place, delta_rotation: turn, .. } = state;
                assert!([place.x, place.y, turn.c, turn.s].into_iter().all(f32::is_finite), "{state:?}");
            }
        }
    }
}
