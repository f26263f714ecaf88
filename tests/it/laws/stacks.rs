//! What statics says stands.

use rustycs::Tier::{Direct, Swept};
use rustycs::prelude::*;

use crate::support::{add, add_floor, assert_near, earth, earth_with, place, run, unit_box, velocity};

fn stack(count: usize) -> (World, Vec<BodyId>) {
    let mut world = earth();
    add_floor(&mut world, 0.6);
    let ids = (0..count).map(|i| add(&mut world, unit_box(0.0, 0.5 + i as f64))).collect();
    (world, ids)
}

fn fastest(world: &World, ids: &[BodyId]) -> f64 {
    ids.iter().map(|&id| velocity(world, id)).map(|[x, y]| x.hypot(y)).fold(0.0, f64::max)
}

/// Contact k below the top carries k weights and overlaps by k·compliance·g·h/(2·bias rate) = k × 1.0e-4 m per
/// point pair and substep of 1/240 s; the top sinks by the sum, about 1.3 cm for ten.
#[test]
fn ten_boxes_stand_for_a_minute() {
    let (mut world, ids) = stack(10);
    run(&mut world, 60.0);
    let top = place(&world, ids[9]);
    assert!(9.5 - top[1] < 0.015, "the top sank by {} m", 9.5 - top[1]);
    assert!(fastest(&world, &ids) < 1e-3, "{} m/s", fastest(&world, &ids));
    for &id in &ids {
        assert_near(place(&world, id)[0], 0.0, 1e-3, "sideways drift");
    }
}

#[test]
fn fifty_boxes_stand() {
    let (mut world, ids) = stack(50);
    run(&mut world, 20.0);
    for (i, &id) in ids.iter().enumerate() {
        let [x, y] = place(&world, id);
        assert_near(x, 0.0, 1e-2, "sideways drift");
        assert_near(y, 0.5 + i as f64, 0.5, "height");
    }
    assert!(fastest(&world, &ids) < 1e-2, "{} m/s", fastest(&world, &ids));
}

#[test]
fn a_pyramid_of_base_twenty_is_at_rest_after_ten_seconds() {
    let mut world = earth();
    add_floor(&mut world, 0.6);
    let mut ids = Vec::new();
    for row in 0..20 {
        for column in 0..20 - row {
            let x = 1.05 * (f64::from(column) + 0.5 * f64::from(row));
            ids.push((add(&mut world, unit_box(x, 0.5 + f64::from(row))), x));
        }
    }
    run(&mut world, 10.0);
    let all: Vec<BodyId> = ids.iter().map(|&(id, _)| id).collect();
    assert!(fastest(&world, &all) < 1e-3, "{} m/s", fastest(&world, &all));
    for &(id, x) in &ids {
        assert_near(place(&world, id)[0], x, 0.02, "sideways");
    }
}

/// Cards of 1 m lean at 20 degrees from upright with friction 0.8. A foot holds while the friction exceeds
/// tan 20° = 0.36, so statics lets the house stand.
#[test]
fn a_card_house_of_five_levels_stands() {
    let scene = rustycs_scenes::find("card_house").unwrap();
    let mut world = scene.build(1, Settings { sleep: false, ..Settings::default() });
    let cards: Vec<BodyId> =
        world.bodies().filter(|(_, body)| body.body_type() == BodyType::Dynamic).map(|(id, _)| id).collect();
    let start: Vec<[f64; 2]> = cards.iter().map(|&id| place(&world, id)).collect();
    run(&mut world, 20.0);
    for (&id, &[x, y]) in cards.iter().zip(&start) {
        assert_near(place(&world, id)[0], x, 0.05, "sideways");
        assert_near(place(&world, id)[1], y, 0.05, "height");
    }
    assert!(fastest(&world, &cards) < 1e-3, "{} m/s", fastest(&world, &cards));
}

/// The classic scheme is a setting of the same code and carries a small stack too.
#[test]
fn the_classic_scheme_carries_five_boxes() {
    let mut world = earth_with(Settings::classic());
    add_floor(&mut world, 0.6);
    let ids: Vec<BodyId> = (0..5).map(|i| add(&mut world, unit_box(0.0, 0.5 + f64::from(i)))).collect();
    run(&mut world, 10.0);
    for (i, &id) in ids.iter().enumerate() {
        assert_near(place(&world, id)[1], 0.5 + i as f64, 0.05, "height");
        assert_near(place(&world, id)[0], 0.0, 0.05, "sideways");
    }
}

/// A box of 10,000 kg on one of 1 kg, and the world beside it. Solved directly the light one bears it: what a change
/// of the load leaves is found again by the bias, and at rest nothing is left but the tolerance of 1e-5 m/s, which
/// the bias of 28 1/s turns into 0.4 µm. Without its load the light box is solved like any other.
#[test]
fn a_light_box_carries_ten_thousand_times_its_mass_and_the_others_pay_nothing() {
    let mut world = earth_with(Settings { sleep: false, ..Settings::default() });
    add_floor(&mut world, 0.6);
    let light = add(&mut world, unit_box(0.0, 0.5));
    let heavy = add(&mut world, unit_box(0.0, 1.5).density(10_000.0));
    let beside = add(&mut world, unit_box(5.0, 0.5));
    run(&mut world, 10.0);
    let tier_of = |world: &World, id: BodyId| world.body(id).unwrap().tier();
    assert_eq!([light, heavy, beside].map(|id| tier_of(&world, id)), [Direct, Direct, Swept]);
    assert_near(place(&world, light)[1], 0.5, 1e-5, "height of the light box");
    assert_near(place(&world, heavy)[1], 1.5, 1e-5, "height of the heavy box");
    world.remove(heavy);
    run(&mut world, 3.0);
    assert_eq!(tier_of(&world, light), Swept);
}

/// A stack of 200 boxes: sweeps would leave it 4.6 m shorter. It must lose no more than the tolerance of the direct
/// solve in each contact and the way that it goes until its load is found: the first steps are sweeps, and what they
/// leave is driven out at 28 1/s.
#[test]
fn two_hundred_boxes_stand() {
    let (mut world, ids) = stack(200);
    run(&mut world, 10.0);
    assert_near(place(&world, ids[199])[1], 199.5, 0.01, "height of the top");
    assert_near(place(&world, ids[199])[0], 0.0, 0.01, "sideways");
    assert!(fastest(&world, &ids) < 1e-3, "{} m/s", fastest(&world, &ids));
}
