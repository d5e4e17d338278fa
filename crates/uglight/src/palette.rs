//! The colours of a scene, converted for interpolation.

use std::borrow::Cow;

use glam::DVec3;
use ugphysics::{
    Brightness, Hsv, attenuation, hue_to_wavelength, srgb_decode, srgb_encode, wavelength_to_hue,
};
use ugscene::{ColorId, ColorValue, HueScale, Scene, StageError, Tint};

use crate::color::shown_light;
use crate::{ColorForm, Mixing};

/// The interpolated quantity, besides saturation and value.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Interpolation {
    /// The hue, linearly from −60° to 300° and never across that boundary, because a hue stands for
    /// a wavelength.
    #[default]
    Hue,
    /// The wavelength.
    Wavelength,
}

impl Interpolation {
    /// Reads the hue fields of a scene in this scale, unless the scene states one, and returns the
    /// interpolated quantity: that of wavelengths is the wavelength.
    ///
    /// # Errors
    /// The scene states another scale.
    pub fn of_scene(self, scene: &mut Cow<'_, Scene>, scale: HueScale) -> Result<Self, StageError> {
        let scale = ugscene::hue_scale(scene, scale)?;
        if scale != scene.stage.hue_scale() {
            ugscene::read_tints_in(scene.to_mut(), scale);
        }
        Ok(if scale == HueScale::Wavelengths { Self::Wavelength } else { self })
    }
}

/// A colour ready for interpolation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Swatch {
    /// Hue in −60…300 degrees, or wavelength in nanometres, depending on the [`Interpolation`].
    /// Undefined if the saturation is 0.
    pub tint: f64,
    /// 0 grey … 1 pure.
    pub saturation: f64,
    /// Not negative.
    pub value: f64,
    /// Factor of the linear light that tint, saturation and value stand for. At rest it is 1; laws
    /// that act on linear light change it instead of the value.
    pub factor: f64,
    /// What it is drawn as. If it is light, tint, saturation and value are those of the nearest
    /// colour that a display has. In a [`Palette`], the light of a display is drawn as the hue it
    /// stands for, unless corners of a face differ.
    pub form: ColorForm,
    /// 0 opaque … 1 fully transparent.
    pub translucency: f64,
}

impl Swatch {
    /// The colour of objects without a colour.
    pub const WHITE: Self = Self {
        tint: 0.0,
        saturation: 0.0,
        value: 1.0,
        factor: 1.0,
        form: ColorForm::Hue,
        translucency: 0.0,
    };

    /// True if it has no tint.
    pub fn is_grey(&self) -> bool {
        self.saturation == 0.0
    }

    /// The weighted mean, number by number; the weights add up to 1. A number that is the same in
    /// all of them keeps its bits.
    pub fn mean<const N: usize>(all: &[Self; N], weights: [f64; N]) -> Self {
        let first = all[0];
        let others = || all.iter().zip(weights).skip(1);
        let number = |of: fn(&Self) -> f64| {
            others().fold(of(&first), |sum, (one, weight)| sum + weight * (of(one) - of(&first)))
        };
        let parts = all.iter().zip(weights).map(|(one, weight)| Some(weight * one.form.light()?));
        Self {
            tint: number(|swatch| swatch.tint),
            saturation: number(|swatch| swatch.saturation),
            value: number(|swatch| swatch.value),
            factor: number(|swatch| swatch.factor),
            form: parts
                .sum::<Option<DVec3>>()
                .map_or(ColorForm::Hue, |light| first.form.mixing().form(light)),
            translucency: number(|swatch| swatch.translucency),
        }
    }
}

/// The colours of a scene, and how they are interpolated.
#[derive(Clone, Debug)]
pub struct Palette {
    /// All colours in the order of the scene's table.
    pub swatches: Vec<Swatch>,
    /// The interpolated quantity.
    pub interpolation: Interpolation,
    /// Colours are spectra.
    is_spectral: bool,
    /// Light may be drawn as the nearest hue.
    has_hues_of_light: bool,
    /// A colour of the scene is drawn as light.
    pub has_light: bool,
    /// Colours of a display may be drawn as light.
    pub has_display: bool,
    /// A colour of the scene is not opaque.
    pub has_translucency: bool,
}

impl Palette {
    /// Converts all colours of a scene.
    ///
    /// `is_spectral`: colours are spectra, so all of them are drawn as light. `has_hues_of_light`:
    /// whether colours given as light need their hue as well, which takes long to find.
    pub fn new(
        scene: &Scene,
        interpolation: Interpolation,
        is_spectral: bool,
        has_hues_of_light: bool,
    ) -> Self {
        let has_light =
            is_spectral || scene.colors.iter().any(|color| Mixing::of(color) == Mixing::Light);
        let has_translucency = scene.colors.iter().any(|color| color.translucency > 0.0);
        let mut palette = Self {
            swatches: Vec::new(),
            interpolation,
            is_spectral,
            has_hues_of_light,
            has_light,
            has_display: false,
            has_translucency,
        };
        let ids = (0..scene.colors.len()).map(ColorId::from_index);
        palette.swatches = ids.map(|id| palette.read(scene, id)).collect();
        // One colour is drawn as a hue, unless hues fade there.
        let has_mixtures = palette.swatches.len() > 1;
        let is_drawn = |swatch: &Swatch| {
            swatch.form.mixing() == Mixing::Display && (has_mixtures || palette.is_faded(swatch))
        };
        palette.has_display = palette.swatches.iter().any(is_drawn);
        palette
    }

    /// The colour `color` of the scene.
    pub fn get(&self, color: ColorId) -> Swatch {
        self.swatches[color.index()]
    }

    /// The colour of objects without a colour; given as light if colours are spectra.
    pub fn white(&self) -> Swatch {
        Swatch { form: self.marked(ColorForm::Hue), ..Swatch::WHITE }
    }

    /// The form in which a colour is drawn. Where colours are spectra all are light, which is
    /// computed per sample.
    pub(crate) fn marked(&self, form: ColorForm) -> ColorForm {
        if self.is_spectral { ColorForm::Light(form.light().unwrap_or(DVec3::ONE)) } else { form }
    }

    /// True if a hue is attenuated, because it stands for a wavelength near the ends of the visible
    /// range.  Eq. (P17)
    pub fn is_faded(&self, swatch: &Swatch) -> bool {
        let is_full = match self.interpolation {
            Interpolation::Hue => (0.0..=240.0).contains(&swatch.tint),
            Interpolation::Wavelength => attenuation(swatch.tint) >= 1.0,
        };
        !swatch.is_grey() && !is_full
    }

    /// The light of a colour: linear red, green and blue. Its hue is attenuated near the ends of
    /// the visible range.  Eq. (P17)
    pub fn light(&self, swatch: &Swatch) -> DVec3 {
        swatch.form.light().unwrap_or_else(|| {
            let seen = self.hsv(swatch).attenuated(attenuation(self.wavelength_nm(swatch)));
            swatch.factor * shown_light(seen)
        })
    }

    /// The wavelength a tint stands for.
    pub fn wavelength_nm(&self, swatch: &Swatch) -> f64 {
        match self.interpolation {
            Interpolation::Hue => hue_to_wavelength(swatch.tint),
            Interpolation::Wavelength => swatch.tint,
        }
    }

    /// The colour converted to a hue.
    pub fn hsv(&self, swatch: &Swatch) -> Hsv {
        let hue = match self.interpolation {
            Interpolation::Hue => swatch.tint,
            Interpolation::Wavelength => wavelength_to_hue(swatch.tint),
        };
        Hsv { hue, saturation: swatch.saturation, value: swatch.value }
    }

    /// A colour with a hue, converted for interpolation.
    pub fn swatch(&self, color: Hsv) -> Swatch {
        let tint = match self.interpolation {
            Interpolation::Hue => spectral(color.hue),
            Interpolation::Wavelength => hue_to_wavelength(color.hue),
        };
        Swatch { tint, saturation: color.saturation, value: color.value, ..Swatch::WHITE }
    }

    /// The colour drawn as `mixing` says.
    #[inline]
    pub fn drawn_as(&self, mixing: Mixing, swatch: Swatch) -> Swatch {
        let form = match mixing {
            Mixing::Hue => ColorForm::Hue,
            mixing => mixing.form(self.light(&swatch)),
        };
        Swatch { form, ..swatch }
    }

    fn read(&self, scene: &Scene, id: ColorId) -> Swatch {
        let color = &scene.colors[id.index()];
        let translucency = color.translucency;
        // In other scenes the factor is part of the value, which light levels multiply.
        let is_linear = scene.stage.law().is_some_and(Brightness::acts_on_light);
        let swatch = match color.value {
            // Used unchanged, because an invisible wavelength has no hue.
            ColorValue::Hsv { value, tint: Tint::Wavelength(tint), saturation, factor }
                if self.interpolation == Interpolation::Wavelength =>
            {
                let [value, factor] =
                    if is_linear { [value, factor] } else { [value_times(value, factor), 1.0] };
                Swatch { tint, saturation, value, factor, ..Swatch::WHITE }
            }
            ColorValue::Hsv { .. } if is_linear => {
                let (color, factor) = crate::hsv_and_factor(scene, color);
                Swatch { factor, ..self.swatch(color) }
            }
            ColorValue::Rgb(_) if !self.is_spectral => self.swatch(crate::display_hue(scene, id)),
            _ if !self.has_hues_of_light && Mixing::of(color) == Mixing::Light => Swatch::WHITE,
            _ => self.swatch(crate::hsv(scene, color)),
        };
        Swatch { form: self.marked(crate::color_form(scene, color)), translucency, ..swatch }
    }
}

/// The value of a colour with its linear light multiplied.
fn value_times(value: f64, factor: f64) -> f64 {
    if factor == 1.0 { value } else { srgb_encode(factor * srgb_decode(value)) }
}

/// A hue converted to −60…300 degrees.
fn spectral(hue: f64) -> f64 {
    if (-60.0..=300.0).contains(&hue) { hue } else { wavelength_to_hue(hue_to_wavelength(hue)) }
}
