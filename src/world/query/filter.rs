//! Which bodies a query finds.

use core::fmt;

use crate::body::{BodyId, Role};
use crate::world::{BodyRef, World};

/// Which bodies a query finds: by default all but sensors. It borrows what it is given and allocates nothing.
///
/// ```
/// # use rustycs::prelude::*;
/// # let mut world = World::new(Settings::default());
/// # let player = world.add(Body::dynamic(Shape::circle(0.5)))?;
/// const WALLS: u64 = 0x4;
/// let wall = Body::fixed(Shape::aabb(1.0, 4.0)).at([5.0, 0.0]).filter(Filter { category: WALLS, ..Filter::DEFAULT });
/// # let wall =
/// world.add(wall)?;
/// // From within the player, who is not in the way.
/// let filter = QueryFilter::new().mask(WALLS).ignore(player);
/// let hit = world.ray_cast_with([0.0, 0.0], [10.0, 0.0], &filter).unwrap();
/// assert_eq!((hit.body, hit.fraction), (wall, 0.45));
/// # Ok::<(), BodyError>(())
/// ```
#[derive(Clone, Copy)]
#[must_use]
pub struct QueryFilter<'a> {
    mask: u64,
    category: Option<u64>,
    sensors: bool,
    ignored: Option<BodyId>,
    all_ignored: &'a [BodyId],
    predicate: Option<&'a dyn Fn(BodyRef<'_>) -> bool>,
}

impl<'a> QueryFilter<'a> {
    /// All bodies but sensors.
    pub const fn new() -> Self {
        let (mask, sensors) = (u64::MAX, false);
        Self { mask, category: None, sensors, ignored: None, all_ignored: &[], predicate: None }
    }

    /// Whether sensors are found too.
    pub const fn sensors(mut self, sensors: bool) -> Self {
        self.sensors = sensors;
        self
    }

    /// Only bodies of these categories, see [`Filter`](crate::Filter).
    pub const fn mask(mut self, mask: u64) -> Self {
        self.mask = mask;
        self
    }

    /// Only bodies whose mask has one of these categories: those that a body of this category would meet.
    pub const fn category(mut self, category: u64) -> Self {
        self.category = Some(category);
        self
    }

    /// Not this body, nor those of [`ignore_all`](Self::ignore_all). Another call takes the place of this one.
    pub const fn ignore(mut self, body: BodyId) -> Self {
        self.ignored = Some(body);
        self
    }

    /// None of these bodies.
    pub const fn ignore_all(mut self, bodies: &'a [BodyId]) -> Self {
        self.all_ignored = bodies;
        self
    }

    /// Only bodies for which this is true. It is asked last, about those that would be found.
    ///
    /// ```
    /// # use rustycs::prelude::*;
    /// # let world = World::new(Settings::default());
    /// let is_light = |body: BodyRef<'_>| body.mass() < 1.0;
    /// let light = world.overlaps(&Shape::circle(5.0), Pose::at([0.0, 0.0]), &QueryFilter::new().predicate(&is_light));
    /// # assert!(light.is_empty());
    /// ```
    pub const fn predicate(mut self, predicate: &'a dyn Fn(BodyRef<'_>) -> bool) -> Self {
        self.predicate = Some(predicate);
        self
    }
}

impl Default for QueryFilter<'_> {
    fn default() -> Self {
        Self::new()
    }
}

impl fmt::Debug for QueryFilter<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut shown = f.debug_struct("QueryFilter");
        shown.field("mask", &self.mask).field("category", &self.category).field("sensors", &self.sensors);
        shown.field("ignored", &self.ignored).field("all_ignored", &self.all_ignored);
        shown.field("has_predicate", &self.predicate.is_some()).finish()
    }
}

impl World {
    /// Whether a query is about the body in `slot` at all, as far as its predicate is not asked.
    pub(super) fn is_asked_about(&self, filter: &QueryFilter<'_>, slot: u32) -> bool {
        let Role { filter: of_body, is_sensor, .. } = self.bodies.roles.of(slot);
        if is_sensor && !filter.sensors {
            return false;
        }
        if of_body.category & filter.mask == 0 || filter.category.is_some_and(|own| of_body.mask & own == 0) {
            return false;
        }
        let id = self.id_of(slot);
        filter.ignored != Some(id) && !filter.all_ignored.contains(&id)
    }

    /// What the predicate of a query says of the body in `slot`.
    pub(super) fn satisfies(&self, filter: &QueryFilter<'_>, slot: u32) -> bool {
        filter.predicate.is_none_or(|predicate| predicate(BodyRef::new(self, self.id_of(slot))))
    }
}
