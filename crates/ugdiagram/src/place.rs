//! Places in a diagram.

/// A place in a diagram: along its axis, and in time.
pub type DiagramPlace = [f64; 2];
