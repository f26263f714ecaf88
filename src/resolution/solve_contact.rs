//! The equations of one sweep over a contact: what its impulses are to become, and what that does to its bodies.

use crate::compute::{BodyState, Lane, LaneVec2};
use crate::resolution::axis::Axis;
use crate::resolution::block::{Row, solve_pair};
use crate::resolution::constraint::ContactConstraint;
use crate::resolution::softness::{bias, gap_bias, one_and_compliance};

/// No impulse along a normal is larger than what changes the speed of its point by this, m/s. A body that is wedged between
/// walls has no impulses that are enough: with friction, each sweep finds them larger by a factor than the last, and after
/// some hundred they overflow. A million bodies in a row that are stopped from the greatest speed, 10⁶ m/s, need as much, so
/// that less would let loads through. At 10⁵ times as much the heaviest bodies with the greatest friction overflow.
pub(crate) const LARGEST_SPEED_CHANGE: f32 = 1e12;

/// What a sweep does, beside stopping the approach.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Sweep {
    /// Pushes overlapping bodies apart and lets contacts yield: the sweep before the bodies move.
    pub(crate) biased: bool,
    /// Solves friction after the normals.
    pub(crate) friction: bool,
    /// Solves the two points of a contact together.
    pub(crate) block: bool,
}

impl Sweep {
    /// The sweep before the bodies move, by default.
    pub(crate) const PUSH: Self = Self { biased: true, friction: false, block: true };
    /// The sweep after it, by default.
    pub(crate) const RELAX: Self = Self { biased: false, friction: true, block: true };
    /// The same over contacts without friction.
    pub(crate) const SMOOTH_RELAX: Self = Self { friction: false, ..Self::RELAX };

    /// Whether it is one of the default.
    #[inline(always)]
    pub(crate) fn is_usual(self) -> bool {
        self.block && self.biased != self.friction
    }
}

impl<L: Lane> ContactConstraint<L> {
    /// Finds how far the points are apart where the bodies are now. It is so until they move again.
    #[inline(always)]
    pub(crate) fn find_separations<const POINTS: usize>(&mut self, [a, b]: &[BodyState<L>; 2]) {
        for index in 0..POINTS {
            self.points[index].separation_now = self.separation(&self.points[index], a, b);
        }
    }

    /// Solves the first `POINTS` points once: normals, then friction. The surfaces go past each other with `surface_speed`, m/s,
    /// beside how the bodies move.
    #[inline(always)]
    pub(crate) fn solve<const POINTS: usize, const STILL: bool>(
        &mut self,
        sweep: Sweep,
        substep_rate: f32,
        surface_speed: Option<L>,
        pair: &mut [BodyState<L>; 2],
    ) {
        let mut impulse = self.solve_normals::<POINTS, STILL>(sweep, substep_rate, pair);
        if sweep.friction {
            // The push along the normal, which is still to come, is across to the tangent.
            impulse = impulse + self.solve_frictions::<POINTS, STILL>(surface_speed, pair);
        }
        let [a, b] = pair;
        self.push(impulse, a, b);
    }

    /// Turns the bodies; returns the impulse that is still to push them, N s.
    #[inline(always)]
    fn solve_normals<const POINTS: usize, const STILL: bool>(
        &mut self,
        sweep: Sweep,
        substep_rate: f32,
        [a, b]: &mut [BodyState<L>; 2],
    ) -> LaneVec2<L> {
        let axis = Axis::<L, POINTS, STILL>::new(self, self.normal);
        let speeds = axis.speeds(a, b);
        let mut changes = [L::splat(0.0); POINTS];
        if sweep.block && POINTS == 2 {
            changes = self.solve_normals_together(speeds, sweep.biased, substep_rate);
        } else {
            for index in 0..POINTS {
                let vn = axis.speed_after(index, speeds, self, changes);
                changes[index] = self.solve_normal(index, vn, sweep.biased, substep_rate);
            }
        }
        axis.turn(self, changes, a, b);
        axis.sum(changes)
    }

    /// Turns the bodies; returns the impulse that is still to push them, N s.
    #[inline(always)]
    fn solve_frictions<const POINTS: usize, const STILL: bool>(
        &mut self,
        surface_speed: Option<L>,
        [a, b]: &mut [BodyState<L>; 2],
    ) -> LaneVec2<L> {
        let axis = Axis::<L, POINTS, STILL>::new(self, self.normal.perp());
        let speeds = axis.speeds(a, b);
        let mut changes = [L::splat(0.0); POINTS];
        for index in 0..POINTS {
            let slip = axis.speed_after(index, speeds, self, changes);
            let slip = surface_speed.map_or(slip, |speed| slip + speed);
            changes[index] = self.solve_friction(index, slip);
        }
        axis.turn(self, changes, a, b);
        axis.sum(changes)
    }

    /// What a point with the speed `vn`, m/s, asks of its impulse x and of that of the other point, x', so that it does not
    /// approach: the row and its q of
    ///
    /// ```text
    /// (1 + γ) k x + coupling x' + q ≥ 0,   q = vn + bias - γ k λ* - k λ - coupling λ'
    /// ```
    ///
    /// where the impulses so far, λ and λ', have brought about vn, and λ* is the part of λ that has lasted. γ is 0 in a sweep that is
    /// not `biased`.
    #[inline(always)]
    fn row(
        &self,
        index: usize,
        vn: L,
        [coupling, other_impulse]: [L; 2],
        biased: bool,
        substep_rate: f32,
    ) -> (Row<L>, L) {
        let (point, substep_rate) = (&self.points[index], L::splat(substep_rate));
        let (zero, one) = (L::splat(0.0), L::splat(1.0));
        let separation = point.separation_now;
        let load = point.normal_k * point.normal_impulse;
        let (row, bias) = if biased {
            let [soft, whole] = one_and_compliance(separation, load);
            let row = Row { own: point.normal_k * soft, other: coupling * whole, scale: whole };
            // No more than it bears now: what it has ceased to bear would push the bodies apart.
            let held = point.normal_k * self.lasting_impulses[index].min(point.normal_impulse);
            let mut spared = zero;
            // Few have any, and a division takes long.
            if L::bits(held.greater(zero)) != 0 {
                spared = (soft - whole) / whole * held;
            }
            (row, bias(separation, substep_rate) - spared)
        } else {
            (Row { own: point.normal_k, other: coupling, scale: one }, gap_bias(separation, substep_rate))
        };
        // What is small is added first: of that less is lost by rounding.
        let q = ((vn + bias) - (load + coupling * other_impulse)).max(L::splat(-LARGEST_SPEED_CHANGE));
        // A point that is not there, or pending, asks for nothing, with a harmless 1.
        let is_there = point.normal_k.greater(zero);
        (Row { own: L::select(is_there, row.own, one), ..row }, L::select(is_there, q, zero))
    }

    /// Two points together; returns by how much their impulses change, N s.
    #[inline(always)]
    fn solve_normals_together<const POINTS: usize>(
        &mut self,
        speeds: [L; POINTS],
        biased: bool,
        substep_rate: f32,
    ) -> [L; POINTS] {
        let before = [self.points[0].normal_impulse, self.points[1].normal_impulse];
        let coupling = self.coupling;
        let (first, q_1) = self.row(0, speeds[0], [coupling, before[1]], biased, substep_rate);
        let (second, q_2) = self.row(1, speeds[1], [coupling, before[0]], biased, substep_rate);
        let after = solve_pair([first, second], [q_1, q_2]);
        let mut changes = [L::splat(0.0); POINTS];
        for (index, change) in changes.iter_mut().enumerate() {
            self.points[index].normal_impulse = after[index];
            *change = after[index] - before[index];
        }
        changes
    }

    /// One point on its own. Returns by how much its impulse changes, N s.
    #[inline(always)]
    fn solve_normal(&mut self, index: usize, vn: L, biased: bool, substep_rate: f32) -> L {
        let zero = L::splat(0.0);
        let before = self.points[index].normal_impulse;
        let (row, q) = self.row(index, vn, [zero; 2], biased, substep_rate);
        // By the inverse, as two points together: a contact of one gets the same either way.
        let after = (-(row.scale * (L::splat(1.0) / row.own)) * q).max(zero);
        self.points[index].normal_impulse = after;
        after - before
    }

    /// Friction of one point: stops the slip, with at most µ times the normal impulse (Coulomb). Returns by how much the
    /// impulse changes, N s.
    #[inline(always)]
    fn solve_friction(&mut self, index: usize, slip: L) -> L {
        let limit = self.friction * self.points[index].normal_impulse;
        let friction = &mut self.frictions[index];
        let before = friction.impulse;
        friction.impulse = (before - friction.mass * slip).min(limit).max(-limit);
        friction.impulse - before
    }
}
