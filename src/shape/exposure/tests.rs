//! Exposures by hand: tiles, steps, blocks, shared corners, ridges, and lines beside them.

use super::*;
use crate::math::Rot;
use crate::shape::exposure::neighbour::Place;

fn beside(hull: &Hull, center: [f32; 2]) -> Neighbour {
    Neighbour::still(*hull, Place { rotation: Rot::IDENTITY, center: center.into() })
}

/// Whether a contact at a place counts, with a normal at an angle from upwards to the left, rad.
fn allows(exposure: &Exposure, hull: &Hull, angle: f32, place: [f32; 2]) -> bool {
    let Rot { c, s } = Rot::from_angle(angle);
    let (normal, place) = (Vec2::new(-s, c), Vec2::from(place));
    exposure.allows(hull, normal, [place].into_iter(), place + normal, false)
}

const LEFT: f32 = core::f32::consts::FRAC_PI_2;

#[test]
fn between_tiles_nothing_can_be_touched_and_on_top_only_from_above() {
    let tile = Hull::rectangle(Vec2::new(0.5, 0.5));
    assert_eq!(Exposure::new(&tile, None, &[]), None);
    assert_eq!(Exposure::new(&tile, None, &[beside(&tile, [-1.1, 0.0])]), None, "a gap of 10 cm");
    let middle =
        Exposure::new(&tile, None, &[beside(&tile, [-1.0, 0.0]), beside(&tile, [1.0, 0.0])]).unwrap();
    assert_eq!([0, 1, 2, 3].map(|face| middle.is_exposed(face)), [true, false, true, false]);
    assert!(!allows(&middle, &tile, LEFT, [-0.5, 0.49]), "the side");
    assert!(allows(&middle, &tile, 0.0, [-0.5, 0.5]) && allows(&middle, &tile, 0.01, [-0.5, 0.5]));
    assert!(!allows(&middle, &tile, 0.3, [-0.5, 0.5]) && !allows(&middle, &tile, -0.3, [0.5, 0.5]));
    let end = Exposure::new(&tile, None, &[beside(&tile, [1.0, 0.0])]).unwrap();
    assert!(allows(&end, &tile, LEFT, [-0.5, 0.49]) && allows(&end, &tile, 0.7, [-0.5, 0.5]));
    assert!(!allows(&end, &tile, -LEFT, [0.5, 0.49]));
}

/// Its bevels are shorter than tiles may be apart.
#[test]
fn a_shape_without_neighbours_is_exposed_however_short_its_faces_are() {
    let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-0.9996, 1.0], [-1.0, 0.9996]];
    let hull = Hull::new(&corners.map(Vec2::from));
    assert_eq!(Exposure::new(&hull, None, &[]), None);
}

#[test]
fn a_step_of_a_centimetre_has_a_side_and_one_of_less_than_a_gap_has_none() {
    let tile = Hull::rectangle(Vec2::new(0.5, 0.5));
    let above = |step: f32| Exposure::new(&tile, None, &[beside(&tile, [-1.0, -step])]).unwrap();
    assert!(allows(&above(0.01), &tile, LEFT, [-0.5, 0.495]));
    assert!(allows(&above(0.01), &tile, 0.7, [-0.5, 0.5]), "and a corner");
    assert!(!allows(&above(0.01), &tile, LEFT, [-0.5, 0.3]), "but not below the step");
    assert!(!allows(&above(0.0005), &tile, LEFT, [-0.5, 0.4999]));
    // Where the neighbour stands higher, there is no corner to meet.
    assert!(!allows(&above(-0.01), &tile, 0.7, [-0.5, 0.5]));
}

/// A floor under a block bears up to the block, however far that is overlapped there: both sides of it are exposed.
#[test]
fn the_floor_beside_a_block_bears_up_to_the_block() {
    let (floor, block) = (Hull::rectangle(Vec2::new(10.0, 0.5)), Hull::rectangle(Vec2::new(1.0, 1.0)));
    assert_eq!(Exposure::new(&floor, None, &[beside(&block, [3.0, 1.5])]), None);
    let at_end = Exposure::new(&floor, None, &[beside(&block, [9.0, 1.5])]).unwrap();
    for (at, bears) in [(-9.0, true), (7.9, true), (8.0005, true), (8.5, false)] {
        assert_eq!(allows(&at_end, &floor, 0.0, [at, 0.5]), bears, "at {at} m");
    }
    let of_block = Exposure::new(&block, None, &[beside(&floor, [-3.0, -1.5])]).unwrap();
    assert!(!allows(&of_block, &block, core::f32::consts::PI, [0.0, -1.0]), "below it is the floor");
    assert!(allows(&of_block, &block, LEFT, [-1.0, -0.999]));
}

/// An outline of two pieces, whose common face ends at an outer corner: the corner is met as that of the whole outline, also
/// where the outline turns by a right angle or more.
#[test]
fn a_corner_that_two_pieces_share_is_that_of_the_outline() {
    // The corner is the origin. One edge goes up; the other comes from the right, and turns with the angle.
    for turn in [0.3, 1.2, LEFT, 2.2, 2.8] {
        let ray = |angle: f32, length: f32| Rot::from_angle(angle).rotate(Vec2::new(length, 0.0));
        let interior = core::f32::consts::PI - turn;
        let inner = ray(LEFT - 0.5 * interior, 1.0);
        let left = Hull::new(&[Vec2::ZERO, inner, ray(LEFT, 1.0)]);
        let right = Hull::new(&[Vec2::ZERO, ray(LEFT - interior, 1.0), inner]);
        let exposure = Exposure::new(&left, None, &[beside(&right, [0.0, 0.0])]).unwrap();
        // Outwards of the upright edge is to the left; from there the normals turn counter-clockwise.
        for (share, counts) in [(0.1, true), (0.5, true), (0.9, true), (1.2, false), (1.5, false)] {
            let angle = LEFT + share * turn;
            assert_eq!(allows(&exposure, &left, angle, [0.0, 0.0]), counts, "{turn}: {share}");
        }
    }
}

/// A flat edge of pieces that meet in a point of it, with faces that go down from there at all angles.
#[test]
fn covered_faces_make_no_ridge_of_a_flat() {
    let ray = |angle: f32| Rot::from_angle(angle).rotate(Vec2::new(1.0, 0.0));
    let angles = [LEFT, 1.3 * LEFT, 1.8 * LEFT, 2.2 * LEFT, 2.6 * LEFT, 3.0 * LEFT];
    let pieces: Vec<Hull> = angles
        .windows(2)
        .map(|pair| Hull::new(&[Vec2::ZERO, ray(pair[0] + LEFT), ray(pair[1] + LEFT)]))
        .collect();
    for (index, piece) in pieces.iter().enumerate() {
        let others: Vec<Neighbour> = (0..pieces.len())
            .filter(|&other| other != index)
            .map(|other| beside(&pieces[other], [0.0, 0.0]))
            .collect();
        let exposure = Exposure::new(piece, None, &others).unwrap();
        for angle in [-1.0, -0.3, 0.3, 1.0] {
            // The ends of the flat are corners, and may be met as such.
            if index == 0 && angle > 0.0 || index + 1 == pieces.len() && angle < 0.0 {
                continue;
            }
            assert!(!allows(&exposure, piece, angle, [0.0, 0.0]), "piece {index} at {angle}");
        }
    }
}

/// Where a slope falls away from a flat, the ridge may be met from between the two.
#[test]
fn a_ridge_is_met_from_between_its_slopes() {
    let flat = Hull::rectangle(Vec2::new(2.0, 0.5));
    let slope = Rot::from_angle(0.5);
    // The upper right corner of the slope is the upper left one of the flat.
    let center = Vec2::new(-2.0, 0.5) - slope.rotate(Vec2::new(2.0, 0.5));
    let neighbour = Neighbour::still(flat, Place { rotation: slope, center });
    let exposure = Exposure::new(&flat, None, &[neighbour]).unwrap();
    for (angle, counts) in [(0.0, true), (0.25, true), (0.5, true), (0.6, false), (LEFT, false)] {
        assert_eq!(allows(&exposure, &flat, angle, [-2.0, 0.5]), counts, "{angle} rad");
    }
}
