//! Damping: the part of its velocity that a body loses with each kick.

use crate::body::Forcing;
use crate::compute::BodyState;

/// Damping of the body of a row, for one kick.
#[derive(Clone, Copy, Debug)]
struct Damping {
    row: u32,
    /// Share of the velocity that is lost, no unit.
    linear: f32,
    /// Share of the angular velocity that is lost, no unit.
    angular: f32,
}

/// The bodies with damping.
#[derive(Clone, Debug, Default)]
pub(crate) struct Damped {
    rows: Vec<Damping>,
}

/// Whether a body has damping.
#[inline(always)]
pub(crate) fn is_damped(forcing: &Forcing) -> bool {
    forcing.linear_damping > 0.0 || forcing.angular_damping > 0.0
}

/// Share of a velocity that damping `c` (1/s) takes in the time `t` (s): 1 - e^(-ct) to second order, and
/// between 0 and 1 for every c ≥ 0. The share and not what is left, which so near to 1 has lost its digits.
fn damping_loss(c: f32, t: f32) -> f32 {
    let x = c * t;
    let gain = x + 0.5 * x * x;
    gain / (1.0 + gain)
}

impl Damped {
    pub(crate) fn clear(&mut self) {
        self.rows.clear();
    }

    /// Takes up some bodies with damping, by ascending row, for kicks of so many seconds.
    pub(crate) fn add<'a>(&mut self, bodies: impl Iterator<Item = (usize, &'a Forcing)>, kick_time: f32) {
        self.rows.extend(bodies.map(|(row, forcing)| Damping {
            row: row as u32,
            linear: damping_loss(forcing.linear_damping, kick_time),
            angular: damping_loss(forcing.angular_damping, kick_time),
        }));
    }

    /// Takes from the bodies with damping what they lose with each kick.
    pub(crate) fn slow_down(&self, states: &mut [BodyState]) {
        for &Damping { row, linear, angular } in &self.rows {
            let state = &mut states[row as usize];
            state.velocity = state.velocity - state.velocity * linear;
            state.angular_velocity -= state.angular_velocity * angular;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::damping_loss;

    /// 1 - e^(-ct), whose next term is (ct)³/6; and never more than all of a velocity.
    #[test]
    fn a_share_of_the_velocity_is_lost_as_the_exponential_says() {
        for c in [1e-4_f32, 0.1, 1.0, 10.0, 60.0] {
            let x = c / 480.0;
            let exact = -f64::from(-x).exp_m1();
            let error = (f64::from(damping_loss(c, 1.0 / 480.0)) - exact).abs();
            assert!(error <= f64::from(x).powi(3) / 6.0 + 2e-7 * exact, "damping {c} /s: {error}");
        }
        assert_eq!(damping_loss(0.0, 1.0), 0.0);
        assert!((0.999..=1.0).contains(&damping_loss(1e4, 1.0)));
    }
}
