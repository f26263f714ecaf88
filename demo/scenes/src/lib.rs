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

pub mod arch;
pub mod attractor;
pub mod ball_pit;
pub mod billiards;
pub mod bounce;
pub mod bridge;
pub mod capsules;
pub mod car;
pub mod card_house;
pub mod confined;
pub mod conveyor;
pub mod cradle;
pub mod dominoes;
pub mod double_pendulum;
pub mod elevator;
pub mod friction_ramp;
pub mod galaxy;
pub mod gears;
mod joined;
pub mod letters;
mod mark;
pub mod mass_ratio;
pub mod materials;
pub mod orbit;
mod parts;
pub mod pile;
pub mod pinball;
pub mod platforms;
pub mod polygons;
pub mod pool;
pub mod pyramid;
pub mod radial_engine;
pub mod ragdolls;
mod random;
mod rotor;
pub mod sandbox;
pub mod scissor_lift;
pub mod slide;
pub mod slope;
pub mod smash;
pub mod solar_system;
pub mod spinner;
pub mod strings;
pub mod swing_doors;
#[cfg(test)]
mod testing;
pub mod tower;
pub mod trebuchet;
pub mod tumbler;
pub mod washer;
pub mod wind_tunnel;
pub mod windmill;
pub mod wrecking_ball;

use rustycs::{BodyId, Settings, Vec2, World};

use crate::mark::{Label, Mark};

/// A world worth watching, and what to know about it.
///
/// A scene holds no state: all that its motion depends on is in the world, so a clone of the world, or one of
/// some ticks ago, goes on as the original did.
///
/// ```
/// let scene = rustycs_scenes::find("solar_system").expect("there is a solar system");
/// let mut world = scene.build(1, rustycs::Settings::default());
/// scene.before_tick(&mut world); // before every tick, once
/// world.step();
/// let names: Vec<&str> = scene.labels(&world).into_iter().map(|(_, name)| name).collect();
/// assert!(names.contains(&"Jupiter"));
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Scene {
    /// Short name, as typed on a command line: lower case, words joined by `_`.
    pub name: &'static str,
    /// What it is listed under: one of [`GROUPS`].
    pub group: &'static str,
    /// One sentence on what to look for.
    pub summary: &'static str,
    /// The part of the world to look at.
    pub view: View,
    /// What to try in it, in a sentence, where it is for trying.
    pub hint: Option<&'static str>,
    /// Time after which all has happened in it, s, where it comes to an end.
    pub ends_after: Option<f32>,
    /// Whether its seed matters.
    pub is_random: bool,
    /// Whether it is about bodies that have to be told apart by their [`labels`](Self::labels).
    pub is_about_names: bool,
    /// Whether it is about the paths of its bodies.
    pub is_about_paths: bool,
    build: fn(u64, Settings) -> World,
    before_tick: Option<fn(&mut World)>,
    played: Option<fn(&mut World, [bool; 2])>,
    readout: Option<fn(&World) -> String>,
    labels: &'static [Label],
}

/// The groups that scenes are listed under, in order.
pub const GROUPS: [&str; 7] = ["classic", "stacks", "collisions", "machines", "joints", "attraction", "many"];

impl Scene {
    /// What most scenes have no need of.
    const PLAIN: Self = Self {
        name: "",
        group: "",
        summary: "",
        view: View::above(0.0, 0.0, 1.0, 1.0),
        hint: None,
        ends_after: None,
        is_random: false,
        is_about_names: false,
        is_about_paths: false,
        build: |_, settings| World::new(settings),
        before_tick: None,
        played: None,
        readout: None,
        labels: &[],
    };

    /// The world at time 0. `seed` matters to scenes with chance in them; the others ignore it.
    ///
    /// # Panics
    /// If [`Settings::validate`] refuses `settings`.
    pub fn build(&self, seed: u64, settings: Settings) -> World {
        (self.build)(seed, settings)
    }

    /// Whether the scene steers some of its bodies, so that [`before_tick`](Self::before_tick) does anything.
    pub fn is_steered(&self) -> bool {
        self.before_tick.is_some()
    }

    /// Tells the bodies that the scene steers how to move in the next tick: to be called before every
    /// [`World::step`]. It depends on the world alone and does the same when it is called twice; where bodies
    /// were removed or added meanwhile it steers those that are left.
    pub fn before_tick(&self, world: &mut World) {
        if let Some(before_tick) = self.before_tick {
            before_tick(world);
        }
    }

    /// Whether somebody can play it, with a key on the left and one on the right.
    pub fn is_playable(&self) -> bool {
        self.played.is_some()
    }

    /// What [`before_tick`](Self::before_tick) does, with a player in place of the scene's own decisions: whether the
    /// left and the right key are down.
    pub fn before_tick_played(&self, world: &mut World, keys: [bool; 2]) {
        match self.played {
            Some(played) => played(world, keys),
            None => self.before_tick(world),
        }
    }

    /// What the scene measures, in a line of text with units: how fast Jupiter is, how many dominoes lie.
    pub fn readout(&self, world: &World) -> Option<String> {
        self.readout.map(|readout| readout(world))
    }

    /// Names to show beside bodies, for those that have one, by ascending place.
    pub fn labels(&self, world: &World) -> Vec<(BodyId, &'static str)> {
        self.labelled(world).filter_map(|(id, label)| Some((id, label.text?))).collect()
    }

    /// Colours (red, green, blue) of the bodies that have one of their own, by ascending place.
    pub fn colours(&self, world: &World) -> Vec<(BodyId, [u8; 3])> {
        self.labelled(world).filter_map(|(id, label)| Some((id, label.colour?))).collect()
    }

    fn labelled(&self, world: &World) -> impl Iterator<Item = (BodyId, Label)> {
        world.bodies().filter_map(|(id, body)| Some((id, *self.labels.get(Mark::of(body).label?)?)))
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

/// Every scene, group by group in the order of [`GROUPS`]; the first is the one to show when nothing is asked
/// for.
pub fn all() -> &'static [Scene] {
    const ALL: &[Scene] = &[
        pile::SCENE,
        pool::SCENE,
        materials::SCENE,
        slide::SCENE,
        slope::SCENE,
        platforms::SCENE,
        attractor::SCENE,
        polygons::SCENE,
        capsules::SCENE,
        letters::SCENE,
        solar_system::SCENE,
        sandbox::SCENE,
        tower::SCENE,
        tower::FAR,
        pyramid::SCENE,
        card_house::SCENE,
        arch::SCENE,
        dominoes::SCENE,
        mass_ratio::SCENE,
        friction_ramp::SCENE,
        cradle::SCENE,
        bounce::SCENE,
        billiards::SCENE,
        confined::SCENE,
        tumbler::SCENE,
        washer::SCENE,
        spinner::SCENE,
        wind_tunnel::SCENE,
        pinball::SCENE,
        gears::SCENE,
        conveyor::SCENE,
        car::SCENE,
        bridge::SCENE,
        wrecking_ball::SCENE,
        strings::SCENE,
        double_pendulum::SCENE,
        ragdolls::SCENE,
        scissor_lift::SCENE,
        elevator::SCENE,
        radial_engine::SCENE,
        windmill::SCENE,
        swing_doors::SCENE,
        trebuchet::SCENE,
        orbit::SCENE,
        galaxy::SCENE,
        smash::SCENE,
        ball_pit::SCENE,
    ];
    ALL
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
    fn the_seed_matters_to_scenes_with_chance_in_them() {
        for scene in all() {
            let [one, other] = [1, 2].map(|seed| scene.build(seed, Settings::default()).state_hash());
            assert_eq!(one != other, scene.is_random, "{}", scene.name);
        }
    }

    #[test]
    fn scenes_are_listed_by_group() {
        let groups: Vec<&str> = all().iter().map(|scene| scene.group).collect();
        let listed: Vec<&str> = groups.chunk_by(|one, next| one == next).map(|group| group[0]).collect();
        assert_eq!(listed, GROUPS);
    }

    /// Ten seconds, or fewer where many bodies make ticks long; every table is checked on the way.
    #[test]
    fn every_scene_steps_for_ten_seconds_and_stays_finite() {
        for scene in all() {
            let mut world = scene.build(1, Settings::default());
            let ticks = if world.body_count() > 600 { 120 } else { 600 };
            for tick in 1..=ticks {
                scene.before_tick(&mut world);
                world.step();
                if tick % 100 == 0 {
                    world.validate().unwrap_or_else(|error| panic!("{}, tick {tick}: {error}", scene.name));
                }
            }
        }
    }

    #[test]
    fn every_scene_works_under_other_settings() {
        let slow = Settings { tick_rate: 15.0, ..Settings::default() };
        let weightless = Settings { gravitational_constant: 0.0, sleep: false, ..Settings::default() };
        for settings in [Settings::classic(), slow, weightless] {
            for scene in all() {
                let mut world = scene.build(2, settings.clone());
                testing::run(scene, &mut world, 20);
                assert_eq!(world.validate(), Ok(()), "{} with {settings:?}", scene.name);
            }
        }
    }

    /// What steers a scene is in its world: a clone goes on as the original, and so does the world of before.
    #[test]
    fn steered_worlds_can_be_cloned_and_rewound() {
        for scene in all().iter().filter(|scene| scene.is_steered()) {
            let mut world = scene.build(1, Settings::default());
            testing::run(scene, &mut world, 30);
            let mut rewound = world.clone();
            testing::run(scene, &mut world, 30);
            // Asking twice changes nothing.
            scene.before_tick(&mut rewound);
            testing::run(scene, &mut rewound, 30);
            assert_eq!(world.state_hash(), rewound.state_hash(), "{}", scene.name);
        }
    }

    /// A part that was removed or cannot be steered leaves the rest in motion.
    #[test]
    fn machines_go_on_without_their_first_part() {
        for scene in all().iter().filter(|scene| scene.is_steered()) {
            let mut world = scene.build(1, Settings::default());
            let (first, _) = world.bodies().next().expect("every machine has parts");
            world.remove(first);
            testing::run(scene, &mut world, 30);
            assert_eq!(world.validate(), Ok(()), "{}", scene.name);
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
