//! A filter by a function, for what [filters](crate::Filter) by category and group cannot say.

use core::fmt;
use std::sync::Arc;

use crate::body::{BodyId, BodyType, ColliderId, Filter, Material};
use crate::shape::Shape;

/// One of two shapes of which a [`ContactFilter`] is asked: what it is, and not where, as the answer holds while both are there.
///
/// ```
/// use rustycs::prelude::*;
///
/// let mut world = World::new(Settings::default());
/// // What is round rolls through gates; all else is stopped by them.
/// const GATE: u64 = 3;
/// world.set_contact_filter(ContactFilter::new(|a, b| {
///     let passes = |one: FilteredShape<'_>, other: FilteredShape<'_>| {
///         one.shape().radius().is_some() && other.body_user_data() == GATE
///     };
///     !passes(a, b) && !passes(b, a)
/// }));
/// let gate = world.add(Body::fixed(Shape::rectangle(0.2, 3.0)).user_data(GATE))?;
/// let ball = world.add(Body::dynamic(Shape::circle(0.5)).at([2.0, 0.0]))?;
/// assert_eq!(world.may_collide(ball, gate), Some(false));
/// # Ok::<(), BodyError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct FilteredShape<'a> {
    pub(super) body: BodyId,
    pub(super) collider: ColliderId,
    pub(super) body_type: BodyType,
    pub(super) body_user_data: u64,
    pub(super) user_data: u64,
    pub(super) filter: Filter,
    pub(super) material: Material,
    pub(super) shape: &'a Shape,
}

impl FilteredShape<'_> {
    /// Its body.
    pub fn body(&self) -> BodyId {
        self.body
    }

    /// Which of the shapes of the body it is.
    pub fn collider(&self) -> ColliderId {
        self.collider
    }

    /// What the body is: one of the two is dynamic.
    pub fn body_type(&self) -> BodyType {
        self.body_type
    }

    /// The caller's own number of the body.
    pub fn body_user_data(&self) -> u64 {
        self.body_user_data
    }

    /// That of the shape: the same for a body of one shape.
    pub fn user_data(&self) -> u64 {
        self.user_data
    }

    /// What it collides with by category and group.
    pub fn filter(&self) -> Filter {
        self.filter
    }

    /// Density, friction and restitution.
    pub fn material(&self) -> Material {
        self.material
    }

    /// Its geometry.
    pub fn shape(&self) -> &Shape {
        self.shape
    }
}

type Collide = dyn Fn(FilteredShape<'_>, FilteredShape<'_>) -> bool + Send + Sync;

/// A function that says whether two shapes collide, for [`World::set_contact_filter`](crate::World::set_contact_filter).
///
/// It is asked of pairs that filters and parted bodies let through, when they come near each other, which may be on any thread and
/// more than once. So it is to be a function of the two alone, and the same whichever comes first: it sees what they are and not
/// where, and what it has captured must not change. Then a step has the same bits on any number of threads, and a pair that is
/// refused costs nothing more until it is found again. After a change of what it reads, as of user data, set it once more: then all
/// pairs are asked about anew. If it panics, so does the step, in the middle: the world is to be dropped.
///
/// A function that is kept, and not one that is given to each step: bodies may be put to sleep, be moved by hand and be asked about
/// between steps, and what was refused is to stay refused. It is shared by all clones of a world, so that a rollback needs no care.
#[derive(Clone)]
pub struct ContactFilter(Arc<Collide>);

impl ContactFilter {
    /// A filter by a function, which is true where two shapes collide.
    ///
    /// ```
    /// use rustycs::prelude::*;
    ///
    /// let mut world = World::new(Settings::default());
    /// // Bodies of one colour pass through each other.
    /// world.set_contact_filter(ContactFilter::new(|a, b| a.body_user_data() != b.body_user_data()));
    /// let red = world.add(Body::dynamic(Shape::circle(0.5)).user_data(0xFF0000))?;
    /// let other = world.add(Body::dynamic(Shape::circle(0.5)).user_data(0xFF0000))?;
    /// assert_eq!(world.may_collide(red, other), Some(false));
    /// # Ok::<(), BodyError>(())
    /// ```
    pub fn new(
        collide: impl Fn(FilteredShape<'_>, FilteredShape<'_>) -> bool + Send + Sync + 'static,
    ) -> Self {
        Self(Arc::new(collide))
    }

    /// Whether it lets two shapes collide.
    pub(super) fn lets_collide(&self, a: FilteredShape<'_>, b: FilteredShape<'_>) -> bool {
        (self.0)(a, b)
    }
}

impl fmt::Debug for ContactFilter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("ContactFilter")
    }
}
