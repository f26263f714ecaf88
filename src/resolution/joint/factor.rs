//! Sparse factorization A = L D Lᵀ of the rows of some joints, A = J M⁻¹ Jᵀ + softness.
//!
//! Row by row (T. Davis, "Algorithm 849: a concise sparse Cholesky factorization package", 2005): the numbers of a row of L
//! are found along the elimination tree. Where joints form a tree there is no fill, and the work is that of the number of joints.
//!
//! A row that others already hold has a pivot by what it yields. One that has none left even so gets no impulse of its own.

/// The end of a path in the elimination tree.
const ROOT: u32 = u32::MAX;

/// A pivot that is a smaller share of its row is rounding: two rows of one direction, whose anchors are known to the seven
/// digits of `f32`, leave 10⁻¹⁴; a weight of 50,000 times its chain leaves 10⁻⁷.
const NO_PIVOT: f64 = 1e-11;

/// Structure of a factorization, and its numbers.
#[derive(Debug, Default)]
pub(super) struct Factor {
    /// For each row, in the order of elimination, where its entries begin in `columns`: those left of the diagonal.
    starts: Vec<u32>,
    columns: Vec<u32>,
    parent: Vec<u32>,
    /// For each column of L, where it begins and how many entries it has got.
    l_starts: Vec<u32>,
    l_counts: Vec<u32>,
    l_rows: Vec<u32>,
    l: Vec<f64>,
    d: Vec<f64>,
    flags: Vec<u32>,
    path: Vec<u32>,
    y: Vec<f64>,
    /// Right-hand side, then solution, in the order of elimination.
    pub(super) x: Vec<f64>,
}

clone_into_buffers!(Factor { starts, columns, parent, l_starts, l_counts, l_rows, l, d, flags, path, y, x });

impl Factor {
    /// Takes up the structure: for each row, the columns left of its diagonal that it shares a body with. Returns about how many
    /// multiplications a factorization takes.
    pub(super) fn new(rows: &[Vec<u32>]) -> (Self, u64) {
        let n = rows.len();
        let mut factor = Self { starts: vec![0], flags: vec![ROOT; n], path: vec![0; n], ..Self::default() };
        factor.parent = vec![ROOT; n];
        let mut counts = vec![0_u32; n];
        for (row, columns) in rows.iter().enumerate() {
            factor.columns.extend(columns);
            factor.starts.push(factor.columns.len() as u32);
            factor.flags[row] = row as u32;
            for &column in columns {
                let mut at = column as usize;
                while factor.flags[at] != row as u32 {
                    if factor.parent[at] == ROOT {
                        factor.parent[at] = row as u32;
                    }
                    counts[at] += 1;
                    factor.flags[at] = row as u32;
                    at = factor.parent[at] as usize;
                }
            }
        }
        factor.l_starts.push(0);
        let mut work = 0;
        for &count in &counts {
            work += u64::from(count) * u64::from(count + 2);
            factor.l_starts.push(factor.l_starts[factor.l_starts.len() - 1] + count);
        }
        let entries = factor.l_starts[n] as usize;
        (factor.l_counts, factor.l_rows, factor.l) = (vec![0; n], vec![0; entries], vec![0.0; entries]);
        (factor.d, factor.y, factor.x) = (vec![0.0; n], vec![0.0; n], vec![0.0; n]);
        (factor, work)
    }

    /// Finds L and D. `entry` gives the number at a row and a column that is not right of it.
    pub(super) fn factorize(&mut self, entry: impl Fn(usize, usize) -> f64) {
        let n = self.d.len();
        self.l_counts.fill(0);
        self.flags.fill(ROOT);
        for row in 0..n {
            let diagonal = entry(row, row);
            if diagonal <= 0.0 {
                // It takes no part.
                self.d[row] = f64::INFINITY;
                continue;
            }
            let mut top = n;
            self.flags[row] = row as u32;
            for at in self.starts[row]..self.starts[row + 1] {
                let mut column = self.columns[at as usize] as usize;
                self.y[column] += entry(row, column);
                let mut length = 0;
                while self.flags[column] != row as u32 {
                    self.path[length] = column as u32;
                    length += 1;
                    self.flags[column] = row as u32;
                    column = self.parent[column] as usize;
                }
                while length > 0 {
                    (top, length) = (top - 1, length - 1);
                    self.path[top] = self.path[length];
                }
            }
            let pivot = self.eliminate(row, top, diagonal);
            // An infinite pivot leaves the row without an impulse, and without a say in others.
            self.d[row] = if pivot > NO_PIVOT * diagonal { pivot } else { f64::INFINITY };
        }
    }

    /// Finds a row of L, along the path from `top` on; returns what is left of the diagonal.
    fn eliminate(&mut self, row: usize, top: usize, diagonal: f64) -> f64 {
        let mut pivot = diagonal;
        for place in top..self.d.len() {
            let column = self.path[place] as usize;
            let y = std::mem::replace(&mut self.y[column], 0.0);
            // Nothing is left of it, or never was where that row takes no part.
            if y == 0.0 {
                continue;
            }
            let (start, end) = (self.l_starts[column], self.l_starts[column] + self.l_counts[column]);
            for at in start as usize..end as usize {
                self.y[self.l_rows[at] as usize] -= self.l[at] * y;
            }
            let l = y / self.d[column];
            pivot -= l * y;
            self.l_rows[end as usize] = row as u32;
            self.l[end as usize] = l;
            self.l_counts[column] += 1;
        }
        pivot
    }

    /// Solves A x = b, where `x` holds b.
    pub(super) fn solve(&mut self) {
        let n = self.d.len();
        let entries = |column: usize| {
            let start = self.l_starts[column] as usize;
            start..start + self.l_counts[column] as usize
        };
        for column in 0..n {
            let x = self.x[column];
            for at in entries(column) {
                self.x[self.l_rows[at] as usize] -= self.l[at] * x;
            }
        }
        for column in (0..n).rev() {
            let mut x = self.x[column] / self.d[column];
            for at in entries(column) {
                x -= self.l[at] * self.x[self.l_rows[at] as usize];
            }
            // A row without a pivot has none from the rows after it either.
            self.x[column] = if self.d[column].is_finite() { x } else { 0.0 };
        }
    }
}
