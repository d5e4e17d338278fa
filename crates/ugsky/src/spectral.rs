//! Spectra for light of which only red, green and blue are known, and how it is seen in motion.

use std::fmt;
use std::ops::Range;
use std::sync::OnceLock;

use rayon::prelude::*;
use ugphysics::spectrum::{InfraredRule, LightSpectrum, Spectrum, integrate};
use ugphysics::{linear_srgb_to_xyz, luminance, xyz_to_linear_srgb};

/// The spectra that red, green and blue stand for. A picture determines three numbers of a
/// spectrum, and nothing of its infrared and ultraviolet parts, which motion brings into view; each
/// basis is an assumption about both.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Basis {
    /// Daylight on a mixture of white, pairs of primaries and primaries, mixed with white to a few
    /// saturations, each with the reflectance of (P20) (after Smits 1999). Colours that differ
    /// little have spectra that differ little, in the infrared as well.
    Mixture,
    /// Sums of black bodies at three temperatures, in kelvins (Weiskopf 2000). Saturated colours
    /// need negative amounts of some.
    Planck([f64; 3]),
    /// Daylight, as much as the luminance of a colour: for pictures of infrared or ultraviolet
    /// light, which have no colours.
    Grey,
    /// In place of red, green and blue, the channels are radiances at the inner three of five
    /// ascending wavelengths in nm. The spectrum is interpolated linearly between these and is 0 at
    /// the outer two.
    Samples([f64; 5]),
}

/// All wavelengths at rest, nm.
pub const ALL_NM: Range<f64> = 0.0..f64::INFINITY;

/// Why there is no table of a [`Basis`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum BasisError {
    /// The temperatures of [`Basis::Planck`].
    Temperatures([f64; 3]),
}

impl fmt::Display for BasisError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self::Temperatures([first, second, third]) = self;
        write!(
            f,
            "black bodies at {first}, {second} and {third} K are no basis of colours: give three different \
             temperatures from 500 to 100000 K, such as 3500 5900 10000"
        )
    }
}

impl std::error::Error for BasisError {}

/// Step of tables in ln D.
const STEP: f64 = 0.003;

/// |ln D| up to which light is tabulated: beyond it nothing visible is left.
const MOST_LN_DOPPLER: f64 = 12.0;

/// Temperatures that colours may have, kelvins.
const KELVIN: [f64; 2] = [500.0, 100_000.0];

/// Light as seen by an observer: a table for each basis over the Doppler factor.  Eq. (P12), (P19)
pub struct SpectralTable {
    doppler: bool,
    flux: bool,
    kind: Kind,
}

enum Kind {
    /// Matrices from linear red, green and blue at rest to those seen, by ln D.
    Linear { first: f64, maps: Vec<[[f32; 3]; 3]> },
    /// The light seen of the spectra of a mixture, by ln D: computed by `colors` when it is first
    /// read, as a view shows few of all Doppler factors.
    Mixture { first: f64, lights: Vec<OnceLock<[[f32; 3]; N_MIXED]>>, colors: Box<MixedColors> },
}

/// The linear red, green and blue of the spectra of a mixture by ln D, without D⁵.
type MixedColors = dyn Fn(f64) -> [[f64; 3]; N_MIXED] + Send + Sync;

/// Number of [`pure_lights`].
pub const N_PURE: usize = 7;

/// Saturations at which [`Basis::Mixture`] has spectra, evenly spaced up to 1. The spectrum of a
/// pale colour is smooth, that of a primary goes to 0 steeply: mixed from white and primaries
/// alone, a pale blue sky would be green at D = 1.3.
const N_LEVELS: usize = 2;

/// Number of spectra of [`Basis::Mixture`]: white, and the others of [`PURE`] at each saturation.
const N_MIXED: usize = 1 + N_LEVELS * (N_PURE - 1);

/// White, the primaries, and the pairs that lack one of them.
const PURE: [[f64; 3]; N_PURE] = [
    [1.0, 1.0, 1.0],
    [1.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, 0.0, 1.0],
    [0.0, 1.0, 1.0],
    [1.0, 0.0, 1.0],
    [1.0, 1.0, 0.0],
];

impl SpectralTable {
    /// A table for Doppler factors up to e^±`reach`. `doppler`: wavelengths are shifted; `flux`:
    /// the radiance at each wavelength is multiplied by D⁵. `range`: wavelengths at rest, nm, at
    /// which there is light.
    ///
    /// # Errors
    /// [`BasisError`].
    pub fn new(
        basis: Basis,
        doppler: bool,
        flux: bool,
        reach: f64,
        range: Range<f64>,
    ) -> Result<Self, BasisError> {
        let reach = if doppler { reach.abs().min(MOST_LN_DOPPLER) } else { 0.0 };
        let kind = match basis {
            Basis::Planck(kelvin) => planck(kelvin, reach, &range)?,
            Basis::Mixture => mixture(reach, &range),
            Basis::Grey => grey(reach, &range),
            Basis::Samples(nm) => samples(nm, reach),
        };
        Ok(Self { doppler, flux, kind })
    }

    /// Linear red, green and blue as seen with a Doppler factor. Neither is clipped.
    #[inline]
    pub fn seen(&self, rgb: [f32; 3], doppler: f64) -> [f32; 3] {
        let shift = if self.doppler { libm::log(doppler) } else { 0.0 };
        let seen = match &self.kind {
            Kind::Linear { first, maps } => {
                let (idx, part) = place(shift, *first, STEP, maps.len());
                let [low, high] = [&maps[idx], &maps[idx + 1]];
                std::array::from_fn(|i| {
                    let row: [f32; 3] =
                        std::array::from_fn(|j| low[i][j] + part * (high[i][j] - low[i][j]));
                    row[0] * rgb[0] + row[1] * rgb[1] + row[2] * rgb[2]
                })
            }
            Kind::Mixture { first, lights, colors } => {
                let (idx, part) = place(shift, *first, STEP, lights.len());
                let light = |idx: usize| {
                    let color =
                        || colors(first + STEP * idx as f64).map(|rgb| rgb.map(|part| part as f32));
                    lights[idx].get_or_init(color)
                };
                mixture_seen(rgb, [light(idx), light(idx + 1)], part)
            }
        };
        if !self.flux {
            return seen;
        }
        let square = doppler * doppler;
        let gain = (square * square * doppler) as f32;
        seen.map(|part| part * gain)
    }
}

/// The cell of a table, and the place in it from 0 to 1; the nearer end outside of the table.
#[inline]
fn place(at: f64, first: f64, step: f64, n: usize) -> (usize, f32) {
    let at = ((at - first) / step).clamp(0.0, (n - 1) as f64);
    let idx = (at as usize).min(n - 2);
    (idx, (at - idx as f64) as f32)
}

/// ln D of the first entry of a table with 0 among its entries, and the number of its entries.
fn range_of(reach: f64, step: f64) -> (f64, usize) {
    let half = (reach / step).ceil().max(1.0);
    (-half * step, 2 * half as usize + 1)
}

/// X, Y, Z of the light of a spectrum in a range of wavelengths at rest, seen with a Doppler
/// factor, without D⁵.
fn shifted(spectrum: &LightSpectrum, range: &Range<f64>, ln_doppler: f64) -> [f64; 3] {
    let doppler = libm::exp(ln_doppler);
    let radiance = |rest_nm: f64| if range.contains(&rest_nm) { spectrum.at(rest_nm) } else { 0.0 };
    integrate(|nm| radiance(nm * doppler))
}

fn grey(reach: f64, range: &Range<f64>) -> Kind {
    let daylight = LightSpectrum::new(&Spectrum::from_linear_srgb([1.0; 3]));
    let weights = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(luminance);
    let (first, n) = range_of(reach, STEP);
    let map = |idx: usize| {
        let seen = xyz_to_linear_srgb(shifted(&daylight, range, first + STEP * idx as f64));
        seen.map(|part| weights.map(|weight| (part * weight) as f32))
    };
    Kind::Linear { first, maps: (0..n).into_par_iter().map(map).collect() }
}

fn samples(nm: [f64; 5], reach: f64) -> Kind {
    let (first, n) = range_of(reach, STEP);
    let map = |idx: usize| {
        let doppler = libm::exp(first + STEP * idx as f64);
        let of_sample = |at: usize| {
            let rises = |rest_nm: f64| (rest_nm - nm[at]) / (nm[at + 1] - nm[at]);
            let falls = |rest_nm: f64| (nm[at + 2] - rest_nm) / (nm[at + 2] - nm[at + 1]);
            xyz_to_linear_srgb(integrate(|seen_nm| {
                let rest_nm = seen_nm * doppler;
                rises(rest_nm).min(falls(rest_nm)).max(0.0)
            }))
        };
        let columns = [0, 1, 2].map(of_sample);
        std::array::from_fn(|i| columns.map(|column| column[i] as f32))
    };
    Kind::Linear { first, maps: (0..n).into_par_iter().map(map).collect() }
}

fn planck(kelvin: [f64; 3], reach: f64, range: &Range<f64>) -> Result<Kind, BasisError> {
    let error = BasisError::Temperatures(kelvin);
    if kelvin.iter().any(|kelvin| !(KELVIN[0]..=KELVIN[1]).contains(kelvin)) {
        return Err(error);
    }
    let spectra = kelvin.map(|kelvin| Spectrum::blackbody(kelvin, 1.0));
    // The amounts of the three bodies in a colour are those of the whole light at rest.
    let rest = spectra.each_ref().map(|spectrum| xyz_to_linear_srgb(spectrum.shifted(1.0)));
    let colors = colors_of(spectra, range.clone());
    let inverse = inverse(rest).ok_or(error)?;
    let (first, n) = range_of(reach, STEP);
    let map = |idx: usize| {
        let seen = colors(first + STEP * idx as f64);
        std::array::from_fn(|i| {
            std::array::from_fn(|j| (0..3).map(|k| seen[k][i] * inverse[k][j]).sum::<f64>() as f32)
        })
    };
    Ok(Kind::Linear { first, maps: (0..n).into_par_iter().map(map).collect() })
}

/// The linear red, green and blue of spectra by ln D, without D⁵.
fn colors_of<const N: usize>(
    spectra: [Spectrum; N],
    range: Range<f64>,
) -> impl Fn(f64) -> [[f64; 3]; N] + Send + Sync {
    let lights = spectra.each_ref().map(LightSpectrum::new);
    move |ln_doppler| {
        let xyz = match range == ALL_NM {
            true => Spectrum::all_shifted(spectra.each_ref(), libm::exp(ln_doppler)),
            false => lights.each_ref().map(|light| shifted(light, &range, ln_doppler)),
        };
        xyz.map(xyz_to_linear_srgb)
    }
}

/// The spectrum of a pure colour. Skies are no surfaces: their infrared is that of the curve of the
/// colour.
fn pure_light(rgb: [f64; 3]) -> Spectrum {
    Spectrum::with_infrared(linear_srgb_to_xyz(rgb), InfraredRule::Constant).0
}

/// The spectra of [`Basis::Mixture`], mixed with white to a saturation from 0 to 1.
pub fn pure_lights(saturation: f64) -> [Spectrum; N_PURE] {
    PURE.map(|rgb| pure_light(rgb.map(|part| 1.0 - saturation * (1.0 - part))))
}

fn mixture(reach: f64, range: &Range<f64>) -> Kind {
    let levels: [_; N_LEVELS] =
        std::array::from_fn(|level| pure_lights((level + 1) as f64 / N_LEVELS as f64));
    let spectra: [Spectrum; N_MIXED] = std::array::from_fn(|row| match row {
        0 => levels[0][0].clone(),
        _ => levels[(row - 1) / (N_PURE - 1)][1 + (row - 1) % (N_PURE - 1)].clone(),
    });
    let colors = Box::new(colors_of(spectra, range.clone()));
    let (first, n) = range_of(reach, STEP);
    Kind::Mixture { first, lights: std::iter::repeat_with(OnceLock::new).take(n).collect(), colors }
}

/// The light of a mixture between two entries of the table.
fn mixture_seen(rgb: [f32; 3], [low, high]: [&[[f32; 3]; N_MIXED]; 2], part: f32) -> [f32; 3] {
    let mut seen = [0.0; 3];
    for (row, amount) in mixed(rgb) {
        let (low, high) = (&low[row], &high[row]);
        for c in 0..3 {
            seen[c] += amount * (low[c] + part * (high[c] - low[c]));
        }
    }
    seen
}

/// The spectra of [`Basis::Mixture`] in a colour with their amounts: a pair and its brighter
/// primary, at the saturations below and above that of the colour.
fn mixed(rgb: [f32; 3]) -> [(usize, f32); 4] {
    let [(_, white), (pair, of_pair), (one, of_one)] = amounts(rgb);
    let chroma = of_pair + of_one;
    if chroma <= 0.0 {
        return [(0, white), (0, 0.0), (0, 0.0), (0, 0.0)];
    }
    let most = white + chroma;
    let at = N_LEVELS as f32 * chroma / most;
    let level = (at as usize).min(N_LEVELS - 1);
    let above = most * (at - level as f32);
    let below = most - above;
    let share = of_pair / chroma;
    let row = |level: usize, pure| if level == 0 { 0 } else { (level - 1) * (N_PURE - 1) + pure };
    [
        (row(level, pair), below * share),
        (row(level, one), below * (1.0 - share)),
        (row(level + 1, pair), above * share),
        (row(level + 1, one), above * (1.0 - share)),
    ]
}

/// The [`pure_lights`] in a colour with their amounts: as much white as all channels have, as much
/// of a pair as the two brighter ones have more, and the rest of the brightest.
pub fn amounts(rgb: [f32; 3]) -> [(usize, f32); 3] {
    let rgb = rgb.map(|part| part.max(0.0));
    let [mut darkest, mut middle, mut brightest] = [0, 1, 2];
    let sort = |a: &mut usize, b: &mut usize| {
        if rgb[*a] > rgb[*b] {
            std::mem::swap(a, b);
        }
    };
    sort(&mut darkest, &mut middle);
    sort(&mut middle, &mut brightest);
    sort(&mut darkest, &mut middle);
    [
        (0, rgb[darkest]),
        (4 + darkest, rgb[middle] - rgb[darkest]),
        (1 + brightest, rgb[brightest] - rgb[middle]),
    ]
}

/// The matrix that gives the amounts of three colours in a colour; `None` if they are not
/// independent.
fn inverse(colors: [[f64; 3]; 3]) -> Option<[[f64; 3]; 3]> {
    let cross = |a: [f64; 3], b: [f64; 3]| {
        [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    };
    let rows =
        [cross(colors[1], colors[2]), cross(colors[2], colors[0]), cross(colors[0], colors[1])];
    let determinant: f64 = (0..3).map(|i| colors[0][i] * rows[0][i]).sum();
    (determinant.abs() > 1e-6).then(|| rows.map(|row| row.map(|part| part / determinant)))
}
