//! The engines pass, and engines that are set up wrongly do not.

use super::PROOFS;
use crate::engine::{Engine, Fineness};
use crate::engines::{self, Misled};
use crate::scene::{BodySpec, Kind, Scene};

/// The claims that do not hold for an engine.
fn failures(engine: &dyn Engine) -> Vec<String> {
    let failed = PROOFS.iter().filter(|proof| !proof.holds((proof.deviation)(engine)));
    failed.map(|proof| format!("{}: {}", engine.name(), proof.claim)).collect()
}

#[test]
fn every_engine_solves_the_same_problem() {
    let failed: Vec<_> = engines::all().iter().flat_map(|engine| failures(&**engine)).collect();
    assert!(failed.is_empty(), "{failed:#?}");
}

#[test]
fn box2d_is_compiled_for_a_fair_race() {
    engines::fair_box2d().unwrap();
}

/// Fails unless the proofs notice, with every engine.
fn is_noticed(mislead: fn(&mut Scene, &mut Fineness)) {
    for engine in engines::all() {
        let engine = Misled { engine, mislead };
        assert!(!failures(&engine).is_empty(), "{}", engine.name());
    }
}

fn every_body(scene: &mut Scene, change: fn(&mut BodySpec)) {
    scene.bodies.iter_mut().for_each(change);
}

#[test]
fn a_wrong_density_is_noticed() {
    is_noticed(|scene, _| every_body(scene, |body| body.density *= 1.01));
}

#[test]
fn a_wrong_friction_is_noticed() {
    is_noticed(|scene, _| every_body(scene, |body| body.friction *= 1.05));
}

#[test]
fn friction_mixed_by_average_is_noticed() {
    is_noticed(|scene, _| {
        let sum: f64 = scene.bodies.iter().map(|body| body.friction).sum();
        let average = sum / scene.bodies.len() as f64;
        scene.bodies.iter_mut().for_each(|body| body.friction = average);
    });
}

#[test]
fn a_wrong_restitution_is_noticed() {
    is_noticed(|scene, _| every_body(scene, |body| body.restitution *= 0.9));
}

#[test]
fn a_wrong_gravity_is_noticed() {
    is_noticed(|scene, _| scene.gravity[1] *= 1.01);
}

#[test]
fn a_wrong_pull_is_noticed() {
    is_noticed(|scene, _| scene.pull.iter_mut().for_each(|pull| pull.strength *= 1.05));
}

#[test]
fn a_wrong_tick_rate_is_noticed() {
    is_noticed(|_, fineness| fineness.tick_rate *= 1.001);
}

#[test]
fn substeps_that_do_not_arrive_are_noticed() {
    is_noticed(|_, fineness| fineness.substeps = 4);
}

#[test]
fn a_kinematic_body_that_is_pushed_away_is_noticed() {
    is_noticed(|scene, _| {
        every_body(scene, |body| {
            if body.kind == Kind::Kinematic {
                body.kind = Kind::Dynamic;
            }
        });
    });
}

#[test]
fn an_angle_of_the_wrong_sense_is_noticed() {
    is_noticed(|scene, _| every_body(scene, |body| body.angle = -body.angle));
}
