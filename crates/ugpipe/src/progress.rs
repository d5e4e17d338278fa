//! The interface to which computations report progress.

/// Receives progress reports of a computation, from any thread. They do not affect its result.
pub trait Progress: Sync {
    /// Begins a step, which ends the previous one. `parts` is the total that [`Progress::done`]
    /// counts up to, or 0 if the step does not call it.
    fn step(&self, name: &'static str, parts: u64);

    /// Reports that `parts` more parts of the current step are done.
    fn done(&self, parts: u64);
}

/// Ignores all progress reports.
impl Progress for () {
    fn step(&self, _name: &'static str, _parts: u64) {}
    fn done(&self, _parts: u64) {}
}
