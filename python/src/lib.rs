//! The compiled half of the Python package `uglorentz`.
//!
//! The package calls the functions of the programs. Its keyword arguments are their options: Python
//! turns them into the words of a command line ([`tools`] lists the options), and the programs
//! parse these. So an option that a program gains is a keyword of the package, and a picture has
//! the bytes of the shell pipe.
//!
//! ```text
//! Python: keywords → words ─┬─ scene, sky  read, move and colour
//!                           ├─ drawing     draw; files, arrays
//!                           └─ film        frames of a film
//!         arrays ────────────── physics    one formula for all rows
//! ```
//!
//! Computations run on a thread of their own without the interpreter lock ([`call`]), so that an
//! interrupt stops them.

mod call;
mod drawing;
mod error;
mod film;
mod physics;
mod scene;
mod sky;
mod tools;

use pyo3::prelude::*;

/// Scenes, pictures and formulas of the package `uglorentz`.
#[pymodule]
mod _core {
    #[pymodule_export]
    use super::drawing::Drawing;
    #[pymodule_export]
    use super::film::film;
    #[pymodule_export]
    use super::physics::physics;
    #[pymodule_export]
    use super::scene::{PyScene, text_from_arrays};
    #[pymodule_export]
    use super::sky::PySky;
    #[pymodule_export]
    use super::tools::{channels, example, examples, formats, options};
    use super::*;

    #[pymodule_init]
    fn init(_module: &Bound<'_, PyModule>) -> PyResult<()> {
        ugpipe::leave_signals();
        call::remember_process();
        Ok(())
    }
}
