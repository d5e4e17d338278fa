//! From linear light to the range of a display: exposure, tone mapping, gamut mapping.  Eq. (P30)

use ugphysics::luminance;

use crate::LinearFrame;

/// The tone curve, which maps luminance to the range of a display, 0…1. The *white point* is the
/// smallest luminance that maps to 1.
///
/// Both curves are increasing and map 0 to 0. They are applied to luminance, and the ratios of red,
/// green and blue are kept: greys stay grey, and no hue changes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Tone {
    /// Linear up to 1 and clipped there. The white point is 1.
    #[default]
    Clip,
    /// The curve of J. Hable, *Filmic Tonemapping Operators* (filmicworlds.com, 2010): a toe, a
    /// linear part and a shoulder. The white point is 5.6: Hable's linear white point 11.2 divided
    /// by his exposure bias 2.
    Filmic,
}

impl Tone {
    /// All curves, the default first.
    pub const ALL: [Self; 2] = [Self::Clip, Self::Filmic];

    /// The name of the curve.
    pub fn name(self) -> &'static str {
        match self {
            Self::Clip => "clip",
            Self::Filmic => "filmic",
        }
    }

    /// The white point: the smallest luminance that is shown as white.
    pub fn white(self) -> f64 {
        match self {
            Self::Clip => 1.0,
            Self::Filmic => LINEAR_WHITE / EXPOSURE_BIAS,
        }
    }

    /// The largest median of an automatic exposure. A filmic curve compresses what is above it, and
    /// whitens colours there. Found by trial: with it, scenes at rest and photographs keep about
    /// the brightness that they have without a look.
    fn largest_median(self) -> f64 {
        match self {
            Self::Clip => self.white(),
            Self::Filmic => 0.63,
        }
    }

    /// The displayed luminance, 0…1, of a `luminance` ≥ 0.
    pub fn at(self, luminance: f64) -> f64 {
        if luminance >= self.white() {
            return 1.0;
        }
        match self {
            Self::Clip => luminance,
            Self::Filmic => hable(EXPOSURE_BIAS * luminance) / hable(LINEAR_WHITE),
        }
    }
}

const LINEAR_WHITE: f64 = 11.2;
const EXPOSURE_BIAS: f64 = 2.0;

/// The curve as published, with its published parameter names and values.
fn hable(x: f64) -> f64 {
    const SHOULDER: f64 = 0.15;
    const LINEAR: f64 = 0.50;
    const ANGLE: f64 = 0.10;
    const TOE: f64 = 0.20;
    const NUMERATOR: f64 = 0.02;
    const DENOMINATOR: f64 = 0.30;
    let above = x * (SHOULDER * x + ANGLE * LINEAR) + TOE * NUMERATOR;
    let below = x * (SHOULDER * x + LINEAR) + TOE * DENOMINATOR;
    above / below - NUMERATOR / DENOMINATOR
}

/// How linear light is converted for a display.  Eq. (P30)
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Development {
    /// The exposure: light is first multiplied by 2 to this power.
    pub stops: f64,
    /// The tone curve.
    pub tone: Tone,
}

/// The intermediate results for one pixel, as linear red, green and blue.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DevelopmentSteps {
    /// After the exposure.
    pub exposed: [f64; 3],
    /// After the tone curve.
    pub toned: [f64; 3],
    /// After gamut mapping: each channel 0…1.
    pub shown: [f64; 3],
}

impl Development {
    /// Converts one pixel and returns the result of every step.
    pub fn steps(&self, light: [f32; 3]) -> DevelopmentSteps {
        self.steps_with(libm::exp2(self.stops), light)
    }

    #[inline]
    fn steps_with(&self, gain: f64, light: [f32; 3]) -> DevelopmentSteps {
        let exposed = light.map(|channel| f64::from(channel) * gain);
        let toned = self.toned(exposed);
        DevelopmentSteps { exposed, toned, shown: into_gamut(toned) }
    }

    /// Converts one pixel; see [`Development::converter`].
    pub fn apply(&self, light: [f32; 3]) -> [f32; 3] {
        self.converter()(light)
    }

    /// Converts pixels: each channel of a result is 0…1. With the default settings, light already
    /// in that range keeps its bits.
    pub fn converter(self) -> impl Fn([f32; 3]) -> [f32; 3] + Sync {
        let gain = libm::exp2(self.stops);
        let is_plain = self.stops == 0.0 && self.tone == Tone::Clip;
        move |light| {
            if is_plain && light.iter().all(|channel| (0.0..=1.0).contains(channel)) {
                return light;
            }
            self.steps_with(gain, light).shown.map(|channel| channel as f32)
        }
    }

    #[inline]
    fn toned(&self, exposed: [f64; 3]) -> [f64; 3] {
        let before = luminance(exposed);
        // Negative and NaN luminance becomes black.
        if before.is_nan() || before <= 0.0 {
            return [0.0; 3];
        }
        if before == f64::INFINITY {
            return [1.0; 3];
        }
        let ratio = self.tone.at(before) / before;
        if ratio == 1.0 { exposed } else { exposed.map(|channel| channel * ratio) }
    }
}

/// Gamut mapping of a colour of luminance 0…1: mixes it with the grey of its own luminance, as
/// little as possible. This keeps luminance and dominant wavelength, since the colour moves
/// straight towards white in the chromaticity diagram.
#[inline]
fn into_gamut(rgb: [f64; 3]) -> [f64; 3] {
    // The clamp removes rounding: the weights of luminance add up to 1 only approximately.
    let grey = luminance(rgb).clamp(0.0, 1.0);
    let part = rgb.iter().fold(1.0f64, |part, &channel| {
        let away = channel - grey;
        if channel > 1.0 {
            part.min((1.0 - grey) / away)
        } else if channel < 0.0 {
            part.min(grey / -away)
        } else {
            part
        }
    });
    if part == 1.0 {
        rgb
    } else {
        rgb.map(|channel| (grey + part * (channel - grey)).clamp(0.0, 1.0))
    }
}

/// The fraction of lit pixels that automatic exposure keeps at or below the white point.
const BELOW_WHITE: f64 = 0.99;

/// The automatic exposure, in stops: the largest that puts 99 percent of the lit pixels at or below
/// the white point of the curve and, for a filmic curve, their median at or below a luminance that
/// is shown as the sRGB level 0.63. The second limit applies to pictures of low contrast, such as a
/// house at rest, which would be nearly white otherwise. Lit pixels are covered (alpha above 0) and
/// not black. Rounded to hundredths, so that it can be printed and passed again exactly; 0 if there
/// are no lit pixels.
pub fn auto_exposure(frame: &LinearFrame, tone: Tone) -> f64 {
    let luminance_of = |&[r, g, b, _]: &[f32; 4]| luminance([r, g, b].map(f64::from)) as f32;
    let mut seen: Vec<f32> = frame
        .pixels()
        .iter()
        .filter(|pixel| pixel[3] > 0.0)
        .map(luminance_of)
        .filter(|light| *light > 0.0 && light.is_finite())
        .collect();
    let Some(last) = seen.len().checked_sub(1) else { return 0.0 };
    let mut gain = |part: f64, shown: f64| {
        let rank = (last as f64 * part).round() as usize;
        shown / f64::from(*seen.select_nth_unstable_by(rank, f32::total_cmp).1)
    };
    let stops = libm::log2(gain(BELOW_WHITE, tone.white()).min(gain(0.5, tone.largest_median())));
    (100.0 * stops).round() / 100.0
}

#[cfg(test)]
mod tests {
    use ugtesting::Random;

    use super::*;

    /// The published code, for a scalar.
    #[test]
    fn filmic_is_as_published() {
        let f =
            |x: f64| ((x * (0.15 * x + 0.05) + 0.004) / (x * (0.15 * x + 0.5) + 0.06)) - 0.02 / 0.3;
        for x in [0.0, 0.01, 0.18, 0.5, 1.0, 2.0, 5.5999] {
            assert!((Tone::Filmic.at(x) - f(2.0 * x) / f(11.2)).abs() < 1e-15, "{x}");
        }
        assert_eq!(Tone::Filmic.at(5.6), 1.0);
    }

    #[test]
    fn tone_curves_increase_from_black_to_white() {
        for tone in Tone::ALL {
            assert!(tone.at(0.0).abs() < 1e-16);
            let steps = 100_000;
            let levels: Vec<f64> = (0..=steps)
                .map(|step| tone.at(1.01 * tone.white() * f64::from(step) / f64::from(steps)))
                .collect();
            assert!(levels.windows(2).all(|pair| pair[0] <= pair[1]), "{tone:?}");
            assert!(levels.iter().all(|level| (-1e-16..=1.0).contains(level)));
            assert_eq!(tone.at(tone.white()), 1.0);
        }
    }

    fn noise(count: usize, scale: f32) -> Vec<[f32; 3]> {
        let mut random = Random(7);
        (0..count).map(|_| [(); 3].map(|()| scale * random.between(-0.25, 0.75) as f32)).collect()
    }

    /// Gamut mapping moves a colour on a line through the grey of its luminance, so the difference
    /// from that grey keeps its direction.
    #[test]
    fn gamut_mapping_keeps_hue_and_luminance() {
        for scale in [1.0, 3.0, 40.0] {
            for light in noise(20_000, scale) {
                for development in [
                    Development::default(),
                    Development { stops: -2.5, tone: Tone::Clip },
                    Development { stops: 1.0, tone: Tone::Filmic },
                ] {
                    let DevelopmentSteps { exposed, toned, shown } = development.steps(light);
                    assert!(shown.iter().all(|channel| (0.0..=1.0).contains(channel)), "{shown:?}");
                    if luminance(exposed) <= 0.0 {
                        assert_eq!(shown, [0.0; 3]);
                        continue;
                    }
                    let wanted = development.tone.at(luminance(exposed));
                    assert!((luminance(toned) - wanted).abs() < 1e-12);
                    assert!((luminance(shown) - wanted).abs() < 1e-12, "{light:?}: {shown:?}");
                    // The chroma vector after is parallel to the one before and not reversed: no
                    // hue changes.
                    let away = |rgb: [f64; 3]| rgb.map(|channel| channel - luminance(rgb));
                    let (before, after) = (away(exposed), away(shown));
                    let across = cross(before, after);
                    assert!(
                        dot(across, across).sqrt() <= 1e-9 * dot(before, before).sqrt().max(1.0)
                    );
                    assert!(dot(before, after) >= -1e-12);
                }
            }
        }
    }

    fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
        a.iter().zip(b).map(|(a, b)| a * b).sum()
    }

    fn cross([a, b, c]: [f64; 3], [d, e, f]: [f64; 3]) -> [f64; 3] {
        [b * f - c * e, c * d - a * f, a * e - b * d]
    }

    #[test]
    fn displayable_light_is_unchanged() {
        for light in noise(10_000, 1.0) {
            let light = light.map(|channel| channel.clamp(0.0, 1.0));
            assert_eq!(Development::default().apply(light), light);
        }
        assert_eq!(Development::default().apply([1.0; 3]), [1.0; 3]);
        assert_eq!(Development::default().apply([7.0; 3]), [1.0; 3]);
        assert_eq!(Development { stops: 1.0, ..Development::default() }.apply([0.25; 3]), [0.5; 3]);
    }

    #[test]
    fn nan_and_infinities_give_valid_colours() {
        let odd = [0.0, -0.0, 1e-45, 1e38, -1e38, f32::INFINITY, f32::NEG_INFINITY, f32::NAN];
        for r in odd {
            for g in odd {
                for tone in Tone::ALL {
                    for stops in [0.0, 1000.0, -1000.0, 3.0] {
                        let shown = Development { stops, tone }.apply([r, g, 0.5]);
                        assert!(
                            shown.iter().all(|x| (0.0..=1.0).contains(x)),
                            "{r} {g} {stops}: {shown:?}"
                        );
                    }
                }
            }
        }
    }

    #[test]
    fn automatic_exposure_shows_99_of_100_below_white() {
        // Of high contrast: 600 of 1000 pixels are lit by less than a hundredth of the brightest.
        let light = (1..=1000u16).map(|k| f32::from(k) * if k > 600 { 0.37 } else { 0.0037 });
        let frame = LinearFrame::new(
            [100, 10],
            true,
            light.map(|light| [light, light, light, 1.0]).collect(),
        );
        for tone in Tone::ALL {
            let gain = libm::exp2(auto_exposure(&frame, tone));
            let white =
                frame.pixels().iter().filter(|p| f64::from(p[0]) * gain >= tone.white()).count();
            // Rounding the exposure to a hundredth of a stop changes light by up to 0.35 percent.
            assert!((4..=17).contains(&white), "{tone:?}: {white}");
        }
        let black = LinearFrame::new([1, 1], true, vec![[0.0, 0.0, 0.0, 1.0]]);
        assert_eq!(auto_exposure(&black, Tone::Clip), 0.0);
        // Uncovered pixels do not count.
        let back =
            LinearFrame::new([2, 1], true, vec![[9.0, 9.0, 9.0, 0.0], [0.25, 0.25, 0.25, 0.5]]);
        assert_eq!(auto_exposure(&back, Tone::Clip), 2.0);
        // One brightness is not shown as white by a filmic curve.
        let shown = Tone::Filmic.at(0.25 * libm::exp2(auto_exposure(&back, Tone::Filmic)));
        assert!((shown - 0.36).abs() < 0.01, "{shown}");
    }
}
