//! PostScript: one colour page of the size of the image.

use crate::postscript::{color_image, creator_comment, history_comments};
use crate::{Frame, Metadata};

/// The frame as a PostScript document of one page, one pixel per point, or as many as its metadata state.
pub fn encode(frame: &Frame, metadata: &Metadata) -> Vec<u8> {
    let points = metadata.points([frame.width(), frame.height()]);
    wrap(points, 2, metadata, &color_image(frame, points))
}

/// Makes a one-page document of the PostScript code `drawing`, which draws `width` × `height`
/// points.
pub fn wrap([width, height]: [u32; 2], level: u32, metadata: &Metadata, drawing: &[u8]) -> Vec<u8> {
    let mut file = format!(
        "%!PS-Adobe-3.0\n\
         %%BoundingBox: 0 0 {width} {height}\n\
         {}\
         %%LanguageLevel: {level}\n\
         %%DocumentData: Clean7Bit\n\
         %%Pages: 1\n\
         %%EndComments\n\
         {}\
         %%BeginSetup\n\
         << /PageSize [{width} {height}] >> setpagedevice\n\
         %%EndSetup\n\
         %%Page: 1 1\n",
        creator_comment(metadata),
        history_comments(metadata)
    )
    .into_bytes();
    file.extend_from_slice(drawing);
    file.extend_from_slice(b"showpage\n%%Trailer\n%%EOF\n");
    file
}
