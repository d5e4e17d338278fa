//! Options of camera and motion on the command line, the same in every program.

mod words;

use clap::{ArgAction, Args};
use glam::DVec3;
use ugphysics::Brightness;
use ugphysics::spectrum::InfraredRule;
use ugpipe::{Failure, Preset, finite, number, one_of, vector, view_angle};

use crate::{Anchor, CameraOptions, MotionOptions, ShownEffects};

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

    /// Full horizontal and, if given, vertical view angle, in degrees [default: that of the scene's
    /// camera, else 40]
    ///
    /// Pixels are square unless both
    /// are given. A scene that is written contains the horizontal one only; give the vertical one
    /// to the renderer as well.
    #[arg(long, num_args = 1..=2, value_names = ["A", "B"], action = ArgAction::Set,
          value_parser = number(view_angle), visible_alias = "view-angle", help_heading = CAMERA)]
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
            is_ahead: false,
            part: None,
        }
    }
}

/// How bodies and camera move, and when the picture is taken: flatten it into the arguments of a
/// program that reads a scene at rest.
#[derive(Args, Clone, Debug, Default, PartialEq)]
pub struct MotionArgs {
    /// Velocity of all objects, fraction of c [default: the scene's, else 0]
    #[arg(long = "vel", visible_alias = "velocity", value_names = ["X", "Y", "Z"], num_args = 3,
          action = ArgAction::Set, allow_hyphen_values = true, value_parser = finite)]
    velocity: Option<Vec<f64>>,

    /// Velocity of the camera in the scene, fraction of c [default: the scene's, else 0]
    ///
    /// Velocities of objects are in the frame of the scene as well. -vc and -ud are in the frame of
    /// the camera.
    #[arg(long = "cv", visible_alias = "camera-velocity", value_names = ["X", "Y", "Z"], num_args = 3,
          action = ArgAction::Set, allow_hyphen_values = true, value_parser = finite)]
    camera_velocity: Option<Vec<f64>>,

    /// Time of the picture on the observer's clock
    ///
    /// The coordinates of the scene are those at time 0. Light travels one unit of length in one
    /// unit of time.
    #[arg(long = "ti", visible_alias = "time", value_name = "T", default_value = "0",
          allow_hyphen_values = true, value_parser = finite)]
    time: f64,

    /// Fixed point of the contraction: eye, origin, center or X Y Z
    ///
    /// At time 0 of the scene this point of each body is where the scene has it. The default is the
    /// reference point of each body (-at of its motion, the origin of its instance), and the eye
    /// for -vel. center is the centre of the bounding box of each body. Orbits and paths stay where
    /// they are stated.
    #[arg(long = "an", visible_alias = "anchor", value_name = "POINT", num_args = 1..=3,
          action = ArgAction::Set, allow_hyphen_values = true)]
    anchor: Option<Vec<String>>,

    /// Keep bodies in view: they appear where the scene has them
    ///
    /// Each body is moved so that its fixed point (-an) is seen at its coordinates in the scene, at
    /// time 0. The default of -an is then center.
    #[arg(long = "in", visible_aliases = ["keep-in-view", "in-place"])]
    in_place: bool,

    /// View ahead of a moving camera: the picture shows at every speed what it shows at rest
    ///
    /// What is ahead of a fast camera is seen small, because of aberration. With --ahead, the
    /// scene's camera or -ep, -vc, -ud and -va state the view of a camera at rest, which is
    /// aberrated: at 0.9c a view angle of 75 degrees becomes 17.8. A camera that looks more than
    /// 60 degrees away from its motion turns to it. A scene without a camera is seen from behind
    /// along the motion.
    #[arg(long = "ahead", conflicts_with = "og")]
    is_ahead: bool,
}

impl MotionArgs {
    /// True if the view of the camera is aberrated: [`CameraOptions::is_ahead`].
    pub fn is_ahead(&self) -> bool {
        self.is_ahead
    }

    /// The options that these arguments define, with all effects.
    ///
    /// # Errors
    /// The anchor is none.
    pub fn options(&self) -> Result<MotionOptions, Failure> {
        Ok(MotionOptions {
            velocity: point(&self.velocity),
            camera_velocity: point(&self.camera_velocity),
            time: self.time,
            anchor: self.anchor.as_deref().map(anchor).transpose()?,
            in_place: self.in_place,
            geometry: ShownEffects::default(),
            zero: None,
        })
    }
}

/// Options that omit contraction or light travel time: flatten it into the arguments of a program.
#[derive(Args, Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct EffectArgs {
    /// For teaching: omit Lorentz contraction
    #[arg(long = "nc", visible_alias = "no-contraction")]
    no_contraction: bool,

    /// For teaching: omit the light travel time
    #[arg(long = "no-flight-time")]
    no_flight_time: bool,
}

impl EffectArgs {
    /// The effects that are shown.
    pub fn geometry(self) -> ShownEffects {
        ShownEffects { contraction: !self.no_contraction, flight_time: !self.no_flight_time }
    }
}

/// How motion changes colours: flatten it into the arguments of a program that shifts them.
#[derive(Args, Clone, Copy, Debug, Default, PartialEq)]
pub struct ShiftArgs {
    /// Brightness law: report (D), photon (D^3), bolometric (D^4), none [default: report]
    ///
    /// The laws photon and bolometric multiply linear light, report and none display-encoded values
    /// as in 1988, and light of lamps likewise. A renderer clips values above 1 sample by sample,
    /// unless it has -ex or -tc.
    #[arg(long, visible_alias = "brightness", value_name = "LAW",
          value_parser = one_of("laws", Brightness::ALL.map(|law| (law.name(), law))), conflicts_with = "no_flux")]
    pub br: Option<Brightness>,

    /// Shift spectra instead of hues
    ///
    /// Black bodies and sampled spectra as they are, other colours as surfaces in daylight. The
    /// brightness law is D^5 per wavelength, and light brighter than white is clipped only in the
    /// last step.
    #[arg(long, visible_alias = "spectral", conflicts_with = "br")]
    pub sp: bool,

    /// Leave wavelengths as they are
    #[arg(long)]
    pub no_doppler: bool,

    /// Infrared of surfaces of which only the colour is known: measured, constant [default:
    /// measured]
    ///
    /// With -sp. measured: what measured surfaces of this colour reflect. constant: that of
    /// the red channel. Spectra that are given (c_refl) need no rule.
    #[arg(long, value_name = "RULE",
          value_parser = one_of("rules", InfraredRule::ALL.map(|rule| (rule.name(), rule))))]
    pub infrared_rule: Option<InfraredRule>,

    /// Leave brightness as it is; with -sp omit the factor D^5
    #[arg(long)]
    pub no_flux: bool,
}

impl ShiftArgs {
    /// Shifted spectra, for the looks of a program.
    pub const SPECTRA: Preset = Preset::new(&["sp"], &["br", "gw", "iw", "wi"]);

    /// Wavelengths as at rest, for the looks of a program.
    pub const REST_WAVELENGTHS: Preset = Preset::new(&["no-doppler"], &[]);

    /// Brightness as at rest, for the looks of a program.
    pub const REST_BRIGHTNESS: Preset = Preset::new(&["no-flux"], &["br"]);
}

/// Colours where faces of different colours meet: flatten it into the arguments of a program.
#[derive(Args, Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RepeatArgs {
    /// Keep colours of faces apart where they share vertices
    ///
    /// A vertex is repeated for every face colour that meets there, instead of mixing them. Faces
    /// then keep their own colours up to their edges.
    #[arg(long, visible_alias = "repeat-vertices")]
    vr: bool,
}

impl RepeatArgs {
    /// Colours of faces apart, for the looks of a program.
    pub const APART: Preset = Preset::new(&["vr"], &[]);

    /// True if vertices are to be repeated.
    pub fn repeats(self) -> bool {
        self.vr
    }
}

fn point(numbers: &Option<Vec<f64>>) -> Option<DVec3> {
    vector(numbers.as_deref()).map(DVec3::from_array)
}

fn anchor(words: &[String]) -> Result<Anchor, Failure> {
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    let anchor = match words[..] {
        ["eye"] => Some(Anchor::Eye),
        ["origin"] => Some(Anchor::Origin),
        ["center"] => Some(Anchor::Center),
        [x, y, z] => match [x, y, z].map(finite) {
            [Ok(x), Ok(y), Ok(z)] => Some(Anchor::Point(DVec3::new(x, y, z))),
            _ => None,
        },
        _ => None,
    };
    anchor.ok_or_else(|| {
        let words = words.join(" ");
        Failure::Usage(format!(
            "`{words}` is not an anchor: -an takes eye, origin, center or three numbers"
        ))
    })
}
