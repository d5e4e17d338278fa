//! Lines of text, and paragraphs broken into lines.

use crate::figure::{Point, Rgb, SLANT, Text};

use crate::label::font::{Glyph, MissingCharacter, SizedFont};

/// Height of letters above the baseline, including accents on lower-case letters, in em.
pub const ASCENT: f64 = 0.8;

/// Depth of letters below the baseline, in em.
pub const DESCENT: f64 = 0.25;

/// Distance from one baseline to the next, in em.
pub const SPACING: f64 = 1.35;

/// A line of text at a size.
#[derive(Clone, Debug)]
pub struct Line {
    text: String,
    size: f64,
    /// The distance of each character's origin from the left end, in pixels.
    places: Vec<f64>,
    width: f64,
}

impl Line {
    /// Sets `text` at em size `size`, in pixels. Tabs and line breaks become spaces.
    ///
    /// # Errors
    /// The font lacks a character.
    pub fn new(text: &str, size: f64) -> Result<Self, MissingCharacter> {
        let font = SizedFont::new(size);
        let text: String =
            text.chars().map(|c| if matches!(c, '\t' | '\n' | '\r') { ' ' } else { c }).collect();
        let glyphs = text.chars().map(|c| font.glyph(c)).collect::<Result<Vec<Glyph>, _>>()?;
        let mut width = 0.0;
        let places = glyphs.iter().enumerate().map(|(idx, &glyph)| {
            let place = width;
            width += font.advance(glyph, glyphs.get(idx + 1).copied());
            place
        });
        let places = places.collect();
        Ok(Self { text, size, places, width })
    }

    /// Its width in pixels.
    pub fn width(&self) -> f64 {
        self.width
    }

    /// The line with a baseline that begins at `origin`, in runs of upright or slanted characters.
    pub fn at(&self, [x, y]: Point, color: Rgb) -> impl Iterator<Item = Text> {
        let chars: Vec<char> = self.text.chars().collect();
        let slanted: Vec<(bool, usize)> =
            (0..chars.len()).map(|at| (is_symbol(&chars, at), at)).collect();
        let runs = slanted.chunk_by(|one, next| one.0 == next.0).map(|run| {
            let (is_slanted, first) = run[0];
            let (size, start) = (self.size, self.places[first]);
            let places = run.iter().map(|&(_, at)| self.places[at] - start).collect();
            let text = chars[first..first + run.len()].iter().collect();
            Text { text, places, origin: [x + start, y], size, color, is_slanted }
        });
        runs.collect::<Vec<_>>().into_iter()
    }
}

/// True for a letter that stands alone and is a symbol of a quantity: β, γ, λ, τ anywhere, others
/// before a sign such as `=`, so that no unit or word is one.
fn is_symbol(text: &[char], at: usize) -> bool {
    let is_letter = |c: Option<&char>| c.is_some_and(|c| c.is_alphanumeric());
    let (before, after) = text.split_at(at);
    if is_letter(before.last()) || is_letter(after.get(1)) {
        return false;
    }
    let next = after[1..].iter().find(|&&c| c != ' ');
    match after[0] {
        'β' | 'γ' | 'λ' | 'τ' => true,
        'D' if before.ends_with(&['f', 'a', 'c', 't', 'o', 'r', ' ']) => true,
        'D' | 'v' | 'z' | 't' | 'x' | 'y' => next.is_some_and(|c| "=<>≤≥≈".contains(*c)),
        _ => false,
    }
}

/// The outlines of all characters of a line.
pub fn contours(
    Text { text, places, origin: [x, y], size, is_slanted, .. }: &Text,
) -> Vec<Vec<Point>> {
    let slant = if *is_slanted { SLANT } else { 0.0 };
    let font = SizedFont::new(*size);
    let glyphs =
        text.chars().zip(places).filter_map(|(c, place)| Some((font.glyph(c).ok()?, place)));
    glyphs.flat_map(|(glyph, place)| font.contours(glyph, [x + place, *y], slant)).collect()
}

/// Text broken into lines of at most `width` pixels: at line breaks, between words, and inside a
/// word only if the word alone is too wide. Spaces at both ends of a line and blank lines at the
/// end of the text are removed.
///
/// # Errors
/// The font lacks a character.
pub fn wrapped(text: &str, size: f64, width: f64) -> Result<Vec<Line>, MissingCharacter> {
    let mut lines = Vec::new();
    for paragraph in text.trim_end().lines() {
        let mut line = String::new();
        for word in paragraph.split([' ', '\t']).filter(|word| !word.is_empty()) {
            let longer = if line.is_empty() { word.to_owned() } else { format!("{line} {word}") };
            if Line::new(&longer, size)?.width <= width {
                line = longer;
                continue;
            }
            if !line.is_empty() {
                lines.push(Line::new(&line, size)?);
            }
            line = break_word(word, size, width, &mut lines)?;
        }
        lines.push(Line::new(&line, size)?);
    }
    Ok(lines)
}

/// Breaks a word that may be too wide: adds its full lines to `lines` and returns the rest.
fn break_word(
    word: &str,
    size: f64,
    width: f64,
    lines: &mut Vec<Line>,
) -> Result<String, MissingCharacter> {
    let mut part = String::new();
    for character in word.chars() {
        let longer = format!("{part}{character}");
        if !part.is_empty() && Line::new(&longer, size)?.width > width {
            lines.push(Line::new(&part, size)?);
            part = character.to_string();
        } else {
            part = longer;
        }
    }
    Ok(part)
}
