//! The embedded font in PostScript (type 42, a TrueType font), and text in it.

use std::collections::BTreeSet;

use super::{SLANT, Text, number};
use crate::postscript::Ascii85;
use crate::typeface;

/// Longest string of PostScript, in bytes.
const MAX_STRING: usize = 65_535;

/// Defines the font with the characters of some lines; nothing if there are none.
pub fn definition<'a>(texts: impl Iterator<Item = &'a Text>, out: &mut Vec<u8>) {
    let characters: BTreeSet<char> = texts.flat_map(|text| text.text.chars()).collect();
    if characters.is_empty() {
        return;
    }
    let bounds = typeface::bounds().map(|em| format!("{em:.4}")).join(" ");
    let font = typeface::font();
    let mut text = format!(
        "12 dict begin\n\
         /FontName /{} def /FontType 42 def /PaintType 0 def\n\
         /FontMatrix [1 0 0 1 0 0] def /FontBBox [{bounds}] def\n\
         /Encoding StandardEncoding def\n\
         /CharStrings {} dict dup begin /.notdef 0 def\n",
        typeface::SUBSET_NAME,
        characters.len() + 1
    );
    for character in characters {
        text +=
            &format!("/{} {} def\n", glyph_name(character), typeface::glyph_id(&font, character));
    }
    text += "end def\n/sfnts [\n";
    out.extend_from_slice(text.as_bytes());
    for part in typeface::parts(MAX_STRING - 1) {
        out.extend_from_slice(b"<~");
        // Interpreters ignore the last byte of each string, which pads it.
        Ascii85::encode(&[part, &[0]].concat(), out);
    }
    out.extend_from_slice(b"] def\nFontName currentdict end definefont pop\n");
}

/// Code that shows a line, each character at its place.
pub fn show(Text { text, places, origin: [x, y], size, is_slanted, .. }: &Text) -> String {
    let slant = number(if *is_slanted { SLANT * size } else { 0.0 });
    let size = number(*size);
    // Rows of the page count downwards, letters stand upright.
    let mut code = format!(
        "/{} findfont [{size} 0 {slant} -{size} 0 0] makefont setfont\n",
        typeface::SUBSET_NAME
    );
    for (character, place) in text.chars().zip(places) {
        code += &format!(
            "{} {} m /{} glyphshow\n",
            number(x + place),
            number(*y),
            glyph_name(character)
        );
    }
    code
}

/// The name by which the Adobe Glyph List finds a character.
fn glyph_name(character: char) -> String {
    format!("uni{:04X}", u32::from(character))
}
