use super::{BroadPhase, Home, MARGIN, MARGIN_OF_SIDE, SIDES_AHEAD, STEPS_AHEAD, STEPS_AHEAD_ALONE, TOO_BIG};
use crate::compute::ThreadPool;
use crate::math::{Aabb, Point, Vec2};
use crate::testing::Random;

#[derive(Clone, Copy)]
struct Mover {
    tight: Aabb,
    /// m per step.
    motion: Vec2,
    movable: bool,
}

/// A world of boxes and nothing else, whose contacts end when the fat boxes part.
#[derive(Default)]
struct Boxes {
    broad_phase: BroadPhase,
    movers: Vec<Option<Mover>>,
    contacts: Vec<(u32, u32)>,
}

impl Boxes {
    fn add(&mut self, body: u32, mover: Mover) {
        if self.movers.len() <= body as usize {
            self.movers.resize(body as usize + 1, None);
        }
        self.broad_phase.add(body, mover.movable, mover.tight);
        self.movers[body as usize] = Some(mover);
    }

    fn remove(&mut self, body: u32) {
        self.movers[body as usize] = None;
        self.broad_phase.remove(body);
        self.end_contacts(|_, a, b| a != body && b != body);
    }

    fn end_contacts(&mut self, keep: impl Fn(&BroadPhase, u32, u32) -> bool) {
        let broad_phase = &mut self.broad_phase;
        self.contacts.retain(|&(a, b)| {
            let kept = keep(broad_phase, a, b);
            if !kept {
                broad_phase.forget_pair(a, b);
            }
            kept
        });
    }

    /// Moves everything by its motion and returns the pairs found.
    fn step(&mut self, random: &mut Random) -> Vec<(u32, u32)> {
        for (body, mover) in self.movers.iter_mut().enumerate() {
            let Some(mover) = mover else { continue };
            if !mover.movable {
                continue;
            }
            if random.below(10) == 0 {
                mover.motion = Vec2::new(random.between(-0.3, 0.3), random.between(-0.3, 0.3));
            }
            mover.tight = Aabb::new(mover.tight.min + mover.motion, mover.tight.max + mover.motion);
            self.broad_phase.update(body as u32, mover.tight, mover.motion);
            assert!(self.broad_phase.fat_aabb(body as u32).contains(mover.tight.swept(mover.motion)));
        }
        self.end_contacts(BroadPhase::overlap);
        let mut found = vec![];
        self.broad_phase.find_pairs(&ThreadPool::default(), |_, _| true, &mut found);
        self.contacts.extend(&found);
        found
    }

    /// Every pair that has to have a contact, from a look at all of them.
    fn expected(&self) -> Vec<(u32, u32)> {
        let mut pairs = vec![];
        for (a, mover_a) in self.movers.iter().enumerate() {
            for (b, mover_b) in self.movers.iter().enumerate().skip(a + 1) {
                let (Some(mover_a), Some(mover_b)) = (mover_a, mover_b) else { continue };
                let (a, b) = (a as u32, b as u32);
                if (mover_a.movable || mover_b.movable) && self.broad_phase.overlap(a, b) {
                    pairs.push((a, b));
                }
            }
        }
        pairs
    }
}

fn random_mover(random: &mut Random) -> Mover {
    let min = Vec2::new(random.between(-12.0, 12.0), random.between(-12.0, 12.0));
    let size = Vec2::new(random.between(0.1, 1.5), random.between(0.1, 1.5));
    Mover { tight: Aabb::new(min, min + size), motion: Vec2::ZERO, movable: random.below(4) != 0 }
}

fn run(seed: u64, steps: u32, check: bool) -> Vec<(u32, u32)> {
    let mut random = Random(seed);
    let mut boxes = Boxes::default();
    let mut history = vec![];
    for body in 0..150 {
        boxes.add(body, random_mover(&mut random));
    }
    for _ in 0..steps {
        for _ in 0..random.below(6) {
            let body = random.below(170);
            if boxes.movers.get(body as usize).is_some_and(Option::is_some) {
                boxes.remove(body);
            }
            // Half the time under the same number at once, even moved and taken out in the same step.
            if boxes.movers.get(body as usize).is_none_or(Option::is_none) && random.below(2) == 0 {
                boxes.add(body, random_mover(&mut random));
            }
        }
        let found = boxes.step(&mut random);
        history.extend(&found);
        if check {
            assert!(found.is_sorted_by(|x, y| x < y), "ascending and none twice");
            boxes.broad_phase.validate().unwrap();
            let mut contacts = boxes.contacts.clone();
            contacts.sort_unstable();
            assert_eq!(contacts, boxes.expected());
        }
    }
    history
}

#[test]
fn contacts_are_those_a_look_at_all_pairs_finds_while_bodies_move_come_and_go() {
    for seed in 0..4 {
        assert!(run(seed, 150, true).len() > 1000);
    }
}

#[test]
fn the_same_calls_give_the_same_pairs_in_the_same_order() {
    assert_eq!(run(9, 120, false), run(9, 120, false));
}

fn square(x: f32, y: f32) -> Aabb {
    Aabb::new(Vec2::new(x, y), Vec2::new(x + 1.0, y + 1.0))
}

#[test]
fn two_moved_bodies_report_their_pair_once_and_a_known_pair_is_not_reported_again() {
    let mut broad_phase = BroadPhase::default();
    broad_phase.add(7, true, square(0.0, 0.0));
    broad_phase.add(3, true, square(0.5, 0.0));
    let mut out = vec![(1, 2)];
    broad_phase.find_pairs(&ThreadPool::default(), |_, _| true, &mut out);
    assert_eq!(out, [(1, 2), (3, 7)], "appended");
    assert_eq!(broad_phase.moved_count(), 0);
    for x in [2.0, 0.0] {
        broad_phase.update(7, square(x, 0.0), Vec2::ZERO);
    }
    broad_phase.find_pairs(&ThreadPool::default(), |_, _| true, &mut out);
    assert_eq!(out.len(), 2, "its contact has not ended");
    broad_phase.forget_pair(7, 3);
    broad_phase.mark_moved(3);
    broad_phase.find_pairs(&ThreadPool::default(), |_, _| true, &mut out);
    assert_eq!(out[2..], [(3, 7)]);
}

#[test]
fn two_fixed_bodies_make_no_pair_and_a_fixed_one_that_is_moved_finds_the_movable() {
    let mut broad_phase = BroadPhase::default();
    broad_phase.add(0, false, square(0.0, 0.0));
    broad_phase.add(1, false, square(0.5, 0.0));
    broad_phase.add(2, true, square(5.0, 0.0));
    let mut out = vec![];
    broad_phase.find_pairs(&ThreadPool::default(), |_, _| true, &mut out);
    assert_eq!(out, []);
    assert!(!broad_phase.update(0, square(0.0, 0.0), Vec2::ZERO));
    assert!(broad_phase.update(0, square(4.5, 0.0), Vec2::ZERO));
    broad_phase.find_pairs(&ThreadPool::default(), |_, _| true, &mut out);
    assert_eq!(out, [(0, 2)]);
}

#[test]
fn a_pair_that_is_refused_is_not_known_and_is_asked_for_again_when_one_of_it_moves() {
    let mut broad_phase = BroadPhase::default();
    broad_phase.add(0, true, square(0.0, 0.0));
    broad_phase.add(1, true, square(0.5, 0.0));
    let mut out = vec![];
    broad_phase.find_pairs(&ThreadPool::default(), |pair, _| pair != [0, 1], &mut out);
    assert_eq!(out, []);
    broad_phase.mark_moved(1);
    broad_phase.find_pairs(&ThreadPool::default(), |_, _| true, &mut out);
    assert_eq!(out, [(0, 1)]);
}

#[test]
fn a_body_taken_out_is_off_the_moved_list_and_makes_no_pair() {
    let mut broad_phase = BroadPhase::default();
    for body in 0..5 {
        broad_phase.add(body, true, square(0.2 * body as f32, 0.0));
    }
    broad_phase.remove(1);
    broad_phase.remove(4);
    assert_eq!(broad_phase.moved_count(), 3);
    broad_phase.validate().unwrap();
    let mut out = vec![];
    broad_phase.find_pairs(&ThreadPool::default(), |_, _| true, &mut out);
    assert_eq!(out, [(0, 2), (0, 3), (2, 3)]);
}

#[test]
fn a_body_at_rest_or_within_its_margin_is_left_alone() {
    let mut broad_phase = BroadPhase::default();
    broad_phase.add(0, true, square(0.0, 0.0));
    broad_phase.find_pairs(&ThreadPool::default(), |_, _| true, &mut vec![]);
    for offset in [0.0, 0.9 * MARGIN_OF_SIDE, -0.9 * MARGIN_OF_SIDE] {
        assert!(!broad_phase.update(0, square(offset, 0.0), Vec2::ZERO));
    }
    assert_eq!(broad_phase.moved_count(), 0);
    assert!(broad_phase.update(0, square(1.1 * MARGIN_OF_SIDE, 0.0), Vec2::ZERO));
    assert!(!broad_phase.update(0, square(1.1 * MARGIN_OF_SIDE, 0.0), Vec2::ZERO));
    assert_eq!(broad_phase.moved_count(), 1);
}

/// The box reaches `STEPS_AHEAD` motions ahead, and each check wants one motion ahead to be inside: a body at
/// constant speed leaves it every `STEPS_AHEAD` steps, later by what the margin holds.
#[test]
fn a_body_at_constant_speed_gets_a_new_box_only_every_fifth_step() {
    let mut broad_phase = BroadPhase::default();
    broad_phase.add(0, true, square(0.0, 0.0));
    let motion = Vec2::new(0.0, -0.5);
    let updates = (1..=100).filter(|&i| broad_phase.update(0, square(0.0, -0.5 * i as f32), motion)).count();
    assert_eq!(updates, 100 / STEPS_AHEAD as usize);
}

/// However slow it is, and though it slows down by 1 % per step.
#[test]
fn a_body_that_is_near_no_other_gets_one_only_every_ninth_step() {
    for first in [Vec2::new(0.0, -0.8), Vec2::new(0.3, 0.1), Vec2::new(1e-3, 0.0)] {
        let motion = |step: usize| first * 0.99_f32.powi(step as i32);
        let tight = |step: usize| {
            let gone = (0..step).fold(Vec2::ZERO, |gone, step| gone + motion(step));
            square(gone.x, gone.y)
        };
        let mut broad_phase = BroadPhase::default();
        broad_phase.add(0, true, tight(0));
        broad_phase.give_box(0, tight(0), first, true);
        let stays = |step: &usize| !broad_phase.leaves_box(0, tight(*step), motion(*step));
        assert!((0..100).take_while(stays).count() >= STEPS_AHEAD_ALONE as usize, "{first:?}");
    }
}

/// Its box holds the next step and no more, however fast it is, and what is on its way is asked about in each step until it is
/// taken, though the body stays in its box.
#[test]
fn a_body_that_moves_by_more_than_its_reach_ahead_is_looked_for_in_each_step() {
    let mut broad_phase = BroadPhase::default();
    broad_phase.add(0, true, square(0.0, 0.0));
    broad_phase.add(1, false, square(5.0, 0.0));
    for motion in [1.01 * SIDES_AHEAD, 1e3] {
        broad_phase.update(0, square(0.0, 0.0), Vec2::new(motion, 0.0));
        let margins = 2.0 * MARGIN_OF_SIDE;
        assert!(broad_phase.fat_aabb(0).size().x <= 1.0 + motion * 1.001 + margins, "{motion}");
        for _ in 0..3 {
            let mut out = vec![];
            broad_phase.find_pairs(
                &ThreadPool::default(),
                |pair, is_fast| {
                    assert_eq!((pair, is_fast), ([0, 1], [true, false]));
                    false
                },
                &mut out,
            );
            assert_eq!((out.len(), broad_phase.moved_count()), (0, 1), "{motion}");
            broad_phase.validate().unwrap();
        }
    }
    broad_phase.update(0, square(0.0, 0.0), Vec2::ZERO);
    broad_phase.find_pairs(&ThreadPool::default(), |_, is_fast| is_fast == [true; 2], &mut vec![]);
    assert_eq!(broad_phase.moved_count(), 0, "it is slow again");
}

#[test]
fn a_box_that_was_stretched_by_speed_shrinks_when_the_body_rests() {
    let mut broad_phase = BroadPhase::default();
    broad_phase.add(0, true, square(0.0, 0.0));
    broad_phase.update(0, square(0.0, 0.0), Vec2::new(1.5, 0.0));
    assert!(broad_phase.fat_aabb(0).size().x > STEPS_AHEAD * 1.5);
    let mut updates = 0;
    for i in 0..60 {
        updates += u32::from(broad_phase.update(0, square(0.0, 0.0), Vec2::new(1.5 * 0.8_f32.powi(i), 0.0)));
    }
    let at_rest = 4.0 * (1.0 + 2.0 * MARGIN_OF_SIDE);
    assert!(broad_phase.fat_aabb(0).perimeter() <= TOO_BIG * at_rest * 1.001);
    // From 8 m to 1: each new box has half the outline of the one before.
    assert!((1..=3).contains(&updates), "{updates}");
}

#[test]
fn a_body_whose_outline_moves_by_less_than_its_room_does_not_leave_its_box() {
    let mut random = Random(5);
    let mut with_room = 0;
    for _ in 0..20_000 {
        let mut broad_phase = BroadPhase::default();
        let far = [0.0, 1e3, 1e6][random.below(3) as usize];
        let corner = Vec2::new(far + random.between(-1.0, 1.0), random.between(-1.0, 1.0));
        let size = Vec2::new(random.between(0.01, 2.0), random.between(0.01, 2.0));
        broad_phase.add(0, true, Aabb::new(corner, corner + size));
        let stretch = random.between(0.0, 0.2);
        broad_phase.update(0, Aabb::new(corner, corner + size), Vec2::new(stretch, 0.0));
        let room = broad_phase.room(0, Aabb::new(corner, corner + size));
        with_room += u32::from(room > 0.0);
        // Each bound goes a way of its own, as far as the outline may, and the body is about to go the rest.
        let way = random.between(0.0, 1.0) * room.max(0.0);
        let mut moved = |place: Vec2| place + Vec2::new(random.between(-way, way), random.between(-way, way));
        let tight = Aabb::new(moved(corner), moved(corner + size));
        let ahead = room - way;
        let is_through = room <= 0.0 || !broad_phase.leaves_box(0, tight, Vec2::new(ahead, -ahead));
        assert!(is_through, "{corner:?} {size:?} {stretch} {room} {way}");
    }
    assert!((5_000..19_000).contains(&with_room), "{with_room}");
}

#[test]
fn the_margin_of_a_small_body_is_a_part_of_its_size() {
    let mut broad_phase = BroadPhase::default();
    let centimetre = Aabb::new(Vec2::ZERO, Vec2::splat(0.01));
    let house = Aabb::new(Vec2::ZERO, Vec2::splat(10.0));
    broad_phase.add(0, true, centimetre);
    broad_phase.add(1, true, house);
    broad_phase.add(2, false, centimetre);
    // The margin is on both sides; rounding of f32 at 0.01 is below 1e-9, at 10 below 1e-6.
    let with_margin = 0.01 * (1.0 + 2.0 * MARGIN_OF_SIDE);
    assert!((broad_phase.fat_aabb(0).size().x - with_margin).abs() < 1e-8);
    assert!((broad_phase.fat_aabb(1).size().x - (10.0 + 2.0 * MARGIN)).abs() < 2e-6);
    assert_eq!(broad_phase.fat_aabb(2), centimetre);
}

#[test]
fn queries_and_rays_see_both_trees() {
    let mut broad_phase = BroadPhase::default();
    for body in 0..20 {
        broad_phase.add(body, body % 2 == 0, square(3.0 * body as f32, 0.0));
    }
    let mut found = vec![];
    broad_phase.query(Aabb::new(Vec2::new(5.0, 0.0), Vec2::new(14.0, 0.5)), |body| {
        found.push(body);
        true
    });
    found.sort_unstable();
    assert_eq!(found, [2, 3, 4]);
    let mut visits = 0;
    broad_phase.query(Aabb::new(Vec2::ZERO, Vec2::splat(100.0)), |_| {
        visits += 1;
        visits < 12
    });
    assert_eq!(visits, 12);

    let (mut met, across) = (vec![], Vec2::new(60.0, 0.0));
    broad_phase.ray_cast(Point::new(-1.0, 0.5), across, 0.5, |body, end| {
        met.push(body);
        end
    });
    met.sort_unstable();
    assert_eq!(met, (0..10).collect::<Vec<_>>());
    // Clipped by body 1, which is fixed: of the movable ones only body 0 lies before it.
    met.clear();
    broad_phase.ray_cast(Point::new(-1.0, 0.5), across, 1.0, |body, end| {
        met.push(body);
        if body % 2 == 1 { end.min((3.0 * body as f32 + 1.0) / 60.0) } else { end }
    });
    assert_eq!(met, [1, 0]);
    let mut visits = 0;
    broad_phase.ray_cast(Point::new(-1.0, 0.5), across, 1.0, |_, _| {
        visits += 1;
        0.0
    });
    assert_eq!(visits, 1, "0 stops both trees");
}

#[test]
fn no_motion_makes_the_broad_phase_panic() {
    let odd = [0.0, 1e30, -1e30, f32::MAX, f32::INFINITY, f32::NAN, 1e-45];
    let mut random = Random(11);
    let mut pick = || odd[random.below(odd.len() as u32) as usize];
    let mut broad_phase = BroadPhase::default();
    for body in 0..30 {
        broad_phase.add(body, body % 3 != 0, Aabb::new(Vec2::splat(pick()), Vec2::splat(pick())));
    }
    let mut out = vec![];
    for i in 0..2000 {
        let tight = Aabb::new(Vec2::new(pick(), pick()), Vec2::new(pick(), pick()));
        broad_phase.update(i % 30, tight, Vec2::new(pick(), pick()));
        out.clear();
        broad_phase.find_pairs(&ThreadPool::default(), |_, _| true, &mut out);
        for &(a, b) in &out {
            broad_phase.forget_pair(a, b);
        }
    }
    assert!(matches!(broad_phase.proxies[0].home, Home::Fixed(_)));
}

/// A box of equal coordinates and a thousand in one place: every pair, once.
#[test]
fn bodies_that_all_lie_in_one_place_make_every_pair_once() {
    let mut broad_phase = BroadPhase::default();
    let point = Aabb::new(Vec2::splat(2.0), Vec2::splat(2.0));
    for body in 0..200 {
        broad_phase.add(body, true, point);
    }
    let mut out = vec![];
    broad_phase.find_pairs(&ThreadPool::default(), |_, _| true, &mut out);
    let expected: Vec<_> = (0..200).flat_map(|a| (a + 1..200).map(move |b| (a, b))).collect();
    assert_eq!(out, expected);
    broad_phase.validate().unwrap();
}

#[test]
fn the_buffers_of_a_settled_rhythm_do_not_grow() {
    let mut random = Random(12);
    let mut boxes = Boxes::default();
    for body in 0..100 {
        boxes.add(body, random_mover(&mut random));
    }
    let capacity = |boxes: &Boxes| (boxes.broad_phase.moved.capacity(), boxes.broad_phase.proxies.capacity());
    boxes.step(&mut random);
    let before = capacity(&boxes);
    for _ in 0..200 {
        boxes.step(&mut random);
    }
    assert_eq!(capacity(&boxes), before);
}
