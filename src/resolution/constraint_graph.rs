//! The constraint graph: contacts sorted into colours, so that no two of one colour share a body that the
//! solver moves.
//!
//! Contacts of one colour can be solved in any order, or at once in lanes, with the same result. Colours are
//! kept across steps: a contact enters one when it gets points and leaves it when it loses them, greedily
//! (E. Catto, "Simulation Islands", 2023). Contacts with the ground take the last colours: solved last, they
//! have the last word, and the ground gives no way.

use crate::body::Bodies;
use crate::collision::Contacts;
use crate::compute::Lane;
use crate::resolution::constraint::ContactConstraint;
use crate::store::BitSet;

/// How many colours there are. A body can be in one contact per colour; the few contacts of a very crowded
/// body overflow.
const COLOURS: usize = 24;

/// Colours from here on are for contacts with the ground only, so that they find room.
const FIRST_GROUND_COLOUR: usize = 18;

/// The place of contacts that found no colour: solved one after the other, before all colours.
const OVERFLOW: usize = COLOURS;

/// Contacts that share no movable body.
#[derive(Clone, Debug, Default)]
pub(crate) struct Colour<L: Lane> {
    /// Slots of the movable bodies in it.
    bodies: BitSet,
    /// Indices of the contacts in it.
    pub(crate) contacts: Vec<u32>,
    /// The contacts as the solver sees them during a step, `L::WIDTH` to one.
    pub(crate) constraints: Vec<ContactConstraint<L>>,
}

/// All contacts with points, by colour.
#[derive(Clone, Debug)]
pub(crate) struct ConstraintGraph {
    /// The colours, then the overflow.
    colours: Vec<Colour<f32>>,
    len: usize,
}

impl Default for ConstraintGraph {
    fn default() -> Self {
        Self { colours: vec![Colour::default(); COLOURS + 1], len: 0 }
    }
}

impl ConstraintGraph {
    /// How many contacts there are.
    pub(crate) fn len(&self) -> usize {
        self.len
    }

    /// How many colours have contacts, and how many contacts overflow.
    pub(crate) fn occupancy(&self) -> (usize, usize) {
        let used = self.colours[..COLOURS].iter().filter(|colour| !colour.contacts.is_empty()).count();
        (used, self.colours[OVERFLOW].contacts.len())
    }

    /// The overflow, then the colours: the order in which they are solved.
    pub(crate) fn in_order(&mut self) -> impl Iterator<Item = &mut Colour<f32>> {
        let (colours, overflow) = self.colours.split_at_mut(COLOURS);
        overflow.iter_mut().chain(colours).filter(|colour| !colour.contacts.is_empty())
    }

    /// Indices of all contacts, in the order in which they are solved.
    pub(crate) fn contacts(&self) -> impl Iterator<Item = u32> {
        let (colours, overflow) = self.colours.split_at(COLOURS);
        overflow.iter().chain(colours).flat_map(|colour| colour.contacts.iter().copied())
    }

    /// Enters the contact with this index into a colour, if it is in none.
    pub(crate) fn enter(&mut self, contacts: &mut Contacts, bodies: &Bodies, index: u32) {
        if contacts[index].graph_place.is_some() {
            return;
        }
        let slots = contacts[index].slots;
        let [a_moves, b_moves] = slots.map(|slot| bodies.is_dynamic(slot));
        let is_free = |colour: &Colour<f32>| {
            !(a_moves && colour.bodies.contains(slots[0]) || b_moves && colour.bodies.contains(slots[1]))
        };
        let colour = if a_moves && b_moves {
            self.colours[..FIRST_GROUND_COLOUR].iter().position(is_free)
        } else {
            self.colours[..COLOURS].iter().rposition(is_free)
        }
        .unwrap_or(OVERFLOW);
        let entered = &mut self.colours[colour];
        if colour != OVERFLOW {
            for (slot, moves) in slots.into_iter().zip([a_moves, b_moves]) {
                if moves {
                    entered.bodies.insert(slot);
                }
            }
        }
        contacts[index].graph_place = Some((colour as u32, entered.contacts.len() as u32));
        entered.contacts.push(index);
        self.len += 1;
    }

    /// Takes the contact with this index out of its colour, if it is in one.
    pub(crate) fn leave(&mut self, contacts: &mut Contacts, index: u32) {
        let Some((colour, place)) = contacts[index].graph_place.take() else { return };
        let left = &mut self.colours[colour as usize];
        left.contacts.swap_remove(place as usize);
        if let Some(&moved) = left.contacts.get(place as usize) {
            contacts[moved].graph_place = Some((colour, place));
        }
        if colour as usize != OVERFLOW {
            // Fixed and kinematic bodies were never entered; taking them out does nothing.
            for slot in contacts[index].slots {
                left.bodies.remove(slot);
            }
        }
        self.len -= 1;
    }

    /// Makes the constraints of a step from the contacts; stored impulses are multiplied by `scale`.
    pub(crate) fn prepare(&mut self, contacts: &Contacts, bodies: &Bodies, scale: f32) {
        for colour in self.in_order() {
            colour.constraints.clear();
            for lane in colour.contacts.chunks(<f32 as Lane>::WIDTH) {
                let mut constraint = ContactConstraint::default();
                for (place, &index) in lane.iter().enumerate() {
                    constraint.set(place, &contacts[index], bodies, scale);
                }
                colour.constraints.push(constraint);
            }
        }
    }

    /// The constraint of the contact at a place of the graph.
    pub(crate) fn constraint(&self, (colour, place): (u32, u32)) -> &ContactConstraint<f32> {
        &self.colours[colour as usize].constraints[place as usize]
    }

    /// The constraint of the contact at a place of the graph, for changing it.
    pub(crate) fn constraint_mut(&mut self, (colour, place): (u32, u32)) -> &mut ContactConstraint<f32> {
        &mut self.colours[colour as usize].constraints[place as usize]
    }

    /// Checks that every contact with a place is at that place, and no colour holds a movable body twice.
    pub(crate) fn validate(&self, contacts: &Contacts, bodies: &Bodies) -> Result<(), String> {
        let mut found = 0;
        for (number, colour) in self.colours.iter().enumerate() {
            let mut seen = BitSet::default();
            for (place, &index) in colour.contacts.iter().enumerate() {
                found += 1;
                if contacts[index].graph_place != Some((number as u32, place as u32)) {
                    return Err(format!("contact {index} is not where the constraint graph holds it"));
                }
                for slot in contacts[index].slots {
                    if number != OVERFLOW && bodies.is_dynamic(slot) && !seen.insert(slot) {
                        return Err(format!("colour {number} holds body {slot} twice"));
                    }
                }
            }
        }
        if found == self.len {
            Ok(())
        } else {
            Err(format!("the graph counts {} of {found} contacts", self.len))
        }
    }
}
