//! Whether two shapes collide where they meet.

use crate::body::{Bodies, BodyId, ColliderId, FilteredShape};

impl Bodies {
    /// Whether the bodies in two slots collide where they meet.
    #[inline(always)]
    pub(crate) fn may_collide(&self, a: u32, b: u32) -> bool {
        (self.is_dynamic(a) || self.is_dynamic(b))
            && self.roles.may_collide([a, b], self.bodies_of([a, b]))
            && (self.contact_filter.is_none() || self.filter_lets_collide([a, b]))
    }

    #[cold]
    fn filter_lets_collide(&self, [a, b]: [u32; 2]) -> bool {
        // In one order, so that a function that is not the same both ways is so every time.
        let (first, second) = (self.filtered(a.min(b)), self.filtered(a.max(b)));
        self.contact_filter.as_ref().is_none_or(|filter| filter.lets_collide(first, second))
    }

    fn filtered(&self, slot: u32) -> FilteredShape<'_> {
        let body = self.body_of(slot);
        FilteredShape {
            body: BodyId(self.records.key_at(body)),
            collider: ColliderId(self.records.key_at(slot)),
            body_type: self.records[body].body_type,
            body_user_data: self.records[body].user_data,
            user_data: self.records[slot].user_data,
            filter: self.roles.of(slot).filter,
            material: self.records[slot].material,
            shape: &self.shapes[slot as usize],
        }
    }
}
