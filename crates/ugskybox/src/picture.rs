//! What a picture of a sky depends on.

use std::ops::Range;

use uglight::ColorShift;
use ugphysics::Velocity;
use ugpicture::{Background, Filter};
use ugsky::{Basis, SkyColors, StarOptions};
use ugtrace::lens::{Film, Lens};

/// A picture of a sky by one eye: lens, observer, and how colours change.
#[derive(Clone, Debug)]
pub struct SkyPicture {
    /// Left column, upper row, width and height of the part that is drawn.
    pub part: [u32; 4],
    /// Samples along a side of a pixel.
    pub samples: u32,
    /// The reconstruction filter.
    pub filter: Filter,
    /// What is seen where the sky shows nothing.
    pub background: Background,
    /// Which direction is seen where.
    pub lens: Lens,
    /// The film with these samples, in the axes of the sky.
    pub film: Film,
    /// The film with one sample per pixel, for stars.
    pub pixel_film: Film,
    /// Velocity of the observer in the frame and the axes of the sky.
    pub velocity: Velocity,
    /// How colours change with the Doppler factor.
    pub colors: SkyColors,
    /// Wavelengths at rest at which a panorama has light, nm, with spectra.
    pub range_nm: Range<f64>,
    /// Light brighter than white is kept.
    pub keeps_light: bool,
    /// How stars are drawn.
    pub stars: StarOptions,
}

/// How the colours of a sky change where those of a scene change by `shift`. `basis`: the spectra
/// of colours, if spectra are shifted.
pub fn sky_colors(shift: ColorShift, basis: Basis) -> SkyColors {
    match shift {
        ColorShift::Hues(shift) => SkyColors::Hues { doppler: shift.doppler, law: shift.law },
        ColorShift::Spectra(shift) => {
            SkyColors::Spectra { basis, doppler: shift.doppler, flux: shift.flux }
        }
    }
}
