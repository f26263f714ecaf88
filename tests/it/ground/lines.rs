//! Lines beside other ground: chains and segments that are flush with boxes, and with each other, are one ground with them.

use rustycs::prelude::*;

use super::chains::{height_of, shapes};
use crate::support::{G, add, assert_near, earth_with, place, space, velocity};

/// Greatest upward speed that a seam of what is flush may give, m/s.
const KICK: f64 = 1e-3;

/// Largest difference of speed at the end, as a share of the speed at the beginning.
const LOSS: f64 = 1e-4;

/// A box of 40 m with its upper right corner in a place.
fn box_up_to(x: f64, y: f64) -> Body {
    Body::fixed(Shape::rectangle(40.0, 1.0)).at([x - 20.0, y - 0.5])
}

/// The same with its upper left corner there.
fn box_from(x: f64, y: f64) -> Body {
    Body::fixed(Shape::rectangle(40.0, 1.0)).at([x + 20.0, y - 0.5])
}

/// A segment, with its ends in two places.
fn segment(a: [f32; 2], b: [f32; 2]) -> Body {
    let Shape::Segment(line) = Shape::segment(a, b) else { unreachable!("a segment") };
    Body::fixed(Shape::Segment(line)).at(line.centroid_of_input())
}

/// Floors up to 0 and from 4 m on, and what is between them.
fn floors() -> Vec<(&'static str, Vec<Body>)> {
    let chain = |points: &[[f32; 2]]| Ground::chain(points.iter().copied()).unwrap();
    let between =
        |ground: Vec<Body>| [box_up_to(0.0, 0.0), box_from(4.0, 0.0)].into_iter().chain(ground).collect();
    vec![
        ("a chain between boxes", between(vec![chain(&[[0.0, 0.0], [1.0, 0.0], [4.0, 0.0]])])),
        (
            "two chains between boxes",
            between(vec![chain(&[[0.0, 0.0], [1.5, 0.0]]), chain(&[[1.5, 0.0], [4.0, 0.0]])]),
        ),
        ("a segment between boxes", between(vec![segment([0.0, 0.0], [4.0, 0.0])])),
        (
            "a segment and a chain",
            between(vec![segment([0.0, 0.0], [2.0, 0.0]), chain(&[[2.0, 0.0], [4.0, 0.0]])]),
        ),
        (
            "segments",
            (-40..40)
                .map(|number| f32::from(number as i8))
                .map(|x| segment([x, 0.0], [x + 1.0, 0.0]))
                .collect(),
        ),
    ]
}

/// Lets a body slide without friction, and returns its greatest upward speed and its velocity at the end, m/s.
fn slide(shape: Shape, ground: Vec<Body>, [x, y]: [f64; 2], speed: f32, restitution: f32) -> ([f64; 2], f64) {
    let mut world = earth_with(Settings::default());
    for body in ground {
        add(&mut world, body.friction(0.0).restitution(restitution));
    }
    let body = Body::dynamic(shape).at([x, y + height_of(&shape)]).velocity([speed, 0.0]);
    let id = add(&mut world, body.friction(0.0).restitution(restitution));
    let mut kick = 0.0_f64;
    for _ in 0..((8.0 / speed.abs()).min(4.0) * 60.0) as u32 {
        world.step();
        kick = kick.max(velocity(&world, id)[1]);
    }
    (velocity(&world, id), kick)
}

#[test]
fn what_slides_over_lines_and_boxes_does_not_feel_where_they_meet() {
    for (ground, bodies) in floors() {
        for (name, shape) in shapes() {
            for (speed, restitution) in [(2.0, 0.0), (2.0, 0.5), (5.0, 0.0), (20.0, 0.0), (20.0, 0.5)] {
                for (x, speed) in [(-1.77, speed), (5.77, -speed)] {
                    let ([vx, _], kick) = slide(shape, bodies.clone(), [x, 0.0], speed, restitution);
                    let what = format!("{name} at {speed} m/s, restitution {restitution}, over {ground}");
                    assert!(kick <= KICK, "{what}: kicked up at {kick:e} m/s");
                    let loss = 1.0 - vx / f64::from(speed);
                    assert!(loss.abs() <= LOSS, "{what}: {vx} m/s at the end");
                }
            }
        }
    }
}

#[test]
fn a_step_of_a_centimetre_at_the_end_of_a_line_stops_a_box() {
    let chain = || Ground::chain([[-20.0, 0.0], [0.0, 0.0]]).unwrap();
    for line in [chain(), segment([-20.0, 0.0], [0.0, 0.0])] {
        let ground = vec![line, box_from(0.0, 0.01)];
        let ([vx, _], _) = slide(Shape::aabb(1.0, 1.0), ground, [-2.0, 0.0], 5.0, 0.0);
        assert!(vx.abs() < 1e-3, "{vx} m/s");
    }
}

/// Frictionless, up a slope of a line onto a box and off it down another: the speed follows from the height; what flies off the crest
/// comes down again on the box.
#[test]
fn slopes_of_lines_go_over_into_boxes() {
    let slope = [[-10.0, -1.0], [0.0, 0.0]];
    for (name, shape) in shapes().into_iter().filter(|(name, _)| *name == "disc" || *name == "capsule") {
        for line in [Ground::chain(slope).unwrap(), segment(slope[0], slope[1])] {
            let mut world = earth_with(Settings::default());
            add(&mut world, line.friction(0.0).restitution(0.0));
            add(&mut world, box_from(0.0, 0.0).friction(0.0).restitution(0.0));
            let height = height_of(&shape) / 0.995 + 0.01;
            let (direction, angle) = ([6.0 * 0.995_04, 6.0 * 0.099_504], 0.099_669);
            let body = Body::dynamic(shape).at([-5.0, -0.5 + height]).velocity(direction).angle(angle);
            let id = add(&mut world, body.friction(0.0).restitution(0.0));
            for _ in 0..120 {
                world.step();
            }
            assert!(place(&world, id)[0] > 2.0, "{name} came to {:?}", place(&world, id));
            // The blow as it comes down takes what it falls with, never what it goes along with.
            let rise = place(&world, id)[1] - (-0.5 + height);
            let least = (36.0 - 2.0 * G * (rise + 0.05)).sqrt() * 0.99;
            assert!(velocity(&world, id)[0] >= least, "{name}: {:?} m/s of {least}", velocity(&world, id));
        }
    }
}

/// Down a slope of a segment that begins at an upper corner of a box, and over the box: of the speed it loses what goes into the box, as
/// the ground turns by the angle of the slope. The same at both corners.
#[test]
fn a_slope_that_rises_from_a_corner_of_a_box_goes_over_into_it() {
    let angle = 0.1_f32;
    let (run, rise) = (10.0 * Rot::from_angle(angle).c, up_to(10.0, angle));
    for (name, shape) in
        [("disc", Shape::circle(0.3)), ("capsule", Shape::capsule([-0.3, 0.0], [0.3, 0.0], 0.2))]
    {
        let mut speeds = [0.0; 2];
        for (side, speed) in [1.0_f32, -1.0].into_iter().zip(&mut speeds) {
            let mut world = earth_with(Settings::default());
            let slab = if side > 0.0 { box_up_to(0.0, 0.0) } else { box_from(0.0, 0.0) };
            add(&mut world, slab.friction(0.0).restitution(0.0));
            let slope = segment([0.0, 0.0], [side * run, rise]);
            add(&mut world, slope.friction(0.0).restitution(0.0));
            let up = Rot::from_angle(side * angle).rotate(Vec2::new(side * 5.0, height_of(&shape) as f32));
            let body = Body::dynamic(shape).at([f64::from(up.x), f64::from(up.y)]).angle(side * angle);
            let id = add(&mut world, body.friction(0.0).restitution(0.0));
            for _ in 0..360 {
                world.step();
            }
            assert!(f64::from(-side) * place(&world, id)[0] > 1.0, "{name} {side}: {:?}", place(&world, id));
            *speed = velocity(&world, id)[0].abs();
        }
        // It is half its length before the corner where its front meets the box.
        let highest = (2.0 * G * f64::from(up_to(5.0, angle))).sqrt();
        let least =
            (2.0 * G * f64::from(up_to(4.0, angle))).sqrt() * f64::from(Rot::from_angle(angle).c).powi(2);
        for speed in speeds {
            assert!((least..=highest).contains(&speed), "{name}: {speed} of {least} to {highest} m/s");
        }
        assert_near(speeds[0], speeds[1], 1e-3 * speeds[0], "the same at both corners");
    }
}

/// How much higher a slope at an angle, rad, is after so much of it, m.
fn up_to(length: f32, angle: f32) -> f32 {
    length * Rot::from_angle(angle).s
}

/// Along its underside a line ends at the side of a box that it is flush with on top.
#[test]
fn what_is_behind_a_line_meets_the_side_of_the_box() {
    for line in [Ground::chain([[-20.0, 0.0], [0.0, 0.0]]).unwrap(), segment([-20.0, 0.0], [0.0, 0.0])] {
        let mut world = space();
        add(&mut world, line.friction(0.0).restitution(0.0));
        add(&mut world, box_from(0.0, 0.0).friction(0.0).restitution(0.0));
        let plank = Body::dynamic(Shape::rectangle(0.4, 0.04)).at([-2.0, -0.021]).velocity([3.0, 0.0]);
        let id = add(&mut world, plank.friction(0.0).restitution(0.0));
        for _ in 0..120 {
            world.step();
        }
        assert_near(place(&world, id)[0], -0.2, 5e-3, "it stops at the side");
        assert!(velocity(&world, id)[0].abs() < 1e-3);
    }
}

/// A line that is taken away, or moved, is no longer gone over from.
#[test]
fn edges_beside_lines_follow_edits() {
    let mut world = earth_with(Settings::default());
    let line = add(&mut world, Ground::chain([[-20.0, 0.0], [0.0, 0.0]]).unwrap().friction(0.0));
    add(&mut world, box_from(0.0, 0.0).friction(0.0).restitution(0.0));
    let slider = Body::dynamic(Shape::rectangle(1.0, 1.0)).friction(0.0).restitution(0.0);
    let goes_over = |world: &mut World| {
        let id = add(world, slider.clone().at([-1.0, 0.5]).velocity([4.0, 0.0]));
        for _ in 0..60 {
            world.step();
        }
        let x = place(world, id)[0];
        world.remove(id);
        x > 1.0
    };
    assert!(goes_over(&mut world));
    world.body_mut(line).unwrap().set_position([0.0, -0.05]).unwrap();
    assert!(!goes_over(&mut world), "there is a step now");
    world.body_mut(line).unwrap().set_position([0.0, 0.0]).unwrap();
    assert!(goes_over(&mut world));
    world.validate().unwrap();
}

/// An L of two pieces that share its outer corner, with a box of its mass that falls on its upright leg at an angle: it lies flat again, with its
/// centre of mass as high as follows from its areas, wherever the middle of the line is. A line has no inside by which its pieces could tell
/// where it is. To a millimetre: contacts sag by a tenth of that under it, and what is lost is metres below.
#[test]
fn a_corner_that_two_pieces_share_stays_on_a_line() {
    let (side, leg) = (0.5_f32, 0.175_f32);
    let outline = [[0.0, 0.0], [side, 0.0], [side, leg], [leg, leg], [leg, side], [0.0, side]];
    let areas = [side * leg, leg * (side - leg)].map(f64::from);
    let heights = [0.5 * leg, 0.5 * (leg + side)].map(f64::from);
    let height = (areas[0] * heights[0] + areas[1] * heights[1]) / (areas[0] + areas[1]);
    for middle in [-12.0, -0.3, 0.0, 0.3, 12.0] {
        let mut world = earth_with(Settings::default());
        add(&mut world, segment([middle - 20.0, 0.0], [middle + 20.0, 0.0]));
        let pieces = Body::dynamic_pieces(Shape::concave(outline).unwrap());
        let struck = add(&mut world, pieces.mass(1.0));
        let falling = Body::dynamic(Shape::rectangle(side, side)).at([0.25, 1.2]).angle(0.1);
        add(&mut world, falling.velocity([0.0, -3.0]).mass(1.0));
        for _ in 0..120 {
            world.step();
        }
        assert_near(place(&world, struck)[1], height, 1e-3, &format!("with its middle at {middle} m"));
    }
}
