//! Notes on a scene.

use std::fmt;

use crate::words::point;
use crate::{
    BodyBoxes, CameraOptions, DefaultCamera, MotionOptions, Scene, TimesInView, VertexId, View,
    n_mixing_vertices,
};

/// A note on a scene.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Note {
    /// The scene has no camera.
    DefaultCamera(DefaultCamera),
    /// Faces of different colours meet at this many vertices.
    MixedColors(usize),
    /// A black body or spectrum is drawn with its colour at rest.
    SpectraAtRest {
        /// The name of its colour.
        color: String,
    },
    /// Bodies move, and none of those is in the picture.
    OutOfView {
        /// The time of the picture.
        time: f64,
        /// When they are in it, if they ever are.
        when: Option<TimesInView>,
    },
}

impl Note {
    /// The note on vertices whose colours are mixed; `None` if there are none.
    pub fn mixed_colors(scene: &Scene) -> Option<Self> {
        let n_vertices = n_mixing_vertices(scene);
        (n_vertices > 0).then_some(Self::MixedColors(n_vertices))
    }
}

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::DefaultCamera(DefaultCamera { eye, center, view_angle_deg }) => write!(
                f,
                "no camera in the scene: seen from {}, toward {}, with a view angle of {view_angle_deg} degrees",
                point(*eye),
                point(*center)
            ),
            Self::MixedColors(n) => {
                let vertices = if *n == 1 { "vertex" } else { "vertices" };
                write!(
                    f,
                    "colours are mixed at {n} {vertices} where faces of different colours meet"
                )
            }
            Self::OutOfView { time, when: Some(when) } => {
                write!(f, "nothing that moves is in the picture at time {time}; it is {when}")
            }
            Self::OutOfView { time, when: None } => {
                write!(
                    f,
                    "nothing that moves is in the picture at time {time}, and no other time was found"
                )
            }
            Self::SpectraAtRest { color } => {
                write!(
                    f,
                    "black bodies and spectra count with their colour at rest (colour `{color}`)"
                )
            }
        }
    }
}

/// False only if nothing moves, or a part of a body that moves in the frame of the scene is in the
/// picture of a scene as seen. Then [`BodyBoxes::note`], which needs the scene at rest, has nothing
/// to say. Bodies on world lines, and those that a moving camera sees, are not examined.
pub fn may_miss_motion(seen: &Scene, options: &CameraOptions, size: [u32; 2]) -> bool {
    let Some(stage) = seen.stage.seen_geometry() else { return false };
    let options = CameraOptions { eye: None, ..options.clone() };
    let Ok(view) = View::new(seen, &options, size) else { return true };
    let spaces: Vec<_> = view.half_spaces().into_iter().flatten().collect();
    let is_seen = |corner: &VertexId| {
        let place = seen.vertices[corner.index()].position - view.eye;
        spaces.iter().all(|space| place.dot(space.normal) + space.offset >= 0.0)
    };
    let frame = |body| seen.bodies.motion(body).inertial_frame();
    let moves = |body| frame(body).is_some_and(|own| !own.velocity.is_zero());
    let mut moving = seen.drawn().filter(|drawn| moves(drawn.body));
    !stage.camera_velocity.is_zero()
        || !moving.any(|drawn| seen.contours.corners(drawn.contours).iter().any(is_seen))
}

impl BodyBoxes {
    /// The note on a picture in which nothing is that moves, with the times at which it would be;
    /// `None` if it is, nothing moves, or the camera is invalid. `seen`: the scene as seen, whose
    /// camera has the eye and the view centre of a scene without a camera.
    pub fn note(
        &self,
        seen: &Scene,
        motion: &MotionOptions,
        options: &CameraOptions,
        size: [u32; 2],
    ) -> Option<Note> {
        let fitted = seen.camera().filter(|_| !self.has_camera());
        let camera = fitted.map_or_else(
            || options.clone(),
            |camera| CameraOptions { eye: camera.eye, center: camera.center, ..options.clone() },
        );
        if !self.seen(motion, &camera, size).ok()?.are_moving_out_of_view() {
            return None;
        }
        Some(Note::OutOfView {
            time: motion.time,
            when: self.times_in_view(motion, &camera, size).ok()?,
        })
    }
}
