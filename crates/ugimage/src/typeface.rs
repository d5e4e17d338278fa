//! The embedded font: DejaVu Sans, a part of it; its licence is in the folder `font`.

use ab_glyph::{Font, FontRef, GlyphId};

/// The font file, TrueType.
pub const FILE: &[u8] = include_bytes!("../font/DejaVuSans.ttf");

/// The name of the family, by which systems find the whole font.
pub const FAMILY: &str = "DejaVu Sans";

/// The PostScript name. The six letters and the plus say that it is a part of the font.
pub const SUBSET_NAME: &str = "UGRAIN+DejaVuSans";

/// The font, parsed.
pub fn font() -> FontRef<'static> {
    FontRef::try_from_slice(FILE).expect("the embedded font is valid")
}

/// The number of a character's glyph; 0 if the font lacks the character.
pub fn glyph_id(font: &FontRef<'static>, character: char) -> u16 {
    font.glyph_id(character).0
}

/// Font units per em.
pub fn units_per_em(font: &FontRef<'static>) -> f64 {
    f64::from(font.units_per_em().expect("the embedded font has units per em"))
}

/// The width of a glyph without kerning, in em.
pub fn advance(font: &FontRef<'static>, glyph: u16) -> f64 {
    f64::from(font.h_advance_unscaled(GlyphId(glyph))) / units_per_em(font)
}

/// The box around all glyphs: left, bottom, right, top, in em.
pub fn bounds() -> [f64; 4] {
    let head = tables().find(|(tag, _)| tag == b"head").expect("the embedded font has a head").1;
    let number = |at: usize| i16::from_be_bytes([FILE[head + at], FILE[head + at + 1]]);
    let per_em = f64::from(number(18));
    [36, 38, 40, 42].map(|at| f64::from(number(at)) / per_em)
}

/// The file cut at the beginnings of tables into parts of at most `most` bytes, as far as tables
/// allow.
pub fn parts(most: usize) -> Vec<&'static [u8]> {
    let mut cuts: Vec<usize> = tables().map(|(_, start)| start).collect();
    cuts.sort_unstable();
    cuts.push(FILE.len());
    let mut parts = Vec::new();
    let (mut start, mut end) = (0, 0);
    for cut in cuts {
        if cut - start > most && end > start {
            parts.push(&FILE[start..end]);
            start = end;
        }
        end = cut;
    }
    parts.push(&FILE[start..]);
    parts
}

/// The tag and the place of each table.
fn tables() -> impl Iterator<Item = (&'static [u8], usize)> {
    let n_tables = usize::from(u16::from_be_bytes([FILE[4], FILE[5]]));
    FILE[12..].chunks_exact(16).take(n_tables).map(|entry| {
        (&entry[..4], u32::from_be_bytes([entry[8], entry[9], entry[10], entry[11]]) as usize)
    })
}
