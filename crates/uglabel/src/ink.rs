//! The colour of text.

use ugimage::figure::Rgb;
use ugphysics::{luminance, srgb_decode};

/// A ground that is lighter than this, in linear light, contrasts more with black than with white.
const MIDDLE: f64 = 0.179;

/// Black or white, whichever contrasts more with a ground.
pub fn ink_on(ground: Rgb) -> Rgb {
    let light = luminance(ground.map(|level| srgb_decode(f64::from(level) / 255.0)));
    if light > MIDDLE { [0; 3] } else { [255; 3] }
}
