//! PPM: the portable pixmap of the netpbm programs.

use crate::postscript::over_white;
use crate::{Frame, Metadata};

/// The frame as a binary PPM file (P6, 8 bits), transparent pixels composited over white, the
/// metadata in comments.
pub fn encode(frame: &Frame, metadata: &Metadata) -> Vec<u8> {
    let mut file = b"P6\n".to_vec();
    for line in [&metadata.software[..]]
        .into_iter()
        .chain(metadata.comment.lines())
        .filter(|line| !line.is_empty())
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
