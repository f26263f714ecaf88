//! The tree's invariants, for tests and debug builds.

use super::{MAX_IMBALANCE, ROOT, Tree};

impl Tree {
    /// Checks every link, box and height. O(n).
    ///
    /// # Errors
    /// A sentence that names the first node found wrong.
    pub(crate) fn validate(&self) -> Result<(), String> {
        if self.node(ROOT).parent != ROOT {
            return Err("the root is not its own parent".into());
        }
        let mut leaves = 0;
        let mut inner = 0;
        let mut pending = if self.len() == 0 { vec![] } else { vec![ROOT] };
        while let Some(place) = pending.pop() {
            if self.node(place).is_leaf() {
                leaves += 1;
                self.validate_leaf(place)?;
            } else {
                inner += 1;
                self.validate_inner(place)?;
                pending.extend([self.node(place).link, self.node(place).link + 1]);
            }
        }
        let pairs = self.pairs.len() - 1 - self.free_pairs.len();
        if leaves != self.len() || inner != pairs {
            return Err(format!("{leaves} leaves of {} and {inner} pairs of {pairs} reached", self.len()));
        }
        Ok(())
    }

    fn validate_leaf(&self, place: u32) -> Result<(), String> {
        let leaf = self.node(place).link;
        if self.leaf_places.get(leaf as usize) == Some(&place) {
            Ok(())
        } else {
            Err(format!("leaf {leaf} at {place} is not where the table says"))
        }
    }

    fn validate_inner(&self, place: u32) -> Result<(), String> {
        let node = self.node(place);
        let [a, b] = self.pair(node.link);
        if !node.link.is_multiple_of(2) || a.parent != place || b.parent != place {
            return Err(format!("the children of {place} at {} do not point back", node.link));
        }
        if node.reach != a.reach.union(b.reach) {
            return Err(format!("the box of {place} is not the union of its children's"));
        }
        if node.height != 1 + a.height.max(b.height) || a.height.abs_diff(b.height) > MAX_IMBALANCE {
            return Err(format!(
                "{place} of height {} has children of {}, {}",
                node.height, a.height, b.height
            ));
        }
        Ok(())
    }
}
