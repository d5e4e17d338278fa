//! The command line.

mod words;

use std::path::{Path, PathBuf};
use std::str::FromStr;

use clap::{ArgAction, Parser};
use glam::DVec3;
use ugimage::Format;
use ugimage::label::TextForm;
use ugparse::pipe;
use ugpicture::cli::{format_for, format_named, refuse_terminal, with_format, write_picture};
use ugpicture::{AnnotationOptions, Output, PictureOptions, Units};
use ugpipe::{
    CommonArgs, Context, Failure, PIXELS_PER_INCH, Side, ToolArgs, Words, finite, number, vector,
};
use ugscene::cli::{CameraArgs, MotionArgs};
use ugscene::{CameraOptions, Provenance};

use crate::config::{Config, DiagramOptions, PointChoice, TickChoice};
use crate::render::{PROVENANCE, run};
use crate::words::{EventWord, FrameWord, NamedEvent};

/// Draws the spacetime diagram of a UniGrafix scene
///
/// Reads a scene at rest and writes its diagram: world lines with ticks of own time, the past light
/// cone of the eye, and on it the events at which the light of the picture left. Time runs upwards,
/// light at 45 degrees. Bodies are where they are, not where they are seen.
///
/// EVENT is one of: eye; T,X or T,X,Y,Z in the scene, with @FRAME in another frame; NAME@TIME, a
/// body, lamp or camera at an own time; the name of an event or of a vertex. FRAME is scene, camera,
/// or the name of a body, with @TIME that of what accelerates at an own time.
#[derive(Clone, Debug, Parser)]
#[command(name = "ugdiagram", version, after_help = EXAMPLES)]
pub struct Args {
    #[command(flatten)]
    motion: MotionArgs,

    #[command(flatten)]
    camera: CameraArgs,

    /// Frame of the diagram [default: scene]
    #[arg(long, value_name = "FRAME", value_parser = FrameWord::from_str, help_heading = DIAGRAM)]
    frame: Option<FrameWord>,

    /// Direction of space across, in the axes of the scene [default: that of the fastest motion]
    #[arg(long, num_args = 3, value_names = ["X", "Y", "Z"], action = ArgAction::Set,
          allow_hyphen_values = true, value_parser = finite, help_heading = DIAGRAM)]
    axis: Option<Vec<f64>>,

    /// Names of world lines to draw [default: all]
    ///
    /// Of bodies, lamps and cameras, separated by commas; by default those that do not coincide. A
    /// body is called as its motion is, or as its instance; the camera of the picture is called
    /// camera, and what rests without a name is called rest.
    #[arg(long, value_name = "NAMES", help_heading = DIAGRAM)]
    show: Option<String>,

    /// Vertices whose emission events are drawn, with their names, separated by commas; or all,
    /// none [default: all, without names]
    #[arg(long, value_name = "NAMES", help_heading = DIAGRAM)]
    points: Option<String>,

    /// Mark an event; may be given more than once
    #[arg(long, value_name = "NAME=EVENT", action = ArgAction::Append, allow_hyphen_values = true,
          value_parser = NamedEvent::from_str, help_heading = DIAGRAM)]
    event: Vec<NamedEvent>,

    /// Measure the interval of two events
    ///
    /// Its kind, its length and its parts in the frames of the diagram are printed. It is drawn as a
    /// dotted line.
    #[arg(long, num_args = 2, value_names = ["A", "B"], action = ArgAction::Append,
          allow_hyphen_values = true, value_parser = EventWord::from_str, help_heading = DIAGRAM)]
    interval: Vec<EventWord>,

    /// Line of events simultaneous with EVENT in FRAME
    ///
    /// The frame of a body that accelerates is the one in which it rests then.
    #[arg(long, num_args = 2, value_names = ["FRAME", "EVENT"], action = ArgAction::Append,
          allow_hyphen_values = true, help_heading = DIAGRAM)]
    simultaneous: Vec<String>,

    /// Axes of FRAME through EVENT, with ticks in its units
    #[arg(long, num_args = 2, value_names = ["FRAME", "EVENT"], action = ArgAction::Append,
          allow_hyphen_values = true, help_heading = DIAGRAM)]
    axes: Vec<String>,

    /// Light cone of an event, into past and future
    #[arg(long, value_name = "EVENT", action = ArgAction::Append, allow_hyphen_values = true,
          value_parser = EventWord::from_str, help_heading = DIAGRAM)]
    cone: Vec<EventWord>,

    /// Leave out the past light cone of the eye
    #[arg(long, help_heading = DIAGRAM)]
    no_cone: bool,

    /// Own time between ticks of world lines, or off [default: a round number]
    #[arg(long, value_name = "TIME", allow_hyphen_values = true, value_parser = ticks,
          help_heading = DIAGRAM)]
    ticks: Option<TickChoice>,

    /// First and last time [default: those of all events]
    #[arg(long, num_args = 2, value_names = ["FROM", "TO"], action = ArgAction::Set,
          allow_hyphen_values = true, value_parser = finite, help_heading = DIAGRAM)]
    times: Option<Vec<f64>>,

    /// First and last place along the axis [default: those of all events]
    ///
    /// Units of time and space are equally long, so the range that is too short for the picture is
    /// extended to both sides.
    #[arg(long, num_args = 2, value_names = ["FROM", "TO"], action = ArgAction::Set,
          allow_hyphen_values = true, value_parser = finite, help_heading = DIAGRAM)]
    places: Option<Vec<f64>>,

    /// Also write all events and intervals to FILE.csv, in each frame of the diagram
    #[arg(id = "at", long = "at", visible_alias = "attributes", value_name = "FILE", help_heading = DIAGRAM)]
    table: Option<PathBuf>,

    /// Format of the picture [default: by the ending of -fo, else png]
    ///
    /// pdf, svg, eps and ps have lines and letters, sharp at any size; -sz is then in points.
    #[arg(long, value_name = "FMT", visible_alias = "format", value_parser = format_named,
          help_heading = PICTURE)]
    dt: Option<Format>,

    /// Size of the picture in pixels, or in mm, cm, in, pt
    ///
    /// A length, as in -sz 8.6cm 8cm, has 300 pixels to the inch, which a PNG file states.
    #[arg(long, num_args = 2, value_names = ["W", "H"], action = ArgAction::Set,
          default_values = ["1024", "1024"], value_parser = Side::parse,
          visible_alias = "size", help_heading = PICTURE)]
    sz: Vec<Side>,

    /// Text of vector graphics as text, instead of outlines
    #[arg(long, visible_alias = "text", help_heading = PICTURE)]
    txt: bool,

    /// Smaller PNG files, which take longer to compress
    #[arg(long, visible_alias = "pack", help_heading = PICTURE)]
    pz: bool,

    /// Title above the diagram, wrapped as needed
    #[arg(long, value_name = "TEXT", help_heading = PICTURE)]
    title: Option<String>,

    /// Caption below the diagram, wrapped as needed; line breaks are kept
    #[arg(long, value_name = "TEXT", visible_alias = "caption", help_heading = PICTURE)]
    cap: Option<String>,

    /// Size of text in pixels, 4 to 200 [default: 1/40 of the geometric mean of -sz]
    #[arg(long, value_name = "PIXELS", visible_alias = "text-size", value_parser = number(text_size),
          help_heading = PICTURE)]
    ts: Option<f64>,

    /// What a length of 1 in the scene is: m, km, ls (a light-second) ...; with a number, as '20 m'
    #[arg(long, value_name = "UNIT", help_heading = PICTURE)]
    unit: Option<String>,

    #[command(flatten)]
    common: CommonArgs,
}

const DIAGRAM: &str = "Diagram";
const PICTURE: &str = "Picture";

const EXAMPLES: &str = "Examples:
  ugdiagram twins.ug -ti 26 > twins.png
  ugdiagram -vel .6 0 0 -in ship.ug -axes ship eye -sz 8.6cm 8cm -fo ship.pdf
  ugdiagram twins.ug -ti 26 --simultaneous traveller traveller@4 --interval traveller@0 traveller@12 > ages.png
  ugdiagram ticks.ug --frame camera -at events.csv -fo ticks.svg";

impl ToolArgs for Args {
    const ESSENTIAL: &'static [&'static str] = &[
        "-vel",
        "-cv",
        "-ti",
        "--frame",
        "-show",
        "--event",
        "--interval",
        "--simultaneous",
        "-axes",
        "-sz",
        "-fo",
    ];

    fn common(&self) -> &CommonArgs {
        &self.common
    }
}

impl Args {
    /// The configuration of the options. `output`: the file whose ending is the format unless an
    /// option gives it.
    ///
    /// # Errors
    /// [`Failure::Usage`]: a value out of range.
    pub fn config(&self, output: Option<&Path>) -> Result<Config, Failure> {
        let format = format_for(self.dt, output)?;
        let is_vector = format.has_vectors();
        let per_inch = if is_vector { 72.0 } else { PIXELS_PER_INCH };
        let annotations = AnnotationOptions {
            title: self.title.clone().unwrap_or_default(),
            caption: self.cap.clone().unwrap_or_default(),
            text_size: self.ts,
            units: Units::new(self.unit.as_deref(), None)
                .map_err(|error| Failure::usage(format!("-unit: {error}")))?,
            ..AnnotationOptions::default()
        };
        let camera = CameraOptions { is_ahead: self.motion.is_ahead(), ..self.camera.options() };
        Ok(Config {
            motion: self.motion.options()?,
            picture: PictureOptions {
                camera,
                size: Side::both(&self.sz, per_inch).map_err(Failure::Usage)?,
                per_inch: self.sz.iter().any(|side| side.is_length()).then_some(per_inch),
                output: if is_vector { Output::Vector(format) } else { Output::Color(format) },
                text: if self.txt { TextForm::Text } else { TextForm::Outlines },
                annotations,
                small: self.pz,
                ..Config::default().picture
            },
            diagram: self.diagram()?,
            reading: pipe::options(&self.common)?,
        })
    }

    fn diagram(&self) -> Result<DiagramOptions, Failure> {
        let names = |list: &String| list.split(',').map(str::to_owned).collect();
        let range = |range: &Option<Vec<f64>>| range.as_ref().map(|ends| [ends[0], ends[1]]);
        let points = match self.points.as_ref().map(|list| (&**list, names(list))) {
            None | Some(("all", _)) => PointChoice::All,
            Some(("none", _)) => PointChoice::None,
            Some((_, names)) => PointChoice::Named(names),
        };
        Ok(DiagramOptions {
            lines: self.show.as_ref().map(names),
            frame: self.frame.clone().unwrap_or_default(),
            axis: vector(self.axis.as_deref()).map(DVec3::from_array),
            times: range(&self.times),
            places: range(&self.places),
            events: self.event.clone(),
            intervals: self.interval.as_chunks().0.to_vec(),
            simultaneous: through("--simultaneous", &self.simultaneous)?,
            axes: through("-axes", &self.axes)?,
            cones: self.cone.clone(),
            points,
            ticks: self.ticks.unwrap_or_default(),
            without_cone: self.no_cone,
        })
    }
}

/// Frames, and events that their lines go through.
fn through(option: &str, words: &[String]) -> Result<Vec<(FrameWord, EventWord)>, Failure> {
    let failed = |error: String| Failure::usage(format!("{option}: {error}"));
    let pair = |[frame, event]: &[String; 2]| {
        Ok((frame.parse().map_err(failed)?, event.parse().map_err(failed)?))
    };
    words.as_chunks().0.iter().map(pair).collect()
}

/// Own time between ticks, or `off`.
fn ticks(word: &str) -> Result<TickChoice, String> {
    match word {
        "off" => Ok(TickChoice::Off),
        word => finite(word).map(TickChoice::Every),
    }
}

fn text_size(pixels: f64) -> Result<f64, String> {
    if (4.0..=200.0).contains(&pixels) {
        Ok(pixels)
    } else {
        Err("text is 4 to 200 pixels large".to_owned())
    }
}

/// The whole program between its streams: reads the scene, draws its diagram, writes it.
///
/// # Errors
/// Bad usage, a bad scene, or a stream that fails.
pub fn draw(args: &Args, context: &mut Context) -> Result<(), Failure> {
    let config = args.config(context.output_name())?;
    let output = config.picture.output;
    refuse_terminal(output.format(), context)?;
    if args.table.as_ref().is_some_and(|table| {
        !table.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("csv"))
    }) {
        return Err(Failure::usage("-at writes a table: the name of its file must end with .csv"));
    }
    let source = pipe::read(context, &config.reading)?;
    let command_line = with_format(context.command_line(), output, args.dt.is_some());
    let (command, files) = (Some(&*command_line), &context.take_files_read()[..]);
    let provenance = Provenance { command, files, ..PROVENANCE };
    let steps = context.steps();
    let file = run(&config, &source, provenance, &steps).map_err(Failure::of)?;
    drop(steps);
    file.notes.iter().for_each(|note| context.note(&note.words()));
    if let Some(path) = &args.table {
        context.write_file(path, file.table.as_bytes())?;
    }
    write_picture(&file.picture, config.picture.size, context)
}
