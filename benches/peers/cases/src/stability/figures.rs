//! Shapes.

use crate::chance::Chance;
use crate::scene::{BodySpec, Kind, Outline};

/// A body whose corners, counter-clockwise, are here, m.
pub(super) fn polygon(kind: Kind, corners: &[[f64; 2]]) -> BodySpec {
    let (mut area, mut moment) = (0.0, [0.0; 2]);
    let [ox, oy] = corners[0];
    for (&[ax, ay], &[bx, by]) in corners.iter().zip(corners.iter().cycle().skip(1)) {
        let (a, b) = ([ax - ox, ay - oy], [bx - ox, by - oy]);
        let twice = a[0] * b[1] - a[1] * b[0];
        area += 0.5 * twice;
        moment = [0, 1].map(|axis| moment[axis] + twice * (a[axis] + b[axis]) / 6.0);
    }
    let [x, y] = [ox + moment[0] / area, oy + moment[1] / area];
    let outline = Outline::Polygon(corners.iter().map(|corner| [corner[0] - x, corner[1] - y]).collect());
    BodySpec { position: [x, y], ..BodySpec::new(kind, outline) }
}

/// A box, a disc or a polygon of up to eight corners, with this radius, m.
pub(super) fn any(chance: &mut Chance, radius: f64) -> BodySpec {
    let outline = match chance.one_of(3) {
        0 => Outline::Circle { radius },
        1 => {
            let slant = chance.between(0.4, 1.1_f64);
            Outline::Box { width: 2.0 * radius * slant.cos(), height: 2.0 * radius * slant.sin() }
        }
        _ => Outline::regular(3 + chance.one_of(6), radius),
    };
    BodySpec { angle: chance.between(-3.0, 3.0), ..BodySpec::new(Kind::Dynamic, outline) }
}
