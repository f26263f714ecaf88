//! A stream of discs past an attractor that has a range.

use rustycs::{Body, Settings, Shape, World};

use crate::parts::{ELASTIC, put, put_attractor};
use crate::{Scene, View};

/// A stream of discs past an attractor that has a range.
pub const SCENE: Scene = Scene {
    name: "attractor",
    group: "classic",
    summary: "Discs fly straight until they come within range of the attractor, which bends or keeps their paths.",
    view: View::above(-9.0, 0.0, 32.0, 18.0),
    build,
    is_about_paths: true,
    ..Scene::PLAIN
};

/// Distance from the attractor beyond which nothing pulls, m.
const RANGE: f32 = 5.0;
/// G times the mass of the attractor, m³/s².
const GM: f32 = 30.0;
/// Speed of the discs, m/s.
const SPEED: f32 = 3.0;

/// Three columns of discs come from the left; those at the edge pass out of range and never turn.
fn build(_seed: u64, settings: Settings) -> World {
    let mut world = World::new(settings);
    put_attractor(&mut world, GM, Some(RANGE));
    put(&mut world, Body::fixed(Shape::circle(0.6)).restitution(0.2));
    for column in 0..3_u8 {
        for row in 0..9_u8 {
            let place = [-8.0 - 3.0 * f32::from(column), (f32::from(row) - 4.0) * 1.6 + 0.1];
            let disc = Body::dynamic(Shape::circle(0.2)).at(place).velocity([SPEED, 0.0]);
            put(&mut world, disc.material(ELASTIC).restitution(0.5));
        }
    }
    world
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The rows at ±6.4 m pass the range of 5 m: no force, and no contact within three seconds.
    #[test]
    fn discs_out_of_range_fly_straight() {
        let mut world = SCENE.build(1, Settings::default());
        let outer: Vec<_> = world
            .bodies()
            .filter(|(_, body)| body.position().y.abs() > RANGE + 1.0)
            .map(|(id, body)| (id, body.position_f64()))
            .collect();
        assert_eq!(outer.len(), 6);
        for _ in 0..180 {
            world.step();
        }
        for (id, [x, y]) in outer {
            let [x_now, y_now] = world.body(id).expect("no disc was removed").position_f64();
            let error = (x_now - x - 3.0 * f64::from(SPEED)).abs() + (y_now - y).abs();
            // Places are in f64; the time of a tick is rounded to f32, 1e-7 of the way.
            assert!(error < 1e-5, "off by {error} m");
        }
    }
}
