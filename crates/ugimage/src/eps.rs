//! Encapsulated PostScript: a colour image to be placed in a document.

use crate::postscript::{color_image, creator_comment, history_comments};
use crate::{Frame, Metadata};

/// The frame as an EPS file, one pixel per point, or as many as its metadata state.
pub fn encode(frame: &Frame, metadata: &Metadata) -> Vec<u8> {
    let points = metadata.points([frame.width(), frame.height()]);
    wrap(points, 2, metadata, &color_image(frame, points))
}

/// Makes an EPS file of the PostScript code `drawing`, which draws `width` × `height` points.
pub fn wrap([width, height]: [u32; 2], level: u32, metadata: &Metadata, drawing: &[u8]) -> Vec<u8> {
    let mut file = format!(
        "%!PS-Adobe-3.0 EPSF-3.0\n\
         %%BoundingBox: 0 0 {width} {height}\n\
         {}\
         %%LanguageLevel: {level}\n\
         %%DocumentData: Clean7Bit\n\
         %%EndComments\n\
         {}",
        creator_comment(metadata),
        history_comments(metadata)
    )
    .into_bytes();
    file.extend_from_slice(drawing);
    file.extend_from_slice(b"showpage\n%%EOF\n");
    file
}
