//! PPM: the portable pixmap of the netpbm programs.

use crate::postscript::over_white;
use crate::{Frame, Metadata};

/// The frame as a binary PPM file (P6, 8 bits), transparent pixels composited over white, the
/// metadata in comments.
pub fn encode(frame: &Frame, metadata: &Metadata) -> Vec<u8> {
    let mut file = b"P6\n".to_vec();
    for line in
        [&metadata.software[..]].into_iter().chain(metadata.comment.lines()).filter(|line| !line.is_empty())
    {
        let line: String = line.chars().map(|c| if c.is_control() { '?' } else { c }).collect();
        file.extend_from_slice(format!("# {line}\n").as_bytes());
    }
    file.extend_from_slice(format!("{} {}\n255\n", frame.width(), frame.height()).as_bytes());
    let pixels = over_white(frame);
    file.reserve_exact(pixels.as_flattened().len());
    file.extend_from_slice(pixels.as_flattened());
    file
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn another_reader_reads_the_same_pixels() {
        let metadata =
            Metadata { software: "ug 1".into(), comment: "ug -sz 3 2\nug γ".into(), ..Metadata::default() };
        for frame in crate::test_frames::frames() {
            let file = encode(&frame, &metadata);
            let read =
                image::load_from_memory_with_format(&file, image::ImageFormat::Pnm).unwrap().into_rgb8();
            assert_eq!(read.dimensions(), (frame.width(), frame.height()));
            assert_eq!(read.as_raw()[..], *over_white(&frame).as_flattened());
        }
    }
}
