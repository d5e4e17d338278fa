//! The scale of a picture in false colours: a bar with ticks.

use ugimage::label::{Drawing, Line, MissingCharacter};

use super::map::Scale;
use super::style::Style;

/// Height of the strip in text sizes.
const HEIGHT: f64 = 4.4;

/// Greatest and least width of the bar, in text sizes.
const WIDTH: [f64; 2] = [26.0, 9.0];

/// Pieces of uniform colour.
const N_PIECES: u32 = 256;

/// Rows of the strip in a picture `width` columns wide; `None` if that is too narrow.
pub fn rows(style: &Style, width: u32) -> Option<u32> {
    let room = f64::from(width) - 2.0 * style.margin();
    (room >= WIDTH[1] * style.size).then_some((HEIGHT * style.size).ceil() as u32)
}

/// Draws the bar on a strip of a given width that begins at a given row.
///
/// # Errors
/// Never, because the font has all its characters.
pub fn draw(
    scale: &Scale,
    style: &Style,
    [width, top]: [f64; 2],
    drawing: &mut Drawing,
) -> Result<(), MissingCharacter> {
    let Style { size, ink, hairline, .. } = *style;
    let room = width - 2.0 * style.margin();
    let long = room.min(WIDTH[0] * size);
    let left = 0.5 * (width - long);
    let column = |place: f64| left + long * place;
    let [upper, lower] = [1.6, 2.6].map(|row| (top + row * size).round());
    let title = Line::new(&scale.title(), size)?;
    drawing.text(&title, [0.5 * (width - title.width()), (top + 1.2 * size).round()], ink);
    for piece in 0..N_PIECES {
        let part = |at: f64| (f64::from(piece) + at) / f64::from(N_PIECES);
        // Each piece extends under the next, so that no background shows between them.
        let ends = [part(0.0), part(1.7).min(1.0)].map(column);
        drawing.rectangle([ends[0], upper], [ends[1], lower], scale.color(part(0.5)));
    }
    let mut end = f64::NEG_INFINITY;
    for (tick, text) in scale.ticks() {
        let at = column(scale.place(tick));
        drawing.lines(vec![[[at, lower], [at, lower + 0.3 * size]]], hairline, ink);
        let number = Line::new(&text, 0.85 * size)?;
        let start = at - 0.5 * number.width();
        // A number that would touch the one before is left out.
        if start > end + 0.3 * size {
            drawing.text(&number, [start, (lower + 1.15 * size).round()], ink);
            end = start + number.width();
        }
    }
    Ok(())
}
