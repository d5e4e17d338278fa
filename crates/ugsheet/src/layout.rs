//! The layout of a sheet: positions of pictures and lines of text.

use ugimage::figure::{Point, Rgb};
use ugimage::label::{ASCENT, DESCENT, Drawing, Line, SPACING, ink_on, wrapped};

use crate::error::{Error, MAX_PIXELS};
use crate::{Config, Picture};

/// Text sizes of the title and of the caption, relative to labels.
const TITLE: f64 = 1.35;
const CAPTION: f64 = 1.1;

/// Ratio of the size of pictures to the default text size.
const PER_TEXT: f64 = 28.0;

/// Pictures are not enlarged by less than this.
const KEPT: f64 = 1.05;

/// Smallest and largest default text size, in pixels.
const SIZES: [f64; 2] = [10.0, 48.0];

/// The positions of everything on a sheet, in pixels.
#[derive(Clone, Debug)]
pub struct Layout {
    /// Width and height of the sheet.
    pub size: [u32; 2],
    /// The pictures.
    pub pictures: Vec<Place>,
    /// The lines of text, and where their baselines begin.
    lines: Vec<(Line, Point)>,
    /// The colour of the text.
    ink: Rgb,
}

/// The place of a picture, in pixels.
#[derive(Clone, Copy, Debug)]
pub struct Place {
    /// Its upper left corner.
    pub corner: [u32; 2],
    /// Its width and height.
    pub size: [u32; 2],
}

impl Layout {
    /// Lays out a sheet. `labels` has one label for each picture, and there is at least one
    /// picture.
    ///
    /// # Errors
    /// The font lacks a character, or the sheet is too large, or too narrow for its pictures.
    pub fn new(config: &Config, pictures: &[Picture], labels: &[String]) -> Result<Self, Error> {
        let layout = match config.size {
            Some((width, height)) => {
                Self::fitted(config, pictures, labels, [width, height.unwrap_or(u32::MAX)])?
            }
            None => Self::scaled(config, pictures, labels, 1.0)?,
        };
        let [width, height] = layout.size;
        let [width, height] = match config.size {
            Some((width, whole)) => [width, whole.unwrap_or(height)],
            None => [width, height],
        };
        let sides = [width, height]
            .map(|side| if config.is_even { side.next_multiple_of(2) } else { side });
        if u64::from(sides[0]) * u64::from(sides[1]) > MAX_PIXELS {
            return Err(Error::Size);
        }
        Ok(layout.centred(sides))
    }

    /// The sheet with its pictures as large as this size allows. They keep their pixels if these
    /// are nearly as many.
    fn fitted(
        config: &Config,
        pictures: &[Picture],
        labels: &[String],
        size: [u32; 2],
    ) -> Result<Self, Error> {
        // The width does not depend on texts, whose layout takes long.
        let bare = Config {
            letters: false,
            title: String::new(),
            caption: String::new(),
            ..config.clone()
        };
        let blank = vec![String::new(); pictures.len()];
        let widest = pictures.iter().map(|picture| picture.size[0]).max().unwrap_or(1);
        // A row with this picture alone fills the sheet.
        let most = f64::from(size[0]) / f64::from(widest);
        let mut scale = largest(32, most, |scale| {
            Self::scaled(&bare, pictures, &blank, scale)
                .is_ok_and(|layout| layout.size[0] <= size[0])
        });
        let is_low = |scale: f64| {
            Self::scaled(config, pictures, labels, scale)
                .is_ok_and(|layout| layout.size[1] <= size[1])
        };
        if size[1] < u32::MAX && !is_low(scale) {
            scale = largest(16, scale, is_low);
        }
        if (1.0..KEPT).contains(&scale) {
            scale = 1.0;
        }
        let layout = Self::scaled(config, pictures, labels, scale)?;
        if scale > 0.0 { Ok(layout) } else { Err(Error::Narrow) }
    }

    /// The sheet with its pictures scaled by a factor.
    fn scaled(
        config: &Config,
        pictures: &[Picture],
        labels: &[String],
        scale: f64,
    ) -> Result<Self, Error> {
        let scaled = |side: u32| ((f64::from(side) * scale).round() as u32).max(1);
        let sizes: Vec<[u32; 2]> =
            pictures.iter().map(|picture| picture.size.map(scaled)).collect();
        let text = config.text_size.unwrap_or_else(|| text_size(&sizes));
        let gap = (0.9 * text).round() as u32;
        let [gap, margin] = config.gap.unwrap_or([gap; 2]);
        let n = sizes.len();
        let n_columns = config.columns.map_or_else(
            || n.isqrt() + usize::from(n.isqrt().pow(2) < n),
            |columns| columns as usize,
        );
        let n_columns = n_columns.clamp(1, n);
        let widest =
            |column: usize| sizes.iter().skip(column).step_by(n_columns).map(|size| size[0]).max();
        let widths: Vec<u32> = (0..n_columns).map(|column| widest(column).unwrap_or(0)).collect();
        let inner: u64 = widths.iter().map(|&width| u64::from(width)).sum::<u64>()
            + (n_columns as u64 - 1) * u64::from(gap);
        let width = inner + 2 * u64::from(margin);
        if width > MAX_PIXELS {
            return Err(Error::Size);
        }
        let width = width as u32;
        let mut page = Page { width, margin, row: margin, lines: Vec::new() };
        page.heading(&config.title, TITLE * text)?;
        let mut places = Vec::with_capacity(n);
        for (row, cells) in sizes.chunks(n_columns).enumerate() {
            if row > 0 {
                page.advance(gap)?;
            }
            let height = cells.iter().map(|size| size[1]).max().unwrap_or(0);
            let mut column = margin;
            let mut label_rows = 0;
            for (idx, &size) in cells.iter().enumerate() {
                let [free, above] = [widths[idx] - size[0], height - size[1]];
                places.push(Place { corner: [column + free / 2, page.row + above / 2], size });
                let number = row * n_columns + idx;
                let label = with_letter(config.letters, number, &labels[number]);
                let top = page.row.checked_add(height).ok_or(Error::Size)?;
                label_rows =
                    label_rows.max(page.centered(&label, text, [column, top], widths[idx])?);
                column += widths[idx] + gap;
            }
            page.advance(height)?;
            page.advance(label_rows)?;
        }
        page.caption(&config.caption, CAPTION * text)?;
        page.advance(margin)?;
        Ok(Self {
            size: [width, page.row],
            pictures: places,
            lines: page.lines,
            ink: ink_on(config.background),
        })
    }

    /// The same in the middle of a sheet that is as large or larger.
    fn centred(mut self, size: [u32; 2]) -> Self {
        let [left, top] = [0, 1].map(|axis| size[axis].saturating_sub(self.size[axis]) / 2);
        for Place { corner, .. } in &mut self.pictures {
            *corner = [corner[0] + left, corner[1] + top];
        }
        for (_, [x, y]) in &mut self.lines {
            (*x, *y) = (*x + f64::from(left), *y + f64::from(top));
        }
        Self { size, ..self }
    }

    /// The text of the sheet.
    pub fn drawing(&self) -> Drawing {
        let mut drawing = Drawing::default();
        for (line, origin) in &self.lines {
            drawing.text(line, *origin, self.ink);
        }
        drawing
    }
}

/// The largest number up to `high` that fits, to 1 part in 2 to the power `n_steps`; 0 if none
/// does.
fn largest(n_steps: u32, high: f64, fits: impl Fn(f64) -> bool) -> f64 {
    let (mut low, mut high) = (0.0, high);
    for _ in 0..n_steps {
        let middle = 0.5 * (low + high);
        *(if fits(middle) { &mut low } else { &mut high }) = middle;
    }
    low
}

/// The default text size. It depends on the mean area of the pictures only, so that sheets of
/// similar pictures have the same text size.
fn text_size(sizes: &[[u32; 2]]) -> f64 {
    let sum: f64 = sizes.iter().map(|size| f64::from(size[0]) * f64::from(size[1])).sum();
    let mean = (sum / sizes.len() as f64).sqrt();
    (mean / PER_TEXT).round().clamp(SIZES[0], SIZES[1])
}

/// The label of a picture, with its letter if `letters` is set.
fn with_letter(letters: bool, number: usize, label: &str) -> String {
    if !letters {
        return label.to_owned();
    }
    format!("({}) {label}", letter(number)).trim_end().to_owned()
}

/// a … z, aa, ab, …
fn letter(number: usize) -> String {
    let last = char::from(b'a' + (number % 26) as u8);
    match number / 26 {
        0 => last.to_string(),
        more => format!("{}{last}", letter(more - 1)),
    }
}

/// A sheet that is filled from top to bottom.
struct Page {
    width: u32,
    margin: u32,
    /// The first free pixel row.
    row: u32,
    lines: Vec<(Line, Point)>,
}

impl Page {
    fn advance(&mut self, rows: u32) -> Result<(), Error> {
        self.row = self.row.checked_add(rows).ok_or(Error::Size)?;
        Ok(())
    }

    /// Adds a paragraph of centred lines within `width`, below `top`. Returns its height in pixel
    /// rows.
    fn centered(
        &mut self,
        text: &str,
        size: f64,
        [left, top]: [u32; 2],
        width: u32,
    ) -> Result<u32, Error> {
        let lines = lines(text, size, f64::from(width))?;
        if lines.is_empty() {
            return Ok(0);
        }
        let above = 0.35 * size;
        let rows = above + paragraph(lines.len(), size);
        for (idx, line) in lines.into_iter().enumerate() {
            let column = f64::from(left) + 0.5 * (f64::from(width) - line.width());
            let base = f64::from(top) + above + size * (ASCENT + SPACING * idx as f64);
            // Baselines at whole pixel rows are sharp.
            self.lines.push((line, [column, base.round()]));
        }
        Ok(rows.ceil() as u32)
    }

    fn text_width(&self) -> u32 {
        // At least 4 pixels of margin, so that letters do not touch the edge.
        self.width.saturating_sub(2 * self.margin.max(4)).max(1)
    }

    fn heading(&mut self, text: &str, size: f64) -> Result<(), Error> {
        let (text_width, row) = (self.text_width(), self.row);
        let left = (self.width - text_width) / 2;
        let rows = self.centered(text, size, [left, row], text_width)?;
        self.advance(if rows == 0 { 0 } else { rows + (0.4 * size) as u32 })
    }

    /// Adds the caption: a single line is centred, several lines are left-aligned.
    fn caption(&mut self, text: &str, size: f64) -> Result<(), Error> {
        let text_width = self.text_width();
        let left = (self.width - text_width) / 2;
        let lines = lines(text, size, f64::from(text_width))?;
        if lines.is_empty() {
            return Ok(());
        }
        self.advance((0.6 * size).round() as u32)?;
        let top = self.row;
        if lines.len() == 1 {
            let rows = self.centered(text, size, [left, top], text_width)?;
            return self.advance(rows);
        }
        let rows = paragraph(lines.len(), size);
        for (idx, line) in lines.into_iter().enumerate() {
            let base = f64::from(top) + size * (ASCENT + SPACING * idx as f64);
            self.lines.push((line, [f64::from(left), base.round()]));
        }
        self.advance(rows.ceil() as u32)
    }
}

/// Height of a paragraph in pixels.
fn paragraph(n_lines: usize, size: f64) -> f64 {
    size * (ASCENT + DESCENT + SPACING * (n_lines - 1) as f64)
}

fn lines(text: &str, size: f64, width: f64) -> Result<Vec<Line>, Error> {
    wrapped(text, size, width)
        .map_err(|missing| Error::Text { text: text.trim().to_owned(), missing })
}

#[cfg(test)]
mod tests {
    use super::letter;

    #[test]
    fn letters_continue_after_z() {
        assert_eq!([0, 25, 26, 27, 701, 702].map(letter), ["a", "z", "aa", "ab", "zz", "aaa"]);
    }
}
