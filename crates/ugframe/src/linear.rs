//! The linear frame: an image of linear, unclipped light.

use ugphysics::srgb_decode;

use crate::{Frame, Quantizer};

/// An image of linear light, rows from top to bottom: linear red, green and blue of the sRGB
/// primaries, and alpha, the covered fraction of the pixel, 0…1.
///
/// White is 1, 1, 1. Nothing is clipped: light brighter than white is above 1, and a colour outside
/// the sRGB gamut has a negative channel. In an opaque frame the light is that of the whole pixel,
/// including the background; otherwise it is that of the covered part, not premultiplied by alpha.
///
/// # Guarantees
/// There are exactly width × height pixels, and as many samples in every plane. Neither side is 0.
/// All numbers of new pixels are finite.
#[derive(Clone, Debug, PartialEq)]
pub struct LinearFrame {
    width: u32,
    height: u32,
    is_opaque: bool,
    pixels: Vec<[f32; 4]>,
    planes: Vec<Plane>,
}

/// An extra channel (AOV): one number per pixel.
#[derive(Clone, Debug, PartialEq)]
pub struct Plane {
    /// The name of the channel in the file.
    pub name: String,
    /// The value of each pixel.
    pub samples: Samples,
}

/// The values of a [`Plane`], rows from top to bottom.
#[derive(Clone, Debug, PartialEq)]
pub enum Samples {
    /// Real numbers.
    Float(Vec<f32>),
    /// Unsigned integers, such as indices.
    Whole(Vec<u32>),
}

impl Samples {
    fn len(&self) -> usize {
        match self {
            Self::Float(numbers) => numbers.len(),
            Self::Whole(numbers) => numbers.len(),
        }
    }
}

impl LinearFrame {
    /// A frame of the given pixels, without extra planes. NaN becomes 0. A pixel with an infinite
    /// number has lost its colour: there that becomes the largest number, and negative ones 0.
    ///
    /// # Panics
    /// If a side is 0, or the number of pixels is not width × height.
    pub fn new(size: [u32; 2], is_opaque: bool, mut pixels: Vec<[f32; 4]>) -> Self {
        let [width, height] = size;
        assert!(width > 0 && height > 0, "a frame has at least one pixel");
        assert_eq!(pixels.len(), width as usize * height as usize, "a frame has all its pixels");
        // Without branches, so that several numbers are compared at once.
        let is_odd = |pixel: &[f32; 4]| {
            pixel.iter().fold(false, |is_odd, number| is_odd | !number.is_finite())
        };
        for pixel in pixels.iter_mut().filter(|pixel| is_odd(pixel)) {
            let least =
                if pixel.iter().any(|number| number.is_infinite()) { 0.0 } else { -f32::MAX };
            *pixel = pixel
                .map(|number| if number.is_nan() { 0.0 } else { number.clamp(least, f32::MAX) });
        }
        Self { width, height, is_opaque, pixels, planes: Vec::new() }
    }

    /// Adds a plane.
    ///
    /// # Panics
    /// If the number of its samples is not that of the pixels.
    pub fn push_plane(&mut self, plane: Plane) {
        assert_eq!(plane.samples.len(), self.pixels.len(), "a plane has a number for each pixel");
        self.planes.push(plane);
    }

    /// Number of pixels per row.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Number of rows.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// True if the frame has no transparency.
    pub fn is_opaque(&self) -> bool {
        self.is_opaque
    }

    /// All pixels, row after row from the top.
    pub fn pixels(&self) -> &[[f32; 4]] {
        &self.pixels
    }

    /// All pixels, mutable.
    pub fn pixels_mut(&mut self) -> &mut [[f32; 4]] {
        &mut self.pixels
    }

    /// The extra planes.
    pub fn planes(&self) -> &[Plane] {
        &self.planes
    }

    /// The light of one of its pixels over black: premultiplied by alpha unless the frame is
    /// opaque.
    pub fn light_of(&self, [red, green, blue, part]: [f32; 4]) -> [f32; 3] {
        let part = if self.is_opaque { 1.0 } else { part };
        [red * part, green * part, blue * part]
    }

    /// The frame display-encoded with 8 bits per channel; light outside 0…1 is clipped.
    pub fn to_display(&self) -> Frame {
        let quantizer = Quantizer::new();
        let level = |&light: &[f32; 4]| display_pixel(&quantizer, light, self.is_opaque);
        Frame::new(
            [self.width, self.height],
            self.is_opaque,
            self.pixels.iter().map(level).collect(),
        )
    }
}

/// A pixel display-encoded with 8 bits per channel: red, green, blue and alpha.
#[inline]
pub fn display_pixel(
    quantizer: &Quantizer,
    [red, green, blue, part]: [f32; 4],
    is_opaque: bool,
) -> [u8; 4] {
    if !is_opaque && part == 0.0 {
        return [0; 4];
    }
    let [red, green, blue] = [red, green, blue].map(|light| quantizer.level(light));
    let alpha = if is_opaque { 255 } else { (255.0 * part).round() as u8 };
    [red, green, blue, alpha]
}

impl From<&Frame> for LinearFrame {
    fn from(frame: &Frame) -> Self {
        let linear: [f32; 256] =
            std::array::from_fn(|level| srgb_decode(level as f64 / 255.0) as f32);
        let light = |&[red, green, blue, alpha]: &[u8; 4]| {
            let [red, green, blue] = [red, green, blue].map(|level| linear[usize::from(level)]);
            [red, green, blue, f32::from(alpha) / 255.0]
        };
        let pixels = frame.pixels().iter().map(light).collect();
        Self::new([frame.width(), frame.height()], frame.is_opaque(), pixels)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_new_frame_is_finite() {
        #[track_caller]
        fn check(pixel: [f32; 4], expected: [f32; 4]) {
            assert_eq!(LinearFrame::new([1, 1], true, vec![pixel]).pixels(), [expected]);
        }
        check([f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1.0], [0.0, f32::MAX, 0.0, 1.0]);
        check([-3e38, f32::INFINITY, 2.0, 1.0], [0.0, f32::MAX, 2.0, 1.0]);
        check([f32::NAN, -0.5, 2.0, 1.0], [0.0, -0.5, 2.0, 1.0]);
        // A colour outside of the gamut.
        check([-0.5, 1.0, 2.0, 1.0], [-0.5, 1.0, 2.0, 1.0]);
    }

    #[test]
    fn display_levels_round_trip_through_light() {
        let clear =
            [0, 1, 255].map(|alpha| (0..=255).map(move |level| [level, 255 - level, 7, alpha]));
        let clear = Frame::new([256, 3], false, clear.into_iter().flatten().collect());
        let opaque = Frame::new([256, 1], true, clear.pixels()[512..].to_vec());
        for frame in [clear, opaque] {
            let back = LinearFrame::from(&frame).to_display();
            for (ours, &pixel) in back.pixels().iter().zip(frame.pixels()) {
                assert_eq!(*ours, if pixel[3] == 0 { [0; 4] } else { pixel });
            }
        }
    }
}
