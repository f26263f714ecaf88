//! A contact as the solver sees it: made from the manifold at the start of a step, asked for its impulses at
//! the end.
//!
//! For each point with anchors r_a, r_b and the normal n (from a to b):
//!
//! ```text
//! separation      s  = s₀ + n·(Δx_b + t_b (ΔR_b - 1) r_b - Δx_a - t_a (ΔR_a - 1) r_a)
//! velocity        vn = n·(v_b + w_b × r_b - v_a - w_a × r_a)
//! 1/(eff. mass)   k  = 1/m_a + 1/m_b + (r_a × n)²/I_a + (r_b × n)²/I_b
//! impulse λ       v_a -= λ n/m_a,  w_a -= λ (r_a × n)/I_a,  v_b += λ n/m_b,  w_b += λ (r_b × n)/I_b
//! ```
//!
//! and the same with the tangent for friction. t is 1 for an outline that turns with its body and 0 for a
//! circle, which rolls: its contact point is always the one nearest to the other body, and a point that went
//! round with it would seem to lift off.
//!
//! The equations are written for any [`Lane`]: a [`ContactConstraint`] of lanes is as many contacts that share no
//! movable body, one of `f32` is a single contact. In between they are stored in a [`ContactBlock`](crate::resolution::contact_block::ContactBlock).

use crate::collision::Manifold;
use crate::compute::{BodyState, Lane, LaneVec2, columns};

/// One of the (at most two) points of a contact.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct ConstraintPoint<C> {
    /// Contact point from the centre of a, m. It holds still during the step.
    pub(crate) anchor_a: LaneVec2<C>,
    /// Contact point from the centre of b, m.
    pub(crate) anchor_b: LaneVec2<C>,
    /// Separation at the start of the step, m.
    pub(crate) separation: C,
    /// Separation where the bodies are now, m, as the first sweep after they moved has found it.
    pub(crate) separation_now: C,
    /// Inverse effective mass k along the normal, 1/kg; 0 for a point that is not there.
    pub(crate) normal_k: C,
    /// Impulse along the normal in this substep, N s, 0 or more.
    pub(crate) normal_impulse: C,
}

columns!(ConstraintPoint { anchor_a, anchor_b, separation, separation_now, normal_k, normal_impulse });

/// What the sweep before the bodies move does not look at of a point, kept apart from what it does.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct PointFriction<C> {
    /// Effective mass along the tangent, kg.
    pub(crate) mass: C,
    /// Impulse along the tangent in this substep, N s.
    pub(crate) impulse: C,
    /// What each of the two warm starts of this substep applies along the normal, N s; until it begins, of the last. Contacts that are solved directly
    /// have none.
    pub(crate) warm_start: C,
}

columns!(PointFriction { mass, impulse, warm_start });

/// Normal and points of a contact, with its bodies where they are now.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Geometry<L> {
    pub(crate) normal: LaneVec2<L>,
    pub(crate) points: [GeometryPoint<L>; 2],
}

/// Where one of the points is.
#[derive(Clone, Copy, Debug)]
pub(crate) struct GeometryPoint<L> {
    pub(crate) anchor_a: LaneVec2<L>,
    pub(crate) anchor_b: LaneVec2<L>,
    pub(crate) separation: L,
}

impl<L: Lane> Geometry<L> {
    /// Points at the centres of the bodies, still to be moved to where they are.
    #[inline(always)]
    pub(crate) fn of_normal(normal: LaneVec2<L>) -> Self {
        let zero = L::splat(0.0);
        let center = LaneVec2 { x: zero, y: zero };
        let point = GeometryPoint { anchor_a: center, anchor_b: center, separation: zero };
        Self { normal, points: [point; 2] }
    }
}

/// The k of a point that is there, until [`ContactConstraint::find_masses`] has found it, 1/kg.
pub(crate) const THERE: f32 = 1.0;

/// A contact, or as many as a lane holds.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct ContactConstraint<C> {
    pub(crate) inverse_mass_a: C,
    pub(crate) inverse_mass_b: C,
    pub(crate) inverse_inertia_a: C,
    pub(crate) inverse_inertia_b: C,
    /// From a to b.
    pub(crate) normal: LaneVec2<C>,
    /// Coupling of the two points along the normal, 1/kg: what a unit impulse at one does to the other's vn.
    pub(crate) coupling: C,
    pub(crate) points: [ConstraintPoint<C>; 2],
    /// By point, what it bears along the normal without yielding, N s in half a substep: the part of its load that has lasted.
    pub(crate) lasting_impulses: [C; 2],
    /// Coefficient of friction.
    pub(crate) friction: C,
    /// By point.
    pub(crate) frictions: [PointFriction<C>; 2],
    pub(crate) turns: Turns<C>,
}

columns!(ContactConstraint {
    inverse_mass_a,
    inverse_mass_b,
    inverse_inertia_a,
    inverse_inertia_b,
    normal,
    coupling,
    points,
    lasting_impulses,
    friction,
    frictions,
    turns,
});

/// By body: 1 where its outline turns with it, 0 where it is a circle.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Turns<C> {
    pub(crate) a: C,
    pub(crate) b: C,
}

columns!(Turns { a, b });

/// |k12| may be at most this share of √(k11 k22). The points of bodies that do not turn respond as one, and those that all
/// but coincide nearly so: the problem of two would have no solution, or huge impulses of opposite sign. This bounds the
/// condition number at about 4000; more, and the sum of the impulses has too few digits; less, and what stands on a narrow
/// foot tips more slowly than it should.
const LARGEST_COUPLING: f32 = 0.9995;

impl<L: Lane> ConstraintPoint<L> {
    /// Moments r × d about the centres of the two bodies: of a direction its lever arms, m.
    #[inline(always)]
    pub(crate) fn moments(&self, direction: LaneVec2<L>) -> [L; 2] {
        [self.anchor_a.cross(direction), self.anchor_b.cross(direction)]
    }

    /// Velocity of b against a at the point, m/s.
    #[inline(always)]
    pub(crate) fn relative_velocity(&self, a: &BodyState<L>, b: &BodyState<L>) -> LaneVec2<L> {
        b.velocity_at(self.anchor_b) - a.velocity_at(self.anchor_a)
    }
}

/// What acts on b, and its opposite on a.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Action<L> {
    /// N s.
    pub(crate) impulse: LaneVec2<L>,
    /// Its moments about the centres of a and b, N m s.
    pub(crate) moments: [L; 2],
}

impl<L: Lane> Action<L> {
    /// An impulse, N s, at a point.
    #[inline(always)]
    pub(crate) fn at(point: &ConstraintPoint<L>, impulse: LaneVec2<L>) -> Self {
        Self { impulse, moments: point.moments(impulse) }
    }

    /// Both together.
    #[inline(always)]
    pub(crate) fn and(self, other: Self) -> Self {
        let ([a, b], [other_a, other_b]) = (self.moments, other.moments);
        Self { impulse: self.impulse + other.impulse, moments: [a + other_a, b + other_b] }
    }
}

impl<L: Lane> ContactConstraint<L> {
    /// What a unit impulse at a point with the `first` arms does to the speed at one with the `second`, along the same
    /// direction, 1/kg.
    #[inline(always)]
    pub(crate) fn response(&self, first: [L; 2], second: [L; 2]) -> L {
        let mass = self.inverse_mass_a + self.inverse_mass_b;
        mass + self.inverse_inertia_a * (first[0] * second[0])
            + self.inverse_inertia_b * (first[1] * second[1])
    }

    /// Acceleration of b against a along the normal at a point, m/s²: of their centres, and by how a and b turn, rad/s².
    #[inline(always)]
    pub(crate) fn acceleration_along_normal(
        &self,
        index: usize,
        of_centers: LaneVec2<L>,
        turns: [L; 2],
    ) -> L {
        let point = &self.points[index];
        let [by_a, by_b] = [(point.anchor_a, turns[0]), (point.anchor_b, turns[1])]
            .map(|(anchor, turn)| anchor.cross(self.normal) * turn);
        self.normal.dot(of_centers) + (by_b - by_a)
    }

    /// Separation of a point now, m.
    #[inline(always)]
    pub(crate) fn separation(&self, point: &ConstraintPoint<L>, a: &BodyState<L>, b: &BodyState<L>) -> L {
        let moved = self.normal.dot(b.delta_position - a.delta_position);
        let carried_a = a.delta_rotation.displacement_along(point.anchor_a, self.normal);
        let carried_b = b.delta_rotation.displacement_along(point.anchor_b, self.normal);
        point.separation + (moved + (carried_b * self.turns.b - carried_a * self.turns.a))
    }

    /// The anchors of a point where they have been carried to: with the outlines that turn, and with a circle that touches
    /// something else, on which the point stays.
    #[inline(always)]
    pub(crate) fn carried(
        &self,
        point: &ConstraintPoint<L>,
        a: &BodyState<L>,
        b: &BodyState<L>,
    ) -> [LaneVec2<L>; 2] {
        let Turns { a: turns_a, b: turns_b } = self.turns;
        let (moved, turn) = (b.delta_position - a.delta_position, turns_a * turns_b);
        let [stays_on_a, stays_on_b] = [turns_b - turn, turns_a - turn];
        let carried_a = a.delta_rotation.displacement(point.anchor_a) * turn + moved * stays_on_b;
        let carried_b = b.delta_rotation.displacement(point.anchor_b) * turn - moved * stays_on_a;
        [point.anchor_a + carried_a, point.anchor_b + carried_b]
    }

    /// Gives b what acts on it, and a the opposite.
    #[inline(always)]
    pub(crate) fn apply(
        &self,
        Action { impulse, moments: [moment_a, moment_b] }: Action<L>,
        a: &mut BodyState<L>,
        b: &mut BodyState<L>,
    ) {
        self.push(impulse, a, b);
        self.turn([moment_a, moment_b], a, b);
    }

    /// Gives b an impulse, N s, and a the opposite; none of them turns.
    #[inline(always)]
    pub(crate) fn push(&self, impulse: LaneVec2<L>, a: &mut BodyState<L>, b: &mut BodyState<L>) {
        a.velocity = a.velocity - impulse * self.inverse_mass_a;
        b.velocity = b.velocity + impulse * self.inverse_mass_b;
    }

    /// Turns the bodies as moments about the centres of a and b do, N m s, that on a being the opposite.
    #[inline(always)]
    pub(crate) fn turn(&self, [moment_a, moment_b]: [L; 2], a: &mut BodyState<L>, b: &mut BodyState<L>) {
        a.angular_velocity = a.angular_velocity - self.inverse_inertia_a * moment_a;
        b.angular_velocity = b.angular_velocity + self.inverse_inertia_b * moment_b;
    }
}

impl<L: Lane> ContactConstraint<L> {
    /// Finds the effective masses and the coupling of the points that are there, as their k above 0 says: none beyond
    /// the first `POINTS`.
    #[inline(always)]
    pub(crate) fn find_masses<const POINTS: usize>(&mut self) {
        let zero = L::splat(0.0);
        let tangent = self.normal.perp();
        let [first, second] = &self.points;
        let is_there = [first.normal_k.greater(zero), second.normal_k.greater(zero)];
        let mut arms = [[zero; 2]; 2];
        for index in 0..POINTS {
            let point = &self.points[index];
            let (arm, tangent_arm) = (point.moments(self.normal), point.moments(tangent));
            arms[index] = arm;
            self.points[index].normal_k = L::select(is_there[index], self.response(arm, arm), zero);
            let tangent_k = self.response(tangent_arm, tangent_arm);
            self.frictions[index].mass = L::select(is_there[index], L::splat(1.0) / tangent_k, zero);
        }
        if POINTS < 2 {
            return;
        }
        let [k_11, k_22] = arms.map(|arm| self.response(arm, arm));
        let k_12 = self.response(arms[0], arms[1]);
        let excess = (k_12.abs() - L::splat(LARGEST_COUPLING) * (k_11 * k_22).sqrt()).max(zero);
        // Half of it goes over to k11 and k22: equal impulses are answered as they are, and what they differ by more stiffly.
        let half = L::select(L::both(is_there[0], is_there[1]), L::splat(0.5) * excess, zero);
        let sign = L::select(k_12.greater(zero), L::splat(1.0), L::splat(-1.0));
        self.coupling = L::select(L::both(is_there[0], is_there[1]), k_12 - sign * half, zero);
        for point in &mut self.points {
            point.normal_k = point.normal_k + half;
        }
    }
}

impl<L: Lane> ContactConstraint<L> {
    /// Takes normal and the first `POINTS` points over, with the bodies in the states `a` and `b` within the step.
    /// Separations count from the start of the step.
    #[inline(always)]
    pub(crate) fn set_geometry_in<const POINTS: usize>(
        &mut self,
        geometry: &Geometry<L>,
        a: &BodyState<L>,
        b: &BodyState<L>,
    ) {
        self.normal = geometry.normal;
        for index in 0..POINTS {
            let GeometryPoint { anchor_a, anchor_b, separation } = geometry.points[index];
            let to = &mut self.points[index];
            (to.anchor_a, to.anchor_b, to.separation) = (anchor_a, anchor_b, separation);
            let moved = self.separation(&self.points[index], a, b) - separation;
            self.points[index].separation = separation - moved;
        }
        self.find_masses::<POINTS>();
    }

    /// The same constraint, with normal and points of `other` where the mask holds.
    #[inline(always)]
    pub(crate) fn with_geometry_where(&self, mask: L::Mask, other: &Self) -> Self {
        let mut chosen = *self;
        chosen.normal = LaneVec2::select(mask, other.normal, self.normal);
        chosen.coupling = L::select(mask, other.coupling, self.coupling);
        for (index, to) in chosen.points.iter_mut().enumerate() {
            let (yes, no) = (&other.points[index], &self.points[index]);
            to.anchor_a = LaneVec2::select(mask, yes.anchor_a, no.anchor_a);
            to.anchor_b = LaneVec2::select(mask, yes.anchor_b, no.anchor_b);
            to.separation = L::select(mask, yes.separation, no.separation);
            to.normal_k = L::select(mask, yes.normal_k, no.normal_k);
            let (yes, no) = (&other.frictions[index], &self.frictions[index]);
            chosen.frictions[index].mass = L::select(mask, yes.mass, no.mass);
        }
        chosen
    }

    /// How fast the outlines of the two bodies turn against each other, rad/s.
    #[inline(always)]
    pub(crate) fn outlines_turn_at(&self, a: &BodyState<L>, b: &BodyState<L>) -> L {
        (b.angular_velocity * self.turns.b - a.angular_velocity * self.turns.a).abs()
    }

    /// Lets what overlaps seem to touch where the mask holds.
    #[inline(always)]
    pub(crate) fn see_as_touching_where(&mut self, mask: L::Mask) {
        for point in &mut self.points {
            let separation = point.separation_now;
            point.separation_now = L::select(mask, separation.max(L::splat(0.0)), separation);
        }
    }
}

impl ContactConstraint<f32> {
    /// Takes normal and points over from a manifold of the bodies in the states `a` and `b` within the step.
    pub(crate) fn set_manifold_in(&mut self, manifold: &Manifold, a: &BodyState, b: &BodyState) {
        let mut geometry = Geometry::of_normal(manifold.normal.into());
        self.coupling = 0.0;
        for point in &mut self.points {
            point.normal_k = 0.0;
        }
        for (index, point) in manifold.points().iter().enumerate() {
            geometry.points[index] = GeometryPoint {
                anchor_a: point.anchor_a.into(),
                anchor_b: point.anchor_b.into(),
                separation: point.separation,
            };
            self.points[index].normal_k = THERE;
        }
        match manifold.points() {
            [_] => self.set_geometry_in::<1>(&geometry, a, b),
            _ => self.set_geometry_in::<2>(&geometry, a, b),
        }
    }

    /// Velocity of b against a along the normal at each of the points, m/s.
    pub(crate) fn normal_speeds(&self, [a, b]: &[BodyState; 2]) -> [f32; 2] {
        self.points.map(|point| self.normal.dot(point.relative_velocity(a, b)))
    }

    /// Applies impulses along the normal, N s per point.
    pub(crate) fn apply_normal_impulses(&self, impulses: [f32; 2], [a, b]: &mut [BodyState; 2]) {
        for (point, impulse) in self.points.iter().zip(impulses) {
            self.apply(Action::at(point, self.normal * impulse), a, b);
        }
    }

    /// Applies the impulses of a collision along the normal, N s per point, and then the friction of each, at most µ times
    /// as strong. Beside how the bodies move, their surfaces go past each other with `surface_speed`, m/s. Returns the sum
    /// that acts on b, N s.
    pub(crate) fn apply_collision_impulses(
        &self,
        impulses: [f32; 2],
        surface_speed: Option<f32>,
        pair: &mut [BodyState; 2],
    ) -> LaneVec2<f32> {
        self.apply_normal_impulses(impulses, pair);
        let mut sum = self.normal * (impulses[0] + impulses[1]);
        let [a, b] = pair;
        let tangent = self.normal.perp();
        for ((point, normal_impulse), friction) in self.points.iter().zip(impulses).zip(&self.frictions) {
            let slip = tangent.dot(point.relative_velocity(a, b));
            let slip = surface_speed.map_or(slip, |speed| slip + speed);
            let limit = self.friction * normal_impulse;
            let impulse = (-friction.mass * slip).clamp(-limit, limit);
            self.apply(Action::at(point, tangent * impulse), a, b);
            sum = sum + tangent * impulse;
        }
        sum
    }
}

/// What the solver left wrong at the end of a step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct StepResidual {
    /// Deepest overlap, m.
    pub(crate) penetration: f32,
    /// Largest speed with which two touching points still approach each other, m/s.
    pub(crate) approach_speed: f32,
}

impl StepResidual {
    /// The larger of both, number by number.
    pub(crate) fn max(self, other: Self) -> Self {
        Self {
            penetration: self.penetration.max(other.penetration),
            approach_speed: self.approach_speed.max(other.approach_speed),
        }
    }
}

pub(crate) mod warm_start;

#[cfg(test)]
mod tests;
