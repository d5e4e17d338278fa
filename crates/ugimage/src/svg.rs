//! SVG: an image embedded as PNG, one pixel per user unit, or as many as its metadata state.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

use crate::png::Compression;
use crate::{Frame, Metadata, png};

/// The frame as an SVG file; transparency is kept.
pub fn encode(frame: &Frame, metadata: &Metadata) -> Vec<u8> {
    let size @ [width, height] = metadata.points([frame.width(), frame.height()]);
    // No metadata in the embedded PNG: the SVG file has it already.
    let picture = STANDARD.encode(png::encode(frame, &Metadata::default(), Compression::Fast));
    let image = format!(
        "<image width=\"{width}\" height=\"{height}\" image-rendering=\"pixelated\" \
         href=\"data:image/png;base64,{picture}\"/>\n"
    );
    document(size, metadata, &image)
}

/// Makes a file of the SVG elements `drawing`, which draw `width` × `height` points. The metadata
/// becomes its description.
pub fn document([width, height]: [u32; 2], metadata: &Metadata, drawing: &str) -> Vec<u8> {
    let words = [metadata.software.as_str(), metadata.comment.as_str()];
    let words: Vec<String> =
        words.into_iter().filter(|text| !text.is_empty()).map(escaped).collect();
    let description = if words.is_empty() {
        String::new()
    } else {
        format!("<desc>{}</desc>\n", words.join("\n"))
    };
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}pt\" height=\"{height}pt\" \
         viewBox=\"0 0 {width} {height}\">\n{description}{drawing}</svg>\n"
    )
    .into_bytes()
}

/// Escapes text for XML. Most control characters are not allowed in XML and become `?`.
pub fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out += "&amp;",
            '<' => out += "&lt;",
            '>' => out += "&gt;",
            '\n' | '\t' => out.push(c),
            c if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') => out.push('?'),
            c => out.push(c),
        }
    }
    out
}
