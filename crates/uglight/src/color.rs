//! The value of a colour statement: a hue, light, or a spectrum.

use std::sync::LazyLock;

use glam::DVec3;
use ugphysics::spectrum::Spectrum;
use ugphysics::{
    Hsv, linear_srgb_to_xyz, srgb_decode, srgb_encode, wavelength_to_hue, xyz_to_linear_srgb,
};
use ugscene::{Color, ColorId, ColorValue, Note, Scene, Tint};

/// How colours mix and are lit, by the way they are written. A mixture is like the greatest of its
/// parts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Mixing {
    /// `c`: by hue, saturation and value. Light multiplies the value.
    Hue,
    /// `c_rgb`, red, green and blue of a display: as light. Light multiplies the display-encoded
    /// channels, as it does the value of a hue.
    Display,
    /// `c_xyz`, `c_bb`, `c_spd`, `c_refl`: as light. Light multiplies light.
    Light,
}

impl Mixing {
    /// How a colour statement mixes.
    pub fn of(color: &Color) -> Self {
        match color.value {
            ColorValue::Hsv { .. } => Self::Hue,
            ColorValue::Rgb(_) => Self::Display,
            _ => Self::Light,
        }
    }

    /// Light that mixes so; a hue needs none.
    pub fn form(self, light: DVec3) -> ColorForm {
        match self {
            Self::Hue => ColorForm::Hue,
            Self::Display => ColorForm::Display(light),
            Self::Light => ColorForm::Light(light),
        }
    }
}

/// What a colour is drawn as: a hue, or linear red, green and blue with the sRGB primaries, neither
/// clipped nor gamut-mapped.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ColorForm {
    /// See [`Mixing::Hue`].
    Hue,
    /// See [`Mixing::Display`].
    Display(DVec3),
    /// See [`Mixing::Light`].
    Light(DVec3),
}

impl ColorForm {
    /// How it mixes.
    pub fn mixing(self) -> Mixing {
        match self {
            Self::Hue => Mixing::Hue,
            Self::Display(_) => Mixing::Display,
            Self::Light(_) => Mixing::Light,
        }
    }

    /// The light that it is drawn as; `None` for a hue.
    pub fn light(self) -> Option<DVec3> {
        match self {
            Self::Hue => None,
            Self::Display(light) | Self::Light(light) => Some(light),
        }
    }

    /// Its light under levels of red, green and blue; `None` for a hue.
    pub fn lit(self, level: DVec3) -> Option<DVec3> {
        match self {
            Self::Hue => None,
            Self::Display(light) => Some(lit_display(light, level)),
            Self::Light(light) => Some(light * level),
        }
    }
}

/// A colour at rest: of a statement, or mixed of several.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RestColor {
    /// As [`hsv`].
    pub hsv: Hsv,
    /// As [`color_form`].
    pub form: ColorForm,
    /// 0 opaque … 1 fully transparent.
    pub translucency: f64,
}

impl RestColor {
    /// The colour of what has none.
    pub const WHITE: Self = Self {
        hsv: Hsv { hue: 0.0, saturation: 0.0, value: 1.0 },
        form: ColorForm::Hue,
        translucency: 0.0,
    };

    /// The colour of a statement, or white.
    pub fn new(scene: &Scene, color: Option<ColorId>) -> Self {
        color.map_or(Self::WHITE, |id| {
            let color = &scene.colors[id.index()];
            Self {
                hsv: hsv(scene, color),
                form: color_form(scene, color),
                translucency: color.translucency,
            }
        })
    }

    /// Linear red, green and blue.
    pub fn linear(&self) -> DVec3 {
        self.form.light().unwrap_or_else(|| shown_light(self.hsv))
    }

    /// A statement of it. A mixture that is brighter than the largest `c_rgb`, because a colour of
    /// it has a factor above 1, is written as light (`c_xyz`).
    pub fn value(&self) -> ColorValue {
        let Hsv { hue, saturation, value } = self.hsv;
        match self.form {
            ColorForm::Hue => {
                ColorValue::Hsv { value, tint: Tint::Hue(hue), saturation, factor: 1.0 }
            }
            ColorForm::Display(_) if value <= 1.0 => ColorValue::Rgb(self.hsv.to_rgb()),
            ColorForm::Display(light) | ColorForm::Light(light) => {
                ColorValue::Xyz(linear_srgb_to_xyz(light.to_array()))
            }
        }
    }

    /// Equal for equal colours.
    pub fn key(&self) -> [u64; 5] {
        let Hsv { hue, saturation, value } = self.hsv;
        let [a, b, c] = match self.form {
            // Its hue is clipped.
            ColorForm::Light(light) => light.to_array(),
            _ => [hue, saturation, value],
        };
        let [a, b, c, translucency] = [a, b, c, self.translucency].map(f64::to_bits);
        [self.form.mixing() as u64, a, b, c, translucency]
    }
}

/// A colour statement as hue in degrees, saturation and value.
///
/// Wavelengths outside 380…780 nm become the hue at that end of the range, (P16). Black bodies and
/// spectra get their colour at rest, see [`spectra_note`]. Colours outside the gamut of a screen
/// are clipped to it.
pub fn hsv(scene: &Scene, color: &Color) -> Hsv {
    match color.value {
        ColorValue::Rgb(rgb) => Hsv::from_rgb(rgb),
        ColorValue::Xyz(xyz) => shown(xyz),
        ColorValue::Blackbody { .. } | ColorValue::Spectrum { .. } => {
            shown(spectrum(scene, color).0.seen(1.0))
        }
        ColorValue::Hsv { value, tint, saturation, factor } => {
            let color = Hsv { hue: hue(tint), saturation, value };
            if factor == 1.0 { color } else { brightened(color, factor) }
        }
    }
}

/// A colour with its linear light multiplied. The transfer function of displays is not a power, so
/// hue and saturation change a little.
fn brightened(color: Hsv, factor: f64) -> Hsv {
    Hsv::from_rgb(
        color.to_rgb().map(|channel| srgb_encode(brightest(factor * srgb_decode(channel)))),
    )
}

/// Light whose sums are finite: brighter light is shown as bright as this.
fn brightest(light: f64) -> f64 {
    light.min(1e300)
}

/// A colour statement like [`hsv`], and the factor on its linear light, which leaves hue and
/// saturation as they are written.
pub fn hsv_and_factor(scene: &Scene, color: &Color) -> (Hsv, f64) {
    match color.value {
        ColorValue::Hsv { value, tint, saturation, factor } => {
            (Hsv { hue: hue(tint), saturation, value }, factor)
        }
        _ => (hsv(scene, color), 1.0),
    }
}

fn hue(tint: Tint) -> f64 {
    match tint {
        Tint::Hue(hue) => hue,
        Tint::Wavelength(wavelength_nm) => wavelength_to_hue(wavelength_nm),
    }
}

/// Linear red, green and blue as the hue, saturation and value that a display shows: channels below
/// 0 are clipped, those above 1 are kept.
pub(crate) fn encoded_hsv(linear: DVec3) -> Hsv {
    Hsv::from_rgb(linear.to_array().map(|channel| srgb_encode(channel.max(0.0))))
}

/// Steps of the table of [`texel_hsv`].
const ENCODED_STEPS: usize = 1024;

/// Like [`encoded_hsv`], fast enough for every texel: within 10⁻⁶, from a table over square roots.
pub(crate) fn texel_hsv(linear: DVec3) -> Hsv {
    static ENCODED: LazyLock<Vec<f64>> = LazyLock::new(|| {
        let root = |step: usize| step as f64 / ENCODED_STEPS as f64;
        (0..=ENCODED_STEPS).map(|step| srgb_encode(root(step) * root(step))).collect()
    });
    let encode = |channel: f64| {
        let place = channel.max(0.0).sqrt() * ENCODED_STEPS as f64;
        match ENCODED.get(place as usize..place as usize + 2) {
            Some(&[below, above]) => below + place.fract() * (above - below),
            _ => srgb_encode(channel.max(0.0)),
        }
    };
    Hsv::from_rgb(linear.to_array().map(encode))
}

/// Linear red, green and blue that a display shows of a colour.
pub(crate) fn shown_light(color: Hsv) -> DVec3 {
    DVec3::from_array(color.to_rgb().map(srgb_decode))
}

/// Linear light of a surface whose colour is that of a display, under levels of red, green and
/// blue: they multiply display-encoded channels, as they do of hues.
pub(crate) fn lit_display(linear: DVec3, level: DVec3) -> DVec3 {
    if level == DVec3::ONE {
        return linear;
    }
    let lit = |channel: f64, level: f64| srgb_decode(srgb_encode(channel) * level);
    DVec3::new(lit(linear.x, level.x), lit(linear.y, level.y), lit(linear.z, level.z))
}

/// The hue of red, green and blue of a display. That of a mixture of other colours (`c_mix`) is the
/// mean of their hues, as the renderer of 1988 interpolates them: its own statement is the mixture
/// of their light.
pub fn display_hue(scene: &Scene, id: ColorId) -> Hsv {
    let of = |id: ColorId| hsv(scene, &scene.colors[id.index()]);
    match scene.mix_of(id) {
        [] => of(id),
        parts => mean_hue(parts.iter().map(|&(part, share)| (of(part), share))),
    }
}

/// What a colour statement is drawn as at rest: unless it is a hue, linear red, green and blue
/// without clipping, so channels may be above 1 and below 0.  Eq. (P19)
pub fn color_form(scene: &Scene, color: &Color) -> ColorForm {
    let light = |xyz| ColorForm::Light(DVec3::from_array(xyz_to_linear_srgb(xyz)));
    match color.value {
        ColorValue::Hsv { .. } => ColorForm::Hue,
        ColorValue::Rgb(rgb) => ColorForm::Display(DVec3::from_array(rgb.map(srgb_decode))),
        ColorValue::Xyz(xyz) => light(ugphysics::limited(xyz, ugphysics::MOST_LIGHT)),
        _ => light(spectrum(scene, color).0.seen(1.0)),
    }
}

/// X, Y, Z as the hue, saturation and value of a screen; colours outside its gamut are clipped.
fn shown(xyz: [f64; 3]) -> Hsv {
    /// Sums of such numbers are finite. Brighter light is shown as bright as this.
    const BRIGHTEST: f64 = 1e300;
    let largest = xyz.iter().fold(BRIGHTEST, |largest, part| largest.max(part.abs()));
    let xyz = xyz.map(|part| part * (BRIGHTEST / largest));
    encoded_hsv(DVec3::from_array(xyz_to_linear_srgb(xyz)))
}

/// The spectrum of a colour statement: for `c`, `c_rgb` and `c_xyz` that of a surface of
/// this colour (P20). False if its colour at rest differs from the one stated, which happens to a
/// `c_xyz` that is more saturated than a smooth reflectance allows.
pub fn spectrum(scene: &Scene, color: &Color) -> (Spectrum, bool) {
    let of_screen = |rgb: [f64; 3], factor: f64| {
        let light = rgb.map(|channel| brightest(factor * srgb_decode(channel)));
        (Spectrum::with_infrared(linear_srgb_to_xyz(light), scene.infrared).0, true)
    };
    match color.value {
        ColorValue::Rgb(rgb) => of_screen(rgb, 1.0),
        ColorValue::Hsv { value, tint, saturation, factor } => {
            of_screen(Hsv { hue: hue(tint), saturation, value }.to_rgb(), factor)
        }
        ColorValue::Xyz(xyz) => Spectrum::with_infrared(xyz, scene.infrared),
        ColorValue::Blackbody { kelvin, scale } => (Spectrum::blackbody(kelvin, scale), true),
        ColorValue::Spectrum { reflects, start, end } => {
            let samples = &scene.samples[start as usize..end as usize];
            (
                if reflects { Spectrum::reflectance(samples) } else { Spectrum::samples(samples) },
                true,
            )
        }
    }
}

/// The note on a scene where something is drawn or lit with a black body or spectrum, of which
/// [`hsv`] uses the colour at rest only.
pub fn spectra_note(scene: &Scene) -> Option<Note> {
    let has_spectrum = |color: &Color| {
        matches!(color.value, ColorValue::Blackbody { .. } | ColorValue::Spectrum { .. })
    };
    // Most scenes have none, and there is no need to test their vertices.
    if !scene.colors.iter().any(has_spectrum) {
        return None;
    }
    let is_spectrum = |id: &ColorId| has_spectrum(&scene.colors[id.index()]);
    // The colours of vertices override that of their face.
    let needs_color = |rows: &std::ops::Range<u32>| {
        let corners = scene.contours.corners(rows.clone());
        corners.iter().any(|corner| scene.vertices[corner.index()].color.is_none())
    };
    let vertices = scene.vertices.iter().filter_map(|vertex| vertex.color);
    let drawn =
        scene.drawn().filter(|drawn| needs_color(&drawn.contours)).filter_map(|drawn| drawn.color);
    let lights = scene.lights.iter().filter_map(|light| light.color);
    let color = vertices.chain(drawn).chain(lights).find(is_spectrum)?;
    Some(Note::SpectraAtRest {
        color: scene.names.get(scene.colors[color.index()].name).to_owned(),
    })
}

/// The weighted means of hue, saturation and value, as the renderer of 1988 interpolates them
/// between the corners of a face. Wavelengths in place of hues are averaged alike. Greys do not
/// contribute to the hue.
pub fn mean_hue(parts: impl Iterator<Item = (Hsv, f64)>) -> Hsv {
    let (mut mean, mut hue_weight) = (Hsv { hue: 0.0, saturation: 0.0, value: 0.0 }, 0.0);
    for (color, weight) in parts {
        mean.value += weight * color.value;
        mean.saturation += weight * color.saturation;
        if color.saturation > 0.0 {
            mean.hue += weight * below_violet(color.hue);
            hue_weight += weight;
        }
    }
    if hue_weight > 0.0 {
        mean.hue /= hue_weight;
    }
    // Weights may add up to more than 1 by rounding.
    Hsv { saturation: mean.saturation.min(1.0), ..mean }
}

/// Maps hues between violet (300) and red (360) to negative ones, (P16). Larger numbers are
/// wavelengths.
fn below_violet(hue: f64) -> f64 {
    if hue > 300.0 && hue < 360.0 { hue - 360.0 } else { hue }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn black_bodies_and_spectra_have_their_colour_at_rest() {
        let shown = |statement: &str| {
            let source = ugparse::Source::new("t.ug", statement);
            let scene = ugparse::parse(&source, &ugparse::Options::default()).unwrap().scene;
            hsv(&scene, &scene.colors[0])
        };
        // Reddish below the temperature of daylight, bluish above, and as bright as the scale says.
        assert!((15.0..45.0).contains(&shown("c_bb glow 3000 0.2;").hue));
        assert!((210.0..240.0).contains(&shown("c_bb star 15000 0.2;").hue));
        let linear = shown("c_bb glow 5000 0.2;").to_rgb().map(srgb_decode);
        assert!((ugphysics::luminance(linear) - 0.2).abs() < 1e-4);
        // Lines of a nanometre: no screen shows them, but their hues are plain.
        assert!((shown("c_spd sodium 588 0 589 100 590 0;").hue - 40.0).abs() < 10.0);
        assert!((shown("c_spd green 531 0 532 100 533 0;").hue - 120.0).abs() < 20.0);
        assert_eq!(shown("c_spd infrared 900 1 1000 1;").value, 0.0);
    }
}
