//! PFM (P. Debevec): a header of three lines and 32-bit floating point samples, rows from bottom to
//! top.

use crate::LinearFrame;

/// The light as a PFM file: linear red, green and blue as little-endian `f32`, unclipped. The
/// format has neither text nor alpha: transparent pixels are composited over black.
pub fn encode(frame: &LinearFrame) -> Vec<u8> {
    let mut file = format!("PF\n{} {}\n-1.0\n", frame.width(), frame.height()).into_bytes();
    file.reserve(12 * frame.pixels().len());
    for row in frame.pixels().chunks(frame.width() as usize).rev() {
        for channel in row.iter().flat_map(|&pixel| frame.light_of(pixel)) {
            file.extend_from_slice(&channel.to_le_bytes());
        }
    }
    file
}
