//! The command line.

mod words;

use std::ops::Range;
use std::path::{Path, PathBuf};

use clap::{ArgAction, Parser};
use glam::DVec3;
use ugimage::{Filter, Format, PictureLimits};
use uglight::ColorShift;
use ugmeshfile::foreign_data;
use ugparse::{Source, pipe};
use ugphysics::Velocity;
use ugpicture::cli::{
    AnnotationArgs, LensArgs, PICTURE, PictureArgs, format_for, refuse_terminal, with_format,
    write_picture,
};
use ugpicture::{Output, PictureOptions};
use ugpipe::{
    CommonArgs, Context, Failure, Input, Look, LookArgs, Looks, ToolArgs, Words, finite, number,
    one_of, remedies, vector,
};
use ugscene::cli::ShiftArgs;
use ugscene::{Provenance, Scene};
use ugsky::{Arrangement, Band, Basis, Extent, StarOptions, VISIBLE_NM};
use ugskybox::{OpenError, Opened, StarList, is_star_list, open, open_spectrum, read_stars};
use ugtrace::lens::Lens;

use crate::config::Config;
use crate::error::Error;
use crate::needs::needs;
use crate::render::{PROVENANCE, metadata, run};

/// Shows a 360-degree panorama as a fast traveller sees it
///
/// Reads an equirectangular panorama or a cube map (PNG, JPEG, HDR, EXR or PFM) or a list of stars
/// (CSV) and writes a picture: a perspective view, a panorama, a fisheye or a cube map. In the
/// panorama y is ahead, in its middle, x is to the right and z up.
#[derive(Clone, Debug, Parser)]
#[command(name = "ugwarp", version, after_help = EXAMPLES)]
#[command(mut_arg("aa", |arg| arg.default_value("1")))]
pub struct Args {
    /// Velocity of the surroundings, fraction of c
    ///
    /// As in the other programs the velocity of what is seen, in the frame of the camera.
    #[arg(long = "vel", visible_alias = "velocity", value_names = ["X", "Y", "Z"], num_args = 3,
          action = ArgAction::Set, allow_hyphen_values = true, value_parser = finite, conflicts_with = "cv")]
    velocity: Option<Vec<f64>>,

    /// Velocity of the camera in the panorama, fraction of c
    #[arg(long, visible_alias = "camera-velocity", value_names = ["X", "Y", "Z"], num_args = 3,
          action = ArgAction::Set, allow_hyphen_values = true, value_parser = finite)]
    cv: Option<Vec<f64>>,

    /// Scene whose camera takes the picture
    ///
    /// Where the camera looks, its view angle, its velocity and its motion are those of the scene,
    /// at the time -ti. The scene is in the axes of the panorama, which is infinitely far away.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["velocity", "cv"], help_heading = CAMERA)]
    scene: Option<PathBuf>,

    /// Time of the picture on the clock of the camera of --scene [default: 0]
    #[arg(long, visible_alias = "time", value_name = "T", requires = "scene", allow_hyphen_values = true,
          value_parser = finite, help_heading = CAMERA)]
    ti: Option<f64>,

    /// Arrangement of directions: panorama, strip, cross, sides [default: panorama]
    ///
    /// panorama: longitude across, latitude down. The others are cube maps: six squares from left
    /// to right, as -cube draws them; four squares across and three down, or three and four; six
    /// files in the order right, left, up, down, front, back.
    #[arg(long, value_name = "KIND", value_parser = one_of("arrangements", Arrangement::ALL.map(|kind| (kind.name(), kind))),
          conflicts_with = "part")]
    from: Option<Arrangement>,

    /// Angles that the panorama shows, in degrees [default: -180 180 -90 90]
    ///
    /// Longitudes of its left and right edge, 0 ahead and 90 to the right, and latitudes of its
    /// lower and upper edge. Where it shows nothing there is background.
    #[arg(long, num_args = 4, value_names = ["WEST", "EAST", "SOUTH", "NORTH"], action = ArgAction::Set,
          allow_hyphen_values = true, value_parser = finite)]
    part: Option<Vec<f64>>,

    /// Print which part of the panorama the picture needs, and draw nothing
    ///
    /// The angles and pixels that it reads at its speed, how many pixels of the panorama one of the
    /// picture is wide, and how large a whole panorama has one for each.
    #[arg(long)]
    needs: bool,

    #[command(flatten, next_help_heading = COLOR)]
    shift: ShiftArgs,

    /// Spectra of colours: mixture, or three temperatures [default: mixture]
    ///
    /// A picture has three numbers per colour and no infrared or ultraviolet light, so its spectra
    /// are an assumption. mixture: daylight on mixtures of white and pure colours, for photographs.
    /// Three temperatures in kelvins, such as 3500 5900 10000: sums of black bodies. Implies -sp.
    #[arg(long, num_args = 1..=33, value_names = ["BASIS", "T2", "T3"], action = ArgAction::Set,
          conflicts_with = "br", help_heading = COLOR)]
    basis: Option<Vec<String>>,

    /// How much brighter than white clipped highlights of a photograph are, in stops
    ///
    /// A photograph has no number for light brighter than white, so the sun is as bright as paper
    /// in it. With -highlights 6 pixels whose three channels are clipped are 64 times as bright as
    /// white, and stay white in pictures of motion. Has no effect on HDR, EXR and PFM.
    #[arg(long, value_name = "STOPS", allow_hyphen_values = true, value_parser = number(stops),
          help_heading = COLOR)]
    highlights: Option<f64>,

    /// Panorama of infrared light
    ///
    /// A grey picture with the same arrangement of directions. Its light has the spectrum of
    /// daylight from 830 nm to --infrared-to at rest, and 1 is a white surface; the panorama itself
    /// has none there. Without it, --basis says what infrared light there is. Implies -sp.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["br", "no_doppler"], help_heading = COLOR)]
    infrared: Option<PathBuf>,

    /// Longest wavelength of the infrared panorama, nm [default: 1400]
    #[arg(long, value_name = "NM", requires = "infrared", value_parser = number(infrared_end), help_heading = COLOR)]
    infrared_to: Option<f64>,

    /// Panorama of ultraviolet light
    ///
    /// As --infrared, from --ultraviolet-from to 360 nm.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["br", "no_doppler"], help_heading = COLOR)]
    ultraviolet: Option<PathBuf>,

    /// Shortest wavelength of the ultraviolet panorama, nm [default: 200]
    #[arg(long, value_name = "NM", requires = "ultraviolet", value_parser = number(ultraviolet_end), help_heading = COLOR)]
    ultraviolet_from: Option<f64>,

    /// Draw the stars of a list in front of the panorama
    ///
    /// A list is CSV text whose first line names its columns: ra,dec,mag,kelvin. Without a
    /// panorama, give the list in its place.
    #[arg(long, value_name = "LIST", conflicts_with = "br", help_heading = STARS)]
    stars: Option<PathBuf>,

    /// Width of stars at half of their maximum, in pixels [default: 1.7]
    ///
    /// A star is a Gaussian profile on the sphere.
    #[arg(long, value_name = "PIXELS", allow_hyphen_values = true, value_parser = finite, help_heading = STARS)]
    star_width: Option<f64>,

    /// Magnitude of stars of which one per square degree is white [default: -2]
    ///
    /// It relates stars to the light of a panorama, in which white is 1.
    #[arg(long, value_name = "MAG", allow_hyphen_values = true, value_parser = finite, help_heading = STARS)]
    white: Option<f64>,

    #[command(flatten, next_help_heading = PICTURE)]
    lens: LensArgs,

    /// Format of the picture [default: by the ending of -fo, else png]
    ///
    /// png16 has 16 bits per component. exr, pfm and hdr hold linear light, neither clipped nor
    /// gamut-mapped: white is 1, and components may exceed 1 or be negative.
    #[arg(long, value_name = "FMT", visible_alias = "format",
          value_parser = one_of("formats", Format::ALL.map(|format| (format.name(), format))), help_heading = PICTURE)]
    dt: Option<Format>,

    #[command(flatten)]
    picture: PictureArgs,

    #[command(flatten)]
    annotations: AnnotationArgs,

    #[command(flatten)]
    look: LookArgs,

    #[command(flatten)]
    common: CommonArgs,

    /// More files to read: the other sides of a cube
    #[arg(value_name = "FILE")]
    files: Vec<PathBuf>,
}

/// Usual wavelengths of pictures of infrared and ultraviolet light, nm.
const INFRARED_TO: f64 = 1400.0;
const ULTRAVIOLET_FROM: f64 = 200.0;

const CAMERA: &str = "Camera";
const COLOR: &str = "Colour";
const STARS: &str = "Stars";

const EXAMPLES: &str = "Examples:
  ugwarp -cv 0 .9 0 -va 90 sky.png > view.png
  ugwarp -cv 0 .5 0 -sp -ex auto -pan -sz 2048 1024 sky.png > moving.png
  ugwarp -vel 0 -.9 0 --basis 3500 5900 10000 -fish 180 -sz 900 900 sky.png > dome.png
  ugwarp -cv 0 .5 0 -dt exr -ch D,direction sky.png > light.exr
  ugwarp -cv 0 .9 0 -fish 180 -sz 900 900 stars.csv > stars.png";

impl ToolArgs for Args {
    const ESSENTIAL: &'static [&'static str] =
        &["-vel", "-cv", "-part", "-look", "-vc", "-va", "-pan", "-fish", "-sz", "-ex", "-fo"];

    const LOOKS: Looks = Looks {
        default: Look::Light,
        light: &[ShiftArgs::SPECTRA, PictureArgs::AUTO_EXPOSURE, PictureArgs::FILMIC],
        shape: &[ShiftArgs::REST_WAVELENGTHS, ShiftArgs::REST_BRIGHTNESS],
    };

    fn common(&self) -> &CommonArgs {
        &self.common
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
        let mut picture = self.picture_options(output)?;
        if self.scene.is_some() {
            // It chose the camera when the scene was read.
            picture.camera.name = None;
        } else if picture.camera.eye.is_some() && picture.camera.center.is_none() {
            return Err(Failure::usage(
                "a sky is infinitely far away from any eye, and -ep is where -vc is seen from: add -vc, or leave \
                 out -ep",
            ));
        }
        let lens = self.lens.lens();
        let is_full = self.part.is_none() && !matches!(lens, Lens::Fisheye { .. });
        if is_full && picture.background != PictureOptions::default().background {
            return Err(Failure::usage(
                "the sky is everywhere in the picture, so it has no background: leave out -bg and -tb",
            ));
        }
        Ok(Config {
            velocity: self.velocity()?,
            time: self.ti.unwrap_or(0.0),
            shift: self.color_shift(),
            basis: self.basis.as_deref().map_or(Ok(Basis::Mixture), basis)?,
            picture,
            lens,
            stars: StarOptions {
                width: self.star_width.unwrap_or(StarOptions::default().width),
                white: self.white.unwrap_or(StarOptions::default().white),
            },
            ..Config::default()
        })
    }

    fn picture_options(&self, output: Option<&Path>) -> Result<PictureOptions, Failure> {
        let output = Output::Color(format_for(self.dt, output)?);
        self.picture.options(output, self.annotations.options()?)
    }

    /// The velocity of the camera.
    fn velocity(&self) -> Result<Velocity, Failure> {
        let beta = |numbers: &Option<Vec<f64>>| {
            let beta = vector(numbers.as_deref()).map(DVec3::from_array).unwrap_or_default();
            Velocity::from_beta(beta).map_err(|error| Failure::Usage(error.to_string()))
        };
        if self.cv.is_some() { beta(&self.cv) } else { Ok(-beta(&self.velocity)?) }
    }

    fn color_shift(&self) -> ColorShift {
        let ShiftArgs { br, sp, no_doppler, no_flux, .. } = self.shift;
        let is_spectral = sp || self.basis.is_some() || self.bands().next().is_some();
        ColorShift::new(is_spectral, !no_doppler, !no_flux, br)
    }

    /// Reads the panorama, or the stars, of the input and of the other files that options name.
    ///
    /// # Errors
    /// A file that cannot be read, is no panorama or no list of stars, or options that do not suit
    /// it.
    pub fn open(&self, input: &Input, context: &Context) -> Result<Opened, Failure> {
        let mut opened = self.open_input(input, context)?;
        self.open_others(&mut opened, context)?;
        Ok(opened)
    }

    /// The part of [`Args::open`] that reads the input and what belongs to it: other sides of a
    /// cube, infrared and ultraviolet light.
    ///
    /// # Errors
    /// See [`Args::open`].
    pub fn open_input(&self, input: &Input, context: &Context) -> Result<Opened, Failure> {
        let is_list = is_star_list(&input.name, &input.text);
        if !is_list && self.stars.is_none() && (self.star_width.is_some() || self.white.is_some()) {
            return Err(Failure::usage(
                "there are no stars: leave out --star-width and --white, or give --stars LIST",
            ));
        }
        if !is_list {
            return self.open_panorama(input, context);
        }
        self.refuse_for_stars()?;
        let StarList { stars, notes } = stars(input)?;
        Ok(Opened { stars, notes, ..Opened::default() })
    }

    /// The files that [`Args::open_input`] reads beside the input, in this order.
    pub fn files_of_input(&self) -> impl Iterator<Item = &Path> {
        let bands = self.bands().map(|(path, _)| path);
        self.files.iter().chain(bands).map(PathBuf::as_path)
    }

    /// The part of [`Args::open`] that reads the list of stars before a panorama and the scene of
    /// the camera.
    ///
    /// # Errors
    /// See [`Args::open`].
    pub fn open_others(&self, opened: &mut Opened, context: &Context) -> Result<(), Failure> {
        if let Some(path) = &self.stars {
            let input = context.input_file(path)?;
            let StarList { stars, notes } = stars(&input)?;
            opened.stars.extend(stars);
            opened.notes.extend(notes);
        }
        if let Some(path) = &self.scene {
            opened.scene = Some(Box::new(self.scene(path, context)?));
        }
        Ok(())
    }

    /// Reads the scene that the camera is taken from.
    fn scene(&self, path: &Path, context: &Context) -> Result<Scene, Failure> {
        let options = pipe::options(&self.common)?;
        let Input { name, text } = context.input_file(path)?;
        let source =
            pipe::follow(Source::new(name, text), &options, context).map_err(pipe::refused)?;
        let camera = self.picture_options(None)?.camera.name;
        let parsed = ugparse::read(&source, &options, camera.as_deref()).map_err(pipe::refused)?;
        if !parsed.warnings.is_empty() {
            context.report(&parsed.warnings.report());
        }
        Ok(parsed.scene)
    }

    /// Refuses options of panoramas, if a list of stars is read instead.
    fn refuse_for_stars(&self) -> Result<(), Failure> {
        let refused = |text: &str| Err(Failure::usage(text));
        if !self.files.is_empty() {
            return refused(
                "the first file is a list of stars: name the panorama first, and add stars with --stars FILE",
            );
        }
        if self.from.is_some() || self.part.is_some() || self.highlights.is_some() {
            return refused(
                "the input is a list of stars: leave out -from, -part and --highlights",
            );
        }
        let PictureOptions { samples, filter, .. } = self.picture_options(None)?;
        if samples > 1 || filter != Filter::default() {
            return refused(
                "the input is a list of stars, whose light is spread by --star-width: leave out -aa and -fl",
            );
        }
        if self.shift.br.is_some() || self.basis.is_some() || self.bands().next().is_some() {
            return refused(
                "the input is a list of stars, which are black bodies: leave out -br, --basis, --infrared and \
                 --ultraviolet",
            );
        }
        Ok(())
    }

    fn open_panorama(&self, input: &Input, context: &Context) -> Result<Opened, Failure> {
        let others: Vec<Input> =
            self.files.iter().map(|path| context.input_file(path)).collect::<Result<_, _>>()?;
        let inputs: Vec<&Input> = std::iter::once(input).chain(&others).collect();
        let files: Vec<&[u8]> = inputs.iter().map(|input| input.text.as_slice()).collect();
        context
            .detail(&format!("read {} bytes", files.iter().map(|file| file.len()).sum::<usize>()));
        let arrangement = self.from.unwrap_or_default();
        let mut limits = PictureLimits::default();
        limits.bytes = self.common.memory_limit().unwrap_or(limits.bytes);
        let mut opened = open(&files, Some(arrangement), self.extent(), self.highlights(), limits)
            .map_err(|error| match error {
                OpenError::Read { idx, error } => {
                    let Input { name, text } = inputs[idx];
                    let remedy = match foreign_data(name, text) {
                        None => format!("; {}", remedies::DRAW_SCENE),
                        Some(_) => CommonArgs::memory_remedy(error.needed_memory()),
                    };
                    Failure::Failed(format!("`{name}`: {error}{remedy}"))
                }
                error => Failure::of(Error::from(error)),
            })?;
        let is_spectral =
            matches!(self.color_shift(), ColorShift::Spectra(_)) && self.basis.is_none();
        if is_spectral && arrangement != Arrangement::Sides {
            let spectrum = open_spectrum(&input.text, arrangement, self.extent(), &limits)
                .map_err(|error| {
                    Failure::Failed(format!("`{}`: {}", input.name, Error::from(error).words()))
                })?;
            if !spectrum.is_empty() {
                if self.bands().next().is_some() {
                    return Err(Failure::usage(
                        "the panorama has radiances at wavelengths, infrared and ultraviolet among them: leave out \
                         --infrared and --ultraviolet",
                    ));
                }
                opened.notes.push(
                    "the panorama has radiances at wavelengths, which are used in place of red, green and blue"
                        .to_owned(),
                );
                (opened.panorama, opened.bands) = (None, spectrum);
            }
        }
        for (path, range_nm) in self.bands() {
            if arrangement == Arrangement::Sides {
                return Err(Failure::usage(
                    "infrared and ultraviolet light comes in one file: use -from strip or -from cross for all",
                ));
            }
            let file = context.input_file(path)?;
            let band = open(&[&file.text], Some(arrangement), self.extent(), None, limits)
                .map_err(|error| {
                    Failure::Failed(format!("`{}`: {}", file.name, Error::from(error).words()))
                })?;
            opened.notes.extend(band.notes);
            opened.bands.extend(band.panorama.map(|panorama| Band {
                range_nm,
                basis: Basis::Grey,
                panorama,
            }));
        }
        context.detail("decoded the panorama");
        Ok(opened)
    }

    /// Files of infrared and ultraviolet light, with their wavelengths in nm.
    fn bands(&self) -> impl Iterator<Item = (&PathBuf, Range<f64>)> {
        let infrared = VISIBLE_NM.end..self.infrared_to.unwrap_or(INFRARED_TO);
        let ultraviolet = self.ultraviolet_from.unwrap_or(ULTRAVIOLET_FROM)..VISIBLE_NM.start;
        let infrared = self.infrared.iter().map(move |path| (path, infrared.clone()));
        infrared.chain(self.ultraviolet.iter().map(move |path| (path, ultraviolet.clone())))
    }

    /// How many times as bright as white clipped highlights are.
    fn highlights(&self) -> Option<f32> {
        self.highlights.map(|stops| libm::exp2(stops) as f32)
    }

    /// Writes which part of the panorama a picture needs.
    fn write_needs(
        &self,
        opened: &Opened,
        config: &Config,
        context: &mut Context,
    ) -> Result<(), Failure> {
        if opened.panorama.is_none() && opened.bands.is_empty() {
            return Err(Failure::usage("a list of stars has no pixels: leave out --needs"));
        }
        opened.notes.iter().for_each(|note| context.note(note));
        let found = needs(opened, config, &context.steps()).map_err(Failure::of)?;
        let has_pixels = self.from.is_none_or(|kind| kind == Arrangement::Equirectangular);
        match found {
            Some(needs) => context.write_text(&needs.text(has_pixels)),
            None => context.write_text("the picture shows no part of the panorama\n"),
        }
    }

    /// The angles that the panorama shows.
    fn extent(&self) -> Option<Extent> {
        let [west, east, south, north]: [f64; 4] = self.part.as_deref()?.try_into().ok()?;
        let radians = |edges: [f64; 2]| edges.map(f64::to_radians);
        Some(Extent { longitudes: radians([west, east]), latitudes: radians([south, north]) })
    }
}

/// The whole program between its streams: reads the panorama, makes a picture, writes it.
///
/// # Errors
/// Bad usage, a bad panorama, or a stream that fails.
pub fn draw(args: &Args, context: &mut Context) -> Result<(), Failure> {
    let config = args.config(context.output_name())?;
    config.check().map_err(Failure::of)?;
    if !args.needs {
        refuse_terminal(config.picture.output.format(), context)?;
    }
    let input = context.input()?;
    let opened = args.open(&input, context)?;
    if args.needs {
        return args.write_needs(&opened, &config, context);
    }
    let command_line = args.recorded(context.command_line(), &config);
    let provenance = Provenance { command: Some(&command_line), ..PROVENANCE };
    let metadata = metadata(&context.take_record(&input), provenance);
    let picture = run(&config, &opened, &metadata, &context.steps()).map_err(Failure::of)?;
    write_picture(&picture, config.picture.size, context)
}

/// The stars of a list.
fn stars(input: &Input) -> Result<StarList, Failure> {
    read_stars(&input.name, &input.text).map_err(|found| Failure::Report(found.report()))
}

/// The name of a basis, or three temperatures.
fn basis(words: &[String]) -> Result<Basis, Failure> {
    let kelvins: Vec<f64> = words.iter().map_while(|word| finite(word).ok()).collect();
    match (words, &kelvins[..]) {
        ([word], _) if word == "mixture" => Ok(Basis::Mixture),
        (_, &[first, second, third]) => Ok(Basis::Planck([first, second, third])),
        (_, kelvins) => {
            let given = match kelvins.len() {
                0 => String::new(),
                n => format!(", and {n} {} given", if n == 1 { "is" } else { "are" }),
            };
            Err(Failure::Usage(format!(
                "`{}` is no basis: --basis takes mixture or three temperatures{given}",
                words.join(" ")
            )))
        }
    }
}

fn stops(stops: f64) -> Result<f64, String> {
    if (0.0..=24.0).contains(&stops) { Ok(stops) } else { Err("from 0 to 24 stops".to_owned()) }
}

fn infrared_end(nm: f64) -> Result<f64, String> {
    if nm > VISIBLE_NM.end { Ok(nm) } else { Err("infrared light has more than 830 nm".to_owned()) }
}

fn ultraviolet_end(nm: f64) -> Result<f64, String> {
    if (0.0..VISIBLE_NM.start).contains(&nm) {
        Ok(nm)
    } else {
        Err("ultraviolet light has 0 to 360 nm".to_owned())
    }
}
