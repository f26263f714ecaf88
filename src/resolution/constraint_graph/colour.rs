//! The contacts of one colour, and where each of them is.

use crate::collision::Contact;
use crate::compute::{COLUMN, DistinctIndices, PairBlocks};
use crate::resolution::contact_block::ContactBlock;
use crate::store::BitSet;

/// How many colours there are. A body can be in one contact per colour; the few contacts of a very crowded
/// body overflow.
pub(super) const COLOURS: usize = 24;

/// Colours from here on are for contacts with the ground only, so that they find room.
pub(super) const FIRST_GROUND_COLOUR: usize = 18;

/// The place of contacts that found no colour: solved one after the other, before all colours.
pub(super) const OVERFLOW: usize = COLOURS;

/// The place of contacts that are solved directly.
pub(super) const DIRECT: usize = COLOURS + 1;

/// Where a contact is in the graph: its colour, and which of the contacts there it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct GraphIndex {
    pub(super) colour: u32,
    pub(super) contact: u32,
}

impl GraphIndex {
    /// Whether it is solved directly.
    pub(crate) fn is_solved_directly(self) -> bool {
        self.block().is_solved_directly()
    }

    pub(crate) fn block(self) -> BlockIndex {
        BlockIndex { colour: self.colour, block: self.contact / COLUMN as u32 }
    }

    /// Its place in its block.
    pub(super) fn place(self) -> usize {
        self.contact as usize % COLUMN
    }
}

/// Where a block is in the graph: its colour, and which of the blocks there it is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct BlockIndex {
    pub(super) colour: u32,
    pub(super) block: u32,
}

impl BlockIndex {
    /// The contact at a place of the block.
    pub(crate) fn contact(self, place: usize) -> GraphIndex {
        GraphIndex { colour: self.colour, contact: self.block * COLUMN as u32 + place as u32 }
    }

    /// Whether its contacts are solved directly.
    pub(crate) fn is_solved_directly(self) -> bool {
        self.colour as usize == DIRECT
    }
}

/// What the contacts of a colour are sorted by, so that most blocks have contacts of one kind and leave out what these do
/// not need: how many points they have, and whether they follow the surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Single,
    SingleMoving,
    DoubleMoving,
    Double,
}

impl Kind {
    pub(super) const COUNT: usize = 4;

    #[inline(always)]
    pub(super) fn of(contact: &Contact) -> Self {
        match (contact.manifold.points().len(), contact.follows) {
            (0 | 1, false) => Self::Single,
            (0 | 1, true) => Self::SingleMoving,
            (_, true) => Self::DoubleMoving,
            (_, false) => Self::Double,
        }
    }
}

/// Contacts of one colour, which share no movable body; or those that have none.
#[derive(Debug, Default)]
pub(super) struct Colour {
    /// Slots of the movable bodies in it.
    pub(super) bodies: BitSet,
    /// Indices of the contacts in it, sorted by their kind.
    pub(super) contacts: DistinctIndices,
    /// By kind: where the contacts of that kind end.
    ends_of_kinds: [usize; Kind::COUNT],
    /// The contacts as the solver sees them during a step, in the same order.
    pub(super) blocks: PairBlocks<ContactBlock>,
}

clone_into_buffers!(Colour { bodies, contacts, ends_of_kinds } scratch { blocks });

impl Colour {
    pub(super) fn is_empty(&self) -> bool {
        self.contacts.is_empty()
    }

    /// Gives up what the contacts in it do not need.
    pub(super) fn trim(&mut self) {
        self.bodies.trim();
        self.contacts.trim();
        self.blocks.trim(self.contacts.len().div_ceil(COLUMN));
    }

    /// Which kind of contacts stands at a place, as a number.
    pub(super) fn kind_at(&self, place: usize) -> usize {
        self.ends_of_kinds.iter().take_while(|&&end| end <= place).count()
    }

    /// Puts a contact to those of its kind; `number` is that of this colour.
    pub(super) fn push(&mut self, number: u32, index: u32, kind: Kind, homes: &mut [Option<GraphIndex>]) {
        // It is put last. Of each kind after it, the first contact becomes the last, in exchange for it.
        let mut place = self.contacts.len();
        self.contacts.push(index);
        for later in (kind as usize + 1..Kind::COUNT).rev() {
            let first = self.ends_of_kinds[later - 1];
            self.exchange(number, place, first, homes);
            self.ends_of_kinds[later] += 1;
            place = first;
        }
        self.ends_of_kinds[kind as usize] += 1;
        homes[index as usize] = Some(GraphIndex { colour: number, contact: place as u32 });
    }

    /// Takes a contact out: the last of each kind from its own on is exchanged for it.
    pub(super) fn take(&mut self, home: GraphIndex, homes: &mut [Option<GraphIndex>]) {
        let mut place = home.contact as usize;
        for kind in self.kind_at(place)..Kind::COUNT {
            self.ends_of_kinds[kind] -= 1;
            let last = self.ends_of_kinds[kind];
            self.exchange(home.colour, place, last, homes);
            place = last;
        }
        self.contacts.pop();
    }

    /// Exchanges a contact that has no place yet, or no longer, for another one, which has then its place.
    fn exchange(&mut self, number: u32, place: usize, other: usize, homes: &mut [Option<GraphIndex>]) {
        if place != other {
            self.contacts.swap(place, other);
            let home = GraphIndex { colour: number, contact: place as u32 };
            homes[self.contacts[place] as usize] = Some(home);
        }
    }
}
