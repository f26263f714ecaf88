//! Any use of the public API with any numbers: no panic, no number that is not finite, and tables that agree.

#![no_main]

use arbitrary::Arbitrary;
use libfuzzer_sys::fuzz_target;
use rustycs::prelude::*;

#[derive(Arbitrary, Debug)]
struct Description {
    kind: u8,
    outline: u8,
    size: [f32; 2],
    place: [f64; 2],
    angle: f32,
    velocity: [f32; 2],
    spin: f32,
    density: f32,
    surface: [f32; 2],
}

impl Description {
    fn body(&self) -> Option<Body> {
        let [width, height] = self.size;
        let shape = match self.outline % 6 {
            0 => Shape::circle(width),
            1 => Shape::aabb(width, height),
            2 => Shape::obb(width, height),
            3 => Shape::capsule([0.0, 0.0], [width, 0.0], height),
            4 => Shape::rounded([[0.0, 0.0], [width, 0.0], [width, height]], 0.5 * height).ok()?,
            _ => Shape::polygon([[0.0, 0.0], [width, 0.0], [width, height], [0.0, 0.5 * height]]).ok()?,
        };
        let body = match self.kind % 4 {
            0 => Body::fixed(shape),
            1 => Body::kinematic(shape),
            _ => Body::dynamic(shape),
        };
        let body = body.at(self.place).angle(self.angle).velocity(self.velocity).angular_velocity(self.spin);
        Some(body.density(self.density).friction(self.surface[0]).restitution(self.surface[1]))
    }
}

#[derive(Arbitrary, Debug)]
enum Use {
    Add(Description),
    /// The same in small numbers, where bodies meet.
    AddNear(Description),
    Remove(u8),
    Push(u8, [f32; 2], [f64; 2]),
    Turn(u8, f32),
    Move(u8, [f64; 2]),
    Gravity([f32; 2]),
    Attract([f64; 2], f32),
    Tune { tick_rate: f32, substeps: u32, switches: u8 },
    Bound([f32; 4]),
    Step(u8),
    Clone,
}

/// A number into ±5, whatever it is.
fn small(value: f32) -> f32 {
    if value.is_finite() { value % 5.0 } else { 1.0 }
}

fuzz_target!(|uses: Vec<Use>| {
    let mut world = World::new(Settings::default());
    let mut ids: Vec<BodyId> = Vec::new();
    let mut steps = 0_u32;
    for one in uses.iter().take(60) {
        let id = |number: &u8| ids.get(*number as usize % ids.len().max(1)).copied();
        match one {
            Use::Add(description) if ids.len() < 60 => ids.extend(description.body().and_then(|body| world.add(body).ok())),
            Use::AddNear(description) if ids.len() < 60 => {
                let near = Description {
                    size: description.size.map(|side| 0.2 + small(side).abs() * 0.3),
                    place: description.place.map(|x| f64::from(small(x as f32))),
                    angle: small(description.angle),
                    velocity: description.velocity.map(small),
                    spin: small(description.spin),
                    density: 0.1 + small(description.density).abs() * 20.0,
                    surface: description.surface.map(|value| small(value).abs() * 0.2),
                    ..*description
                };
                ids.extend(near.body().and_then(|body| world.add(body).ok()));
            }
            Use::Add(_) | Use::AddNear(_) => (),
            Use::Remove(number) => drop(id(number).and_then(|id| world.remove(id))),
            Use::Push(number, impulse, at) => {
                if let Some(mut body) = id(number).and_then(|id| world.body_mut(id)) {
                    body.apply_impulse_at(*impulse, *at);
                }
            }
            Use::Turn(number, spin) => {
                if let Some(mut body) = id(number).and_then(|id| world.body_mut(id)) {
                    body.set_angular_velocity(*spin);
                }
            }
            Use::Move(number, place) => {
                if let Some(mut body) = id(number).and_then(|id| world.body_mut(id)) {
                    _ = body.set_position(*place);
                }
            }
            Use::Gravity(acceleration) => {
                if let Ok(force) = Force::try_new("fuzz", *acceleration) {
                    world.add_force(force);
                }
            }
            Use::Attract(at, mass) => {
                if let Ok(attractor) = Attractor::try_new(*at, *mass, None) {
                    world.add_attractor(attractor);
                }
            }
            Use::Tune { tick_rate, substeps, switches } => {
                let [sleep, adaptive, warm_starting, recycling] = [0, 1, 2, 3].map(|bit| switches >> bit & 1 == 1);
                let substeps = substeps % 17;
                let settings = Settings {
                    tick_rate: *tick_rate,
                    substeps,
                    sleep,
                    adaptive,
                    warm_starting,
                    recycling,
                    ..world.settings().clone()
                };
                _ = world.set_settings(settings);
            }
            Use::Bound([left, low, right, high]) => {
                let bounds = Some(Aabb::new(Vec2::new(*left, *low), Vec2::new(*right, *high)));
                _ = world.set_settings(Settings { bounds, ..world.settings().clone() });
            }
            Use::Step(count) => {
                for _ in 0..count % 30 {
                    if steps < 200 {
                        steps += 1;
                        world.step();
                    }
                }
            }
            Use::Clone => world = world.clone(),
        }
        world.validate().unwrap();
    }
});
