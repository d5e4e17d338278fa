//! Colours of a panorama as a moving observer sees them.

use std::collections::VecDeque;
use std::ops::Range;
use std::sync::{Arc, Mutex, PoisonError};

use uglight::{ColorShift, HueShift, HueTable, SpectralShift};
use ugphysics::{Hsv, VIOLET_END_NM, attenuation, srgb_decode, srgb_encode};
use ugsky::{Basis, BasisError, SpectralTable};

use crate::config::Config;
use crate::error::Error;

/// How light changes with the Doppler factor.
pub struct Shade {
    kind: Kind,
    /// Brightest display-encoded value.
    most: f32,
}

enum Kind {
    /// As at rest.
    Same,
    /// Hues and values of 1988.
    Hues {
        shift: HueShift,
        hues: &'static HueTable,
        curves: Curves,
    },
    Spectra(Arc<SpectralTable>),
}

impl Shade {
    /// The shade of a picture's options.
    ///
    /// # Errors
    /// [`Error::Basis`].
    pub fn new(config: &Config) -> Result<Self, Error> {
        let kind = match config.shift {
            ColorShift::Hues(shift) if shift == HueShift::NONE => Kind::Same,
            ColorShift::Hues(shift) => Kind::Hues { shift, hues: HueTable::get(), curves: Curves::new() },
            ColorShift::Spectra(shift) => Kind::Spectra(spectral_table(config, shift)?),
        };
        let is_uncut = config.picture.keeps_light() || matches!(kind, Kind::Spectra(_));
        Ok(Self { kind, most: if is_uncut { f32::INFINITY } else { 1.0 } })
    }

    /// Light brighter than white is kept until it is developed.
    pub fn is_uncut(&self) -> bool {
        self.most > 1.0
    }

    /// Linear red, green and blue at rest as seen with a Doppler factor.
    #[inline]
    pub fn seen(&self, rgb: [f32; 3], doppler: f64) -> [f32; 3] {
        match &self.kind {
            Kind::Same => rgb.map(|part| part.min(self.most)),
            Kind::Spectra(table) => table.seen(rgb, libm::log(doppler)),
            Kind::Hues { shift, hues, curves } => {
                let encoded = rgb.map(|part| f64::from(curves.encoded.at(part)));
                let rest = Hsv::from_rgb(encoded);
                let color = seen_hue(*shift, hues, rest, doppler);
                color.map(|part| curves.decoded.at((part as f32).min(self.most)))
            }
        }
    }
}

/// Tables are made for this step in ln D, so that the frames of an acceleration share them.
const REACH_STEP: f64 = 0.25;

/// What a spectral table depends on.
type TableKey = (Basis, SpectralShift, f64, Range<f64>);

/// Tables that are kept: those of visible, infrared and ultraviolet light.
const MOST_TABLES: usize = 3;

/// The table of a basis. The last ones are kept for the next picture: they are filled as colours
/// need them.
fn spectral_table(config: &Config, shift: SpectralShift) -> Result<Arc<SpectralTable>, BasisError> {
    static LAST: Mutex<VecDeque<(TableKey, Arc<SpectralTable>)>> = Mutex::new(VecDeque::new());
    let (basis, range) = (config.basis, config.range_nm.clone());
    let reach = (config.velocity.rapidity() / REACH_STEP).ceil() * REACH_STEP;
    let key = (basis, shift, reach, range.clone());
    let mut last = LAST.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some((_, table)) = last.iter().find(|(of, _)| *of == key) {
        return Ok(Arc::clone(table));
    }
    let table = Arc::new(SpectralTable::new(basis, shift.doppler, shift.flux, reach, range)?);
    last.truncate(MOST_TABLES - 1);
    last.push_front((key, Arc::clone(&table)));
    Ok(table)
}

/// A display-encoded colour by the hue model of 1988. A picture shows hues near the ends of the
/// visible range dimmed, so they are first amplified, up to white.  Eq. (P11), (P12), (P17)
#[inline]
fn seen_hue(shift: HueShift, hues: &HueTable, rest: Hsv, doppler: f64) -> [f64; 3] {
    let gain = shift.law.factor(doppler);
    if shift.keeps_wavelength(rest.saturation, doppler) {
        return Hsv { value: rest.value * gain, ..rest }.to_rgb();
    }
    let rest_nm = hues.wavelength_nm(rest.hue);
    let full = rest.unattenuated(attenuation(rest_nm), rest.value.max(1.0));
    let seen_nm = rest_nm / doppler;
    // Violet is the hue of 380 nm, and no longer −60 degrees.
    let hue = if seen_nm <= VIOLET_END_NM { 300.0 } else { hues.hue(seen_nm) };
    Hsv { hue, saturation: full.saturation, value: full.value * gain }
        .attenuated(attenuation(seen_nm))
        .to_rgb()
}

/// The sRGB transfer function and its inverse, tabulated.
struct Curves {
    encoded: Curve,
    decoded: Curve,
}

impl Curves {
    fn new() -> Self {
        Self { encoded: Curve::new(srgb_encode), decoded: Curve::new(srgb_decode) }
    }
}

/// A table of a function: 1024 values for each power of two of its argument, with linear
/// interpolation between them. Relative errors are below 10⁻⁶. Negative arguments count as 0.
struct Curve {
    values: Vec<f32>,
}

/// Bits of the mantissa that select the cell.
const CELL_BITS: u32 = 10;

/// Exponents of the table, 2⁻²⁰ and 2²⁰, and outside of them the function is computed.
const EXPONENTS: [i32; 2] = [-20, 20];

impl Curve {
    fn new(function: impl Fn(f64) -> f64) -> Self {
        let n = ((EXPONENTS[1] - EXPONENTS[0]) << CELL_BITS) as u32 + 1;
        let start = Self::start();
        let at = |idx: u32| f32::from_bits(start + (idx << (23 - CELL_BITS)));
        Self { values: (0..n).map(|idx| function(f64::from(at(idx))) as f32).collect() }
    }

    /// The bits of the first number.
    fn start() -> u32 {
        ((EXPONENTS[0] + 127) as u32) << 23
    }

    #[inline]
    fn at(&self, x: f32) -> f32 {
        const CELL: u32 = 1 << (23 - CELL_BITS);
        let Some(bits) = x.to_bits().checked_sub(Self::start()) else {
            // Linear near 0.
            return x.max(0.0) * (self.values[0] / f32::from_bits(Self::start()));
        };
        let idx = (bits / CELL) as usize;
        let Some([low, high]) = self.values.get(idx..idx + 2) else {
            // Negative numbers have the highest bit; larger numbers are clipped at the end.
            return if x > 0.0 { self.values[self.values.len() - 1] } else { 0.0 };
        };
        low + (high - low) * ((bits % CELL) as f32 / CELL as f32)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ugphysics::{Brightness, Velocity, hue_to_wavelength};

    #[test]
    fn curves_are_those_of_srgb() {
        let curves = Curves::new();
        for step in 0..20_000 {
            let x = libm::exp(f64::from(step - 14_000) * 1e-3);
            for (curve, exact) in [(&curves.encoded, srgb_encode(x)), (&curves.decoded, srgb_decode(x))] {
                let found = f64::from(curve.at(x as f32));
                assert!((found / exact - 1.0).abs() < 2e-6, "{x}: {found} {exact}");
            }
        }
        assert_eq!(
            (curves.encoded.at(0.0), curves.encoded.at(-1.0), curves.decoded.at(-0.0)),
            (0.0, 0.0, 0.0)
        );
        assert!(curves.decoded.at(f32::MAX) > 1e9);
    }

    fn shade(shift: HueShift) -> Shade {
        let config = Config { shift: ColorShift::Hues(shift), velocity: Velocity::ZERO, ..Config::default() };
        Shade::new(&config).unwrap()
    }

    /// At rest nothing changes, hues at the ends of the visible range among them.
    #[test]
    fn colours_at_rest_are_kept() {
        let shade = shade(HueShift { doppler: true, law: Brightness::Report });
        for rgb in [[0.5, 0.2, 0.1], [0.1, 0.9, 0.9], [0.4, 0.0, 0.4], [0.3, 0.02, 0.6], [0.7, 0.7, 0.7]] {
            let seen = shade.seen(rgb, 1.0);
            assert!((0..3).all(|i| (seen[i] - rgb[i]).abs() < 1e-5), "{rgb:?} {seen:?}");
        }
    }

    #[test]
    fn hues_are_shifted_as_in_1988() {
        let shade = shade(HueShift { doppler: true, law: Brightness::Report });
        let green =
            Hsv { hue: 120.0, saturation: 1.0, value: 0.4 }.to_rgb().map(|part| srgb_decode(part) as f32);
        let seen = shade.seen(green, 1.1);
        let encoded = seen.map(|part| srgb_encode(f64::from(part)));
        let found = Hsv::from_rgb(encoded);
        assert!((hue_to_wavelength(found.hue) - 546.1 / 1.1).abs() < 1e-2, "{found:?}");
        assert!((found.value - 0.44).abs() < 1e-5, "{found:?}");
    }
}
