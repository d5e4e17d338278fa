//! The maximum of any range of a list, in logarithmic time.

use core::ops::Range;

/// A binary tree whose leaves are the second half of the list; each parent has the maxima of its
/// two children.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct RangeMaximum(Vec<[f64; 2]>);

fn greater([a, b]: [f64; 2], [c, d]: [f64; 2]) -> [f64; 2] {
    [a.max(c), b.max(d)]
}

impl RangeMaximum {
    pub(super) fn new(values: Vec<[f64; 2]>) -> Self {
        let n = values.len();
        let mut tree = vec![[0.0; 2]; n];
        tree.extend(values);
        for parent in (1..n).rev() {
            tree[parent] = greater(tree[2 * parent], tree[2 * parent + 1]);
        }
        Self(tree)
    }

    /// The maxima of these rows; 0 if there are none.
    pub(super) fn of(&self, rows: Range<usize>) -> [f64; 2] {
        let n = self.0.len() / 2;
        let (mut low, mut high) = (rows.start + n, rows.end + n);
        let mut most = [0.0; 2];
        while low < high {
            if low % 2 == 1 {
                most = greater(most, self.0[low]);
                low += 1;
            }
            if high % 2 == 1 {
                high -= 1;
                most = greater(most, self.0[high]);
            }
            low /= 2;
            high /= 2;
        }
        most
    }
}
