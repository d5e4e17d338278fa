//! The command line of `uglorentz`.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{ArgAction, Parser};
use glam::DVec3;
use ugparse::pipe;
use ugpipe::{CommonArgs, Failure, Stage, ToolArgs, finite, vector};
use ugscene::Geometry;
use ugscene::cli::CameraArgs;

use crate::{Anchor, Config, DEFAULT_COLOR_ERROR, DEFAULT_ERROR, Error, Pieces, Table};

/// Geometry of a UniGrafix scene as seen in relativistic motion
///
/// Moves every vertex to where its light left it, cuts edges that are then seen bent, and writes a flat
/// scene whose faces carry their velocity and whose camera carries the eye, ready for ugdoppler.
#[derive(Debug, Parser)]
#[command(name = "uglorentz", version, before_help = ugpipe::ONE_DASH, after_help = EXAMPLES)]
pub struct Args {
    /// Velocity of all objects, fraction of c [default: the scene's, else 0]
    #[arg(long = "vel", visible_alias = "velocity", value_names = ["X", "Y", "Z"], num_args = 3,
          action = ArgAction::Set, allow_hyphen_values = true, value_parser = finite)]
    velocity: Option<Vec<f64>>,

    /// Velocity of the camera in the scene, fraction of c [default: the scene's, else 0]
    ///
    /// Velocities of objects are then those in the scene, too. Where the camera looks, -vc and -ud, is said in
    /// its own frame.
    #[arg(long = "cv", visible_alias = "camera-velocity", value_names = ["X", "Y", "Z"], num_args = 3,
          action = ArgAction::Set, allow_hyphen_values = true, value_parser = finite)]
    camera_velocity: Option<Vec<f64>>,

    /// Time of the picture on the observer's clock
    ///
    /// At time 0 the scene's coordinates hold; a unit of time is what light takes for a unit of length.
    #[arg(long = "ti", visible_alias = "time", value_name = "T", default_value = "0",
          allow_hyphen_values = true, value_parser = finite)]
    time: f64,

    /// Point about which bodies contract: eye, origin, center or X Y Z [default: eye]
    ///
    /// center is the middle of the box round each body.
    #[arg(long = "an", visible_alias = "anchor", value_name = "POINT", num_args = 1..=3,
          action = ArgAction::Set, allow_hyphen_values = true)]
    anchor: Option<Vec<String>>,

    /// Put each body so that its anchor is seen where the scene has it
    ///
    /// At time 0. The anchor is then center unless -an says otherwise.
    #[arg(long = "in", visible_alias = "in-place")]
    in_place: bool,

    /// Cut until the picture is right to ERR milliradians at the eye [default: 0.1]
    ///
    /// Cutting stops at 4000000 pieces, or after 32 halvings of an edge, with a warning that tells the error left.
    /// -vb always tells it, and where it is.
    #[arg(long = "se", visible_alias = "error", value_name = "ERR", conflicts_with = "equal",
          allow_hyphen_values = true, value_parser = finite)]
    error: Option<f64>,

    /// Cut until the Doppler factor is right to PERCENT between vertices, or off [default: 0.15]
    ///
    /// The default is less than an eye can tell apart. off saves faces where colours are not shown as they are
    /// seen (ugdoppler --no-doppler --no-flux). It does nothing with -sd.
    #[arg(long = "sc", visible_alias = "color-error", value_name = "PERCENT", allow_hyphen_values = true,
          value_parser = percent_or_off)]
    color_error: Option<f64>,

    /// Cut also until the light of near lamps is right to PERCENT between vertices [default: off]
    ///
    /// For ugdoppler -li, which puts light into colours at vertices: large faces near a lamp, at rest too, get the vertices they
    /// need. 2 is hardly seen. It does nothing with -sd.
    #[arg(long = "sl", visible_alias = "light-error", value_name = "PERCENT", allow_hyphen_values = true,
          value_parser = percent_or_off)]
    light_error: Option<f64>,

    /// Cut every edge into N equal pieces instead
    #[arg(id = "equal", long = "sd", visible_alias = "pieces", value_name = "N")]
    equal: Option<u32>,

    /// Write vertex normals for smooth shading, where the scene has none
    #[arg(long = "sm", visible_alias = "smooth")]
    smooth: bool,

    /// For teaching: leave out Lorentz contraction
    #[arg(long = "nc", visible_alias = "no-contraction")]
    no_contraction: bool,

    /// For teaching: leave out the time light takes
    #[arg(long = "no-flight-time")]
    no_flight_time: bool,

    /// Leave out faces that the camera does not see
    ///
    /// They are not cut either, nor are parts of others that are out of sight. The picture stays the same, if ugrainbow has the same -va and -sz; the
    /// scene's camera or -vc must say where it looks.
    #[arg(long = "cull", help_heading = CAMERA)]
    cull: bool,

    #[command(flatten)]
    camera: CameraArgs,

    /// Size of the picture in pixels, for -cull: its shape counts
    #[arg(long = "sz", visible_alias = "size", num_args = 2, value_names = ["W", "H"], action = ArgAction::Set,
          default_values = ["1024", "768"], value_parser = clap::value_parser!(u32).range(1..),
          help_heading = CAMERA)]
    size: Vec<u32>,

    /// Also write what is measured at each vertex, to FILE.csv or FILE.ply
    ///
    /// Name, place, emission time on the camera's clock, Doppler factor, apparent distance, and the angle between
    /// the motion and the light's way to the eye, in degrees: in the camera's frame and in the body's.
    #[arg(id = "at", long = "at", visible_alias = "attributes", value_name = "FILE")]
    attributes: Option<PathBuf>,

    #[command(flatten)]
    common: CommonArgs,
}

const CAMERA: &str = "Camera";

const EXAMPLES: &str = "Examples:
  uglorentz -vel .9 0 0 ship.ug | ugdoppler | ugrainbow > ship.png
  uglorentz -vel .9 0 0 -in ship.ug        the ship stays in the picture at any speed
  uglorentz -vel 0 .9 0 -ti -2 street.ug   two units of time earlier
  uglorentz -cv 0 .9 0 street.ug           the camera drives; cars keep their velocities in the street";

/// The whole program.
pub fn main() -> ExitCode {
    ugpipe::main(run)
}

fn run(args: &Args, stage: &mut Stage) -> Result<(), Failure> {
    let config = args.config(stage.command_line())?;
    let source = pipe::read(stage, &config.reading)?;
    let report = crate::run_with(&config, &source, &stage.steps()).map_err(failure)?;
    if !report.warnings.is_empty() {
        stage.report(&report.warnings.render(true));
    }
    report.notes.warnings().iter().for_each(|warning| stage.warn(warning));
    report.notes.details().iter().for_each(|detail| stage.detail(detail));
    if let (Some(path), Some(table)) = (&args.attributes, &report.table) {
        stage.write_file(path, table)?;
    }
    stage.write_with(|out| ugparse::write_to(&report.scene, out))
}

fn failure(error: Error) -> Failure {
    match error {
        Error::Scene(findings) => pipe::refused(findings),
        error if error.is_usage() => Failure::usage(error),
        error => Failure::failed(error),
    }
}

impl ToolArgs for Args {
    fn common(&self) -> &CommonArgs {
        &self.common
    }
}

impl Args {
    fn config(&self, command_line: &str) -> Result<Config, Failure> {
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
            cull: self.cull.then(|| [self.size[0], self.size[1]]),
            time: self.time,
            anchor: self.anchor.as_deref().map(anchor).transpose()?,
            in_place: self.in_place,
            pieces,
            color_error: self.color_error.unwrap_or(DEFAULT_COLOR_ERROR),
            light_error: self.light_error.unwrap_or(f64::INFINITY),
            measure: self.common.verbose(),
            smooth: self.smooth,
            geometry: Geometry { contraction: !self.no_contraction, flight_time: !self.no_flight_time },
            table: self.attributes.as_deref().map(table).transpose()?,
            reading: pipe::options(&self.common)?,
            command_line: command_line.to_string(),
        })
    }
}

/// The format of a file of measurements.
fn table(path: &Path) -> Result<Table, Failure> {
    let ending = path.extension().map(|ending| ending.to_string_lossy()).unwrap_or_default();
    Table::by_ending(&ending).ok_or_else(|| {
        Failure::Usage("the file of -at is a table: its name ends with .csv or .ply".to_string())
    })
}

/// A part, from a percentage.
fn percent_or_off(word: &str) -> Result<f64, String> {
    if word == "off" {
        return Ok(f64::INFINITY);
    }
    match finite(word)? {
        percent if percent > 0.0 => Ok(percent / 100.0),
        _ => Err("it takes a percentage above 0, or off".to_string()),
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
