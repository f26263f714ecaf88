//! rustycs beside Box2D and Rapier: error, stability and speed, in one process.

mod engine;
mod engines;
mod scene;

use engine::Fineness;
use scene::{BodySpec, Kind, Outline, Scene};

fn main() {
    println!("{:?}", engines::fair_build());
    let ball =
        BodySpec { position: [0.0, 2.0], ..BodySpec::new(Kind::Dynamic, Outline::Circle { radius: 0.5 }) };
    let floor = BodySpec::new(Kind::Fixed, Outline::Box { width: 10.0, height: 1.0 });
    let scene = Scene { bodies: vec![ball, floor], gravity: [0.0, -9.81], pull: None };
    for engine in engines::all() {
        let mut world = engine.simulate(&scene, Fineness { tick_rate: 60.0, substeps: 4 });
        for _ in 0..120 {
            world.step();
        }
        println!("{} {:?} {}", engine.version(), world.state(0), world.contact_points());
    }
}
