//! Which bodies collide with which, by bits.

/// Which bodies a body collides with.
///
/// Two bodies of the same `group`, if that is not 0, collide always where it is positive, and never where it is negative.
/// All others collide if the category of each is in the mask of the other. A pair can be parted beside that, see
/// [`World::set_collision`](crate::World::set_collision).
///
/// ```
/// use rustycs::prelude::*;
///
/// const PLAYERS: u64 = 0x2;
/// const BULLETS: u64 = 0x4;
///
/// let player = Filter { category: PLAYERS, ..Filter::DEFAULT };
/// // Bullets hit all but bullets.
/// let bullet = Filter { category: BULLETS, mask: !BULLETS, ..Filter::DEFAULT };
/// assert!(bullet.collides_with(player) && !bullet.collides_with(bullet));
/// // Those of one player have his group, and pass through him.
/// let own = |filter| Filter { group: -7, ..filter };
/// assert!(!own(bullet).collides_with(own(player)));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Filter {
    /// What the body is: as a rule one bit. The default is the lowest.
    pub category: u64,
    /// Categories that it collides with. The default is all.
    pub mask: u64,
    /// Bodies of one group collide always (positive) or never (negative), whatever their categories; 0, the default, is none.
    pub group: i32,
}

impl Filter {
    /// That of a body which is given none: of the lowest category, collides with all, has no group.
    pub const DEFAULT: Self = Self { category: 1, mask: u64::MAX, group: 0 };

    /// Whether two bodies with these filters collide.
    #[must_use]
    pub const fn collides_with(self, other: Self) -> bool {
        if self.group == other.group && self.group != 0 {
            self.group > 0
        } else {
            self.category & other.mask != 0 && other.category & self.mask != 0
        }
    }
}

impl Default for Filter {
    fn default() -> Self {
        Self::DEFAULT
    }
}
