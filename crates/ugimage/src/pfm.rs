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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_have_the_position_and_byte_order_of_the_format() {
        for frame in crate::test_frames::linear_frames() {
            let file = encode(&frame);
            let (width, height) = (frame.width() as usize, frame.height() as usize);
            let data = &file[file.len() - 12 * width * height..];
            assert_eq!(file[..file.len() - data.len()], *format!("PF\n{width} {height}\n-1.0\n").as_bytes());
            for y in 0..height {
                for x in 0..width {
                    let at = 12 * ((height - 1 - y) * width + x);
                    for (bytes, light) in
                        data[at..at + 12].chunks(4).zip(frame.light_of(frame.pixels()[y * width + x]))
                    {
                        assert_eq!(f32::from_le_bytes(bytes.try_into().unwrap()), light);
                    }
                }
            }
        }
    }
}
