//! What statics says stands.

use rustycs::prelude::*;

use crate::support::{add, add_floor, assert_near, earth, place, run, unit_box, velocity};

fn stack(count: usize) -> (World, Vec<BodyId>) {
    let mut world = earth();
    add_floor(&mut world, 0.6);
    let ids = (0..count).map(|i| add(&mut world, unit_box(0.0, 0.5 + i as f64))).collect();
    (world, ids)
}

fn fastest(world: &World, ids: &[BodyId]) -> f64 {
    ids.iter().map(|&id| velocity(world, id)).map(|[x, y]| x.hypot(y)).fold(0.0, f64::max)
}

/// Contact k below the top carries k weights and overlaps by k·leak·g·h/(2·bias rate) = k × 1.0e-4 m per
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
    let mut world = crate::support::earth_with(Settings::classic());
    add_floor(&mut world, 0.6);
    let ids: Vec<BodyId> = (0..5).map(|i| add(&mut world, unit_box(0.0, 0.5 + f64::from(i)))).collect();
    run(&mut world, 10.0);
    for (i, &id) in ids.iter().enumerate() {
        assert_near(place(&world, id)[1], 0.5 + i as f64, 0.05, "height");
        assert_near(place(&world, id)[0], 0.0, 0.05, "sideways");
    }
}

/// A box of 1000 kg on one of 1 kg. The overlap of the light one goes with the load over its mass and the length of
/// the substep: at four substeps it is crushed, at sixteen (a quarter of the compliance, and the stiffer contact of
/// heavy loads) it stands with a few centimetres.
#[test]
fn adaptive_substeps_carry_a_thousand_to_one() {
    let mut world = crate::support::earth_with(Settings { adaptive: true, ..Settings::default() });
    add_floor(&mut world, 0.6);
    let light = add(&mut world, unit_box(0.0, 0.5));
    let heavy = add(&mut world, unit_box(0.0, 1.5).density(1000.0));
    assert_eq!(world.profile().counters().substeps, 0);
    run(&mut world, 10.0);
    assert!(world.profile().counters().substeps > 4, "{:?}", world.profile().counters());
    assert_near(place(&world, light)[1], 0.5, 0.05, "height of the light box");
    assert_near(place(&world, heavy)[1], 1.5, 0.05, "height of the heavy box");
    // Without its load the light box needs no more than it did before.
    world.remove(heavy);
    run(&mut world, 3.0);
    assert_eq!(world.profile().counters().substeps, 4);
}
