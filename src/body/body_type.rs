//! How a body takes part in the motion.

use core::fmt;

/// How a body takes part in the motion.
///
/// ```
/// use rustycs::prelude::*;
///
/// let mut world = World::new(Settings::default());
/// world.add_force(Force::EARTH_GRAVITY);
/// let branch = world.add(Body::fixed(Shape::rectangle(2.0, 0.2)).at([0.0, 5.0]))?;
/// world.step();
/// world.body_mut(branch).unwrap().set_body_type(BodyType::Dynamic)?; // it breaks off
/// for _ in 0..60 {
///     world.step();
/// }
/// assert!((world.body(branch).unwrap().position().y - (5.0 - 0.5 * 9.81)).abs() < 1e-4);
/// # Ok::<(), BodyError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BodyType {
    /// Moved by forces and contacts.
    Dynamic,
    /// Never moves.
    Fixed,
    /// Moves with the velocity it is told, whatever it meets; as if its mass were infinite.
    Kinematic,
}

impl fmt::Display for BodyType {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Dynamic => "dynamic",
            Self::Fixed => "fixed",
            Self::Kinematic => "kinematic",
        })
    }
}
