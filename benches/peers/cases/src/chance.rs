//! Numbers by chance.

/// Numbers as if by chance, the same on every machine. (S. Vigna, "splitmix64", 2015.)
#[derive(Clone, Copy, Debug)]
pub struct Chance(
    /// What the numbers follow from.
    pub u64,
);

impl Chance {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut word = self.0;
        word = (word ^ (word >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        word = (word ^ (word >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        word ^ (word >> 31)
    }

    /// From one number up to another, that one left out.
    pub fn between(&mut self, from: f64, to: f64) -> f64 {
        from + (to - from) * ((self.next() >> 11) as f64 / (1_u64 << 53) as f64)
    }

    /// One of so many, from 0.
    pub fn one_of(&mut self, count: u32) -> u32 {
        self.between(0.0, f64::from(count)) as u32
    }
}
