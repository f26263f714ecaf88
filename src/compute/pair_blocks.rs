//! Blocks of pairs of bodies, of which several threads may each have some: those of one colour of the constraint graph.
//!
//! What a part may read and write of the bodies is what the rows of its blocks say. Blocks are divided only after
//! [`PairBlocks::seal`] has seen that no row which a pair moves is anywhere else in them: then nobody reads or writes
//! what somebody else writes.

use core::marker::PhantomData;
use core::ptr::NonNull;

use crate::compute::{BodyState, COLUMN, Divide, Lane, RowPairs};

/// Blocks of sixteen pairs of bodies: which they are, and what is known of them.
#[derive(Clone, Debug)]
pub(crate) struct PairBlocks<B> {
    /// By block.
    rows: Vec<RowPairs>,
    /// As many or more: what a block owns is kept for when there are as many again.
    blocks: Vec<B>,
    /// What is known of the rows, which cannot be written without losing it.
    known: Option<KnownRows>,
}

/// What is known of the rows of all blocks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct KnownRows {
    /// No row is greater.
    greatest: u32,
    /// Whether no row that a pair moves is anywhere else.
    are_disjoint: bool,
}

impl KnownRows {
    /// What there is to know but whether they are disjoint.
    fn of(rows: &[RowPairs]) -> Self {
        let greatest = rows.iter().map(RowPairs::greatest_row).max().unwrap_or(0);
        Self { greatest, are_disjoint: false }
    }
}

impl<B> Default for PairBlocks<B> {
    fn default() -> Self {
        Self { rows: Vec::new(), blocks: Vec::new(), known: None }
    }
}

impl<B> PairBlocks<B> {
    /// How many blocks there are.
    pub(crate) fn len(&self) -> usize {
        self.rows.len()
    }

    /// A block and its rows.
    ///
    /// # Panics
    /// If there is no such block.
    #[inline(always)]
    pub(crate) fn get(&self, number: usize) -> (&RowPairs, &B) {
        (&self.rows[number], &self.blocks[number])
    }

    /// A block, to change it, and its rows.
    ///
    /// # Panics
    /// If there is no such block.
    #[inline(always)]
    pub(crate) fn get_mut(&mut self, number: usize) -> (&RowPairs, &mut B) {
        (&self.rows[number], &mut self.blocks[number])
    }

    /// All rows and blocks.
    pub(crate) fn all(&self) -> (&[RowPairs], &[B]) {
        (&self.rows, &self.blocks[..self.rows.len()])
    }

    /// All rows and blocks, to change them.
    pub(crate) fn all_mut(&mut self) -> (&mut [RowPairs], &mut [B]) {
        self.known = None;
        let blocks = &mut self.blocks[..self.rows.len()];
        (&mut self.rows, blocks)
    }

    /// Takes note of all rows once they are written. With `marks` it looks whether the blocks may be divided: whether no row
    /// that a pair moves is anywhere else in them.
    pub(crate) fn seal(&mut self, marks: Option<&mut RowMarks>) {
        let are_disjoint = marks.is_some_and(|marks| marks.are_disjoint(&self.rows));
        self.known = Some(KnownRows { are_disjoint, ..KnownRows::of(&self.rows) });
    }

    /// The blocks with the states of their bodies, to be divided if they were found to be disjoint.
    ///
    /// # Panics
    /// If there is no state in one of the rows.
    #[inline(always)]
    pub(crate) fn over<'a>(&'a mut self, states: &'a mut [BodyState]) -> BlocksOver<'a, B> {
        let known = self.known.unwrap_or_else(|| KnownRows::of(&self.rows));
        assert!((known.greatest as usize) < states.len(), "a row beyond the {} there are", states.len());
        BlocksOver {
            rows: &self.rows,
            blocks: &mut self.blocks[..self.rows.len()],
            are_disjoint: known.are_disjoint,
            states: NonNull::from(states).cast(),
            slice: PhantomData,
        }
    }
}

impl<B: Default> PairBlocks<B> {
    /// Makes so many of them. Those that are there stay as they are.
    pub(crate) fn resize(&mut self, count: usize) {
        self.known = None;
        self.rows.resize(count, RowPairs::default());
        self.blocks.resize_with(count.max(self.blocks.len()), B::default);
    }

    /// Gives up those after so many, and what is kept for when there are as many again.
    pub(crate) fn trim(&mut self, count: usize) {
        self.known = None;
        self.rows.truncate(count);
        self.blocks.truncate(self.rows.len());
    }
}

/// Some blocks, and the states of their bodies.
#[derive(Debug)]
pub(crate) struct BlocksOver<'a, B> {
    rows: &'a [RowPairs],
    blocks: &'a mut [B],
    are_disjoint: bool,
    /// The first of the states. In every one of the rows there is one.
    states: NonNull<BodyState>,
    slice: PhantomData<&'a mut [BodyState]>,
}

// SAFETY: of the states, which are plain numbers, it uses those that its rows name; what other parts write is not among
// them, see `divide`.
unsafe impl<B: Send> Send for BlocksOver<'_, B> {}

impl<B> BlocksOver<'_, B> {
    /// A block, and the states of its bodies.
    ///
    /// # Panics
    /// If there is no such block.
    #[inline(always)]
    pub(crate) fn get_mut(&mut self, number: usize) -> (&mut B, PairStates<'_>) {
        (&mut self.blocks[number], PairStates { rows: &self.rows[number], states: self.states })
    }
}

impl<B: Send> Divide for BlocksOver<'_, B> {
    fn count(&self) -> usize {
        self.blocks.len()
    }

    /// # Panics
    /// If the blocks were not found to be disjoint.
    fn divide(self, at: usize) -> (Self, Self) {
        assert!(self.are_disjoint, "blocks that share a body are divided");
        let (rows, blocks) = (self.rows.split_at(at), self.blocks.split_at_mut(at));
        (Self { rows: rows.0, blocks: blocks.0, ..self }, Self { rows: rows.1, blocks: blocks.1, ..self })
    }
}

/// The states of the bodies of a block, which no other thread writes, and of which no other reads what the pairs move.
/// Borrowed from the blocks: a part has one at a time.
#[derive(Debug)]
pub(crate) struct PairStates<'a> {
    /// In every one of them there is a state.
    rows: &'a RowPairs,
    /// The first of all states.
    states: NonNull<BodyState>,
}

impl PairStates<'_> {
    /// The states of the pairs from `place` on, a multiple of the lane's width.
    #[inline(always)]
    pub(crate) fn gather<L: Lane>(&self, place: usize) -> [BodyState<L>; 2] {
        // SAFETY: there is a state in every row, borrowed as long as this is, and no other thread writes it.
        unsafe { L::gather(self.states.as_ptr(), self.rows, place) }
    }

    /// The same where only velocities are needed: the rest is at rest.
    #[inline(always)]
    pub(crate) fn gather_velocities<L: Lane>(&self, place: usize) -> [BodyState<L>; 2] {
        // SAFETY: as in `gather`.
        unsafe { L::gather_velocities(self.states.as_ptr(), self.rows, place) }
    }

    /// Writes the velocities of those that the pairs from `place` on move.
    #[inline(always)]
    pub(crate) fn scatter_velocities<L: Lane>(&mut self, place: usize, pair: &[BodyState<L>; 2]) {
        // SAFETY: there is a state in every row, borrowed to be changed as long as this is, and no other thread reads
        // or writes one that the pairs move.
        unsafe { L::scatter_velocities(self.states.as_ptr(), self.rows, place, pair) }
    }

    /// Writes all of the states of the pair at `place`, of the bodies that it moves.
    pub(crate) fn scatter_one(&mut self, place: usize, pair: &[BodyState; 2]) {
        let moves = self.rows.moves::<1>(place);
        for ((row, state), moves) in self.rows.get(place).into_iter().zip(pair).zip(moves) {
            if moves != 0 {
                // SAFETY: as in `scatter_velocities`.
                unsafe { *self.states.as_ptr().add(row as usize) = *state }
            }
        }
    }
}

impl RowPairs {
    /// The states of the pairs from `place` on, a multiple of the lane's width.
    ///
    /// # Panics
    /// If there is no such row.
    #[inline(always)]
    pub(crate) fn gather<L: Lane>(&self, states: &[BodyState], place: usize) -> [BodyState<L>; 2] {
        self.check_among(states.len());
        // SAFETY: there is a state in every row, borrowed, so that nobody writes it.
        unsafe { L::gather(states.as_ptr(), self, place) }
    }

    /// The same where only velocities are needed: the rest is at rest.
    ///
    /// # Panics
    /// If there is no such row.
    #[inline(always)]
    pub(crate) fn gather_velocities<L: Lane>(&self, states: &[BodyState], place: usize) -> [BodyState<L>; 2] {
        self.check_among(states.len());
        // SAFETY: as in `gather`.
        unsafe { L::gather_velocities(states.as_ptr(), self, place) }
    }
}

/// Scratch: how rows were found to be used.
#[derive(Clone, Debug, Default)]
pub(crate) struct RowMarks {
    /// By row: below `read` if it was not found since, `read`, or `read` + 1 if it is moved.
    marks: Vec<u32>,
    read: u32,
}

impl RowMarks {
    /// Whether no row that a pair moves is anywhere else in the blocks.
    fn are_disjoint(&mut self, blocks: &[RowPairs]) -> bool {
        if self.read >= u32::MAX - 3 {
            (self.marks, self.read) = (Vec::new(), 0);
        }
        self.read += 2;
        blocks.iter().all(|rows| self.take_up(rows))
    }

    /// Marks the rows of a block; returns whether they agree with those before.
    fn take_up(&mut self, rows: &RowPairs) -> bool {
        let count = rows.greatest_row() as usize + 1;
        if count > self.marks.len() {
            self.marks.resize(count, 0);
        }
        let (read, moved) = (self.read, self.read + 1);
        let [a_moves, b_moves] = rows.moves::<COLUMN>(0);
        let mut agree = true;
        for place in 0..COLUMN {
            for (row, moves) in rows.get(place).into_iter().zip([a_moves, b_moves]) {
                let mark = &mut self.marks[row as usize];
                if moves & 1 << place != 0 {
                    agree &= *mark < read;
                    *mark = moved;
                } else {
                    agree &= *mark != moved;
                    *mark = read;
                }
            }
        }
        agree
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Pairs with what they move, sixteen to a block.
    fn blocks(pairs: &[([u32; 2], [bool; 2])]) -> PairBlocks<()> {
        let mut blocks = PairBlocks::default();
        blocks.resize(pairs.len().div_ceil(COLUMN));
        for (number, &(rows, moves)) in pairs.iter().enumerate() {
            blocks.all_mut().0[number / COLUMN].set_one(number % COLUMN, rows, moves);
        }
        blocks
    }

    #[test]
    fn blocks_are_disjoint_where_no_pair_names_what_another_moves() {
        let mut marks = RowMarks::default();
        let both = |first: u32| ([first, first + 1], [true; 2]);
        let mut pairs: Vec<_> = (1..40).map(|number| both(3 * number)).collect();
        let mut check = |pairs: &[_]| {
            let mut blocks = blocks(pairs);
            assert_eq!(blocks.known, None);
            blocks.seal(Some(&mut marks));
            blocks.known.is_some_and(|known| known.are_disjoint)
        };
        assert!(check(&pairs) && check(&pairs[..7]) && check(&[]));
        // Many may touch what none of them moves.
        pairs[5] = ([18, 2], [true, false]);
        pairs[38] = ([2, 20], [false, true]);
        assert!(check(&pairs));
        // One that others move: before it, after it, and in the same pair.
        for (number, pair) in [
            (38, ([3, 117], [true; 2])),
            (38, ([3, 117], [false, true])),
            (0, ([3, 114], [true, false])),
            (0, ([114, 3], [true; 2])),
            (20, ([1, 1], [true; 2])),
            (20, ([1, 1], [true, false])),
            (20, ([0, 1], [true; 2])),
        ] {
            let mut pairs = pairs.clone();
            pairs[number] = pair;
            assert!(!check(&pairs), "{pair:?}");
        }
        assert!(check(&pairs));
    }

    #[test]
    fn what_is_known_of_rows_is_forgotten_when_they_may_change() {
        let mut blocks = blocks(&[([1, 2], [true; 2]); 1]);
        let forget: [fn(&mut PairBlocks<()>); 2] = [|blocks| _ = blocks.all_mut(), |blocks| blocks.resize(2)];
        for forget in forget {
            blocks.seal(Some(&mut RowMarks::default()));
            assert_eq!(blocks.known, Some(KnownRows { greatest: 2, are_disjoint: true }));
            forget(&mut blocks);
            assert_eq!(blocks.known, None);
        }
    }

    #[test]
    #[should_panic(expected = "blocks that share a body are divided")]
    fn blocks_that_share_a_body_are_not_divided() {
        let mut pairs = vec![([0, 0], [false; 2]); 20];
        (pairs[0], pairs[19]) = (([1, 2], [true; 2]), ([3, 2], [true; 2]));
        let mut blocks = blocks(&pairs);
        blocks.seal(Some(&mut RowMarks::default()));
        _ = blocks.over(&mut [BodyState::REST; 4]).divide(1);
    }

    #[test]
    fn a_pair_writes_what_it_moves() {
        let mut blocks = blocks(&[([1, 2], [true, false])]);
        let mut states = [BodyState::REST; 3];
        let pushed = BodyState { angular_velocity: 1.0, ..BodyState::REST };
        let mut over = blocks.over(&mut states);
        let ((), mut pairs) = over.get_mut(0);
        pairs.scatter_one(0, &[pushed; 2]);
        assert_eq!(pairs.gather::<f32>(0).map(|state| state.angular_velocity), [1.0, 0.0]);
        assert_eq!(states.map(|state| state.angular_velocity), [0.0, 1.0, 0.0]);
    }
}
