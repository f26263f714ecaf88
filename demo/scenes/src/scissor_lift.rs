//! A scissor lift with a load.

use rustycs::{Body, BodyId, Joint, JointId, Material, Settings, Shape, Vec2, World};

use crate::joined::{GHOST, bar, join, largest_gap};
use crate::parts::{put, put_floor, world_with_gravity};
use crate::{Scene, View};

/// A scissor lift with a load.
pub const SCENE: Scene = Scene {
    name: "scissor_lift",
    group: "joints",
    summary: "One slider below lifts crates eight metres: six bars, ten hinges, and the platform stays level.",
    view: View::above(-0.8, 0.0, 22.0, 15.0),
    build,
    before_tick: Some(run),
    played: Some(played),
    readout: Some(readout),
    hint: Some("← lowers it, → lifts it."),
    ..Scene::PLAIN
};

const PAIRS: usize = 3;
/// Half of the distance of the feet at first, and half of the height of a pair, m.
const HALF_WIDTH: f32 = 2.6;
const HALF_HEIGHT: f32 = 0.6;
/// Where the lower hinges are, m above the floor.
const BASE: f32 = 0.4;
/// How far the slider goes, m, how fast, m/s, and the greatest force, N.
const TRAVEL: f32 = 2.0;
const SPEED: f32 = 0.15;
const FORCE: f32 = 60_000.0;
/// What the joint of the slider is marked with: whether it lifts.
const LIFTS: u64 = 1;
const LOWERS: u64 = 2;

fn build(_seed: u64, settings: Settings) -> World {
    let mut world = world_with_gravity(settings);
    let floor = put_floor(&mut world, 40.0, 1.0);
    let corner =
        |side: f32, level: usize| Vec2::new(side * HALF_WIDTH, BASE + 2.0 * HALF_HEIGHT * level as f32);
    // The bars that end on the left and on the right of a level, from below.
    let mut ends: Option<[BodyId; 2]> = None;
    for level in 0..PAIRS {
        let [rising, falling] = [1.0, -1.0].map(|side| {
            put(&mut world, bar(corner(-side, level), corner(side, level + 1), 0.16).filter(GHOST))
        });
        let middle = Vec2::new(0.0, corner(0.0, level).y + HALF_HEIGHT);
        join(&mut world, Joint::revolute(rising, falling).at(middle));
        let feet = [(rising, -1.0), (falling, 1.0)];
        match ends {
            Some(below) => {
                for (below, (above, side)) in below.into_iter().zip(feet) {
                    join(&mut world, Joint::revolute(below, above).at(corner(side, level)));
                }
            }
            None => put_base(&mut world, floor, [rising, falling], [corner(-1.0, 0), corner(1.0, 0)]),
        }
        ends = Some([falling, rising]);
    }
    let top = [-1.0, 1.0].map(|side| corner(side, PAIRS));
    if let Some(ends) = ends {
        put_platform(&mut world, ends, top);
    }
    world
}

/// The left foot turns on the floor, the right one on a slider that a motor drives.
fn put_base(world: &mut World, floor: BodyId, bars: [BodyId; 2], feet: [Vec2; 2]) {
    join(world, Joint::revolute(floor, bars[0]).at(feet[0]));
    let slider = Body::dynamic(Shape::obb(0.6, 0.3)).at(feet[1]).material(Material::METAL).filter(GHOST);
    let slider = put(world, slider);
    join(world, Joint::revolute(slider, bars[1]).at(feet[1]));
    let slide = Joint::prismatic(floor, slider).at(feet[1]).axis([1.0, 0.0]).limits(-TRAVEL..=0.0);
    join(world, slide.motor(-SPEED, FORCE).user_data(LIFTS));
}

/// A platform on the two upper ends, one of which slides along it, and crates on it.
fn put_platform(world: &mut World, ends: [BodyId; 2], top: [Vec2; 2]) {
    let above = Vec2::new(0.0, top[0].y + 0.3);
    let platform = Body::dynamic(Shape::obb(6.4, 0.3)).at(above).material(Material::PLASTIC).filter(GHOST);
    let platform = put(world, platform.friction(0.8));
    join(world, Joint::revolute(platform, ends[0]).at(top[0]));
    // A pin in a slot: the axis is that of the platform.
    join(world, Joint::wheel(platform, ends[1]).at(top[1]).axis([1.0, 0.0]));
    for (x, size) in [(-1.6, 1.2), (0.0, 1.0), (1.7, 1.4)] {
        let place = above + Vec2::new(x, 0.15 + 0.5 * size);
        let crate_ = Body::dynamic(Shape::obb(size, size)).at(place).material(Material::STONE);
        put(world, crate_.restitution(0.0));
    }
}

fn slide(world: &World) -> Option<JointId> {
    world.joints().find(|(_, joint)| joint.user_data() != 0).map(|(id, _)| id)
}

/// Up, and down again.
fn run(world: &mut World) {
    let Some(mut slide) = slide(world).and_then(|id| world.joint_mut(id)) else { return };
    let at = slide.view().translation();
    let direction = match slide.view().user_data() {
        LIFTS if at < 0.02 - f64::from(TRAVEL) => LOWERS,
        LOWERS if at > -0.02 => LIFTS,
        same => same,
    };
    slide.set_user_data(direction);
    slide.set_motor(if direction == LIFTS { -SPEED } else { SPEED }, FORCE);
}

fn played(world: &mut World, [lowers, lifts]: [bool; 2]) {
    let speed = SPEED * (f32::from(u8::from(lowers)) - f32::from(u8::from(lifts)));
    if let Some(mut slide) = slide(world).and_then(|id| world.joint_mut(id)) {
        slide.set_motor(speed, FORCE);
    }
}

fn readout(world: &World) -> String {
    let slide = slide(world).and_then(|id| world.joint(id));
    let force = slide.map_or(0.0, |slide| slide.force().x.abs());
    format!("the slider pushes with {:.1} kN, largest gap {:.4} mm", 1e-3 * force, 1e3 * largest_gap(world))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing;

    /// The platform, the last body but the three crates, rises by metres, and is never off the level by more than a hundredth of a
    /// degree.
    #[test]
    fn the_platform_rises_and_stays_level() {
        let mut world = SCENE.build(1, Settings::default());
        let platform = world.bodies().map(|(id, _)| id).nth(2 * PAIRS + 2).expect("there is a platform");
        let start = world.body(platform).expect("it is there").position().y;
        let mut highest = start;
        for _ in 0..1_200 {
            testing::run(&SCENE, &mut world, 1);
            let body = world.body(platform).expect("it is there");
            highest = highest.max(body.position().y);
            assert!(body.angle().abs() < 2e-4, "{} rad at {} s", body.angle(), world.time());
        }
        assert!(highest > start + 5.0, "from {start} to {highest} m");
    }
}
