//! Conversion of interpolated numbers to light.

mod hues;
mod transfer;

use fearless_simd::{Level, Simd, dispatch};
use ugphysics::{attenuation, hue_to_wavelength, srgb_decode, srgb_encode, wavelength_to_hue};
use ugraster::{Encoding, RUN, SampleShading, ShadedRun, ShadedSample, TRANSPARENT_VALUES};

use crate::packing::Layout;
use hues::{Lights, all_between, decode_all, encode_all};
use transfer::decode;
use uglight::Interpolation;

/// Cells of each attenuation table.
const FADE_CELLS: usize = 1024;

/// Converts tint, saturation and value to linear light. Hues near the ends of the visible range are
/// attenuated.  Eq. (P17)
#[derive(Clone, Debug)]
pub struct Shader {
    interpolation: Interpolation,
    /// Values are clipped to this, or light is.
    ceiling: f32,
    /// Light levels multiply linear light; otherwise they multiply display-encoded values.
    acts_on_light: bool,
    /// Three numbers are light.
    is_light: bool,
    /// SIMD instructions of the processor. The result does not depend on them.
    level: Level,
    /// Attenuation for hues −60…0 and 240…300; in between it is 1. Tables, because the wavelength
    /// of a hue needs an iteration, too slow for each sample.
    red_fade: Table,
    violet_fade: Table,
}

impl Shader {
    /// Computes the tables. `is_clipped`: values of hues are clipped to 1, sample by sample, as in
    /// 1988; otherwise the transfer function is continued above 1. `acts_on_light`: light levels
    /// multiply linear light, see [`ugphysics::Brightness::acts_on_light`].
    pub fn new(
        interpolation: Interpolation,
        is_clipped: bool,
        acts_on_light: bool,
        layout: Layout,
    ) -> Self {
        let fade = |hue: f64| attenuation(hue_to_wavelength(hue));
        Self {
            interpolation,
            ceiling: if is_clipped { 1.0 } else { f32::INFINITY },
            acts_on_light,
            is_light: layout == Layout::Light,
            level: Level::new(),
            red_fade: Table::new(FADE_CELLS, |part| fade(-60.0 + 60.0 * part)),
            violet_fade: Table::new(FADE_CELLS, |part| fade(240.0 + 60.0 * part)),
        }
    }

    /// The light of one sample.
    pub fn one<const N: usize>(&self, sample: &[f32; N]) -> ShadedSample
    where
        Self: SampleShading<N>,
    {
        let mut run = ShadedRun::default();
        self.shade(sample.each_ref().map(std::slice::from_ref), Encoding::Linear, &mut run);
        run.get(0)
    }

    /// Display-encoded red, green and blue with their hue attenuated, the greatest of them before
    /// clipping likewise, and the attenuation.  Eq. (P17)
    fn faded(&self, levels: [f32; 3], intensity: f32) -> ([f32; 3], f32, f32) {
        let [red, green, blue] = levels;
        // All other hues are between 0° and 240°.
        if green >= red.min(blue) {
            return (levels, intensity, 1.0);
        }
        let (red_part, blue_part) = (red - green, blue - green);
        let fade = if blue_part >= red_part {
            self.violet_fade.at(red_part / blue_part)
        } else {
            self.red_fade.at(1.0 - blue_part / red_part)
        };
        let levels = [green + red_part * fade, green, green + blue_part * fade];
        (levels, intensity * (levels[0].max(levels[2]) / red.max(blue)), fade)
    }

    /// As [`Shader::faded`], of linear light. `lights`: the levels that are contained in it.
    fn faded_light(
        &self,
        light: [f32; 3],
        intensity: f32,
        lights: [f32; 3],
    ) -> ([f32; 3], f32, f32) {
        let most = lights.into_iter().fold(0.0, f32::max);
        if most <= 0.0 || light[1] >= light[0].min(light[2]) {
            return (light, intensity, 1.0);
        }
        let encoded = light.map(|channel| srgb_encode(f64::from(channel / most)) as f32);
        let (encoded, _, fade) = self.faded(encoded, 0.0);
        let seen = encoded.map(|channel| most * linear(channel));
        (seen, intensity * (seen[0].max(seen[2]) / light[0].max(light[2])), fade)
    }

    /// Shades a run of samples.
    fn lit_all(
        &self,
        [tints, saturations, values]: [&[f32]; 3],
        lights: Lights<'_>,
        encoding: Encoding,
        run: &mut ShadedRun,
    ) {
        let n = tints.len();
        // Set only where they are needed, since many runs are short.
        let (mut own_hues, mut own_fades): ([f32; RUN], [f32; RUN]);
        let hues = match self.interpolation {
            Interpolation::Hue => tints,
            Interpolation::Wavelength => {
                own_hues = [0.0; RUN];
                own_hues.iter_mut().zip(tints).for_each(|(hue, &tint)| *hue = self.hue(tint));
                &own_hues[..n]
            }
        };
        let fades = if all_between(self.level, tints, self.bright_tints()) {
            run.is_out_of_range[..n].fill(false);
            None
        } else {
            own_fades = [1.0; RUN];
            let [low, high] = self.bright_tints();
            for (idx, fade) in own_fades[..n].iter_mut().enumerate() {
                let is_product =
                    || lights.is_some_and(|lights| is_product(lights.map(|light| light[idx])));
                if !(low..=high).contains(&tints[idx]) && !is_product() {
                    *fade = self.fade(tints[idx], saturations[idx]);
                }
            }
            for (is_out, fade) in run.is_out_of_range.iter_mut().zip(&own_fades) {
                *is_out = *fade == 0.0;
            }
            Some(&own_fades[..n])
        };
        let numbers = [hues, saturations, values];
        if self.acts_on_light {
            encode_all(self.level, numbers, fades, None, f32::INFINITY, run);
            decode_all(self.level, n, f32::INFINITY, run);
            self.light_up(lights, n, encoding, run);
            return;
        }
        encode_all(self.level, numbers, fades, lights, self.ceiling, run);
        if let Some(lights) = lights {
            self.fade_products(lights, n, run);
        }
        if encoding == Encoding::Linear {
            decode_all(self.level, n, self.ceiling, run);
        }
    }

    /// Attenuates the products of colours with light in a run of `n` samples.
    fn fade_products(&self, lights: [&[f32]; 3], n: usize, run: &mut ShadedRun) {
        for idx in (0..n).filter(|&idx| is_product(lights.map(|light| light[idx]))) {
            let levels = run.light.each_ref().map(|channel| channel[idx]);
            let (levels, intensity, fade) = self.faded(levels, run.intensity[idx]);
            run.light.iter_mut().zip(levels).for_each(|(channel, level)| channel[idx] = level);
            run.intensity[idx] = intensity;
            run.is_out_of_range[idx] = fade == 0.0;
        }
    }

    /// Multiplies the linear light of `n` samples by light levels.
    fn light_up(&self, lights: Lights<'_>, n: usize, encoding: Encoding, run: &mut ShadedRun) {
        for idx in 0..n {
            let levels = lights.map_or([1.0; 3], |lights| lights.map(|level| level[idx]));
            let own = run.light.each_ref().map(|channel| channel[idx]);
            let (mut light, mut intensity) =
                times(own, linear(run.intensity[idx]), levels, self.ceiling);
            if is_product(levels) {
                let fade;
                (light, intensity, fade) = self.faded_light(light, intensity, levels);
                run.is_out_of_range[idx] = fade == 0.0;
            }
            let shown = match encoding {
                Encoding::Linear => light,
                Encoding::Display => light.map(|light| srgb_encode(f64::from(light)) as f32),
            };
            run.light.iter_mut().zip(shown).for_each(|(channel, light)| channel[idx] = light);
            run.intensity[idx] = intensity;
        }
    }

    #[inline]
    fn hue(&self, tint: f32) -> f32 {
        match self.interpolation {
            Interpolation::Hue => tint,
            Interpolation::Wavelength => wavelength_to_hue(f64::from(tint)) as f32,
        }
    }

    /// A range of tints that are not attenuated.
    fn bright_tints(&self) -> [f32; 2] {
        match self.interpolation {
            Interpolation::Hue => [0.0, 240.0],
            Interpolation::Wavelength => [436.0, 700.0],
        }
    }

    /// Attenuation of a tint; 1 for grey.
    fn fade(&self, tint: f32, saturation: f32) -> f32 {
        if saturation <= 0.0 {
            return 1.0;
        }
        match self.interpolation {
            Interpolation::Wavelength => attenuation(f64::from(tint)) as f32,
            Interpolation::Hue if tint < 0.0 => self.red_fade.at((tint + 60.0) / 60.0),
            Interpolation::Hue if tint > 240.0 => self.violet_fade.at((tint - 240.0) / 60.0),
            Interpolation::Hue => 1.0,
        }
    }
}

impl SampleShading<3> for Shader {
    fn shade(&self, color: [&[f32]; 3], encoding: Encoding, run: &mut ShadedRun) {
        if self.is_light {
            dispatch!(self.level, simd => set_light(simd, color, |_| true, self.ceiling, run));
            encode_light(color[0].len(), |_| true, encoding, run);
        } else {
            self.lit_all(color, None, encoding, run);
        }
    }
}

impl SampleShading<TRANSPARENT_VALUES> for Shader {
    fn shade(
        &self,
        [a, b, c, red, green, blue, is_light, _]: [&[f32]; TRANSPARENT_VALUES],
        encoding: Encoding,
        run: &mut ShadedRun,
    ) {
        // Without an early exit, which would prevent vectorization.
        let (mut has_light, mut has_hues) = (false, false);
        for &light in is_light {
            has_light |= light > 0.5;
            has_hues |= light.is_nan() | (light <= 0.5);
        }
        if has_hues {
            self.lit_all([a, b, c], Some([red, green, blue]), encoding, run);
        }
        if has_light {
            let is_given = |idx: usize| is_light[idx] > 0.5;
            dispatch!(self.level, simd => set_light(simd, [a, b, c], is_given, self.ceiling, run));
            encode_light(a.len(), is_given, encoding, run);
        }
    }
}

/// True if light of these levels is coloured: what is seen is then the product of two colours, and
/// the hue of the product fades.
#[inline]
fn is_product([red, green, blue]: [f32; 3]) -> bool {
    red != green || green != blue
}

/// Linear light of a display-encoded level, which may be above 1.
fn linear(level: f32) -> f32 {
    if level <= 1.0 { decode(level) } else { srgb_decode(f64::from(level)) as f32 }
}

/// Linear light under levels of light, and its greatest channel before it is clipped to `ceiling`.
/// Clipping keeps hue and saturation. `peak`: the greatest channel under white light.
fn times(light: [f32; 3], peak: f32, levels: [f32; 3], ceiling: f32) -> ([f32; 3], f32) {
    let most = if peak > 0.0 { ceiling / peak } else { f32::INFINITY };
    let intensity = levels.into_iter().map(|level| peak * level).fold(0.0, f32::max);
    (std::array::from_fn(|i| light[i] * levels[i].min(most)), intensity)
}

/// Sets the samples whose colours are given as light, clipped to `ceiling`.
#[inline(always)] // Compiled for several instruction sets.
fn set_light<S: Simd>(
    _: S,
    light: [&[f32]; 3],
    is_given: impl Fn(usize) -> bool,
    ceiling: f32,
    run: &mut ShadedRun,
) {
    let n = light[0].len().min(RUN);
    let [red, green, blue] = light.map(|channel| &channel[..n]);
    let [reds, greens, blues] = run.light.each_mut().map(|channel| &mut channel[..n]);
    let (intensity, is_out_of_range) = (&mut run.intensity[..n], &mut run.is_out_of_range[..n]);
    for idx in 0..n {
        let is_given = is_given(idx);
        reds[idx] = if is_given { red[idx].min(ceiling) } else { reds[idx] };
        greens[idx] = if is_given { green[idx].min(ceiling) } else { greens[idx] };
        blues[idx] = if is_given { blue[idx].min(ceiling) } else { blues[idx] };
        let most = 0.0f32.max(red[idx]).max(green[idx]).max(blue[idx]);
        intensity[idx] = if is_given { most } else { intensity[idx] };
        is_out_of_range[idx] &= !is_given;
    }
}

/// Encodes the samples that are light for a display, if that is wanted.
fn encode_light(
    n: usize,
    is_given: impl Fn(usize) -> bool,
    encoding: Encoding,
    run: &mut ShadedRun,
) {
    if encoding == Encoding::Display {
        for idx in (0..n).filter(|&idx| is_given(idx)) {
            run.light
                .iter_mut()
                .for_each(|light| light[idx] = srgb_encode(f64::from(light[idx])) as f32);
        }
    }
}

/// A function on 0…1, interpolated linearly between tabulated points.
#[derive(Clone, Debug)]
struct Table(Vec<f32>);

impl Table {
    fn new(n_cells: usize, function: impl Fn(f64) -> f64) -> Self {
        Self((0..=n_cells).map(|point| function(point as f64 / n_cells as f64) as f32).collect())
    }

    /// The value at `x`, which is clamped to 0…1.
    #[inline]
    fn at(&self, x: f32) -> f32 {
        let n_cells = self.0.len() - 1;
        let place = x.clamp(0.0, 1.0) * n_cells as f32;
        let cell = (place as usize).min(n_cells - 1);
        let part = place - cell as f32;
        self.0[cell] * (1.0 - part) + self.0[cell + 1] * part
    }
}

#[cfg(test)]
mod tests {
    use ugphysics::Hsv;
    use ugtesting::Random;

    use super::*;

    fn hues(interpolation: Interpolation, is_clipped: bool, acts_on_light: bool) -> Shader {
        Shader::new(interpolation, is_clipped, acts_on_light, Layout::Hues)
    }

    fn exact(hue: f64, saturation: f64, value: f64) -> [f64; 3] {
        Hsv { hue, saturation, value: value.min(1.0) }.to_rgb().map(srgb_decode)
    }

    #[track_caller]
    fn assert_light(shade: &ShadedSample, light: [f64; 3]) {
        for (ours, exact) in shade.light.iter().zip(light) {
            // Two table look-ups in single precision: 1e-6 is a thousandth of a level.
            assert!((f64::from(*ours) - exact).abs() < 1e-6, "{shade:?} {light:?}");
        }
    }

    #[test]
    fn hues_fade_as_their_wavelengths() {
        let shader = hues(Interpolation::Hue, true, false);
        for step in 0..=3600 {
            let hue = f64::from(step) / 10.0 - 60.0;
            let fade = attenuation(hue_to_wavelength(hue));
            let shade = shader.one(&[hue as f32, 1.0, 0.8]);
            assert_light(&shade, exact(hue, 1.0, 0.8 * fade));
            assert_eq!(shade.is_out_of_range, fade == 0.0, "hue {hue}");
        }
    }

    /// Expected light: the white part stays, the pure hue is attenuated.
    fn parts(hue: f64, saturation: f64, value: f64, fade: f64) -> [f64; 3] {
        let pure = Hsv { hue, saturation: 1.0, value: 1.0 }.to_rgb();
        pure.map(|pure| srgb_decode(value * ((1.0 - saturation) + saturation * fade * pure)))
    }

    #[test]
    fn of_pale_colours_the_hue_alone_fades() {
        let shader = hues(Interpolation::Hue, true, false);
        for hue in [-60.0, -59.0, -30.0, -1.0, 0.0, 120.0, 240.0, 250.0, 280.0, 299.0, 300.0] {
            let fade = attenuation(hue_to_wavelength(hue));
            let mut before = shader.one(&[hue as f32, 0.0, 0.8]).light;
            for step in 0..=1000 {
                let saturation = f64::from(step) / 1000.0;
                let shade = shader.one(&[hue as f32, saturation as f32, 0.8]);
                assert_light(&shade, parts(hue, saturation, 0.8, fade));
                // A thousandth of saturation is 0.0008 of display-encoded value, and the slope of
                // decoding is at most 2.3.
                for (now, before) in shade.light.iter().zip(before) {
                    assert!(
                        (now - before).abs() < 0.002,
                        "hue {hue}, saturation {saturation}: {shade:?}"
                    );
                }
                before = shade.light;
            }
        }
    }

    #[test]
    fn whitish_is_never_nearly_black() {
        for interpolation in [Interpolation::Hue, Interpolation::Wavelength] {
            let shader = hues(interpolation, true, false);
            let tints: [f32; 5] = match interpolation {
                Interpolation::Hue => [-60.0, -59.9, 299.9, 300.0, 120.0],
                Interpolation::Wavelength => [10.0, 379.9, 380.1, 779.9, 5000.0],
            };
            for tint in tints {
                for saturation in [0.0, 1e-6, 0.03, 0.1] {
                    for color in [
                        shader.one(&[tint, saturation, 1.0]),
                        shader.one(&[tint, saturation, 1.0, 1.0, 1.0, 1.0, 0.0, 0.0]),
                    ] {
                        // Nine tenths of display-encoded white are left.
                        let least = color.light.into_iter().fold(1.0, f32::min);
                        assert!(least > 0.78, "tint {tint}, saturation {saturation}: {color:?}");
                    }
                }
            }
        }
    }

    #[test]
    fn wavelengths_fade_at_both_ends() {
        let shader = hues(Interpolation::Wavelength, true, false);
        for nm in
            [300.0, 379.0, 380.0, 400.0, 435.8, 500.0, 589.0, 700.0, 740.0, 779.0, 780.0, 5000.0]
        {
            let fade = attenuation(nm);
            let shade = shader.one(&[nm as f32, 1.0, 1.0]);
            assert_light(&shade, exact(wavelength_to_hue(nm), 1.0, fade));
            assert_eq!(shade.is_out_of_range, fade == 0.0);
        }
    }

    /// Shades samples of N numbers as runs of various lengths and one by one, and compares.
    #[track_caller]
    fn check_runs<const N: usize>(shader: &Shader, samples: &[[f32; N]])
    where
        Shader: SampleShading<N>,
    {
        for n in [1, 7, 64, RUN] {
            for chunk in samples.chunks(n) {
                let columns: [Vec<f32>; N] =
                    std::array::from_fn(|i| chunk.iter().map(|numbers| numbers[i]).collect());
                let mut run = ShadedRun::default();
                shader.shade(columns.each_ref().map(|all| &all[..]), Encoding::Linear, &mut run);
                for (idx, numbers) in chunk.iter().enumerate() {
                    assert_eq!(run.get(idx), shader.one(numbers), "{numbers:?}, {n} at once");
                }
                shader.shade(columns.each_ref().map(|all| &all[..]), Encoding::Display, &mut run);
                for (idx, numbers) in chunk.iter().enumerate() {
                    let levels =
                        shader.one(numbers).light.map(|light| srgb_encode(f64::from(light)));
                    for (ours, exact) in run.get(idx).light.iter().zip(levels) {
                        // Where the curve is steepest, an error of 3e-7 in light is 4e-6 of a
                        // level.
                        assert!(
                            (f64::from(*ours) - exact).abs() < 4e-6 * exact.abs().max(1.0),
                            "{numbers:?}"
                        );
                    }
                }
            }
        }
    }

    #[test]
    fn many_at_once_are_shaded_like_one() {
        let mut random = Random(7);
        let mut unit = || random.unit() as f32;
        for (interpolation, low, high) in [
            (Interpolation::Hue, -60.0, 300.0),
            (Interpolation::Hue, 10.0, 230.0),
            (Interpolation::Wavelength, 300.0, 900.0),
        ] {
            let mut sample = || {
                let [tint, pure, saturation, value] = [unit(), unit(), unit(), 1.6 * unit()];
                let saturation = if pure < 0.2 {
                    0.0
                } else if pure > 0.8 {
                    1.0
                } else {
                    saturation
                };
                let lights = [1.5 * unit(), unit(), unit()];
                ([low + (high - low) * tint, saturation, value], lights, f32::from(unit() > 0.5))
            };
            let samples: Vec<_> = (0..1000).map(|_| sample()).collect();
            // The bits are the same with all SIMD instructions.
            let levels = [Level::new(), Level::baseline()];
            let kinds = [[true, false], [false, false], [true, true], [false, true]];
            for ([is_clipped, acts_on_light], level) in
                kinds.into_iter().flat_map(|kind| levels.map(|level| (kind, level)))
            {
                let shader = Shader { level, ..hues(interpolation, is_clipped, acts_on_light) };
                let few: Vec<_> = samples.iter().map(|(color, ..)| *color).collect();
                check_runs(&shader, &few);
                let all = samples
                    .iter()
                    .map(|&([a, b, c], [d, e, f], light)| [a, b, c, d, e, f, light, 0.0]);
                check_runs(&shader, &all.collect::<Vec<_>>());
                let shader = Shader { is_light: true, ..shader };
                check_runs(&shader, &few);
            }
        }
    }

    #[test]
    fn grey_has_no_wavelength() {
        let shade = hues(Interpolation::Wavelength, true, false).one(&[5000.0, 0.0, 0.5]);
        assert_light(&shade, [srgb_decode(0.5); 3]);
        let shade = hues(Interpolation::Hue, true, false).one(&[300.0, 0.0, 0.5]);
        assert_light(&shade, [srgb_decode(0.5); 3]);
    }

    #[test]
    fn intensity_is_told_before_clipping() {
        let shader = hues(Interpolation::Hue, true, false);
        let shade = shader.one(&[120.0, 0.5, 1.5]);
        assert_eq!(shade.intensity, 1.5);
        assert_light(&shade, exact(120.0, 0.5, 1.0));
        let shade = shader.one(&[0.0, 0.0, 1.0, 0.5, 2.0, 0.0, 0.0, 0.0]);
        assert_eq!(shade.intensity, 2.0);
        assert_light(&shade, [srgb_decode(0.5), 1.0, 0.0]);
    }

    /// Levels of a law that names a quantity multiply linear light; clipping keeps ratios of
    /// channels.
    #[test]
    fn levels_multiply_linear_light() {
        for hue in [40.0, 130.0, 200.0] {
            let own = exact(hue, 0.6, 0.5);
            for (is_clipped, level) in [(false, 0.25), (false, 7.0), (true, 0.25), (true, 7.0)] {
                let shader = hues(Interpolation::Hue, is_clipped, true);
                let shade = shader.one(&[hue as f32, 0.6, 0.5, level, level, level, 0.0, 0.0]);
                let bright = srgb_decode(0.5) * f64::from(level);
                let scale = f64::from(level) / if is_clipped { bright.max(1.0) } else { 1.0 };
                // Single precision, of which the level multiplies the errors.
                for (found, own) in shade.light.iter().zip(own) {
                    assert!(
                        (f64::from(*found) - scale * own).abs() < 1e-6 * scale.max(1.0),
                        "{shade:?}"
                    );
                }
                assert!((f64::from(shade.intensity) - bright).abs() < 1e-6);
            }
        }
    }

    #[test]
    fn without_a_ceiling_bright_colours_follow_the_curve() {
        let shader = hues(Interpolation::Hue, false, false);
        for value in [0.25, 1.0, 1.0001, 1.5, 40.0] {
            let shade = shader.one(&[120.0, 0.5, value]);
            let light = Hsv { hue: 120.0, saturation: 0.5, value: f64::from(value) }
                .to_rgb()
                .map(srgb_decode);
            for (ours, exact) in shade.light.iter().zip(light) {
                assert!(
                    (f64::from(*ours) - exact).abs() < 1e-6 * exact.max(1.0),
                    "{shade:?} {light:?}"
                );
            }
        }
        let light = [7.0, -0.5, 0.25];
        assert_eq!(shader.one(&[7.0, -0.5, 0.25, 1.0, 1.0, 1.0, 1.0, 0.0]).light, light);
        let hue = [120.0, 0.5, 0.25];
        assert_eq!(shader.one(&[120.0, 0.5, 0.25, 1.0, 1.0, 1.0, 0.0, 0.0]), shader.one(&hue));
        assert_eq!(Shader { is_light: true, ..shader }.one(&light).light, light);
    }
}
