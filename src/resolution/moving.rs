//! Manifolds within a step: where the bodies are now, and not where they were when the step began.
//!
//! A normal that stands still while a disc rolls on along a curve costs energy, as each step redirects the whole
//! velocity at once; a body that topples over a corner falls too late if its arm lags behind; a corner that has
//! swung on is not where a blow lands. So circles, and corners under load, follow the surface from substep to
//! substep, unless the bodies hardly move, and an impact finds its manifold at its own time.

use crate::body::Bodies;
use crate::collision::{Contact, Contacts, Manifold, detect_within};
use crate::compute::{BodyState, Column, Lane, PairStates, ThreadPool, Width};
use crate::math::{Rot, Vec2};
use crate::resolution::constraint::ContactConstraint;
use crate::resolution::constraint_graph::{ConstraintGraph, GraphIndex};
use crate::resolution::contact_block::ContactBlock;
use crate::resolution::kernel::Kernel;
use crate::resolution::moving_geometry::MovingGeometry;

/// Far enough that the nearest points of two bodies are found wherever they are, m.
const ANY_DISTANCE: f32 = 1e9;

/// The manifold of a contact with its bodies in the given states; empty where they cannot be told apart from
/// bodies that do not touch.
pub(crate) fn manifold_in(contact: &Contact, bodies: &Bodies, [a, b]: [&BodyState; 2]) -> Manifold {
    let [slot_a, slot_b] = contact.slots.map(|slot| slot as usize);
    let (pose_a, pose_b) = (bodies.motions[slot_a].pose, bodies.motions[slot_b].pose);
    let turned = |state: &BodyState, rotation: Rot| {
        Rot { c: state.delta_rotation.c, s: state.delta_rotation.s } * rotation
    };
    let offset = (pose_b.center - pose_a.center) + Vec2::from(b.delta_position - a.delta_position);
    let rotations = [turned(a, pose_a.rotation), turned(b, pose_b.rotation)];
    let shapes = [&bodies.shapes[slot_a], &bodies.shapes[slot_b]];
    detect_within(shapes[0], rotations[0], shapes[1], rotations[1], offset, ANY_DISTANCE).unwrap_or_default()
}

/// The constraint of a contact at a place of the graph with its bodies in the given states, and the separation of its first
/// point there, m; `None` where one of its points is gone.
pub(crate) fn constraint_in(
    contact: &Contact,
    home: GraphIndex,
    bodies: &Bodies,
    graph: &ConstraintGraph,
    [a, b]: &[BodyState; 2],
) -> Option<(ContactConstraint<f32>, f32)> {
    let manifold = manifold_in(contact, bodies, [a, b]).restricted_to(&contact.manifold)?;
    let mut constraint = graph.constraint(home);
    constraint.set_manifold_in(&manifold, a, b);
    Some((constraint, manifold.points()[0].separation))
}

/// Contacts that follow the surface within the step.
#[derive(Clone, Debug, Default)]
pub(crate) struct MovingContacts {
    /// Those of some blocks of the constraint graph that follow in closed form, by the index that their block has. Longer
    /// where there once were more.
    columns: Vec<MovingGeometry<Column>>,
    /// How many blocks may have some.
    block_count: usize,
    /// By index, and place in the graph: those whose manifold has to be found anew. Where they are left as the step began, card
    /// houses fall and piles do not come to rest.
    found_anew: Vec<(u32, GraphIndex)>,
}

impl MovingContacts {
    /// Makes room for those of so many blocks.
    pub(crate) fn reset(&mut self, block_count: usize) {
        self.block_count = block_count;
        self.columns.resize(self.columns.len().max(block_count), MovingGeometry::default());
        self.found_anew.clear();
    }

    /// By the index that their block gets: those that follow in closed form, to be taken up.
    pub(crate) fn columns_mut(&mut self) -> &mut [MovingGeometry<Column>] {
        &mut self.columns[..self.block_count]
    }

    /// Takes up the contact at a place of the graph, which follows the surface, but not in closed form.
    pub(crate) fn find_anew(&mut self, home: GraphIndex, graph: &ConstraintGraph) {
        self.found_anew.push((graph.contact_at(home), home));
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.block_count == 0
    }

    /// Brings the constraints up to where the bodies are now.
    pub(crate) fn follow(
        &self,
        pool: &ThreadPool,
        width: Width,
        contacts: &Contacts,
        bodies: &mut Bodies,
        graph: &mut ConstraintGraph,
    ) {
        for &(index, place) in &self.found_anew {
            let states = graph.rows(place).map(|row| bodies.states[row as usize]);
            if let Some((constraint, _)) = constraint_in(&contacts[index], place, bodies, graph, &states) {
                graph.set_geometry(place, &constraint);
            }
        }
        if !self.is_empty() {
            graph.for_each(pool, width, &mut bodies.states, &Follow { columns: &self.columns });
        }
    }
}

/// Brings the contacts of a block up to where their bodies are.
#[derive(Clone, Debug)]
struct Follow<'a> {
    /// Those that follow, by the index that their block has.
    columns: &'a [MovingGeometry<Column>],
}

impl Kernel for Follow<'_> {
    #[inline(always)]
    fn run<L: Lane>(&self, block: &mut ContactBlock, states: &mut PairStates<'_>, place: usize) {
        let Some(moving) = self.columns.get(block.moving as usize) else { return };
        if !moving.has_any::<L>(place) {
            return;
        }
        if block.fit().is_single {
            follow::<L, 1>(moving, block, states, place);
        } else {
            follow::<L, 2>(moving, block, states, place);
        }
    }
}

#[inline(always)]
fn follow<L: Lane, const POINTS: usize>(
    moving: &MovingGeometry<Column>,
    block: &mut ContactBlock,
    states: &PairStates<'_>,
    place: usize,
) {
    let [a, b] = states.gather::<L>(place);
    let (geometry, follows) = moving.load::<L>(place).geometry_in::<POINTS>(&a, &b);
    let before = block.load::<L>(place);
    let mut after = before;
    after.set_geometry_in::<POINTS>(&geometry, &a, &b);
    block.store_geometry(place, &before.with_geometry_where(follows, &after));
}
