//! A picture as a renderer returns it.

use ugimage::figure::{self, Figure, GouraudTriangle, Gradient};
use ugimage::{Compression, Format, Frame, LinearFrame, Metadata};
use ugparse::Diagnostics;
use ugpipe::Progress;

use crate::image::Image;
use crate::note::Note;
use crate::options::PictureOptions;
use crate::output::Output;
use crate::picture_file::PictureFile;

/// A rendered picture, and the kind of file that the options ask for.
#[derive(Clone, Debug)]
pub struct Rendering {
    content: Content,
    output: Output,
    compression: Compression,
    /// The record in the file of how it was made.
    pub metadata: Metadata,
    /// Notes on it.
    pub notes: Vec<Note>,
}

/// Pixels or areas.
#[derive(Clone, Debug)]
pub enum Content {
    /// Pixels.
    Image(Image),
    /// Areas and lines.
    Figure(VectorFigure),
}

/// A figure with smooth colours in the form that its format supports.
#[derive(Clone, Debug)]
pub enum VectorFigure {
    /// For SVG.
    Gradients(Figure<Gradient>),
    /// For PostScript and PDF.
    Triangles(Figure<GouraudTriangle>, Format),
}

impl VectorFigure {
    /// The bytes of its file.
    pub fn file(&self, metadata: &Metadata) -> Vec<u8> {
        match self {
            Self::Gradients(figure) => figure::svg(figure, metadata),
            Self::Triangles(figure, Format::Pdf) => figure::pdf(figure, metadata),
            Self::Triangles(figure, Format::Ps) => figure::ps(figure, metadata),
            Self::Triangles(figure, _) => figure::eps(figure, metadata),
        }
    }
}

impl Rendering {
    /// A picture that was drawn with some options.
    pub(crate) fn new(
        content: Content,
        options: &PictureOptions,
        metadata: Metadata,
        notes: Vec<Note>,
    ) -> Self {
        Self {
            content,
            output: options.output,
            compression: options.compression(),
            metadata,
            notes,
        }
    }

    /// The bytes of a file of the kind that the options ask for.
    pub fn into_file(self) -> Vec<u8> {
        match self.content {
            Content::Image(image) => image.into_file(self.output, &self.metadata, self.compression),
            Content::Figure(figure) => figure.file(&self.metadata),
        }
    }

    /// Packs it into a file, with its notes. `warnings`: about the text of the scene.
    pub fn pack(mut self, warnings: Diagnostics, progress: &dyn Progress) -> PictureFile {
        progress.step("compression", 0);
        let notes = std::mem::take(&mut self.notes);
        PictureFile { bytes: self.into_file(), notes, warnings }
    }

    /// 8-bit pixels for a display; `None` for a vector figure, which has no pixels.
    pub fn into_frame(self) -> Option<Frame> {
        match self.content {
            Content::Image(image) => Some(image.into_frame()),
            Content::Figure(_) => None,
        }
    }

    /// The light of a picture whose format holds light; `None` for others.
    pub fn into_light(self) -> Option<LinearFrame> {
        match self.content {
            Content::Image(Image::Light(frame)) if self.output.format().is_linear() => Some(frame),
            _ => None,
        }
    }
}
