//! The formulas of `ugphysics`, each for all rows of arrays.

use std::sync::Arc;

use glam::DVec3;
use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::prelude::*;
use ugphysics::spectrum::{self, Spectrum};
use ugphysics::{self as p, Brightness, HyperbolicMotion, Lorentz, Velocity};
use ugpipe::Failure;

use crate::call::{self, Call};
use crate::error::{Refused, wrong};

/// One row of the arguments, read from left to right.
struct Row<'a> {
    columns: &'a [&'a [f64]],
    widths: &'a [usize],
    row: usize,
    next: usize,
}

impl Row<'_> {
    fn numbers<const N: usize>(&mut self) -> [f64; N] {
        let argument = self.next;
        self.next += 1;
        // A column of width 1 that stands for three is refused before.
        let width = self.widths[argument];
        std::array::from_fn(|idx| self.columns[argument][self.row * width + idx.min(width - 1)])
    }

    fn number(&mut self) -> f64 {
        self.numbers::<1>()[0]
    }

    fn vector(&mut self) -> DVec3 {
        DVec3::from_array(self.numbers())
    }

    fn velocity(&mut self) -> Result<Velocity, String> {
        Velocity::from_beta(self.vector()).map_err(|error| error.to_string())
    }
}

/// A formula: the widths of its arguments and of its result.
type Formula = (&'static [usize], usize, fn(&mut Row<'_>, &mut [f64]) -> Result<(), String>);

/// A formula whose result is a number.
macro_rules! number {
    ($widths:expr, $row:ident => $value:expr) => {
        numbers!($widths, 1, $row => [$value])
    };
}

/// A formula whose result is several numbers.
macro_rules! numbers {
    ($widths:expr, $n:expr, $row:ident => $value:expr) => {
        (&$widths, $n, |$row, out| {
            out.copy_from_slice(&$value);
            Ok(())
        })
    };
}

fn formula(name: &str) -> Option<Formula> {
    Some(match name {
        "contracted" => {
            numbers!([3, 3], 3, r => p::contracted(r.vector(), r.velocity()?).to_array())
        }
        "seen_position" => {
            numbers!([3, 3], 3, r => p::seen_position(r.vector(), r.velocity()?).to_array())
        }
        "emission_time" => number!([3, 3], r => p::seen_event(r.vector(), r.velocity()?).t),
        "rest_position" => {
            numbers!([3, 3], 3, r => p::rest_position(r.vector(), r.velocity()?).to_array())
        }
        "aberrate" => numbers!([3, 3], 3, r => p::aberrate(r.vector(), r.velocity()?).to_array()),
        "doppler_factor" => number!([3, 3], r => p::doppler_factor(r.vector(), r.velocity()?)),
        "compose" => {
            numbers!([3, 3], 3, r => p::compose(r.velocity()?, r.velocity()?).beta().to_array())
        }
        "wigner_rotation" => {
            numbers!([3, 3], 4, r => p::wigner_rotation(r.velocity()?, r.velocity()?).to_array())
        }
        "gamma" => number!([3], r => r.velocity()?.gamma()),
        "rapidity" => number!([3], r => r.velocity()?.rapidity()),
        "from_rapidity" => numbers!([3, 1], 3, r => {
            let made = Velocity::from_rapidity(r.vector(), r.number());
            made.map_err(|error| error.to_string())?.beta().to_array()
        }),
        "boost" => {
            // Rows of the matrix; glam has columns.
            numbers!([3], 16, r => Lorentz::boost(r.velocity()?).matrix().transpose().to_cols_array())
        }
        "wavelength_to_hue" => number!([1], r => p::wavelength_to_hue(r.number())),
        "hue_to_wavelength" => number!([1], r => p::hue_to_wavelength(r.number())),
        "attenuation" => number!([1], r => p::attenuation(r.number())),
        "brightness.report" => number!([1], r => Brightness::Report.factor(r.number())),
        "brightness.photon" => number!([1], r => Brightness::Photon.factor(r.number())),
        "brightness.bolometric" => number!([1], r => Brightness::Bolometric.factor(r.number())),
        "brightness.none" => number!([1], r => Brightness::None.factor(r.number())),
        "planck" => number!([1, 1], r => {
            let (wavelength_nm, kelvin) = (r.number(), r.number());
            if !(wavelength_nm > 0.0 && kelvin > 0.0) {
                return Err("wavelength and temperature must be above 0".to_owned());
            }
            spectrum::planck(wavelength_nm, kelvin)
        }),
        "daylight" => number!([1], r => spectrum::daylight(r.number())),
        "observer" => numbers!([1], 3, r => spectrum::observer(r.number())),
        "blackbody_xyz" => numbers!([1, 1], 3, r => {
            let (kelvin, doppler) = (r.number(), r.number());
            if !(kelvin > 0.0 && doppler > 0.0) {
                return Err("temperature and Doppler factor must be above 0".to_owned());
            }
            Spectrum::blackbody(kelvin, 1.0).seen(doppler)
        }),
        "surface_xyz" => numbers!([3, 1], 3, r => {
            let (rgb, doppler) = (r.numbers(), r.number());
            if !rgb.iter().all(|part| (0.0..=1.0).contains(part)) || doppler.is_nan() || doppler <= 0.0 {
                return Err("red, green and blue must be from 0 to 1, and the Doppler factor above 0".to_owned());
            }
            Spectrum::from_linear_srgb(rgb).seen(doppler)
        }),
        "xyz_to_linear_srgb" => numbers!([3], 3, r => p::xyz_to_linear_srgb(r.numbers())),
        "linear_srgb_to_xyz" => numbers!([3], 3, r => p::linear_srgb_to_xyz(r.numbers())),
        "srgb_encode" => number!([1], r => p::srgb_encode(r.number())),
        "srgb_decode" => number!([1], r => p::srgb_decode(r.number())),
        "hyperbolic_event" => numbers!([3, 1], 4, r => {
            let event = HyperbolicMotion { acceleration: r.vector() }.event(r.number());
            [event.t, event.x.x, event.x.y, event.x.z]
        }),
        "hyperbolic_velocity" => numbers!([3, 1], 3, r => {
            let velocity = HyperbolicMotion { acceleration: r.vector() }.velocity(r.number());
            velocity.map_err(|error| error.to_string())?.beta().to_array()
        }),
        _ => return None,
    })
}

/// A formula for all rows: arrays (n, 1 or 3) to (n, m).
#[pyfunction]
pub fn physics<'py>(
    py: Python<'py>,
    name: &str,
    arguments: Vec<PyReadonlyArray2<'py, f64>>,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let (widths, n_out, compute) =
        formula(name).ok_or_else(|| wrong(format!("no formula `{name}`")))?;
    let n_rows = arguments.first().map_or(0, |array| array.shape()[0]);
    let shapes = arguments.iter().map(|array| array.shape());
    if !shapes.eq(widths.iter().map(|&width| [n_rows, width])) {
        return Err(wrong(format!("`{name}`: wrong shapes")));
    }
    let columns = arguments.iter().map(|array| array.as_slice()).collect::<Result<Vec<_>, _>>()?;
    let all = |_: &Arc<Call>| {
        let mut numbers = vec![0.0; n_rows * n_out];
        for (row, out) in numbers.chunks_exact_mut(n_out).enumerate() {
            let mut arguments = Row { columns: &columns, widths, row, next: 0 };
            compute(&mut arguments, out).map_err(|why| format!("row {row}: {why}"))?;
        }
        Ok::<_, String>(numbers)
    };
    let numbers = call::run(py, None, None, all)?;
    let numbers = numbers.map_err(|why| Refused::Failure(Failure::Failed(why)).exception(py))?;
    PyArray1::from_vec(py, numbers).reshape([n_rows, n_out])
}
