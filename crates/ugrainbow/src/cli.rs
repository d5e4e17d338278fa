//! The command line.

mod words;

use std::path::Path;

use clap::{Arg, ArgAction, ArgMatches, Parser};
use ugimage::Format;
use uglight::Interpolation;
use ugparse::pipe;
use ugphysics::Hsv;
use ugpicture::cli::{
    AnnotationArgs, Kind, PICTURE, PictureArgs, Pixel, color, color_shift, kinds, picture_format,
    pixel, refuse_terminal, with_format, write_explanation, write_picture,
};
use ugpicture::{Output, PictureOptions, TextForm};
use ugpipe::{
    CommonArgs, Context, Failure, Look, LookArgs, Looks, ToolArgs, finite, is_given, number, one_of,
};
use ugscene::cli::{RepeatArgs, ShiftArgs};
use ugscene::{HueScale, Provenance};
use ugskybox::cli::SkyArgs;

use crate::config::{Config, DepthCue, EdgeKind, HiddenLines, LINE_WIDTH, Wireframe};
use crate::explain::explain;
use crate::{PROVENANCE, run_with};

/// Greatest width of lines in pixels.
const MAX_LINE_WIDTH: f64 = 100.0;

/// Draws a UniGrafix scene
///
/// Reads a scene and writes a picture. At the end of a pipe it shows what moves nearly as fast as
/// light. Between the corners of faces it interpolates hues or wavelengths. A scene without a
/// camera is seen from far enough away that all of it is in the picture.
#[derive(Clone, Debug, Parser)]
#[command(name = "ugrainbow", version, after_help = EXAMPLES)]
#[command(mut_args(with_exact))]
pub struct Args {
    /// Interpolate hue between corners (default)
    #[arg(long, visible_alias = "interpolate-hue", conflicts_with_all = ["iw", "wi", "sp"])]
    ih: bool,

    /// Interpolate wavelength between corners
    #[arg(long, visible_alias = "interpolate-wavelength", conflicts_with = "sp")]
    iw: bool,

    /// Hues in colour statements are wavelengths in nm; implies -iw
    ///
    /// Only scenes written by hand need it: the output of `ugdoppler -gw` is recognized.
    #[arg(long, visible_alias = "wavelengths", conflicts_with = "sp")]
    wi: bool,

    /// Format of the picture [default: by the ending of -fo, else png]
    ///
    /// png16 has 16 bits per component. exr, pfm and hdr hold linear light, neither clipped nor
    /// gamut-mapped: white is 1, and components may exceed 1 or be negative. text and json are for
    /// --explain.
    #[arg(long, value_name = "FMT", visible_alias = "format", value_parser = one_of("formats", kinds()))]
    dt: Option<Kind>,

    /// Write PostScript to the file POSTSCRIPTFILE, or to that of -fo, as in 1988
    ///
    /// Like -dt ps -fo POSTSCRIPTFILE. The file has colours; that of 1988 was black and white.
    #[arg(long, conflicts_with_all = ["dt", "explain"])]
    dp: bool,

    /// Vector graphics instead of pixels, for eps, ps, pdf, svg
    ///
    /// They are sharp at any size. -sz is then the size in points. Faces are painted back to front,
    /// so nearer ones cover those behind; lines are drawn without their hidden parts. Colours
    /// deviate by at most 2 levels of 255.
    #[arg(long, visible_alias = "vector", conflicts_with_all = ["explain", "xc"])]
    vec: bool,

    /// Text of captions, legends and grids as text in vector graphics, instead of outlines
    ///
    /// It can be searched, copied, and changed in an editor. The font, DejaVu Sans, is embedded in
    /// the file; editors of SVG need it installed.
    #[arg(long, visible_alias = "text", requires = "vec", conflicts_with = "xc")]
    txt: bool,

    #[command(flatten)]
    picture: PictureArgs,

    /// Cull back faces, whose corners run clockwise in the picture
    ///
    /// Closed opaque bodies look the same without them, and large scenes are drawn faster.
    #[arg(long, visible_alias = "cull-back-faces", conflicts_with = "xc", help_heading = PICTURE)]
    cb: bool,

    #[command(flatten)]
    repeat: RepeatArgs,

    /// Wireframe: draw edges of faces as lines, instead of faces; faces still occlude them
    ///
    /// An edge between two coplanar faces of the same colour and velocity is not drawn. So the cuts
    /// made by uglorentz are invisible.
    #[arg(long, visible_alias = "wireframe", conflicts_with = "ed", help_heading = LINES)]
    wf: bool,

    /// Draw edges of faces as black lines, over the faces
    #[arg(long, visible_alias = "edges", help_heading = LINES)]
    ed: bool,

    /// Silhouette: of edges only those where a body turns away from the eye, and those of a single
    /// face
    ///
    /// Like -wf, or with -ed over the faces. Which side of a face is seen is decided in its rest
    /// frame, so pieces made by uglorentz add no lines.
    #[arg(long, visible_alias = "silhouette", help_heading = LINES)]
    sil: bool,

    /// Of edges only the silhouette and creases of at least ANGLE degrees, 0 to 180
    ///
    /// Like -wf, or with -ed over the faces. An angle of 20 leaves out the edges of polygons in
    /// place of curved surfaces. Edges between different colours are drawn.
    #[arg(long, value_name = "ANGLE", value_parser = number(crease), help_heading = LINES)]
    crease: Option<f64>,

    /// Lines that are hidden by faces: dash, thin [default: not drawn]
    ///
    /// Like -wf; both have 0.6 of the width of visible lines.
    #[arg(long, value_name = "STYLE", visible_alias = "hidden-lines", conflicts_with = "ed",
          value_parser = one_of("styles", [("dash", HiddenLines::Dashed), ("thin", HiddenLines::Thin)]),
          help_heading = LINES)]
    hl: Option<HiddenLines>,

    /// Colour of the edges, as for -bg [default: colours of the faces with -wf, black with -ed]
    #[arg(long, num_args = 1..=3, value_names = ["L", "H", "S"], action = ArgAction::Set,
          visible_alias = "line-color", help_heading = LINES)]
    lc: Option<Vec<String>>,

    /// Width of edges and wires in pixels
    #[arg(long, value_name = "W", default_value_t = LINE_WIDTH, value_parser = number(line_width),
          visible_alias = "line-width", help_heading = LINES)]
    lw: f64,

    /// Depth cueing: between the depths NEAR and FAR, light fades linearly into the background, to
    /// the fraction LEAST
    ///
    /// Depth is measured along the view direction. NEAR and FAR are by default the least and the
    /// greatest depth that is seen. LEAST is from 0 to 1, by default 0.2.
    #[arg(long, num_args = 0..=3, value_names = ["NEAR", "FAR", "LEAST"], action = ArgAction::Set,
          value_parser = finite, visible_alias = "depth-cue", help_heading = PICTURE)]
    dc: Option<Vec<f64>>,

    /// Exact: a ray for every sample, instead of subdivision
    ///
    /// Each ray is intersected with the faces in their rest frames, and the colour is shifted
    /// there. Reads what `uglorentz -sd 1` writes, and does the work of ugdoppler itself. Outline,
    /// depth, Doppler factor, colour and light are exact at every sample, so faces need no
    /// subdivision. Scenes with textures (c_tex) are drawn so without it, too, with colours as they
    /// are, unless they went through ugdoppler, or -og, -cb or -vec is given.
    #[arg(long, visible_alias = "exact", conflicts_with_all = ["og", "explain"], help_heading = EXACT)]
    xc: bool,

    #[command(flatten, next_help_heading = EXACT)]
    shift: ShiftArgs,

    /// Instead of a picture, print how the colour of the pixel in column X and row Y (from 0 at the
    /// upper left) comes about
    ///
    /// As text, or with `--format json` as JSON: the face, its motion, when and where its light was
    /// emitted, colour and light, and every step to the bytes of the pixel.
    #[arg(long, value_name = "X,Y", value_parser = pixel)]
    explain: Option<Pixel>,

    #[command(flatten)]
    sky: SkyArgs,

    #[command(flatten)]
    annotations: AnnotationArgs,

    #[command(flatten)]
    look: LookArgs,

    #[command(flatten)]
    common: CommonArgs,
}

const EXAMPLES: &str = "Examples:
  ugrainbow ship.ug > rest.png
  uglorentz -vel .3 0 0 -in ship.ug | ugdoppler | ugrainbow -sz 800 600 > ship.png
  uglorentz -vel 0 -.5 0 -in ship.ug | ugdoppler -sp | ugrainbow -ex auto -lg > blue.png
  uglorentz -vel .9 0 0 -in ship.ug | ugrainbow -vec -cap 'A ship at 0.9c' -fo figure.pdf
  uglorentz -vel .9 0 0 -in teapot.ug | ugrainbow -crease 40 -hl dash -lc black -bg white > lines.png
  uglorentz -vel 0 -.2 0 -in -sd 1 ship.ug | ugrainbow -xc > exact.png";

const LINES: &str = "Lines";
const EXACT: &str = "Exact pictures (-xc)";

fn is_exact(matches: &ArgMatches) -> bool {
    is_given(matches, "xc")
}

/// The options of [`ShiftArgs`] need `-xc`. clap does not require it beside `-vec`, which excludes
/// it.
fn with_exact(arg: Arg) -> Arg {
    match arg.get_id().as_str() {
        "br" | "sp" | "no_doppler" | "no_flux" => arg.requires("xc").conflicts_with("vec"),
        "aa" => arg.conflicts_with("vec"),
        _ => arg,
    }
}

impl ToolArgs for Args {
    const ESSENTIAL: &'static [&'static str] =
        &["-sz", "-ep", "-vc", "-va", "-look", "-ex", "-bg", "-aa", "-lg", "-vec", "-xc", "-fo"];

    const LOOKS: Looks = Looks {
        default: Look::Report,
        light: &[
            RepeatArgs::APART.with(is_exact),
            PictureArgs::AUTO_EXPOSURE,
            PictureArgs::FILMIC,
            ShiftArgs::SPECTRA.with(is_exact),
        ],
        shape: &[
            RepeatArgs::APART.with(is_exact),
            ShiftArgs::REST_WAVELENGTHS.with(is_exact),
            ShiftArgs::REST_BRIGHTNESS.with(is_exact),
        ],
    };

    fn common(&self) -> &CommonArgs {
        &self.common
    }

    fn default_output(&self) -> Option<&Path> {
        self.dp.then_some(Path::new("POSTSCRIPTFILE"))
    }
}

impl Args {
    /// The command line to be recorded, which states the format of the picture.
    pub fn recorded(&self, command_line: &str, config: &Config) -> String {
        with_format(command_line, config.picture.output, self.dt.is_some())
    }

    /// The configuration of the options. `output`: the file whose ending is the format unless an
    /// option gives it.
    ///
    /// # Errors
    /// [`Failure::Usage`]: options that exclude each other, or a value out of range.
    pub fn config(&self, output: Option<&Path>) -> Result<Config, Failure> {
        Ok(Config {
            picture: PictureOptions {
                text: if self.txt { TextForm::Text } else { TextForm::Outlines },
                ..self.picture.options(self.output(output)?, self.annotations.options()?)?
            },
            interpolation: if self.iw { Interpolation::Wavelength } else { Interpolation::Hue },
            hue_scale: if self.wi { HueScale::Wavelengths } else { HueScale::Degrees },
            reading: pipe::options(&self.common)?,
            wireframe: self.wireframe()?,
            line_width: self.lw,
            depth_cue: self.depth_cue()?,
            exact: self.xc.then(|| color_shift(&self.shift)),
            cull: self.cb,
            sky: self.sky.sky(),
            repeat: self.repeat.repeats(),
        })
    }

    fn wireframe(&self) -> Result<Option<Wireframe>, Failure> {
        let given = self.lc.as_deref().map(|words| color("lines -lc", words)).transpose()?;
        if !(self.wf || self.ed || self.sil || self.crease.is_some() || self.hl.is_some()) {
            return match given {
                Some(_) => Err(Failure::Usage(
                    "-lc is the colour of edges: add -wf or -ed, or leave it out".into(),
                )),
                None => Ok(None),
            };
        }
        let black = || Hsv { hue: 0.0, saturation: 0.0, value: 0.0 };
        let color = if self.ed { Some(given.unwrap_or_else(black)) } else { given };
        let edges = match self.crease {
            Some(degrees) => EdgeKind::Creases { angle: degrees.to_radians() },
            None if self.sil => EdgeKind::Silhouette,
            None => EdgeKind::All,
        };
        Ok(Some(Wireframe {
            has_faces: self.ed,
            color,
            edges,
            hidden: self.hl.unwrap_or_default(),
        }))
    }

    fn depth_cue(&self) -> Result<Option<DepthCue>, Failure> {
        let Some(numbers) = &self.dc else { return Ok(None) };
        let (range, least) = match numbers[..] {
            [] => (None, DepthCue::LEAST),
            [near, far] => (Some([near, far]), DepthCue::LEAST),
            [near, far, least] => (Some([near, far]), least),
            _ => {
                return Err(Failure::Usage(
                    "depth cueing -dc is followed by nothing, by NEAR FAR, or by NEAR FAR LEAST"
                        .into(),
                ));
            }
        };
        if range.is_some_and(|[near, far]| near >= far) || !(0.0..=1.0).contains(&least) {
            return Err(Failure::Usage(
                "in -dc NEAR FAR LEAST, FAR must be greater than NEAR, and LEAST must be from 0 to 1".into(),
            ));
        }
        Ok(Some(DepthCue { range, least }))
    }

    fn output(&self, file: Option<&Path>) -> Result<Output, Failure> {
        let given = if self.dp { Some(Kind::Picture(Format::Ps)) } else { self.dt };
        let format = picture_format(given, file, self.explain.is_some())?;
        Ok(if self.vec { Output::Vector(format) } else { Output::Color(format) })
    }
}

/// The whole program between its streams: reads the scene, draws it, writes the picture.
///
/// # Errors
/// Bad usage, a bad scene, or a stream that fails.
pub fn draw(args: &Args, context: &mut Context) -> Result<(), Failure> {
    let mut config = args.config(context.output_name())?;
    if let Some(pixel) = args.explain {
        let explain = |source: &_| explain(&config, source, pixel).map_err(Failure::of);
        return write_explanation(args.dt, &config.reading, context, explain);
    }
    refuse_terminal(config.picture.output.format(), context)?;
    let input = pipe::downstream(pipe::input(context, &config.reading)?, context);
    context.detail(&format!("read {} bytes of `{}`", input.text.len(), input.name));
    let source = pipe::follow(input, &config.reading, context).map_err(pipe::refused)?;
    config.sky.open_with((&source, &config.reading), &args.common, context)?;
    let command_line = args.recorded(context.command_line(), &config);
    let (command, files) = (Some(&*command_line), &context.take_files_read()[..]);
    let provenance = Provenance { command, files, ..PROVENANCE };
    let picture = run_with(&config, &source, provenance, &context.steps()).map_err(Failure::of)?;
    write_picture(&picture, config.picture.size, context)
}

/// Width of lines in pixels.
fn line_width(width: f64) -> Result<f64, String> {
    if 0.0 < width && width <= MAX_LINE_WIDTH {
        Ok(width)
    } else {
        Err(format!("a line is more than 0 and at most {MAX_LINE_WIDTH} pixels wide"))
    }
}

/// An angle between two faces, in degrees.
fn crease(angle: f64) -> Result<f64, String> {
    if (0.0..=180.0).contains(&angle) {
        Ok(angle)
    } else {
        Err("a crease is from 0 to 180 degrees".to_owned())
    }
}
