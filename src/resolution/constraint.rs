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
//! `L` holds `L::WIDTH` contacts that share no movable body.

use crate::body::Bodies;
use crate::collision::{Contact, Manifold};
use crate::compute::{BodyState, GROUND_ROW, Lane, LaneVec2};
use crate::math::Vec2;
use crate::resolution::softness::FULL_PUSH_DEPTH;
use crate::shape::Shape;

/// One of the (at most two) points of a contact.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct ConstraintPoint<L> {
    /// Contact point from the centre of a, m. It holds still during the step.
    pub(crate) anchor_a: LaneVec2<L>,
    /// Contact point from the centre of b, m.
    pub(crate) anchor_b: LaneVec2<L>,
    /// Separation at the start of the step, m.
    pub(crate) separation: L,
    /// Inverse effective mass k along the normal, 1/kg; 0 for a point that is not there.
    pub(crate) normal_k: L,
    /// Effective mass along the tangent, kg.
    pub(crate) tangent_mass: L,
    /// Impulse along the normal in this substep, N s, 0 or more.
    pub(crate) normal_impulse: L,
    /// Impulse along the tangent in this substep, N s.
    pub(crate) tangent_impulse: L,
    /// What the warm start of this substep applies twice, N s.
    pub(crate) normal_share: L,
    /// What the warm start of this substep applies twice, N s.
    pub(crate) tangent_share: L,
    /// Added to the separation, m: 0, or so much that the sweeps leave the point alone, because it
    /// approaches fast enough to bounce and its impact is not due in this substep.
    pub(crate) awaits_impact: L,
}

impl<L: Lane> ConstraintPoint<L> {
    /// Velocity of b against a at the point, m/s.
    #[inline(always)]
    pub(crate) fn relative_velocity(&self, a: &BodyState<L>, b: &BodyState<L>) -> LaneVec2<L> {
        let tip_a = a.velocity + self.anchor_a.perp() * a.angular_velocity;
        let tip_b = b.velocity + self.anchor_b.perp() * b.angular_velocity;
        tip_b - tip_a
    }
}

/// What the sweeps see as the separation of a point that awaits its impact, m.
pub(crate) const OUT_OF_REACH: f32 = 1e9;

/// `L::WIDTH` contacts.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct ContactConstraint<L: Lane> {
    pub(crate) row_a: L::Rows,
    pub(crate) row_b: L::Rows,
    pub(crate) inverse_mass_a: L,
    pub(crate) inverse_mass_b: L,
    pub(crate) inverse_inertia_a: L,
    pub(crate) inverse_inertia_b: L,
    /// 1 where the outline of a turns with it, 0 where it is a circle.
    pub(crate) turns_a: L,
    /// The same for b.
    pub(crate) turns_b: L,
    /// From a to b.
    pub(crate) normal: LaneVec2<L>,
    pub(crate) friction: L,
    /// Coupling of the two points along the normal, 1/kg: what a unit impulse at one does to the other's vn.
    pub(crate) coupling: L,
    pub(crate) points: [ConstraintPoint<L>; 2],
}

/// |k12| may be at most this share of √(k11 k22). Two points that all but coincide would otherwise ask for
/// huge impulses of opposite sign; this bounds the condition number at about 4000.
const LARGEST_COUPLING: f32 = 0.9995;

impl<L: Lane> ContactConstraint<L> {
    /// Puts `contact` at `place` of the lane, as the step begins. Its impulses are multiplied by `scale`, the
    /// length of a substep now over that of the substep they were found in.
    pub(crate) fn set(&mut self, place: usize, contact: &Contact, bodies: &Bodies, scale: f32) {
        let [a, b] = contact.slots.map(|slot| &bodies.motions[slot as usize]);
        let [turns_a, turns_b] = contact.slots.map(|slot| match bodies.shapes[slot as usize] {
            Shape::Circle(_) => 0.0,
            Shape::Aabb(_) | Shape::Obb(_) | Shape::Polygon(_) => 1.0,
        });
        L::set_row(&mut self.row_a, place, a.row);
        L::set_row(&mut self.row_b, place, b.row);
        self.inverse_mass_a.set(place, a.inverse_mass);
        self.inverse_mass_b.set(place, b.inverse_mass);
        self.inverse_inertia_a.set(place, a.inverse_inertia);
        self.inverse_inertia_b.set(place, b.inverse_inertia);
        self.turns_a.set(place, turns_a);
        self.turns_b.set(place, turns_b);
        self.friction.set(place, contact.friction);
        for (slot, point) in self.points.iter_mut().zip(contact.manifold.points()) {
            slot.normal_impulse.set(place, scale * point.normal_impulse);
            slot.tangent_impulse.set(place, scale * point.tangent_impulse);
        }
        self.set_geometry(place, &contact.manifold);
    }

    /// Takes normal and points over from a manifold of the bodies as they were when the step began.
    pub(crate) fn set_geometry(&mut self, place: usize, manifold: &Manifold) {
        let [m_a, m_b] = [self.inverse_mass_a.get(place), self.inverse_mass_b.get(place)];
        let [i_a, i_b] = [self.inverse_inertia_a.get(place), self.inverse_inertia_b.get(place)];
        let k = |first: [f32; 2], second: [f32; 2]| {
            m_a + m_b + i_a * (first[0] * second[0]) + i_b * (first[1] * second[1])
        };
        let normal = manifold.normal;
        let tangent = normal.perp();
        set_vector(&mut self.normal, place, normal);
        self.coupling.set(place, 0.0);
        let mut arms = [[0.0; 2]; 2];
        for (index, point) in manifold.points().iter().enumerate() {
            let slot = &mut self.points[index];
            let arm = [point.anchor_a.cross(normal), point.anchor_b.cross(normal)];
            let tangent_arm = [point.anchor_a.cross(tangent), point.anchor_b.cross(tangent)];
            arms[index] = arm;
            set_vector(&mut slot.anchor_a, place, point.anchor_a);
            set_vector(&mut slot.anchor_b, place, point.anchor_b);
            slot.separation.set(place, point.separation);
            slot.normal_k.set(place, k(arm, arm));
            slot.tangent_mass.set(place, 1.0 / k(tangent_arm, tangent_arm));
        }
        if manifold.points().len() == 2 {
            let limit = LARGEST_COUPLING * (k(arms[0], arms[0]) * k(arms[1], arms[1])).sqrt();
            self.coupling.set(place, k(arms[0], arms[1]).clamp(-limit, limit));
        }
    }

    /// Takes normal and points over from a manifold of the bodies in the states `a` and `b`, within the step. It
    /// must have as many points as before.
    pub(crate) fn set_geometry_in(
        &mut self,
        place: usize,
        manifold: &Manifold,
        a: &BodyState<L>,
        b: &BodyState<L>,
    ) {
        self.set_geometry(place, manifold);
        for (index, point) in manifold.points().iter().enumerate() {
            // Separations count from the start of the step.
            let moved = self.separation(&self.points[index], a, b).get(place) - point.separation;
            self.points[index].separation.set(place, point.separation - moved);
        }
    }

    /// Separation of a point now, m.
    #[inline(always)]
    pub(crate) fn separation(&self, point: &ConstraintPoint<L>, a: &BodyState<L>, b: &BodyState<L>) -> L {
        let tip_a = a.delta_position + a.delta_rotation.displacement(point.anchor_a) * self.turns_a;
        let tip_b = b.delta_position + b.delta_rotation.displacement(point.anchor_b) * self.turns_b;
        point.separation + self.normal.dot(tip_b - tip_a)
    }

    /// Applies `impulse`, N s, to b and its opposite to a, at a point.
    #[inline(always)]
    pub(crate) fn apply(
        &self,
        point: &ConstraintPoint<L>,
        impulse: LaneVec2<L>,
        a: &mut BodyState<L>,
        b: &mut BodyState<L>,
    ) {
        a.velocity = a.velocity - impulse * self.inverse_mass_a;
        a.angular_velocity = a.angular_velocity - self.inverse_inertia_a * point.anchor_a.cross(impulse);
        b.velocity = b.velocity + impulse * self.inverse_mass_b;
        b.angular_velocity = b.angular_velocity + self.inverse_inertia_b * point.anchor_b.cross(impulse);
    }

    /// Writes impulses and end-of-step separations back into the manifold; adds what is left wrong to
    /// `residual`.
    pub(crate) fn store(
        &self,
        place: usize,
        states: &[BodyState],
        contact: &mut Contact,
        residual: &mut StepResidual,
    ) {
        let (a, b) = (L::gather(states, self.row_a), L::gather(states, self.row_b));
        for (point, stored) in self.points.iter().zip(contact.manifold.points_mut()) {
            let separation = self.separation(point, &a, &b).get(place);
            let approach = -self.normal.dot(point.relative_velocity(&a, &b)).get(place);
            stored.separation = separation;
            stored.normal_impulse = point.normal_impulse.get(place);
            stored.tangent_impulse = point.tangent_impulse.get(place);
            residual.penetration = residual.penetration.max(-separation);
            if stored.normal_impulse > 0.0 && -separation < FULL_PUSH_DEPTH {
                residual.loaded_penetration = residual.loaded_penetration.max(-separation);
            }
            if separation <= 0.0 && point.awaits_impact.get(place) == 0.0 {
                residual.approach_speed = residual.approach_speed.max(approach);
            }
        }
    }
}

fn set_vector<L: Lane>(to: &mut LaneVec2<L>, place: usize, from: Vec2) {
    to.x.set(place, from.x);
    to.y.set(place, from.y);
}

impl ContactConstraint<f32> {
    /// Whether one of the two bodies is a circle.
    pub(crate) fn has_circle(&self) -> bool {
        self.turns_a == 0.0 || self.turns_b == 0.0
    }

    /// The rows of the two bodies, with the ground's in the place of a body that contacts do not move.
    pub(crate) fn moved_rows(&self) -> [u32; 2] {
        let row_if = |moves: bool, row: u32| if moves { row } else { GROUND_ROW };
        [row_if(self.inverse_mass_a > 0.0, self.row_a), row_if(self.inverse_mass_b > 0.0, self.row_b)]
    }
}

/// What the solver left wrong at the end of a step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct StepResidual {
    /// Deepest overlap, m.
    pub(crate) penetration: f32,
    /// Deepest overlap of a contact under load, m, not counting bodies that were put into each other.
    pub(crate) loaded_penetration: f32,
    /// Largest speed with which two touching points still approach each other, m/s.
    pub(crate) approach_speed: f32,
}
