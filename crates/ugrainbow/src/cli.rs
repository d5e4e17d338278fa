//! The command line.

use std::path::Path;

use clap::{ArgAction, Parser};
use ugimage::{Format, Tone};
use uglight::HueScale;
use ugparse::{Source, pipe};
use ugphysics::{Brightness, Hsv};
use ugpipe::{CommonArgs, Failure, Stage, ToolArgs, finite};
use ugraster::Filter;
use ugscene::cli::CameraArgs;

use crate::config::{
    Background, Config, DepthCue, Exact, Exposure, Interpolation, LINE_WIDTH, Output, Wireframe,
};
use crate::explain::{self, explain};
use crate::figures::Figures;
use crate::words::{
    Channels, Kind, Pixel, Report, channels, color, exposure, filter, format_named, kind_named, law,
    line_width, pixel, tone,
};
use crate::{Error, run_with};

/// Where black-and-white PostScript goes if standard output is a terminal, as in 1988.
const POSTSCRIPT_FILE: &str = "POSTSCRIPTFILE";

/// Draw a UniGrafix scene, interpolating hues or wavelengths between corners.
///
/// Reads a scene and writes a picture. At the end of a pipe it shows what moves nearly as
/// fast as light:
///
///   uglorentz -vel .9 0 0 < ship.ug | ugdoppler | ugrainbow > ship.png
///   uglorentz -vel 0 -.2 0 -in -sd 1 < ship.ug | ugrainbow -xc > exact.png
#[derive(Clone, Debug, Parser)]
#[command(name = "ugrainbow", version, before_help = ugpipe::ONE_DASH)]
pub struct Args {
    /// Interpolate hue between corners (default)
    #[arg(long, visible_alias = "interpolate-hue", conflicts_with_all = ["iw", "wi"])]
    ih: bool,

    /// Interpolate wavelength between corners
    #[arg(long, visible_alias = "interpolate-wavelength")]
    iw: bool,

    /// Hues in colour statements are wavelengths in nm; implies -iw
    ///
    /// For scenes written by hand: of what `ugdoppler -gw` writes it is known.
    #[arg(long, visible_alias = "wavelengths")]
    wi: bool,

    /// Write black-and-white PostScript, as in 1988
    ///
    /// To the file POSTSCRIPTFILE if standard output is a terminal and there is no -fo.
    #[arg(long, visible_alias = "grey-postscript", conflicts_with_all = ["dt", "tb"])]
    dp: bool,

    /// Format of the picture [default: by the ending of -fo, else png]
    ///
    /// png, png16 (16 bits), ppm, eps, ps, pdf, svg; and exr, pfm, hdr, which hold linear light, neither clipped nor
    /// brought into the gamut: white is 1, parts may be above it and below 0.
    #[arg(long, value_name = "FMT", visible_alias = "format", value_parser = kind_named)]
    dt: Option<Kind>,

    /// Areas and lines in place of pixels, sharp at any size: for eps, ps, pdf, svg
    ///
    /// A pixel of -sz is a point. Faces are painted from behind, and hidden parts covered; of wires they are
    /// left out. Colours are right to 2 levels of 255.
    #[arg(long, visible_alias = "vector", conflicts_with_all = ["dp", "explain", "xc"])]
    vec: bool,

    #[command(flatten)]
    camera: CameraArgs,

    /// Size of the picture in pixels
    #[arg(long, num_args = 2, value_names = ["W", "H"], action = ArgAction::Set,
          default_values = ["1024", "768"], value_parser = clap::value_parser!(u32).range(1..),
          visible_alias = "size", help_heading = PICTURE)]
    sz: Vec<u32>,

    /// N x N samples per pixel, 1 to 16
    #[arg(long, value_name = "N", default_value = "4", value_parser = clap::value_parser!(u32).range(1..=16),
          visible_alias = "samples", help_heading = PICTURE)]
    aa: u32,

    /// Filter, by which samples weigh in pixels: box, triangle, spline
    ///
    /// box: those of the pixel alike, as of a detector. triangle and spline (a quadratic B-spline) reach into the neighbours: edges and
    /// thin lines are smoother, and softer.
    #[arg(long, value_name = "FILTER", default_value = "box", value_parser = filter, visible_alias = "filter",
          help_heading = PICTURE)]
    fl: Filter,

    /// Background colour: lightness, hue in degrees, saturation [default: black]
    #[arg(long, num_args = 1..=3, value_names = ["L", "H", "S"], action = ArgAction::Set,
          value_parser = finite, visible_alias = "background", help_heading = PICTURE)]
    bg: Option<Vec<f64>>,

    /// Transparent background
    #[arg(long, visible_alias = "transparent", conflicts_with = "bg", help_heading = PICTURE)]
    tb: bool,

    /// Exposure in stops: light is multiplied by 2 to the power E, and clipped only then
    ///
    /// auto: by what shows 99 of 100 pixels that are not black at or below white.
    #[arg(long, value_name = "E|auto", allow_hyphen_values = true, value_parser = exposure,
          visible_alias = "exposure", help_heading = PICTURE)]
    ex: Option<Exposure>,

    /// Tone curve from light to display: clip, filmic
    ///
    /// filmic is Hable's of 2010, whose white is 5.6. Curves work on luminance and keep hue.
    #[arg(long, value_name = "CURVE", default_value = "clip", value_parser = tone,
          visible_alias = "tone-curve", help_heading = PICTURE)]
    tc: Tone,

    /// Small PNG files, which take longer to pack
    ///
    /// The pixels stay the same.
    #[arg(long, visible_alias = "pack", help_heading = PICTURE)]
    pz: bool,

    /// Leave out faces that are seen from behind: those whose corners run clockwise
    ///
    /// Of closed opaque bodies the picture stays the same, and large scenes are drawn faster.
    #[arg(long, visible_alias = "cull-back-faces", conflicts_with = "xc", help_heading = PICTURE)]
    cb: bool,

    /// More channels of an EXR picture, with commas between: D, time, distance, Z, id, velocity
    ///
    /// Doppler factor, emission time, distance of the emission, depth along the view, number of the
    /// face, velocity of the body; all at the middle of the pixel.
    #[arg(long, value_name = "LIST", value_parser = channels, visible_alias = "channels", help_heading = PICTURE)]
    ch: Option<Channels>,

    /// Draw edges of faces as lines, and no faces; they only hide
    ///
    /// Not those where two faces of one colour and velocity meet in one plane: so cuts of uglorentz are not drawn.
    #[arg(long, visible_alias = "wireframe", conflicts_with = "ed", help_heading = LINES)]
    wf: bool,

    /// Draw edges of faces as black lines, over the faces
    #[arg(long, visible_alias = "edges", help_heading = LINES)]
    ed: bool,

    /// Colour of the edges: lightness, hue in degrees, saturation [default: with -wf of the faces, with -ed black]
    #[arg(long, num_args = 1..=3, value_names = ["L", "H", "S"], action = ArgAction::Set,
          value_parser = finite, visible_alias = "line-color", help_heading = LINES)]
    lc: Option<Vec<f64>>,

    /// Width of lines, wires too, in pixels
    #[arg(long, value_name = "W", default_value_t = LINE_WIDTH, value_parser = line_width,
          visible_alias = "line-width", help_heading = LINES)]
    lw: f64,

    /// Depth cueing: light falls linearly from depth NEAR to FAR, to the part LEAST, towards the background
    ///
    /// Depth is along the view. Without numbers it is from the nearest to the farthest that is seen; LEAST is 0.2
    /// unless given, 0 to 1.
    #[arg(long, num_args = 0..=3, value_names = ["NEAR", "FAR", "LEAST"], action = ArgAction::Set,
          value_parser = finite, visible_alias = "depth-cue", help_heading = PICTURE)]
    dc: Option<Vec<f64>>,

    /// Exact: find every sample by a ray into the rest frame of each face, and shift its colour there
    ///
    /// Takes a scene as `uglorentz -sd 1` writes it, and does the work of ugdoppler itself: outline, depth, Doppler
    /// factor, colour and light are exact at every sample, and nothing need be cut into pieces.
    #[arg(long, visible_alias = "exact", conflicts_with_all = ["og", "explain"], help_heading = EXACT)]
    xc: bool,

    /// With -xc, brightness law: report (D), photon (D^3), bolometric (D^4), none [default: report]
    ///
    /// As of ugdoppler. Values above 1 are clipped at the sample, unless -ex or -tc keeps them.
    #[arg(long, visible_alias = "brightness", value_name = "LAW", value_parser = law, requires = "xc",
          conflicts_with = "no_flux", help_heading = EXACT)]
    br: Option<Brightness>,

    /// With -xc, leave wavelengths as they are
    #[arg(long, requires = "xc", help_heading = EXACT)]
    no_doppler: bool,

    /// With -xc, leave brightness as it is
    #[arg(long, requires = "xc", help_heading = EXACT)]
    no_flux: bool,

    /// Instead of the picture, explain the pixel in column X and row Y, from 0 at the upper left
    ///
    /// As text, or with `--format json` as JSON: the face, its motion, when and where its light was sent,
    /// colour and light, and every step to the bytes.
    #[arg(long, value_name = "X,Y", value_parser = pixel, conflicts_with = "dp")]
    explain: Option<Pixel>,

    /// Caption below the picture, in lines as they fit, or as they are
    ///
    /// The scene is drawn in what the strips below it leave of -sz.
    #[arg(long, value_name = "TEXT", visible_alias = "caption", help_heading = FIGURES)]
    cap: Option<String>,

    /// Legend below the picture: the rainbow, velocities, and the Doppler factors that are seen
    ///
    /// Wavelengths in nm, where light of 550 nm is seen, the velocity as a unit arrow seen from the camera (a point at its
    /// tail: it comes, a cross: it goes), and β, γ and D.
    #[arg(long, visible_alias = "legend", help_heading = FIGURES)]
    lg: bool,

    /// Outline of moving bodies as they would look at rest, each with its centre where it is seen
    #[arg(long, visible_alias = "undistorted", help_heading = FIGURES)]
    dl: bool,

    /// Grid of coordinates on the ground: in the plane z = 0, or under what reaches lower
    #[arg(long, visible_alias = "grid", help_heading = FIGURES)]
    gr: bool,

    #[command(flatten)]
    common: CommonArgs,
}

const FIGURES: &str = "Figures";
const PICTURE: &str = "Picture";
const LINES: &str = "Lines";
const EXACT: &str = "Exact pictures";

impl ToolArgs for Args {
    fn common(&self) -> &CommonArgs {
        &self.common
    }
}

impl Args {
    /// What is asked for. `output`: the file to be written, `command_line`: what the picture
    /// says about how it was made.
    ///
    /// # Errors
    /// The ending of the file is that of no format, or the background is no colour.
    pub fn config(&self, output: Option<&Path>, command_line: &str) -> Result<Config, Failure> {
        Ok(Config {
            interpolation: if self.iw { Interpolation::Wavelength } else { Interpolation::Hue },
            hue_scale: if self.wi { HueScale::Wavelengths } else { HueScale::Degrees },
            camera: self.camera.options(),
            size: [self.sz[0], self.sz[1]],
            samples: self.aa,
            filter: self.fl,
            background: self.background()?,
            output: self.output(output)?,
            reading: pipe::options(&self.common)?,
            exposure: self.ex,
            tone: self.tc,
            channels: self.ch.clone().unwrap_or_default().0,
            wireframe: self.wireframe()?,
            line_width: self.lw,
            depth_cue: self.depth_cue()?,
            exact: self.xc.then(|| self.exact()),
            cull: self.cb,
            small: self.pz,
            figures: self.figures(),
            command_line: command_line.to_owned(),
        })
    }

    fn figures(&self) -> Figures {
        Figures {
            caption: self.cap.clone().unwrap_or_default(),
            legend: self.lg,
            outline: self.dl,
            grid: self.gr,
        }
    }

    fn exact(&self) -> Exact {
        let law = if self.no_flux { Brightness::None } else { self.br.unwrap_or_default() };
        Exact { law, doppler: !self.no_doppler }
    }

    fn background(&self) -> Result<Background, Failure> {
        if self.tb {
            return Ok(Background::Transparent);
        }
        let black = [0.0];
        color("background -bg", self.bg.as_deref().unwrap_or(&black)).map(Background::Color)
    }

    fn wireframe(&self) -> Result<Option<Wireframe>, Failure> {
        let given = self.lc.as_deref().map(|numbers| color("lines -lc", numbers)).transpose()?;
        if !self.wf && !self.ed {
            return match given {
                Some(_) => {
                    Err(Failure::Usage("-lc is the colour of edges: add -wf or -ed, or leave it out".into()))
                }
                None => Ok(None),
            };
        }
        let black = || Hsv { hue: 0.0, saturation: 0.0, value: 0.0 };
        let color = if self.ed { Some(given.unwrap_or_else(black)) } else { given };
        Ok(Some(Wireframe { has_faces: self.ed, color }))
    }

    fn depth_cue(&self) -> Result<Option<DepthCue>, Failure> {
        let Some(numbers) = &self.dc else { return Ok(None) };
        let (range, least) = match numbers[..] {
            [] => (None, DepthCue::LEAST),
            [near, far] => (Some([near, far]), DepthCue::LEAST),
            [near, far, least] => (Some([near, far]), least),
            _ => {
                return Err(Failure::Usage(
                    "depth cueing -dc takes no numbers, two depths, or two depths and a part".into(),
                ));
            }
        };
        if range.is_some_and(|[near, far]| near >= far) || !(0.0..=1.0).contains(&least) {
            return Err(Failure::Usage(
                "depth cueing -dc is from a depth to a greater one, and what is left there is from 0 to 1"
                    .into(),
            ));
        }
        Ok(Some(DepthCue { range, least }))
    }

    fn output(&self, file: Option<&Path>) -> Result<Output, Failure> {
        match self.pixels(file)? {
            Output::Color(format) if self.vec => Ok(Output::Vector(format)),
            output => Ok(output),
        }
    }

    /// The output if it has pixels.
    fn pixels(&self, file: Option<&Path>) -> Result<Output, Failure> {
        if self.dp {
            return Ok(Output::Grey);
        }
        if self.explain.is_some() {
            return Ok(Output::Color(Format::Png));
        }
        match (self.dt, ending(file)) {
            (Some(Kind::Picture(format)), _) => Ok(Output::Color(format)),
            (Some(Kind::Report(_)), _) => Err(Failure::Usage(
                "`text` and `json` explain a pixel: add --explain X,Y, or name a format of pictures".into(),
            )),
            (None, None) => Ok(Output::Color(Format::Png)),
            (None, Some(ending)) => format_named(&ending)
                .map(Output::Color)
                .map_err(|error| Failure::Usage(format!("`.{ending}` is {error}; name one with -dt"))),
        }
    }

    /// How a pixel is to be explained.
    fn report(&self, file: Option<&Path>) -> Result<Report, Failure> {
        match self.dt {
            Some(Kind::Report(report)) => Ok(report),
            Some(Kind::Picture(_)) => Err(Failure::Usage(
                "a pixel is explained as text or json: give --format json, or none".into(),
            )),
            None if ending(file).is_some_and(|ending| ending.eq_ignore_ascii_case("json")) => {
                Ok(Report::Json)
            }
            None => Ok(Report::Text),
        }
    }
}

fn ending(file: Option<&Path>) -> Option<String> {
    file.and_then(Path::extension).map(|ending| ending.to_string_lossy().into_owned())
}

/// The whole program between its streams: reads the scene, draws it, writes the picture.
///
/// # Errors
/// Bad usage, a bad scene, or a stream that fails.
pub fn draw(args: &Args, stage: &mut Stage) -> Result<(), Failure> {
    let config = args.config(stage.output_name(), stage.command_line())?;
    let report = match args.explain {
        Some(pixel) => Some((pixel, args.report(stage.output_name())?)),
        None => None,
    };
    if report.is_none() && stage.output_is_terminal() {
        redirect(config.output, stage)?;
    }
    let input = stage.input()?;
    stage.detail(&format!("read {} bytes of `{}`", input.text.len(), input.name));
    let source =
        pipe::follow(Source::new(input.name, input.text), &config.reading, stage).map_err(pipe::refused)?;
    if let Some((pixel, report)) = report {
        return explain_pixel(&config, &source, pixel, report, stage);
    }
    let picture = run_with(&config, &source, &stage.steps()).map_err(failure)?;
    if !picture.warnings.is_empty() {
        stage.report(&picture.warnings.render(true));
    }
    picture.notes.iter().for_each(|note| stage.note(note));
    stage.detail(&format!("drew {} x {} pixels", config.size[0], config.size[1]));
    stage.write(&picture.bytes)
}

fn explain_pixel(
    config: &Config,
    source: &Source,
    pixel: Pixel,
    report: Report,
    stage: &mut Stage,
) -> Result<(), Failure> {
    let (explanation, warnings) = explain(config, source, pixel).map_err(failure)?;
    if !warnings.is_empty() {
        stage.report(&warnings.render(true));
    }
    let text = match report {
        Report::Text => explain::text(&explanation),
        Report::Json => explain::json(&explanation),
    };
    stage.write(text.as_bytes())
}

fn failure(error: Error) -> Failure {
    match error {
        Error::Scene(diagnostics) => Failure::Report(diagnostics.render(true)),
        error if error.is_usage() => Failure::usage(error),
        error => Failure::failed(error),
    }
}

/// Keeps a terminal free of what it cannot show.
fn redirect(output: Output, stage: &mut Stage) -> Result<(), Failure> {
    match output {
        Output::Color(format) | Output::Vector(format) if format.is_binary() => Err(Failure::Usage(
            "a picture is not written to a terminal; send it to a file with `> FILE` or -fo FILE".into(),
        )),
        Output::Color(_) | Output::Vector(_) => Ok(()),
        Output::Grey => {
            stage.set_output_name(POSTSCRIPT_FILE);
            stage.note(&format!("the picture goes to the file {POSTSCRIPT_FILE}"));
            Ok(())
        }
    }
}
