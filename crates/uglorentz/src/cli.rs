//! The command line of `uglorentz`.

mod words;

use std::convert::Infallible;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{ArgAction, Parser};
use ugparse::{Origins, Source, pipe};
use ugpipe::{
    CommonArgs, Context, Failure, Look, LookArgs, PIXELS_PER_INCH, Progress, Side, ToolArgs, Words,
    finite, remedies,
};
use ugscene::cli::{CameraArgs, EffectArgs, MotionArgs, RepeatArgs};
use ugscene::{BodyBoxes, CameraOptions, Provenance};

use crate::{
    Config, DEFAULT_COLOR_ERROR, DEFAULT_ERROR, Error, MeasuredFrame, PROVENANCE, Pieces, Table,
    measure,
};

/// Geometry of a UniGrafix scene as seen in relativistic motion
///
/// Moves every vertex to where it was when its light left it, subdivides edges that are seen as
/// curves, and writes a flat scene (instances expanded) for ugdoppler, with the velocity of each
/// face and the eye of the camera.
#[derive(Clone, Debug, Parser)]
#[command(name = "uglorentz", version, after_help = EXAMPLES)]
pub struct Args {
    #[command(flatten)]
    motion: MotionArgs,

    /// Largest error of edges: milliradians at the eye, or pixels, .15px [default: 0.1]
    ///
    /// Edges are subdivided until they deviate by at most ERR. Pixels are those of -sz and the view:
    /// small pictures have fewer pieces, and edges shorter than a pixel are not cut. Subdivision
    /// stops at 4000000 pieces (1000000 beyond the faces, if a body accelerates or turns), or after
    /// 32 halvings of an edge, with a warning that states the remaining errors. -vb always
    /// states them, and the vertices where they occur. Faces of a scene with textures stay whole,
    /// since a ray is drawn for each sample of them, unless ERR in milliradians, -sc or -sl is given.
    #[arg(long = "se", visible_alias = "error", value_name = "ERR", conflicts_with = "equal",
          allow_hyphen_values = true, value_parser = error_bound)]
    error: Option<Pieces>,

    /// Subdivide also until the interpolated Doppler factor deviates by at most PERCENT, or off
    /// [default: 0.15]
    ///
    /// The default is below the threshold of human vision. off makes fewer faces, for pictures
    /// without Doppler colours (ugdoppler --no-doppler --no-flux). D above 10000, or below 0.0001,
    /// is not resolved.
    #[arg(long = "sc", visible_alias = "color-error", value_name = "PERCENT", conflicts_with = "equal",
          allow_hyphen_values = true, value_parser = percent_or_off)]
    color_error: Option<f64>,

    /// Subdivide also until the interpolated light of near lamps deviates by at most PERCENT
    /// [default: off]
    ///
    /// For ugdoppler -li, which computes light at vertices: large faces near a lamp are cut, also
    /// those at rest. An error of 2 percent is hardly visible. Where the light of a lamp jumps
    /// (c_time), edges are halved up to 12 times, and the shortest do not count as errors.
    #[arg(long = "sl", visible_alias = "light-error", value_name = "PERCENT", conflicts_with = "equal",
          allow_hyphen_values = true, value_parser = percent_or_off)]
    light_error: Option<f64>,

    /// Cut every edge into N equal pieces, instead of -se, -sc and -sl
    ///
    /// With 1, spheres, cylinders, tubes and discs stay whole, as ugrainbow -xc draws them; else
    /// they become polygons.
    #[arg(id = "equal", long = "sd", visible_alias = "pieces", value_name = "N")]
    equal: Option<u32>,

    /// Write vertex normals for smooth shading
    ///
    /// Normals that the scene has are kept.
    #[arg(long = "sm", visible_alias = "smooth")]
    smooth: bool,

    #[command(flatten)]
    repeat: RepeatArgs,

    #[command(flatten)]
    effects: EffectArgs,

    /// Where bodies are at one time of a frame, not where they are seen: camera, scene, or a body
    ///
    /// Writes a scene at rest: bodies are contracted, clocks and other colours that change are
    /// those of their own times then, and lamps are where they are. Any program draws it, ugphoton
    /// too. The camera rests in the frame; -ti is the time of a clock at its eye, or that of the body.
    /// A body that accelerates or turns carries the eye, and its frame is that of this moment.
    #[arg(long, value_name = "FRAME", value_parser = frame,
          conflicts_with_all = ["no_contraction", "no_flight_time", "at", "is_ahead"])]
    measured: Option<MeasuredFrame>,

    /// Remove faces that are outside the view of the camera
    ///
    /// Parts of other faces outside the view are not subdivided. The picture stays the same if
    /// ugrainbow is given the same -va and -sz, but for the margins of the view beside a legend or
    /// above a caption. If the scene has a camera, it or -vc must give the view centre.
    #[arg(long = "cull", help_heading = CAMERA)]
    cull: bool,

    #[command(flatten)]
    camera: CameraArgs,

    /// Size of the picture in pixels, of which mostly the aspect ratio is used
    ///
    /// For -se in pixels, -cull, and for the camera of a scene without one. Lengths have 300 pixels to the inch here;
    /// -vec rounds them to points, so its aspect ratio may differ by half a point on a side.
    #[arg(long = "sz", visible_alias = "size", num_args = 2, value_names = ["W", "H"], action = ArgAction::Set,
          default_values = ["1024", "768"], value_parser = Side::parse,
          help_heading = CAMERA)]
    size: Vec<Side>,

    /// Also write measurements at each vertex to FILE
    ///
    /// FILE.csv, FILE.ply, or FILE.vtp for ParaView. Name, position, emission time on the camera's
    /// clock, Doppler factor, apparent distance, and the angle between the velocity and the
    /// direction of the light to the eye, in degrees: in the frame of the camera and in that of the
    /// body. FILE.vtp has the velocity instead of the name.
    #[arg(id = "at", long = "at", visible_alias = "attributes", value_name = "FILE")]
    attributes: Option<PathBuf>,

    #[command(flatten)]
    look: LookArgs,

    #[command(flatten)]
    common: CommonArgs,
}

const CAMERA: &str = "Camera";

const EXAMPLES: &str = "Examples:
  uglorentz -vel .6 0 0 -in ship.ug | ugdoppler | ugrainbow > ship.png
  uglorentz -vel .9 0 0 -in ship.ug | ugrainbow > shape.png   # shape only
  uglorentz -vel 0 .9 0 -ti -2 street.ug | ugrainbow > earlier.png   # two units of time earlier
  uglorentz -cv 0 .7 0 traffic.ug | ugrainbow > drive.png   # the camera moves";

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
    let parsed =
        ugparse::read(&source, &reading, config.camera.name.as_deref()).map_err(pipe::refused)?;
    // Downstream, faces of a texture that no file names are drawn without it.
    let has_names = pipe::unnamed_textures(&parsed.scene).is_none();
    let config = Config { is_for_rays: config.is_for_rays && has_names, ..config };
    let (mut scene, report) = crate::apply_with(parsed.scene, &config, &steps)
        .map_err(|error| failure(error, &source, &parsed.origins))?;
    drop(steps);
    let (command, files) = (Some(context.command_line()), &context.take_files_read()[..]);
    scene.head.record(Provenance { command, files, ..PROVENANCE });
    if !parsed.warnings.is_empty() {
        context.report(&parsed.warnings.report());
    }
    if let Some(look @ (Look::Light | Look::Shape)) = args.look.given() {
        let option = format!("-look {}", look.name());
        context.note(&remedies::LOOK_DOWNSTREAM.replacen("{}", &option, 1));
    }
    report.warnings().iter().for_each(|warning| context.warn(warning));
    report.notes().iter().for_each(|note| context.note(note));
    if !context.is_quiet() && ugscene::may_miss_motion(&scene, &config.camera, config.size) {
        // Seldom, so the scene at rest is read again rather than kept.
        let at_rest = ugparse::read(&source, &reading, config.camera.name.as_deref());
        let boxes = BodyBoxes::new(&at_rest.map_err(pipe::refused)?.scene);
        let camera = CameraOptions { eye: config.eye, ..config.camera.clone() };
        let note = boxes.note(&scene, &config.motion(), &camera, config.size);
        note.iter().for_each(|note| context.note(&note.words()));
    }
    let files_notes = [pipe::unnamed_textures(&scene), pipe::outside_files(&scene, context)];
    files_notes.into_iter().flatten().for_each(|note| context.note(note));
    report.details().iter().for_each(|detail| context.detail(detail));
    if let (Some(path), Some(table)) = (&args.attributes, table) {
        context.steps().step("measuring", 0);
        let rows = measure(&scene, ugscene::eye(&scene, None), config.time);
        context.write_file(path, &table.write(&scene, &rows))?;
    }
    context.write_with(|out| ugparse::write_to(&scene, &parsed.passed_on, out).map(drop))
}

fn failure(error: Error, source: &Source, origins: &Origins) -> Failure {
    match error.diagnostics(source, origins) {
        Some(findings) => pipe::refused(findings),
        None => Failure::of(error),
    }
}

impl ToolArgs for Args {
    const ESSENTIAL: &'static [&'static str] = &[
        "-vel",
        "--keep-in-view",
        "-cv",
        "-ti",
        "-ep",
        "-se",
        "-sm",
        "-nc",
        "--measured",
        "-at",
        "-fo",
    ];

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
        let pieces = match (self.equal, self.error) {
            (Some(n), _) => Pieces::PerEdge(n),
            (None, Some(pieces)) => pieces,
            (None, None) => Pieces::UpTo(DEFAULT_ERROR),
        };
        let camera = CameraOptions { is_ahead: self.motion.is_ahead(), ..self.camera.options() };
        let motion = self.motion.options()?;
        Ok(Config {
            velocity: motion.velocity,
            camera_velocity: motion.camera_velocity,
            eye: camera.eye,
            camera,
            size: Side::both(&self.size, PIXELS_PER_INCH).map_err(Failure::Usage)?,
            cull: self.cull,
            time: motion.time,
            anchor: motion.anchor,
            in_place: motion.in_place,
            pieces,
            color_error: self.color_error.unwrap_or(DEFAULT_COLOR_ERROR),
            light_error: self.light_error.unwrap_or(f64::INFINITY),
            is_for_rays: self.equal.is_none() && !self.has_bound() && self.attributes.is_none(),
            measure: self.common.vb,
            smooth: self.smooth,
            repeat: self.repeat.repeats(),
            geometry: self.effects.geometry(),
            zero: None,
            measured: self.measured.clone(),
        })
    }
}

impl Args {
    /// True if faces are to be cut whatever draws them: a bound in pixels says only how.
    fn has_bound(&self) -> bool {
        match self.error {
            Some(Pieces::UpToPixels(_)) => false,
            Some(_) => true,
            None => self.color_error.is_some() || self.light_error.is_some(),
        }
    }
}

fn frame(word: &str) -> Result<MeasuredFrame, Infallible> {
    Ok(match word {
        "camera" => MeasuredFrame::Camera,
        "scene" => MeasuredFrame::Scene,
        name => MeasuredFrame::Body(name.to_owned()),
    })
}

/// The format of a file of measurements.
fn table(path: &Path) -> Result<Table, Failure> {
    let extension =
        path.extension().map(|extension| extension.to_string_lossy()).unwrap_or_default();
    Table::by_extension(&extension).ok_or_else(|| {
        Failure::Usage(
            "-at writes a table: the name of its file must end with .csv, .ply or .vtp".to_string(),
        )
    })
}

/// The bound of `-se`.
fn error_bound(word: &str) -> Result<Pieces, String> {
    match word.strip_suffix("px") {
        Some(pixels) => finite(pixels).map(Pieces::UpToPixels),
        None => finite(word).map(|milliradians| Pieces::UpTo(milliradians * 1e-3)),
    }
}

/// A fraction, from a percentage.
fn percent_or_off(word: &str) -> Result<f64, String> {
    if word == "off" {
        return Ok(f64::INFINITY);
    }
    finite(word).and_then(percent)
}

fn percent(percent: f64) -> Result<f64, String> {
    if percent > 0.0 {
        Ok(percent / 100.0)
    } else {
        Err("must be a percentage above 0, or off".to_string())
    }
}
