//! The embedded font in PDF: a font of glyph numbers, with the characters that they stand for.

use std::collections::BTreeMap;

use pdf_writer::types::{CidFontType, FontFlags, SystemInfo, UnicodeCmap};
use pdf_writer::{Filter, Finish, Name, Pdf, Rect, Ref, Str};

use super::Text;
use crate::pdf::deflate;
use crate::typeface;

/// The name of the font in the resources of the page.
pub const FONT_NAME: &[u8] = b"F";

/// Glyphs are numbered as in the font file.
const SYSTEM: SystemInfo<'static> =
    SystemInfo { registry: Str(b"Adobe"), ordering: Str(b"Identity"), supplement: 0 };

/// Height of capital letters, and width of stems, in em.
const CAP_HEIGHT: f32 = 0.729;
const STEM: f32 = 0.088;

/// Units of metrics per em.
const PER_EM: f64 = 1000.0;

/// The glyphs that a figure uses, with their widths and characters.
pub struct PdfFont {
    glyphs: BTreeMap<u16, (f64, char)>,
    numbers: BTreeMap<char, u16>,
}

impl PdfFont {
    /// The font with the characters of some lines.
    pub fn of<'a>(texts: impl Iterator<Item = &'a Text>) -> Self {
        let font = typeface::font();
        let (mut glyphs, mut numbers) = (BTreeMap::new(), BTreeMap::new());
        for character in texts.flat_map(|text| text.text.chars()) {
            let glyph =
                *numbers.entry(character).or_insert_with(|| typeface::glyph_id(&font, character));
            glyphs.entry(glyph).or_insert_with(|| (typeface::advance(&font, glyph), character));
        }
        Self { glyphs, numbers }
    }

    /// True if no characters are used.
    pub fn is_empty(&self) -> bool {
        self.glyphs.is_empty()
    }

    /// A line as bytes to show, each followed by the adjustment in 1/1000 em to the left that brings
    /// the next character to its place.
    pub fn runs(&self, text: &Text) -> Vec<(Vec<u8>, f32)> {
        let mut runs = Vec::new();
        let mut run = Vec::new();
        for (idx, (character, place)) in text.text.chars().zip(&text.places).enumerate() {
            let glyph = self.numbers.get(&character).copied().unwrap_or_default();
            run.extend(glyph.to_be_bytes());
            let Some(next) = text.places.get(idx + 1) else { break };
            let width = self.glyphs.get(&glyph).map_or(0.0, |(width, _)| *width);
            // Kerning is in units of the font, which are larger than this.
            let adjustment = (PER_EM * (width - (next - place) / text.size) * 10.0).round() / 10.0;
            if adjustment != 0.0 {
                runs.push((std::mem::take(&mut run), adjustment as f32));
            }
        }
        runs.push((run, 0.0));
        runs
    }

    /// Writes the objects of the font; `id` is that of the first, the others follow it.
    pub fn write(&self, pdf: &mut Pdf, id: Ref) {
        let [cid, descriptor, file, characters] =
            [1, 2, 3, 4].map(|step| Ref::new(id.get() + step));
        let name = Name(typeface::SUBSET_NAME.as_bytes());
        let mut font = pdf.type0_font(id);
        font.base_font(name).encoding_predefined(Name(b"Identity-H"));
        font.descendant_font(cid).to_unicode(characters);
        font.finish();
        let mut font = pdf.cid_font(cid);
        font.subtype(CidFontType::Type2)
            .base_font(name)
            .system_info(SYSTEM)
            .font_descriptor(descriptor);
        font.default_width(0.0).cid_to_gid_map_predefined(Name(b"Identity"));
        let mut widths = font.widths();
        for (&glyph, &(width, _)) in &self.glyphs {
            widths.consecutive(glyph, [(PER_EM * width) as f32]);
        }
        widths.finish();
        font.finish();
        let [left, bottom, right, top] = typeface::bounds().map(|em| (PER_EM * em) as f32);
        let mut metrics = pdf.font_descriptor(descriptor);
        metrics.name(name).flags(FontFlags::NON_SYMBOLIC).bbox(Rect::new(left, bottom, right, top));
        metrics.italic_angle(0.0).ascent(top).descent(bottom);
        metrics.cap_height(1000.0 * CAP_HEIGHT).stem_v(1000.0 * STEM).font_file2(file);
        metrics.finish();
        let data = deflate(typeface::FILE);
        let mut stream = pdf.stream(file, &data);
        stream.filter(Filter::FlateDecode);
        stream.pair(Name(b"Length1"), typeface::FILE.len() as i32);
        stream.finish();
        let mut map = UnicodeCmap::new(Name(b"UgCharacters"), SYSTEM);
        for (&glyph, &(_, character)) in &self.glyphs {
            map.pair(glyph, character);
        }
        let data = deflate(map.finish().as_slice());
        pdf.cmap(characters, &data).filter(Filter::FlateDecode);
    }
}
