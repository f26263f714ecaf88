//! A world that was restored into another one went on otherwise than its original, where joints had motors of bounded force: what the last step
//! had found of their islands was not restored.

use rand::rngs::Xoshiro256PlusPlus;
use rand::{RngExt, SeedableRng};
use rustycs::prelude::*;

use crate::support::add;

#[test]
fn a_world_restored_into_another_one_goes_on_as_its_original() {
    let mut random = Xoshiro256PlusPlus::seed_from_u64(3);
    let mut between = move |low: f32, high: f32| random.random_range(low..high);
    for world_number in 0..40 {
        let mut world = World::new(Settings::default());
        let a = add(&mut world, Body::dynamic(Shape::circle(0.5)));
        let thrown = Body::dynamic(Shape::circle(0.5)).at([1.5, 0.0]);
        let velocity = [between(-5.0, 5.0), between(-5.0, 5.0)];
        let b = add(&mut world, thrown.velocity(velocity).angular_velocity(between(-5.0, 5.0)));
        let (force, torque) = (
            10.0_f64.powf(f64::from(between(-3.0, 2.0))) as f32,
            10.0_f64.powf(f64::from(between(-4.0, 1.0))) as f32,
        );
        world.add_joint(Joint::motor_to(a, b).max_force(force).max_torque(torque)).unwrap();
        for tick in 0..100 {
            let mut restored = World::new(Settings::default());
            restored.clone_from(&world);
            world.step();
            restored.step();
            assert_eq!(world.state_hash(), restored.state_hash(), "world {world_number}, tick {tick}");
        }
    }
}
