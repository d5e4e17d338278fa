//! Panoramas that are opened while a film is drawn: numbered pictures, one for each frame, or a
//! picture that frames read in different ways.

use std::collections::BTreeMap;
use std::ffi::OsString;
use std::path::PathBuf;
use std::sync::{Mutex, PoisonError};

use ugpipe::{CommonArgs, Context, Failure, Input, ToolArgs, parse_words};
use ugscene::Head;
use ugsheet::film::FrameNames;
use ugwarp::Opened;

use crate::note::Note;
use crate::pipe::FilmSubject;
use crate::script::Script;

/// Frames that are drawn at the same time from panoramas that each of them opens, so that no more
/// are in memory.
const MOST_AT_ONCE: usize = 2;

/// The subjects of the frames of a film.
#[derive(Clone, Copy)]
pub enum Subjects<'s> {
    /// The same in all frames.
    Same(FilmSubject<'s>),
    /// A panorama for each frame. Its file and how it is read are in the commands of the script.
    Each(&'s Series, &'s Script),
}

/// Panoramas that are opened while the film is drawn.
pub struct Series {
    pictures: Pictures,
    /// Stars and the scene of the camera, which all frames share.
    others: Opened,
    /// Hash and name of their files.
    files_of_others: Vec<String>,
    /// Hash and name of the files of a panorama that were read, by its number.
    records: Mutex<BTreeMap<u32, Vec<String>>>,
}

/// The files of the panoramas.
pub enum Pictures {
    /// Numbered files.
    Files(FrameNames),
    /// One file, `None` for standard input, and its content.
    One(Option<PathBuf>, Input),
}

/// A panorama that is open.
struct Loaded {
    /// The command that reads it.
    words: Vec<OsString>,
    opened: Opened,
    files: Vec<String>,
}

/// Opens the subjects of frames, one at a time.
pub struct Opener<'s> {
    subjects: Subjects<'s>,
    loaded: Option<Loaded>,
}

impl<'s> Subjects<'s> {
    /// What the file of a frame or moment records of its subject.
    ///
    /// # Errors
    /// A file cannot be read.
    pub fn head(&self, moment: f64) -> Result<Head, Failure> {
        match self {
            Self::Same(subject) => Ok(subject.head()),
            Self::Each(series, script) => {
                Ok(Head { files: series.files(script, moment)?, ..Head::default() })
            }
        }
    }

    /// True if a picture has labels by its scene.
    pub fn have_labels(&self) -> bool {
        matches!(self, Self::Same(FilmSubject::Scene(scene)) if scene.labels().next().is_some())
    }

    /// The file of a frame or moment, unless it is that of the whole film.
    pub fn file(&self, moment: f64) -> Option<PathBuf> {
        match self {
            Self::Each(Series { pictures: Pictures::Files(names), .. }, script) => {
                Some(names.path(script.picture(moment)?))
            }
            Self::Each(..) | Self::Same(_) => None,
        }
    }

    /// How many frames may be drawn at the same time.
    pub fn most_at_once(&self) -> usize {
        if let Self::Each(..) = self { MOST_AT_ONCE } else { usize::MAX }
    }

    /// Opens the subjects of frames.
    pub fn opener(self) -> Opener<'s> {
        Opener { subjects: self, loaded: None }
    }
}

impl Opener<'_> {
    /// The subject of a frame or moment. It stays open until another one is.
    ///
    /// # Errors
    /// Its file cannot be read, or is no panorama.
    pub fn at(&mut self, moment: f64) -> Result<FilmSubject<'_>, Failure> {
        let (series, script) = match self.subjects {
            Subjects::Same(subject) => return Ok(subject),
            Subjects::Each(series, script) => (series, script),
        };
        let words = series.words(script, moment)?;
        let loaded = match self.loaded.take() {
            Some(loaded) if loaded.words == words => loaded,
            // Closed before the next one is opened.
            other => {
                drop(other);
                series.open(words, script.picture(moment))?
            }
        };
        let Loaded { opened, files, .. } = self.loaded.insert(loaded);
        Ok(FilmSubject::Panorama(opened, files))
    }

    /// Notes on the file of the panorama that is open.
    pub fn notes(&self) -> impl Iterator<Item = Note> {
        let notes = self.loaded.iter().flat_map(|loaded| &loaded.opened.notes);
        notes.map(|note| {
            Note::Picture(ugwarp::PROVENANCE.program, ugpicture::Note::Source(note.clone()))
        })
    }
}

/// The numbers of the pictures of a film.
struct Numbers {
    /// Those that there are, in ascending order.
    found: Vec<u32>,
    first: u32,
}

impl Numbers {
    fn new(names: &FrameNames) -> Result<Self, Failure> {
        let found = names
            .numbers_found()
            .map_err(|error| Failure::Read { name: names.path(1).display().to_string(), error })?;
        match found.first() {
            Some(&first) => Ok(Self { found, first }),
            None => Err(Failure::Failed(format!(
                "there are no pictures such as `{}`",
                names.path(1).display()
            ))),
        }
    }

    /// How many there are without a gap.
    fn n_together(&self) -> u32 {
        let expected = (u64::from(self.first)..).zip(&self.found);
        expected.take_while(|(number, found)| *number == u64::from(**found)).count() as u32
    }
}

impl Series {
    /// The numbered panoramas of an input; `None` if it is a single file. Checks that there is one
    /// for each of some frames.
    ///
    /// # Errors
    /// One is missing; stars or the scene of the camera cannot be read.
    pub fn of_files(
        common: &CommonArgs,
        script: &mut Script,
        frames: &[u32],
        context: &Context,
    ) -> Result<Option<Self>, Failure> {
        let Some(names) = common.input().and_then(FrameNames::of_path) else { return Ok(None) };
        let numbers = Numbers::new(&names)?;
        script.first_picture = Some(numbers.first);
        let n_together = numbers.n_together();
        for &frame in frames {
            let number = script.picture(frame.into()).unwrap_or_default();
            let of_options = script.numbered_files(frame.into())?;
            let is_missing = |path: &PathBuf| !path.exists();
            let missing = of_options.into_iter().find(is_missing);
            let missing = match numbers.found.binary_search(&number) {
                Ok(_) => missing,
                Err(_) => Some(names.path(number)),
            };
            if let Some(missing) = missing {
                let remedy = match numbers.found.last() {
                    Some(&last) if last < number => {
                        format!("; there are {n_together} pictures: give -frames {n_together}")
                    }
                    _ => String::new(),
                };
                return Err(Failure::Failed(format!(
                    "`{}` is missing, of which frame {frame} is drawn{remedy}",
                    missing.display()
                )));
            }
        }
        if numbers.first > 1 {
            let first = names.path(numbers.first);
            context.note(&format!("the first picture is `{}`", first.display()));
        }
        let n_frames = script.n_frames / script.n_rows();
        if n_together > n_frames {
            context.note(&format!(
                "of {n_together} pictures the film shows the first {n_frames}; give -frames {n_together} to show all"
            ));
        }
        Self::new(Pictures::Files(names), script, context).map(Some)
    }

    /// A series of panoramas with the stars and the scene that options name.
    ///
    /// # Errors
    /// These cannot be read.
    pub fn new(pictures: Pictures, script: &Script, context: &Context) -> Result<Self, Failure> {
        let mut others = Opened::default();
        let words = script.opening(1.0)?.into_iter().map(OsString::from);
        parse_words::<ugwarp::Args>(words)?.open_others(&mut others, context)?;
        others.notes.drain(..).for_each(|note| context.note(&note));
        let files_of_others = context.take_files_read();
        Ok(Self { pictures, others, files_of_others, records: Mutex::default() })
    }

    /// The command that reads the panorama of a moment.
    fn words(&self, script: &Script, moment: f64) -> Result<Vec<OsString>, Failure> {
        let mut words: Vec<OsString> =
            script.opening(moment)?.into_iter().map(OsString::from).collect();
        let path = match &self.pictures {
            Pictures::Files(names) => script.picture(moment).map(|number| names.path(number)),
            Pictures::One(path, _) => path.clone(),
        };
        words.extend(path.into_iter().flat_map(|path| ["--".into(), path.into_os_string()]));
        Ok(words)
    }

    /// The program with these words, and how it reads.
    fn program(&self, words: &[OsString]) -> Result<(ugwarp::Args, Context), Failure> {
        let args = parse_words::<ugwarp::Args>(words.iter().cloned())?;
        let given = match &self.pictures {
            Pictures::Files(_) => None,
            Pictures::One(_, input) => Some(input.clone()),
        };
        let context = Context::called(args.common(), given);
        Ok((args, context))
    }

    /// Hash and name of every file of a frame or moment, in the order in which its pipe records
    /// them.
    fn files(&self, script: &Script, moment: f64) -> Result<Vec<String>, Failure> {
        let number = script.picture(moment);
        if let Some(files) = number.and_then(|number| self.record(number)) {
            return Ok(files);
        }
        let (args, mut context) = self.program(&self.words(script, moment)?)?;
        let input = context.input()?;
        args.files_of_input().try_for_each(|path| context.input_file(path).map(|_| ()))?;
        self.recorded(number, context.take_record(&input), &input)
    }

    /// The record of the files that were read for a panorama, with those of others. Its number is
    /// that of a picture of a series.
    fn recorded(
        &self,
        number: Option<u32>,
        mut files: Vec<String>,
        input: &Input,
    ) -> Result<Vec<String>, Failure> {
        files.extend(self.files_of_others.iter().cloned());
        let Some(number) = number else { return Ok(files) };
        let mut records = self.records.lock().unwrap_or_else(PoisonError::into_inner);
        let known = records.entry(number).or_insert_with(|| files.clone());
        if *known == files {
            return Ok(files);
        }
        Err(Failure::Failed(format!(
            "`{}`, or a file that is read with it, changed while the film was drawn: draw it again",
            input.name
        )))
    }

    fn record(&self, number: u32) -> Option<Vec<String>> {
        self.records.lock().unwrap_or_else(PoisonError::into_inner).get(&number).cloned()
    }

    fn open(&self, words: Vec<OsString>, number: Option<u32>) -> Result<Loaded, Failure> {
        let (args, mut context) = self.program(&words)?;
        let input = context.input()?;
        let mut opened = args.open_input(&input, &context)?;
        let files = self.recorded(number, context.take_record(&input), &input)?;
        opened.stars.extend_from_slice(&self.others.stars);
        opened.scene.clone_from(&self.others.scene);
        Ok(Loaded { words, opened, files })
    }
}
