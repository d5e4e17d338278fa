//! Colours of a panorama as a moving observer sees them.

use std::collections::VecDeque;
use std::ops::Range;
use std::sync::{Arc, Mutex, PoisonError};

use fearless_simd::prelude::*;
use fearless_simd::{Level, Simd, dispatch, f32x16};
use ugphysics::{Brightness, Velocity};

use crate::hues::Hues;
use crate::sample::Seen;
use crate::spectral::{Basis, BasisError, SpectralTable};

/// How the colours of a sky change with the Doppler factor D.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SkyColors {
    /// A colour is white and a hue, which stands for a wavelength (Nguyen 1988).  Eq. (P11), (P16)
    Hues {
        /// Wavelengths are divided by D.
        doppler: bool,
        /// The power of D by which the brightness is multiplied.
        law: Brightness,
    },
    /// A colour is a spectrum.  Eq. (P12)
    Spectra {
        /// The spectra of red, green and blue.
        basis: Basis,
        /// Wavelengths are divided by D.
        doppler: bool,
        /// The radiance at each wavelength is multiplied by D⁵.
        flux: bool,
    },
}

impl SkyColors {
    /// Whether wavelengths are shifted, and whether the brightness changes.
    pub fn parts(self) -> [bool; 2] {
        match self {
            Self::Hues { doppler, law } => [doppler, law != Brightness::None],
            Self::Spectra { doppler, flux, .. } => [doppler, flux],
        }
    }

    /// The same parts of the effect, on the spectra of `basis`.
    #[must_use]
    pub fn on(self, basis: Basis) -> Self {
        let [doppler, flux] = self.parts();
        Self::Spectra { basis, doppler, flux }
    }
}

/// How light changes with the Doppler factor.
pub struct Shade {
    kind: Kind,
    /// Brightest display-encoded value.
    most: f32,
    /// How many times as bright as white light is where all channels are clipped.
    highlights: f32,
    simd: Level,
}

/// Light of the least of three channels from which on a photograph is clipped more or less: above
/// the brightest paper. Encoded it is 0.94.
const HIGHLIGHT: f32 = 0.87;

enum Kind {
    /// As at rest.
    Same,
    /// Hues and values of 1988: whether wavelengths are shifted, and the law of brightness.
    Hues((bool, Brightness)),
    Spectra(Arc<SpectralTable>),
}

impl Shade {
    /// The shade of an observer with a velocity in the frame of the sky. `range_nm`: wavelengths at
    /// rest at which the sky has light, [`ALL_NM`](crate::ALL_NM) except with spectra. Colours that
    /// are hues are clipped at white unless `keeps_light`.
    ///
    /// # Errors
    /// [`BasisError`].
    pub fn new(
        colors: SkyColors,
        velocity: Velocity,
        range_nm: &Range<f64>,
        keeps_light: bool,
    ) -> Result<Self, BasisError> {
        let kind = match colors {
            SkyColors::Hues { doppler: false, law: Brightness::None } => Kind::Same,
            SkyColors::Hues { doppler, law } => Kind::Hues((doppler, law)),
            SkyColors::Spectra { basis, .. } => {
                Kind::Spectra(spectral_table(basis, colors.parts(), velocity, range_nm)?)
            }
        };
        let keeps_highlights = keeps_light || matches!(kind, Kind::Spectra(_));
        Ok(Self {
            kind,
            most: if keeps_highlights { f32::INFINITY } else { 1.0 },
            highlights: 1.0,
            simd: Level::new(),
        })
    }

    /// Makes clipped highlights of a photograph, whose channels are all 1, `factor` times as bright
    /// as white. Below 1 the factor falls with the square of the way to `HIGHLIGHT`, where it is 1.
    pub fn set_highlights(&mut self, factor: f32) {
        self.highlights = factor;
    }

    /// Light brighter than white is kept until it is developed.
    pub fn keeps_highlights(&self) -> bool {
        self.most > 1.0
    }

    /// Replaces the light of sixteen pixels in the frame of the sky by what the moving observer
    /// sees. `light`: linear red, green and blue times alpha, and alpha; `doppler`: the Doppler
    /// factors.
    pub fn see(&self, light: &mut [[f32; Seen::N]; 4], doppler: &[f32; Seen::N]) {
        dispatch!(self.simd, simd => self.see_on(simd, light, doppler));
    }

    #[inline(always)]
    pub(crate) fn see_on<S: Simd>(
        &self,
        simd: S,
        light: &mut [[f32; Seen::N]; 4],
        doppler: &[f32; Seen::N],
    ) {
        let (zero, one) = (f32x16::splat(simd, 0.0), f32x16::splat(simd, 1.0));
        let [reds, greens, blues, alphas] = light;
        // Interpolation may exceed the range by a little.
        let alpha = f32x16::from_slice(simd, alphas).max(zero).min(one);
        let inverse = alpha.simd_gt(zero).select(one / alpha, zero);
        let red = f32x16::from_slice(simd, reds) * inverse;
        let green = f32x16::from_slice(simd, greens) * inverse;
        let blue = f32x16::from_slice(simd, blues) * inverse;
        let [red, green, blue] = if self.highlights == 1.0 {
            [red, green, blue]
        } else {
            self.brightened(simd, [red, green, blue])
        };
        let [red, green, blue] = match &self.kind {
            Kind::Same => {
                let most = f32x16::splat(simd, self.most);
                [red.min(most), green.min(most), blue.min(most)]
            }
            Kind::Hues(shift) => {
                let doppler = f32x16::from_slice(simd, doppler);
                Hues::get().seen(simd, *shift, self.most, [red, green, blue], doppler)
            }
            Kind::Spectra(table) => spectra(simd, table, [red, green, blue], doppler),
        };
        (red * alpha).store_slice(reds);
        (green * alpha).store_slice(greens);
        (blue * alpha).store_slice(blues);
        alpha.store_slice(alphas);
    }

    /// Light with brighter highlights. It is sampled light that is brightened, not texels: between
    /// texels that differ by orders of magnitude the kernel would interpolate negative light.
    #[inline(always)]
    fn brightened<S: Simd>(&self, simd: S, light: [f32x16<S>; 3]) -> [f32x16<S>; 3] {
        let [zero, one, start] = [0.0, 1.0, HIGHLIGHT].map(|number| f32x16::splat(simd, number));
        let least = light[0].min(light[1]).min(light[2]);
        let way = ((least - start) / (one - start)).max(zero).min(one);
        let gain = one + f32x16::splat(simd, self.highlights - 1.0) * way * way;
        light.map(|channel| channel * gain)
    }
}

#[inline(always)]
fn spectra<S: Simd>(
    simd: S,
    table: &SpectralTable,
    [red, green, blue]: [f32x16<S>; 3],
    doppler: &[f32; Seen::N],
) -> [f32x16<S>; 3] {
    let (mut red, mut green, mut blue): ([f32; Seen::N], [f32; Seen::N], [f32; Seen::N]) =
        (red.into(), green.into(), blue.into());
    for k in 0..Seen::N {
        let seen = table.seen([red[k], green[k], blue[k]], f64::from(doppler[k]));
        (red[k], green[k], blue[k]) = (seen[0], seen[1], seen[2]);
    }
    [
        f32x16::from_slice(simd, &red),
        f32x16::from_slice(simd, &green),
        f32x16::from_slice(simd, &blue),
    ]
}

/// Tables are made for this step in ln D, so that the frames of an acceleration share them.
const REACH_STEP: f64 = 0.25;

/// The key of a spectral table.
type TableKey = (Basis, [bool; 2], f64, Range<f64>);

/// Tables that are kept: those of visible, infrared and ultraviolet light.
const MOST_TABLES: usize = 3;

/// The table of a basis. The last ones are kept for the next picture: they are filled as colours
/// need them.
fn spectral_table(
    basis: Basis,
    parts: [bool; 2],
    velocity: Velocity,
    range_nm: &Range<f64>,
) -> Result<Arc<SpectralTable>, BasisError> {
    static LAST: Mutex<VecDeque<(TableKey, Arc<SpectralTable>)>> = Mutex::new(VecDeque::new());
    let reach = (velocity.rapidity() / REACH_STEP).ceil() * REACH_STEP;
    let key = (basis, parts, reach, range_nm.clone());
    let mut last = LAST.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some((_, table)) = last.iter().find(|(of, _)| *of == key) {
        return Ok(Arc::clone(table));
    }
    let [doppler, flux] = parts;
    let table = Arc::new(SpectralTable::new(basis, doppler, flux, reach, range_nm.clone())?);
    last.truncate(MOST_TABLES - 1);
    last.push_front((key, Arc::clone(&table)));
    Ok(table)
}
