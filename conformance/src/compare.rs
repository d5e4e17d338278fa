//! Compares two pictures in linear light.

use std::fmt;

use ugimage::{PictureLimits, Pixels, ReadPicture, read_picture};
use ugphysics::srgb_decode;

/// Formats that are compared.
const FORMATS: &str = "PNG, EXR, HDR or PFM";

/// A picture in linear light, composited over black.
struct Light {
    size: [u32; 2],
    pixels: Vec<[f64; 3]>,
}

/// The differences of two pictures of one size.
///
/// The difference of a pixel is that of its channel that differs most, in linear light, relative to
/// the largest channel of the second picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// The mean difference of all pixels.
    pub mean: f64,
    /// The largest difference.
    pub largest: f64,
    /// The pixel that has it: column from the left and row from the top, from 0.
    pub place: [u32; 2],
    /// The light of this pixel in both pictures.
    pub light: [[f64; 3]; 2],
    /// The difference above which a pixel is counted in `n_different`.
    pub tolerance: f64,
    /// Pixels that differ by more than the tolerance.
    pub n_different: u64,
}

impl Comparison {
    /// Compares the bytes of two picture files: PNG, OpenEXR, Radiance HDR or PFM.
    ///
    /// # Errors
    /// A picture cannot be read, is lossy, or has light that is not finite; or the sizes differ.
    /// The message begins with the name of the file.
    pub fn new(mine: (&str, &[u8]), truth: (&str, &[u8]), tolerance: f64) -> Result<Self, String> {
        let ours = Light::read(mine)?;
        let right = Light::read(truth)?;
        if ours.size != right.size {
            let [width, height] = ours.size;
            let [right_width, right_height] = right.size;
            return Err(format!(
                "{} is {width} x {height} pixels, and {} is {right_width} x {right_height}; draw both in one size",
                mine.0, truth.0
            ));
        }
        if ours.pixels.is_empty() {
            return Err(format!("{} has no pixels", mine.0));
        }
        Ok(Self::of(&ours, &right, tolerance))
    }

    fn of(mine: &Light, truth: &Light, tolerance: f64) -> Self {
        let brightest = truth.pixels.as_flattened().iter().copied().fold(0.0, f64::max);
        // A black picture has nothing to be relative to but white.
        let unit = if brightest > 0.0 { brightest } else { 1.0 };
        let (mut sum, mut largest, mut worst, mut n_different) = (0.0, 0.0, 0, 0);
        for (idx, (a, b)) in mine.pixels.iter().zip(&truth.pixels).enumerate() {
            let channels = a.iter().zip(b).map(|(a, b)| (a - b).abs() / unit);
            let difference = channels.fold(0.0, f64::max);
            sum += difference;
            n_different += u64::from(difference > tolerance);
            if difference > largest {
                (largest, worst) = (difference, idx);
            }
        }
        let width = truth.size[0] as usize;
        Self {
            size: truth.size,
            mean: sum / mine.pixels.len() as f64,
            largest,
            place: [worst % width, worst / width].map(|at| at as u32),
            light: [mine.pixels[worst], truth.pixels[worst]],
            tolerance,
            n_different,
        }
    }

    /// The share of the pixels that differ by more than the tolerance, 0 to 1.
    pub fn share(&self) -> f64 {
        self.n_different as f64 / self.n_pixels() as f64
    }

    fn n_pixels(&self) -> u64 {
        self.size.into_iter().map(u64::from).product()
    }
}

impl fmt::Display for Comparison {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [width, height] = self.size;
        writeln!(f, "size: {width} x {height} pixels")?;
        writeln!(f, "mean difference: {:.6}", self.mean)?;
        write!(f, "largest difference: {:.6}", self.largest)?;
        if self.largest > 0.0 {
            let [x, y] = self.place;
            let [mine, truth] =
                self.light.map(|light| light.map(|channel| format!("{channel:.6}")).join(" "));
            write!(f, ", at column {x}, row {y}: {mine} instead of {truth}")?;
        }
        writeln!(f)?;
        writeln!(
            f,
            "pixels that differ by more than {}: {} of {}, {:.4} %",
            self.tolerance,
            self.n_different,
            self.n_pixels(),
            100.0 * self.share()
        )
    }
}

impl Light {
    fn read((name, file): (&str, &[u8])) -> Result<Self, String> {
        refuse_lossy(file, FORMATS).map_err(|problem| format!("{name}: {problem}"))?;
        let ReadPicture { size, pixels, .. } = read_picture(file, &PictureLimits::default())
            .map_err(|error| {
                format!("{name}: the picture cannot be read: {error}; write it as {FORMATS}")
            })?;
        let pixels: Vec<[f64; 3]> = match pixels {
            Pixels::Srgb(pixels) => {
                let light: Vec<f64> =
                    (0..=255).map(|level| srgb_decode(f64::from(level) / 255.0)).collect();
                let over_black = |[red, green, blue, alpha]: [u8; 4]| {
                    [red, green, blue]
                        .map(|level| light[usize::from(level)] * f64::from(alpha) / 255.0)
                };
                pixels.into_iter().map(over_black).collect()
            }
            Pixels::Light(pixels) => {
                let over_black = |[red, green, blue, alpha]: [f32; 4]| {
                    [red, green, blue].map(|channel| f64::from(channel) * f64::from(alpha))
                };
                pixels.into_iter().map(over_black).collect()
            }
        };
        let is_invalid = |light: &[f64; 3]| light.iter().any(|channel| !channel.is_finite());
        if let Some(idx) = pixels.iter().position(is_invalid) {
            let (x, y) = (idx % size[0] as usize, idx / size[0] as usize);
            return Err(format!("{name}: the light at column {x}, row {y} is infinite or NaN"));
        }
        Ok(Self { size, pixels })
    }
}

/// Refuses a JPEG, whose pixels are not those that the renderer computed.
///
/// # Errors
/// The message names `formats`, which are read instead.
pub fn refuse_lossy(file: &[u8], formats: &str) -> Result<(), String> {
    if file.starts_with(b"\xff\xd8\xff") {
        return Err(format!(
            "a JPEG cannot be scored: its compression changes the pixels; write the picture as {formats}"
        ));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use ugimage::{Compression, Format, Frame, LinearFrame, Metadata};

    fn png(pixels: &[[u8; 4]]) -> Vec<u8> {
        let frame = Frame::new([pixels.len() as u32, 1], false, pixels.to_vec());
        Format::Png.encode(&frame, &Metadata::default())
    }

    fn pfm(pixels: &[[f32; 3]]) -> Vec<u8> {
        let head = format!("PF\n{} 1\n-1.0\n", pixels.len());
        let samples = pixels.as_flattened().iter().flat_map(|sample| sample.to_le_bytes());
        head.into_bytes().into_iter().chain(samples).collect()
    }

    fn compare(mine: &[u8], truth: &[u8]) -> Result<Comparison, String> {
        Comparison::new(("mine", mine), ("truth", truth), 0.01)
    }

    #[test]
    fn differences_are_in_linear_light_relative_to_the_brightest() {
        let found =
            compare(&pfm(&[[0.0; 3], [3.0, 0.0, 0.0]]), &pfm(&[[0.02, 0.0, 0.0], [4.0, 0.0, 0.0]]));
        let found = found.unwrap();
        assert_eq!((found.largest, found.place, found.n_different), (0.25, [1, 0], 1));
        assert_eq!(found.light, [[3.0, 0.0, 0.0], [4.0, 0.0, 0.0]]);
        assert!((found.mean - 0.1275).abs() < 1e-7, "{}", found.mean);
        assert_eq!(found.share(), 0.5);
        let text = found.to_string();
        assert!(
            text.contains("at column 1, row 0: 3.000000 0.000000 0.000000 instead of 4.0"),
            "{text}"
        );
        assert!(
            text.ends_with("pixels that differ by more than 0.01: 1 of 2, 50.0000 %\n"),
            "{text}"
        );
    }

    #[test]
    fn formats_agree() {
        let level = |linear: f64| (255.0 * ugphysics::srgb_encode(linear)).round() as u8;
        let grey = level(0.2);
        let light = srgb_decode(f64::from(grey) / 255.0) as f32;
        let shown = png(&[[255; 4], [grey, 0, 0, 255]]);
        let found = compare(&pfm(&[[1.0; 3], [light, 0.0, 0.0]]), &shown).unwrap();
        assert!(found.largest < 1e-7, "{found}");
        assert_eq!(compare(&shown, &shown).unwrap().largest, 0.0);
        // Transparent pixels count as seen over black.
        let clear = png(&[[255; 4], [255, 0, 0, 0]]);
        assert_eq!(compare(&clear, &png(&[[255; 4], [0, 0, 0, 255]])).unwrap().largest, 0.0);
        let frame = LinearFrame::new([2, 1], true, vec![[0.0, 0.0, 0.0, 1.0]; 2]);
        for format in [Format::Exr, Format::Hdr, Format::Pfm] {
            let file = format.encode_linear(&frame, &Metadata::default(), Compression::default());
            assert_eq!(compare(&file, &pfm(&[[0.0; 3]; 2])).unwrap().largest, 0.0);
        }
    }

    #[test]
    fn pictures_that_do_not_compare_are_refused() {
        let refused = |mine: &[u8]| compare(mine, &pfm(&[[1.0; 3]])).unwrap_err();
        assert_eq!(
            refused(&pfm(&[[1.0; 3]; 2])),
            "mine is 2 x 1 pixels, and truth is 1 x 1; draw both in one size"
        );
        assert_eq!(
            refused(b"\xff\xd8\xff\xe0"),
            "mine: a JPEG cannot be scored: its compression changes the pixels; write the picture as PNG, EXR, HDR or PFM"
        );
        assert!(
            refused(b"GIF89a").starts_with("mine: the picture cannot be read: it is a GIF picture")
        );
        assert_eq!(
            refused(&pfm(&[[f32::NAN, 0.0, 0.0]])),
            "mine: the light at column 0, row 0 is infinite or NaN"
        );
    }
}
