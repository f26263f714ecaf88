use super::{Search, Tree};
use crate::math::{Aabb, Point, Reach, Vec2};
use crate::testing::Random;

fn random_aabb(random: &mut Random, extent: f32, largest: f32) -> Aabb {
    let min = Vec2::new(random.between(-extent, extent), random.between(-extent, extent));
    Aabb::new(min, min + Vec2::new(random.between(0.0, largest), random.between(0.0, largest)))
}

/// Leaves with the values from 0 on.
fn random_tree(random: &mut Random, count: u32, extent: f32, largest: f32) -> Tree {
    let mut tree = Tree::default();
    for value in 0..count {
        tree.insert(random_aabb(random, extent, largest), value);
    }
    tree
}

fn found(tree: &Tree, aabb: Aabb) -> Vec<u32> {
    let mut values = vec![];
    tree.query(aabb, |value| {
        values.push(value);
        true
    });
    values.sort_unstable();
    values
}

fn found_around(tree: &Tree, leaf: u32) -> Vec<u32> {
    let mut values = vec![];
    tree.search_around(leaf, &mut Search::new(), |value| values.push(value));
    values
}

fn found_by_ray(tree: &Tree, origin: Point, translation: Vec2, max_fraction: f32) -> Vec<u32> {
    let mut values = vec![];
    let end = tree.cast(origin, 0.0, translation, max_fraction, |value, end| {
        values.push(value);
        end
    });
    assert_eq!(end, max_fraction);
    values.sort_unstable();
    values
}

/// h <= 2.47·log₂ n + 4, derived in `balance`.
fn height_bound(leaves: usize) -> f32 {
    2.47 * (leaves as f32).log2() + 4.0
}

fn assert_sound(tree: &Tree) {
    tree.validate().unwrap();
    assert!(tree.len() < 2 || tree.height() as f32 <= height_bound(tree.len()));
}

#[test]
fn a_query_finds_what_a_look_at_every_box_finds_under_random_edits() {
    let mut random = Random(1);
    let mut tree = Tree::default();
    let mut boxes: Vec<(u32, u32, Aabb)> = vec![];
    for edit in 0..6000_u32 {
        // Grows to a few hundred leaves, then shrinks to none.
        let (insert_share, remove_share) = if edit < 3000 { (40, 20) } else { (20, 45) };
        let dice = random.below(100);
        let aabb = random_aabb(&mut random, 50.0, 6.0);
        if dice < insert_share || boxes.is_empty() {
            boxes.push((tree.insert(aabb, edit), edit, aabb));
        } else if dice < insert_share + remove_share {
            let (leaf, value, _) = boxes.swap_remove(random.below(boxes.len() as u32) as usize);
            assert_eq!(tree.remove(leaf), value);
        } else {
            let which = random.below(boxes.len() as u32) as usize;
            let is_short = random.below(2) == 0;
            let old = boxes[which].2;
            boxes[which].2 =
                if is_short { old.swept(Vec2::new(random.between(-0.5, 0.5), 0.2)) } else { aabb };
            tree.move_leaf(boxes[which].0, boxes[which].2);
        }
        assert_eq!(tree.len(), boxes.len());
        if edit % 100 == 0 {
            tree.trim();
        }
        if edit % 5 == 0 {
            assert_sound(&tree);
            let area = random_aabb(&mut random, 60.0, 30.0);
            let mut expected: Vec<u32> =
                boxes.iter().filter(|(_, _, aabb)| aabb.overlaps(area)).map(|&(_, value, _)| value).collect();
            expected.sort_unstable();
            assert_eq!(found(&tree, area), expected);
            if let Some(&(leaf, value, aabb)) = boxes.last() {
                let mut around = found_around(&tree, leaf);
                assert!(!around.contains(&value));
                around.push(value);
                around.sort_unstable();
                assert_eq!(around, found(&tree, aabb));
            }
        }
    }
    for (leaf, value, aabb) in boxes {
        assert_eq!((tree.value(leaf), tree.aabb(leaf)), (value, aabb));
        tree.remove(leaf);
        assert_sound(&tree);
    }
    assert_eq!((tree.len(), tree.height()), (0, 0));
}

/// More leaves than a search has room for, and more pairs of siblings at a time.
#[test]
fn a_search_around_a_box_that_meets_all_finds_each_once() {
    let mut tree = random_tree(&mut Random(3), 5000, 50.0, 1.0);
    let all = tree.insert(Aabb::new(Vec2::splat(-100.0), Vec2::splat(100.0)), 5000);
    let mut around = found_around(&tree, all);
    around.sort_unstable();
    assert!(around.into_iter().eq(0..5000));
}

/// How far, m, a segment and a box are apart by the separating axis theorem in f64; not above 0 if they touch.
fn separation(origin: Point, translation: Vec2, fraction: f32, aabb: Aabb) -> f64 {
    let reach =
        [f64::from(translation.x) * f64::from(fraction), f64::from(translation.y) * f64::from(fraction)];
    let length = (reach[0] * reach[0] + reach[1] * reach[1]).sqrt();
    let corners = [aabb.min.x, aabb.max.x]
        .map(|x| [aabb.min.y, aabb.max.y].map(|y| [f64::from(x) - origin.x, f64::from(y) - origin.y]));
    let corners = [corners[0][0], corners[0][1], corners[1][0], corners[1][1]];
    let mut apart = f64::NEG_INFINITY;
    for axis in [[1.0, 0.0], [0.0, 1.0], [-reach[1] / length, reach[0] / length]] {
        let along = |v: [f64; 2]| v[0] * axis[0] + v[1] * axis[1];
        let low = corners.iter().map(|&corner| along(corner)).fold(f64::INFINITY, f64::min);
        let high = corners.iter().map(|&corner| along(corner)).fold(f64::NEG_INFINITY, f64::max);
        let end = along(reach);
        apart = apart.max(low - end.max(0.0)).max(end.min(0.0) - high);
    }
    apart
}

#[test]
fn a_ray_meets_what_the_separating_axis_test_says_it_meets() {
    let mut random = Random(2);
    // Slack of the reference: f64 rounding at coordinates of the size of `far`, with a hundredfold reserve.
    for (far, slack) in [(0.0, 1e-11), (1e4, 1e-9), (1e7, 1e-7)] {
        let mut tree = Tree::default();
        let origin = Point::new(far, -0.7 * far);
        let boxes: Vec<Aabb> = (0..500)
            .map(|_| {
                let local = random_aabb(&mut random, 40.0, 5.0);
                Aabb::around(origin, local.min, local.max)
            })
            .collect();
        for (value, &aabb) in boxes.iter().enumerate() {
            tree.insert(aabb, value as u32);
        }
        for _ in 0..1000 {
            let from = origin + random_aabb(&mut random, 60.0, 0.0).min;
            let translation = random_aabb(&mut random, 60.0, 0.0).min;
            let fraction = random.between(0.1, 1.5);
            let met = found_by_ray(&tree, from, translation, fraction);
            for (value, &aabb) in boxes.iter().enumerate() {
                let apart = separation(from, translation, fraction, aabb);
                if apart.abs() > slack {
                    assert_eq!(met.binary_search(&(value as u32)).is_ok(), apart < 0.0, "{apart} at {far}");
                }
            }
        }
    }
}

#[test]
fn a_ray_that_only_grazes_a_border_or_ends_on_it_still_meets_the_box() {
    let mut tree = Tree::default();
    // Whole numbers, so that touching is exact: a grid of boxes from (3i, 3j) to (3i + 1, 3j + 1).
    for i in 0..20_u16 {
        for j in 0..20_u16 {
            let min = Vec2::new(f32::from(i) * 3.0, f32::from(j) * 3.0);
            tree.insert(Aabb::new(min, min + Vec2::splat(1.0)), u32::from(i) * 20 + u32::from(j));
        }
    }
    let row = |j: u32| (0..20).map(|i| i * 20 + j).collect::<Vec<_>>();
    // Along the lower and the upper border of row 2, both ways, and straight up at the left border of column 4.
    assert_eq!(found_by_ray(&tree, Point::new(-1.0, 6.0), Vec2::new(100.0, 0.0), 1.0), row(2));
    assert_eq!(found_by_ray(&tree, Point::new(99.0, 7.0), Vec2::new(-100.0, -0.0), 1.0), row(2));
    assert_eq!(
        found_by_ray(&tree, Point::new(12.0, -1.0), Vec2::new(0.0, 100.0), 1.0),
        (80..100).collect::<Vec<_>>()
    );
    assert_eq!(found_by_ray(&tree, Point::new(11.999_999, -1.0), Vec2::new(0.0, 100.0), 1.0), []);
    // Ends on a corner; touches corners in passing on a diagonal; is one point.
    assert_eq!(found_by_ray(&tree, Point::new(1.5, -4.5), Vec2::new(3.0, 9.0), 0.5), [20]);
    assert_eq!(found_by_ray(&tree, Point::new(-1.0, 2.0), Vec2::new(3.0, -3.0), 1.0), [0]);
    assert_eq!(found_by_ray(&tree, Point::new(4.0, 4.0), Vec2::ZERO, 1.0), [21]);
    assert_eq!(found_by_ray(&tree, Point::new(2.0, 2.0), Vec2::ZERO, 1.0), []);
}

#[test]
fn a_ray_far_from_the_origin_meets_the_box_around_every_place_on_its_way() {
    let mut random = Random(3);
    for far in [1e3, 1e6, 1e9, 1e12] {
        let origin = Point::new(far + 0.123_456_789, 0.3 - far);
        let translation = Vec2::new(random.between(-30.0, 30.0), random.between(-30.0, 30.0));
        let mut tree = Tree::default();
        for value in 0..200 {
            let place = origin + translation * random.between(0.0, 1.0);
            tree.insert(Aabb::around(place, Vec2::splat(-1e-3), Vec2::splat(1e-3)), value);
        }
        assert_eq!(found_by_ray(&tree, origin, translation, 1.0), (0..200).collect::<Vec<_>>(), "{far}");
    }
}

#[test]
fn a_ray_that_is_clipped_at_each_hit_ends_at_the_nearest_box() {
    let mut random = Random(4);
    let mut tree = Tree::default();
    let boxes: Vec<Aabb> = (0..400).map(|_| random_aabb(&mut random, 40.0, 2.0)).collect();
    for (value, &aabb) in boxes.iter().enumerate() {
        tree.insert(aabb, value as u32);
    }
    // Along x from outside, where the fraction of the entry is plain arithmetic.
    let mut visits = 0;
    for _ in 0..200 {
        let y = random.between(-40.0, 40.0);
        let enter = |aabb: Aabb| (aabb.min.x + 64.0) / 128.0;
        let nearest = boxes.iter().filter(|aabb| aabb.min.y <= y && y <= aabb.max.y).map(|&aabb| enter(aabb));
        let nearest = nearest.fold(1.0, f32::min);
        let end =
            tree.cast(Point::new(-64.0, f64::from(y)), 0.0, Vec2::new(128.0, 0.0), 1.0, |value, end| {
                visits += 1;
                end.min(enter(boxes[value as usize]))
            });
        assert_eq!(end, nearest);
    }
    // About 5 boxes lie on each such line; near to far, hardly more than one of them is looked at.
    assert!(visits < 200 * 3, "{visits}");
    let mut visits = 0;
    let end = tree.cast(Point::new(-50.0, -50.0), 0.0, Vec2::splat(100.0), 1.0, |_, _| {
        visits += 1;
        0.0
    });
    assert_eq!((end, visits), (0.0, 1));
}

#[test]
fn a_query_stops_when_the_visitor_says_so() {
    let mut tree = Tree::default();
    for value in 0..100 {
        tree.insert(Aabb::new(Vec2::ZERO, Vec2::splat(1.0)), value);
    }
    let mut visits = 0;
    let finished = tree.query(Aabb::new(Vec2::ZERO, Vec2::splat(1.0)), |_| {
        visits += 1;
        visits < 7
    });
    assert_eq!((finished, visits), (false, 7));
}

#[test]
fn height_stays_near_the_logarithm_for_random_and_for_sorted_boxes() {
    let mut random = Random(5);
    let count = 16_384;
    let line = |i: usize| Aabb::new(Vec2::new(i as f32, 0.0), Vec2::new(i as f32 + 1.2, 1.0));
    let row_of_128 = |i: usize| Vec2::new((i % 128) as f32, (i / 128) as f32);
    let grid = |i: usize| Aabb::new(row_of_128(i), row_of_128(i) + Vec2::splat(1.2));
    let scattered: Vec<Aabb> = (0..count).map(|_| random_aabb(&mut random, 100.0, 2.0)).collect();
    let orders: [(&str, Vec<Aabb>); 4] = [
        ("scattered", scattered),
        ("line", (0..count).map(line).collect()),
        ("line backward", (0..count).rev().map(line).collect()),
        ("grid row by row", (0..count).map(grid).collect()),
    ];
    for (name, boxes) in orders {
        let mut tree = Tree::default();
        for (value, &aabb) in boxes.iter().enumerate() {
            tree.insert(aabb, value as u32);
        }
        tree.validate().unwrap();
        // log₂ 16384 = 14; the perimeters alone, without any hostility, keep it well below the proven 38.
        assert!(tree.height() <= 24, "{name}: {}", tree.height());
    }
}

fn around_origin(half: f32) -> Aabb {
    Aabb::new(Vec2::splat(-half), Vec2::splat(half))
}

/// Without the bound on imbalance each of these makes a list, or nearly one.
#[test]
fn height_stays_in_its_proven_bound_for_hostile_boxes() {
    type Make = fn(u32) -> Aabb;
    let count = 5000;
    let orders: [(&str, Make); 5] = [
        ("growing", |i| around_origin(1.0 + i as f32)),
        ("shrinking", |i| around_origin(6000.0 - i as f32)),
        ("equal", |_| around_origin(1.0)),
        ("points", |_| around_origin(0.0)),
        ("each a tenth farther", |i| around_origin(0.5).swept(Vec2::new(1.1_f32.powi(i as i32 % 800), 0.0))),
    ];
    for (name, make) in orders {
        let mut tree = Tree::default();
        let leaves: Vec<u32> = (0..count).map(|i| tree.insert(make(i), i)).collect();
        assert!(tree.height() as f32 <= height_bound(tree.len()), "{name}: {}", tree.height());
        tree.validate().unwrap();
        assert_eq!(found(&tree, around_origin(1e30)).len(), count as usize, "{name}");
        // Taking out all but every 16th, in order, unbalances whole subtrees.
        for &leaf in leaves.iter().filter(|&&leaf| leaf % 16 != 0) {
            tree.remove(leaf);
        }
        assert_sound(&tree);
    }
}

#[test]
fn no_number_makes_the_tree_panic_or_lose_a_leaf() {
    let mut random = Random(6);
    let odd =
        [0.0, -0.0, 1.0, 1e30, -1e30, f32::MAX, f32::MIN, f32::MIN_POSITIVE, 1e-45, f32::INFINITY, f32::NAN];
    let mut tree = Tree::default();
    let mut leaves = vec![];
    let pick = |random: &mut Random| odd[random.below(odd.len() as u32) as usize];
    for edit in 0..4000_u32 {
        // Corners in any order: inverted boxes and boxes of no size are among them.
        let min = Vec2::new(pick(&mut random), pick(&mut random));
        let aabb = Aabb::new(min, Vec2::new(pick(&mut random), pick(&mut random)));
        match random.below(4) {
            0 | 1 => leaves.push((tree.insert(aabb, edit), edit)),
            2 if !leaves.is_empty() => {
                let (leaf, value) = leaves.swap_remove(random.below(leaves.len() as u32) as usize);
                assert_eq!(tree.remove(leaf), value);
            }
            _ if !leaves.is_empty() => {
                tree.move_leaf(leaves[random.below(leaves.len() as u32) as usize].0, aabb);
            }
            _ => {}
        }
        tree.query(aabb, |_| true);
        let origin = Point::new(f64::from(pick(&mut random)), f64::from(pick(&mut random)));
        tree.cast(origin, 0.0, aabb.max, pick(&mut random), |_, end| end);
        assert_eq!(tree.len(), leaves.len());
        assert!(tree.len() < 2 || tree.height() as f32 <= height_bound(tree.len()));
    }
    let mut nodes = 0;
    tree.for_each_node(|_, depth, _| {
        assert!(depth <= tree.height());
        nodes += 1;
    });
    assert_eq!(nodes, 2 * leaves.len() - 1);
    for (leaf, value) in leaves {
        assert_eq!(tree.remove(leaf), value);
    }
    assert_eq!(tree.len(), 0);
}

#[test]
fn boxes_at_the_end_of_the_range_are_found() {
    let mut tree = Tree::default();
    let corners = [-1e30, 1e30].map(|x| [-1e30, 1e30].map(|y| Vec2::new(x, y)));
    for (value, &corner) in corners.as_flattened().iter().enumerate() {
        for copy in 0..500 {
            tree.insert(Aabb::new(corner, corner), value as u32 * 500 + copy);
        }
    }
    tree.insert(Aabb::new(Vec2::splat(-1e30), Vec2::splat(1e30)), 2000);
    assert_sound(&tree);
    assert_eq!(found(&tree, Aabb::new(Vec2::ZERO, Vec2::ZERO)), [2000]);
    assert_eq!(found(&tree, Aabb::new(Vec2::splat(1e30), Vec2::splat(1e30))).len(), 501);
    assert_eq!(found_by_ray(&tree, Point::new(-1e30_f32 as f64, 0.0), Vec2::new(2e30, 0.0), 1.0), [2000]);
}

#[test]
fn a_walk_over_all_nodes_sees_every_leaf_once_below_its_depth() {
    let tree = random_tree(&mut Random(7), 300, 20.0, 3.0);
    let (mut leaves, mut inner, mut deepest) = (0, 0, 0);
    tree.for_each_node(|_, depth, is_leaf| {
        if is_leaf {
            leaves += 1;
        } else {
            inner += 1;
        }
        deepest = deepest.max(depth);
    });
    assert_eq!((leaves, inner, deepest), (300, 299, tree.height()));
}

/// Small steps of every box for as long as it takes to mix them: moving must not let the tree rot. A tree made
/// anew from the same boxes is the measure.
#[test]
fn moving_boxes_keeps_queries_as_cheap_as_in_a_new_tree() {
    let mut random = Random(8);
    let mut boxes: Vec<Aabb> = (0..2000).map(|_| random_aabb(&mut random, 30.0, 1.0)).collect();
    let mut tree = Tree::default();
    let leaves: Vec<u32> = boxes.iter().enumerate().map(|(i, &aabb)| tree.insert(aabb, i as u32)).collect();
    for _ in 0..100 {
        for (aabb, &leaf) in boxes.iter_mut().zip(&leaves) {
            let step = Vec2::new(random.between(-2.0, 2.0), random.between(-2.0, 2.0));
            *aabb = Aabb::new(aabb.min + step, aabb.max + step);
            tree.move_leaf(leaf, *aabb);
        }
    }
    assert_sound(&tree);
    assert_eq!(tree.pairs.len(), boxes.len(), "a move takes the pair it has freed");
    let mut fresh = Tree::default();
    for (value, &aabb) in boxes.iter().enumerate() {
        fresh.insert(aabb, value as u32);
    }
    let (moved, fresh) = (inner_perimeter(&tree), inner_perimeter(&fresh));
    assert!(moved < 1.15 * fresh, "{moved} against {fresh}");
}

/// What a query costs, by the surface-area heuristic.
fn inner_perimeter(tree: &Tree) -> f32 {
    let mut sum = 0.0;
    tree.for_each_node(|aabb, _, is_leaf| sum += if is_leaf { 0.0 } else { aabb.perimeter() });
    sum
}

#[test]
fn distance_orders_boxes_by_how_far_their_middles_are_apart() {
    let at = |x: f32| Reach::from(Aabb::new(Vec2::new(x, 0.0), Vec2::new(x + 1.0, 1.0)));
    assert!(at(0.0).distance(at(1.0)) < at(0.0).distance(at(-1.5)));
}
