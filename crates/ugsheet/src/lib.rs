//! `ugsheet` puts several pictures on one sheet, as the figures of papers do: in rows, with a label under each.
//!
//! Labels are given, or follow from what the pictures say of how they were made: if they differ in the velocity that
//! `uglorentz` was given, or in the time, that is the label, else the name of the file ([`Labels`]). Pictures keep their
//! pixels; on the sheet's ground stand only those with transparency.
//!
//! # Example
//!
//! ```
//! use ugimage::{Frame, Label};
//! use ugsheet::{Config, Labels, Picture};
//!
//! let picture = |line: &str| Picture {
//!     name: "ship".into(),
//!     frame: Frame::opaque(80, 60),
//!     history: Label { software: "ugrainbow".into(), comment: line.into() },
//! };
//! let pictures = [picture("uglorentz -vel 0 0 0"), picture("uglorentz -vel .9 0 0")];
//! assert_eq!(Labels::Auto.texts(&pictures), ["at rest", "β = 0.9"]);
//! let sheet = ugsheet::sheet(&Config::default(), &pictures)?;
//! assert!(sheet.width() > 160 && sheet.height() > 60);
//! # Ok::<(), ugsheet::Error>(())
//! ```

#[cfg(feature = "cli")]
mod cli;
mod error;
mod labels;
mod layout;
mod words;

use ugimage::{Frame, Label};
use uglabel::Drawing;

#[cfg(feature = "cli")]
pub use cli::main;
pub use error::Error;
pub use labels::Labels;
use layout::Layout;
pub use uglabel::Rgb;

/// A picture to be put on a sheet.
#[derive(Clone, Debug)]
pub struct Picture {
    /// Of its file, without folder and ending.
    pub name: String,
    /// Its pixels.
    pub frame: Frame,
    /// What its file says of how it was made.
    pub history: Label,
}

/// Everything that decides what a sheet looks like besides the pictures.
#[derive(Clone, Debug, PartialEq)]
pub struct Config {
    /// Pictures in a row; by default as many as make rows and columns about equal.
    pub columns: Option<u32>,
    /// What stands under the pictures.
    pub labels: Labels,
    /// Labels begin with (a), (b), …
    pub letters: bool,
    /// Above all; none if there is nothing but blanks in it.
    pub title: String,
    /// Below all, likewise.
    pub caption: String,
    /// Of the ground.
    pub background: Rgb,
    /// Pixels between pictures, and around all; by default what suits the text.
    pub gap: Option<[u32; 2]>,
    /// Size of labels in pixels; by default what suits the pictures.
    pub text_size: Option<f64>,
}

impl Default for Config {
    /// Labels by themselves, on white.
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
        }
    }
}

/// The sheet of pictures.
///
/// # Errors
/// There is no picture, labels are not as many as pictures, the font lacks a character, or the sheet is too large.
pub fn sheet(config: &Config, pictures: &[Picture]) -> Result<Frame, Error> {
    let labels = config.labels.checked(pictures)?;
    let layout = Layout::new(config, pictures, &labels)?;
    let mut frame = Frame::opaque(layout.size[0], layout.size[1]);
    let [red, green, blue] = config.background;
    frame.pixels_mut().fill([red, green, blue, 255]);
    for (picture, &place) in pictures.iter().zip(&layout.pictures) {
        put(&picture.frame, place, &mut frame);
    }
    let mut drawing = Drawing::default();
    for (line, origin) in &layout.lines {
        drawing.text(line, *origin, layout.ink);
    }
    drawing.paint(&mut frame);
    Ok(frame)
}

/// How the sheet was made: what all the pictures say, and the command line.
pub fn history(pictures: &[Picture], command_line: &str) -> Label {
    let lines = pictures.iter().map(|picture| picture.history.comment.as_str());
    let lines: Vec<&str> = lines.chain([command_line]).filter(|line| !line.is_empty()).collect();
    Label { software: concat!("ugsheet ", env!("CARGO_PKG_VERSION")).to_owned(), comment: lines.join("\n") }
}

/// Puts a picture on a frame, with its upper left corner at a place.
fn put(picture: &Frame, [left, top]: [u32; 2], frame: &mut Frame) {
    let (width, columns) = (frame.width() as usize, picture.width() as usize);
    let rows = picture.pixels().chunks_exact(columns);
    let quantizer = ugimage::Quantizer::new();
    for (row, pixels) in (top as usize..).zip(rows) {
        let start = row * width + left as usize;
        for (under, pixel) in frame.pixels_mut()[start..start + columns].iter_mut().zip(pixels) {
            *under = match pixel[3] {
                255 => *pixel,
                alpha => over(*pixel, f64::from(alpha) / 255.0, *under, &quantizer),
            };
        }
    }
}

/// A pixel of which a part is there, over one that is there; mixed as light.
fn over(pixel: [u8; 4], part: f64, under: [u8; 4], quantizer: &ugimage::Quantizer) -> [u8; 4] {
    let light = |level: u8| ugphysics::srgb_decode(f64::from(level) / 255.0);
    let mixed = |i: usize| quantizer.level((part * light(pixel[i]) + (1.0 - part) * light(under[i])) as f32);
    [mixed(0), mixed(1), mixed(2), 255]
}
