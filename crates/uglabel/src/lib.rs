//! Text and lines on pictures: captions, legends, grids.
//!
//! A [`Drawing`] is a list of shapes, areas and lines of one colour each, in pixels from the upper left corner. It
//! is painted on a frame ([`Drawing::paint`], [`Drawing::paint_light`]), with smooth edges, or
//! becomes the elements of a figure of areas ([`Drawing::elements`]), so both show the same.
//!
//! Text ([`Line`], [`wrapped`]) is areas, too: the outlines of a font that is part of the program, DejaVu Sans with Latin,
//! Greek, figures above and below the line, arrows and signs of mathematics. A character that it lacks is an error
//! ([`MissingCharacter`]), not a box. Text runs from left to right, and a character is one glyph.
//!
//! The same drawing gives the same bytes everywhere: outlines are made of straight lines, and their coverage of pixels
//! is counted in whole numbers.
//!
//! ```
//! use uglabel::{Drawing, Line};
//! use ugimage::Frame;
//!
//! let line = Line::new("β = 0.9", 20.0)?;
//! let mut drawing = Drawing::default();
//! drawing.text(&line, [4.0, 24.0], [255, 255, 255]);
//! let mut frame = Frame::opaque(line.width().ceil() as u32 + 8, 32);
//! drawing.paint(&mut frame);
//! assert!(frame.pixels().contains(&[255; 4]));
//! # Ok::<(), uglabel::MissingCharacter>(())
//! ```

mod coverage;
mod drawing;
mod font;
mod ink;
pub mod number;
mod paint;
mod text;

pub use drawing::{Drawing, Shape};
pub use font::MissingCharacter;
pub use ink::ink_on;
pub use text::{ASCENT, DESCENT, Line, SPACING, wrapped};
pub use ugimage::figure::{Point, Rgb};
