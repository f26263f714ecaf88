//! The spring by which the mouse drags a body.

use rustycs::{BodyId, BodyType, Point, Pose, Vec2, World};

/// Natural frequency of the spring, rad/s: it closes most of a distance in a tenth of a second.
const FREQUENCY: f32 = 20.0;

/// A spring from a point of a body to the mouse, critically damped.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spring {
    pub(crate) body: BodyId,
    /// The point of the body that is held, m, in the body's frame.
    anchor: Vec2,
    /// Where it is pulled, m.
    target: Point,
}

impl Spring {
    /// A spring that holds the first body at a place that moves by forces.
    pub(crate) fn grab(world: &World, place: Point) -> Option<Self> {
        let is_movable =
            |id: &BodyId| world.body(*id).is_some_and(|body| body.body_type() == BodyType::Dynamic);
        let body = world.bodies_at(place).into_iter().rev().find(is_movable)?;
        let anchor = world.body(body)?.pose().to_local(place);
        Some(Self { body, anchor, target: place })
    }

    /// The same spring, pulling elsewhere.
    pub(crate) fn toward(self, target: Point) -> Self {
        Self { target, ..self }
    }

    /// Where the held point of a body with this pose is.
    pub(crate) fn held(&self, pose: Pose) -> Point {
        pose.to_world(self.anchor)
    }

    /// Pulls for the length of a tick.
    ///
    /// A point of effective mass m that is x from its target and moves at v is pulled with
    /// m (w² x - 2 w v) / (1 + 2 w h + w² h²): the backward Euler step of the critically damped spring, which is
    /// stable for every length h of the tick. Along the worst direction 1/m = 1/M + r²/I.
    pub(crate) fn pull(&self, world: &mut World) {
        let h = world.settings().tick_seconds() as f32;
        let Some(body) = world.body(self.body) else { return };
        let held = self.held(body.pose());
        let arm = held - body.pose().center;
        let mass = 1.0 / (1.0 / body.mass() + arm.length_squared() / body.inertia());
        let (apart, velocity) = (self.target - held, body.velocity_at(held));
        let w = FREQUENCY;
        let strength = mass / (1.0 + 2.0 * w * h + w * w * h * h);
        let force = (apart * (w * w) - velocity * (2.0 * w)) * strength;
        if let Some(mut body) = world.body_mut(self.body) {
            // The mouse, or the body, may be farther away than a place can be given.
            if force.length() < 1e18 && held.distance(Point::ORIGIN) < 1e12 {
                body.apply_force_at(force, held);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rustycs::{Body, Settings, Shape};

    #[test]
    fn a_held_body_comes_to_rest_at_the_mouse() {
        for tick_rate in [30.0, 60.0, 240.0] {
            let mut world = World::new(Settings { tick_rate, ..Settings::default() });
            let ball = world.add(Body::dynamic(Shape::circle(0.5))).unwrap();
            let mut spring = Spring::grab(&world, Point::ORIGIN).unwrap();
            spring.target = Point::new(3.0, 1.0);
            for _ in 0..(2.0 * tick_rate) as u32 {
                spring.pull(&mut world);
                world.step();
            }
            let body = world.body(ball).unwrap();
            // e^(-w t) (1 + w t) of 3.2 m is below rounding after two seconds.
            assert!((body.position() - Vec2::new(3.0, 1.0)).length() < 1e-3);
            assert!(body.velocity().length() < 1e-2);
        }
    }
}
