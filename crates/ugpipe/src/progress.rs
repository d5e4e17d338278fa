//! What a computation reports its progress to.

/// Receives the progress of a computation, from any thread. The result does not depend on it.
pub trait Progress: Sync {
    /// A step begins; the one before has ended. `parts`: the total that [`Progress::done`] counts up to; 0 if it is not called.
    fn step(&self, name: &'static str, parts: u64);

    /// This many more parts of the current step are done.
    fn done(&self, parts: u64);
}

/// Progress is not shown.
impl Progress for () {
    fn step(&self, _name: &'static str, _parts: u64) {}
    fn done(&self, _parts: u64) {}
}
