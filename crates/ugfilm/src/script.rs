//! The command lines of every frame.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use ugimage::Format;
use ugimage::label::number::significant;
use ugparse::Source;
use ugpicture::{Output, Unit, Units};
use ugpipe::{CommonArgs, Context, Failure, shell_pipe, shell_word};
use ugsheet::film::FrameNames;
use ugskybox::{SceneSky, SkySource};

use crate::options::{EXACT_PIPE, Given, PIPE, ParsedCommand, TOOLS, Tool};
use crate::pipe::Pipe;
use crate::program::Program;
use crate::timeline::{Ease, Quantity, Timeline};

/// Options that more than one program of a pipe must know; all others are given to the first that
/// has them, which passes them on in the scene.
const FOR_ALL: [&str; 4] = ["sz", "va", "sky", "sky-turn"];

/// Options that are velocities.
const VELOCITIES: [&str; 2] = ["vel", "cv"];

/// The options of which every frame has its own text.
const TEXTS: [&str; 2] = ["cap", "title"];

/// Options that say how a panorama is read, of those that may change over a film.
const OPENING: [&str; 4] = ["part", "highlights", "infrared-to", "ultraviolet-from"];

/// Options that name pictures, which are numbered as those of the input are.
const NUMBERED: [&str; 2] = ["infrared", "ultraviolet"];

/// Options for what is done to the light of a picture.
pub const DONE_TO_LIGHT: &[&str] = &["cap", "title", "lg", "lp", "gr", "dl", "iso", "ex", "tc"];

/// A number of four digits, or of all if it rounds to 1, as fast speeds do; other words as they
/// are.
fn readable(word: String) -> String {
    let Ok(number) = word.parse() else { return word };
    let is_fast = (0.99995..1.0).contains(&f64::abs(number));
    if is_fast { word } else { significant(number, 4) }
}

/// The subject of every frame.
pub struct Script {
    /// The programs of the pipe, the last of which draws.
    tools: &'static [&'static Tool],
    /// How many there are.
    pub n_frames: u32,
    /// How numbers go from one value to the next.
    pub ease: Ease,
    /// The last frame comes before the first again, so it is not the same.
    pub is_loop: bool,
    /// If the film is drawn from numbered pictures, the number of the first frame's picture.
    pub first_picture: Option<u32>,
    /// Words that every program gets: options for reading.
    pub reading: Vec<String>,
    options: Vec<Setting>,
    /// The sky of all frames, which is opened once.
    sky: SceneSky,
    /// Least and greatest speed over the film, for captions.
    pub speeds: Option<Timeline>,
    /// An option with a slider of its own on a page, and how many values it has there: all frames
    /// are drawn for each.
    across: Option<(String, u32)>,
    /// The words of the programs of some frame, and what they are.
    parsed: OnceLock<Vec<(Vec<String>, Program)>>,
}

/// An option over the film.
#[derive(Clone, Debug)]
struct Setting {
    name: String,
    /// The programs of the pipe that are given it.
    owners: Vec<usize>,
    timeline: Timeline,
}

/// The commands of a frame: the words of each program, which begin with its name.
pub struct Commands(pub Vec<Vec<String>>);

impl Script {
    /// A script without options. `n_frames`: 1 or more.
    pub fn new(tools: &'static [&'static Tool], n_frames: u32) -> Self {
        Self {
            tools,
            n_frames,
            ease: Ease::Linear,
            is_loop: false,
            first_picture: None,
            reading: Vec::new(),
            options: Vec::new(),
            sky: SceneSky::default(),
            speeds: None,
            across: None,
            parsed: OnceLock::new(),
        }
    }

    /// Adds an option as it was given.
    ///
    /// # Errors
    /// No program of the pipe has this option, or a value is invalid.
    pub fn add(&mut self, option: &Given) -> Result<(), Failure> {
        let timeline = Timeline::new(option.values.clone(), quantity(&option.name));
        let timeline = timeline.map_err(|why| refused(&option.name, &why))?;
        self.add_timeline(&option.name, timeline)
    }

    /// Adds an option with its values over the film.
    ///
    /// # Errors
    /// No program of the pipe has this option, or it was added before.
    pub fn add_timeline(&mut self, name: &str, timeline: Timeline) -> Result<(), Failure> {
        match self.get(name) {
            // Of a look; the film has numbers.
            Some(Timeline::Fixed(words)) if words[..] == ["auto"] => {
                self.options.retain(|setting| setting.name != name);
            }
            Some(_) => return Err(refused(name, "it is given twice")),
            None => {}
        }
        let owners = self.owners(name);
        if owners.is_empty() {
            let owners: Vec<&str> =
                TOOLS.iter().filter(|tool| tool.has(name)).map(|tool| tool.name()).collect();
            let why = match owners[..] {
                [] => "no program has it".to_owned(),
                _ => format!(
                    "it is an option of {}, which draws no frame here",
                    owners.join(" and ")
                ),
            };
            return Err(refused(name, &why));
        }
        self.options.push(Setting { name: name.to_owned(), owners, timeline });
        Ok(())
    }

    /// Replaces the values of an option, or adds it.
    pub fn set(&mut self, name: &str, values: Vec<String>) {
        self.set_timeline(name, Timeline::Fixed(values));
    }

    /// Replaces the values of an option over the film, or adds it.
    pub fn set_timeline(&mut self, name: &str, timeline: Timeline) {
        if let Some(setting) = self.options.iter_mut().find(|setting| setting.name == name) {
            setting.timeline = timeline;
        } else {
            self.options.push(Setting {
                name: name.to_owned(),
                owners: self.owners(name),
                timeline,
            });
        }
    }

    /// Moves an option to a second slider of a page. `n_values`: positions of that slider.
    ///
    /// # Errors
    /// The option does not change over the film, no other does, or a caption has speeds of the
    /// scene, which are found for films.
    pub fn set_across(&mut self, name: &str, n_values: u32) -> Result<(), Failure> {
        let is_moving = |setting: &&Setting| setting.timeline.is_moving();
        let (across, along): (Vec<_>, Vec<_>) =
            self.options.iter().filter(is_moving).partition(|setting| setting.name == name);
        if across.is_empty() || along.is_empty() {
            let why = format!(
                "give two options with several values, one of them -{name}, as -{name} 0..1"
            );
            return Err(refused("across", &why));
        }
        if self.lacks_speeds() {
            return Err(refused(
                "across",
                "{beta}, {gamma} and {speed} are known only with -vel or -cv",
            ));
        }
        self.across = Some((name.to_owned(), n_values));
        self.n_frames = self.n_frames.saturating_mul(n_values);
        Ok(())
    }

    /// The rows of frames, of which each has another value of the option with its own slider.
    pub fn n_rows(&self) -> u32 {
        self.across.as_ref().map_or(1, |(_, n_values)| *n_values)
    }

    /// Leaves textures to rays in the pipe of three programs, unless an option excludes rays.
    pub fn draw_textures(&mut self) {
        /// Options of `ugrainbow` that need colours at vertices.
        const SCANLINE: [&str; 7] = ["cb", "og", "vec", "wf", "sil", "crease", "hl"];
        /// Options of `ugdoppler` with which it colours vertices.
        const AT_VERTICES: [&str; 5] = ["no-textures", "gw", "ir", "hd", "li"];
        let is_given = |names: &[&str]| names.iter().any(|name| self.get(name).is_some());
        if self.tools.len() != PIPE.len() {
            return;
        }
        let needs_colors = is_given(&SCANLINE);
        if needs_colors || is_given(&AT_VERTICES) {
            self.cut("se", uglorentz::DEFAULT_ERROR * 1e3);
        }
        if needs_colors {
            self.set("no-textures", Vec::new());
        }
    }

    /// Leaves faces whole where a ray is drawn for each sample of them (`-xc`), unless an option
    /// says how to cut them.
    pub fn leave_whole(&mut self) {
        if self.tools.len() == EXACT_PIPE.len() {
            self.cut("sd", 1.0);
        }
    }

    /// Sets an option of subdivision, unless one is given.
    fn cut(&mut self, name: &str, number: f64) {
        if ["se", "sc", "sl", "sd"].iter().all(|given| self.get(given).is_none()) {
            self.set(name, vec![number.to_string()]);
        }
    }

    /// The only word of an option that does not change.
    pub fn fixed(&self, name: &str) -> Option<String> {
        match self.get(name) {
            Some(Timeline::Fixed(words)) => words.first().cloned(),
            _ => None,
        }
    }

    /// True if a caption has speeds and no option gives them.
    pub fn lacks_speeds(&self) -> bool {
        let has_place = |text: &String| {
            ["{beta}", "{gamma}", "{speed}"].iter().any(|place| text.contains(place))
        };
        let is_given = VELOCITIES.iter().any(|name| self.get(name).is_some());
        !is_given && TEXTS.iter().any(|name| self.fixed(name).as_ref().is_some_and(has_place))
    }

    /// True if no option changes over the film.
    pub fn is_still(&self) -> bool {
        !self.options.iter().any(|setting| setting.timeline.is_moving())
    }

    /// The programs of the pipe that are given an option.
    fn owners(&self, name: &str) -> Vec<usize> {
        let owners =
            self.tools.iter().enumerate().filter(|(_, tool)| tool.has(name)).map(|(row, _)| row);
        owners.take(if FOR_ALL.contains(&name) { usize::MAX } else { 1 }).collect()
    }

    /// The values of an option, if it is given.
    pub fn get(&self, name: &str) -> Option<&Timeline> {
        self.options.iter().find(|setting| setting.name == name).map(|setting| &setting.timeline)
    }

    /// The time of a frame, from 0 to 1. Frames are counted from 1, and `frame` may lie between
    /// two.
    pub fn time(&self, frame: f64) -> f64 {
        let n_frames = self.n_frames / self.n_rows();
        let frame =
            if self.across.is_some() { 1.0 + (frame - 1.0) % f64::from(n_frames) } else { frame };
        let steps = if self.is_loop { n_frames } else { n_frames - 1 };
        let time = if steps == 0 { 0.0 } else { (frame - 1.0) / f64::from(steps) };
        // With motion blur, the first frame of a film that repeats begins at its end.
        if self.is_loop && time < 0.0 { time.rem_euclid(1.0) } else { time }
    }

    /// The number of the picture of a frame or moment, the nearest one, of a film of numbered
    /// pictures. In a film that repeats the first one follows the last.
    pub fn picture(&self, moment: f64) -> Option<u32> {
        let n_pictures = f64::from(self.n_frames / self.n_rows());
        let idx = (moment.round() - 1.0).rem_euclid(n_pictures) as u32;
        self.first_picture.map(|first| first.saturating_add(idx))
    }

    /// The numbered files that options name for a frame.
    ///
    /// # Errors
    /// See [`Script::commands`].
    pub fn numbered_files(&self, frame: f64) -> Result<Vec<PathBuf>, Failure> {
        let is_numbered = |setting: &&Setting| NUMBERED.contains(&setting.name.as_str());
        let values = self.options.iter().filter(is_numbered).map(|setting| {
            self.values(setting, frame).map(|values| PathBuf::from(values.concat()))
        });
        values.collect()
    }

    /// True if an option changes that says how a panorama is read.
    pub fn opens_each(&self) -> bool {
        OPENING.iter().any(|name| self.get(name).is_some_and(Timeline::is_moving))
    }

    /// The command of a frame or moment of a panorama without its file, in which all options that
    /// do not say how it is read are those of the first frame.
    ///
    /// # Errors
    /// See [`Script::commands`].
    pub fn opening(&self, moment: f64) -> Result<Vec<String>, Failure> {
        let at = |setting: &Setting| {
            let name = setting.name.as_str();
            if OPENING.contains(&name) || NUMBERED.contains(&name) { moment } else { 1.0 }
        };
        Ok(self.commands_at(at, &TEXTS)?.0.concat())
    }

    /// The time of an option in a frame.
    fn time_of(&self, name: &str, frame: f64) -> f64 {
        match &self.across {
            Some((across, n_values)) if across == name && *n_values > 1 => {
                let row = (frame - 1.0) / f64::from(self.n_frames / n_values);
                row.floor() / f64::from(n_values - 1)
            }
            Some((across, _)) if across == name => 0.0,
            _ => self.time(frame),
        }
    }

    /// The programs of a frame or moment. Their command lines, which its file records, are without
    /// the options `left_out`.
    ///
    /// # Errors
    /// An option is wrong, or a caption asks for what the frame does not have.
    pub fn pipe(&self, frame: f64, left_out: &[&str], format: Format) -> Result<Pipe, Failure> {
        let mut commands = self.commands(frame, left_out)?;
        commands.set_format(format);
        let mut pipe = Pipe::new(self.programs(frame)?);
        if let SkySource::Opened(source) = &self.sky.source {
            for sky in pipe.skies() {
                // An option turns it in each frame, a statement once.
                let turn = if sky.is_some() { sky.turn } else { self.sky.turn };
                *sky = SceneSky { source: SkySource::Opened(source.clone()), turn, ..*sky };
            }
        }
        let quoted = |words: &Vec<String>| {
            words.iter().map(|word| shell_word(word)).collect::<Vec<_>>().join(" ")
        };
        pipe.lines = commands.0.iter().map(quoted).collect();
        pipe.picture.output = match pipe.picture.output {
            Output::Vector(_) => Output::Vector(format),
            _ => Output::Color(format),
        };
        let annotations = &mut pipe.picture.annotations;
        for setting in self.settings(left_out) {
            match setting.name.as_str() {
                "cap" => annotations.caption = self.values(setting, frame)?.concat(),
                "title" => annotations.title = self.values(setting, frame)?.concat(),
                _ => {}
            }
        }
        Ok(pipe)
    }

    /// Opens the sky of all frames. `source`: the scene, which may state it.
    ///
    /// # Errors
    /// An option is wrong, or the file of the sky.
    pub fn open_sky(
        &mut self,
        source: (&Source, &ugparse::Options),
        common: &CommonArgs,
        context: &Context,
    ) -> Result<(), Failure> {
        // Frames that are wrong are reported when they are drawn.
        let Ok(programs) = self.programs(1.0) else { return Ok(()) };
        let mut pipe = Pipe::new(programs);
        if let Some(sky) = pipe.skies().last() {
            sky.open_with(source, common, context)?;
            self.sky = sky.clone();
        }
        Ok(())
    }

    /// The programs of a frame. Words that are those of an earlier frame are not parsed again.
    fn programs(&self, frame: f64) -> Result<Vec<Program>, Failure> {
        let mut parsed = Vec::new();
        for (row, words) in self.commands(frame, &TEXTS)?.0.into_iter().enumerate() {
            let program = match self.parsed.get().map(|parsed| &parsed[row]) {
                Some((earlier, program)) if *earlier == words => program.clone(),
                _ => ParsedCommand::from_words(&words)?.program,
            };
            parsed.push((words, program));
        }
        let programs = parsed.iter().map(|(_, program)| program.clone()).collect();
        self.parsed.get_or_init(|| parsed);
        Ok(programs)
    }

    /// The words of the values of an option.
    fn values(&self, setting: &Setting, frame: f64) -> Result<Vec<String>, Failure> {
        let time = self.time_of(&setting.name, frame);
        let values = setting.timeline.at(time, self.ease);
        match setting.name.as_str() {
            name if TEXTS.contains(&name) => {
                values.iter().map(|text| self.filled(name, text, frame)).collect()
            }
            name if NUMBERED.contains(&name) => {
                let Some(number) = self.picture(frame) else { return Ok(values) };
                let file = |word: String| match FrameNames::of_path(Path::new(&word)) {
                    Some(names) => names.path(number).to_string_lossy().into_owned(),
                    None => word,
                };
                Ok(values.into_iter().map(file).collect())
            }
            _ => Ok(values),
        }
    }

    /// The options for the exposure and tone curve of a frame, in words.
    pub fn development(&self, frame: f64) -> String {
        let words = |name: &str| {
            let values = self.get(name)?.at(self.time_of(name, frame), self.ease);
            Some(format!("{} {}", spelling(name), values.join(" ")))
        };
        let options: Vec<String> = ["ex", "tc"].into_iter().filter_map(words).collect();
        format!(", developed with {}", options.join(" "))
    }

    /// The options that change over the film, with their values in a frame, rounded to be read.
    ///
    /// # Errors
    /// See [`Script::commands`].
    pub fn changing(&self, frame: f64) -> Result<String, Failure> {
        let moving = self.options.iter().filter(|setting| setting.timeline.is_moving());
        let words = moving.map(|setting| {
            let values = self.values(setting, frame)?;
            let values: Vec<String> = values.into_iter().map(readable).collect();
            Ok(format!("{} {}", spelling(&setting.name), values.join(" ")))
        });
        Ok(words.collect::<Result<Vec<_>, Failure>>()?.join(" "))
    }

    /// The commands of a frame or moment without the options `left_out`.
    ///
    /// # Errors
    /// A caption asks for what the frame does not have.
    pub fn commands(&self, frame: f64, left_out: &[&str]) -> Result<Commands, Failure> {
        self.commands_at(|_| frame, left_out)
    }

    /// The same with the frame or moment of each option.
    fn commands_at(
        &self,
        frame_of: impl Fn(&Setting) -> f64,
        left_out: &[&str],
    ) -> Result<Commands, Failure> {
        let begin = |tool: &&Tool| {
            let first = [tool.name()].into_iter().chain(tool.first_words().iter().copied());
            first.map(str::to_owned).chain(self.reading.clone()).collect()
        };
        let mut commands = Commands(self.tools.iter().map(begin).collect());
        for setting in self.settings(left_out) {
            let values = self.values(setting, frame_of(setting))?;
            // The first program states the view ahead in the scene.
            let is_stated = setting.name == "va" && self.get("ahead").is_some();
            let owners = &setting.owners;
            for &row in if is_stated { &owners[..owners.len().min(1)] } else { owners } {
                commands.0[row].push(spelling(&setting.name));
                commands.0[row].extend(values.iter().cloned());
            }
        }
        Ok(commands)
    }

    fn settings(&self, left_out: &[&str]) -> impl Iterator<Item = &Setting> {
        self.options.iter().filter(|setting| !left_out.contains(&setting.name.as_str()))
    }

    /// A caption with the numbers of a frame: `{frame}`, `{beta}`, `{gamma}`, `{speed}`, `{t}`, and
    /// the names of options with one number.
    fn filled(&self, option: &str, text: &str, frame: f64) -> Result<String, Failure> {
        let mut filled = String::new();
        let mut rest = text;
        while let Some((before, after)) = rest.split_once('{') {
            let Some((name, after)) = after.split_once('}') else { break };
            filled += before;
            filled += &self.number(name, frame).ok_or_else(|| {
                let known =
                    "{frame}, {beta}, {gamma}, {speed}, {t}, or an option of this film with one number, as {ti}";
                refused(option, &format!("`{{{name}}}` is not one of {known}"))
            })?;
            rest = after;
        }
        Ok(filled + rest)
    }

    /// The units in its captions, which were checked when its programs were parsed.
    fn units(&self) -> Units {
        let [length, light] = ["unit", "c"].map(|name| self.fixed(name));
        Units::new(length.as_deref(), light.as_deref()).unwrap_or_default()
    }

    fn number(&self, name: &str, frame: f64) -> Option<String> {
        let numbers = |name: &str| {
            self.get(name).map(|timeline| timeline.numbers(self.time_of(name, frame), self.ease))
        };
        let speeds = |write: &dyn Fn(f64) -> String| {
            let speeds = match &self.speeds {
                Some(speeds) => speeds.numbers(self.time(frame), self.ease),
                None => {
                    let velocity =
                        VELOCITIES.iter().rev().find_map(|name| numbers(name)).unwrap_or_default();
                    vec![velocity.iter().fold(0.0, |sum, part| libm::hypot(sum, *part))]
                }
            };
            let mut words: Vec<String> = speeds.into_iter().map(write).collect();
            words.dedup();
            words.join(" – ")
        };
        Some(match name {
            "frame" => format!("{frame}"),
            "beta" => speeds(&|speed| format!("{speed:.3}")),
            "gamma" => {
                speeds(&|speed| format!("{:.2}", 1.0 / ((1.0 - speed) * (1.0 + speed)).sqrt()))
            }
            "speed" => {
                let unit =
                    self.units().speed().unwrap_or(Unit { factor: 1.0, name: "c".to_owned() });
                format!("{} {}", speeds(&|speed| significant(speed * unit.factor, 4)), unit.name)
            }
            "t" => {
                let at = |time: f64| {
                    let timeline = self.get("ti")?;
                    timeline.numbers(time, self.ease).first().copied()
                };
                let longest = [0.0, 1.0].map(|end| at(end).unwrap_or(0.0).abs());
                let unit = self.units().time(longest[0].max(longest[1]));
                let (factor, name) = unit
                    .map_or((1.0, String::new()), |unit| (unit.factor, format!(" {}", unit.name)));
                format!("{:.2}{name}", factor * at(self.time_of("ti", frame)).unwrap_or(0.0))
            }
            _ => match numbers(name)?[..] {
                [number] => format!("{number:.2}"),
                _ => return None,
            },
        })
    }
}

impl Commands {
    /// States the format of the picture, unless it is the default.
    pub fn set_format(&mut self, format: Format) {
        if let (Some(words), true) = (self.0.last_mut(), format != Format::Png) {
            words.extend(["-dt".to_owned(), format.name().to_owned()]);
        }
    }

    /// The pipe for a shell. `input`: the scene, `None` for standard input; `output`: the file.
    pub fn line(&self, input: Option<&Path>, output: Option<&Path>) -> String {
        let mut commands: Vec<Vec<&OsStr>> =
            self.0.iter().map(|words| words.iter().map(AsRef::as_ref).collect()).collect();
        if let (Some(first), Some(input)) = (commands.first_mut(), input) {
            first.insert(1, input.as_os_str());
        }
        shell_pipe(&commands, output.map(Path::as_os_str))
    }
}

/// The kind of an option's numbers.
pub fn quantity(name: &str) -> Quantity {
    if VELOCITIES.contains(&name) { Quantity::Velocity } else { Quantity::Plain }
}

/// An option as our documentation writes it.
fn spelling(name: &str) -> String {
    if name.len() <= 3 { format!("-{name}") } else { format!("--{name}") }
}

fn refused(name: &str, why: &str) -> Failure {
    Failure::Usage(format!("`{}`: {why}", spelling(name)))
}
