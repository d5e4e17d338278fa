//! Contours of faces and wires, in one table.

use std::ops::Range;

use super::ids::VertexId;

/// Lists of vertices, all in one buffer.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Contours {
    corners: Vec<VertexId>,
    ends: Vec<u32>,
}

impl Contours {
    /// Appends a contour; its row is [`Contours::len`] before the call.
    pub fn push(&mut self, corners: impl IntoIterator<Item = VertexId>) {
        self.corners.extend(corners);
        let end = u32::try_from(self.corners.len()).expect("fewer than 2^32 corners");
        self.ends.push(end);
    }

    /// Appends a corner to the contour that [`Contours::end_contour`] will end.
    pub fn push_corner(&mut self, corner: VertexId) {
        self.corners.push(corner);
    }

    /// Ends a contour of single corners.
    pub fn end_contour(&mut self) {
        self.push([]);
    }

    /// Removes all but the first `rows` contours, and the corners of an unfinished one.
    pub fn truncate(&mut self, rows: usize) {
        self.ends.truncate(rows);
        self.corners.truncate(self.ends.last().map_or(0, |&end| end as usize));
    }

    /// Corners of all contours.
    pub fn all_corners_mut(&mut self) -> &mut Vec<VertexId> {
        &mut self.corners
    }

    /// Empty, with room for so many corners and contours.
    pub fn with_capacity(corners: usize, contours: usize) -> Self {
        Self { corners: Vec::with_capacity(corners), ends: Vec::with_capacity(contours) }
    }

    /// Total number of corners.
    pub fn corner_count(&self) -> usize {
        self.corners.len()
    }

    /// Appends the contours of a face and returns their rows.
    pub fn push_all<C>(&mut self, contours: impl IntoIterator<Item = C>) -> Range<u32>
    where
        C: IntoIterator<Item = VertexId>,
    {
        let first = self.row_count();
        contours.into_iter().for_each(|contour| self.push(contour));
        first..self.row_count()
    }

    /// The vertices of contour `row`.
    #[inline]
    pub fn get(&self, row: u32) -> &[VertexId] {
        self.corners(row..row + 1)
    }

    /// The contours of a face or wire, in order.
    pub fn iter(&self, rows: Range<u32>) -> impl ExactSizeIterator<Item = &[VertexId]> + Clone {
        (rows.start as usize..rows.end as usize).map(|row| self.get(row as u32))
    }

    /// Position of the first corner of contour `row` among those of all contours.
    pub fn first_corner(&self, row: u32) -> usize {
        if row == 0 { 0 } else { self.ends[row as usize - 1] as usize }
    }

    /// The corner at position `idx` among those of all contours.
    pub fn corner(&self, idx: usize) -> VertexId {
        self.corners[idx]
    }

    /// All corners of a face or wire, contour after contour.
    #[inline]
    pub fn corners(&self, rows: Range<u32>) -> &[VertexId] {
        &self.corners[self.first_corner(rows.start)..self.first_corner(rows.end)]
    }

    /// All corners of a face or wire, mutable.
    pub fn corners_mut(&mut self, rows: Range<u32>) -> &mut [VertexId] {
        let places = self.first_corner(rows.start)..self.first_corner(rows.end);
        &mut self.corners[places]
    }

    /// Number of contours.
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// True if there are no contours.
    pub fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

    /// Number of contours, which is the row of the next.
    pub fn row_count(&self) -> u32 {
        u32::try_from(self.ends.len()).expect("fewer than 2^32 contours")
    }
}
