//! Greyscale PostScript, as the 1988 renderer wrote it for laser printers: level 1, an 8-bit
//! `image` in hexadecimal.

use ugphysics::{luminance, srgb_encode};

use crate::postscript::{creator_comment, decode_table, history_comments, over_white};
use crate::{Frame, Metadata};

/// Longest string of a PostScript level 1 interpreter, in bytes.
const MAX_STRING: u32 = 65_535;

/// The frame as greyscale PostScript, one pixel per point.
///
/// The grey level is the display-encoded luminance, computed in linear light. Transparent pixels
/// are composited over white.
pub fn grey_postscript(frame: &Frame, metadata: &Metadata) -> Vec<u8> {
    let (width, height) = (frame.width(), frame.height());
    let mut file = format!(
        "%!PS-Adobe-2.0 EPSF-2.0\n\
         %%BoundingBox: 0 0 {width} {height}\n\
         {}\
         %%EndComments\n\
         {}\
         gsave\n\
         /line {} string def\n\
         {width} {height} scale\n\
         {width} {height} 8 [{width} 0 0 -{height} 0 {height}]\n\
         {{ currentfile line readhexstring pop }} image\n",
        creator_comment(metadata),
        history_comments(metadata),
        string_len(width)
    )
    .into_bytes();
    push_hex(&mut file, &grey_levels(frame));
    file.extend_from_slice(b"grestore\nshowpage\n%%EOF\n");
    file
}

/// Length of the string that each `readhexstring` fills. It divides the row length, so that the
/// last string ends with the image data.
fn string_len(width: u32) -> u32 {
    (1..=width.min(MAX_STRING)).rev().find(|len| width.is_multiple_of(*len)).unwrap_or(1)
}

fn grey_levels(frame: &Frame) -> Vec<u8> {
    let linear = decode_table();
    let mut last = ([0; 3], 0);
    let mut grey = |rgb: [u8; 3]| {
        if rgb != last.0 {
            let light = luminance(rgb.map(|level| linear[usize::from(level)]));
            last = (rgb, (255.0 * srgb_encode(light)).round() as u8);
        }
        last.1
    };
    over_white(frame).into_iter().map(&mut grey).collect()
}

fn push_hex(out: &mut Vec<u8>, bytes: &[u8]) {
    const DIGITS: &[u8; 16] = b"0123456789abcdef";
    for line in bytes.chunks(40) {
        for &byte in line {
            out.extend([DIGITS[usize::from(byte >> 4)], DIGITS[usize::from(byte & 15)]]);
        }
        out.push(b'\n');
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::test_frames;
    use crate::postscript::decode;

    #[test]
    fn pixels_round_trip() {
        for frame in test_frames() {
            let file = grey_postscript(&frame, &Metadata::default());
            let levels = decode::hex(decode::between(&file, "image\n", "grestore"));
            assert_eq!(levels.len(), frame.pixels().len());
            for (level, [r, g, b]) in levels.into_iter().zip(over_white(&frame)) {
                // Luminance with the published weights of ITU-R BT.709.
                let [r, g, b] = [r, g, b].map(|level| ugphysics::srgb_decode(f64::from(level) / 255.0));
                let light = 0.2126 * r + 0.7152 * g + 0.0722 * b;
                let exact = 255.0 * srgb_encode(light);
                assert!((f64::from(level) - exact).abs() < 0.52, "{level} for {exact}");
            }
        }
    }

    #[test]
    fn greys_are_unchanged() {
        let mut frame = Frame::opaque(256, 1);
        frame
            .pixels_mut()
            .iter_mut()
            .zip(0..=255)
            .for_each(|(pixel, level)| *pixel = [level, level, level, 255]);
        let expected: Vec<u8> = (0..=255).collect();
        assert_eq!(grey_levels(&frame), expected);
    }

    #[test]
    fn strings_fit_level_1() {
        let rows = [(1, 1), (1024, 1024), (65_535, 65_535), (65_536, 32_768), (131_071, 1)];
        for (width, len) in rows {
            assert_eq!(string_len(width), len);
        }
    }
}
