//! Progress of a picture that is being painted.

/// Receives how much of a picture is painted. It is called from any thread and has no influence on
/// the result, unless it stops it.
pub trait BandProgress: Sync {
    /// Painting begins; it has this many parts.
    fn begin(&self, parts: u64);

    /// One more part is painted.
    fn done(&self);

    /// True if no more parts are to be painted; the others stay empty.
    fn is_stopped(&self) -> bool {
        false
    }
}

/// Progress is not reported.
impl BandProgress for () {
    fn begin(&self, _parts: u64) {}
    fn done(&self) {}
}
