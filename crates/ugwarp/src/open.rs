//! From the bytes of files to a sky.

use ugimage::{PictureLimits, Pixels, read_picture};
use ugparse::{Diagnostic, Diagnostics, Source, Span};
use ugscene::Scene;
use ugsky::{Arrangement, Band, Extent, Panorama, PanoramaError, Sky, Star, Texels};

use crate::error::Error;

/// A panorama, stars or both, and what their user should know.
pub struct Opened {
    /// The panorama.
    pub panorama: Option<Panorama>,
    /// Infrared and ultraviolet light beside that of the panorama.
    pub bands: Vec<Band>,
    /// The stars.
    pub stars: Vec<Star>,
    /// The scene whose camera takes the picture, if there is one.
    pub scene: Option<Box<Scene>>,
    /// How many times as bright as white clipped highlights of the panorama are.
    pub highlights: Option<f32>,
    /// Notes for the user, one sentence each.
    pub notes: Vec<String>,
}

impl<'s> From<&'s Opened> for Sky<'s> {
    fn from(opened: &'s Opened) -> Self {
        Self {
            panorama: opened.panorama.as_ref(),
            bands: &opened.bands,
            stars: &opened.stars,
            highlights: opened.highlights,
        }
    }
}

/// Reads a panorama from the bytes of PNG, JPEG, HDR, EXR or PFM files. `extent`: the angles that
/// an equirectangular one shows; without it the whole sphere. `highlights`: how many times as
/// bright as white clipped highlights of photographs are. `limits`: of all files together.
///
/// # Errors
/// - [`Error::Read`]: a file is no picture that can be read.
/// - [`Error::Panorama`]: the pictures do not suit the arrangement, are too small, or their angles
///   are impossible.
pub fn open(
    files: &[&[u8]],
    arrangement: Arrangement,
    extent: Option<Extent>,
    highlights: Option<f32>,
    mut limits: PictureLimits,
) -> Result<Opened, Error> {
    let mut notes = Vec::new();
    let mut pictures = Vec::new();
    if files.len() != arrangement.n_files() {
        return Err(PanoramaError::Sides { n_files: files.len() }.into());
    }
    for (idx, file) in files.iter().enumerate() {
        let (size, pixels) = read_picture(file, &limits).map_err(|error| Error::Read { idx, error })?;
        limits.bytes -= pixels.n_bytes().min(limits.bytes);
        pictures.push((size, texels(pixels, &mut notes)));
    }
    let is_clipped = pictures.iter().any(|(_, texels)| matches!(texels, Texels::Srgb(_)));
    if highlights.is_some() && !is_clipped {
        notes.push(LIGHT.to_owned());
    }
    let panorama = Panorama::arranged(pictures, arrangement, extent)?;
    let highlights = highlights.filter(|_| is_clipped);
    Ok(Opened {
        panorama: Some(panorama),
        bands: Vec::new(),
        stars: Vec::new(),
        scene: None,
        highlights,
        notes,
    })
}

/// The note on highlights that are not clipped.
const LIGHT: &str = "the panorama holds light, in which no highlights are clipped, so they stay as they are";

fn texels(pixels: Pixels, notes: &mut Vec<String>) -> Texels {
    match pixels {
        Pixels::Srgb(pixels) => Texels::Srgb(pixels),
        Pixels::Light(pixels) => {
            let n_invalid = pixels.iter().filter(|pixel| pixel.iter().any(|part| !part.is_finite())).count();
            if n_invalid > 0 {
                notes.push(format!(
                    "{n_invalid} pixels of the panorama are not finite: NaN counts as black, and infinite light as the \
                     largest number"
                ));
            }
            Texels::Light(pixels)
        }
    }
}

/// Reads a list of stars, see [`ugsky::read_stars`]. `name`: of the file, for messages.
///
/// # Errors
/// All errors of up to 20 lines, with line and column.
pub fn read_stars(name: &str, file: &[u8]) -> Result<Vec<Star>, Box<Diagnostics>> {
    ugsky::read_stars(file).map_err(|errors| {
        let found = errors.into_iter().map(|error| {
            let span = Span { start: error.place.start as u32, end: error.place.end as u32 };
            Diagnostic::error(span, error.mistake.to_string()).help(error.mistake.remedy())
        });
        Box::new(Diagnostics::new(&Source::new(name, file), found.collect()))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use ugimage::{Format, Frame, Metadata};

    fn png(size: [u32; 2], color: impl Fn([u32; 2]) -> [u8; 4]) -> Vec<u8> {
        let pixels = (0..size[0] * size[1]).map(|idx| color([idx % size[0], idx / size[0]])).collect();
        Format::Png.encode(&Frame::new(size, true, pixels), &Metadata::default())
    }

    const SIDE: u32 = 16;

    /// Sides of different colours, whose red increases to the right and green downward.
    fn side(face: usize, [x, y]: [u32; 2]) -> [u8; 4] {
        [(8 * x) as u8, (8 * y) as u8, 40 * face as u8, 255]
    }

    /// Strips, crosses and files of the same sides are the same panorama.
    #[test]
    fn arrangements_agree() {
        let light = |files: &[Vec<u8>], arrangement: Arrangement| {
            let files: Vec<&[u8]> = files.iter().map(Vec::as_slice).collect();
            let opened = open(&files, arrangement, None, None, PictureLimits::default())
                .unwrap_or_else(|error| panic!("{error}"));
            let config = crate::Config { lens: crate::Lens::Panorama, ..crate::Config::default() };
            let picture = crate::PictureOptions { size: [40, 20], samples: 1, ..config.picture.clone() };
            crate::light(&opened, &crate::Config { picture, ..config }).unwrap()
        };
        let files: Vec<Vec<u8>> = (0..6).map(|face| png([SIDE, SIDE], |at| side(face, at))).collect();
        let expected = light(&files, Arrangement::Sides);
        let strip = png([6 * SIDE, SIDE], |[x, y]| side((x / SIDE) as usize, [x % SIDE, y]));
        assert_eq!(light(&[strip], Arrangement::Strip), expected);
        for (across, down, places) in [
            (4, 3, [[2, 1], [0, 1], [1, 0], [1, 2], [1, 1], [3, 1]]),
            (3, 4, [[2, 1], [0, 1], [1, 0], [1, 2], [1, 1], [1, 3]]),
        ] {
            let cross = png([across * SIDE, down * SIDE], |[x, y]| {
                let place = [x / SIDE, y / SIDE].map(|at| at as usize);
                let Some(face) = places.iter().position(|other| *other == place) else {
                    return [0, 0, 0, 255];
                };
                let at = [x % SIDE, y % SIDE];
                side(face, if across == 3 && face == 5 { at.map(|at| SIDE - 1 - at) } else { at })
            });
            assert_eq!(light(&[cross], Arrangement::Cross), expected, "{across}");
        }
    }

    #[test]
    fn wrong_shapes_are_refused() {
        let file = |size: [u32; 2]| png(size, |_| [9, 9, 9, 255]);
        let message = |files: &[Vec<u8>], arrangement: Arrangement| {
            let files: Vec<&[u8]> = files.iter().map(Vec::as_slice).collect();
            open(&files, arrangement, None, None, PictureLimits::default())
                .err()
                .map(|error| error.to_string())
                .unwrap_or_default()
        };
        let mut sides = vec![file([16, 16]); 6];
        assert!(message(&sides[..5], Arrangement::Sides).contains("5 files"));
        sides[2] = file([16, 15]);
        assert_eq!(
            message(&sides, Arrangement::Sides),
            "the third side of the cube has 16 x 15 pixels: all must be squares of the same size, here 16 x 16"
        );
        assert!(
            message(&[file([60, 16])], Arrangement::Strip)
                .contains("60 x 16 pixels are not the shape of a strip")
        );
        assert!(message(&[file([60, 16])], Arrangement::Cross).contains("not the shape of a cross"));
        assert!(message(&[file([60, 40])], Arrangement::Equirectangular).contains("twice as wide as high"));
    }
}
