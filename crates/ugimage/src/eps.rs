//! Encapsulated PostScript: a picture for a document, in colour.

use crate::postscript::{color_image, history_comments, label_comments};
use crate::{Frame, Label};

/// The frame as an EPS file, one pixel a point.
pub fn encode(frame: &Frame, label: &Label) -> Vec<u8> {
    let mut file = format!(
        "%!PS-Adobe-3.0 EPSF-3.0\n\
         %%BoundingBox: 0 0 {} {}\n\
         {}\
         %%LanguageLevel: 2\n\
         %%DocumentData: Clean7Bit\n\
         %%EndComments\n\
         {}",
        frame.width(),
        frame.height(),
        label_comments(label),
        history_comments(label)
    )
    .into_bytes();
    file.extend(color_image(frame));
    file.extend_from_slice(b"showpage\n%%EOF\n");
    file
}
