//! Rolling resistance, as a body is described with it.

use crate::body::Body;

impl Body {
    /// Coefficient of rolling resistance, no unit, beside those of the [material](Self::material): by how much a disc that rolls
    /// is slowed down, as a share of the force that presses it on, over its mass. On level ground it stops after v²/(2 c g), if its
    /// friction is greater than c, and on a slope it stays up to a gradient of 3/2 c. Rubber on asphalt has some 0.01, on grass 0.1.
    ///
    /// It acts where a circle touches something, as a moment of 3/2 c r N on both that never turns the spin round. Of two bodies the
    /// greater coefficient counts, or the only one that was told. r is the radius of the circle, or the extent of the other body if that can
    /// turn, or is round, and is smaller. Boxes, polygons, capsules and round corners may have it too, for the circles that they touch;
    /// between two of them it does nothing. Of a body of several shapes only circles about its centre of mass roll.
    ///
    /// Where neither of two bodies was told one it is 0.002, as of hard wheels on hard ground: a disc at 1 m/s comes 25 m far, and
    /// heaps come to rest. What is told 0 rolls on for ever, on all that was not told more.
    ///
    /// ```
    /// # use rustycs::prelude::*;
    /// # let mut world = World::new(Settings::default());
    /// # world.add_force(Force::EARTH_GRAVITY);
    /// # world.add(Body::fixed(Shape::rectangle(100.0, 1.0)).at([0.0, -0.5]))?;
    /// let ball = Body::dynamic(Shape::circle(0.5)).at([0.0, 0.5]).velocity([2.0, 0.0]).angular_velocity(-4.0);
    /// let ball = world.add(ball.rolling_resistance(0.1))?;
    /// # for _ in 0..180 { world.step(); }
    /// assert!((world.body(ball).unwrap().position().x - 2.0 * 2.0 / (2.0 * 0.1 * 9.81)).abs() < 0.01);
    /// # Ok::<(), BodyError>(())
    /// ```
    #[must_use]
    pub fn rolling_resistance(mut self, coefficient: f32) -> Self {
        self.role.rolling_resistance = Some(coefficient);
        self
    }

    /// Coefficient of rolling resistance, no unit; 0.002 where none was told.
    pub fn get_rolling_resistance(&self) -> f32 {
        self.role.rolling_resistance_or_usual()
    }
}
