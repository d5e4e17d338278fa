//! Levels of a picture: whether it is nearly black or overexposed.

use rayon::prelude::*;
use ugimage::{LinearFrame, Quantizer, display_pixel};

use crate::background::Backdrop;
use crate::exposure::Exposure;
use crate::image::Image;
use crate::note::Note;
use crate::options::PictureOptions;

/// Least level of a channel, of 255, that is well visible beside white.
const VISIBLE: u32 = 24;

/// A picture is nearly black if less than one of this many pixels is visible…
const FEW: u64 = 500;

/// …and at most one of this many that are not background: a small body, or stars, may be bright.
const SMALL_PART: u64 = 4;

/// A picture is overexposed if more than one of this many pixels that are not background is white.
const MANY: u64 = 10;

/// Pixels that one task counts.
const CHUNK: usize = 1 << 14;

/// How many pixels of a picture, without its annotations, are bright.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct LevelCounts {
    n_pixels: u32,
    /// Not outside the scene; in an opaque picture of 8 bits every pixel counts.
    n_covered: u32,
    /// Covered, and of another colour than the background.
    n_seen: u32,
    n_visible: u32,
    n_white: u32,
}

impl LevelCounts {
    /// Those of 8-bit pixels. `background`: its light as it is in the picture; `None` if it is
    /// transparent.
    fn of_pixels(pixels: &[[u8; 4]], background: Option<[f32; 3]>) -> Self {
        let background = color_of(background, &Quantizer::new());
        let of_chunk = |chunk: &[[u8; 4]]| {
            Self::of(chunk.iter().map(|&pixel| (pixel, pixel[3] > 0)), background)
        };
        pixels.par_chunks(CHUNK).map(of_chunk).reduce(Self::default, Self::plus)
    }

    /// Those of light for a display. The fourth channel of an opaque picture is its covered part,
    /// too.
    fn of_light(light: &LinearFrame, background: Option<[f32; 3]>) -> Self {
        let quantizer = Quantizer::new();
        let shown = |&pixel: &[f32; 4]| display_pixel(&quantizer, pixel, light.is_opaque());
        let pixels = light.pixels().iter().map(|pixel| (shown(pixel), pixel[3] > 0.0));
        Self::of(pixels, color_of(background, &quantizer))
    }

    /// Those of pixels that are covered or not. Without branches, so that several are counted at
    /// once.
    #[inline]
    fn of(pixels: impl Iterator<Item = ([u8; 4], bool)>, background: u32) -> Self {
        let mut counts = Self::default();
        for (pixel, is_covered) in pixels {
            let all = u32::from_le_bytes(pixel);
            let is_bright =
                (all & 255 >= VISIBLE) | (all >> 8 & 255 >= VISIBLE) | (all >> 16 & 255 >= VISIBLE);
            let is_seen = is_covered & (all & COLOR != background);
            counts.n_pixels += 1;
            counts.n_covered += u32::from(is_covered);
            counts.n_seen += u32::from(is_seen);
            counts.n_visible += u32::from(is_bright & (all >> 24 >= VISIBLE));
            counts.n_white += u32::from(is_seen & (all & COLOR == COLOR));
        }
        counts
    }

    /// The sum of those of two parts of a picture.
    fn plus(self, other: Self) -> Self {
        Self {
            n_pixels: self.n_pixels + other.n_pixels,
            n_covered: self.n_covered + other.n_covered,
            n_seen: self.n_seen + other.n_seen,
            n_visible: self.n_visible + other.n_visible,
            n_white: self.n_white + other.n_white,
        }
    }

    /// [`Note::NearlyBlack`] or [`Note::Overexposed`], if a picture with these options is; `None`
    /// if it shows only the background. White is expected without an exposure or tone curve,
    /// where surfaces may be white, and is rare with an automatic exposure but for lines.
    fn note(&self, picture: &PictureOptions) -> Option<Note> {
        let Self { n_pixels, n_covered, n_seen, n_visible, n_white } = *self;
        let [n_pixels, n_seen, n_visible, n_white] =
            [n_pixels, n_seen, n_visible, n_white].map(u64::from);
        if n_covered == 0 {
            return None;
        }
        if n_visible * FEW < n_pixels && n_visible * SMALL_PART <= n_seen {
            return Some(Note::NearlyBlack { is_exposed: picture.exposure.is_some() });
        }
        (may_be_overexposed(picture) && n_white * MANY > n_seen).then_some(Note::Overexposed)
    }
}

/// Red, green and blue of a pixel.
const COLOR: u32 = u32::from_le_bytes([255, 255, 255, 0]);

/// The background as it is in pixels; a number that no colour has if it is transparent.
fn color_of(background: Option<[f32; 3]>, quantizer: &Quantizer) -> u32 {
    let [red, green, blue] =
        background.map_or([0.0; 3], |light| light).map(|part| quantizer.level(part));
    if background.is_none() { u32::MAX } else { u32::from_le_bytes([red, green, blue, 0]) }
}

fn may_be_overexposed(picture: &PictureOptions) -> bool {
    picture.keeps_light() && picture.exposure != Some(Exposure::Auto)
}

/// True if so many pixels are visible that a picture is not nearly black. Few have to be looked at.
fn is_bright(pixels: &[[u8; 4]]) -> bool {
    let enough = pixels.len().div_ceil(FEW as usize);
    let is_visible = |[red, green, blue, alpha]: &&[u8; 4]| {
        u32::from(*alpha.min(red.max(green).max(blue))) >= VISIBLE
    };
    pixels.iter().filter(is_visible).take(enough).count() == enough
}

/// The note on the levels of a developed picture without annotations, see [`LevelCounts::note`].
pub fn of_image(image: &Image, picture: &PictureOptions) -> Option<Note> {
    if picture.output.format().is_linear() {
        return None;
    }
    let background = Backdrop::new(picture.background, 1).light();
    let counts = match image {
        Image::Display(frame) if !may_be_overexposed(picture) && is_bright(frame.pixels()) => {
            return None;
        }
        Image::Display(frame) => LevelCounts::of_pixels(frame.pixels(), background),
        Image::Light(light) => LevelCounts::of_light(light, background),
    };
    counts.note(picture)
}

/// [`Note::NearlyBlack`] or [`Note::Overexposed`], if light is so as a picture with these options
/// shows it.
pub fn levels_note(light: &LinearFrame, picture: &PictureOptions) -> Option<Note> {
    let development = picture.development(|| light);
    let convert = Backdrop::new(picture.background, 1).converter(development);
    let mut developed = light.clone();
    for pixel in developed.pixels_mut() {
        [pixel[0], pixel[1], pixel[2]] = convert(*pixel);
    }
    of_image(&Image::Light(developed), picture)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Background;

    /// A picture of 1000 × 1 pixels, of which `n` have `light` and cover the background.
    fn picture(light: f32, n: usize) -> LinearFrame {
        let pixel = |idx: usize| if idx < n { [light, light, light, 1.0] } else { [0.0; 4] };
        LinearFrame::new([1000, 1], true, (0..1000).map(pixel).collect())
    }

    #[test]
    fn dark_and_white_pictures_are_noted() {
        let with = |exposure| PictureOptions { exposure, ..PictureOptions::default() };
        let check = |light: f32, n: usize, exposure, expected: Option<Note>| {
            assert_eq!(levels_note(&picture(light, n), &with(exposure)), expected, "{light} {n}");
        };
        let dark = |is_exposed| Some(Note::NearlyBlack { is_exposed });
        let stops = |stops| Some(Exposure::Stops(stops));
        check(0.5, 1000, None, None);
        // Less than half a level is no light on a black background.
        check(1e-9, 500, None, dark(false));
        check(0.005, 500, None, dark(false));
        check(0.003, 500, stops(1.0), dark(true));
        check(0.003, 500, stops(6.0), None);
        // Nothing is covered, or little, which is bright.
        check(0.5, 0, None, None);
        check(0.5, 1, None, None);
        check(0.5, 500, stops(4.0), Some(Note::Overexposed));
        check(1.0, 500, None, None);
        check(0.5, 500, Some(Exposure::Auto), None);
    }

    #[test]
    fn a_transparent_picture_has_no_background() {
        let transparent =
            PictureOptions { background: Background::Transparent, ..PictureOptions::default() };
        let pixels =
            |light: f32| LinearFrame::new([9, 1], false, vec![[light, light, light, 1.0]; 9]);
        assert_eq!(
            levels_note(&pixels(0.0), &transparent),
            Some(Note::NearlyBlack { is_exposed: false })
        );
        assert_eq!(levels_note(&pixels(0.5), &transparent), None);
    }

    #[test]
    fn bands_add_up_to_the_picture() {
        let pixels: Vec<[u8; 4]> = (0..=255).map(|level| [level, level / 2, 0, 255]).collect();
        let (first, second) = pixels.split_at(99);
        let of = |pixels| LevelCounts::of_pixels(pixels, Some([0.0; 3]));
        assert_eq!(of(first).plus(of(second)), of(&pixels));
    }
}
