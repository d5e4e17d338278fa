//! Colours as seen.

use glam::DVec3;
use uglight::{ColorShift, HueShift, HueTable};

use crate::config::Interpolation;
use crate::painter::Painter;
use crate::palette::{Palette, Swatch};
use crate::spectra::Spectra;

/// How the colours of a scene are seen, sample by sample.
#[derive(Clone, Copy)]
pub struct Appearance<'a> {
    shift: HueShift,
    palette: &'a Palette,
    hues: &'static HueTable,
    /// If colours are spectra.
    spectra: Option<&'a Spectra>,
}

impl<'a> Appearance<'a> {
    /// That of the colours of a painter.
    pub fn new(shift: ColorShift, painter: &Painter<'a>) -> Self {
        let shift = match shift {
            ColorShift::Hues(shift) => shift,
            ColorShift::Spectra(_) => HueShift::NONE,
        };
        Self { shift, palette: painter.palette, hues: HueTable::get(), spectra: painter.spectra }
    }

    /// True if colours given as light can be drawn of bodies that move: as spectra, or unchanged.
    pub fn keeps_light(&self) -> bool {
        self.spectra.is_some() || self.shift == HueShift::NONE
    }

    /// The spectra, if colours are spectra.
    #[inline]
    pub fn spectra(&self) -> Option<&'a Spectra> {
        self.spectra
    }

    /// The wavelength of a tint, for [`Appearance::seen`].
    #[inline]
    pub fn wavelength_nm(&self, tint: f64) -> f64 {
        match self.palette.interpolation() {
            Interpolation::Hue => self.hues.wavelength_nm(tint),
            Interpolation::Wavelength => tint,
        }
    }

    /// A hue at rest as seen where wavelengths are stretched by 1/D; `rest_nm` is the wavelength of
    /// its tint.  Eq. (P11), (P12), (P18)
    ///
    /// A colour given as light stays; unless colours are spectra, no face that moves has one
    /// ([`super::look::Look`]).
    #[inline]
    pub fn seen(&self, rest: &Swatch, rest_nm: f64, stretch: f64) -> Swatch {
        if rest.light.is_some() || stretch == 1.0 {
            return *rest;
        }
        let doppler = 1.0 / stretch;
        let seen = Swatch { value: self.shift.value(rest.value, doppler), ..*rest };
        if !self.shift.doppler || rest.is_grey() {
            return seen;
        }
        let seen_nm = self.shift.wavelength_nm(rest_nm, doppler);
        // The wavelength may be invisible; a hue stops at the end of its range.
        let tint = match self.palette.interpolation() {
            Interpolation::Hue => self.hues.hue(seen_nm),
            Interpolation::Wavelength => seen_nm,
        };
        Swatch { tint, ..seen }
    }

    /// The spectra of some rows as seen where wavelengths are stretched by 1/D, with their weights:
    /// linear red, green and blue. White if colours are no spectra.
    pub fn seen_light(&self, parts: impl IntoIterator<Item = (u32, f64)>, stretch: f64) -> DVec3 {
        let Some(spectra) = self.spectra else { return DVec3::ONE };
        let ln_doppler = -libm::log(stretch);
        parts.into_iter().map(|(row, weight)| weight * spectra.light(row, ln_doppler)).sum()
    }
}
