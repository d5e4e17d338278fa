//! From the bytes of files to a panorama.

use std::ops::Range;

use ugimage::{MAX_PIXELS, Pixels, read_picture};
use ugsky::{CubeMap, Extent, Panorama, PanoramaError, Star, Texels};

use crate::arrangement::Arrangement;
use crate::error::Error;

/// A panorama of light outside of the visible range.
pub struct Band {
    /// Wavelengths at rest, nm.
    pub range_nm: Range<f64>,
    /// The light, of which only the luminance is used.
    pub panorama: Panorama,
}

/// A panorama, stars or both, and what their user should know.
pub struct Opened {
    /// The panorama.
    pub panorama: Option<Panorama>,
    /// Infrared and ultraviolet light beside that of the panorama.
    pub bands: Vec<Band>,
    /// The stars.
    pub stars: Vec<Star>,
    /// Notes for the user, one sentence each.
    pub notes: Vec<String>,
}

/// The places of the sides in a cross of four squares across, and in one of three across, whose
/// back is upside down: column and row.
const CROSSES: [[[usize; 2]; 6]; 2] =
    [[[2, 1], [0, 1], [1, 0], [1, 2], [1, 1], [3, 1]], [[2, 1], [0, 1], [1, 0], [1, 2], [1, 1], [1, 3]]];

/// Reads a panorama from the bytes of PNG, JPEG, HDR or EXR files. `extent`: the angles that an
/// equirectangular one shows; without it the whole sphere.
///
/// # Errors
/// - [`Error::Read`]: a file is no picture that can be read.
/// - [`Error::Sides`]: the number of files does not suit the arrangement.
/// - [`Error::Shape`]: nor does the ratio of width to height.
/// - [`Error::Side`]: the sides of a cube are not squares of one size.
/// - [`Error::Panorama`]: the picture is too small, or its angles are impossible.
pub fn open(files: &[&[u8]], arrangement: Arrangement, extent: Option<Extent>) -> Result<Opened, Error> {
    if files.len() != arrangement.n_files() {
        return Err(Error::Sides { n_files: files.len() });
    }
    let mut notes = Vec::new();
    let mut pictures = Vec::new();
    for (idx, file) in files.iter().enumerate() {
        let (size, pixels) = read_picture(file, MAX_PIXELS).map_err(|error| Error::Read { idx, error })?;
        pictures.push((size, texels(pixels, &mut notes)));
    }
    let panorama = match arrangement {
        Arrangement::Equirectangular => equirectangular(pictures, extent)?,
        _ => cube(pictures, arrangement)?.panorama()?,
    };
    Ok(Opened { panorama: Some(panorama), bands: Vec::new(), stars: Vec::new(), notes })
}

type Picture = ([u32; 2], Texels);

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

fn equirectangular(pictures: Vec<Picture>, extent: Option<Extent>) -> Result<Panorama, Error> {
    let Some((size, texels)) = pictures.into_iter().next() else { return Err(PanoramaError::Size.into()) };
    let [width, height] = size.map(u64::from);
    // Some cameras cut off a row or a column.
    let is_double = width.abs_diff(2 * height) <= 2 + width / 100;
    let extent = match extent {
        Some(extent) => extent,
        None if is_double => Extent::FULL,
        None => return Err(Error::Shape { size, arrangement: Arrangement::Equirectangular }),
    };
    Ok(Panorama::new(size, texels, extent)?)
}

fn cube(mut pictures: Vec<Picture>, arrangement: Arrangement) -> Result<CubeMap, Error> {
    let [width, height] = pictures[0].0;
    if arrangement == Arrangement::Sides {
        for (idx, (size, _)) in pictures.iter().enumerate() {
            if *size != [width, width] {
                return Err(Error::Side { idx, size: *size, expected: width });
            }
        }
        let faces: Vec<Texels> = pictures.into_iter().map(|(_, texels)| texels).collect();
        let faces = faces.try_into().map_err(|_| PanoramaError::Size)?;
        return Ok(CubeMap::new(width, faces)?);
    }
    let (across, down) = match arrangement {
        Arrangement::Strip => (6, 1),
        _ if width > height => (4, 3),
        _ => (3, 4),
    };
    let side = width / across;
    if side == 0 || [side * across, side * down] != [width, height] {
        return Err(Error::Shape { size: [width, height], arrangement });
    }
    let (_, texels) = pictures.remove(0);
    let faces = std::array::from_fn(|face| {
        let place = match (arrangement, across) {
            (Arrangement::Strip, _) => [face, 0],
            (_, 4) => CROSSES[0][face],
            _ => CROSSES[1][face],
        };
        let is_turned = across == 3 && face == 5;
        match &texels {
            Texels::Srgb(texels) => Texels::Srgb(square(texels, width, side, place, is_turned)),
            Texels::Light(texels) => Texels::Light(square(texels, width, side, place, is_turned)),
        }
    });
    Ok(CubeMap::new(side, faces)?)
}

/// A square of a picture of squares.
fn square<T: Copy>(texels: &[T], width: u32, side: u32, place: [usize; 2], is_turned: bool) -> Vec<T> {
    let (width, side) = (width as usize, side as usize);
    let row = |row: usize| {
        let start = (place[1] * side + row) * width + place[0] * side;
        &texels[start..start + side]
    };
    let mut square: Vec<T> = (0..side).flat_map(row).copied().collect();
    if is_turned {
        square.reverse();
    }
    square
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
            let opened = open(&files, arrangement, None).unwrap_or_else(|error| panic!("{error}"));
            let config = crate::Config { lens: crate::Lens::Panorama, ..crate::Config::default() };
            let picture = crate::PictureOptions { size: [40, 20], samples: 1, ..config.picture.clone() };
            crate::light(&opened, &crate::Config { picture, ..config }).unwrap()
        };
        let files: Vec<Vec<u8>> = (0..6).map(|face| png([SIDE, SIDE], |at| side(face, at))).collect();
        let expected = light(&files, Arrangement::Sides);
        let strip = png([6 * SIDE, SIDE], |[x, y]| side((x / SIDE) as usize, [x % SIDE, y]));
        assert_eq!(light(&[strip], Arrangement::Strip), expected);
        for (across, down, places) in [(4, 3, CROSSES[0]), (3, 4, CROSSES[1])] {
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
            open(&files, arrangement, None).err().map(|error| error.to_string()).unwrap_or_default()
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
