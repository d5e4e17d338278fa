//! PNG, written with the `png` crate.

use std::io::Write;

use png::{
    BitDepth, ColorType, Encoder, EncodingError, PixelDimensions, SrgbRenderingIntent, Unit,
};

use ugphysics::srgb_encode;

use crate::{Frame, LinearFrame, Metadata};

/// Keyword of the chunk `iTXt` with XMP metadata.
pub(crate) const XMP: &str = "XML:com.adobe.xmp";

/// How hard PNG files are compressed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Compression {
    /// Fast: compression takes less time than rendering.
    #[default]
    Fast,
    /// Small: about two thirds of the size of `Fast`, for many times the time.
    Small,
}

/// Bytes of a chunk of compressed data. There are several, so that memory for all of it is not
/// needed twice.
const CHUNK: usize = 1 << 18;

/// The frame as a PNG file: RGB if it is opaque, otherwise RGBA; tagged as sRGB. The metadata is in
/// the text chunks `Software` and `Comment`, and for a panorama in an XMP packet; there is no date.
pub fn encode(frame: &Frame, metadata: &Metadata, compression: Compression) -> Vec<u8> {
    let image = Image::of_8_bits([frame.width(), frame.height()], frame.is_opaque(), metadata);
    let rows = || frame.pixels().chunks_exact(frame.width() as usize);
    let file = image.encode(compression.into(), rows(), copy_row);
    image.smaller(file, compression, rows(), copy_row)
}

/// Copies a row of pixels into the bytes of a PNG row, with alpha if there are four bytes a pixel.
fn copy_row(row: &[[u8; 4]], bytes: &mut [u8]) {
    if bytes.len() < 4 * row.len() {
        for (bytes, &[r, g, b, _]) in bytes.as_chunks_mut::<3>().0.iter_mut().zip(row) {
            *bytes = [r, g, b];
        }
    } else {
        bytes.copy_from_slice(row.as_flattened());
    }
}

/// Linear light as a PNG file with 16 bits per channel, encoded as sRGB: RGB or RGBA. Light outside
/// 0…1 is clipped.
pub fn encode_16(frame: &LinearFrame, metadata: &Metadata, compression: Compression) -> Vec<u8> {
    let whole = |part: f64| (65535.0 * part).round() as u16;
    let level = |light: f32| whole(srgb_encode(f64::from(light).clamp(0.0, 1.0))).to_be_bytes();
    let channels = if frame.is_opaque() { 3 } else { 4 };
    let image = Image {
        size: [frame.width(), frame.height()],
        is_opaque: frame.is_opaque(),
        depth: BitDepth::Sixteen,
        metadata,
    };
    let rows = || frame.pixels().chunks_exact(frame.width() as usize);
    let mut last = ([f32::NAN; 4], [[0; 2]; 4]);
    let mut convert = |row: &[[f32; 4]], bytes: &mut [u8]| {
        for (bytes, &pixel) in bytes.chunks_exact_mut(2 * channels).zip(row) {
            if pixel != last.0 {
                let [r, g, b, part] = pixel;
                last =
                    (pixel, [level(r), level(g), level(b), whole(f64::from(part)).to_be_bytes()]);
            }
            bytes.copy_from_slice(last.1[..channels].as_flattened());
        }
    };
    let file = image.encode(compression.into(), rows(), &mut convert);
    image.smaller(file, compression, rows(), convert)
}

impl From<Compression> for png::Compression {
    fn from(compression: Compression) -> Self {
        match compression {
            Compression::Fast => Self::Fast,
            Compression::Small => Self::High,
        }
    }
}

/// All that a file needs except the pixels.
struct Image<'a> {
    size: [u32; 2],
    is_opaque: bool,
    depth: BitDepth,
    metadata: &'a Metadata,
}

impl<'a> Image<'a> {
    fn of_8_bits(size: [u32; 2], is_opaque: bool, metadata: &'a Metadata) -> Self {
        Self { size, is_opaque, depth: BitDepth::Eight, metadata }
    }

    /// The file of rows of pixels. `fill` sets the bytes of a row.
    fn encode<R>(
        &self,
        compression: png::Compression,
        rows: impl Iterator<Item = R>,
        fill: impl FnMut(R, &mut [u8]),
    ) -> Vec<u8> {
        self.try_encode(compression, rows, fill)
            .expect("a frame with pixels fits a PNG and a vector takes every write")
    }

    /// A file, or the same without compression if that is smaller: fast compression makes noise
    /// larger than it is.
    fn smaller<R>(
        &self,
        file: Vec<u8>,
        compression: Compression,
        rows: impl Iterator<Item = R>,
        fill: impl FnMut(R, &mut [u8]),
    ) -> Vec<u8> {
        let n_bytes = (self.stride() + 1) * self.size[1] as usize;
        if compression == Compression::Small || file.len() <= n_bytes {
            return file;
        }
        let stored = self.encode(png::Compression::NoCompression, rows, fill);
        if stored.len() < file.len() { stored } else { file }
    }

    fn try_encode<R>(
        &self,
        compression: png::Compression,
        rows: impl Iterator<Item = R>,
        mut fill: impl FnMut(R, &mut [u8]),
    ) -> Result<Vec<u8>, EncodingError> {
        let is_stored = matches!(compression, png::Compression::NoCompression);
        let mut file = Vec::new();
        let mut encoder = Encoder::new(&mut file, self.size[0], self.size[1]);
        encoder.set_color(if self.is_opaque { ColorType::Rgb } else { ColorType::Rgba });
        encoder.set_depth(self.depth);
        encoder.set_source_srgb(SrgbRenderingIntent::Perceptual);
        encoder.set_compression(compression);
        if let Some(per_inch) = self.metadata.per_inch {
            let per_metre = (per_inch / 0.0254).round() as u32;
            let unit = Unit::Meter;
            encoder.set_pixel_dims(Some(PixelDimensions {
                xppu: per_metre,
                yppu: per_metre,
                unit,
            }));
        }
        add_text(&mut encoder, "Software", &self.metadata.software)?;
        add_text(&mut encoder, "Comment", &self.metadata.comment)?;
        if let Some(area) = self.metadata.panorama {
            encoder.add_itxt_chunk(XMP.into(), area.xmp(self.size))?;
        }
        let mut writer = encoder.write_header()?;
        if is_stored {
            // The stream copies bytes slowly.
            let mut bytes = vec![0; self.stride() * self.size[1] as usize];
            rows.zip(bytes.chunks_exact_mut(self.stride()))
                .for_each(|(row, bytes)| fill(row, bytes));
            writer.write_image_data(&bytes)?;
        } else {
            let mut stream = writer.stream_writer_with_size(CHUNK)?;
            let mut bytes = vec![0; self.stride()];
            for row in rows {
                fill(row, &mut bytes);
                stream.write_all(&bytes)?;
            }
            stream.finish()?;
        }
        writer.finish()?;
        Ok(file)
    }

    /// Bytes of a row of pixels.
    fn stride(&self) -> usize {
        let channels = if self.is_opaque { 3 } else { 4 };
        let bytes = if self.depth == BitDepth::Sixteen { 2 } else { 1 };
        self.size[0] as usize * channels * bytes
    }
}

/// Adds a text chunk: `tEXt`, which every PNG reader supports, if the text is Latin-1, otherwise
/// `iTXt`.
fn add_text(
    encoder: &mut Encoder<'_, &mut Vec<u8>>,
    key: &str,
    text: &str,
) -> Result<(), EncodingError> {
    if text.is_empty() {
        return Ok(());
    }
    // NUL is not allowed in text chunks.
    let text = text.replace('\0', "");
    if text.chars().all(|c| u32::from(c) < 256) {
        encoder.add_text_chunk(key.into(), text)
    } else {
        encoder.add_itxt_chunk(key.into(), text)
    }
}
