//! Limits on the work of a figure, which can grow with the square of the number of faces.

use std::cell::Cell;

use crate::planar::Convex;

/// Counts steps up to a limit. A step is a comparison of two bounding boxes, or of a corner of a
/// polygon with a side of another.
#[derive(Debug)]
pub struct Work {
    done: Cell<u64>,
    most: u64,
}

impl Work {
    /// No steps yet of at most `most`.
    pub fn new(most: u64) -> Self {
        Self { done: Cell::new(0), most }
    }

    /// Counts steps.
    pub fn count(&self, steps: usize) {
        self.done.set(self.done.get().saturating_add(steps as u64));
    }

    /// Counts an intersection, difference or depth comparison of two polygons.
    pub fn count_pair(&self, one: &Convex, other: &Convex) {
        self.count(if one.is_apart(other) { 1 } else { one.corners.len() * other.corners.len() });
    }

    /// The steps counted.
    pub fn done(&self) -> u64 {
        self.done.get()
    }

    /// True if there are more steps than the limit.
    pub fn is_exceeded(&self) -> bool {
        self.done() > self.most
    }
}
