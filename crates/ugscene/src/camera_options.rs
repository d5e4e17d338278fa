//! Options of the camera, their errors, and the film.

use glam::DVec3;

use crate::Camera;
use crate::words::{messages, point};

/// Default view angle across the picture, degrees.
pub(crate) const DEFAULT_VIEW_ANGLE: f64 = 40.0;

/// Camera options of a program, which override the camera of the scene.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CameraOptions {
    /// Name of the camera to use, if the scene has several; chosen by `ugparse::read`.
    pub name: Option<String>,
    /// Eye point.
    pub eye: Option<DVec3>,
    /// View centre: the point at the centre of the picture.
    pub center: Option<DVec3>,
    /// The direction that is up in the picture.
    pub up: Option<DVec3>,
    /// Full view angle across the picture, and if given also down it, in degrees.
    pub view_angle: Option<(f64, Option<f64>)>,
    /// Parallel projection.
    pub is_orthographic: bool,
    /// The view of a camera that moves is that of a camera at rest, aberrated (`--ahead`): the
    /// options above state it at rest.
    pub is_ahead: bool,
    /// The fractions of the picture's width and height that its scene fills, if text stands beside
    /// or below it: the view of the whole picture is in that part, with more around it.
    pub part: Option<[f64; 2]>,
}

/// Why a camera is invalid.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum CameraError {
    /// The eye point is the view centre, or the direction between them underflows or overflows.
    NoDirection {
        /// The eye point.
        eye: DVec3,
    },
    /// The up direction of the options is the zero vector.
    NoUp,
    /// A view angle, in degrees, that is not between 0 and 180.
    ViewAngle(f64),
    /// A film size or focal length that is not positive.
    Film,
    /// A film rectangle without area.
    FilmRectangle,
    /// The yon distance is not behind the hither distance, or not in front of the eye.
    Clip([f64; 2]),
}

messages! { CameraError {
    Self::NoDirection { eye } =>
        "the eye point {} is also the view centre, so there is no direction to look in", point(*eye);
    Self::NoUp => "the up direction 0 0 0 is no direction";
    Self::ViewAngle(angle) => "a view angle of {angle} degrees cannot be projected on a flat picture";
    Self::Film => "the film size and the focal length of the camera must be positive";
    Self::FilmRectangle => "the film rectangle of the camera has no area";
    Self::Clip([hither, yon]) => "nothing lies between the clipping distances {hither} and {yon}";
} }

impl CameraOptions {
    /// # Errors
    /// [`CameraError::NoUp`].
    pub fn check_up(&self) -> Result<(), CameraError> {
        if self.up == Some(DVec3::ZERO) { Err(CameraError::NoUp) } else { Ok(()) }
    }
}

/// The film: which part of the view the picture shows.
pub(crate) struct Film {
    /// Half its sides at distance 1 from the eye.
    pub half: [f64; 2],
    /// Samples that would cover the whole film.
    pub samples: [f64; 2],
    /// The sample at its middle.
    pub axis: [f64; 2],
}

impl Film {
    /// Pixels are square unless both angles are given as options: otherwise the angle across is
    /// used, and the height follows from the aspect ratio of the picture.
    pub fn new(
        camera: &Camera,
        options: &CameraOptions,
        samples: [u32; 2],
    ) -> Result<Self, CameraError> {
        let [min_x, min_y, max_x, max_y] = camera.film.unwrap_or([0.0, 0.0, 1.0, 1.0]);
        if !(min_x < max_x && min_y < max_y) {
            return Err(CameraError::FilmRectangle);
        }
        let part = options.part.unwrap_or([1.0; 2]);
        let [width, height] = [0, 1].map(|side| f64::from(samples[side]) / part[side]);
        // From the whole picture to its part.
        let scale = part[0].min(part[1]);
        let margin = |whole: f64, part: f64| 0.5 * whole * (part - scale);
        let samples = [width / (max_x - min_x), height / (max_y - min_y)].map(|side| scale * side);
        // Film coordinates run up, rows run down.
        let axis = [
            margin(width, part[0]) + (0.5 - min_x) * samples[0],
            margin(height, part[1]) + (max_y - 0.5) * samples[1],
        ];
        let half_width = match options.view_angle {
            Some((across, _)) => half_side(across)?,
            None => half_width_of(camera)?,
        };
        let half_height = match options.view_angle {
            Some((_, Some(down))) => half_side(down)?,
            _ => half_width * samples[1] / samples[0],
        };
        Ok(Self { half: [half_width, half_height], samples, axis })
    }
}

/// Half the sides of the film at distance 1, of a camera that only has options.
pub(crate) fn half_film(options: &CameraOptions, size: [u32; 2]) -> Result<[f64; 2], CameraError> {
    Ok(Film::new(&Camera::default(), options, size)?.half)
}

/// Half the width of the film at distance 1, from any two of view angle, film size and focal
/// length: fs = 2 fl tan(va/2).
pub(crate) fn half_width_of(camera: &Camera) -> Result<f64, CameraError> {
    match (camera.view_angle, camera.film_size, camera.focal_length) {
        (Some([across, _]), _, _) => half_side(across),
        (None, Some([width, _]), Some(length)) if width > 0.0 && length > 0.0 => {
            Ok(0.5 * width / length)
        }
        (None, Some(_), Some(_)) => Err(CameraError::Film),
        _ => half_side(DEFAULT_VIEW_ANGLE),
    }
}

/// Half the side of the film at distance 1 that fills a view angle in degrees.
pub(crate) fn half_side(degrees: f64) -> Result<f64, CameraError> {
    let is_flat = 0.0 < degrees && degrees < 180.0;
    let half = libm::tan(0.5 * degrees.to_radians());
    if is_flat && half > 0.0 { Ok(half) } else { Err(CameraError::ViewAngle(degrees)) }
}

/// The unit vector to the right, and whether `up` had to be replaced because it is parallel
/// to the view.
pub(crate) fn right_of(forward: DVec3, up: DVec3) -> (DVec3, bool) {
    /// Sine of the angle between up and view below which they count as parallel.
    const LEAST: f64 = 1e-9;
    let across = forward.cross(ugphysics::unit_or_zero(up));
    if across.length() > LEAST {
        return (across.normalize(), false);
    }
    // +y is up for a vertical view, as on a map.
    let axis = if forward.y.abs() < 0.9 { DVec3::Y } else { DVec3::Z };
    (forward.cross(axis).normalize(), true)
}
