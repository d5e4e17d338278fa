//! Levels of a picture: whether it is nearly black or overexposed.

use rayon::prelude::*;
use ugimage::{Development, Frame, LinearFrame, Quantizer, display_pixel};

use crate::background::Backdrop;
use crate::exposure::Exposure;
use crate::image::Image;
use crate::note::Note;
use crate::options::PictureOptions;

/// Least level of a channel, of 255, that is well visible beside white.
const VISIBLE: u8 = 24;

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
pub struct LevelCounts {
    n_pixels: u64,
    /// Not outside the scene; in an opaque picture of 8 bits every pixel counts.
    n_covered: u64,
    /// Covered, and of another colour than the background.
    n_seen: u64,
    n_visible: u64,
    n_white: u64,
}

impl LevelCounts {
    /// Those of 8-bit pixels. `background`: its light as it is in the picture; `None` if it is
    /// transparent.
    pub fn of_pixels(pixels: &[[u8; 4]], background: Option<[f32; 3]>) -> Self {
        let background = background_level(background, &Quantizer::new());
        let mut counts = Self::default();
        pixels.iter().for_each(|&pixel| counts.add(pixel, pixel[3] > 0, background));
        counts
    }

    fn of_frame(frame: &Frame, background: Option<[f32; 3]>) -> Self {
        let chunks = frame.pixels().par_chunks(CHUNK);
        chunks.map(|pixels| Self::of_pixels(pixels, background)).reduce(Self::default, Self::plus)
    }

    /// Those of light for a display. The fourth channel of an opaque picture is its covered part,
    /// too.
    fn of_light(light: &LinearFrame, background: Option<[f32; 3]>) -> Self {
        let quantizer = Quantizer::new();
        let background = background_level(background, &quantizer);
        let of_chunk = |pixels: &[[f32; 4]]| {
            let mut counts = Self::default();
            for &pixel in pixels {
                let level = display_pixel(&quantizer, pixel, light.is_opaque());
                counts.add(level, pixel[3] > 0.0, background);
            }
            counts
        };
        light.pixels().par_chunks(CHUNK).map(of_chunk).reduce(Self::default, Self::plus)
    }

    fn add(&mut self, [red, green, blue, alpha]: [u8; 4], is_covered: bool, background: Option<[u8; 3]>) {
        let is_seen = is_covered && background != Some([red, green, blue]);
        self.n_pixels += 1;
        self.n_covered += u64::from(is_covered);
        self.n_seen += u64::from(is_seen);
        self.n_visible += u64::from(red.max(green).max(blue) >= VISIBLE && alpha >= VISIBLE);
        self.n_white += u64::from(is_seen && [red, green, blue] == [255; 3]);
    }

    /// The sum of those of two parts of a picture.
    #[must_use]
    pub fn plus(self, other: Self) -> Self {
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
    pub fn note(&self, picture: &PictureOptions) -> Option<Note> {
        let Self { n_pixels, n_covered, n_seen, n_visible, n_white } = *self;
        if n_covered == 0 {
            return None;
        }
        if n_visible * FEW < n_pixels && n_visible * SMALL_PART <= n_seen {
            return Some(Note::NearlyBlack { is_exposed: picture.exposure.is_some() });
        }
        let is_chosen = picture.keeps_light() && picture.exposure != Some(Exposure::Auto);
        (is_chosen && n_white * MANY > n_seen).then_some(Note::Overexposed)
    }
}

fn background_level(background: Option<[f32; 3]>, quantizer: &Quantizer) -> Option<[u8; 3]> {
    background.map(|light| light.map(|channel| quantizer.level(channel)))
}

/// The note on the levels of a developed picture without annotations, see [`LevelCounts::note`].
pub fn of_image(image: &Image, development: Option<Development>, picture: &PictureOptions) -> Option<Note> {
    if picture.output.format().is_linear() {
        return None;
    }
    let background = Backdrop::new(picture.background, 1).developed(development);
    let counts = match image {
        Image::Display(frame) => LevelCounts::of_frame(frame, background),
        Image::Light(light) => LevelCounts::of_light(light, background),
    };
    counts.note(picture)
}

/// The note on the levels of light as a picture with these options shows it; see
/// [`LevelCounts::note`].
pub fn levels_note(light: &LinearFrame, picture: &PictureOptions) -> Option<Note> {
    let development = picture.development(|| light);
    let mut developed = light.clone();
    for [red, green, blue, _] in developed.pixels_mut() {
        [*red, *green, *blue] = development.apply([*red, *green, *blue]);
    }
    of_image(&Image::Light(developed), Some(development), picture)
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
        let transparent = PictureOptions { background: Background::Transparent, ..PictureOptions::default() };
        let pixels = |light: f32| LinearFrame::new([9, 1], false, vec![[light, light, light, 1.0]; 9]);
        assert_eq!(levels_note(&pixels(0.0), &transparent), Some(Note::NearlyBlack { is_exposed: false }));
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
