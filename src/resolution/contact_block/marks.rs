//! Which contacts of a block something is true of.

use crate::compute::{COLUMN, Column, Lane};
use crate::store::places_of;

/// Some of the sixteen contacts of a block.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Marks(u16);

impl Marks {
    /// Marks the contact at `place`, below [`COLUMN`], that is not marked yet, or not.
    #[inline(always)]
    pub(crate) fn set(&mut self, place: usize, is_marked: bool) {
        self.0 |= u16::from(is_marked) << place;
    }

    /// Marks the contact at `place`, below [`COLUMN`], or takes its mark away.
    #[inline(always)]
    pub(crate) fn put(&mut self, place: usize, is_marked: bool) {
        self.0 = self.0 & !(1 << place) | u16::from(is_marked) << place;
    }

    /// Marks as many contacts as a lane holds from `place` on, or not, as the bits of a mask say.
    #[inline(always)]
    pub(super) fn write<L: Lane>(&mut self, place: usize, bits: u32) {
        let of_lane = (1_u32 << L::WIDTH) - 1;
        self.0 = (u32::from(self.0) & !(of_lane << place) | (bits & of_lane) << place) as u16;
    }

    /// The marks of as many contacts as a lane holds from `place` on.
    #[inline(always)]
    pub(super) fn mask<L: Lane>(self, place: usize) -> L::Mask {
        let mut marks = Column::default();
        for of_lane in place..place + L::WIDTH {
            marks.set(of_lane, f32::from(self.0 >> of_lane & 1));
        }
        L::load(&marks, place).greater(L::splat(0.0))
    }

    /// How many are marked.
    pub(crate) fn count(self) -> usize {
        self.0.count_ones() as usize
    }

    /// Whether the contact at `place` is marked.
    #[inline(always)]
    pub(crate) fn get(self, place: usize) -> bool {
        self.0 & 1 << place != 0
    }

    /// Those marked in either.
    #[inline(always)]
    pub(super) fn or(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// Whether any is marked.
    pub(crate) fn any(self) -> bool {
        self.0 != 0
    }

    /// The first place of each lane that has marked contacts, and these as the bits of a mask.
    #[inline(always)]
    pub(crate) fn lanes<L: Lane>(self) -> impl Iterator<Item = (usize, u32)> {
        let of_lane = (1_u32 << L::WIDTH) - 1;
        let lanes = (0..COLUMN).step_by(L::WIDTH);
        lanes.map(move |first| (first, u32::from(self.0) >> first & of_lane)).filter(|&(_, bits)| bits != 0)
    }

    /// Calls `visit` with the places of the marked contacts, in order.
    #[inline(always)]
    pub(crate) fn for_each(self, visit: impl FnMut(usize)) {
        places_of(self.0.into()).for_each(visit);
    }
}

#[cfg(test)]
mod tests {
    use super::Marks;
    use crate::compute::{COLUMN, F32x4, Lane};

    fn marked(places: &[usize]) -> Marks {
        let mut marks = Marks::default();
        for &place in places {
            marks.put(place, true);
        }
        marks
    }

    #[test]
    fn a_mark_is_put_and_taken_away_alone() {
        let mut marks = marked(&[0, 5, 15]);
        marks.put(5, false);
        assert_eq!((0..COLUMN).filter(|&place| marks.get(place)).collect::<Vec<_>>(), [0, 15]);
        assert_eq!(marks.count(), 2);
    }

    #[test]
    fn lanes_see_the_marks_of_their_places() {
        let marks = marked(&[1, 4, 6, 15]);
        let lanes: Vec<_> = marks.lanes::<F32x4>().collect();
        assert_eq!(lanes, [(0, 0b0010), (4, 0b0101), (12, 0b1000)]);
        for first in (0..COLUMN).step_by(4) {
            let bits = lanes.iter().find(|lane| lane.0 == first).map_or(0, |lane| lane.1);
            assert_eq!(F32x4::bits(marks.mask::<F32x4>(first)), bits, "from {first} on");
        }
        let mut written = marks;
        written.write::<F32x4>(4, 0b1000);
        assert_eq!((0..COLUMN).filter(|&place| written.get(place)).collect::<Vec<_>>(), [1, 7, 15]);
    }
}
