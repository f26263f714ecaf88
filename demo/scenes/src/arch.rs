//! An arch of wedges, with nothing that binds them.

use rustycs::{Body, Material, Rot, Settings, Shape, Vec2, World};

use crate::parts::{put, put_floor, world_with_gravity};
use crate::{Scene, View};

/// An arch of wedges, with nothing that binds them.
pub const SCENE: Scene = Scene {
    name: "arch",
    group: "stacks",
    summary: "Fifteen wedges in half a circle hold each other up by pressure alone; take one out and all fall.",
    view: View::above(-1.0, 0.0, 15.0, 8.6),
    build,
    hint: Some("Pull a wedge out."),
    ..Scene::PLAIN
};

/// Wedges in the arch.
const WEDGES: u8 = 15;
/// Radii of the inner and outer corners, m. A half circle stands while its thickness is above 10.75 % of its
/// mean radius (Milankovitch 1907); this one has 22 %.
const RADII: [f32; 2] = [4.0, 5.0];
/// Friction between wedges: above what the thinnest arch needs, 0.4.
const FRICTION: f32 = 0.8;

/// All wedges have the same shape: a slice of the half circle with straight sides.
fn build(_seed: u64, settings: Settings) -> World {
    let mut world = world_with_gravity(settings);
    let floor = put_floor(&mut world, 16.0, 1.0);
    world.body_mut(floor).and_then(|mut floor| floor.set_friction(FRICTION).ok());

    let pitch = core::f32::consts::PI / f32::from(WEDGES);
    let half = Rot::from_angle(0.5 * pitch);
    let [inner, outer] = RADII;
    // The sides of the slice lie along ±half; it looks along x.
    let corner = |radius: f32, side: f32| Vec2::new(radius * half.c, side * radius * half.s);
    let corners = [corner(inner, -1.0), corner(outer, -1.0), corner(outer, 1.0), corner(inner, 1.0)];
    let shape = Shape::polygon(corners).expect("a slice of a ring is convex");
    // Distance of its centroid from the tip: 2/3 of (r_2³ - r_1³) / (r_2² - r_1²), along the middle.
    let ratio = (inner * inner + inner * outer + outer * outer) / (inner + outer);
    let center = 2.0 / 3.0 * ratio * half.c;
    let material = Material { friction: FRICTION, restitution: 0.0, ..Material::STONE };
    for wedge in 0..WEDGES {
        let angle = (f32::from(wedge) + 0.5) * pitch;
        let place = Rot::from_angle(angle).rotate(Vec2::new(center, 0.0));
        put(&mut world, Body::dynamic(shape).at(place).angle(angle).material(material));
    }
    world
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::run;

    /// The crown sinks by what the joints give: a few times the overlap that the solver leaves, 5 mm each.
    #[test]
    fn the_arch_stands_for_ten_seconds() {
        let mut world = SCENE.build(1, Settings { sleep: false, ..Settings::default() });
        let height = |world: &World| world.bodies().map(|(_, body)| body.position().y).fold(0.0, f32::max);
        let before = height(&world);
        run(&SCENE, &mut world, 600);
        let sunk = before - height(&world);
        assert!(sunk.abs() < 0.05, "the crown has sunk by {sunk} m");
        assert!(world.kinetic_energy() < 1e-3, "it still moves: {} J", world.kinetic_energy());
    }
}
