//! How an island may be solved; [`tiers`](super::tiers) says which is.

/// How the contacts of an island are solved.
///
/// ```
/// use rustycs::prelude::*;
///
/// let mut world = World::new(Settings::default());
/// world.add_force(Force::EARTH_GRAVITY);
/// world.add(Body::fixed(Shape::rectangle(20.0, 1.0)).at([0.0, -0.5]))?;
/// let small = world.add(Body::dynamic(Shape::rectangle(1.0, 1.0)).at([0.0, 0.5]).mass(1.0))?;
/// world.add(Body::dynamic(Shape::rectangle(3.0, 3.0)).at([0.0, 2.5]).mass(1000.0))?;
/// for _ in 0..10 {
///     world.step();
/// }
/// assert_eq!(world.body(small).unwrap().tier(), Tier::Direct, "a tonne on a kilogram");
/// # Ok::<(), BodyError>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Tier {
    /// By sweeps over all contacts, one after the other.
    #[default]
    Swept,
    /// All contacts at once.
    Direct,
}
