//! The camera: the part of a scene that is in the picture, and projection.

use glam::DVec3;

use crate::camera_options::{CameraError, CameraOptions, Film, right_of};
use crate::{Camera, DefaultCamera, Projection, Scene};

/// The default hither distance, as a fraction of the distance to the view centre: points at the eye
/// cannot be projected.
const NEAREST: f64 = 1e-6;

/// The distance from the eye to the view centre.
///
/// # Errors
/// [`CameraError::NoDirection`].
pub fn view_distance(eye: DVec3, center: DVec3) -> Result<f64, CameraError> {
    let distance = ugphysics::length(center - eye);
    if distance > 0.0 && distance.is_finite() {
        Ok(distance)
    } else {
        Err(CameraError::NoDirection { eye })
    }
}

/// A point in front of the camera, before projection.
///
/// In perspective `x` and `y` are sample coordinates times `z`, so that they are linear in
/// the point wherever it is; in orthographic projection they are sample coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraPoint {
    /// Across, to the right.
    pub x: f64,
    /// Down.
    pub y: f64,
    /// Distance from the eye along the view.
    pub z: f64,
}

/// The range of depths that is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slab {
    /// Smallest distance, positive in perspective.
    pub near: f64,
    /// Largest distance.
    pub far: f64,
}

/// A half-space, relative to the eye: points p with p·normal + offset ≥ 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HalfSpace {
    /// Points inward; any length.
    pub normal: DVec3,
    /// See above.
    pub offset: f64,
}

/// A camera set up for a picture.
#[derive(Clone, Debug)]
pub struct View {
    /// Eye point, scene coordinates.
    pub eye: DVec3,
    /// Unit vector into the picture.
    pub forward: DVec3,
    /// True for perspective, false for orthographic projection.
    pub is_perspective: bool,
    /// The range of depths that is drawn.
    pub slab: Slab,
    /// Distance from the eye to the view centre.
    pub distance: f64,
    /// True if the up direction was parallel to the view and has been replaced.
    pub is_up_replaced: bool,
    /// The eye and the view centre, if they were chosen because the scene has no camera.
    pub default_camera: Option<DefaultCamera>,
    right: DVec3,
    up: DVec3,
    /// Samples per unit of the film at distance 1, across and down.
    scale: [f64; 2],
    /// The sample at the view axis.
    axis: [f64; 2],
    /// Samples of the picture.
    size: [f64; 2],
}

impl View {
    /// From points of the scene (row vectors with a 1) to the axes of the camera, right, up and
    /// forward, and to normalized device coordinates: -1 to 1 to the right and up, after division
    /// by the fourth coordinate. `None` without perspective.
    pub fn matrices(&self) -> Option<[[f64; 16]; 2]> {
        if !self.is_perspective {
            return None;
        }
        let axes = [self.right, self.up, self.forward];
        let shift = axes.map(|axis| -axis.dot(self.eye));
        // Columns are coordinates, and the last row is the shift.
        let rows = |columns: [DVec3; 4], shifts: [f64; 4]| {
            let entry = |i: usize| if i < 12 { columns[i % 4][i / 4] } else { shifts[i % 4] };
            std::array::from_fn(entry)
        };
        let [right, up, forward] = axes;
        let camera = rows([right, up, forward, DVec3::ZERO], [shift[0], shift[1], shift[2], 1.0]);
        let part = |idx: usize, axis: DVec3, sign: f64| {
            // Samples are counted to the right and down.
            let [scale, middle] = [
                2.0 * self.scale[idx] / self.size[idx],
                2.0 * self.axis[idx] / self.size[idx] - 1.0,
            ];
            let column = scale * axis + sign * middle * forward;
            (column, -column.dot(self.eye))
        };
        let ((x, x_shift), (y, y_shift)) = (part(0, right, 1.0), part(1, up, -1.0));
        let device = rows([x, y, forward, forward], [x_shift, y_shift, shift[2], shift[2]]);
        Some([camera, device])
    }

    /// Options, the scene's camera and defaults, in order of precedence. `samples`: of the picture,
    /// across and down.
    ///
    /// # Errors
    /// [`CameraError`] if the combination is invalid.
    pub fn new(
        scene: &Scene,
        options: &CameraOptions,
        samples: [u32; 2],
    ) -> Result<Self, CameraError> {
        let none = Camera::default();
        let camera = scene.camera().unwrap_or(&none);
        let seen;
        let options = if options.is_ahead && scene.stage.seen_geometry().is_some() {
            // They state the view at rest; the scene's camera has that in motion.
            let both = |(_, down): (f64, Option<f64>)| {
                camera.view_angle.map(|[a, b]| (a, down.map(|_| b)))
            };
            let view_angle = options.view_angle.and_then(both);
            seen = CameraOptions { center: None, up: None, view_angle, ..options.clone() };
            &seen
        } else {
            options
        };
        let default_camera = DefaultCamera::new(scene, options, samples, |_| Vec::new())?;
        let (eye, center) = match default_camera {
            Some(DefaultCamera { eye, center, .. }) => (eye, center),
            None => {
                let center = options.center.or(camera.center).unwrap_or_else(|| middle(scene));
                (crate::eye(scene, options.eye), center)
            }
        };
        Ok(Self { default_camera, ..Self::between([eye, center], camera, options, samples)? })
    }

    /// A view of something else than a scene, with the origin for an eye or a view centre that is
    /// not given.
    ///
    /// # Errors
    /// See [`View::new`].
    pub fn without_scene(
        camera: &Camera,
        options: &CameraOptions,
        samples: [u32; 2],
    ) -> Result<Self, CameraError> {
        let ends = [options.eye.or(camera.eye), options.center.or(camera.center)];
        Self::between(ends.map(Option::unwrap_or_default), camera, options, samples)
    }

    /// The view from an eye point to a view centre, with the rest of a camera.
    fn between(
        [eye, center]: [DVec3; 2],
        camera: &Camera,
        options: &CameraOptions,
        samples: [u32; 2],
    ) -> Result<Self, CameraError> {
        let distance = view_distance(eye, center)?;
        options.check_up()?;
        let forward = (center - eye) / distance;
        let (right, is_up_replaced) =
            right_of(forward, options.up.or(camera.up).unwrap_or(DVec3::Z));
        let is_perspective =
            !options.is_orthographic && camera.projection != Some(Projection::Orthographic);
        let film = Film::new(camera, options, samples)?;
        // At the distance of the view centre both projections have the same scale.
        let half = film.half.map(|half| if is_perspective { half } else { half * distance });
        Ok(Self {
            eye,
            forward,
            is_perspective,
            slab: slab(camera, is_perspective, distance)?,
            distance,
            is_up_replaced,
            default_camera: None,
            right,
            up: right.cross(forward),
            scale: [film.samples[0] / (2.0 * half[0]), film.samples[1] / (2.0 * half[1])],
            axis: film.axis,
            size: samples.map(f64::from),
        })
    }

    /// The half-spaces whose intersection is the view volume: the four sides of the picture, and
    /// the clipping planes. `None` where there is no such plane.
    pub fn half_spaces(&self) -> [Option<HalfSpace>; 6] {
        // A side is where a sample coordinate of `place`, a linear function over w, is 0 or the
        // size.
        let side = |scale: DVec3, axis: f64| {
            if self.is_perspective {
                HalfSpace { normal: scale + axis * self.forward, offset: 0.0 }
            } else {
                HalfSpace { normal: scale, offset: axis }
            }
        };
        let (x, y) = (self.scale[0] * self.right, -self.scale[1] * self.up);
        let depth =
            |normal: DVec3, offset: f64| offset.is_finite().then_some(HalfSpace { normal, offset });
        [
            Some(side(x, self.axis[0])),
            Some(side(-x, self.size[0] - self.axis[0])),
            Some(side(y, self.axis[1])),
            Some(side(-y, self.size[1] - self.axis[1])),
            depth(self.forward, -self.slab.near),
            depth(-self.forward, self.slab.far),
        ]
    }

    /// Transforms a point, relative to the eye, to the picture.
    pub fn place(&self, point: DVec3) -> CameraPoint {
        let z = point.dot(self.forward);
        let w = if self.is_perspective { z } else { 1.0 };
        CameraPoint {
            x: self.scale[0] * point.dot(self.right) + self.axis[0] * w,
            y: self.axis[1] * w - self.scale[1] * point.dot(self.up),
            z,
        }
    }
}

/// The inverse: from the picture to points.
impl View {
    /// The point, relative to the eye, at a position in the picture, in samples, and a depth along
    /// the view.
    pub fn point(&self, [x, y]: [f64; 2], z: f64) -> DVec3 {
        let w = if self.is_perspective { z } else { 1.0 };
        let across = (x - self.axis[0]) * w / self.scale[0];
        let above = (self.axis[1] - y) * w / self.scale[1];
        across * self.right + above * self.up + z * self.forward
    }

    /// The rays of a perspective picture, at depth 1: the direction through sample coordinates x, y
    /// is the first vector plus x times the second plus y times the third.
    pub fn rays(&self) -> [DVec3; 3] {
        [self.point([0.0, 0.0], 1.0), self.right / self.scale[0], -self.up / self.scale[1]]
    }
}

/// The middle of the bounding box of all vertices, the default view centre.
pub(crate) fn middle(scene: &Scene) -> DVec3 {
    // Halved first: the sum of two large coordinates may overflow.
    scene.bounds().map_or(DVec3::ZERO, |(low, high)| low * 0.5 + high * 0.5)
}

fn slab(camera: &Camera, is_perspective: bool, distance: f64) -> Result<Slab, CameraError> {
    let nearest = if is_perspective { NEAREST * distance } else { f64::NEG_INFINITY };
    let Some([hither, yon]) = camera.clip else {
        return Ok(Slab { near: nearest, far: f64::INFINITY });
    };
    let slab = Slab { near: hither.max(nearest), far: yon };
    if slab.near < slab.far { Ok(slab) } else { Err(CameraError::Clip([hither, yon])) }
}
