//! Pictures with other numbers of pixels.

use image::imageops::{FilterType, resize};
use image::{ImageBuffer, Rgba};
use ugimage::{Frame, Quantizer};
use ugphysics::srgb_decode;

/// A picture in another size: the mean of linear light, with weights that fall off linearly to zero
/// at the middles of the neighbouring pixels, of the picture or of the result, whichever are
/// larger.
pub fn scaled(frame: &Frame, [width, height]: [u32; 2], quantizer: &Quantizer) -> Frame {
    let light: Vec<f32> =
        (0..=255_u8).map(|level| srgb_decode(f64::from(level) / 255.0) as f32).collect();
    let premultiplied = |x, y| {
        let [red, green, blue, alpha] = frame.pixel(x, y);
        let part = f32::from(alpha) / 255.0;
        let [red, green, blue] = [red, green, blue].map(|level| part * light[usize::from(level)]);
        Rgba([red, green, blue, part])
    };
    let whole = ImageBuffer::from_fn(frame.width(), frame.height(), premultiplied);
    // This filter needs neither roots nor transcendental functions, so its bytes are the same
    // everywhere.
    let scaled = resize(&whole, width, height, FilterType::Triangle);
    let pixel = |&Rgba([red, green, blue, part]): &Rgba<f32>| {
        let [red, green, blue] = [red, green, blue]
            .map(|light| quantizer.level(if part > 0.0 { light / part } else { 0.0 }));
        [red, green, blue, if frame.is_opaque() { 255 } else { (255.0 * part).round() as u8 }]
    };
    Frame::new([width, height], frame.is_opaque(), scaled.pixels().map(pixel).collect())
}
