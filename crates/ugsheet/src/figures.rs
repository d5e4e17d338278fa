//! Sheets of vector figures.

use ugimage::figure::{self, Figure, PartError, PdfPart, Point, SvgPart};
use ugimage::label::{Drawing, TextForm};
use ugimage::{Format, Metadata};

use crate::error::Error;
use crate::layout::Layout;
use crate::{Config, Picture};

/// The vector figures of a sheet, all of one format.
pub enum Figures<'f> {
    /// SVG files.
    Svg(Vec<SvgPart>),
    /// PDF files.
    Pdf(Vec<PdfPart<'f>>),
}

impl<'f> Figures<'f> {
    /// No figures of a format, PDF or SVG.
    pub fn none(format: Format) -> Self {
        if format == Format::Pdf { Self::Pdf(Vec::new()) } else { Self::Svg(Vec::new()) }
    }

    /// Adds a file. Returns its width and height in pixels, rounded up.
    ///
    /// # Errors
    /// See [`PartError`].
    pub fn add(&mut self, file: &'f [u8]) -> Result<[u32; 2], PartError> {
        let size = match self {
            Self::Svg(parts) => {
                let part = SvgPart::read(file, &format!("p{}-", parts.len()))?;
                let size = part.size();
                parts.push(part);
                size
            }
            Self::Pdf(parts) => {
                let part = PdfPart::read(file)?;
                let size = part.size();
                parts.push(part);
                size
            }
        };
        // Sizes that differ from whole numbers by rounding are these numbers.
        Ok(size.map(|side| (side - 1e-3).ceil().max(1.0) as u32))
    }
}

/// The format of a vector figure; `None` for pictures and other files.
pub fn figure_format(file: &[u8]) -> Option<Format> {
    let file = file.strip_prefix(b"\xef\xbb\xbf").unwrap_or(file).trim_ascii_start();
    match file {
        [b'%', b'P', b'D', b'F', b'-', ..] => Some(Format::Pdf),
        [b'<', ..] => Some(Format::Svg),
        _ => None,
    }
}

/// Makes a sheet of vector figures. `pictures` states the sizes, names and histories of `figures`;
/// `text` is the form of labels.
///
/// # Errors
/// As [`sheet`](crate::sheet), and [`Error::Figure`].
pub fn figure_sheet(
    config: &Config,
    pictures: &[Picture],
    figures: &Figures<'_>,
    text: TextForm,
    metadata: &Metadata,
) -> Result<Vec<u8>, Error> {
    let labels = config.labels.checked(pictures)?;
    let layout = Layout::new(config, pictures, &labels)?;
    let drawing = layout.drawing();
    let places = layout.pictures.iter().map(|place| place.map(f64::from));
    match figures {
        Figures::Svg(parts) => {
            let parts: Vec<(Point, SvgPart)> = places.zip(parts.iter().cloned()).collect();
            Ok(figure::svg_sheet(&labelled(&layout, config, &drawing, text), &parts, metadata))
        }
        Figures::Pdf(parts) => {
            let parts: Vec<(Point, PdfPart<'_>)> = places.zip(parts.iter().cloned()).collect();
            figure::pdf_sheet(&labelled(&layout, config, &drawing, text), &parts, metadata)
                .map_err(|(row, error)| Error::Figure { row, error })
        }
    }
}

/// The sheet without its figures.
fn labelled<S>(layout: &Layout, config: &Config, drawing: &Drawing, text: TextForm) -> Figure<S> {
    Figure { size: layout.size, background: Some(config.background), elements: drawing.elements(text) }
}
