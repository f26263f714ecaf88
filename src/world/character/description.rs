//! What a character is.

use crate::body::limits::{STRONGEST, check_place};
use crate::body::{BodyError, BodyId, Filter, check_range};
use crate::math::{Point, Vec2};
use crate::shape::Shape;

/// The gap that a character keeps to what it meets, as a share of its width, no unit: far above what rounding moves it by, and
/// nothing that is seen.
const SKIN_OF_WIDTH: f32 = 0.005;

/// A character to be moved by hand, for a [`Mover`](crate::Mover): any shape that is convex and has a width, which never turns.
///
/// ```
/// use rustycs::prelude::*;
///
/// let hero = Character::new(Shape::rectangle(0.6, 1.8))
///     .at([0.0, 0.9])
///     .max_slope(0.8) // rad
///     .step_height(0.3) // m
///     .push_force(200.0); // N
/// let mover = Mover::new(hero)?;
/// # Ok::<(), BodyError>(())
/// ```
///
/// Nothing is checked here: [`Mover::new`](crate::Mover::new) checks all of it at once.
#[derive(Clone, Debug, PartialEq)]
pub struct Character {
    pub(super) shape: Shape,
    pub(super) at: Point,
    pub(super) up: Vec2,
    pub(super) max_slope: f32,
    pub(super) step_height: f32,
    pub(super) snap: f32,
    pub(super) push_force: f32,
    pub(super) filter: Filter,
    pub(super) ignored: Option<BodyId>,
}

impl Character {
    /// A character of a shape. It walks slopes of up to 45° and steps of up to a fifth of the width of the shape, snaps to the
    /// ground as far, and pushes nothing.
    #[must_use]
    pub fn new(shape: Shape) -> Self {
        let step = 0.2 * shape.thickness();
        Self {
            shape,
            at: Point::ORIGIN,
            up: Vec2::new(0.0, 1.0),
            max_slope: core::f32::consts::FRAC_PI_4,
            step_height: step,
            snap: step,
            push_force: 0.0,
            filter: Filter::DEFAULT,
            ignored: None,
        }
    }

    /// Place of its centre, m.
    #[must_use]
    pub fn at(mut self, center: impl Into<Point>) -> Self {
        self.at = center.into();
        self
    }

    /// Which way is up, of any length. Default: along y.
    #[must_use]
    pub fn up(mut self, up: impl Into<Vec2>) -> Self {
        let up = up.into();
        self.up = up.direction().unwrap_or(up);
        self
    }

    /// Steepest slope that it walks and stands on, rad against the level, 0 to less than π/2.
    #[must_use]
    pub fn max_slope(mut self, angle: f32) -> Self {
        self.max_slope = angle;
        self
    }

    /// Highest step that it climbs, m; 0 for none. It does not climb dynamic bodies, and climbs only where it can stand.
    #[must_use]
    pub fn step_height(mut self, height: f32) -> Self {
        self.step_height = height;
        self
    }

    /// How far the ground may fall away in a move, m, and the character still stays on it: down a step of this height, or down a
    /// slope. With 0 it walks off into the air.
    #[must_use]
    pub fn snap(mut self, distance: f32) -> Self {
        self.snap = distance;
        self
    }

    /// Force with which it pushes dynamic bodies, N, at most. What is lighter gets as fast as the character, and no faster.
    #[must_use]
    pub fn push_force(mut self, force: f32) -> Self {
        self.push_force = force;
        self
    }

    /// What it meets, as the filter of a body would say. Sensors it never does.
    #[must_use]
    pub fn filter(mut self, filter: Filter) -> Self {
        self.filter = filter;
        self
    }

    /// A body that it does not meet: the one that stands for it in the world. Another call takes the place of this one.
    #[must_use]
    pub fn ignore(mut self, body: BodyId) -> Self {
        self.ignored = Some(body);
        self
    }

    /// Its shape.
    pub fn get_shape(&self) -> &Shape {
        &self.shape
    }

    /// Gap that it keeps to what it meets, m: 0.5 % of the width of its shape.
    pub fn get_skin(&self) -> f32 {
        SKIN_OF_WIDTH * self.shape.thickness()
    }

    pub(super) fn validate(&self) -> Result<(), BodyError> {
        self.shape.validate()?;
        check_range("the width of the character", f64::from(self.shape.thickness()), [1e-5, 1e8], "m")?;
        check_place(self.at)?;
        check_range("the length of the up direction", f64::from(self.up.length()), [0.999, 1.001], "")?;
        check_range("the steepest slope", f64::from(self.max_slope), [0.0, 1.57], "rad")?;
        check_range("the height of a step", f64::from(self.step_height), [0.0, 1e8], "m")?;
        check_range("the snapping distance", f64::from(self.snap), [0.0, 1e8], "m")?;
        check_range("the pushing force", f64::from(self.push_force), [0.0, STRONGEST], "N")
    }
}
