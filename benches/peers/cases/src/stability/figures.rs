//! Shapes, and numbers by chance.

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

/// A regular polygon.
pub(super) fn regular(corners: u32, radius: f64) -> Outline {
    let corner = |index: u32| {
        let angle = std::f64::consts::TAU * f64::from(index) / f64::from(corners);
        [radius * angle.cos(), radius * angle.sin()]
    };
    Outline::Polygon((0..corners).map(corner).collect())
}

/// Numbers as if by chance, the same on every machine. (S. Vigna, "splitmix64", 2015.)
#[derive(Clone, Copy, Debug)]
pub(super) struct Chance(pub(super) u64);

impl Chance {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut word = self.0;
        word = (word ^ (word >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        word = (word ^ (word >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        word ^ (word >> 31)
    }

    /// From one number up to another, that one left out.
    pub(super) fn between(&mut self, from: f64, to: f64) -> f64 {
        from + (to - from) * ((self.next() >> 11) as f64 / (1_u64 << 53) as f64)
    }

    /// One of so many, from 0.
    pub(super) fn one_of(&mut self, count: u32) -> u32 {
        self.between(0.0, f64::from(count)) as u32
    }
}

/// A box, a disc or a polygon of up to eight corners, with this radius, m.
pub(super) fn any(chance: &mut Chance, radius: f64) -> BodySpec {
    let outline = match chance.one_of(3) {
        0 => Outline::Circle { radius },
        1 => {
            let slant = chance.between(0.4, 1.1_f64);
            Outline::Box { width: 2.0 * radius * slant.cos(), height: 2.0 * radius * slant.sin() }
        }
        _ => regular(3 + chance.one_of(6), radius),
    };
    BodySpec { angle: chance.between(-3.0, 3.0), ..BodySpec::new(Kind::Dynamic, outline) }
}
