//! Blows: what contacts give their bodies over a whole step, where somebody asks.
//!
//! A contact keeps the impulses of its last substep, from which the next one starts. What it has done over the step is the sum
//! of those of all substeps, and of the collisions that happened at times of their own within them. Over all contacts of a
//! body these sums are what its momentum has changed by, but for forces.
//!
//! A blow that begins in the last substep of a step goes on in the next: what is about to meet is slowed down to reach the
//! surface, and stopped there. It is told when it is over, also if the bodies have parted or one was removed since.
//!
//! Runs three times per substep, before the bodies move, after it and at the end, on the blocks with a contact that is asked about: one
//! whose bodies approach as fast as a hit, or collide, or all of them, if the settings say so. Nothing where there is none.

use crate::body::{BodyId, ColliderId};
use crate::collision::{Contact, Contacts};
use crate::compute::{self, COLUMN, Column, Columns, Job, Lane, LaneVec2, Width, columns};
use crate::math::{Point, Vec2};
use crate::resolution::constraint_graph::{BlockIndex, ConstraintGraph, GraphIndex};
use crate::store::Key;

/// What bodies met with, at a time within the step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Collision {
    /// Speed of approach, m/s.
    pub(crate) speed: f32,
    /// Where they met.
    pub(crate) point: Point,
    /// From a to b.
    pub(crate) normal: Vec2,
    /// Impulse on b, and its opposite on a, N s.
    pub(crate) on_b: Vec2,
}

/// A collision of two bodies that have a contact.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Impact {
    /// Index of the contact.
    pub(crate) contact: u32,
    pub(crate) collision: Collision,
}

/// What a contact has done to its bodies over a step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Blow {
    /// Index of the contact.
    pub(crate) contact: u32,
    /// Impulse on b, and its opposite on a, N s.
    pub(crate) on_b: Vec2,
    /// By point: the part of it along the normal that substeps and seams have brought, N s.
    pub(crate) by_point: [f32; 2],
    /// What it would be along the normal if the contact had borne in each substep what it bore in the last before, N s: what
    /// touched already is told from a blow by it, if impulses are summed up of all.
    pub(crate) load_before: f32,
    /// The first of the collisions, if there was one.
    pub(crate) first: Option<Collision>,
    /// What the step before has left of it to this one, if it has.
    pub(crate) begun: Option<Begun>,
}

/// A blow that was not over as its step ended.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Begun {
    /// Of the contact: there may be another one in its place by now.
    pub(crate) contact: Key,
    /// They are told also if one of the bodies is gone.
    pub(crate) ids: Ids,
    pub(crate) so_far: Collision,
}

/// The bodies of a contact, and their shapes that touch.
pub(crate) type Ids = ([BodyId; 2], [ColliderId; 2]);

/// Sums of a block of contacts over the substeps so far.
#[derive(Clone, Copy, Debug, Default)]
struct Sums<C> {
    /// Impulse on b, N s.
    on_b: LaneVec2<C>,
    /// By point, along the normal, N s.
    by_point: [C; 2],
    /// See [`Blow`], N s.
    load_before: C,
}

columns!(Sums { on_b, by_point, load_before });

/// A block with contacts that are asked about.
#[derive(Clone, Debug)]
struct Summed {
    at: BlockIndex,
    /// Whether normals, or who bears what, may change as the bodies move.
    changes_in_move: bool,
    sums: Sums<Column>,
}

impl Summed {
    fn new(at: BlockIndex, graph: &ConstraintGraph) -> Self {
        let marks = graph.block_at(at).1.marks;
        // What the direct solve does before the move is taken back.
        let changes_in_move =
            (marks.moving_within_step().any() || marks.on_ground.any()) && !at.is_solved_directly();
        Self { at, changes_in_move, sums: Sums::default() }
    }
}

/// The stage and its buffers.
#[derive(Debug, Default)]
pub(crate) struct Blows {
    blocks: Vec<Summed>,
    /// Collisions of the step that are reported, in the order of time.
    impacts: Vec<Impact>,
    /// By index of a contact: further impulses on b at times of their own, N s.
    others: Vec<(u32, Vec2)>,
    /// Of the step, once it has ended: one for each contact that was asked about, by ascending index.
    of_step: Vec<Blow>,
    /// Those of the step before that were not over.
    begun: Vec<Begun>,
    /// Scratch: those of them whose contact has ended since.
    cut_off: Vec<Begun>,
    /// Scratch: by index of the contact, the places of its parts.
    order: Vec<(u32, u32)>,
    /// Scratch.
    merged: Vec<Blow>,
}

// What the last step has done, and left to the next, is part of the state of a world.
clone_into_buffers!(Blows { of_step, begun } scratch { blocks, impacts, others, cut_off, order, merged });

impl Blows {
    /// Forgets the last step.
    pub(crate) fn clear(&mut self) {
        self.blocks.clear();
        self.impacts.clear();
        self.others.clear();
        self.of_step.clear();
        self.cut_off.clear();
    }

    /// Takes up a block with a contact that is asked about, as a step of so many substeps begins.
    pub(crate) fn take_up_block(&mut self, at: BlockIndex, graph: &ConstraintGraph, substeps: u32) {
        let (_, block) = graph.block_at(at);
        let mut summed = Summed::new(at, graph);
        for place in 0..COLUMN {
            let [first, second] = block.load::<f32>(place).points.map(|point| point.normal_impulse);
            summed.sums.load_before.set(place, (first + second) * substeps as f32);
        }
        self.blocks.push(summed);
    }

    /// Takes up the contacts whose blows were not over as the last step ended.
    pub(crate) fn take_up_unfinished(&mut self, contacts: &Contacts, graph: &mut ConstraintGraph) {
        for place in 0..self.begun.len() {
            let contact = self.begun[place].contact;
            if let Some(home) = graph.home(contact.index()).filter(|_| contacts.has(contact)) {
                self.ask_about(home, graph);
            }
        }
    }

    /// Asks about a contact from now on.
    fn ask_about(&mut self, home: GraphIndex, graph: &mut ConstraintGraph) {
        let (block, place) = graph.block_mut(home);
        let is_new = !block.marks.asked.any();
        block.marks.asked.put(place, true);
        if is_new {
            self.blocks.push(Summed::new(home.block(), graph));
        }
    }

    /// Takes note of a collision of two bodies with a contact. If that was not touching, it is asked about from now on, at its
    /// place of the graph.
    pub(crate) fn note(&mut self, impact: Impact, asked: Option<GraphIndex>, graph: &mut ConstraintGraph) {
        self.impacts.push(impact);
        if let Some(home) = asked {
            self.ask_about(home, graph);
        }
    }

    /// Takes note of a collision of two bodies that have got their contact only now.
    pub(crate) fn note_late(&mut self, impact: Impact) {
        self.impacts.push(impact);
    }

    /// Takes note of an impulse on b, N s, that is no impact, of a contact at a place of the graph.
    pub(crate) fn note_other(&mut self, home: GraphIndex, on_b: Vec2, graph: &ConstraintGraph) {
        let (_, block, place) = graph.block(home);
        if block.marks.asked.get(place) {
            self.others.push((graph.contact_at(home), on_b));
        }
    }

    /// The collisions of the step that are reported, in the order of time.
    pub(crate) fn impacts(&self) -> &[Impact] {
        &self.impacts
    }

    /// Adds what has acted before the bodies move, along the normals of then: all impulses along them, and this `part` of those
    /// along the tangents.
    pub(crate) fn begin_move(&mut self, graph: &ConstraintGraph, part: f32, width: Width) {
        self.add_up(AddUp { graph, signs: [1.0, part], when: When::InMove }, width);
    }

    /// Subtracts the same impulses along the normals of after the move, as the end of the substep adds them along these; of contacts that have
    /// forgotten theirs in the move, nothing.
    pub(crate) fn end_move(&mut self, graph: &ConstraintGraph, part: f32, width: Width) {
        self.add_up(AddUp { graph, signs: [-1.0, -part], when: When::InMove }, width);
    }

    /// Adds the impulses of a substep that has ended.
    pub(crate) fn end_substep(&mut self, graph: &ConstraintGraph, width: Width) {
        self.add_up(AddUp { graph, signs: [1.0; 2], when: When::AtTheEnd }, width);
    }

    fn add_up(&mut self, add_up: AddUp<'_>, width: Width) {
        if !self.blocks.is_empty() {
            compute::run(width, AddUpAll { blocks: &mut self.blocks, add_up });
        }
    }

    /// Takes the sums of the blocks, as the last substep has ended.
    pub(crate) fn end_substeps(&mut self, graph: &ConstraintGraph) {
        for Summed { at, sums, .. } in &self.blocks {
            graph.block_at(*at).1.marks.asked.for_each(|place| {
                let of_contact = sums.load::<f32>(place);
                self.of_step.push(Blow {
                    contact: graph.contact_at(at.contact(place)),
                    on_b: of_contact.on_b.to_vec2(),
                    by_point: of_contact.by_point,
                    load_before: of_contact.load_before,
                    first: None,
                    begun: None,
                });
            });
        }
    }

    /// Adds the collisions of contacts that were not touching, or whose blow was not over, or of all, and what the step before has left, as the
    /// step has ended.
    pub(crate) fn end_step(&mut self, contacts: &Contacts, all: bool) {
        let Self { impacts, others, of_step, begun, cut_off, .. } = self;
        let new = |contact| Blow {
            contact,
            on_b: Vec2::ZERO,
            by_point: [0.0; 2],
            load_before: 0.0,
            first: None,
            begun: None,
        };
        // Those of one contact in the order of time, after the sums of its substeps.
        cut_off.extend(begun.extract_if(.., |begun| !contacts.has(begun.contact)));
        let goes_on =
            |contact: u32| begun.binary_search_by_key(&contact, |begun| begun.contact.index()).is_ok();
        let is_asked = |contact: u32| all || !contacts[contact].is_touching || goes_on(contact);
        let asked = impacts.iter().filter(|impact| is_asked(impact.contact));
        of_step.extend(asked.map(|&Impact { contact, collision }| Blow {
            on_b: collision.on_b,
            first: Some(collision),
            ..new(contact)
        }));
        // Of circles, which press with one point: its share is the whole, whatever it is measured by.
        of_step.extend(others.iter().map(|&(contact, on_b)| Blow {
            on_b,
            by_point: [on_b.norm_1(), 0.0],
            ..new(contact)
        }));
        of_step
            .extend(begun.drain(..).map(|begun| Blow { begun: Some(begun), ..new(begun.contact.index()) }));
        if of_step.is_empty() {
            return;
        }
        let order = &mut self.order;
        order.clear();
        order.extend((0..).zip(of_step.iter()).map(|(place, blow): (u32, &Blow)| (blow.contact, place)));
        order.sort_unstable();
        let merged = &mut self.merged;
        merged.clear();
        for &(contact, place) in &*order {
            let part = of_step[place as usize];
            match merged.last_mut() {
                Some(blow) if blow.contact == contact => blow.add(&part),
                _ => merged.push(part),
            }
        }
        core::mem::swap(of_step, merged);
    }

    /// Leaves a blow that is not over to the next step. They are left by ascending index of their contacts.
    pub(crate) fn leave(&mut self, blow: Begun) {
        debug_assert!(self.begun.last().is_none_or(|last| last.contact.index() < blow.contact.index()));
        self.begun.push(blow);
    }

    /// Of how many parts the blows of the step are known, before it ends.
    pub(crate) fn parts(&self) -> usize {
        self.impacts.len() + self.of_step.len() + self.begun.len()
    }

    /// The blows that the step before has left, and whose contact has ended since.
    pub(crate) fn cut_off(&self) -> &[Begun] {
        &self.cut_off
    }

    /// What the contacts that were asked about have done over the step, by ascending index.
    pub(crate) fn of_step(&self) -> &[Blow] {
        &self.of_step
    }

    /// What a contact has done over the last step, if it was asked about.
    pub(crate) fn of_contact(&self, contact: u32) -> Option<&Blow> {
        let place = self.of_step.binary_search_by_key(&contact, |blow| blow.contact).ok()?;
        Some(&self.of_step[place])
    }
}

impl Blow {
    /// Adds what else the same contact has done: its collisions in the order of time, then what the step before has left.
    fn add(&mut self, part: &Self) {
        self.on_b += part.on_b;
        for (sum, of_point) in self.by_point.iter_mut().zip(part.by_point) {
            *sum += of_point;
        }
        self.load_before += part.load_before;
        self.first = self.first.or(part.first);
        self.begun = self.begun.or(part.begun);
    }

    /// Whether substeps or seams have pressed the bodies together.
    pub(crate) fn has_pressed(&self) -> bool {
        self.by_point != [0.0; 2]
    }

    /// All of it, with what the step before has left, of a contact between bodies of which a has this centre now.
    pub(crate) fn whole(&self, contact: &Contact, center_a: Point) -> Collision {
        let begun = self.begun.map(|begun| begun.so_far);
        let on_b = begun.map_or(self.on_b, |begun| begun.on_b + self.on_b);
        let speed = begun.map_or(contact.approach_speed, |begun| begun.speed);
        match begun {
            Some(begun) if self.first.is_none() && !self.has_pressed() => Collision { on_b, ..begun },
            _ => {
                Collision { speed, point: self.point(contact, center_a), normal: self.normal(contact), on_b }
            }
        }
    }

    /// From a to b: as they met first, or as they touch in the end.
    pub(crate) fn normal(&self, contact: &Contact) -> Vec2 {
        self.first.map_or(contact.manifold.normal, |first| first.normal)
    }

    /// Where the blow was given: where they met first, or the middle of what pressed, from the centre of a as it is now.
    fn point(&self, contact: &Contact, center_a: Point) -> Point {
        if let Some(first) = self.first {
            return first.point;
        }
        let points = contact.manifold.points();
        let sum: f32 = self.by_point.iter().sum();
        // Of what has pressed nowhere, all points.
        let share =
            |index: usize| if sum > 0.0 { self.by_point[index] / sum } else { 1.0 / points.len() as f32 };
        let anchors = points.iter().enumerate().map(|(index, point)| point.anchor_a * share(index));
        center_a + anchors.fold(Vec2::ZERO, |sum, anchor| sum + anchor)
    }
}

/// Which blocks impulses are added up of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum When {
    /// Those that change as the bodies move.
    InMove,
    /// All, at the end of a substep.
    AtTheEnd,
}

/// Adds the impulses that contacts have now, times signs or parts: of those along the normal, and along the tangent.
#[derive(Clone, Copy, Debug)]
struct AddUp<'a> {
    graph: &'a ConstraintGraph,
    signs: [f32; 2],
    when: When,
}

struct AddUpAll<'a> {
    blocks: &'a mut [Summed],
    add_up: AddUp<'a>,
}

impl Job for AddUpAll<'_> {
    #[inline(always)]
    fn run<L: Lane>(self) {
        let AddUp { graph, signs, when } = self.add_up;
        for Summed { at, changes_in_move, sums } in self.blocks {
            if when == When::InMove && !*changes_in_move {
                continue;
            }
            let (_, block) = graph.block_at(*at);
            for place in (0..COLUMN).step_by(L::WIDTH) {
                let constraint = block.load::<L>(place);
                let mut sum = sums.load::<L>(place);
                let [normal, tangent] = signs.map(L::splat);
                let [normal, tangent] = [constraint.normal * normal, constraint.normal.perp() * tangent];
                for (index, point) in constraint.points.iter().enumerate() {
                    let friction = tangent * constraint.frictions[index].impulse;
                    sum.on_b = sum.on_b + (normal * point.normal_impulse + friction);
                    if when == When::AtTheEnd {
                        sum.by_point[index] = sum.by_point[index] + point.normal_impulse;
                    }
                }
                sums.store::<L>(place, sum);
            }
        }
    }
}
