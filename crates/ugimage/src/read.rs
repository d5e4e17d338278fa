//! Reads PNG files.

use std::fmt;
use std::io::Cursor;

use png::{ColorType, Decoder, Transformations};

use crate::{Frame, Metadata};

/// Largest number of pixels that is accepted.
const MAX_PIXELS: u64 = 1 << 28;

/// Why a file cannot be read as an image.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ReadError(String);

impl fmt::Display for ReadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for ReadError {}

/// The image of a PNG file of any kind, converted to 8 bits per channel, and its metadata. Colours
/// are assumed to be sRGB.
///
/// # Errors
/// [`ReadError`] if the file is not a PNG, is truncated or corrupt, or has more than 2²⁸ pixels.
pub fn read_png(file: &[u8]) -> Result<(Frame, Metadata), ReadError> {
    if !file.starts_with(b"\x89PNG") {
        return Err(ReadError("not a PNG file".to_owned()));
    }
    let broken = |error: png::DecodingError| {
        let problem = error.to_string();
        ReadError(format!("not a readable PNG file: {}", problem.trim_end_matches('.')))
    };
    let mut decoder = Decoder::new(Cursor::new(file));
    decoder.set_transformations(Transformations::normalize_to_color8());
    let info = decoder.read_header_info().map_err(broken)?;
    let (width, height) = (info.width, info.height);
    if u64::from(width) * u64::from(height) > MAX_PIXELS {
        return Err(ReadError(format!("{width} x {height} pixels exceed the limit of {MAX_PIXELS}")));
    }
    let mut reader = decoder.read_info().map_err(broken)?;
    let size = reader.output_buffer_size().ok_or_else(|| ReadError("too large".to_owned()))?;
    let mut data = vec![0; size];
    let output = reader.next_frame(&mut data).map_err(broken)?;
    // Reads the chunks after the pixels. A file truncated there still has its whole image.
    let _ = reader.finish();
    let data = &data[..output.buffer_size()];
    let (n_channels, is_opaque) = match output.color_type {
        ColorType::Grayscale => (1, true),
        ColorType::GrayscaleAlpha => (2, false),
        ColorType::Rgb | ColorType::Indexed => (3, true),
        ColorType::Rgba => (4, false),
    };
    let mut frame = if is_opaque { Frame::opaque(width, height) } else { Frame::clear(width, height) };
    for (pixel, channels) in frame.pixels_mut().iter_mut().zip(data.chunks_exact(n_channels)) {
        *pixel = match *channels {
            [grey] => [grey, grey, grey, 255],
            [grey, alpha] => [grey, grey, grey, alpha],
            [red, green, blue] => [red, green, blue, 255],
            [red, green, blue, alpha, ..] => [red, green, blue, alpha],
            [] => *pixel,
        };
    }
    Ok((frame, metadata(reader.info())))
}

fn metadata(info: &png::Info<'_>) -> Metadata {
    let latin = info.uncompressed_latin1_text.iter().map(|chunk| (chunk.keyword.clone(), chunk.text.clone()));
    let packed =
        info.compressed_latin1_text.iter().map(|chunk| (chunk.keyword.clone(), chunk.get_text().ok()));
    let wide = info.utf8_text.iter().map(|chunk| (chunk.keyword.clone(), chunk.get_text().ok()));
    let others = packed.chain(wide).filter_map(|(key, text)| Some((key, text?)));
    let mut texts: Vec<(String, String)> = latin.chain(others).collect();
    let mut take = |key: &str| {
        let at = texts.iter().position(|(other, _)| other == key);
        at.map(|at| texts.swap_remove(at).1).unwrap_or_default()
    };
    Metadata { software: take("Software"), comment: take("Comment") }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Format;
    use crate::frame::test_frames;

    #[test]
    fn png_round_trip() {
        for comment in ["uglorentz -vel .9 0 0\nugrainbow", "γ = 2", ""] {
            let metadata = Metadata { software: "ug 1".into(), comment: comment.into() };
            for frame in test_frames() {
                assert_eq!(
                    read_png(&Format::Png.encode(&frame, &metadata)).unwrap(),
                    (frame, metadata.clone())
                );
            }
        }
    }

    #[test]
    fn sixteen_bits_and_greys_are_read() {
        for frame in test_frames() {
            let (deep, _) = read_png(&Format::Png16.encode(&frame, &Metadata::default())).unwrap();
            let near = |(a, b): (&[u8; 4], &[u8; 4])| a.iter().zip(b).all(|(a, b)| a.abs_diff(*b) <= 1);
            assert!(deep.pixels().iter().zip(frame.pixels()).all(near));
        }
        let mut file = Vec::new();
        let mut encoder = png::Encoder::new(&mut file, 3, 1);
        encoder.set_color(ColorType::Grayscale);
        encoder.set_depth(png::BitDepth::Two);
        encoder.write_header().unwrap().write_image_data(&[0b0001_1100]).unwrap();
        let (frame, _) = read_png(&file).unwrap();
        assert_eq!(frame.pixels(), [[0, 0, 0, 255], [85, 85, 85, 255], [255, 255, 255, 255]]);
    }

    #[test]
    fn broken_files_are_refused() {
        let file = Format::Png.encode(&test_frames()[2], &Metadata::default());
        assert!(read_png(b"").is_err());
        assert_eq!(read_png(b"GIF89a").unwrap_err().to_string(), "not a PNG file");
        assert!(
            read_png(b"\x89PNG\r\n\x1a\n").unwrap_err().to_string().starts_with("not a readable PNG file: ")
        );
        for length in 0..file.len() - 30 {
            assert!(read_png(&file[..length]).is_err(), "{length}");
        }
        let mut huge = file;
        huge[16..20].copy_from_slice(&0x7fff_ffff_u32.to_be_bytes());
        assert!(read_png(&huge).is_err());
    }
}
