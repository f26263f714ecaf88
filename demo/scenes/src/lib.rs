//! The scenes: worlds worth watching, shared by the demo, the tests, the benches and the examples.
//!
//! A scene is a function that fills a world, with a sentence on what to look for and the part of the world to
//! look at. It uses only what any user of `rustycs` can use. The same name, seed and settings give the same
//! world, bit for bit, on every machine: angles go through `rustycs::math`, and random numbers come from a
//! generator whose algorithm is named (see [`pile`]).
//!
//! To add a scene, write a file with a `SCENE` and list it in [`all`].
//!
//! ```
//! let scene = rustycs_scenes::find("tower").expect("there is a tower");
//! let mut world = scene.build(1, rustycs::Settings::default());
//! world.step();
//! assert_eq!(world.body_count(), 11);
//! ```

pub mod bounce;
pub mod card_house;
pub mod cradle;
pub mod orbit;
mod parts;
pub mod pile;
pub mod pyramid;
pub mod slope;
pub mod tower;

use rustycs::{Settings, Vec2, World};

/// A world worth watching, and what to know about it.
#[derive(Clone, Copy, Debug)]
pub struct Scene {
    /// Short name, as typed on a command line: lower case, words joined by `_`.
    pub name: &'static str,
    /// One sentence on what to look for.
    pub summary: &'static str,
    /// The part of the world to look at.
    pub view: View,
    build: fn(u64, Settings) -> World,
}

impl Scene {
    /// The world at time 0. `seed` matters to scenes with chance in them; the others ignore it.
    ///
    /// # Panics
    /// If [`Settings::validate`] refuses `settings`.
    pub fn build(&self, seed: u64, settings: Settings) -> World {
        (self.build)(seed, settings)
    }
}

/// A part of the world to look at: show all of it, whatever the shape of the window.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// Middle of the part, m.
    pub center: Vec2,
    /// Width, m.
    pub width: f32,
    /// Height, m.
    pub height: f32,
}

impl View {
    /// The part from `x - width / 2` to `x + width / 2` and from `bottom` to `bottom + height`, m.
    const fn above(bottom: f32, x: f32, width: f32, height: f32) -> Self {
        Self { center: Vec2::new(x, bottom + 0.5 * height), width, height }
    }
}

/// Every scene; the first is the one to show when nothing is asked for.
pub fn all() -> &'static [Scene] {
    const ALL: [Scene; 8] = [
        pile::SCENE,
        tower::SCENE,
        pyramid::SCENE,
        card_house::SCENE,
        cradle::SCENE,
        bounce::SCENE,
        orbit::SCENE,
        slope::SCENE,
    ];
    &ALL
}

/// The scene with this name.
pub fn find(name: &str) -> Option<&'static Scene> {
    all().iter().find(|scene| scene.name == name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_distinct_and_found() {
        for (index, scene) in all().iter().enumerate() {
            let found = find(scene.name).expect("every listed scene is found");
            assert_eq!(found.summary, scene.summary, "two scenes are called {}", scene.name);
            assert_eq!(all().iter().position(|other| other.name == scene.name), Some(index));
        }
        assert!(find("no such scene").is_none());
    }

    #[test]
    fn every_scene_builds_the_same_world_twice_and_steps() {
        for scene in all() {
            let [mut one, mut other] = [(); 2].map(|()| scene.build(7, Settings::default()));
            assert!(one.body_count() > 0, "{} is empty", scene.name);
            for _ in 0..10 {
                one.step();
                other.step();
            }
            assert_eq!(one.state_hash(), other.state_hash(), "{}", scene.name);
        }
    }

    #[test]
    fn bodies_do_not_overlap_at_the_start() {
        for scene in all() {
            let mut world = scene.build(7, Settings::default());
            world.step();
            let deepest = world.error().penetration;
            assert!(deepest < 2e-3, "{} begins {deepest} m deep", scene.name);
        }
    }
}
