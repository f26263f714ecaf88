//! Whether a description makes sense.

use crate::joint::description::{Anchors, ForeignOption, Motor, Spring};
use crate::joint::{Joint, JointError, JointKind};
use crate::math::Point;

/// Lengths and places, m; as far as bodies may be.
const FARTHEST: f64 = 1e12;
/// Shortest rod, m: below, its direction is lost in rounding.
pub(crate) const SHORTEST: f64 = 1e-6;
/// Frequencies of springs, Hz: what is stiffer is rigid in every substep that a game can take.
const HERTZ: [f64; 2] = [1e-6, 1e6];
/// Beyond this damping ratio a spring is a brake.
const LARGEST_DAMPING: f64 = 1e6;
/// Speeds of motors, m/s or rad/s.
const FASTEST: f64 = 1e9;
/// Angles, rad: 10^8 turns, of which an `f64` still tells 10^-7 rad.
const LARGEST_ANGLE: f64 = 1e9;
/// Ratios of gears and pulleys.
const RATIOS: [f64; 2] = [1e-6, 1e6];

fn check(
    quantity: &'static str,
    value: f64,
    [min, max]: [f64; 2],
    unit: &'static str,
) -> Result<(), JointError> {
    // What is told in `f32` may be a bound, rounded to that. NaN fails the comparison.
    let [least, most] = [min.min(f64::from(min as f32)), max.max(f64::from(max as f32))];
    if value >= least && value <= most {
        Ok(())
    } else {
        Err(JointError::OutOfRange { quantity, value, min, max, unit })
    }
}

fn check_point(quantity: &'static str, point: Point) -> Result<(), JointError> {
    check(quantity, point.x, [-FARTHEST, FARTHEST], "m")?;
    check(quantity, point.y, [-FARTHEST, FARTHEST], "m")
}

impl Joint {
    /// Checks every number, and that the kind has every option that was given.
    pub(crate) fn validate(&self) -> Result<(), JointError> {
        self.validate_options()?;
        match self.anchors {
            Anchors::Centers => {}
            Anchors::At(point) => check_point("the anchor", point)?,
            Anchors::Local(a, b) => {
                check_point("the anchor on the first body", a.into())?;
                check_point("the anchor on the second body", b)?;
            }
            Anchors::Between(a, b) => {
                check_point("the first anchor", a)?;
                check_point("the second anchor", b)?;
            }
        }
        if let Some(axis) = self.axis
            && axis.direction().is_none()
        {
            return Err(JointError::NoAxis);
        }
        if let Some(target) = self.target {
            check_point("the target", target)?;
        }
        if let Some([wheel_a, wheel_b]) = self.wheels {
            check_point("the first wheel", wheel_a)?;
            check_point("the second wheel", wheel_b)?;
        }
        if let Some(length) = self.length {
            check("the length", f64::from(length), [SHORTEST, FARTHEST], "m")?;
        }
        check("the rest of the spring", self.rest, [-LARGEST_ANGLE, LARGEST_ANGLE], "m or rad")?;
        self.validate_limits()?;
        self.validate_strengths()
    }

    /// Checks where it may go.
    fn validate_limits(&self) -> Result<(), JointError> {
        let Some([lower, upper]) = self.limits else { return Ok(()) };
        // Infinite is no limit, but not to be met: a lower one of infinity would leave no place.
        let any = |farthest: f64| [f64::NEG_INFINITY, -farthest];
        let limits = ["the lower limit", "the upper limit"];
        let (names, least, greatest, unit) = match self.kind {
            JointKind::Distance => {
                (["the least length", "the greatest length"], [0.0, SHORTEST], FARTHEST, "m")
            }
            JointKind::Revolute => (limits, any(LARGEST_ANGLE), LARGEST_ANGLE, "rad"),
            _ => (limits, any(FARTHEST), FARTHEST, "m"),
        };
        check(names[0], lower, [least[0], greatest], unit)?;
        check(names[1], upper, [least[1], f64::INFINITY], unit)?;
        // One that is finite is within what an angle or a place can be.
        for ((limit, name), least) in [lower, upper].into_iter().zip(names).zip(least) {
            if limit.is_finite() {
                check(name, limit, [least.max(-greatest), greatest], unit)?;
            }
        }
        if lower > upper {
            return Err(JointError::LimitsCrossed { lower, upper });
        }
        Ok(())
    }

    /// Checks motor, spring, and the greatest forces.
    fn validate_strengths(&self) -> Result<(), JointError> {
        let any_strength = [0.0, f64::INFINITY];
        if let Some(Motor { speed, max }) = self.motor {
            check("the speed of the motor", f64::from(speed), [-FASTEST, FASTEST], "m/s or rad/s")?;
            check("the greatest force or torque of the motor", f64::from(max), any_strength, "N or N m")?;
        }
        if let Some(Spring { hertz, damping_ratio }) = self.spring {
            check("the frequency of the spring", f64::from(hertz), HERTZ, "Hz")?;
            check("the damping ratio", f64::from(damping_ratio), [0.0, LARGEST_DAMPING], "")?;
        }
        if let Some(force) = self.max_force {
            check("the greatest force", f64::from(force), any_strength, "N")?;
        }
        if let Some(torque) = self.max_torque {
            check("the greatest torque", f64::from(torque), any_strength, "N m")?;
        }
        if let Some([force, torque]) = self.breaks_at {
            check("the force at which it breaks", f64::from(force), any_strength, "N")?;
            check("the torque at which it breaks", f64::from(torque), any_strength, "N m")?;
        }
        match self.kind {
            JointKind::Friction if self.max_force.is_none() && self.max_torque.is_none() => {
                Err(JointError::NoStrength)
            }
            JointKind::Gear => check("the size of the ratio", self.ratio.abs(), RATIOS, ""),
            JointKind::Pulley => check("the ratio", self.ratio, RATIOS, ""),
            JointKind::Ratchet => check("the angle of a tooth", self.ratio, RATIOS, "rad"),
            _ => Ok(()),
        }
    }

    /// Checks that the kind has every option that was given.
    fn validate_options(&self) -> Result<(), JointError> {
        use JointKind::{Distance, Drag, Friction, Motor, Prismatic, Pulley, Ratchet, Revolute, Weld, Wheel};
        if let Some(ForeignOption { name, kinds }) = self.foreign {
            return Err(JointError::NoSuchOption { kind: self.kind, option: name, kinds });
        }
        // A rest of 0 is that of all springs.
        let options: [(bool, &'static str, &'static [JointKind]); 9] = [
            (self.limits.is_some(), "limits", &[Revolute, Prismatic, Distance, Wheel]),
            (self.motor.is_some(), "motor", &[Revolute, Prismatic, Distance, Wheel, Ratchet]),
            (
                self.spring.is_some(),
                "spring",
                &[Revolute, Prismatic, Distance, Wheel, Weld, Motor, Drag, Ratchet],
            ),
            (self.rest != 0.0, "rest of its spring", &[Revolute, Prismatic, Wheel, Motor, Ratchet]),
            (self.axis.is_some(), "axis", &[Prismatic, Wheel]),
            (self.length.is_some(), "length", &[Distance, Pulley]),
            (self.target.is_some(), "target", &[Drag]),
            (self.max_force.is_some(), "greatest force", &[Drag, Motor, Friction]),
            (self.max_torque.is_some(), "greatest torque", &[Motor, Friction]),
        ];
        let wrong = options.into_iter().find(|(given, _, kinds)| *given && !kinds.contains(&self.kind));
        match wrong {
            Some((_, option, kinds)) => Err(JointError::NoSuchOption { kind: self.kind, option, kinds }),
            None => Ok(()),
        }
    }
}
