//! A symmetric matrix of blocks, one row of them for each body, that is zero outside of its skyline; and its Cholesky factor.
//!
//! A row is kept from its first block that is not zero up to the diagonal. The factor L of A = L Lᵀ fills no place outside of that, so how
//! much work it is can be told from the order of the bodies alone (A. Jennings, 1966; A. George & J. Liu, "Computer Solution of Large
//! Sparse Positive Definite Systems", 1981, chapter 4).

/// What is between two bodies, of three velocities each, row by row. In `f64`: contacts are ten thousand times stiffer than masses
/// and masses may differ as much again, which leaves `f32` nothing.
pub(crate) type Block = [[f64; 3]; 3];

/// Multiplications of a product of two blocks.
const PRODUCT_OF_BLOCKS: u64 = 27;

/// Multiplications that the factorization of a matrix takes whose row i of blocks begins with column `first[i]`.
pub(crate) fn work_of_factorization(first: &[u32]) -> u64 {
    let of_row = |(row, &begin): (u32, &u32)| {
        // Each entry of a row takes the common part of two rows.
        let common = |column: u32| u64::from(column - begin.max(first[column as usize]) + 1);
        (begin..=row).map(common).sum::<u64>()
    };
    PRODUCT_OF_BLOCKS * (0..).zip(first).map(of_row).sum::<u64>()
}

/// The lower half of a symmetric matrix, then its factor L, with the reciprocals of its diagonal.
#[derive(Clone, Debug, Default)]
pub(crate) struct Skyline {
    /// Column of the first block of each row.
    first: Vec<u32>,
    /// Where each row begins in `blocks`.
    starts: Vec<u32>,
    blocks: Vec<Block>,
}

impl Skyline {
    /// Makes it a matrix of zeros, whose row i of blocks begins with column `first[i]`.
    pub(crate) fn reset(&mut self, first: impl Iterator<Item = u32>) {
        self.first.clear();
        self.first.extend(first);
        self.starts.clear();
        let mut end = 0;
        for (row, &first) in (0..).zip(&self.first) {
            debug_assert!(first <= row);
            self.starts.push(end);
            end += row - first + 1;
        }
        self.blocks.clear();
        self.blocks.resize(end as usize, Block::default());
    }

    /// How many rows of blocks it has.
    pub(crate) fn len(&self) -> usize {
        self.first.len()
    }

    /// The block in a row and a column, at or left of the diagonal.
    pub(crate) fn block_mut(&mut self, row: usize, column: usize) -> &mut Block {
        debug_assert!(column <= row && column >= self.first[row] as usize);
        &mut self.blocks[self.starts[row] as usize + (column - self.first[row] as usize)]
    }

    /// Adds a block in a row and a column; right of the diagonal it is added in the other half, transposed.
    pub(crate) fn add(&mut self, row: usize, column: usize, what: &Block) {
        let to = self.block_mut(row.max(column), row.min(column));
        for i in 0..3 {
            for j in 0..3 {
                to[i][j] += if row < column { what[j][i] } else { what[i][j] };
            }
        }
    }

    /// The blocks of a row that are left of the diagonal, and that on it.
    fn row(&self, row: usize) -> (&[Block], &Block) {
        let start = self.starts[row] as usize;
        let end = start + (row - self.first[row] as usize);
        (&self.blocks[start..end], &self.blocks[end])
    }

    /// Replaces the matrix, which must be positive definite, by its factor L.
    pub(crate) fn factorize(&mut self) {
        for row in 0..self.len() {
            let first = self.first[row] as usize;
            let (above, blocks) = self.blocks.split_at_mut(self.starts[row] as usize);
            for column in first..row {
                let first_of_column = self.first[column] as usize;
                let of_column = &above[self.starts[column] as usize..][..=column - first_of_column];
                let from = first.max(first_of_column);
                let (found, rest) = blocks.split_at_mut(column - first);
                let common = found[from - first..].iter().zip(&of_column[from - first_of_column..]);
                let block = common.fold(rest[0], |block, (left, right)| minus_product(block, left, right));
                rest[0] = block.map(|entries| forward(&of_column[column - first_of_column], entries));
            }
            let (found, rest) = blocks.split_at_mut(row - first);
            let diagonal = found.iter().fold(rest[0], |block, left| minus_product(block, left, left));
            rest[0] = factor(&diagonal, &rest[0]);
        }
    }

    /// Replaces b by the solution x of L Lᵀ x = b, after [`factorize`](Self::factorize).
    pub(crate) fn solve(&self, b: &mut [[f64; 3]]) {
        for row in 0..self.len() {
            let (blocks, diagonal) = self.row(row);
            let (before, rest) = b.split_at_mut(row);
            let mut left = rest[0];
            for (block, x) in blocks.iter().zip(&before[self.first[row] as usize..]) {
                for (left, entries) in left.iter_mut().zip(block) {
                    *left -= dot(entries, x);
                }
            }
            rest[0] = forward(diagonal, left);
        }
        for row in (0..self.len()).rev() {
            let (blocks, diagonal) = self.row(row);
            let (before, rest) = b.split_at_mut(row);
            let x = backward(diagonal, rest[0]);
            rest[0] = x;
            for (block, b) in blocks.iter().zip(&mut before[self.first[row] as usize..]) {
                for (b, product) in b.iter_mut().zip(transposed_times(block, &x)) {
                    *b -= product;
                }
            }
        }
    }
}

#[inline(always)]
fn dot(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Aᵀ x.
#[inline(always)]
fn transposed_times(a: &Block, x: &[f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|column| a[0][column] * x[0] + a[1][column] * x[1] + a[2][column] * x[2])
}

/// C - A Bᵀ.
#[inline(always)]
fn minus_product(mut c: Block, a: &Block, b: &Block) -> Block {
    for (row, of_a) in c.iter_mut().zip(a) {
        for (entry, of_b) in row.iter_mut().zip(b) {
            *entry -= dot(of_a, of_b);
        }
    }
    c
}

/// L of a block A = L Lᵀ, with the reciprocals of its diagonal. A is what is left of a block of the matrix: less than a share of that is
/// rounding.
#[inline(always)]
fn factor(a: &Block, whole: &Block) -> Block {
    let reciprocal = |index: usize, pivot: f64| pivot.max(f64::EPSILON * whole[index][index]).sqrt().recip();
    let r_00 = reciprocal(0, a[0][0]);
    let [l_10, l_20] = [a[1][0] * r_00, a[2][0] * r_00];
    let r_11 = reciprocal(1, a[1][1] - l_10 * l_10);
    let l_21 = (a[2][1] - l_20 * l_10) * r_11;
    let r_22 = reciprocal(2, a[2][2] - l_20 * l_20 - l_21 * l_21);
    [[r_00, 0.0, 0.0], [l_10, r_11, 0.0], [l_20, l_21, r_22]]
}

/// x of L x = b.
#[inline(always)]
fn forward(l: &Block, b: [f64; 3]) -> [f64; 3] {
    let x = b[0] * l[0][0];
    let y = (b[1] - l[1][0] * x) * l[1][1];
    [x, y, (b[2] - l[2][0] * x - l[2][1] * y) * l[2][2]]
}

/// x of Lᵀ x = b.
#[inline(always)]
fn backward(l: &Block, b: [f64; 3]) -> [f64; 3] {
    let z = b[2] * l[2][2];
    let y = (b[1] - l[2][1] * z) * l[1][1];
    [(b[0] - l[1][0] * y - l[2][0] * z) * l[0][0], y, z]
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
            let count = 3 * size as usize;
            let mut full = vec![vec![0.0; count]; count];
            for row in 0..count {
                for column in 3 * first[row / 3] as usize..=row {
                    let value = if row == column { 30.0 } else { number() };
                    let block = matrix.block_mut(row / 3, column / 3);
                    block[row % 3][column % 3] = value;
                    if row / 3 == column / 3 {
                        block[column % 3][row % 3] = value;
                    }
                    (full[row][column], full[column][row]) = (value, value);
                }
            }
            let b: Vec<[f64; 3]> = (0..size).map(|_| [(); 3].map(|()| number())).collect();
            let mut x = b.clone();
            matrix.factorize();
            matrix.solve(&mut x);
            for (row, b) in full.iter().zip(b.as_flattened()) {
                let found: f64 = row.iter().zip(x.as_flattened()).map(|(entry, x)| entry * x).sum();
                assert!((found - b).abs() < 1e-13);
            }
        }
    }
}
