//! The command line of `uglorentz`.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{ArgAction, Parser};
use glam::DVec3;
use ugparse::{Origins, Source, pipe};
use ugpipe::{CommonArgs, Context, Failure, Progress, ToolArgs, finite, vector, whole};
use ugscene::Geometry;
use ugscene::cli::{CameraArgs, RepeatArgs};

use crate::{Anchor, Config, DEFAULT_COLOR_ERROR, DEFAULT_ERROR, Error, Pieces, Table, measure};

/// Geometry of a UniGrafix scene as seen in relativistic motion
///
/// Moves every vertex to where it was when its light left it, subdivides edges that are seen as
/// curves, and writes a flat scene (instances expanded) for ugdoppler, with the velocity of each
/// face and the eye of the camera.
#[derive(Debug, Parser)]
#[command(name = "uglorentz", version, before_help = ugpipe::ONE_DASH, after_help = EXAMPLES)]
pub struct Args {
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

    /// Fixed point of the contraction: eye, origin, center or X Y Z [default: eye]
    ///
    /// center is the centre of the bounding box of each body.
    #[arg(long = "an", visible_alias = "anchor", value_name = "POINT", num_args = 1..=3,
          action = ArgAction::Set, allow_hyphen_values = true)]
    anchor: Option<Vec<String>>,

    /// Move each body so that its fixed point (-an) is seen at its coordinates in the scene
    ///
    /// This holds at time 0. With -in, the default of -an is center.
    #[arg(long = "in", visible_aliases = ["keep-in-view", "in-place"])]
    in_place: bool,

    /// Subdivide until edges deviate by at most ERR milliradians, seen from the eye [default: 0.1]
    ///
    /// Subdivision stops at 4000000 pieces, or after 32 halvings of an edge, with a warning that
    /// states the remaining errors. -vb always states them, and the vertices where they occur.
    #[arg(long = "se", visible_alias = "error", value_name = "ERR", conflicts_with = "equal",
          allow_hyphen_values = true, value_parser = finite)]
    error: Option<f64>,

    /// Subdivide also until the interpolated Doppler factor deviates by at most PERCENT, or off
    /// [default: 0.15]
    ///
    /// The default is below the threshold of human vision. off makes fewer faces, for pictures
    /// without Doppler colours (ugdoppler --no-doppler --no-flux). D above 10000, or below 0.0001,
    /// is not resolved. Has no effect with -sd.
    #[arg(long = "sc", visible_alias = "color-error", value_name = "PERCENT", allow_hyphen_values = true,
          value_parser = percent_or_off)]
    color_error: Option<f64>,

    /// Subdivide also until the interpolated light of near lamps deviates by at most PERCENT
    /// [default: off]
    ///
    /// For ugdoppler -li, which computes light at vertices: large faces near a lamp are cut, also
    /// those at rest. An error of 2 percent is hardly visible. Has no effect with -sd.
    #[arg(long = "sl", visible_alias = "light-error", value_name = "PERCENT", allow_hyphen_values = true,
          value_parser = percent_or_off)]
    light_error: Option<f64>,

    /// Cut every edge into N equal pieces, instead of -se, -sc and -sl
    #[arg(id = "equal", long = "sd", visible_alias = "pieces", value_name = "N")]
    equal: Option<u32>,

    /// Write vertex normals for smooth shading, where the scene has none
    #[arg(long = "sm", visible_alias = "smooth")]
    smooth: bool,

    #[command(flatten)]
    repeat: RepeatArgs,

    /// For teaching: omit Lorentz contraction
    #[arg(long = "nc", visible_alias = "no-contraction")]
    no_contraction: bool,

    /// For teaching: omit the light travel time
    #[arg(long = "no-flight-time")]
    no_flight_time: bool,

    /// Remove faces that are outside the view of the camera
    ///
    /// Parts of other faces outside the view are not subdivided. The picture stays the same if
    /// ugrainbow is given the same -va and -sz. If the scene has a camera, it or -vc must give the
    /// view centre.
    #[arg(long = "cull", help_heading = CAMERA)]
    cull: bool,

    #[command(flatten)]
    camera: CameraArgs,

    /// Size of the picture in pixels, of which the aspect ratio is used
    ///
    /// For -cull, and for the camera of a scene without one.
    #[arg(long = "sz", visible_alias = "size", num_args = 2, value_names = ["W", "H"], action = ArgAction::Set,
          default_values = ["1024", "768"], value_parser = whole(1..=u32::MAX),
          help_heading = CAMERA)]
    size: Vec<u32>,

    /// Also write measurements at each vertex, to FILE.csv, FILE.ply or FILE.vtp (ParaView)
    ///
    /// Name, position, emission time on the camera's clock, Doppler factor, apparent distance, and
    /// the angle between the velocity and the direction of the light to the eye, in degrees: in the
    /// frame of the camera and in that of the body. FILE.vtp has the velocity instead of the name.
    #[arg(id = "at", long = "at", visible_alias = "attributes", value_name = "FILE")]
    attributes: Option<PathBuf>,

    #[command(flatten)]
    common: CommonArgs,
}

const PROGRAM: &str = env!("CARGO_PKG_NAME");

const CAMERA: &str = "Camera";

const EXAMPLES: &str = "Examples:
  uglorentz -vel .6 0 0 -in ship.ug | ugdoppler | ugrainbow > ship.png
  uglorentz -vel .9 0 0 -in ship.ug        the ship stays in view at any speed
  uglorentz -vel 0 .9 0 -ti -2 street.ug   two units of time earlier
  uglorentz -cv 0 .9 0 street.ug           the camera drives; cars keep their velocities in the street";

/// The whole program.
pub fn main() -> ExitCode {
    ugpipe::main(run)
}

fn run(args: &Args, context: &mut Context) -> Result<(), Failure> {
    let config = args.config()?;
    let table = args.attributes.as_deref().map(table).transpose()?;
    let reading = pipe::options(&args.common)?;
    let source = pipe::read(context, &reading)?;
    let steps = context.steps();
    steps.step("reading", 0);
    let parsed = ugscene::read(&source, &reading, config.camera.name.as_deref()).map_err(pipe::refused)?;
    let (mut scene, report) = crate::apply_with_progress(parsed.scene, &config, &steps)
        .map_err(|error| failure(error, &source, &parsed.origins))?;
    drop(steps);
    ugscene::record(&mut scene, PROGRAM, env!("CARGO_PKG_VERSION"), context.command_line());
    if !parsed.warnings.is_empty() {
        context.report(&parsed.warnings.render(true));
    }
    report.warnings().iter().for_each(|warning| context.warn(warning));
    report.notes().iter().for_each(|note| context.note(note));
    report.details().iter().for_each(|detail| context.detail(detail));
    if let (Some(path), Some(table)) = (&args.attributes, table) {
        context.steps().step("measuring", 0);
        let rows = measure(&scene, ugscene::eye(&scene, None), config.time);
        context.write_file(path, &table.write(&scene, &rows))?;
    }
    context.write_with(|out| ugparse::write_to(&scene, out))
}

fn failure(error: Error, source: &Source, origins: &Origins) -> Failure {
    match error.diagnostics(source, origins) {
        Some(findings) => pipe::refused(findings),
        None if error.is_usage() => Failure::usage(error),
        None => Failure::failed(error),
    }
}

impl ToolArgs for Args {
    fn common(&self) -> &CommonArgs {
        &self.common
    }
}

impl Args {
    fn config(&self) -> Result<Config, Failure> {
        let pieces = match (self.equal, self.error) {
            (Some(n), _) => Pieces::PerEdge(n),
            (None, Some(milliradians)) => Pieces::UpTo(milliradians * 1e-3),
            (None, None) => Pieces::UpTo(DEFAULT_ERROR),
        };
        let camera = self.camera.options();
        Ok(Config {
            velocity: vector(self.velocity.as_deref()).map(DVec3::from_array),
            camera_velocity: vector(self.camera_velocity.as_deref()).map(DVec3::from_array),
            eye: camera.eye,
            camera,
            size: [self.size[0], self.size[1]],
            cull: self.cull,
            time: self.time,
            anchor: self.anchor.as_deref().map(anchor).transpose()?,
            in_place: self.in_place,
            pieces,
            color_error: self.color_error.unwrap_or(DEFAULT_COLOR_ERROR),
            light_error: self.light_error.unwrap_or(f64::INFINITY),
            measure: self.common.verbose(),
            smooth: self.smooth,
            repeat: self.repeat.repeats(),
            geometry: Geometry { contraction: !self.no_contraction, flight_time: !self.no_flight_time },
        })
    }
}

/// The format of a file of measurements.
fn table(path: &Path) -> Result<Table, Failure> {
    let extension = path.extension().map(|extension| extension.to_string_lossy()).unwrap_or_default();
    Table::by_extension(&extension).ok_or_else(|| {
        Failure::Usage(
            "-at writes a table: the name of its file must end with .csv, .ply or .vtp".to_string(),
        )
    })
}

/// A fraction, from a percentage.
fn percent_or_off(word: &str) -> Result<f64, String> {
    if word == "off" {
        return Ok(f64::INFINITY);
    }
    match finite(word)? {
        percent if percent > 0.0 => Ok(percent / 100.0),
        _ => Err("must be a percentage above 0, or off".to_string()),
    }
}

fn anchor(words: &[String]) -> Result<Anchor, Failure> {
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    match words[..] {
        ["eye"] => Ok(Anchor::Eye),
        ["origin"] => Ok(Anchor::Origin),
        ["center"] => Ok(Anchor::Center),
        [x, y, z] => {
            let numbers = [x, y, z].map(finite);
            let [Ok(x), Ok(y), Ok(z)] = numbers else { return Err(bad_anchor(&words)) };
            Ok(Anchor::Point(DVec3::new(x, y, z)))
        }
        _ => Err(bad_anchor(&words)),
    }
}

fn bad_anchor(words: &[&str]) -> Failure {
    Failure::Usage(format!(
        "`{}` is not an anchor: -an takes eye, origin, center or three numbers",
        words.join(" ")
    ))
}
