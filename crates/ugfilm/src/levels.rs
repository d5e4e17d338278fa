//! Frames that are nearly black or overexposed.

use ugimage::{Development, Frame, LinearFrame, Quantizer};
use ugpicture::{Backdrop, PictureOptions};

/// Least level of a channel, of 255, that is well visible beside white.
const VISIBLE: u8 = 24;

/// A frame is nearly black if less than one of this many pixels is visible.
const FEW: usize = 500;

/// A frame is overexposed if more than one of this many pixels that are not background is white.
const MANY: usize = 10;

/// What is wrong with the brightness of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Brightness {
    /// Hardly any pixel is visible.
    NearlyBlack,
    /// Many pixels are white, where details may be lost.
    Overexposed,
}

impl Brightness {
    /// What is wrong with the 8-bit pixels of a frame with these options; `None` if nothing is, or
    /// the frame shows only the background. White is expected in a
    /// picture without an exposure or tone curve, whose surfaces may be white.
    pub fn of(frame: &Frame, picture: &PictureOptions) -> Option<Self> {
        let development = picture.development(|| LinearFrame::new([1, 1], true, vec![[0.0; 4]]));
        let background = Backdrop::new(picture.background, 1).developed(Some(development));
        let quantizer = Quantizer::new();
        let background = background.map(|light| light.map(|channel| quantizer.level(channel)));
        let (mut n_visible, mut n_white, mut n_seen) = (0, 0, 0);
        for &[red, green, blue, alpha] in frame.pixels() {
            n_visible += usize::from(red.max(green).max(blue) >= VISIBLE && alpha >= VISIBLE);
            let is_seen = alpha > 0 && background != Some([red, green, blue]);
            n_seen += usize::from(is_seen);
            n_white += usize::from(is_seen && [red, green, blue] == [255; 3]);
        }
        if n_seen == 0 {
            return None;
        }
        if n_visible * FEW < frame.pixels().len() {
            return Some(Self::NearlyBlack);
        }
        (picture.keeps_light() && n_white * MANY > n_seen).then_some(Self::Overexposed)
    }

    /// That of light, developed as the options say at an exposure.
    pub fn of_light(light: &LinearFrame, picture: &PictureOptions, stops: f64) -> Option<Self> {
        let development = Development { stops, tone: picture.tone };
        let mut light = light.clone();
        for [red, green, blue, _] in light.pixels_mut() {
            [*red, *green, *blue] = development.apply([*red, *green, *blue]);
        }
        let exposure = Some(ugpicture::Exposure::Stops(stops));
        Self::of(&light.to_display(), &PictureOptions { exposure, ..picture.clone() })
    }
}

/// Frames whose brightness is wrong.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct WrongBrightness {
    /// Those that are nearly black.
    pub nearly_black: Vec<u32>,
    /// Those that are overexposed.
    pub overexposed: Vec<u32>,
}

impl WrongBrightness {
    /// Adds a frame.
    pub fn add(&mut self, frame: u32, brightness: Option<Brightness>) {
        match brightness {
            Some(Brightness::NearlyBlack) => self.nearly_black.push(frame),
            Some(Brightness::Overexposed) => self.overexposed.push(frame),
            None => {}
        }
    }
}
