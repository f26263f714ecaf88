//! Values at fixed places, named by keys that notice when the value has gone.

use core::num::NonZeroU32;
use core::ops::{Index, IndexMut, Range};

use crate::compute::{Chosen, DistinctIndices, Divide, prefetch, prefetch_lines};

/// Place and generation of a value in [`Slots`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) struct Key {
    generation: NonZeroU32,
    index: u32,
}

impl Key {
    /// The place, which is what the engine's own tables are indexed by.
    #[inline(always)]
    pub(crate) fn index(self) -> u32 {
        self.index
    }

    /// How often the place had been filled when this key was given out.
    pub(crate) fn generation(self) -> u32 {
        self.generation.get()
    }

    pub(crate) fn to_bits(self) -> u64 {
        u64::from(self.generation.get()) << 32 | u64::from(self.index)
    }

    pub(crate) fn from_bits(bits: u64) -> Option<Self> {
        Some(Self { generation: NonZeroU32::new((bits >> 32) as u32)?, index: bits as u32 })
    }
}

/// Values at fixed places. A removed value's place is used again (last freed first) under a new generation.
#[derive(Debug)]
pub(crate) struct Slots<T> {
    values: Vec<Option<T>>,
    /// Of each place. Only keys are compared with it, and values keep to their cache lines without it.
    generations: Vec<NonZeroU32>,
    free: Vec<u32>,
    /// That of a place which is made anew: above those of all places there were beyond the last.
    first_generation: NonZeroU32,
}

clone_into_buffers!(Slots<T> { values, generations, free, first_generation });

impl<T> Default for Slots<T> {
    fn default() -> Self {
        Self {
            values: Vec::new(),
            generations: Vec::new(),
            free: Vec::new(),
            first_generation: NonZeroU32::MIN,
        }
    }
}

impl<T> Slots<T> {
    /// Asks for the value at a place to be brought close.
    #[inline(always)]
    pub(crate) fn prefetch(&self, index: u32) {
        prefetch(&self.values, index as usize);
    }

    /// Asks for some cache lines of it.
    #[inline(always)]
    pub(crate) fn prefetch_lines(&self, index: u32, lines: Range<usize>) {
        prefetch_lines(&self.values, index as usize, lines);
    }

    /// Asks for the place that will be filled after so many others to be brought close.
    #[inline(always)]
    pub(crate) fn prefetch_free(&self, after: usize) {
        if let Some(place) = self.free.len().checked_sub(after + 1) {
            self.prefetch(self.free[place]);
        }
    }

    /// How many values there are.
    pub(crate) fn len(&self) -> usize {
        self.values.len() - self.free.len()
    }

    /// How many places there are, the free ones with them.
    pub(crate) fn place_count(&self) -> usize {
        self.values.len()
    }

    pub(crate) fn insert(&mut self, value: T) -> Key {
        if let Some(index) = self.free.pop() {
            self.values[index as usize] = Some(value);
            Key { generation: self.generations[index as usize], index }
        } else {
            let index = self.values.len() as u32;
            self.values.push(Some(value));
            self.generations.push(self.first_generation);
            Key { generation: self.first_generation, index }
        }
    }

    /// How many places after the last value are free; so many are looked at.
    pub(crate) fn free_at_end(&self, looks: usize) -> usize {
        self.values.iter().rev().take(looks).take_while(|value| value.is_none()).count()
    }

    /// Gives up the free places after the last value. Keys of values that were there stay stale.
    pub(crate) fn trim(&mut self) {
        let count = self.values.iter().rposition(Option::is_some).map_or(0, |last| last + 1);
        self.values.truncate(count);
        self.free.retain(|&index| (index as usize) < count);
        let given_up = self.generations.drain(count..);
        self.first_generation = given_up.fold(self.first_generation, NonZeroU32::max);
    }

    /// Takes the value out, or `None` for a stale key.
    pub(crate) fn remove(&mut self, key: Key) -> Option<T> {
        let place = key.index as usize;
        let generation =
            self.generations.get_mut(place).filter(|generation| **generation == key.generation)?;
        let value = self.values[place].take()?;
        // After 2³² - 1 uses of one place the count starts again at 1.
        *generation = generation.checked_add(1).unwrap_or(NonZeroU32::MIN);
        self.free.push(key.index);
        Some(value)
    }

    /// Whether the key is that of the value at its place, or of none.
    fn is_current(&self, key: Key) -> bool {
        self.generations.get(key.index as usize) == Some(&key.generation)
    }

    pub(crate) fn get(&self, key: Key) -> Option<&T> {
        if self.is_current(key) { self.at(key.index) } else { None }
    }

    pub(crate) fn get_mut(&mut self, key: Key) -> Option<&mut T> {
        if self.is_current(key) { self.values[key.index as usize].as_mut() } else { None }
    }

    /// The value at a place, if it is filled.
    pub(crate) fn at(&self, index: u32) -> Option<&T> {
        self.values.get(index as usize)?.as_ref()
    }

    /// The key of the value at a place that is filled.
    pub(crate) fn key_at(&self, index: u32) -> Key {
        debug_assert!(self.at(index).is_some(), "place {index} is free");
        Key { generation: self.generations[index as usize], index }
    }

    /// The values by ascending place, to change them.
    pub(crate) fn values_mut(&mut self) -> impl Iterator<Item = &mut T> {
        self.values.iter_mut().flatten()
    }

    /// Keys and values by ascending place.
    pub(crate) fn iter(&self) -> impl Iterator<Item = (Key, &T)> {
        (0..).zip(self.values.iter().zip(&self.generations)).filter_map(|(index, (value, &generation))| {
            value.as_ref().map(|value| (Key { generation, index }, value))
        })
    }
}

/// The values at some places, each of them once.
#[derive(Debug)]
pub(crate) struct ChosenSlots<'a, T>(Chosen<'a, Option<T>>);

impl<T> Slots<T> {
    /// The values at some places, that are filled.
    pub(crate) fn chosen<'a>(&'a mut self, places: &'a DistinctIndices) -> ChosenSlots<'a, T> {
        ChosenSlots(Chosen::new(&mut self.values, places))
    }
}

impl<T> ChosenSlots<'_, T> {
    /// How many there are.
    #[inline(always)]
    pub(crate) fn len(&self) -> usize {
        self.0.len()
    }

    /// These, without so many of the first.
    #[inline(always)]
    pub(crate) fn skipping(&mut self, first: usize) -> ChosenSlots<'_, T> {
        ChosenSlots(self.0.skipping(first))
    }

    /// Asks for some cache lines of one of them to be brought close, if there are so many.
    #[inline(always)]
    pub(crate) fn prefetch(&self, number: usize, lines: Range<usize>) {
        self.0.prefetch(number, lines);
    }

    /// Index of one of them.
    ///
    /// # Panics
    /// If there are not so many.
    #[inline(always)]
    pub(crate) fn index(&self, number: usize) -> u32 {
        self.0.indices()[number]
    }

    /// One of them, if there are so many.
    #[inline(always)]
    pub(crate) fn get(&self, number: usize) -> Option<&T> {
        if number < self.len() { self.0.get(number).as_ref() } else { None }
    }

    /// One of them, to change it.
    #[inline(always)]
    pub(crate) fn get_mut(&mut self, number: usize) -> &mut T {
        self.0.get_mut(number).as_mut().expect("the place is filled")
    }
}

impl<T: Send> Divide for ChosenSlots<'_, T> {
    fn count(&self) -> usize {
        self.len()
    }

    fn divide(self, at: usize) -> (Self, Self) {
        let (first, last) = self.0.divide(at);
        (Self(first), Self(last))
    }
}

impl<T> Index<u32> for Slots<T> {
    type Output = T;
    #[inline(always)]
    fn index(&self, index: u32) -> &T {
        self.values[index as usize].as_ref().expect("the place is filled")
    }
}

impl<T> IndexMut<u32> for Slots<T> {
    #[inline(always)]
    fn index_mut(&mut self, index: u32) -> &mut T {
        self.values[index as usize].as_mut().expect("the place is filled")
    }
}

#[cfg(test)]
mod tests {
    use super::{Key, Slots};

    #[test]
    fn a_key_is_stale_after_its_value_was_removed_even_when_the_place_is_used_again() {
        let mut slots = Slots::default();
        let first = slots.insert("first");
        let second = slots.insert("second");
        assert_eq!(slots.remove(first), Some("first"));
        let third = slots.insert("third");
        assert_eq!(third.index(), first.index());
        assert_eq!(
            (slots.get(first), slots.get(second), slots.get(third)),
            (None, Some(&"second"), Some(&"third"))
        );
        assert_eq!(slots.remove(first), None);
        assert_eq!(slots.len(), 2);
    }

    #[test]
    fn places_after_the_last_value_are_given_up_and_their_keys_stay_stale() {
        let mut slots = Slots::default();
        let keys = ["a", "b", "c", "d", "e"].map(|value| slots.insert(value));
        for removed in [1, 3, 4] {
            slots.remove(keys[removed]);
        }
        // The last place has been used twice.
        let again = slots.insert("f");
        assert_eq!(again.index(), keys[4].index());
        slots.remove(again);
        assert_eq!((slots.free_at_end(9), slots.free_at_end(1)), (2, 1));
        slots.trim();
        assert_eq!((slots.place_count(), slots.len(), slots.get(keys[2])), (3, 2, Some(&"c")));
        let [gap, new, newer] = ["g", "h", "i"].map(|value| slots.insert(value));
        assert_eq!([gap, new, newer].map(Key::index), [1, 3, 4]);
        for stale in [keys[1], keys[3], keys[4], again] {
            assert_eq!(slots.get(stale), None);
        }
        assert_eq!([gap, new, newer].map(|key| slots.get(key)), [Some(&"g"), Some(&"h"), Some(&"i")]);
    }

    #[test]
    fn an_optional_key_is_as_small_as_a_key_and_survives_the_way_through_bits() {
        assert_eq!(size_of::<Option<Key>>(), 8);
        let key = Slots::default().insert(());
        assert_eq!(Key::from_bits(key.to_bits()), Some(key));
        assert_eq!(Key::from_bits(7), None);
    }
}
