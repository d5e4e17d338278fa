//! The text colour for a background.

use crate::figure::Rgb;
use ugphysics::{luminance, srgb_decode};

/// A background of higher luminance (in linear light) than this has more contrast to black than to
/// white.
const MIDDLE: f64 = 0.179;

/// Black or white, whichever has more contrast to a background.
pub fn ink_on(ground: Rgb) -> Rgb {
    let light = luminance(ground.map(|level| srgb_decode(f64::from(level) / 255.0)));
    if light > MIDDLE { [0; 3] } else { [255; 3] }
}
