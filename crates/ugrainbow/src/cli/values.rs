//! Value parsers of the command line.

use ugphysics::Brightness;
use ugpipe::finite;

/// Greatest width of lines.
const MAX_LINE_WIDTH: f64 = 100.0;

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
