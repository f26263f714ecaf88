//! Islands: which bodies are connected by touching contacts, found by union-find.
//!
//! Bodies that nothing moves (fixed, kinematic) do not connect: two stacks on one floor are two islands.

/// A forest over numbers 0 .. n; each tree is an island (R. Tarjan, 1975; path halving, union by smaller
/// root, so that the result does not depend on the order of unions).
#[derive(Clone, Debug, Default)]
pub(crate) struct Islands {
    parent: Vec<u32>,
}

impl Islands {
    /// Starts with `count` islands of one member each.
    pub(crate) fn reset(&mut self, count: usize) {
        self.parent.clear();
        self.parent.extend(0..count as u32);
    }

    /// The smallest member of the island of `member`, which names the island.
    pub(crate) fn root(&mut self, mut member: u32) -> u32 {
        while self.parent[member as usize] != member {
            let grandparent = self.parent[self.parent[member as usize] as usize];
            self.parent[member as usize] = grandparent;
            member = grandparent;
        }
        member
    }

    /// Makes one island of the islands of two members.
    pub(crate) fn union(&mut self, a: u32, b: u32) {
        let (a, b) = (self.root(a), self.root(b));
        self.parent[a.max(b) as usize] = a.min(b);
    }
}
