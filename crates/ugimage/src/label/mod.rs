//! Text and lines on images: captions, legends, grids.
//!
//! A [`Drawing`] is a list of shapes, areas and lines of one colour each, in pixels from the upper
//! left corner. It is painted, antialiased, on a frame ([`Drawing::paint`],
//! [`Drawing::paint_light`]), or converted to elements of a vector figure ([`Drawing::elements`]);
//! both look the same.
//!
//! Text ([`Line`], [`wrapped`]) is drawn as areas: the glyph outlines of an embedded font. In vector
//! figures it can stay text ([`TextForm`]). The font is DejaVu Sans with Latin and Greek letters,
//! superscript and subscript digits, arrows and mathematical signs. A character that the font lacks
//! is an error ([`MissingCharacter`]); no placeholder box is drawn. Text runs from left to right,
//! with one glyph per character.
//!
//! The same drawing gives the same bytes on every platform: outlines consist of straight lines, and
//! their pixel coverage is computed in integers.
//!
//! ```
//! use ugimage::label::{Drawing, Line};
//! use ugimage::Frame;
//!
//! let line = Line::new("β = 0.9", 20.0)?;
//! let mut drawing = Drawing::default();
//! drawing.text(&line, [4.0, 24.0], [255, 255, 255]);
//! let mut frame = Frame::opaque(line.width().ceil() as u32 + 8, 32);
//! drawing.paint(&mut frame);
//! assert!(frame.pixels().contains(&[255; 4]));
//! # Ok::<(), ugimage::label::MissingCharacter>(())
//! ```

mod coverage;
mod drawing;
mod font;
mod ink;
pub mod number;
mod paint;
mod text;

pub use drawing::{Drawing, Shape, TextForm};
pub use font::MissingCharacter;
pub use ink::ink_on;
pub use text::{ASCENT, DESCENT, Line, SPACING, wrapped};
