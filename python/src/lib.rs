//! x
use numpy as _;
use pyo3::prelude::*;
#[pymodule]
mod _core {}
