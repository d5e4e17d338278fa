//! The programs of a frame, one after the other.

use ugimage::{LinearFrame, Metadata};
use ugpicture::{AnnotationOptions, Canvas, PictureOptions, Rendering};
use ugpipe::Progress;
use ugscene::{Head, Provenance, Scene};
use ugskybox::SceneSky;
use ugtrace::lens::Lens;

use crate::error::Error;
use crate::note::Note;
use crate::program::{FilmItem, Program};

/// The subject of a film.
#[derive(Clone, Copy)]
pub enum FilmSubject<'s> {
    /// A scene at rest.
    Scene(&'s Scene),
    /// A panorama, with hash and name of every file that it was read from, the first one first.
    Panorama(&'s ugwarp::Opened, &'s [String]),
}

impl FilmSubject<'_> {
    /// Comments and files that a picture of it records.
    pub(crate) fn head(&self) -> Head {
        match self {
            Self::Scene(scene) => scene.head.clone(),
            Self::Panorama(_, files) => Head { files: files.to_vec(), ..Head::default() },
        }
    }
}

/// The light of a frame, and the notes of the programs that drew it.
pub type DrawnLight = (LinearFrame, Vec<Note>);

/// The programs that draw a frame.
#[derive(Clone, Debug)]
pub struct Pipe {
    programs: Vec<Program>,
    /// The options of the picture, which replace those of the last program.
    pub picture: PictureOptions,
    /// The command lines of the programs for the history of the picture; none are recorded if it is
    /// empty.
    pub lines: Vec<String>,
    /// Hash and name of every file that was read for it beside those of its subject.
    pub files: Vec<String>,
}

impl Pipe {
    /// Programs in their order, the last of which draws.
    pub fn new(mut programs: Vec<Program>) -> Self {
        let picture = programs.last_mut().and_then(Program::picture).map(std::mem::take);
        let picture = picture.unwrap_or_default();
        Self { programs, picture, lines: Vec::new(), files: Vec::new() }
    }

    /// The programs with their options, but those of the picture.
    pub fn programs(&self) -> &[Program] {
        &self.programs
    }

    /// The sky behind the scene, of the last program.
    pub fn sky(&mut self) -> Option<&mut SceneSky> {
        self.programs.last_mut().and_then(Program::sky)
    }

    /// The sky of each program that has one, which is the same.
    pub fn skies(&mut self) -> impl Iterator<Item = &mut SceneSky> {
        self.programs.iter_mut().filter_map(Program::sky)
    }

    /// The record in the file of the frame. Of a scene only the comments are used.
    pub fn metadata(&self, subject: FilmSubject<'_>) -> Metadata {
        self.recorded(subject.head())
    }

    /// The same with what is recorded of the subject.
    pub(crate) fn recorded(&self, mut head: Head) -> Metadata {
        head.files.extend(self.files.iter().cloned());
        let Some((last, filters)) = self.programs.split_last() else { return Metadata::default() };
        for (filter, line) in filters.iter().zip(&self.lines) {
            head.record(Provenance { command: Some(line), ..filter.provenance() });
        }
        let command = Some(self.lines.last().map_or("", String::as_str));
        let metadata = ugpicture::metadata(&head, Provenance { command, ..last.provenance() });
        Metadata { panorama: last.panorama(&self.picture), ..metadata }
    }

    /// Draws the frame. Returns it with the notes of all programs.
    ///
    /// # Errors
    /// The scene or panorama cannot be drawn with these options.
    pub fn draw(&self, subject: FilmSubject<'_>) -> Result<(Rendering, Vec<Note>), Error> {
        self.draw_with(subject, &())
    }

    /// Like [`Pipe::draw`], and reports progress.
    ///
    /// # Errors
    /// See [`Pipe::draw`]; the caller stopped it.
    pub fn draw_with(
        &self,
        subject: FilmSubject<'_>,
        progress: &dyn Progress,
    ) -> Result<(Rendering, Vec<Note>), Error> {
        let mut item = match subject {
            FilmSubject::Scene(scene) => FilmItem::Scene(Box::new(scene.clone())),
            FilmSubject::Panorama(panorama, _) => FilmItem::Panorama(panorama),
        };
        let mut notes = Vec::new();
        for program in &self.programs {
            let mut program = program.clone();
            if let Some(picture) = program.picture() {
                picture.clone_from(&self.picture);
            }
            let (made, told) = program.run(item, progress)?.ok_or(Error::Subject)?;
            notes.extend(told);
            item = made;
        }
        let FilmItem::Picture(mut picture) = item else { return Err(Error::Subject) };
        let Metadata { camera, per_inch, .. } = std::mem::take(&mut picture.metadata);
        picture.metadata = Metadata { camera, per_inch, ..self.metadata(subject) };
        Ok((picture, notes))
    }

    /// The options of the part of the frame with the scene, without a caption and legend.
    ///
    /// # Errors
    /// See [`Canvas::new`].
    pub fn scene_options(&self) -> Result<PictureOptions, Error> {
        Ok(Canvas::new(&self.picture)?.options().clone())
    }

    /// The light of the frame without exposure and annotations. `scene`: the options of the part
    /// of the frame that shows it.
    ///
    /// # Errors
    /// See [`Pipe::draw`].
    pub fn light(
        &self,
        scene: &PictureOptions,
        subject: FilmSubject<'_>,
    ) -> Result<DrawnLight, Error> {
        let mut pipe = self.clone();
        (pipe.picture.size, pipe.picture.camera.part) = (scene.size, scene.camera.part);
        pipe.picture.keep_light();
        let (picture, notes) = pipe.draw(subject)?;
        Ok((picture.into_light().ok_or(Error::NoPixels)?, notes))
    }

    /// True if the scene is drawn as polygons. The light of few pixels then takes about as long as
    /// that of many.
    pub fn draws_polygons(&self) -> bool {
        matches!(self.programs.last(), Some(Program::Rainbow(_)))
    }

    /// Moves the notes on a picture by the last program.
    pub fn notes(&self, picture: &mut Rendering) -> Vec<Note> {
        self.programs.last().map_or_else(Vec::new, |program| program.notes(picture))
    }

    /// The same frame in a picture of about `side` pixels a side at most, without annotations,
    /// which would leave no room for the scene. The sides of a cube stay squares, and the pictures
    /// of two eyes equal.
    #[must_use]
    pub fn small(mut self, side: u32) -> Self {
        let [width, height] = self.picture.size;
        let longest = width.max(height).max(1);
        if longest > side {
            let scaled = |length: u32, n: u32| {
                let length = u64::from(length / n) * u64::from(side) / u64::from(longest);
                n * length.max(1) as u32
            };
            let (lens, is_stereo) =
                self.programs.last().map_or((Lens::Pinhole, false), Program::lens);
            let [across, down] = lens.frames(is_stereo);
            self.picture.size = [scaled(width, across), scaled(height, down)];
        }
        self.picture.channels.clear();
        self.picture.annotations = AnnotationOptions::default();
        self
    }
}
