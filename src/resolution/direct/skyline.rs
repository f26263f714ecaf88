//! A symmetric matrix that is zero outside of its skyline, and its Cholesky factor.
//!
//! Row i is kept from its first entry that is not zero up to the diagonal. The factor L of A = L Lᵀ fills no place
//! outside of that, so how much work it is can be told from the order of the rows alone (A. Jennings, 1966;
//! A. George & J. Liu, "Computer Solution of Large Sparse Positive Definite Systems", 1981, chapter 4).

/// The lower half of a symmetric matrix, row by row, in `f64`: contacts are ten thousand times stiffer than masses
/// and masses may differ as much again, which leaves `f32` nothing.
#[derive(Clone, Debug, Default)]
pub(crate) struct Skyline {
    /// Column of the first entry of each row.
    first: Vec<u32>,
    /// Where the diagonal of each row is in `entries`.
    diagonal: Vec<u32>,
    entries: Vec<f64>,
}

impl Skyline {
    /// Makes it a matrix of zeros, whose row i begins with column `first[i]`.
    pub(crate) fn reset(&mut self, first: impl Iterator<Item = u32>) {
        self.first.clear();
        self.first.extend(first);
        self.diagonal.clear();
        let mut end = 0;
        for (row, &first) in self.first.iter().enumerate() {
            debug_assert!(first as usize <= row);
            end += row as u32 - first;
            self.diagonal.push(end);
            end += 1;
        }
        self.entries.clear();
        self.entries.resize(end as usize, 0.0);
    }

    /// How many rows it has.
    pub(crate) fn len(&self) -> usize {
        self.first.len()
    }

    /// Adds `value` in `row`, at or left of the diagonal.
    pub(crate) fn add(&mut self, row: usize, column: usize, value: f64) {
        debug_assert!(column <= row && column >= self.first[row] as usize);
        self.entries[self.diagonal[row] as usize - (row - column)] += value;
    }

    /// Adds `factor` times the product of a column of numbers and a row of them, with the upper left `corner` in this row and
    /// column; nothing beyond the diagonal.
    pub(crate) fn add_product(
        &mut self,
        [row, column]: [usize; 2],
        left: &[f64; 3],
        right: &[f64; 3],
        factor: f64,
    ) {
        for (row, left) in (row..).zip(left) {
            let end = self.diagonal[row] as usize + 1;
            let start = end - (row + 1 - column);
            for (entry, right) in self.entries[start..end].iter_mut().zip(right) {
                *entry += left * right * factor;
            }
        }
    }

    /// The entries of a row from column `from` up to, not including, column `to`.
    fn part(&self, row: usize, from: usize, to: usize) -> &[f64] {
        let diagonal = self.diagonal[row] as usize;
        &self.entries[diagonal - (row - from)..diagonal - (row - to)]
    }

    /// Replaces the matrix, which must be positive definite, by its factor L.
    pub(crate) fn factorize(&mut self) {
        for row in 0..self.len() {
            let first = self.first[row] as usize;
            let mut pivot = self.entries[self.diagonal[row] as usize];
            // What is left of less than this share is rounding.
            let smallest = f64::EPSILON * pivot;
            for column in first..row {
                let from = first.max(self.first[column] as usize);
                let sum = dot(self.part(row, from, column), self.part(column, from, column));
                let place = self.diagonal[row] as usize - (row - column);
                let entry = (self.entries[place] - sum) / self.entries[self.diagonal[column] as usize];
                self.entries[place] = entry;
                pivot -= entry * entry;
            }
            self.entries[self.diagonal[row] as usize] = pivot.max(smallest).sqrt();
        }
    }

    /// Replaces b by the solution x of L Lᵀ x = b, after [`factorize`](Self::factorize).
    pub(crate) fn solve(&self, b: &mut [f64]) {
        for row in 0..self.len() {
            let first = self.first[row] as usize;
            let sum = dot(self.part(row, first, row), &b[first..row]);
            b[row] = (b[row] - sum) / self.entries[self.diagonal[row] as usize];
        }
        for row in (0..self.len()).rev() {
            let first = self.first[row] as usize;
            let x = b[row] / self.entries[self.diagonal[row] as usize];
            b[row] = x;
            for (b, entry) in b[first..row].iter_mut().zip(self.part(row, first, row)) {
                *b -= x * entry;
            }
        }
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    // Four sums at a time, which do not wait for each other.
    let mut sums = [0.0; 4];
    let (a4, b4) = (a.chunks_exact(4), b.chunks_exact(4));
    let rest: f64 = a4.remainder().iter().zip(b4.remainder()).map(|(a, b)| a * b).sum();
    for (a, b) in a4.zip(b4) {
        for ((sum, a), b) in sums.iter_mut().zip(a).zip(b) {
            *sum += a * b;
        }
    }
    (sums[0] + sums[1]) + (sums[2] + sums[3]) + rest
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::Random;

    /// A x = b is checked with A itself. Diagonally dominant rows: condition numbers of a few tens, so the residual
    /// is rounding of 1e-16 times a few hundred.
    #[test]
    fn the_solution_satisfies_the_equations() {
        let mut random = Random(3);
        let mut number = move || f64::from(random.between(-1.0, 1.0));
        for size in [1, 2, 7, 40] {
            let first: Vec<u32> = (0..size).map(|row: u32| row.saturating_sub(row % 5)).collect();
            let mut matrix = Skyline::default();
            matrix.reset(first.iter().copied());
            let mut full = vec![vec![0.0; size as usize]; size as usize];
            for (row, &first) in first.iter().enumerate() {
                for entry in 0..=row - first as usize {
                    let (column, value) = (row - entry, if entry == 0 { 10.0 } else { number() });
                    matrix.add(row, column, value);
                    (full[row][column], full[column][row]) = (value, value);
                }
            }
            let b: Vec<f64> = (0..size).map(|_| number()).collect();
            let mut x = b.clone();
            matrix.factorize();
            matrix.solve(&mut x);
            for (row, b) in full.iter().zip(b) {
                assert!((dot(row, &x) - b).abs() < 1e-13);
            }
        }
    }
}
