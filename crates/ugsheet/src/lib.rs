//! `ugsheet` arranges several pictures on one sheet, like the figures of papers: in rows, with a
//! label under each.
//!
//! Labels are given, or made of the [`Motion`] of the pictures: if they differ in velocity or time,
//! these are the labels, otherwise the file names ([`Labels`]). Opaque pixels are copied unchanged;
//! transparent ones are composited over the background.
//!
//! It also joins the tiles of a large picture to the whole ([`join`]).
//!
//! # Example
//!
//! ```
//! use ugimage::{Frame, Metadata};
//! use ugsheet::{Config, Labels, Motion, Picture, Sheet};
//!
//! let picture = |line: &str| {
//!     let history =
//!         Metadata { software: "ugrainbow".into(), comment: line.into(), ..Metadata::default() };
//!     Picture { name: "ship".into(), size: [80, 60], motion: Motion::recorded(&history), history }
//! };
//! let pictures = [picture("uglorentz -vel 0 0 0"), picture("uglorentz -vel .9 0 0")];
//! assert_eq!(Labels::Auto.texts(&pictures), ["at rest", "β = 0.9"]);
//! let sheet = Sheet::new(&Config::default(), &pictures)?.draw(|_| Ok(Frame::opaque(80, 60)))?;
//! assert!(sheet.width() > 160 && sheet.height() > 60);
//! # Ok::<(), ugsheet::Error>(())
//! ```

#[cfg(feature = "cli")]
mod cli;
mod error;
#[cfg(feature = "cli")]
pub mod film;
mod labels;
mod layout;
#[cfg(feature = "cli")]
mod recipe;
#[cfg(feature = "cli")]
mod recorded_files;
mod scaling;
mod shell_words;
mod tiles;

use ugimage::{Frame, Metadata};

#[cfg(feature = "cli")]
pub use cli::{Args, main};
pub use error::Error;
pub use labels::{Labels, Motion};
use layout::Layout;
#[cfg(feature = "cli")]
pub use recipe::{Recipe, recipes};
pub use tiles::join;
pub use ugimage::figure::Rgb;

/// A picture to be placed on a sheet.
#[derive(Clone, Debug)]
pub struct Picture {
    /// Its file name, without folder and extension.
    pub name: String,
    /// Its width and height in pixels.
    pub size: [u32; 2],
    /// The motion that it shows, for labels.
    pub motion: Motion,
    /// The history recorded in its file.
    pub history: Metadata,
}

/// The options of a sheet.
///
/// A later version may have more fields, so complete it with `..Config::default()`.
#[derive(Clone, Debug, PartialEq)]
pub struct Config {
    /// Pictures per row; by default such that there are about as many columns as rows.
    pub columns: Option<u32>,
    /// The labels under the pictures.
    pub labels: Labels,
    /// Whether labels begin with (a), (b), …
    pub letters: bool,
    /// The title above the pictures; no title if it is blank.
    pub title: String,
    /// The caption below the pictures; no caption if it is blank.
    pub caption: String,
    /// The background colour.
    pub background: Rgb,
    /// Pixels between pictures, and margin around them; by default 0.9 of the text size.
    pub gap: Option<[u32; 2]>,
    /// Text size of labels in pixels; by default 1/28 of the size of the pictures.
    pub text_size: Option<f64>,
    /// Width of the sheet and, if there is one, height. All pictures are scaled by one factor, so
    /// that the sheet fits; without it they keep their pixels.
    pub size: Option<(u32, Option<u32>)>,
    /// Whether width and height are even, as encoders of films need them.
    pub is_even: bool,
}

impl Default for Config {
    /// Automatic labels, white background.
    fn default() -> Self {
        Self {
            columns: None,
            labels: Labels::Auto,
            letters: false,
            title: String::new(),
            caption: String::new(),
            background: [255; 3],
            gap: None,
            text_size: None,
            size: None,
            is_even: false,
        }
    }
}

/// A sheet that is laid out, for pictures of known sizes.
#[derive(Clone, Debug)]
pub struct Sheet {
    pictures: Vec<Picture>,
    layout: Layout,
    background: Rgb,
}

impl Sheet {
    /// Lays out a sheet.
    ///
    /// # Errors
    /// There are no pictures, the number of labels is wrong, the font lacks a character, or the
    /// sheet is too large, or too narrow for its pictures.
    pub fn new(config: &Config, pictures: &[Picture]) -> Result<Self, Error> {
        let labels = config.labels.checked(pictures)?;
        let layout = Layout::new(config, pictures, &labels)?;
        Ok(Self { pictures: pictures.to_vec(), layout, background: config.background })
    }

    /// Width and height in pixels.
    pub fn size(&self) -> [u32; 2] {
        self.layout.size
    }

    /// The pictures.
    pub fn pictures(&self) -> &[Picture] {
        &self.pictures
    }

    /// The sizes of the pictures on the sheet, in pixels.
    pub fn picture_sizes(&self) -> impl Iterator<Item = [u32; 2]> {
        self.layout.pictures.iter().map(|place| place.size)
    }

    /// Draws the sheet. `frame_of` returns the pixels of a picture by its index; it is called once
    /// for each picture, in order, so that only one has to be in memory.
    ///
    /// # Errors
    /// The sheet is too large for the memory, or a picture cannot be read or has another size.
    pub fn draw(
        &self,
        mut frame_of: impl FnMut(usize) -> Result<Frame, Error>,
    ) -> Result<Frame, Error> {
        let mut frame = blank(self.layout.size)?;
        let [red, green, blue] = self.background;
        frame.pixels_mut().fill([red, green, blue, 255]);
        let quantizer = ugimage::Quantizer::new();
        for (idx, (picture, place)) in self.pictures.iter().zip(&self.layout.pictures).enumerate() {
            let pixels = frame_of(idx)?;
            if [pixels.width(), pixels.height()] != picture.size {
                return Err(Error::Picture(format!(
                    "`{}` has changed while it was read",
                    picture.name
                )));
            }
            let pixels = if place.size == picture.size {
                pixels
            } else {
                scaling::scaled(&pixels, place.size, &quantizer)
            };
            copy(&pixels, place.corner, &mut frame, |pixel, under| match pixel[3] {
                255 => pixel,
                alpha => over(pixel, f64::from(alpha) / 255.0, under, &quantizer),
            });
        }
        self.layout.drawing().paint(&mut frame);
        Ok(frame)
    }
}

/// The history of a sheet: those of all its pictures, and the command that made it, if one did.
pub fn history(pictures: &[Picture], command: Option<&str>) -> Metadata {
    let lines = pictures.iter().map(|picture| picture.history.comment.as_str());
    let lines: Vec<&str> = lines.chain(command).filter(|line| !line.is_empty()).collect();
    Metadata {
        software: concat!("ugsheet ", env!("CARGO_PKG_VERSION")).to_owned(),
        comment: lines.join("\n"),
        ..Metadata::default()
    }
}

/// A black sheet, if there is memory for it, for its colours and for its file.
fn blank(size: [u32; 2]) -> Result<Frame, Error> {
    const BYTES_PER_PIXEL: u64 = 12;
    let bytes = BYTES_PER_PIXEL * u64::from(size[0]) * u64::from(size[1]);
    let refused = |_| Error::Memory { size, bytes };
    let n_bytes = usize::try_from(bytes).unwrap_or(usize::MAX);
    Vec::<u8>::new().try_reserve_exact(n_bytes).map_err(refused)?;
    Ok(Frame::opaque(size[0], size[1]))
}

/// Copies a picture to a frame, with its upper left corner at `[left, top]`. `composed`: a pixel of
/// the picture over one of the frame.
fn copy(
    picture: &Frame,
    [left, top]: [u32; 2],
    frame: &mut Frame,
    composed: impl Fn([u8; 4], [u8; 4]) -> [u8; 4],
) {
    let (width, columns) = (frame.width() as usize, picture.width() as usize);
    let rows = picture.pixels().chunks_exact(columns);
    for (row, pixels) in (top as usize..).zip(rows) {
        let start = row * width + left as usize;
        for (under, &pixel) in frame.pixels_mut()[start..start + columns].iter_mut().zip(pixels) {
            *under = composed(pixel, *under);
        }
    }
}

/// A pixel of alpha `part` composited over an opaque one, in linear light.
fn over(pixel: [u8; 4], part: f64, under: [u8; 4], quantizer: &ugimage::Quantizer) -> [u8; 4] {
    let light = |level: u8| ugphysics::srgb_decode(f64::from(level) / 255.0);
    let mixed = |i: usize| {
        quantizer.level((part * light(pixel[i]) + (1.0 - part) * light(under[i])) as f32)
    };
    [mixed(0), mixed(1), mixed(2), 255]
}
