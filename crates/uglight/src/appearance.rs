//! Colours as they appear in the frame of the camera.

use glam::DVec3;
use ugphysics::Hsv;

use crate::{
    ColorShift, HueColor, HueShift, HueTable, Interpolation, Irradiance, Lamp, Palette, Spectra, Swatch,
};

/// Computes the apparent colour of each sample from its colour at rest.
#[derive(Clone, Copy)]
pub struct Appearance<'a> {
    shift: HueShift,
    palette: &'a Palette,
    hues: &'static HueTable,
    /// `None` if colours are hues or wavelengths.
    spectra: Option<&'a Spectra>,
}

impl<'a> Appearance<'a> {
    /// The colour shift `shift` of the colours of a scene. `spectra`: given if it shifts spectra.
    pub fn new(shift: ColorShift, palette: &'a Palette, spectra: Option<&'a Spectra>) -> Self {
        let shift = match shift {
            ColorShift::Hues(shift) => shift,
            ColorShift::Spectra(_) => HueShift::NONE,
        };
        Self { shift, palette, hues: HueTable::get(), spectra }
    }

    /// True if colours given as light can be drawn on moving bodies: they are spectra, or nothing
    /// is shifted.
    pub fn keeps_light(&self) -> bool {
        self.spectra.is_some() || self.shift == HueShift::NONE
    }

    /// The spectra; `None` if colours are hues or wavelengths.
    #[inline]
    pub fn spectra(&self) -> Option<&'a Spectra> {
        self.spectra
    }

    /// The wavelength that a tint stands for, as [`Appearance::seen`] requires it.
    #[inline]
    pub fn wavelength_nm(&self, tint: f64) -> f64 {
        match self.palette.interpolation() {
            Interpolation::Hue => self.hues.wavelength_nm(tint),
            Interpolation::Wavelength => tint,
        }
    }

    /// The apparent colour of `rest` where wavelengths are stretched by `stretch` = 1/D. `rest_nm`:
    /// the wavelength of its tint.  Eq. (P11), (P12), (P18)
    ///
    /// A colour given as light is returned unchanged. On moving bodies such colours occur only in
    /// spectral mode; otherwise the renderer replaces them by hues.
    #[inline]
    pub fn seen(&self, rest: &Swatch, rest_nm: f64, stretch: f64) -> Swatch {
        if rest.light.is_some() || stretch == 1.0 {
            return *rest;
        }
        let factor = self.shift.law.factor(1.0 / stretch);
        let seen = if self.shift.law.acts_on_light() {
            Swatch { factor: rest.factor * factor, ..*rest }
        } else {
            Swatch { value: rest.value * factor, ..*rest }
        };
        if !self.shift.doppler || rest.is_grey() {
            return seen;
        }
        // λ/D, as a product, since this runs for every sample.
        let seen_nm = rest_nm * stretch;
        // The wavelength may be invisible; a hue is clamped to the end of its range.
        let tint = match self.palette.interpolation() {
            Interpolation::Hue => self.hues.hue(seen_nm),
            Interpolation::Wavelength => seen_nm,
        };
        Swatch { tint, ..seen }
    }

    /// A colour at rest with its wavelength.
    pub fn hue_color(&self, rest: &Swatch) -> HueColor {
        let Hsv { hue, saturation, value } = self.palette.hsv(rest);
        let wavelength_nm = if rest.is_grey() { 0.0 } else { self.wavelength_nm(rest.tint) };
        HueColor { hue, wavelength_nm, saturation, value, factor: rest.factor }
    }

    /// [`Appearance::seen`] under lamps, which may be coloured: the colour contains their light. Under
    /// a law that names a quantity it is given as light, since the light of lamps adds up.  Eq. (P14)
    pub fn seen_lit(&self, rest: &Swatch, stretch: f64, light: &[Irradiance], lamps: &[Lamp]) -> Swatch {
        let (base, doppler) = (self.hue_color(rest), 1.0 / stretch);
        if self.shift.law.acts_on_light() {
            let parts = light.chunks(1).map(|part| self.shift.seen_lit(base, doppler, part, lamps).light());
            return Swatch { light: Some(parts.sum()), ..*rest };
        }
        let seen = self.shift.seen_lit(base, doppler, light, lamps);
        let tint = match self.palette.interpolation() {
            Interpolation::Hue => seen.hue,
            Interpolation::Wavelength => seen.wavelength_nm,
        };
        Swatch { tint, saturation: seen.saturation, value: seen.value, factor: seen.factor, ..*rest }
    }

    /// [`Appearance::seen_light`] under the coloured lamps of the scene, at rest with the surface.
    /// `place`: see [`Spectra::light_of_lamps`].
    pub fn seen_under_lamps(
        &self,
        parts: impl IntoIterator<Item = (u32, f64)>,
        stretch: f64,
        place: [DVec3; 3],
    ) -> DVec3 {
        let Some(spectra) = self.spectra else { return DVec3::ONE };
        let ln_doppler = -libm::log(stretch);
        let light = |row: u32| spectra.light_of_lamps(row, ln_doppler, place);
        parts.into_iter().map(|(row, weight)| weight * light(row)).sum()
    }

    /// Linear red, green and blue of a weighted mean of spectra, where wavelengths are stretched by
    /// `stretch` = 1/D. `parts`: rows of spectra with their weights. White unless colours are
    /// spectra.
    pub fn seen_light(&self, parts: impl IntoIterator<Item = (u32, f64)>, stretch: f64) -> DVec3 {
        let Some(spectra) = self.spectra else { return DVec3::ONE };
        let ln_doppler = -libm::log(stretch);
        parts.into_iter().map(|(row, weight)| weight * spectra.light(row, ln_doppler)).sum()
    }
}
