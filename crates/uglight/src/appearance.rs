//! Colours as they appear in the frame of the camera.

use glam::DVec3;
use ugphysics::spectrum::Spectrum;
use ugphysics::{Hsv, wavelength_to_hue};
use ugscene::{ColorId, Scene};

use crate::color::{shown_light, texel_hsv};
use crate::hue_table::HueTable;
use crate::spectra::{Spectra, SpectralRows};
use crate::{
    ColorForm, ColorShift, HueColor, HueShift, Interpolation, Irradiance, Lamp, Lamps, Mixing,
    Palette, SpectralFilter, SurfaceAttributes, Swatch,
};

/// A colour at rest at a point of a surface.
#[derive(Clone, Copy, Debug)]
pub struct SurfaceColor {
    /// The colour, interpolated between the corners of its face, or that of the point itself.
    pub swatch: Swatch,
    /// Where colours are spectra, the spectrum is the mean of those of the corners of its face:
    /// rows of the colours of vertices ([`SurfaceAttributes::row`]) with their weights. That of a
    /// texture is a mixture, too ([`Appearance::texel`]).
    pub rows: SpectralRows,
}

impl SurfaceColor {
    /// A colour that is the same all around. `row`: of its spectrum.
    pub fn even(swatch: Swatch, row: u32) -> Self {
        Self { swatch, rows: [(row, 1.0), (row, 0.0), (row, 0.0), (row, 0.0)] }
    }
}

/// Light on a point of a surface.
#[derive(Clone, Copy)]
pub enum Illumination<'a> {
    /// White light of this level, from no lamp.
    Level(f64),
    /// The contribution of each lamp.
    Lamps(&'a [Irradiance], &'a Lamps),
}

/// A coloured transparent surface that light crossed on its way from a surface to the eye.
#[derive(Clone, Copy, Debug)]
pub struct ColorFilter {
    /// Its colour at rest.
    pub color: SurfaceColor,
    /// The Doppler factor with which it is seen.
    pub doppler: f64,
}

/// The colours of a scene, and how they appear in motion: for corners, samples and rays.
pub struct Appearance {
    /// The colours of the scene.
    pub palette: Palette,
    /// Colours and rest positions of its vertices.
    pub surface: SurfaceAttributes,
    /// The shift of hues; none if colours are spectra.
    pub hue_shift: HueShift,
    hues: &'static HueTable,
    /// `None` if colours are hues or wavelengths.
    spectra: Option<Spectra>,
    /// Linear light of hues is clipped to this.
    ceiling: f64,
}

impl Appearance {
    /// The colours of `scene`, whose vertices are part of one body each, shifted by `shift`.
    ///
    /// `eye`: in scene coordinates. `reach`: the |ln D| of spectra that are fast to compute, as a
    /// multiple of the greatest rapidity; 1 for light straight from a body.
    pub fn new(
        scene: &Scene,
        eye: DVec3,
        interpolation: Interpolation,
        shift: ColorShift,
        reach: f64,
    ) -> Self {
        let (hue_shift, hues) = (shift.of_hues(), HueTable::get());
        // Light straight from a body crosses no filters, whose hues count.
        let has_hues_of_light = reach != 1.0 || hue_shift != HueShift::NONE;
        let palette = Palette::new(scene, interpolation, shift.is_spectral(), has_hues_of_light);
        let surface = SurfaceAttributes::new(scene, eye, &palette);
        let spectra = match shift {
            ColorShift::Spectra(shift) => {
                let reach = reach * surface.greatest_rapidity();
                Some(Spectra::new(scene, shift, surface.mixtures(scene), reach))
            }
            ColorShift::Hues(_) => None,
        };
        Self { palette, surface, hue_shift, hues, spectra, ceiling: f64::INFINITY }
    }

    /// The same with tables for the light of that many lamps; see [`Appearance::light`].
    #[must_use]
    pub fn with_tables(mut self, n_lamps: usize) -> Self {
        self.spectra = self.spectra.map(|spectra| spectra.with_tables(n_lamps));
        self
    }

    /// The same with the linear light of hues clipped to white, as in 1988.
    #[must_use]
    pub fn clipped(self) -> Self {
        Self { ceiling: 1.0, ..self }
    }

    /// True if colours given as light can be drawn on moving bodies: they are spectra, or nothing
    /// is shifted.
    pub fn keeps_light(&self) -> bool {
        self.spectra.is_some() || self.hue_shift == HueShift::NONE
    }

    /// True if colours are spectra.
    #[inline]
    pub fn is_spectral(&self) -> bool {
        self.spectra.is_some()
    }

    /// False for black bodies and sampled spectra, whose light is their own, where colours are
    /// spectra.
    pub fn is_lit(&self, color: &SurfaceColor) -> bool {
        self.spectra.as_ref().is_none_or(|spectra| strongest(spectra, color.rows).is_surface())
    }

    /// The colour of a point of a texture with this linear red, green and blue, on a body that
    /// moves or not. It is drawn as a `c_rgb` is: as light at rest, and as its hue or spectrum in
    /// motion.
    pub fn texel(&self, light: DVec3, translucency: f64, is_moving: bool) -> SurfaceColor {
        if let Some(spectra) = &self.spectra {
            let swatch = Swatch { translucency, ..self.palette.white() };
            return SurfaceColor { swatch, rows: spectra.texel_rows(light) };
        }
        let form = if self.keeps_light() || !is_moving {
            ColorForm::Display(light)
        } else {
            ColorForm::Hue
        };
        let swatch = Swatch { form, translucency, ..self.palette.swatch(texel_hsv(light)) };
        SurfaceColor::even(swatch, 0)
    }

    /// The colour at rest that a surface emits; the light of its texel if it is a picture.
    pub fn emitted(&self, color: ColorId, texel: Option<DVec3>, is_moving: bool) -> SurfaceColor {
        if let Some(light) = texel {
            return self.texel(light, 0.0, is_moving);
        }
        let (keeps_light, own) = (self.keeps_light() || !is_moving, self.palette.get(color));
        let swatch = if keeps_light { own } else { self.palette.drawn_as(Mixing::Hue, own) };
        SurfaceColor::even(swatch, self.surface.row_of(Some(color)))
    }

    /// Linear light of a colour as seen under a level of light, as a renderer draws it.
    pub fn drawn_light(&self, seen: &Swatch, level: DVec3) -> DVec3 {
        let hue = || self.hue_shift.brightened(self.hue_color(seen), level.x).light();
        seen.form.lit(level).unwrap_or_else(hue)
    }

    /// The wavelength that a tint stands for, as [`Appearance::seen`] requires it.
    #[inline]
    pub fn wavelength_nm(&self, tint: f64) -> f64 {
        match self.palette.interpolation {
            Interpolation::Hue => self.hues.wavelength_nm(tint),
            Interpolation::Wavelength => tint,
        }
    }

    /// The apparent colour of `color` where wavelengths are stretched by `stretch` = 1/D. `rest_nm`:
    /// the wavelength of its tint.  Eq. (P11), (P12), (P18)
    ///
    /// A colour drawn as light is returned unchanged. On moving bodies such colours occur only in
    /// spectral mode; otherwise the renderer replaces them by hues.
    #[inline]
    pub fn seen(&self, mut color: Swatch, rest_nm: f64, stretch: f64) -> Swatch {
        if stretch == 1.0 || color.form != ColorForm::Hue {
            return color;
        }
        let factor = self.hue_shift.law.factor(1.0 / stretch);
        if self.hue_shift.law.acts_on_light() {
            color.factor *= factor;
        } else {
            color.value *= factor;
        }
        if self.hue_shift.doppler && !color.is_grey() {
            // λ/D, as a product, since this runs for every sample.
            let seen_nm = rest_nm * stretch;
            // The wavelength may be invisible; a hue is clamped to the end of its range.
            color.tint = match self.palette.interpolation {
                Interpolation::Hue => self.hues.hue(seen_nm),
                Interpolation::Wavelength => seen_nm,
            };
        }
        color
    }

    /// A colour at rest with its wavelength.
    pub fn hue_color(&self, rest: &Swatch) -> HueColor {
        let Hsv { hue, saturation, value } = self.palette.hsv(rest);
        let wavelength_nm = if rest.is_grey() { 0.0 } else { self.wavelength_nm(rest.tint) };
        HueColor { hue, wavelength_nm, saturation, value, factor: rest.factor }
    }

    /// [`Appearance::seen`] under lamps, which may be coloured: the colour contains their light.
    /// Where colours are spectra, and under a law that names a quantity, it is given as light,
    /// since the light of lamps adds up.  Eq. (P14)
    pub fn seen_lit(
        &self,
        color: &SurfaceColor,
        stretch: f64,
        light: &[Irradiance],
        lamps: &Lamps,
    ) -> Swatch {
        let (rest, doppler) = (&color.swatch, 1.0 / stretch);
        if self.is_spectral() || self.hue_shift.law.acts_on_light() {
            let light = self.light(color, doppler, Illumination::Lamps(light, lamps), &[]);
            return Swatch { form: ColorForm::Light(light), ..*rest };
        }
        let seen = self.hue_shift.seen_lit(self.hue_color(rest), doppler, light, lamps);
        let tint = match self.palette.interpolation {
            Interpolation::Hue => seen.hue,
            Interpolation::Wavelength => seen.wavelength_nm,
        };
        Swatch {
            tint,
            saturation: seen.saturation,
            value: seen.value,
            factor: seen.factor,
            ..*rest
        }
    }

    /// Linear red, green and blue of a surface under `light` and behind `filters`, seen with the
    /// Doppler factor `doppler`: for rays, which may reach the eye by way of mirrors and glass.
    /// Eq. (P14)
    pub fn light(
        &self,
        color: &SurfaceColor,
        doppler: f64,
        light: Illumination<'_>,
        filters: &[ColorFilter],
    ) -> DVec3 {
        match &self.spectra {
            Some(spectra) => spectral_light(spectra, color, doppler, light, filters),
            None => self.hue_light(&color.swatch, doppler, light) * self.transmitted(filters),
        }
    }

    /// [`Appearance::light`] of a hue, or of a colour that is given as light, without filters.
    /// Light of a display that something shifts is the hue that it stands for.
    fn hue_light(&self, rest: &Swatch, doppler: f64, light: Illumination<'_>) -> DVec3 {
        let shift = self.hue_shift;
        let of_level = |level: f64| {
            let base = shift.brightened(self.hue_color(rest), level);
            shift.seen(base, doppler).light()
        };
        let display = match (rest.form, light) {
            (ColorForm::Display(own), Illumination::Level(level)) if !shift.shifts(doppler) => {
                Some(shift.lit_display(own, DVec3::splat(level)))
            }
            (ColorForm::Display(own), Illumination::Lamps(parts, lamps)) => {
                shift.display_lit((own, self.hue_color(rest)), doppler, parts, lamps)
            }
            _ => None,
        };
        if let Some(lit) = display {
            return lit.min(DVec3::splat(self.ceiling));
        }
        let seen = match (rest.form, light) {
            (ColorForm::Light(own), Illumination::Level(level)) => return level * own,
            (ColorForm::Light(own), Illumination::Lamps(parts, lamps)) => {
                let received = |part: &Irradiance| part.level * lamps[part.lamp as usize].linear;
                return own * parts.iter().map(received).sum::<DVec3>();
            }
            (_, Illumination::Level(level)) => of_level(level),
            (_, Illumination::Lamps(parts, lamps)) if is_plain(parts) && !lamps.is_colored => {
                let of_lamp = |part: &Irradiance| shift.color_of(&lamps[part.lamp as usize]).x;
                of_level(parts.iter().map(|part| part.level * of_lamp(part)).sum())
            }
            (_, Illumination::Lamps(parts, lamps)) => {
                self.light_of_lamps(rest, doppler, parts, lamps)
            }
        };
        seen.min(DVec3::splat(self.ceiling))
    }

    /// Linear light of a hue under lamps, which may be coloured, and move. Light adds up, as seen,
    /// under a law that names a quantity; otherwise display-encoded colours do.  Eq. (P14)
    fn light_of_lamps(
        &self,
        rest: &Swatch,
        doppler: f64,
        parts: &[Irradiance],
        lamps: &[Lamp],
    ) -> DVec3 {
        let base = self.hue_color(rest);
        let seen =
            |parts: &[Irradiance]| self.hue_shift.seen_lit(base, doppler, parts, lamps).light();
        if self.hue_shift.law.acts_on_light() {
            parts.chunks(1).map(seen).sum()
        } else {
            seen(parts)
        }
    }

    /// The part of linear red, green and blue that filters transmit, whose hues are shifted.
    pub fn transmitted(&self, filters: &[ColorFilter]) -> DVec3 {
        let part = |filter: &ColorFilter| {
            let base = self.hue_color(&filter.color.swatch);
            let wavelength_nm = self.hue_shift.wavelength_nm(base.wavelength_nm, filter.doppler);
            let hue =
                if base.saturation > 0.0 { wavelength_to_hue(wavelength_nm) } else { base.hue };
            let hsv = Hsv { hue, saturation: base.saturation, value: base.value };
            shown_light(hsv)
        };
        filters.iter().map(part).product()
    }

    /// Linear red, green and blue of a weighted mean of spectra, where wavelengths are stretched by
    /// `stretch` = 1/D. White unless colours are spectra.
    ///
    /// `parts`: rows of spectra with their weights.
    pub fn seen_light(&self, parts: impl IntoIterator<Item = (u32, f64)>, stretch: f64) -> DVec3 {
        let Some(spectra) = &self.spectra else { return DVec3::ONE };
        spectra.light(parts, -libm::log(stretch))
    }
}

/// True if all light comes from lamps at rest with the surface.
fn is_plain(parts: &[Irradiance]) -> bool {
    parts.iter().all(|part| part.doppler == 1.0)
}

/// [`Appearance::light`] of spectra.
fn spectral_light(
    spectra: &Spectra,
    color: &SurfaceColor,
    doppler: f64,
    light: Illumination<'_>,
    filters: &[ColorFilter],
) -> DVec3 {
    let of_daylight = match light {
        Illumination::Level(level) => Some(level),
        Illumination::Lamps(parts, lamps) => (lamps.is_daylight && is_plain(parts)).then(|| {
            parts.iter().map(|part| part.level * lamps[part.lamp as usize].intensity).sum()
        }),
    };
    if let (Some(level), []) = (of_daylight, filters) {
        return level * spectra.light(color.rows, libm::log(doppler));
    }
    let filter = |filter: &ColorFilter| SpectralFilter {
        color: strongest(spectra, filter.color.rows),
        doppler: filter.doppler,
    };
    let filters: Vec<_> = filters.iter().map(filter).collect();
    let white = [Irradiance { lamp: 0, level: 1.0, doppler: 1.0 }];
    let daylight = of_daylight.map(|level| [Lamp::white(crate::LampPlace::Everywhere, level)]);
    let (parts, lamps) = match (light, &daylight) {
        (Illumination::Lamps(parts, lamps), _) => (parts, &lamps[..]),
        (Illumination::Level(_), Some(lamp)) => (&white[..], &lamp[..]),
        (Illumination::Level(_), None) => (&[][..], &[][..]),
    };
    mean(color.rows, |row| spectra.lit(row, doppler, parts, lamps, &filters))
}

/// The weighted mean of rows. `light`: of a row.
fn mean(rows: SpectralRows, light: impl Fn(u32) -> DVec3) -> DVec3 {
    let parts = rows.into_iter().filter(|(_, weight)| *weight != 0.0);
    parts.map(|(row, weight)| weight * light(row)).sum()
}

/// The spectrum that counts for a filter: the one of the greatest weight.
fn strongest(spectra: &Spectra, rows: SpectralRows) -> &Spectrum {
    let row = rows.into_iter().reduce(|best, row| if row.1 > best.1 { row } else { best });
    spectra.spectrum(row.map_or(0, |row| row.0))
}
