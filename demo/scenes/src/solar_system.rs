//! The sun and eight planets.
//!
//! Distances are the square roots of the real ones, so that Mercury and Neptune fit on one screen; the speed of
//! each planet follows from its orbit, v = √(GM/r). Masses are the real ones, the Earth being 1 kg. Planets do
//! not pull each other.

use rustycs::{Body, Material, Rot, Settings, Shape, Vec2, World};

use crate::mark::{Label, Mark};
use crate::parts::{put, put_attractor};
use crate::{Scene, View};

/// The sun and eight planets.
pub const SCENE: Scene = Scene {
    name: "solar_system",
    group: "classic",
    summary: "Eight planets circle the sun, the inner ones faster: v = √(GM/r), for hours and without drift.",
    view: View::above(-24.0, 0.0, 56.0, 48.0),
    build,
    readout: Some(readout),
    labels: &LABELS,
    is_about_names: true,
    is_about_paths: true,
    ..Scene::PLAIN
};

/// A planet, as it is in the sky.
#[derive(Clone, Copy, Debug)]
pub struct Planet {
    /// Its name.
    pub name: &'static str,
    /// Mean distance from the sun, astronomical units (NASA planetary fact sheet).
    pub distance: f32,
    /// Mass in masses of the Earth: its mass here, kg.
    pub mass: f32,
    /// Radius of its disc here, m: larger for larger planets, not to scale; neighbours pass without touching.
    pub radius: f32,
    colour: [u8; 3],
}

/// The planets from the sun outward.
#[rustfmt::skip]
pub const PLANETS: [Planet; 8] = [
    Planet { name: "Mercury", distance: 0.387, mass: 0.0553, radius: 0.17, colour: [169, 160, 150] },
    Planet { name: "Venus", distance: 0.723, mass: 0.815, radius: 0.25, colour: [229, 196, 130] },
    Planet { name: "Earth", distance: 1.0, mass: 1.0, radius: 0.27, colour: [92, 148, 230] },
    Planet { name: "Mars", distance: 1.524, mass: 0.107, radius: 0.21, colour: [214, 100, 66] },
    Planet { name: "Jupiter", distance: 5.204, mass: 317.8, radius: 0.95, colour: [214, 170, 128] },
    Planet { name: "Saturn", distance: 9.583, mass: 95.2, radius: 0.80, colour: [230, 208, 148] },
    Planet { name: "Uranus", distance: 19.19, mass: 14.5, radius: 0.55, colour: [150, 214, 220] },
    Planet { name: "Neptune", distance: 30.07, mass: 17.1, radius: 0.53, colour: [86, 116, 220] },
];

/// Labels: the planets in their order, then the sun.
const LABELS: [Label; PLANETS.len() + 1] = {
    let mut labels = [Label::painted("Sun", [250, 204, 90]); PLANETS.len() + 1];
    let mut place = 0;
    while place < PLANETS.len() {
        labels[place] = Label::painted(PLANETS[place].name, PLANETS[place].colour);
        place += 1;
    }
    labels
};

/// Radius of the Earth's orbit here, m.
const EARTH_ORBIT: f32 = 4.0;
/// The Earth's year here, s.
pub const YEAR: f32 = 8.0;
/// G times the mass of the sun, m³/s²: what gives the Earth its year, GM = r³ (2π / T)².
pub const GM: f32 = {
    let turn_rate = core::f32::consts::TAU / YEAR;
    EARTH_ORBIT * EARTH_ORBIT * EARTH_ORBIT * turn_rate * turn_rate
};
/// Speed of the Earth in the sky, km/s.
const EARTH_SPEED: f32 = 29.78;

impl Planet {
    /// Radius of its orbit here, m.
    pub fn orbit(&self) -> f32 {
        EARTH_ORBIT * self.distance.sqrt()
    }

    /// Its speed here, m/s.
    pub fn speed(&self) -> f32 {
        (GM / self.orbit()).sqrt()
    }
}

/// A planet's body carries its label; the attractor sits in the sun.
fn build(_seed: u64, settings: Settings) -> World {
    let mut world = World::new(settings);
    put_attractor(&mut world, GM, None);
    let sun = Body::fixed(Shape::circle(1.2)).material(Material::STONE);
    put(&mut world, Mark::label(PLANETS.len()).on(sun));
    for (place, planet) in PLANETS.iter().enumerate() {
        // Spread over the sky by the golden angle, 137.5°, so that names do not meet.
        let place_in_orbit = Rot::from_angle(2.4 * place as f32);
        let body = Body::dynamic(Shape::circle(planet.radius))
            .mass(planet.mass)
            .at(place_in_orbit.rotate(Vec2::new(planet.orbit(), 0.0)))
            .velocity(place_in_orbit.rotate(Vec2::new(0.0, planet.speed())));
        put(&mut world, Mark::label(place).on(body));
    }
    world
}

/// Speed of the planet with this name, m/s, as measured in the world; `None` where it has been removed.
pub fn speed(world: &World, name: &str) -> Option<f32> {
    let place = PLANETS.iter().position(|planet| planet.name == name)?;
    let (_, body) = world.bodies().find(|&(_, body)| Mark::of(body) == Mark::label(place))?;
    Some(body.velocity().length())
}

/// v falls with √r, and √r here with ⁴√r of the sky: speeds there are the squares of speeds here.
fn readout(world: &World) -> String {
    let years = world.time() / f64::from(YEAR);
    let earth = PLANETS[2].speed();
    match speed(world, "Jupiter") {
        Some(speed) => {
            let in_the_sky = EARTH_SPEED * (speed / earth) * (speed / earth);
            format!(
                "Jupiter flies at {speed:.3} m/s, in the sky at {in_the_sky:.2} km/s; the Earth has made {years:.1} turns"
            )
        }
        None => format!("Jupiter is gone; the Earth has made {years:.1} turns"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Angle and radius of every planet, rad and m.
    fn orbits(world: &World) -> Vec<(f32, f64)> {
        let planets = world.bodies().skip(1);
        planets
            .map(|(_, body)| {
                let [x, y] = body.position_f64();
                (rustycs::math::trig::atan2(y as f32, x as f32), (x * x + y * y).sqrt())
            })
            .collect()
    }

    /// A circle at one radius is a solution of every step that keeps energy and angular momentum. The error of
    /// a step, (w h)² / 24 of the pull, makes an ellipse of it: 1e-3 for Mercury at 0.3 rad a tick.
    #[test]
    fn planets_keep_their_distances_for_hours() {
        let mut world = SCENE.build(1, Settings::default());
        let mut angles: Vec<f32> = orbits(&world).iter().map(|orbit| orbit.0).collect();
        let mut turned = [0.0_f64; PLANETS.len()];
        // Two hours: 1,840 orbits of Mercury, 70 of Neptune.
        for tick in 0..432_000 {
            world.step();
            // Mercury turns by a sixth in forty ticks.
            if tick % 40 != 0 {
                continue;
            }
            for (place, (angle, radius)) in orbits(&world).into_iter().enumerate() {
                let planet = PLANETS[place];
                let ratio = radius / f64::from(planet.orbit());
                assert!(
                    (ratio - 1.0).abs() < 0.01,
                    "{} is at {ratio} of its orbit, tick {tick}",
                    planet.name
                );
                turned[place] += f64::from(Rot::from_angle(angle - angles[place]).angle());
                angles[place] = angle;
            }
        }
        // Kepler: T = 2π √(r³ / GM).
        for (planet, turned) in PLANETS.iter().zip(turned) {
            let rate = f64::from(planet.speed() / planet.orbit());
            let ratio = turned / (rate * world.time());
            assert!((ratio - 1.0).abs() < 1e-2, "{} has turned by {turned} rad: {ratio}", planet.name);
            let speed = speed(&world, planet.name).expect("no planet was removed");
            assert!((speed / planet.speed() - 1.0).abs() < 0.01, "{} at {speed} m/s", planet.name);
        }
    }

    /// Jupiter in the sky: 13.06 km/s (NASA planetary fact sheet).
    #[test]
    fn the_speed_of_jupiter_is_read_from_the_world() {
        let mut world = SCENE.build(1, Settings::default());
        world.step();
        assert!(readout(&world).contains("in the sky at 13.0"), "{}", readout(&world));
        let (id, _) = world.bodies().nth(5).expect("Jupiter is the fifth after the sun");
        assert_eq!(speed(&world, "Jupiter"), world.body(id).map(|body| body.velocity().length()));
        world.remove(id);
        assert_eq!(speed(&world, "Jupiter"), None);
    }
}
