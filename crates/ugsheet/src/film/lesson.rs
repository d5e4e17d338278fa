//! A film as a page of a browser, with a slider over its pictures.

use std::io::{self, Write};

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use ugimage::{Compression, Format, Frame, Metadata};

use super::animation::FilmShape;

/// The page around the pictures.
const TEMPLATE: &str = include_str!("lesson.html");

/// What the page says about a picture.
#[derive(Clone, Debug)]
pub struct Caption {
    /// The values that change over the film.
    pub values: String,
    /// The command line that draws it.
    pub line: String,
}

/// Writes pictures and their captions into a page.
pub struct Lesson<'w> {
    out: &'w mut dyn Write,
    captions: std::vec::IntoIter<Caption>,
    tail: String,
}

impl<'w> Lesson<'w> {
    /// Begins the page of pictures with these captions.
    ///
    /// # Errors
    /// Writing fails.
    pub fn new(
        out: &'w mut dyn Write,
        captions: Vec<Caption>,
        shape: FilmShape,
    ) -> io::Result<Self> {
        let (head, tail) = TEMPLATE.split_once("@PICTURES@").unwrap_or((TEMPLATE, ""));
        out.write_all(head.as_bytes())?;
        let tail = tail
            .replace("@DELAY@", &format!("{:.0}", 1e3 / shape.rate))
            .replace("@ROWS@", &shape.n_rows.to_string());
        Ok(Self { out, captions: captions.into_iter(), tail })
    }

    /// Adds the next picture.
    ///
    /// # Errors
    /// Writing fails.
    pub fn push(&mut self, frame: &Frame) -> io::Result<()> {
        let png = STANDARD.encode(Format::Png.encode_with(
            frame,
            &Metadata::default(),
            Compression::Small,
        ));
        let (values, line) = self
            .captions
            .next()
            .map_or_else(Default::default, |of| (escaped(&of.values), escaped(&of.line)));
        writeln!(
            self.out,
            "<img hidden alt=\"{values}\" title=\"{line}\" src=\"data:image/png;base64,{png}\">"
        )
    }

    /// Ends the page.
    ///
    /// # Errors
    /// Writing fails.
    pub fn finish(self) -> io::Result<()> {
        self.out.write_all(self.tail.as_bytes())?;
        self.out.flush()
    }
}

/// Lines of text as the value of an attribute.
fn escaped(text: &str) -> String {
    let one = |line: &str| {
        ugpipe::printable(line).replace('&', "&amp;").replace('"', "&quot;").replace('<', "&lt;")
    };
    text.lines().map(one).collect::<Vec<_>>().join("&#10;")
}
