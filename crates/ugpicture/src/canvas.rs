//! The shell of every renderer: from its options to the picture that it returns.

use ugimage::{Development, Frame, LinearFrame, Metadata, Tone};
use ugpipe::Progress;

use crate::annotations::{Annotated, Layout, Subject};
use crate::error::Error;
use crate::exposure::Exposure;
use crate::image::Image;
use crate::levels;
use crate::note::Note;
use crate::options::PictureOptions;
use crate::rendering::{Content, Rendering, VectorFigure};

/// Least brightness at which clipping is reported; less is invisible in 8 bits.
const CLIPPED: f32 = 1.001;

/// A picture to be drawn: its options are checked, and rows below it are kept for annotations.
///
/// A renderer draws a picture with [`Canvas::options`]; [`Canvas::finish`] does everything else.
pub struct Canvas {
    options: PictureOptions,
    layout: Layout,
}

/// The drawing of a renderer on a [`Canvas`].
pub struct Drawn<'a, E> {
    /// Light, pixels or areas.
    pub content: DrawnContent,
    /// The brightest channel before light is clipped.
    pub brightest: f32,
    /// Notes on the scene.
    pub notes: Vec<Note>,
    /// The subject of annotations.
    pub annotated: Annotated<'a, E>,
}

/// The form in which a renderer draws a picture.
pub enum DrawnContent {
    /// Linear light, to be developed as the options ask for. `is_clipped`: its samples were clipped
    /// one by one, so it is in the range of a display already.
    Light {
        /// The light, with the channels that the options ask for.
        frame: LinearFrame,
        /// See above.
        is_clipped: bool,
    },
    /// 8-bit pixels, for options that neither keep light nor expose it.
    Display(Frame),
    /// Areas, whose light was developed so.
    Figure(VectorFigure, Option<Development>),
}

impl Canvas {
    /// Checks the options of a picture, and lays out its annotations.
    ///
    /// # Errors
    /// See [`Error`].
    pub fn new(options: &PictureOptions) -> Result<Self, Error> {
        options.check()?;
        let layout = Layout::new(options)?;
        Ok(Self { options: layout.of_scene(options), layout })
    }

    /// The options of the part of the picture that the renderer draws.
    pub fn options(&self) -> &PictureOptions {
        &self.options
    }

    /// A pixel of the whole picture as a pixel of the part that the renderer draws.
    ///
    /// # Errors
    /// [`Error::Pixel`]: it is not in that part.
    pub fn pixel_of_scene(&self, pixel: [u32; 2]) -> Result<[u32; 2], Error> {
        let outside = Error::Pixel { pixel, size: self.options.size };
        self.layout.pixel_of_scene(pixel).ok_or(outside)
    }

    /// Develops and annotates what was drawn. `metadata`: what the file says about its making.
    ///
    /// # Errors
    /// Errors of annotations; [`Error::Stopped`].
    pub fn finish<E: From<Error>>(
        &self,
        drawn: Drawn<'_, E>,
        metadata: Metadata,
        progress: &dyn Progress,
    ) -> Result<Rendering, E> {
        let Drawn { mut content, mut brightest, mut notes, annotated } = drawn;
        if let Some(light) = &self.options.light {
            content = DrawnContent::Light { frame: (**light).clone(), is_clipped: false };
            brightest = 0.0;
        }
        let camera = match annotated.subject {
            Subject::Surfaces { view, wires: Some(_), .. } => view.matrices().map(Box::new),
            _ => None,
        };
        let metadata = Metadata { camera, per_inch: self.options.per_inch, ..metadata };
        progress.check().map_err(Error::from)?;
        let mapped = self.layout.map(&annotated, &self.options)?;
        let scale = mapped.as_ref().map(|(_, scale)| scale.clone());
        let content = match mapped {
            Some((frame, _)) => Content::Image(Image::Display(frame)),
            None => {
                let (content, development) = self.developed(content);
                notes.extend(self.light_note(brightest, development));
                notes.extend(self.levels_note(&content, &notes));
                content
            }
        };
        progress.step("annotating", 0);
        let annotations = self.layout.annotate(&annotated, &self.options, scale.as_ref())?;
        let content = annotations.add_to(content);
        notes.extend(annotations.notes);
        progress.check().map_err(Error::from)?;
        Ok(Rendering::new(content, &self.options, metadata, notes))
    }

    fn developed(&self, content: DrawnContent) -> (Content, Option<Development>) {
        match content {
            DrawnContent::Light { frame, is_clipped } => {
                let (image, development) = Image::developed(frame, &self.options, is_clipped);
                (Content::Image(image), development)
            }
            DrawnContent::Display(frame) => (Content::Image(Image::Display(frame)), None),
            DrawnContent::Figure(figure, development) => (Content::Figure(figure), development),
        }
    }

    /// How light brighter than white was brought into range, if there was any.
    fn light_note(&self, brightest: f32, development: Option<Development>) -> Option<Note> {
        let PictureOptions { output, exposure, tone, .. } = self.options;
        if output.format().is_linear() {
            return None;
        }
        if let (Some(Exposure::Auto), Some(Development { stops, .. })) = (exposure, development) {
            return Some(Note::Exposure(stops));
        }
        let is_chosen = exposure.is_some() || tone != Tone::Clip;
        // Light beyond the largest number is shown as that number.
        let (most, has_light) = (brightest.min(f32::MAX), development.is_some());
        (most > CLIPPED && !is_chosen).then_some(Note::ClippedIntensity { most, has_light })
    }

    /// Whether the picture is nearly black or overexposed, unless its other `notes` say why nothing
    /// is visible.
    fn levels_note(&self, content: &Content, notes: &[Note]) -> Option<Note> {
        let Content::Image(image) = content else { return None };
        let is_explained = notes.iter().any(|note| note.is_of_empty() || note.is_of_black());
        if is_explained { None } else { levels::of_image(image, &self.options) }
    }
}
