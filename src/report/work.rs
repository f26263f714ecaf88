//! What a step cannot do without.

use crate::compute::Count;
use crate::resolution::work_of_a_substep;

/// What is done for something: the floor of its run time on a machine that does so many operations, or moves so many
/// bytes, in a second.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Work {
    /// Operations on numbers of `f32`: sums, products, quotients, roots, comparisons, choices.
    pub operations: u32,
    /// Bytes that are read from memory and written to it.
    pub bytes: u32,
}

impl Work {
    /// What a substep of the default settings does in its sweeps for one contact of two points with friction, counted
    /// by running them on numbers that count: a warm start and a sweep before the bodies move, and again after it.
    ///
    /// ```
    /// use rustycs::report::Work;
    ///
    /// let Work { operations, bytes } = Work::of_a_contact();
    /// // Each of the three passes reads the velocities of both bodies, and writes them.
    /// assert!(bytes > 3 * 2 * (16 + 16));
    /// // A number is computed with more than once for each time it is moved.
    /// assert!(operations > bytes / 4);
    /// ```
    pub fn of_a_contact() -> Self {
        let Count { operations, bytes } = work_of_a_substep();
        Self { operations, bytes }
    }
}
