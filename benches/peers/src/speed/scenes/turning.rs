//! Drums that turn and never let their load rest.

use std::f64::consts::{PI, TAU};

use super::{Course, Drum, dynamic, square};
use crate::scene::{BodySpec, Outline, Scene, on_earth};

/// 25 degrees a second, rad/s.
const SPIN: f64 = 25.0 * PI / 180.0;

pub(super) fn races() -> [Course; 2] {
    let (tumbler, its_drum) = tumbler();
    let (washer, washers_drum) = washer();
    [
        Course {
            drum: Some(its_drum),
            ..Course::race(
                "tumbler",
                "45 × 45 boxes of 0.25 m in a hollow drum, 20 m square, that turns by 25 degrees a second.",
                tumbler,
                750,
            )
        },
        Course {
            drum: Some(washers_drum),
            ..Course::race(
                "washer",
                "90 × 90 boxes of 0.2 m in a round drum of 16 m with four paddles that turns by 25 degrees a second.",
                washer,
                500,
            )
        },
    ]
}

fn tumbler() -> (Scene, Drum) {
    let drum = Drum { axis: [0.0, 10.0], spin: SPIN };
    let [long, thick] = [20.0, 1.0];
    let wall = |x: f64, y: f64| {
        let [width, height] = if x == 0.0 { [long + thick, thick] } else { [thick, long + thick] };
        drum.part(Outline::Box { width, height }, [10.0 * x, 10.0 + 10.0 * y], 0.0)
    };
    let mut bodies = vec![wall(1.0, 0.0), wall(-1.0, 0.0), wall(0.0, 1.0), wall(0.0, -1.0)];
    grid(45, 0.4, 0.25, 10.0, &mut bodies);
    (on_earth(bodies), drum)
}

/// Boxes in rows and columns about (0, `middle`), m.
fn grid(count: usize, spacing: f64, side: f64, middle: f64, bodies: &mut Vec<BodySpec>) {
    let place = |index: usize| (index as f64 - 0.5 * (count - 1) as f64) * spacing;
    for row in 0..count {
        for column in 0..count {
            bodies.push(dynamic(square(side), [place(column), middle + place(row)]));
        }
    }
}

fn washer() -> (Scene, Drum) {
    let drum = Drum { axis: [0.0, 16.0], spin: -SPIN };
    let staves = 36;
    let [paddle, inner, outer] = [14.0, 16.0, 18.0];
    let mut bodies = Vec::new();
    // A stave is a trapezium; neighbours overlap by a little, so that nothing falls through the seam.
    let mut add = |from: f64, to: f64, half: f64, angle: f64| {
        let corner = |radius: f64, side: f64| [radius * half.cos(), side * radius * half.sin()];
        let mut corners = vec![corner(from, -1.0), corner(to, -1.0), corner(to, 1.0), corner(from, 1.0)];
        let (low, high) = (corners[0][1].abs(), corners[1][1].abs());
        let (bottom, height) = (corners[0][0], corners[1][0] - corners[0][0]);
        // Centre of mass of a trapezium whose parallel sides are `2 low` and `2 high` long.
        let middle = bottom + height / 3.0 * (low + 2.0 * high) / (low + high);
        for corner in &mut corners {
            corner[0] -= middle;
        }
        let place = [drum.axis[0] + middle * angle.cos(), drum.axis[1] + middle * angle.sin()];
        bodies.push(drum.part(Outline::Polygon(corners), place, angle));
    };
    for stave in 0..staves {
        let angle = f64::from(stave) * TAU / f64::from(staves);
        let half = 0.5 * TAU / f64::from(staves);
        add(inner, outer, 1.2 * half, angle);
        if stave % 9 == 0 {
            add(paddle, inner, half, angle);
        }
    }
    grid(90, 0.21, 0.2, 16.0, &mut bodies);
    (on_earth(bodies), drum)
}
