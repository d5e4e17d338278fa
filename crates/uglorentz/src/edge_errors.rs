//! The errors of a drawn edge.

/// The largest errors of a drawn edge.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Errors {
    /// Rule 1, radians.
    pub angle: f64,
    /// Rule 2.
    pub offset: f64,
    /// Rule 3; an upper bound.
    pub color: f64,
}
