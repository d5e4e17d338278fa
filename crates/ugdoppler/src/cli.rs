//! The command line of `ugdoppler`.

use std::process::ExitCode;

use clap::{ArgAction, Parser};
use glam::DVec3;
use uglight::ColorShift;
use ugparse::{Diagnostic, Diagnostics, Origins, Source, pipe};
use ugphysics::Velocity;
use ugpipe::{
    CommonArgs, Context, Failure, Look, LookArgs, Looks, Progress, ToolArgs, Words, remedies,
};
use ugscene::cli::{EyeArgs, RepeatArgs, ShiftArgs};
use ugscene::{CameraError, Provenance};
use ugskybox::SceneSky;
use ugskybox::cli::SkyArgs;

use crate::{Config, DEFAULT_TOLERANCE, Error, Note, PROVENANCE, apply_with};

/// Colours of a UniGrafix scene as seen in relativistic motion
///
/// Reads the scene that uglorentz writes and gives every vertex its colour as seen. The hue is
/// converted to a wavelength, which is divided by the Doppler factor D and converted back to a hue;
/// brightness is multiplied by D. Faces carry their velocity, and the camera the eye, so the
/// options -vel and -ep of uglorentz need not be repeated.
#[derive(Clone, Parser, Debug)]
#[command(name = "ugdoppler", version, after_help = EXAMPLES)]
pub struct Args {
    /// Velocity of faces that carry none, fractions of c
    ///
    /// For scenes with positions as seen that other programs wrote: those of uglorentz carry it.
    #[arg(long, visible_alias = "velocity", num_args = 3, value_names = ["X", "Y", "Z"],
          action = ArgAction::Set, allow_hyphen_values = true, value_parser = ugpipe::finite)]
    vel: Option<Vec<f64>>,

    #[command(flatten)]
    eye: EyeArgs,

    /// Write wavelengths (nm) instead of hues
    ///
    /// Renderers read and interpolate them as such.
    #[arg(long, visible_alias = "wavelengths")]
    gw: bool,

    #[command(flatten)]
    shift: ShiftArgs,

    #[command(flatten)]
    repeat: RepeatArgs,

    /// Reuse a colour that differs by at most T nm and T percent of value, or with -sp by T percent
    /// of X, Y and Z; 0: a colour for each vertex
    #[arg(long, visible_alias = "color-tolerance", value_name = "T", allow_hyphen_values = true,
          value_parser = ugpipe::finite, default_value_t = DEFAULT_TOLERANCE)]
    ct: f64,

    /// Iris: scale all values so that the brightest is 1
    ///
    /// Without it, values above 1 are clipped.
    #[arg(long, visible_alias = "iris")]
    ir: bool,

    /// Light the scene by its lights, moving ones included
    ///
    /// The light is computed into the colours. One ambient light replaces the lights, so that a
    /// renderer does not light the scene again. A sky (-sky, or that of the scene) lights it as
    /// in ugphoton, without shadows.
    #[arg(long, visible_alias = "light")]
    li: bool,

    /// Keep values above 1 for the exposure of the renderer
    ///
    /// Without it, they are clipped.
    #[arg(long, visible_alias = "keep-intensities")]
    hd: bool,

    /// Give faces with textures their mean colour
    ///
    /// Without it, the colours of a scene with textures are shifted by the renderer, with a ray for
    /// each sample. Pictures in vectors, -og, -cb and mesh files need colours at vertices, and faces
    /// that uglorentz has cut (-se 0.1).
    #[arg(long)]
    no_textures: bool,

    #[command(flatten)]
    sky: SkyArgs,

    #[command(flatten)]
    look: LookArgs,

    #[command(flatten)]
    common: CommonArgs,
}

const EXAMPLES: &str = "Examples:
  uglorentz -vel 0 -.2 0 -in ship.ug | ugdoppler | ugrainbow > ship.png
  uglorentz -vel 0 -.9 0 lattice.ug | ugdoppler -gw | ugrainbow -va 120 > ring.png
  uglorentz lamp.ug | ugdoppler -li | ugrainbow > lamp.png
  uglorentz -vel 0 -.6 0 tunnel.ug | ugdoppler -sp -ir | ugrainbow -va 90 > tunnel.png
  uglorentz -vel .9 0 0 -in ship.ug | ugdoppler --no-doppler --no-flux | ugrainbow > shape.png";

impl ToolArgs for Args {
    const ESSENTIAL: &'static [&'static str] = &[
        "-sp",
        "-look",
        "-br",
        "-gw",
        "-ir",
        "-hd",
        "-li",
        "-vr",
        "--no-doppler",
        "--no-flux",
        "-fo",
    ];

    const LOOKS: Looks = Looks {
        default: Look::Report,
        light: &[ShiftArgs::SPECTRA, RepeatArgs::APART],
        shape: &[ShiftArgs::REST_WAVELENGTHS, ShiftArgs::REST_BRIGHTNESS, RepeatArgs::APART],
    };

    fn common(&self) -> &CommonArgs {
        &self.common
    }
}

impl Args {
    /// The configuration of the options.
    ///
    /// # Errors
    /// [`Failure::Usage`]: options that exclude each other, or a value out of range.
    pub fn config(&self) -> Result<Config, Failure> {
        if !(0.0..=100.0).contains(&self.ct) {
            return Err(Failure::usage("a colour tolerance (-ct) is between 0 and 100"));
        }
        self.refuse_contradictions()?;
        let vector =
            |numbers: &Option<Vec<f64>>| ugpipe::vector(numbers.as_deref()).map(DVec3::from_array);
        let beta = vector(&self.vel).unwrap_or_default();
        let ShiftArgs { sp, br, no_doppler, no_flux, infrared_rule } = self.shift;
        Ok(Config {
            velocity: Velocity::from_beta(beta).map_err(Failure::usage)?,
            eye: self.eye.eye(),
            wavelengths: self.gw,
            shift: ColorShift::new(sp, !no_doppler, !no_flux, br)
                .with_infrared(infrared_rule.unwrap_or_default()),
            repeat: self.repeat.repeats(),
            tolerance: self.ct,
            iris: self.ir,
            light: self.li,
            sky: if self.li { self.sky.sky() } else { SceneSky::default() },
            keep: self.hd,
            no_textures: self.no_textures,
        })
    }

    fn refuse_contradictions(&self) -> Result<(), Failure> {
        if self.shift.sp && self.gw {
            return Err(Failure::usage(
                "-sp writes X, Y, Z and -gw writes wavelengths of hues: give one of them",
            ));
        }
        if self.shift.sp && self.hd {
            return Err(Failure::usage(
                "-sp keeps intensities above 1 for the renderer by itself: leave out -hd",
            ));
        }
        if self.ir && self.hd {
            return Err(Failure::usage(
                "-ir scales intensities to 1 and -hd keeps them: give one of them",
            ));
        }
        Ok(())
    }
}

/// The whole program.
pub fn main() -> ExitCode {
    ugpipe::main(run)
}

fn run(args: &Args, context: &mut Context) -> Result<(), Failure> {
    let mut config = args.config()?;
    let reading = pipe::options(&args.common)?;
    let source = pipe::downstream(pipe::read(context, &reading)?, context);
    if config.light {
        config.sky.open_with((&source, &reading), &args.common, context)?;
    }
    let steps = context.steps();
    steps.step("reading", 0);
    let parsed =
        ugparse::read(&source, &reading, args.eye.name().as_deref()).map_err(pipe::refused)?;
    let first_round = parsed.first_round();
    let applied = apply_with(parsed.scene, &config, &steps);
    let (mut scene, notes) = applied.map_err(|error| match error {
        Error::TooManyPolygons(error) => {
            pipe::refused(ugparse::too_many_polygons(&source, first_round, error))
        }
        error => failure(error, &source, &parsed.origins),
    })?;
    drop(steps);
    let (command, files) = (Some(context.command_line()), &context.take_files_read()[..]);
    scene.head.record(Provenance { command, files, ..PROVENANCE });
    if !parsed.warnings.is_empty() {
        context.report(&parsed.warnings.report());
    }
    notes.iter().for_each(|note| context.note(&note.words()));
    context.detail(&format!("{} vertices, {} colours", scene.vertices.len(), scene.colors.len()));
    context.write_with(|out| ugparse::write_to(&scene, &parsed.passed_on, out).map(drop))
}

/// Errors at a vertex are shown at its statement.
fn failure(error: Error, source: &Source, origins: &Origins) -> Failure {
    match error {
        Error::VertexAtEye { vertex, .. } => {
            let span = origins.vertices.get(vertex.index()).copied().unwrap_or_default();
            let finding = Diagnostic::error(span, error.to_string());
            let finding = finding.label("here").help("move the eye (-ep) or the vertex");
            pipe::refused(Diagnostics::one(source, finding))
        }
        error => Failure::failed(error.words()),
    }
}

impl Words for Note {
    fn words(&self) -> String {
        match self {
            Self::Scene(note) => note.words(),
            Self::Kept(_) => format!("{self}; -ir scales it to 1.0"),
            Self::TakenAsSeen => remedies::MOVE_FIRST.replacen("{}", &self.to_string(), 1),
            Self::AllMove => format!("{self}, so -vel has no effect"),
            Self::NoLights => {
                "no lights in the scene, so -li puts none into its colours".to_owned()
            }
            Self::PlainTextures { .. } => format!(
                "{self}; leave out -vel, -gw, -ir, -hd, -li with moving lights or a sky, and orthographic cameras"
            ),
            Self::DeferredTextures { .. } => {
                format!("{self}; --no-textures shifts mean colours here")
            }
            Self::Scaled(_) | Self::Clipped(_) | Self::TooSaturated { .. } => self.to_string(),
        }
    }
}

impl Words for Error {
    fn words(&self) -> String {
        match self {
            Self::Stage(error) => error.words(),
            // The view centre is that of the scene.
            Self::Camera(CameraError::NoDirection { .. }) => {
                format!(
                    "{self}; move the eye with -ep, or correct the `cam` statement of the scene"
                )
            }
            Self::Camera(error) => error.words(),
            Self::TooManyLights { .. } => format!("-li computes {self}"),
            Self::Sky(error) => error.words(),
            Self::TooManyPolygons(_) | Self::VertexAtEye { .. } | Self::Stopped(_) => {
                self.to_string()
            }
        }
    }
}
