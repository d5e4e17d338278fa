//! The camera's options on the command line, the same in every program.

use clap::{ArgAction, Args};
use glam::DVec3;
use ugpipe::{finite, vector, view_angle};

use crate::CameraOptions;

/// Heading of these options in `--help`.
const CAMERA: &str = "Camera";

/// Camera name and eye point: flatten it into the arguments of a program that needs no more of the
/// camera.
#[derive(Args, Clone, Debug, Default, PartialEq)]
pub struct EyeArgs {
    /// The camera of this name [default: the first without a name, else the first]
    ///
    /// A scene that is written contains it without its name, so programs downstream use it as well.
    #[arg(long, value_name = "NAME", visible_alias = "camera", help_heading = CAMERA)]
    cam: Option<String>,

    /// Eye point [default: that of the scene's camera]
    ///
    /// A scene without a camera is seen from the front, the right and above, far enough away that
    /// all of it is in the picture. A camera without an eye point has it at the origin.
    #[arg(long, num_args = 3, value_names = ["X", "Y", "Z"], action = ArgAction::Set,
          allow_hyphen_values = true, value_parser = finite, visible_alias = "eye", help_heading = CAMERA)]
    ep: Option<Vec<f64>>,
}

impl EyeArgs {
    /// Name of the camera.
    pub fn name(&self) -> Option<String> {
        self.cam.clone()
    }

    /// Eye point.
    pub fn eye(&self) -> Option<DVec3> {
        point(&self.ep)
    }
}

/// The whole camera: flatten it into the arguments of a program.
#[derive(Args, Clone, Debug, Default, PartialEq)]
pub struct CameraArgs {
    #[command(flatten)]
    eye: EyeArgs,

    /// View centre, shown in the middle of the picture [default: that of the scene's camera, else
    /// the scene's middle]
    ///
    /// A scene that is written contains this, and the options below, in its camera.
    #[arg(long, num_args = 3, value_names = ["X", "Y", "Z"], action = ArgAction::Set,
          allow_hyphen_values = true, value_parser = finite, visible_alias = "center", help_heading = CAMERA)]
    vc: Option<Vec<f64>>,

    /// Up direction [default: that of the scene's camera, else 0 0 1]
    #[arg(long, num_args = 3, value_names = ["X", "Y", "Z"], action = ArgAction::Set,
          allow_hyphen_values = true, value_parser = finite, visible_alias = "up", help_heading = CAMERA)]
    ud: Option<Vec<f64>>,

    /// Full horizontal and, if given, vertical view angle, in degrees
    ///
    /// Default: the horizontal one of the scene's camera, else 40. Pixels are square unless both
    /// are given. A scene that is written contains the horizontal one only; give the vertical one
    /// to the renderer as well.
    #[arg(long, num_args = 1..=2, value_names = ["A", "B"], action = ArgAction::Set,
          value_parser = view_angle, visible_alias = "view-angle", help_heading = CAMERA)]
    va: Option<Vec<f64>>,

    /// Orthographic projection
    ///
    /// Objects at the distance of the view centre are drawn as large as in perspective. Objects
    /// behind the eye are drawn, too, unless the scene has clipping distances.
    #[arg(long, visible_alias = "orthographic", help_heading = CAMERA)]
    og: bool,
}

impl CameraArgs {
    /// The camera options that these arguments define.
    pub fn options(&self) -> CameraOptions {
        CameraOptions {
            name: self.eye.name(),
            eye: self.eye.eye(),
            center: point(&self.vc),
            up: point(&self.ud),
            view_angle: self.va.as_ref().map(|angles| (angles[0], angles.get(1).copied())),
            is_orthographic: self.og,
        }
    }
}

/// What happens where faces of different colours meet: flatten it into the arguments of a program.
#[derive(Args, Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RepeatArgs {
    /// Repeat a vertex for every face colour that meets there, instead of mixing them
    ///
    /// Faces then keep their own colours up to their edges.
    #[arg(long, visible_alias = "repeat-vertices")]
    vr: bool,
}

impl RepeatArgs {
    /// True if vertices are to be repeated.
    pub fn repeats(self) -> bool {
        self.vr
    }
}

fn point(numbers: &Option<Vec<f64>>) -> Option<DVec3> {
    vector(numbers.as_deref()).map(DVec3::from_array)
}
