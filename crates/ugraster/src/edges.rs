//! Crossings of a polygon's outline with rows of samples.

use crate::polygons::{Corner, first_center};

/// A crossing of an edge with a row of samples; the fields are those of a [`Corner`].
#[derive(Clone, Copy, Debug)]
pub struct Crossing<const N: usize> {
    pub x: f64,
    pub key: f64,
    pub values: [f64; N],
}

/// An edge that crosses at least one row; all its numbers are linear functions of the row.
#[derive(Clone, Copy, Debug)]
struct Edge<const N: usize> {
    first_row: u32,
    end_row: u32,
    /// Its upper end.
    top: Corner<N>,
    /// Change of x, key and values per row downwards.
    slope: Crossing<N>,
}

impl<const N: usize> Edge<N> {
    /// The edge between two corners, cut to the rows from `first_row` to `end_row`;
    /// `None` if it crosses none of them.
    ///
    /// It crosses row j if y₀ ≤ j + ½ < y₁. The upper end is the start whichever way the
    /// polygon winds, so both polygons at an edge compute the same bits.
    #[inline]
    fn between(a: &Corner<N>, b: &Corner<N>, first_row: u32, end_row: u32) -> Option<Self> {
        let (top, bottom) = if a.y < b.y { (a, b) } else { (b, a) };
        let first_row = first_center(top.y, end_row).max(first_row);
        let end_row = first_center(bottom.y, end_row);
        if first_row >= end_row {
            return None;
        }
        let per_row = 1.0 / (bottom.y - top.y);
        let slope = Crossing {
            x: (bottom.x - top.x) * per_row,
            key: (bottom.key - top.key) * per_row,
            values: std::array::from_fn(|i| (bottom.values[i] - top.values[i]) * per_row),
        };
        Some(Self { first_row, end_row, top: *top, slope })
    }

    #[inline]
    fn at_row(&self, row: u32) -> Crossing<N> {
        // From the end of the edge and never from the row above: the result must not depend on
        // where a band starts.
        let down = f64::from(row) + 0.5 - self.top.y;
        Crossing {
            x: self.top.x + down * self.slope.x,
            key: self.top.key + down * self.slope.key,
            values: std::array::from_fn(|i| self.top.values[i] + down * self.slope.values[i]),
        }
    }
}

/// Scan conversion with a list of the edges that cross the current row. Its buffers are reused from
/// polygon to polygon.
#[derive(Debug, Default)]
pub struct Scanner<const N: usize> {
    edges: Vec<Edge<N>>,
    /// First row and index of every edge, from above.
    order: Vec<(u32, u32)>,
    active: Vec<u32>,
    crossings: Vec<Crossing<N>>,
    /// Column and index of every crossing, from the left.
    columns: Vec<(f64, u32)>,
}

impl<const N: usize> Scanner<N> {
    /// Calls `span` with the row and both ends of every span of the polygon in the rows from
    /// `first_row` to `end_row`, by the even-odd rule.
    pub fn scan<'a>(
        &mut self,
        contours: impl Iterator<Item = &'a [Corner<N>]>,
        first_row: u32,
        end_row: u32,
        mut span: impl FnMut(u32, &Crossing<N>, &Crossing<N>),
    ) {
        self.collect_edges(contours, first_row, end_row);
        let Some(&(first_row, _)) = self.order.first() else { return };
        let (mut row, mut next) = (first_row, 0);
        self.active.clear();
        while next < self.order.len() || !self.active.is_empty() {
            while next < self.order.len() && self.order[next].0 == row {
                self.active.push(self.order[next].1);
                next += 1;
            }
            self.find_crossings(row);
            if let [a, b] = &self.crossings[..] {
                let (left, right) = if a.x > b.x { (b, a) } else { (a, b) };
                span(row, left, right);
            } else {
                for pair in self.columns.chunks_exact(2) {
                    let [left, right] =
                        [pair[0].1, pair[1].1].map(|idx| &self.crossings[idx as usize]);
                    span(row, left, right);
                }
            }
            row += 1;
            self.active.retain(|&edge| self.edges[edge as usize].end_row > row);
        }
    }

    fn collect_edges<'a>(
        &mut self,
        contours: impl Iterator<Item = &'a [Corner<N>]>,
        first_row: u32,
        end_row: u32,
    ) {
        self.edges.clear();
        for contour in contours {
            let Some(mut before) = contour.last() else { continue };
            for corner in contour {
                self.edges.extend(Edge::between(before, corner, first_row, end_row));
                before = corner;
            }
        }
        self.order.clear();
        self.order.extend((0..).zip(&self.edges).map(|(idx, edge)| (edge.first_row, idx)));
        sort_rows(&mut self.order);
    }

    fn find_crossings(&mut self, row: u32) {
        self.crossings.clear();
        self.crossings
            .extend(self.active.iter().map(|&edge| self.edges[edge as usize].at_row(row)));
        if self.crossings.len() != 2 {
            self.columns.clear();
            self.columns
                .extend((0..).zip(&self.crossings).map(|(idx, crossing)| (crossing.x, idx)));
            sort_columns(&mut self.columns);
        }
    }
}

/// Sorts edges, compiled once for any number of values. The index decides between equal rows.
fn sort_rows(order: &mut [(u32, u32)]) {
    order.sort_unstable();
}

/// Sorts crossings, compiled once for any number of values. Equal columns stay in order.
fn sort_columns(columns: &mut [(f64, u32)]) {
    columns.sort_by(|a, b| a.0.total_cmp(&b.0));
}
