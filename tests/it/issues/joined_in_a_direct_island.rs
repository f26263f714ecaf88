//! What was joined was solved directly with all that it touched, as if it were free: contacts pressed joints open, which pressed back in
//! the next substep.

use rustycs::prelude::*;

fn overlap(world: &World) -> f32 {
    let points = world.contacts().flat_map(|contact| contact.points().to_vec());
    points.map(|point| -point.separation).fold(0.0, f32::max)
}

/// Crates on a bridge of hinged planks. Sweeps leave 14 % of what a contact would give way in a substep, here 2 to 3 mm; it was 5 cm.
#[test]
fn what_lies_on_a_bridge_does_not_sink_into_its_planks() {
    let mut world = rustycs_scenes::find("bridge").unwrap().build(1, Settings::default());
    for tick in 0..900 {
        world.step();
        let overlap = overlap(&world);
        assert!(tick < 200 || overlap < 5e-3, "{overlap} m at tick {tick}");
    }
}

/// Heaps of ragdolls come to rest within ten seconds; four of six trembled for ever.
#[test]
fn a_heap_of_ragdolls_comes_to_rest() {
    for seed in 1..=6 {
        let mut world = rustycs_scenes::find("ragdolls").unwrap().build(seed, Settings::default());
        (0..600).for_each(|_| world.step());
        let awake = |body: &BodyRef<'_>| body.body_type() == BodyType::Dynamic && !body.is_sleeping();
        assert_eq!(world.bodies().filter(|(_, body)| awake(body)).count(), 0, "seed {seed}");
    }
}
