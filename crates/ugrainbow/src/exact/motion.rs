//! Colour as seen.

use uglight::HueTable;

use crate::config::{Exact, Interpolation};
use crate::palette::{Palette, Swatch};

/// What motion does to the colours of a picture.
#[derive(Clone, Copy)]
pub struct Motion<'a> {
    exact: Exact,
    palette: &'a Palette,
    hues: &'static HueTable,
}

impl<'a> Motion<'a> {
    /// As asked for.
    pub fn new(exact: Exact, palette: &'a Palette) -> Self {
        Self { exact, palette, hues: HueTable::get() }
    }

    /// True if colours of bodies that move stay as they are.
    pub fn keeps_colors(&self) -> bool {
        self.exact == Exact::NONE
    }

    /// The wavelength of a tint, for [`Motion::seen`].
    #[inline]
    pub fn wavelength_nm(&self, tint: f64) -> f64 {
        match self.palette.interpolation() {
            Interpolation::Hue => self.hues.wavelength_nm(tint),
            Interpolation::Wavelength => tint,
        }
    }

    /// What a colour at rest is seen as where wavelengths grow by a factor, 1/D; `rest_nm` is that of its tint.
    /// Eq. (P11), (P12), (P18)
    ///
    /// A colour given as light stays; a face that moves has none ([`super::look::Look`]).
    #[inline]
    pub fn seen(&self, rest: &Swatch, rest_nm: f64, stretch: f64) -> Swatch {
        if rest.light.is_some() || stretch == 1.0 {
            return *rest;
        }
        let seen = Swatch { value: rest.value * self.exact.law.factor(1.0 / stretch), ..*rest };
        if !self.exact.doppler || rest.is_grey() {
            return seen;
        }
        // A wavelength need not be visible: a hue stops at the end of its range.
        let tint = match self.palette.interpolation() {
            Interpolation::Hue => self.hues.hue(rest_nm * stretch),
            Interpolation::Wavelength => rest_nm * stretch,
        };
        Swatch { tint, ..seen }
    }
}
