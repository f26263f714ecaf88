//! A row of dominoes.

use rustycs::{Body, BodyType, Material, Settings, Shape, World};

use crate::mark::Mark;
use crate::parts::{put, put_floor, world_with_gravity};
use crate::{Scene, View};

/// A row of dominoes.
pub const SCENE: Scene = Scene {
    name: "dominoes",
    group: "stacks",
    summary: "A ball tips the first of forty dominoes: each fells the next, at a speed that settles, to the last.",
    view: View::above(-1.4, 0.0, 26.0, 8.0),
    build,
    readout: Some(readout),
    ends_after: Some(16.0),
    ..Scene::PLAIN
};

/// Dominoes in the row.
const DOMINOES: u8 = 40;
/// Width and height of a domino, m.
const SIZE: [f32; 2] = [0.2, 1.5];
/// From one domino to the next, m.
const PITCH: f32 = 0.55;
/// Angle from upright beyond which a domino has fallen, as its cosine: 45°.
const FALLEN: f32 = core::f32::consts::FRAC_1_SQRT_2;

fn build(_seed: u64, settings: Settings) -> World {
    let mut world = world_with_gravity(settings);
    put_floor(&mut world, 60.0, 1.0);
    let first = -0.5 * f32::from(DOMINOES - 1) * PITCH;
    let [width, height] = SIZE;
    for place in 0..DOMINOES {
        let domino =
            Body::dynamic(Shape::obb(width, height)).at([first + f32::from(place) * PITCH, 0.5 * height]);
        let material = Material { friction: 0.6, restitution: 0.0, ..Material::PLASTIC };
        put(&mut world, Mark::part(usize::from(place)).on(domino.material(material)));
    }
    let ball =
        Body::dynamic(Shape::circle(0.25)).at([first - 1.0, 1.4]).velocity([4.0, 0.0]).angular_damping(2.0);
    put(&mut world, ball.material(Material::STONE));
    world
}

/// How many dominoes lean or lie, and how many there are.
fn fallen(world: &World) -> [usize; 2] {
    let dominoes = world
        .bodies()
        .filter(|&(_, body)| body.body_type() == BodyType::Dynamic && Mark::of(body).part.is_some());
    dominoes.fold([0, 0], |[fallen, all], (_, body)| {
        let has_fallen = body.rotation().c.abs() < FALLEN;
        [fallen + usize::from(has_fallen), all + 1]
    })
}

fn readout(world: &World) -> String {
    let [fallen, all] = fallen(world);
    format!("{fallen} of {all} dominoes have fallen")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::run;

    #[test]
    fn all_dominoes_fall() {
        let mut world = SCENE.build(1, Settings::default());
        assert_eq!(fallen(&world), [0, 40]);
        run(&SCENE, &mut world, 600);
        assert_eq!(fallen(&world), [40, 40]);
    }
}
