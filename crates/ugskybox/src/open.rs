//! From the bytes of files to a sky.

use core::f64::consts::{PI, TAU};

use ugimage::{PictureLimits, Pixels, SpectralPicture, read_picture, read_spectrum};
use ugscene::Scene;
use ugsky::{Arrangement, Band, Basis, Extent, Panorama, PanoramaError, Sky, Star, Texels};

use crate::error::OpenError;

/// A panorama, stars or both, and what their user should know.
#[derive(Default)]
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
/// `arrangement`: without it the one of the ratio of the sides, see [`Arrangement::of_size`].
///
/// # Errors
/// - [`OpenError::Read`]: a file is no picture that can be read.
/// - [`OpenError::Panorama`]: the pictures do not suit the arrangement, are too small, or their angles
///   are impossible.
pub fn open(
    files: &[&[u8]],
    arrangement: Option<Arrangement>,
    mut extent: Option<Extent>,
    highlights: Option<f32>,
    mut limits: PictureLimits,
) -> Result<Opened, OpenError> {
    let mut notes = Vec::new();
    let mut pictures = Vec::new();
    if files.len() != arrangement.unwrap_or_default().n_files() {
        return Err(PanoramaError::Sides { n_files: files.len() }.into());
    }
    for (idx, file) in files.iter().enumerate() {
        let picture =
            read_picture(file, &limits).map_err(|error| OpenError::Read { idx, error })?;
        limits.bytes -= picture.pixels.n_bytes().min(limits.bytes);
        notes.extend(picture.notes);
        if let Some([left, right, top, bottom]) = picture.part
            && extent.is_none()
            && matches!(arrangement, None | Some(Arrangement::Equirectangular))
        {
            let stated = Extent {
                longitudes: [left, right].map(|edge| TAU * (edge - 0.5)),
                latitudes: [bottom, top].map(|edge| PI * (0.5 - edge)),
            };
            let [west, east] = stated.longitudes.map(f64::to_degrees);
            let [south, north] = stated.latitudes.map(f64::to_degrees);
            notes.push(format!(
                "the picture says that it shows a part of the sphere (GPano), longitudes {west:.2} to {east:.2} and \
                 latitudes {south:.2} to {north:.2} degrees"
            ));
            extent = Some(stated);
        }
        pictures.push((picture.size, texels(picture.pixels, &mut notes)));
    }
    let arrangement = arrangement.unwrap_or_else(|| {
        let found = pictures.iter().map(|(size, _)| Arrangement::of_size(*size)).next();
        let found = found.filter(|_| extent.is_none()).unwrap_or_default();
        if found != Arrangement::Equirectangular {
            notes.push(format!("by its size the picture is a cube map: a {}", found.name()));
        }
        found
    });
    let is_clipped = pictures.iter().any(|(_, texels)| matches!(texels, Texels::Srgb(_)));
    if highlights.is_some() && !is_clipped {
        notes.push(LIGHT.to_owned());
    }
    let panorama = Panorama::arranged(pictures, arrangement, extent)?;
    let highlights = highlights.filter(|_| is_clipped);
    Ok(Opened { panorama: Some(panorama), highlights, notes, ..Opened::default() })
}

/// Reads spectral radiances from an EXR file whose channels are named by wavelengths. Each band
/// holds three of the channels. Empty for other files, and for fewer than four such channels.
///
/// # Errors
/// As [`open`].
pub fn open_spectrum(
    file: &[u8],
    arrangement: Arrangement,
    extent: Option<Extent>,
    limits: &PictureLimits,
) -> Result<Vec<Band>, OpenError> {
    /// Light at the first and last wavelength ends this part of them further.
    const BEYOND: f64 = 0.05;
    let picture = read_spectrum(file, limits).map_err(|error| OpenError::Read { idx: 0, error })?;
    let SpectralPicture { size, samples } = picture;
    let wavelength = |at: isize| -> f64 {
        let last = samples.len() as isize - 1;
        let beyond = BEYOND * (at - at.clamp(0, last)) as f64;
        samples[at.clamp(0, last) as usize].0 * (1.0 + beyond)
    };
    let band = |first: usize| {
        let channels: Vec<&[f32]> =
            samples[first..].iter().take(3).map(|(_, values)| &values[..]).collect();
        let texel = |idx: usize| {
            let channel = |at: usize| channels.get(at).map_or(0.0, |values| values[idx].max(0.0));
            [channel(0), channel(1), channel(2), 1.0]
        };
        let texels = (0..size[0] as usize * size[1] as usize).map(texel).collect();
        let nm = std::array::from_fn(|at| wavelength((first + at) as isize - 1));
        let panorama =
            Panorama::arranged(vec![(size, Texels::Light(texels))], arrangement, extent)?;
        Ok(Band { range_nm: ugsky::ALL_NM, basis: Basis::Samples(nm), panorama })
    };
    (0..samples.len()).step_by(3).map(band).collect()
}

/// The note on highlights that are not clipped.
const LIGHT: &str =
    "the panorama holds light, in which no highlights are clipped, so they stay as they are";

fn texels(pixels: Pixels, notes: &mut Vec<String>) -> Texels {
    match pixels {
        Pixels::Srgb(pixels) => Texels::Srgb(pixels),
        Pixels::Light(mut pixels) => {
            let is_negative = |pixel: &&mut [f32; 4]| pixel[..3].iter().any(|part| *part < 0.0);
            let n_negative = pixels.iter_mut().filter(is_negative).fold(0, |count, pixel| {
                pixel[..3].iter_mut().for_each(|part| *part = part.max(0.0));
                count + 1
            });
            if n_negative > 0 {
                notes.push(format!(
                    "{n_negative} pixels of the panorama have negative light, which counts as 0: lossy compression \
                     and colours outside sRGB have it"
                ));
            }
            let n_invalid =
                pixels.iter().filter(|pixel| pixel.iter().any(|part| !part.is_finite())).count();
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
