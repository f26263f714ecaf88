//! Chance in scenes: numbers, shapes and materials drawn from a seed.
//!
//! Random numbers come from xoshiro256++ (Blackman and Vigna 2018, <https://prng.di.unimi.it>), which `rand`
//! offers under its own name: unlike `StdRng` and `SmallRng` it never becomes another algorithm, it works on
//! 64-bit integers only, and it needs none of the crate's features. A float is its upper bits times a power of
//! two, which rounds nowhere, so a seed gives the same bodies on every machine.

use rand::rngs::Xoshiro256PlusPlus;
use rand::{RngExt, SeedableRng};
use rustycs::{Material, Rot, Shape, Vec2};

use crate::parts::MATERIALS;

/// A source of random numbers: the same seed, the same numbers.
#[derive(Debug)]
pub(crate) struct Random(Xoshiro256PlusPlus);

impl Random {
    pub(crate) fn new(seed: u64) -> Self {
        Self(Xoshiro256PlusPlus::seed_from_u64(seed))
    }

    /// A number from `low` to below `high`.
    pub(crate) fn between(&mut self, low: f32, high: f32) -> f32 {
        self.0.random_range(low..high)
    }

    /// A whole number below `limit`.
    pub(crate) fn below(&mut self, limit: u32) -> u32 {
        self.0.random_range(0..limit)
    }

    /// An angle of the full turn, rad.
    pub(crate) fn angle(&mut self) -> f32 {
        self.between(0.0, core::f32::consts::TAU)
    }

    pub(crate) fn material(&mut self) -> Material {
        MATERIALS[self.below(MATERIALS.len() as u32) as usize]
    }

    /// A disc, a box or a polygon that fits into a circle of a radius (m) from `low` to `high`.
    pub(crate) fn shape(&mut self, [low, high]: [f32; 2]) -> Shape {
        let radius = self.between(low, high);
        match self.below(3) {
            0 => Shape::circle(radius),
            1 => {
                // Half the angle between the diagonals: 26° is twice as wide as high, 45° a square.
                let Rot { c, s } = Rot::from_angle(self.between(0.46, core::f32::consts::FRAC_PI_4));
                Shape::obb(2.0 * radius * c, 2.0 * radius * s)
            }
            _ => self.polygon(radius),
        }
    }

    /// A polygon with 3 to 8 corners on a circle, which makes it convex, none of them close to another.
    fn polygon(&mut self, radius: f32) -> Shape {
        let corners = 3 + self.below(6);
        let pitch = core::f32::consts::TAU / corners as f32;
        let points: Vec<Vec2> = (0..corners)
            .map(|corner| {
                let angle = pitch * (corner as f32 + self.between(-0.25, 0.25));
                Rot::from_angle(angle).rotate(Vec2::new(radius, 0.0))
            })
            .collect();
        let convex = |points: Vec<Vec2>| {
            Shape::polygon(points)
                .expect("corners on a circle, a quarter of the pitch off at most, are convex")
        };
        // The centroid is not quite the middle of the circle; about it, too, the farthest corner is at
        // `radius`.
        let shape = convex(points);
        let scale = radius / shape.extent();
        convex(shape.vertices().iter().map(|&vertex| vertex * scale).collect())
    }
}
