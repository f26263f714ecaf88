//! The constraint graph: contacts sorted into colours, so that no two of one colour share a body that the
//! solver moves.
//!
//! Contacts of one colour can be solved in any order, or at once in lanes, with the same result. Colours are
//! kept across steps: a contact enters one when it gets points and leaves it when it loses them, greedily
//! (E. Catto, "Simulation Islands", 2023). Contacts with the ground take the last colours: solved last, they
//! have the last word, and the ground gives no way. The contacts of islands that are solved directly have no colour.

mod colour;
mod passes;

use crate::body::Bodies;
use crate::collision::{Contact, Contacts};
use crate::compute::{GROUND_ROW, RowMarks, RowPairs};
use crate::resolution::constraint::ContactConstraint;
pub(crate) use crate::resolution::constraint_graph::colour::{BlockIndex, GraphIndex};
use crate::resolution::constraint_graph::colour::{
    COLOURS, Colour, DIRECT, FIRST_GROUND_COLOUR, Kind, OVERFLOW,
};
use crate::resolution::contact_block::ContactBlock;
use crate::resolution::tier::Tier;
use crate::store::{BitSet, places_of};

/// All contacts with points, by colour.
#[derive(Debug)]
pub(crate) struct ConstraintGraph {
    /// The colours, the overflow, and what is solved directly.
    colours: Vec<Colour>,
    /// Which of them have contacts.
    used: Used,
    /// By index of a contact: where it is; shorter where no later contact was ever in the graph.
    homes: Vec<Option<GraphIndex>>,
    /// How many contacts there are.
    len: usize,
    /// Slots of the bodies whose contacts are solved directly.
    direct: BitSet,
    /// How many of these there are.
    direct_count: usize,
    /// Scratch.
    row_marks: RowMarks,
}

clone_into_buffers!(ConstraintGraph {
    colours, used, homes, len, direct, direct_count
} scratch {
    row_marks
});

/// Which colours have contacts, the overflow and what is solved directly among them, one bit each.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Used(u32);

impl Used {
    fn set(&mut self, colour: usize, is_used: bool) {
        self.0 = self.0 & !(1 << colour) | u32::from(is_used) << colour;
    }

    fn has_overflow(self) -> bool {
        self.0 >> OVERFLOW & 1 != 0
    }

    /// Without what is solved directly.
    fn swept(self) -> Self {
        Self(self.0 & !(1 << DIRECT))
    }

    /// Without the overflow, in ascending order.
    #[inline(always)]
    fn colours(self) -> impl Iterator<Item = usize> {
        places_of(self.0 & !(1 << OVERFLOW))
    }
}

impl Default for ConstraintGraph {
    fn default() -> Self {
        Self {
            colours: vec![Colour::default(); DIRECT + 1],
            used: Used::default(),
            homes: Vec::new(),
            len: 0,
            direct: BitSet::default(),
            direct_count: 0,
            row_marks: RowMarks::default(),
        }
    }
}

impl ConstraintGraph {
    /// How many contacts there are.
    pub(crate) fn len(&self) -> usize {
        self.len
    }

    /// How many colours have contacts, and how many contacts overflow.
    pub(crate) fn occupancy(&self) -> (usize, usize) {
        (self.used.swept().colours().count(), self.colours[OVERFLOW].contacts.len())
    }

    /// How many contacts each colour has.
    pub(crate) fn sizes(&self) -> impl Iterator<Item = usize> {
        self.colours[..COLOURS].iter().map(|colour| colour.contacts.len())
    }

    /// The colours with their numbers, in the order in which they are solved: the overflow first, and last what is solved
    /// directly.
    fn in_order(&self) -> impl Iterator<Item = (u32, &Colour)> {
        let order = core::iter::once(OVERFLOW).chain(0..COLOURS).chain([DIRECT]);
        order.map(|number| (number as u32, &self.colours[number]))
    }

    /// The blocks, in the order in which they are solved.
    pub(crate) fn blocks(&self) -> impl Iterator<Item = (BlockIndex, &ContactBlock)> {
        self.in_order().flat_map(|(number, colour)| {
            let blocks = (0..).zip(colour.blocks.all().1);
            blocks.map(move |(block, of_colour)| (BlockIndex { colour: number, block }, of_colour))
        })
    }

    /// Where the contact with this index is; `None` where it is not in the graph.
    #[inline(always)]
    pub(crate) fn home(&self, index: u32) -> Option<GraphIndex> {
        self.homes.get(index as usize).copied().flatten()
    }

    /// Whether the contact with this index is in the graph, and swept over.
    pub(crate) fn sweeps(&self, index: u32) -> bool {
        self.home(index).is_some_and(|home| !home.is_solved_directly())
    }

    /// The colour of the contact with this index; `None` where it has none.
    pub(crate) fn colour_of(&self, index: u32) -> Option<u32> {
        self.home(index).map(|home| home.colour).filter(|&colour| colour < OVERFLOW as u32)
    }

    /// Whether the contact with this index is where it no longer belongs: it has got or lost points, or follows or not.
    #[inline(always)]
    pub(crate) fn is_misplaced(&self, index: u32, contact: &Contact) -> bool {
        let has_points = !contact.manifold.points().is_empty();
        match self.home(index) {
            None => has_points,
            Some(home) => {
                let kind = self.colours[home.colour as usize].kind_at(home.contact as usize);
                !has_points || kind != Kind::of(contact) as usize
            }
        }
    }

    /// How the contacts of the body in `slot` are solved.
    pub(crate) fn tier(&self, slot: u32) -> Tier {
        if self.is_direct(slot) { Tier::Direct } else { Tier::Swept }
    }

    /// Whether the contacts of the body in `slot` are solved directly.
    pub(crate) fn is_direct(&self, slot: u32) -> bool {
        self.direct.contains(slot)
    }

    /// Sets how the contacts of the body in `slot` are solved, those that enter from now on; returns whether that is new.
    pub(crate) fn set_tier(&mut self, slot: u32, tier: Tier) -> bool {
        let is_new = self.tier(slot) != tier;
        match tier {
            Tier::Direct if is_new => {
                self.direct.insert(slot);
                self.direct_count += 1;
            }
            Tier::Swept if is_new => {
                self.direct.remove(slot);
                self.direct_count -= 1;
            }
            _ => {}
        }
        is_new
    }

    /// Whether the contacts of any body are solved directly: of one that flies alone too, and has none.
    pub(crate) fn solves_directly(&self) -> bool {
        self.direct_count > 0
    }

    /// Enters the contact with this index, if it is not in the graph: into a colour, or to what is solved directly, if that
    /// holds for one of its bodies.
    pub(crate) fn enter(&mut self, contacts: &Contacts, bodies: &Bodies, index: u32) {
        if self.home(index).is_some() {
            return;
        }
        if self.homes.len() <= index as usize {
            self.homes.resize(contacts.greatest_index() as usize + 1, None);
        }
        let slots = contacts[index].slots;
        let moves = slots.map(|slot| bodies.is_dynamic(slot));
        let colour = if self.is_any_direct(slots) { DIRECT } else { self.free_colour(slots, moves) };
        let entered = &mut self.colours[colour];
        if colour < COLOURS {
            // For any body, so that none asks for memory when all else has settled.
            entered.bodies.make_room(bodies.motions.len());
            entered.contacts.make_room(contacts.greatest_index());
            for (slot, moves) in slots.into_iter().zip(moves) {
                if moves {
                    entered.bodies.insert(slot);
                }
            }
        }
        entered.push(colour as u32, index, Kind::of(&contacts[index]), &mut self.homes);
        self.used.set(colour, true);
        self.len += 1;
    }

    fn is_any_direct(&self, slots: [u32; 2]) -> bool {
        slots.into_iter().any(|slot| self.is_direct(slot))
    }

    /// A colour in which neither of two bodies is, of those that contacts move; else the overflow.
    fn free_colour(&self, slots: [u32; 2], [a_moves, b_moves]: [bool; 2]) -> usize {
        let is_free = |colour: &Colour| {
            !(a_moves && colour.bodies.contains(slots[0]) || b_moves && colour.bodies.contains(slots[1]))
        };
        let found = if a_moves && b_moves {
            self.colours[..FIRST_GROUND_COLOUR].iter().position(is_free)
        } else {
            self.colours[..COLOURS].iter().rposition(is_free)
        };
        found.unwrap_or(OVERFLOW)
    }

    /// Moves a contact of the graph to where those of its kind are.
    pub(crate) fn sort_in(&mut self, contacts: &Contacts, index: u32) {
        if let Some(home) = self.home(index) {
            let colour = &mut self.colours[home.colour as usize];
            colour.take(home, &mut self.homes);
            colour.push(home.colour, index, Kind::of(&contacts[index]), &mut self.homes);
        }
    }

    /// Moves the contact with this index, if it is in the graph, to where it is solved as its bodies are now. What the direct
    /// solve has found is forgotten: light bodies between heavy ones would be thrown about by the part of it that sweeps
    /// give back.
    pub(crate) fn rehome(&mut self, contacts: &mut Contacts, bodies: &Bodies, index: u32) {
        let Some(home) = self.home(index) else { return };
        let was_direct = home.block().is_solved_directly();
        if was_direct == self.is_any_direct(contacts[index].slots) {
            return;
        }
        self.leave(contacts, index);
        self.enter(contacts, bodies, index);
        if was_direct {
            for point in contacts[index].manifold.points_mut() {
                (point.normal_impulse, point.tangent_impulse, point.lasting_impulse) = (0.0, 0.0, 0.0);
            }
        }
    }

    /// Takes the contact with this index out of its colour, if it is in one.
    pub(crate) fn leave(&mut self, contacts: &Contacts, index: u32) {
        let Some(home) = self.home(index) else { return };
        let left = &mut self.colours[home.colour as usize];
        left.take(home, &mut self.homes);
        self.homes[index as usize] = None;
        // Fixed and kinematic bodies were never entered; taking them out does nothing.
        for slot in contacts[index].slots {
            left.bodies.remove(slot);
        }
        self.used.set(home.colour as usize, !left.is_empty());
        self.len -= 1;
    }

    /// The block at its place of the graph, and the rows of its bodies.
    #[inline(always)]
    pub(crate) fn block_at(&self, BlockIndex { colour, block }: BlockIndex) -> (&RowPairs, &ContactBlock) {
        self.colours[colour as usize].blocks.get(block as usize)
    }

    /// The same, to change the block.
    #[inline(always)]
    pub(crate) fn block_at_mut(&mut self, index: BlockIndex) -> (&RowPairs, &mut ContactBlock) {
        self.colours[index.colour as usize].blocks.get_mut(index.block as usize)
    }

    /// Index of the contact at a place of the graph.
    pub(crate) fn contact_at(&self, GraphIndex { colour, contact }: GraphIndex) -> u32 {
        self.colours[colour as usize].contacts[contact as usize]
    }

    /// The block of the contact at a place of the graph, the rows of its bodies, and its place there.
    #[inline(always)]
    pub(crate) fn block(&self, index: GraphIndex) -> (&RowPairs, &ContactBlock, usize) {
        let (rows, block) = self.block_at(index.block());
        (rows, block, index.place())
    }

    pub(crate) fn block_mut(&mut self, index: GraphIndex) -> (&mut ContactBlock, usize) {
        (self.block_at_mut(index.block()).1, index.place())
    }

    /// The constraint of the contact at a place of the graph.
    #[inline(always)]
    pub(crate) fn constraint(&self, at: GraphIndex) -> ContactConstraint<f32> {
        let (_, block, place) = self.block(at);
        block.load(place)
    }

    /// Whether the contact at a place of the graph bears load.
    #[inline(always)]
    pub(crate) fn is_loaded(&self, at: GraphIndex) -> bool {
        let (_, block, place) = self.block(at);
        block.is_loaded(place)
    }

    /// The rows of the bodies of the contact at a place of the graph.
    pub(crate) fn rows(&self, at: GraphIndex) -> [u32; 2] {
        let (rows, _, place) = self.block(at);
        rows.get(place)
    }

    /// The same, with the ground's in the place of a body that contacts do not move.
    pub(crate) fn moved_rows(&self, at: GraphIndex) -> [u32; 2] {
        let (rows, _, place) = self.block(at);
        let [[a, b], [a_moves, b_moves]] = [rows.get(place), rows.moves::<1>(place)];
        [(a, a_moves), (b, b_moves)].map(|(row, moves)| if moves != 0 { row } else { GROUND_ROW })
    }

    /// Gives the contact at a place of the graph the normal and the points of `constraint`.
    pub(crate) fn set_geometry(&mut self, at: GraphIndex, constraint: &ContactConstraint<f32>) {
        let (block, place) = self.block_mut(at);
        block.store_geometry(place, constraint);
    }

    /// Changes the impulses of a point of the contact at a place of the graph, N s, along normal and tangent.
    pub(crate) fn set_impulses(&mut self, at: GraphIndex, point: usize, impulses: [f32; 2]) {
        let (block, place) = self.block_mut(at);
        block.set_impulses(place, point, impulses);
    }

    /// Changes the moment of rolling resistance of the contact at a place of the graph, N m s.
    pub(crate) fn set_rolling_moment(&mut self, at: GraphIndex, moment: f32) {
        let (block, place) = self.block_mut(at);
        block.set_rolling_moment(place, moment);
    }

    /// Changes what the first point of the contact at a place of the graph bears, N s: its impulses along normal and
    /// tangent, and what the warm start after the move will apply along the normal.
    pub(crate) fn set_load(&mut self, at: GraphIndex, load: [f32; 3]) {
        let (block, place) = self.block_mut(at);
        block.set_load(place, load);
    }

    /// Says which points of the contact at a place of the graph are pending.
    pub(crate) fn set_pending(&mut self, at: GraphIndex, is_pending: [bool; 2]) {
        let (block, place) = self.block_mut(at);
        block.set_pending(place, is_pending);
    }

    /// Takes note that the bodies of the contact at a place of the graph are [tangled](crate::resolution::tangles).
    pub(crate) fn set_tangled(&mut self, at: GraphIndex) {
        let (block, place) = self.block_mut(at);
        block.set_tangled(place);
    }

    /// Whether they are.
    pub(crate) fn is_tangled(&self, at: GraphIndex) -> bool {
        let (_, block, place) = self.block(at);
        block.marks.tangled.get(place)
    }

    /// Which points of the contact at a place of the graph are pending.
    pub(crate) fn is_pending(&self, at: GraphIndex) -> [bool; 2] {
        let (_, block, place) = self.block(at);
        block.is_pending(place)
    }

    /// Gives up what the contacts in it do not need.
    pub(crate) fn trim(&mut self) {
        let count = self.homes.iter().rposition(Option::is_some).map_or(0, |last| last + 1);
        self.homes.truncate(count);
        self.direct.trim();
        self.row_marks = RowMarks::default();
        self.colours.iter_mut().for_each(Colour::trim);
    }

    /// Checks that every contact with a place is at that place, and no colour holds a movable body twice.
    pub(crate) fn validate(&self, contacts: &Contacts, bodies: &Bodies) -> Result<(), String> {
        let mut found = 0;
        let mut used = Used::default();
        self.colours.iter().enumerate().for_each(|(number, colour)| used.set(number, !colour.is_empty()));
        if used != self.used {
            return Err("the graph does not know which colours have contacts".into());
        }
        for (number, colour) in self.colours.iter().enumerate() {
            let mut seen = BitSet::default();
            for (place, &index) in colour.contacts.iter().enumerate() {
                found += 1;
                if self.is_any_direct(contacts[index].slots) != (number == DIRECT) {
                    return Err(format!("contact {index} is not solved as its bodies are"));
                }
                if self.home(index) != Some(GraphIndex { colour: number as u32, contact: place as u32 }) {
                    return Err(format!("contact {index} is not where the constraint graph holds it"));
                }
                for slot in contacts[index].slots {
                    if number < COLOURS && bodies.is_dynamic(slot) && !seen.insert(slot) {
                        return Err(format!("colour {number} holds body {slot} twice"));
                    }
                }
            }
        }
        if found == self.len() {
            Ok(())
        } else {
            Err(format!("the graph counts {} of {found} contacts", self.len()))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::{Body, Mixed};
    use crate::collision::{Manifold, ManifoldPoint};
    use crate::math::Vec2;
    use crate::shape::Shape;

    /// A fixed body in slot 0 and dynamic ones, with a contact of one point between each two of some slots.
    fn touching(count: u32, pairs: &[[u32; 2]]) -> (Bodies, Contacts, ConstraintGraph) {
        let (mut bodies, mut contacts) = (Bodies::default(), Contacts::default());
        let shape = Shape::circle(1.0);
        bodies.insert(&Body::fixed(shape));
        for _ in 1..count {
            bodies.insert(&Body::dynamic(shape));
        }
        let mut graph = ConstraintGraph::default();
        for &slots in pairs {
            let index = contacts.begin(&mut bodies, slots, Mixed::default());
            contacts[index].manifold = Manifold::of_one(Vec2::new(0.0, 1.0), ManifoldPoint::default());
            graph.enter(&contacts, &bodies, index);
        }
        (bodies, contacts, graph)
    }

    #[test]
    fn a_chain_takes_two_colours_and_contacts_with_the_ground_the_last() {
        let (bodies, contacts, graph) = touching(5, &[[1, 2], [2, 3], [3, 4], [0, 1], [0, 4]]);
        graph.validate(&contacts, &bodies).unwrap();
        let colours = [0, 1, 2, 3, 4].map(|index| graph.colour_of(index));
        let last = COLOURS as u32 - 1;
        assert_eq!(colours, [Some(0), Some(1), Some(0), Some(last), Some(last)]);
    }

    #[test]
    fn the_contacts_of_a_crowded_body_overflow_and_come_back_to_colours_that_are_free_again() {
        let pairs: Vec<[u32; 2]> = (2..32).map(|other| [1, other]).collect();
        let (bodies, contacts, mut graph) = touching(32, &pairs);
        graph.validate(&contacts, &bodies).unwrap();
        assert_eq!(graph.occupancy(), (FIRST_GROUND_COLOUR, 30 - FIRST_GROUND_COLOUR));
        for index in 0..5 {
            graph.leave(&contacts, index);
        }
        graph.enter(&contacts, &bodies, 2);
        graph.validate(&contacts, &bodies).unwrap();
        assert_eq!((graph.len(), graph.colour_of(2), graph.home(3)), (26, Some(0), None));
    }

    #[test]
    fn what_follows_or_gets_a_second_point_is_sorted_in_anew() {
        let (bodies, mut contacts, mut graph) = touching(9, &[[1, 2], [3, 4], [5, 6], [7, 8]]);
        contacts[1].follows = true;
        let point = ManifoldPoint::default();
        contacts[2].manifold = Manifold::of_two(Vec2::new(0.0, 1.0), point, point);
        for index in [1, 2] {
            assert!(graph.is_misplaced(index, &contacts[index]));
            graph.sort_in(&contacts, index);
            assert!(!graph.is_misplaced(index, &contacts[index]));
        }
        graph.validate(&contacts, &bodies).unwrap();
        let order: Vec<u32> = graph.colours[0].contacts.to_vec();
        assert_eq!((order[2], order[3]), (1, 2), "single, single moving, double: {order:?}");
    }

    #[test]
    fn what_a_direct_body_touches_has_no_colour_and_moves_over_without_its_impulses() {
        let (bodies, mut contacts, mut graph) = touching(4, &[[1, 2], [2, 3]]);
        assert!(graph.set_tier(2, Tier::Direct) && !graph.set_tier(2, Tier::Direct));
        contacts[0].manifold.points_mut()[0].normal_impulse = 1.0;
        graph.rehome(&mut contacts, &bodies, 0);
        graph.rehome(&mut contacts, &bodies, 1);
        graph.validate(&contacts, &bodies).unwrap();
        assert_eq!((graph.colour_of(0), graph.occupancy()), (None, (0, 0)));
        assert!(contacts[0].is_loaded());
        graph.set_tier(2, Tier::Swept);
        graph.rehome(&mut contacts, &bodies, 0);
        assert_eq!(graph.colour_of(0), Some(0));
        assert!(!contacts[0].is_loaded());
    }
}
