//! Reads pictures of several formats: PNG, JPEG, Radiance HDR, OpenEXR and PFM.

use std::io::Cursor;

use exr::compression::Compression;
use exr::meta::attribute::ChannelDescription;
use exr::meta::header::Header;
use exr::prelude::{ReadChannels, ReadLayers, ReadSpecificChannel, pixel_vec::PixelVec, read as exr_reader};
use zune_jpeg::JpegDecoder;
use zune_jpeg::zune_core::bytestream::ZCursor;
use zune_jpeg::zune_core::colorspace::ColorSpace;
use zune_jpeg::zune_core::options::DecoderOptions;

use crate::read::{
    MOST_INFLATED, PictureLimits, ReadError, check_packed, is_png_deep, read_png, read_png_light, reserved,
};
use crate::{read_hdr, read_pfm};

/// The pixels of a picture, row after row from the top.
#[derive(Clone, Debug, PartialEq)]
pub enum Pixels {
    /// Display-encoded sRGB, and alpha.
    Srgb(Vec<[u8; 4]>),
    /// Linear light with the sRGB primaries, not multiplied by alpha; white is 1. Numbers that are
    /// not finite occur as they are in the file.
    Light(Vec<[f32; 4]>),
}

impl Pixels {
    /// Their bytes in memory.
    pub fn n_bytes(&self) -> u64 {
        match self {
            Self::Srgb(pixels) => size_of_val(pixels.as_slice()) as u64,
            Self::Light(pixels) => size_of_val(pixels.as_slice()) as u64,
        }
    }
}

/// Reads a picture, by the first bytes of its file: PNG, JPEG, Radiance HDR, OpenEXR or PFM.
/// Returns its size and its pixels. Memory is used only for pixels that the file has.
///
/// Colours of PNG and JPEG are assumed to be sRGB; PNG files with 16 bits per channel are converted
/// to light. Those of the others are assumed to be linear light with the primaries of sRGB.
/// Colour profiles and the orientation that cameras note are not used.
///
/// # Errors
/// [`ReadError`] if the file is of another kind, is truncated or corrupt, exceeds the limits, or
/// does not fit in memory.
pub fn read_picture(file: &[u8], limits: &PictureLimits) -> Result<([u32; 2], Pixels), ReadError> {
    match file {
        [0x89, b'P', b'N', b'G', ..] if is_png_deep(file) => {
            read_png_light(file, limits).map(|(size, pixels)| (size, Pixels::Light(pixels)))
        }
        [0x89, b'P', b'N', b'G', ..] => {
            let (frame, _) = read_png(file, limits)?;
            let size = [frame.width(), frame.height()];
            Ok((size, Pixels::Srgb(frame.into_pixels())))
        }
        [0xff, 0xd8, 0xff, ..] => jpeg(file, limits),
        [b'#', b'?', ..] => read_hdr::read(file, limits).map(|(size, pixels)| (size, Pixels::Light(pixels))),
        [0x76, 0x2f, 0x31, 0x01, ..] => exr(file, limits),
        [b'P', b'F' | b'f', b' ' | b'\r' | b'\n', ..] => {
            read_pfm::read(file, limits).map(|(size, pixels)| (size, Pixels::Light(pixels)))
        }
        _ => Err(ReadError::new("not a picture of a kind that is read: PNG, JPEG, HDR, EXR or PFM")),
    }
}

fn broken(kind: &str, error: &dyn std::fmt::Display) -> ReadError {
    let problem = error.to_string();
    ReadError::new(&format!("not a readable {kind} file: {}", problem.trim_end_matches('.')))
}

fn jpeg(file: &[u8], limits: &PictureLimits) -> Result<([u32; 2], Pixels), ReadError> {
    /// Bytes of a pixel: red, green, blue and alpha.
    const N_BYTES: usize = 4;
    /// Bytes of its coefficients, which a progressive file needs all at once.
    const N_BYTES_OF_COEFFICIENTS: usize = 6;
    let broken = |error: &dyn std::fmt::Display| broken("JPEG", error);
    // The decoder fills what is missing of a truncated file with grey.
    let Some(Packed { n_bytes: n_packed, is_progressive }) = packed(file) else {
        return Err(broken(&"the file is truncated"));
    };
    let options = DecoderOptions::default()
        .jpeg_set_out_colorspace(ColorSpace::RGBA)
        .set_max_width(usize::from(u16::MAX))
        .set_max_height(usize::from(u16::MAX));
    let mut decoder = JpegDecoder::new_with_options(ZCursor::new(file), options);
    decoder.decode_headers().map_err(|error| broken(&error))?;
    let (width, height) = decoder.dimensions().ok_or_else(|| broken(&"it has no size"))?;
    let n_bytes = N_BYTES + if is_progressive { N_BYTES_OF_COEFFICIENTS } else { 0 };
    let size = limits.check([width, height], n_bytes as u64)?;
    let n_pixels = width * height;
    // Each block of 64 pixels has a bit or more.
    check_packed(n_packed, n_pixels as u64, 8 * 64)?;
    if decoder.output_buffer_size() != Some(N_BYTES * n_pixels) {
        return Err(broken(&"its colours are not red, green and blue"));
    }
    // Reserved before the decoder allocates as much.
    drop(reserved::<u8>(n_bytes * n_pixels)?);
    let mut pixels = vec![[0; N_BYTES]; n_pixels];
    decoder.decode_into(pixels.as_flattened_mut()).map_err(|error| broken(&error))?;
    Ok((size, Pixels::Srgb(pixels)))
}

/// What holds the pixels of a JPEG file.
struct Packed {
    /// Number of bytes that are not in segments with a length of their own.
    n_bytes: usize,
    is_progressive: bool,
}

/// Finds the bytes of a JPEG file that hold its pixels; `None` if no end-of-image marker ends its
/// segments. What follows it, such as a film that telephones append, is not looked at.
fn packed(file: &[u8]) -> Option<Packed> {
    let (mut at, mut n_bytes, mut is_progressive) = (2, 0, false);
    loop {
        // The next marker: in compressed data FF is followed by 0 or by a restart marker.
        let mut pairs = file.get(at..)?.windows(2);
        let skip = pairs.position(|pair| pair[0] == 0xff && !matches!(pair[1], 0 | 0xd0..=0xd7 | 0xff))?;
        at += skip + 2;
        n_bytes += skip;
        match file[at - 1] {
            0xd9 => return Some(Packed { n_bytes, is_progressive }),
            // Markers without a length.
            0x01 | 0xd8 => {}
            marker => {
                is_progressive |= marker == 0xc2;
                let &[high, low] = file.get(at..at + 2)? else { return None };
                at += usize::from(u16::from_be_bytes([high, low])).max(2);
            }
        }
    }
}

fn exr(file: &[u8], limits: &PictureLimits) -> Result<([u32; 2], Pixels), ReadError> {
    /// Of headers, as the decoder of pixels checks them.
    const PEDANTIC: bool = true;
    let broken = |error: &dyn std::fmt::Display| broken("EXR", error);
    let headers = exr::meta::MetaData::read_from_buffered(Cursor::new(file), PEDANTIC);
    let headers = headers.map_err(|error| broken(&error))?;
    // The first layer with these channels is read, so none may be too large.
    for header in headers.headers.iter().filter(|header| !header.deep) {
        check_layer(header, file.len(), limits)?;
    }
    let image = exr_reader()
        .no_deep_data()
        .largest_resolution_level()
        .specific_channels()
        .required("R")
        .required("G")
        .required("B")
        .optional("A", 1.0_f32)
        .collect_pixels(
            |resolution, _| PixelVec { resolution, pixels: vec![[0.0_f32; 4]; resolution.area()] },
            |image, position, (red, green, blue, alpha): (f32, f32, f32, f32)| {
                let idx = position.flat_index_for_size(image.resolution);
                image.pixels[idx] = [red, green, blue, alpha];
            },
        )
        .first_valid_layer()
        .all_attributes()
        .non_parallel()
        .from_buffered(Cursor::new(file));
    let image = image.map_err(|error| broken(&error))?;
    let data = image.layer_data.channel_data.pixels;
    let size = limits.check([data.resolution.width(), data.resolution.height()], N_BYTES_OF_LIGHT)?;
    let mut pixels = data.pixels;
    // Colours of EXR files are multiplied by alpha.
    for [red, green, blue, alpha] in &mut pixels {
        if *alpha > 0.0 && *alpha < 1.0 {
            [*red, *green, *blue] = [*red / *alpha, *green / *alpha, *blue / *alpha];
        }
    }
    Ok((size, Pixels::Light(pixels)))
}

/// Bytes of a pixel of light.
const N_BYTES_OF_LIGHT: u64 = size_of::<[f32; 4]>() as u64;

/// Refuses a layer that is too large, or for which a file of `n_file` bytes has not enough.
fn check_layer(header: &Header, n_file: usize, limits: &PictureLimits) -> Result<(), ReadError> {
    /// Bytes in the file for each block of pixels: its place, its row, its size.
    const N_BYTES_OF_BLOCK: u64 = 16;
    let size = limits.check([header.layer_size.width(), header.layer_size.height()], N_BYTES_OF_LIGHT)?;
    let n_pixels = size[0] as usize * size[1] as usize;
    let n_bytes = |channel: &ChannelDescription| {
        // A channel may have one sample for several pixels. The decoder refuses one for none.
        let n_along = |side: u32, sampling: usize| u64::from(side) / (sampling as u64).max(1);
        let n_samples = n_along(size[0], channel.sampling.x()) * n_along(size[1], channel.sampling.y());
        channel.sample_type.bytes_per_sample() as u64 * n_samples
    };
    let n_stored = header.channels.list.iter().map(n_bytes).fold(0, u64::saturating_add);
    let ratio = match header.compression {
        Compression::Uncompressed => 1,
        // Runs of 128 bytes have two.
        Compression::RLE => 64,
        // Some store 3 of 4 bytes first.
        _ => MOST_INFLATED * 4 / 3,
    };
    check_packed(n_file, n_stored, ratio)?;
    check_packed(n_file, N_BYTES_OF_BLOCK * header.chunk_count as u64, 1)?;
    // Reserved before the decoder allocates as much; it is used only for pixels that are read.
    drop(reserved::<[f32; 4]>(n_pixels)?);
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Compression, Format, LinearFrame, Metadata};

    /// Bars of 64 x 32 pixels; the upper left is black.
    const BARS: &[u8] = include_bytes!("../tests/bars.jpg");

    fn read(file: &[u8]) -> Result<([u32; 2], Pixels), ReadError> {
        read_picture(file, &PictureLimits::default())
    }

    #[test]
    fn jpeg_files_are_read_whole_or_not_at_all() {
        let file = BARS;
        let (size, pixels) = read(file).unwrap();
        let Pixels::Srgb(pixels) = pixels else { panic!("8 bits") };
        assert_eq!((size, pixels.len()), ([64, 32], 64 * 32));
        // Colours of several bars, at the lower edge.
        let bottom = &pixels[31 * 64..];
        assert!(bottom.iter().any(|pixel| pixel[0] > 150) && bottom.iter().any(|pixel| pixel[2] > 150));
        for length in 0..file.len() {
            assert!(read(&file[..length]).is_err(), "{length}");
        }
        // What telephones append is not looked at.
        let longer = [file, b"and a film"].concat();
        assert_eq!(read(&longer).unwrap(), (size, Pixels::Srgb(pixels)));
    }

    #[test]
    fn light_is_read_as_it_was_written() {
        let pixel = |idx: u32| [idx as f32 * 0.25, 1.5, 0.0, 1.0];
        let frame = LinearFrame::new([8, 4], true, (0..32).map(pixel).collect());
        for format in [Format::Exr, Format::Hdr] {
            let file = format.encode_linear(&frame, &Metadata::default(), Compression::Fast);
            let (size, pixels) = read(&file).unwrap();
            let Pixels::Light(pixels) = pixels else { panic!("light") };
            assert_eq!(size, [8, 4]);
            for (found, expected) in pixels.iter().zip(frame.pixels()) {
                let error = (0..4).map(|i| (found[i] - expected[i]).abs()).fold(0.0, f32::max);
                assert!(error <= 0.01 * expected[0].max(1.5), "{format:?}: {found:?} {expected:?}");
            }
            for length in (0..file.len() - 1).step_by(7) {
                assert!(read(&file[..length]).is_err(), "{format:?} {length}");
            }
        }
    }

    /// 16 bits are not rounded to 8.
    #[test]
    fn deep_png_files_are_light() {
        for is_opaque in [true, false] {
            let alpha = if is_opaque { 1.0 } else { 0.25 };
            let pixel = |idx: u32| [0.002 + 1e-5 * idx as f32, 0.5 + 1e-4 * idx as f32, 1.0, alpha];
            let frame = LinearFrame::new([8, 4], is_opaque, (0..32).map(pixel).collect());
            let file = Format::Png16.encode_linear(&frame, &Metadata::default(), Compression::Fast);
            let (size, pixels) = read(&file).unwrap();
            let Pixels::Light(pixels) = pixels else { panic!("light") };
            assert_eq!(size, [8, 4]);
            for (found, expected) in pixels.iter().zip(frame.pixels()) {
                let error = (0..4).map(|i| (found[i] - expected[i]).abs()).fold(0.0, f32::max);
                assert!(error < 2e-5, "{found:?} {expected:?}");
            }
            for length in (0..file.len() - 12).step_by(7) {
                assert!(read(&file[..length]).is_err(), "{length}");
            }
        }
    }

    /// Headers of pictures that are too large for their files, or for any.
    #[test]
    fn large_headers_are_refused() {
        let hdr = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1000000 +X 1000000\n";
        assert!(read(hdr).unwrap_err().to_string().contains("exceed the limit"));
        let hdr = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 5000 +X 20000\n";
        assert!(read(hdr).unwrap_err().to_string().contains("truncated"));
        let hdr = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 10000 +X 20000\n";
        assert_eq!(read(hdr).unwrap_err().needed_memory(), Some(3_200_000_000));
        // The size in the header of a small file, changed.
        let frame = LinearFrame::new([8, 4], true, vec![[0.25, 1.5, 0.0, 1.0]; 32]);
        let mut exr = Format::Exr.encode_linear(&frame, &Metadata::default(), Compression::Fast);
        let corner = |x: u32| [x.to_le_bytes(), 3_u32.to_le_bytes()].concat();
        while let Some(at) = exr.windows(8).position(|bytes| bytes == corner(7)) {
            exr[at..at + 8].copy_from_slice(&corner(0xf_ffff));
        }
        assert!(read(&exr).unwrap_err().to_string().contains("header is wrong"));
        let mut jpeg = BARS.to_vec();
        let frame = jpeg.windows(2).position(|pair| matches!(pair, [0xff, 0xc0..=0xc2])).unwrap();
        jpeg[frame + 5..frame + 9].copy_from_slice(&[0x0f, 0xff, 0xff, 0xff]);
        assert!(read(&jpeg).unwrap_err().to_string().contains("header is wrong"));
    }

    #[test]
    fn a_sample_for_no_pixels_is_refused() {
        let frame = LinearFrame::new([8, 4], true, vec![[0.25, 1.5, 0.0, 1.0]; 32]);
        let mut exr = Format::Exr.encode_linear(&frame, &Metadata::default(), Compression::Fast);
        // The first channel: its name, its type, whether it is linear, and a pixel for each sample.
        let channel = b"B\0\x02\0\0\0\0\0\0\0\x01\0\0\0\x01\0\0\0";
        let at = exr.windows(channel.len()).position(|bytes| bytes == channel).unwrap();
        exr[at + 10] = 0;
        assert!(read(&exr).is_err());
    }

    /// The smallest files of large pictures are read: of one colour, as packed as their formats
    /// allow.
    #[test]
    fn plain_pictures_are_read() {
        let frame = LinearFrame::new([2048, 1024], true, vec![[0.0, 0.0, 0.0, 1.0]; 2048 * 1024]);
        for format in [Format::Exr, Format::Hdr, Format::Png, Format::Png16] {
            let file = format.encode_linear(&frame, &Metadata::default(), Compression::Small);
            assert_eq!(read(&file).unwrap().0, [2048, 1024], "{format:?}");
        }
    }
}
