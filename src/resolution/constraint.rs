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

use crate::body::Bodies;
use crate::collision::{Contact, Manifold};
use crate::compute::{BodyState, Lane, LaneVec2};
use crate::resolution::softness::FULL_PUSH_DEPTH;
use crate::shape::Shape;

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
    /// Inverse effective mass k along the normal, 1/kg; 0 for a point that is not there.
    pub(crate) normal_k: C,
    /// Effective mass along the tangent, kg.
    pub(crate) tangent_mass: C,
    /// Impulse along the normal in this substep, N s, 0 or more.
    pub(crate) normal_impulse: C,
    /// Impulse along the tangent in this substep, N s.
    pub(crate) tangent_impulse: C,
    /// What the warm start of this substep applies twice along the normal, N s.
    pub(crate) normal_share: C,
    /// Added to the separation, m: 0, or so much that the sweeps leave the point alone, because it
    /// approaches fast enough to bounce and its impact is not due in this substep.
    pub(crate) awaits_impact: C,
}

/// What the sweeps see as the separation of a point that awaits its impact, m.
pub(crate) const OUT_OF_REACH: f32 = 1e9;

/// A contact, or as many as a lane holds.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct ContactConstraint<C> {
    pub(crate) inverse_mass_a: C,
    pub(crate) inverse_mass_b: C,
    pub(crate) inverse_inertia_a: C,
    pub(crate) inverse_inertia_b: C,
    /// 1 where the outline of a turns with it, 0 where it is a circle.
    pub(crate) turns_a: C,
    /// The same for b.
    pub(crate) turns_b: C,
    /// From a to b.
    pub(crate) normal: LaneVec2<C>,
    pub(crate) friction: C,
    /// Coupling of the two points along the normal, 1/kg: what a unit impulse at one does to the other's vn.
    pub(crate) coupling: C,
    pub(crate) points: [ConstraintPoint<C>; 2],
}

/// |k12| may be at most this share of √(k11 k22). Two points that all but coincide would otherwise ask for
/// huge impulses of opposite sign; this bounds the condition number at about 4000.
const LARGEST_COUPLING: f32 = 0.9995;

impl<L: Lane> ConstraintPoint<L> {
    /// Velocity of b against a at the point, m/s.
    #[inline(always)]
    pub(crate) fn relative_velocity(&self, a: &BodyState<L>, b: &BodyState<L>) -> LaneVec2<L> {
        let tip_a = a.velocity + self.anchor_a.perp() * a.angular_velocity;
        let tip_b = b.velocity + self.anchor_b.perp() * b.angular_velocity;
        tip_b - tip_a
    }
}

impl<L: Lane> ContactConstraint<L> {
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
}

impl ContactConstraint<f32> {
    /// A contact as the step begins, between bodies in rows of their own. Its impulses are multiplied by `scale`,
    /// the length of a substep now over that of the substep they were found in.
    pub(crate) fn new(contact: &Contact, bodies: &Bodies, scale: f32) -> Self {
        let [a, b] = contact.slots.map(|slot| &bodies.motions[slot as usize]);
        let [turns_a, turns_b] = contact.slots.map(|slot| match bodies.shapes[slot as usize] {
            Shape::Circle(_) => 0.0,
            Shape::Aabb(_) | Shape::Obb(_) | Shape::Polygon(_) => 1.0,
        });
        let mut constraint = Self {
            inverse_mass_a: a.inverse_mass,
            inverse_mass_b: b.inverse_mass,
            inverse_inertia_a: a.inverse_inertia,
            inverse_inertia_b: b.inverse_inertia,
            turns_a,
            turns_b,
            friction: contact.friction,
            ..Self::default()
        };
        for (to, point) in constraint.points.iter_mut().zip(contact.manifold.points()) {
            to.normal_impulse = scale * point.normal_impulse;
            to.tangent_impulse = scale * point.tangent_impulse;
        }
        constraint.set_geometry(&contact.manifold);
        constraint
    }

    /// Takes normal and points over from a manifold of the bodies as they were when the step began.
    pub(crate) fn set_geometry(&mut self, manifold: &Manifold) {
        let [m_a, m_b] = [self.inverse_mass_a, self.inverse_mass_b];
        let [i_a, i_b] = [self.inverse_inertia_a, self.inverse_inertia_b];
        let k = |first: [f32; 2], second: [f32; 2]| {
            m_a + m_b + i_a * (first[0] * second[0]) + i_b * (first[1] * second[1])
        };
        let normal = manifold.normal;
        let tangent = normal.perp();
        self.normal = normal.into();
        self.coupling = 0.0;
        let mut arms = [[0.0; 2]; 2];
        for (index, point) in manifold.points().iter().enumerate() {
            let to = &mut self.points[index];
            let arm = [point.anchor_a.cross(normal), point.anchor_b.cross(normal)];
            let tangent_arm = [point.anchor_a.cross(tangent), point.anchor_b.cross(tangent)];
            arms[index] = arm;
            to.anchor_a = point.anchor_a.into();
            to.anchor_b = point.anchor_b.into();
            to.separation = point.separation;
            to.normal_k = k(arm, arm);
            to.tangent_mass = 1.0 / k(tangent_arm, tangent_arm);
        }
        if manifold.points().len() == 2 {
            let limit = LARGEST_COUPLING * (k(arms[0], arms[0]) * k(arms[1], arms[1])).sqrt();
            self.coupling = k(arms[0], arms[1]).clamp(-limit, limit);
        }
    }

    /// Takes normal and points over from a manifold of the bodies in the states `a` and `b`, within the step. It
    /// must have as many points as before.
    pub(crate) fn set_geometry_in(&mut self, manifold: &Manifold, a: &BodyState, b: &BodyState) {
        self.set_geometry(manifold);
        for (index, point) in manifold.points().iter().enumerate() {
            // Separations count from the start of the step.
            let moved = self.separation(&self.points[index], a, b) - point.separation;
            self.points[index].separation = point.separation - moved;
        }
    }

    /// Writes impulses and end-of-step separations back into the manifold, given the bodies' states; adds what is
    /// left wrong to `residual`.
    pub(crate) fn finish(&self, [a, b]: [&BodyState; 2], contact: &mut Contact, residual: &mut StepResidual) {
        for (point, stored) in self.points.iter().zip(contact.manifold.points_mut()) {
            let separation = self.separation(point, a, b);
            let approach = -self.normal.dot(point.relative_velocity(a, b));
            stored.separation = separation;
            stored.normal_impulse = point.normal_impulse;
            stored.tangent_impulse = point.tangent_impulse;
            residual.penetration = residual.penetration.max(-separation);
            if stored.normal_impulse > 0.0 && -separation < FULL_PUSH_DEPTH {
                residual.loaded_penetration = residual.loaded_penetration.max(-separation);
            }
            if separation <= 0.0 && point.awaits_impact == 0.0 {
                residual.approach_speed = residual.approach_speed.max(approach);
            }
        }
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
