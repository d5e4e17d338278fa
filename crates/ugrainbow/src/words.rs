//! Value parsers of the command line.

use ugimage::Format;
use ugphysics::Brightness;
use ugpicture::cli::format_named;
use ugpipe::finite;

use crate::config::MAX_LINE_WIDTH;

/// A column and a row.
pub type Pixel = [u32; 2];

/// The kind of output: a picture or a report.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    Picture(Format),
    Report(Report),
}

/// Format of the explanation of a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Report {
    Text,
    Json,
}

/// The names of [`Kind`]: formats of pictures, and those of explanations.
pub fn kinds() -> impl Iterator<Item = &'static str> {
    Format::ALL.map(Format::name).into_iter().chain(["text", "json"])
}

/// A format of pictures or of explanations.
pub fn kind_named(name: &str) -> Result<Kind, String> {
    match name {
        "text" => Ok(Kind::Report(Report::Text)),
        "json" => Ok(Kind::Report(Report::Json)),
        name => format_named(name).map(Kind::Picture),
    }
}

/// `320,240`
pub fn pixel(word: &str) -> Result<Pixel, String> {
    let numbers =
        word.split_once(',').and_then(|(x, y)| Some([x.trim().parse().ok()?, y.trim().parse().ok()?]));
    numbers.ok_or_else(|| "a pixel is its column and row, such as 320,240".to_owned())
}

/// Width of lines in pixels.
pub fn line_width(word: &str) -> Result<f64, String> {
    let width = finite(word)?;
    if 0.0 < width && width <= MAX_LINE_WIDTH {
        Ok(width)
    } else {
        Err(format!("a line is more than 0 and at most {MAX_LINE_WIDTH} pixels wide"))
    }
}

/// The name of a brightness law.
pub fn law(word: &str) -> Result<Brightness, String> {
    Brightness::from_name(word)
        .ok_or_else(|| format!("none of the laws {}", Brightness::ALL.map(Brightness::name).join(", ")))
}
