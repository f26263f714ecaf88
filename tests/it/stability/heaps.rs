//! Heaps of bodies of every size and material: light ones under heavy ones.

use rustycs::Settings;

/// Of the contacts of a heap at rest, how many are deeper than 1 cm, and how many there are.
fn deep_contacts(seed: u64) -> [usize; 2] {
    let scene = rustycs_scenes::find("pile").expect("it is the first scene");
    let mut world = scene.build(seed, Settings::default());
    (0..600).for_each(|_| world.step());
    let deepest = |contact: rustycs::ContactRef<'_>| {
        contact.points().iter().map(|point| -point.separation).fold(0.0, f32::max)
    };
    [world.contacts().filter(|&contact| deepest(contact) > 0.01).count(), world.contacts().count()]
}

/// Densities are 78 : 1 and masses up to 1460 : 1. If contacts yielded to all that they bear, one in five would be deeper than
/// 1 cm: a light box of 0.2 m under a hundred times its mass by 34 mm.
#[test]
fn light_bodies_do_not_sink_into_heavy_ones() {
    let heaps: Vec<[usize; 2]> = (21..25).map(deep_contacts).collect();
    let [deep, all] = [0, 1].map(|index| heaps.iter().map(|heap| heap[index]).sum::<usize>());
    assert!(deep <= all / 50, "{deep} of {all} contacts are deeper than 1 cm: {heaps:?}");
}
