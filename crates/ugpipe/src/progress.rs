//! The interface to which computations report progress, and by which a caller stops them.

use std::error::Error;
use std::fmt;

/// Receives progress reports of a computation, from any thread. They do not affect its result.
///
/// A caller stops a computation by [`Progress::is_stopped`]: long loops check it and give up, and
/// the function returns [`Stopped`] as its error.
pub trait Progress: Sync {
    /// Begins a step, which ends the previous one. `parts` is the total that [`Progress::done`]
    /// counts up to, or 0 if the step does not call it.
    fn step(&self, name: &'static str, parts: u64);

    /// Reports that `parts` more parts of the current step are done.
    fn done(&self, parts: u64);

    /// True if the computation is to give up. Once true, it stays true.
    fn is_stopped(&self) -> bool {
        false
    }

    /// `Ok` if the computation is to go on.
    ///
    /// # Errors
    /// [`Stopped`].
    fn check(&self) -> Result<(), Stopped> {
        if self.is_stopped() { Err(Stopped) } else { Ok(()) }
    }
}

/// Ignores all progress reports.
impl Progress for () {
    fn step(&self, _name: &'static str, _parts: u64) {}
    fn done(&self, _parts: u64) {}
}

/// The error of a computation that its caller stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stopped;

impl fmt::Display for Stopped {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("stopped before it was done")
    }
}

impl Error for Stopped {}
