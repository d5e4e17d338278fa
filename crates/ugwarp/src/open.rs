//! From the bytes of a file to a panorama.

use ugimage::{Pixels, read_picture};
use ugsky::{Extent, Panorama, Texels};

use crate::error::Error;

/// A panorama, and what its reader should know.
pub struct Opened {
    /// The panorama.
    pub panorama: Panorama,
    /// Notes for the user, one sentence each.
    pub notes: Vec<String>,
}

/// Reads an equirectangular panorama from the bytes of a PNG, JPEG, HDR or EXR file. `extent`: the
/// angles that it shows; without it the whole sphere.
///
/// # Errors
/// [`Error::Read`], [`Error::Panorama`], or [`Error::Shape`] if it is not twice as wide as high and
/// no angles are given.
pub fn open(file: &[u8], extent: Option<Extent>) -> Result<Opened, Error> {
    let (size, pixels) = read_picture(file)?;
    let [width, height] = size.map(u64::from);
    // Some cameras cut off a row or a column.
    let is_double = width.abs_diff(2 * height) <= 2 + width / 100;
    let extent = match extent {
        Some(extent) => extent,
        None if is_double => Extent::FULL,
        None => return Err(Error::Shape { size }),
    };
    let mut notes = Vec::new();
    let texels = match pixels {
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
    };
    Ok(Opened { panorama: Panorama::new(size, texels, extent)?, notes })
}
