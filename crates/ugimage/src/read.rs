//! Reads PNG files.

use std::fmt;
use std::io::Cursor;

use miniz_oxide::inflate::decompress_to_vec_zlib_with_limit;
use png::{ColorType, Decoder, Transformations};
use ugphysics::srgb_decode;

use crate::encoding::{Encoding, levels};
use crate::orientation;
use crate::png::XMP;
use crate::{Frame, Metadata, PanoramaArea};

/// Largest number of pixels that is accepted.
pub const MAX_PIXELS: u64 = 1 << 28;

/// Limits of a picture that is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PictureLimits {
    /// Most pixels; [`MAX_PIXELS`] at most.
    pub pixels: u64,
    /// Most bytes of pixels, decoded: 4 for a pixel with 8 bits per channel, and 16 for one of
    /// light.
    pub bytes: u64,
}

impl Default for PictureLimits {
    /// [`MAX_PIXELS`], and 2 GiB.
    fn default() -> Self {
        Self { pixels: MAX_PIXELS, bytes: 1 << 31 }
    }
}

impl PictureLimits {
    /// Refuses pictures with too many pixels, or too many bytes if each has `n_bytes`.
    pub(crate) fn check(
        &self,
        [width, height]: [usize; 2],
        n_bytes: u64,
    ) -> Result<[u32; 2], ReadError> {
        let n_pixels = (width as u64).saturating_mul(height as u64);
        let most = self.pixels.min(MAX_PIXELS);
        let (Ok(columns), Ok(rows), true) =
            (u32::try_from(width), u32::try_from(height), n_pixels <= most)
        else {
            return Err(ReadError::new(&format!(
                "{width} x {height} pixels exceed the limit of {most}"
            )));
        };
        let n_bytes = n_bytes * n_pixels;
        if n_bytes > self.bytes {
            let text = format!(
                "{width} x {height} pixels are {n_bytes} bytes, more than the limit of memory, {}",
                self.bytes
            );
            return Err(ReadError { text, needed_memory: Some(n_bytes) });
        }
        Ok([columns, rows])
    }
}

/// Largest number of bytes of a text that is read, unpacked.
pub(crate) const MAX_TEXT: usize = 1 << 20;

/// Why a file cannot be read as an image.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ReadError {
    text: String,
    needed_memory: Option<u64>,
}

impl ReadError {
    pub(crate) fn new(text: &str) -> Self {
        Self { text: text.to_owned(), needed_memory: None }
    }

    /// The bytes of the decoded pixels, if they exceed the limit of memory.
    pub fn needed_memory(&self) -> Option<u64> {
        self.needed_memory
    }
}

impl fmt::Display for ReadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

impl std::error::Error for ReadError {}

/// The size of the image of a PNG file, and the metadata of the file. The pixels are not decoded.
///
/// # Errors
/// [`ReadError`] if the file is not a PNG, or exceeds the default [`PictureLimits`].
pub fn read_png_header(file: &[u8]) -> Result<([u32; 2], Metadata), ReadError> {
    Ok((PictureLimits::default().check(size(&mut decoder(file)?)?, 1)?, metadata(file)))
}

/// The image of a PNG file of any kind, converted to 8 bits per channel, and its metadata. Colours
/// are assumed to be sRGB. The metadata are the texts `Software` and `Comment`, up to 1 MiB each;
/// longer ones are omitted.
///
/// # Errors
/// [`ReadError`] if the file is not a PNG, is truncated or corrupt, exceeds the limits, or does not
/// fit in memory.
pub fn read_png(file: &[u8], limits: &PictureLimits) -> Result<(Frame, Metadata), ReadError> {
    let mut is_opaque = false;
    let (size, pixels) = decoded(decoder(file)?, file.len(), limits, |n_channels, row, pixels| {
        is_opaque = matches!(n_channels, 1 | 3);
        match n_channels {
            1 => pixels.extend(row.iter().map(|&grey| [grey, grey, grey, 255])),
            2 => pixels
                .extend(row.as_chunks().0.iter().map(|&[grey, alpha]| [grey, grey, grey, alpha])),
            3 => pixels.extend(
                row.as_chunks().0.iter().map(|&[red, green, blue]| [red, green, blue, 255]),
            ),
            _ => pixels.extend(row.as_chunks::<4>().0),
        }
    })?;
    Ok((Frame::new(size, is_opaque, pixels), metadata(file)))
}

/// The light of a PNG file with 16 bits per channel, not multiplied by alpha, with the primaries of
/// its encoding; without one colours are sRGB.
///
/// # Errors
/// See [`read_png`].
pub(crate) fn read_png_light(
    file: &[u8],
    limits: &PictureLimits,
    encoding: Option<&Encoding>,
) -> Result<([u32; 2], Vec<[f32; 4]>), ReadError> {
    let mut decoder = decoder(file)?;
    decoder.set_transformations(Transformations::EXPAND);
    let curves = encoding.map_or_else(
        || {
            let curve = levels(srgb_decode);
            [curve.clone(), curve.clone(), curve]
        },
        Encoding::deep_levels,
    );
    decoded(decoder, file.len(), limits, |n_channels, row, pixels| {
        pixels.extend(row.chunks_exact(2 * n_channels).map(|bytes| {
            let level = |idx: usize| u16::from_be_bytes([bytes[2 * idx], bytes[2 * idx + 1]]);
            let light =
                |idx: usize| curves[if n_channels < 3 { 0 } else { idx }][usize::from(level(idx))];
            let alpha = |idx: usize| f32::from(level(idx)) / 65535.0;
            match n_channels {
                1 => [light(0), light(0), light(0), 1.0],
                2 => [light(0), light(0), light(0), alpha(1)],
                3 => [light(0), light(1), light(2), 1.0],
                _ => [light(0), light(1), light(2), alpha(3)],
            }
        }));
    })
}

/// True if a PNG file has 16 bits per channel, by its header.
pub(crate) fn is_png_deep(file: &[u8]) -> bool {
    file.get(24) == Some(&16)
}

/// The size and the pixels of an image. `append` is passed the number of channels, the bytes of a
/// row and the pixels so far. `n_file`: the size of the file.
fn decoded<P>(
    mut decoder: Decoder<Cursor<&[u8]>>,
    n_file: usize,
    limits: &PictureLimits,
    mut append: impl FnMut(usize, &[u8], &mut Vec<P>),
) -> Result<([u32; 2], Vec<P>), ReadError> {
    let size = limits.check(size(&mut decoder)?, size_of::<P>() as u64)?;
    let mut reader = decoder.read_info().map_err(broken)?;
    check_info(reader.info(), n_file)?;
    let n_channels = match reader.output_color_type().0 {
        ColorType::Grayscale => 1,
        ColorType::GrayscaleAlpha => 2,
        ColorType::Rgb | ColorType::Indexed => 3,
        ColorType::Rgba => 4,
    };
    let n_pixels = size[0] as usize * size[1] as usize;
    // A file that has fewer rows than its header says reserves as many pixels as it has bytes.
    let mut pixels = reserved(n_pixels.min(n_file))?;
    if reader.info().interlaced {
        // Rows come in seven passes, so the bytes of all are decoded first.
        let too_large = || ReadError::new("too large");
        let n_bytes = reader.output_buffer_size().ok_or_else(too_large)?;
        let n_bytes_of_pixel = size_of::<P>() + n_bytes / n_pixels.max(1);
        limits.check(size.map(|side| side as usize), n_bytes_of_pixel as u64)?;
        drop(reserved::<u8>(n_bytes)?);
        let mut data = vec![0; n_bytes];
        let output = reader.next_frame(&mut data).map_err(broken)?;
        room_for(n_pixels, n_pixels, &mut pixels)?;
        data.chunks_exact(output.line_size).for_each(|row| append(n_channels, row, &mut pixels));
    } else {
        while let Some(row) = reader.next_row().map_err(broken)? {
            room_for(size[0] as usize, n_pixels, &mut pixels)?;
            append(n_channels, row.data(), &mut pixels);
        }
    }
    if pixels.len() != n_pixels {
        return Err(ReadError::new("not a readable PNG file: rows are missing"));
    }
    Ok((size, pixels))
}

/// The size of a PNG file that [`read_png`] can read, by its header.
///
/// # Errors
/// As [`read_png`], except for corrupt pixels.
pub(crate) fn check_png(file: &[u8], limits: &PictureLimits) -> Result<[u32; 2], ReadError> {
    let mut decoder = decoder(file)?;
    let size = limits.check(size(&mut decoder)?, 4)?;
    check_info(decoder.read_info().map_err(broken)?.info(), file.len())?;
    Ok(size)
}

/// Refuses a header with more pixels than a file of `n_file` bytes can hold, and broken palettes.
fn check_info(info: &png::Info<'_>, n_file: usize) -> Result<(), ReadError> {
    // As stored: a pixel may have one bit.
    check_packed(n_file, info.raw_bytes() as u64, MOST_INFLATED)?;
    let n_palette = info.palette.as_ref().map_or(0, |palette| palette.len());
    if !n_palette.is_multiple_of(3) || n_palette > 3 * 256 {
        // The decoder expects whole colours, as many as it has room for.
        let problem = format!("not a readable PNG file: {n_palette} bytes are no palette");
        return Err(ReadError::new(&problem));
    }
    Ok(())
}

fn broken(error: png::DecodingError) -> ReadError {
    unreadable("PNG", &error)
}

/// The error of a decoder for a kind of files.
pub(crate) fn unreadable(kind: &str, error: &dyn fmt::Display) -> ReadError {
    let problem = error.to_string();
    ReadError::new(&format!("not a readable {kind} file: {}", problem.trim_end_matches('.')))
}

fn decoder(file: &[u8]) -> Result<Decoder<Cursor<&[u8]>>, ReadError> {
    if !file.starts_with(b"\x89PNG") {
        return Err(ReadError::new("not a PNG file, the only kind that is read"));
    }
    let mut decoder = Decoder::new(Cursor::new(file));
    decoder.set_transformations(Transformations::normalize_to_color8());
    // A few kilobytes of compressed text or colour profile may unpack to gigabytes. Texts are read
    // by `metadata`; profiles are not used.
    decoder.set_ignore_text_chunk(true);
    decoder.set_ignore_iccp_chunk(true);
    Ok(decoder)
}

fn size(decoder: &mut Decoder<Cursor<&[u8]>>) -> Result<[usize; 2], ReadError> {
    let info = decoder.read_header_info().map_err(broken)?;
    Ok([info.width as usize, info.height as usize])
}

/// DEFLATE packs at most this many bytes into one.
pub(crate) const MOST_INFLATED: u64 = 1032;

/// Refuses a picture of `n_decoded` bytes if a file of `n_file` bytes cannot hold it, when at most
/// `ratio` bytes are packed into one: its header lies, or the file is truncated.
pub(crate) fn check_packed(n_file: usize, n_decoded: u64, ratio: u64) -> Result<(), ReadError> {
    if (n_file as u64).saturating_mul(ratio) >= n_decoded {
        return Ok(());
    }
    Err(ReadError::new(&format!(
        "{n_file} bytes cannot hold its pixels: the file is truncated, or its header is wrong"
    )))
}

/// An empty table with room for `len` rows, or an error if there is not enough memory.
pub(crate) fn reserved<T>(len: usize) -> Result<Vec<T>, ReadError> {
    let mut rows = Vec::new();
    rows.try_reserve_exact(len).map_err(|_| no_memory::<T>(len))?;
    Ok(rows)
}

/// Makes room for `n` more rows in a table, or returns an error if there is not enough memory. The
/// room is doubled when it is full, up to the `total` of rows, so that it follows what a file has
/// and not what its header says.
pub(crate) fn room_for<T>(n: usize, total: usize, rows: &mut Vec<T>) -> Result<(), ReadError> {
    if rows.capacity() - rows.len() >= n {
        return Ok(());
    }
    let more = rows.len().min(total.saturating_sub(rows.len())).max(n);
    rows.try_reserve_exact(more).map_err(|_| no_memory::<T>(rows.len() + more))
}

fn no_memory<T>(len: usize) -> ReadError {
    let n_bytes = (len as u64).saturating_mul(size_of::<T>() as u64);
    ReadError::new(&format!("there is not enough memory for its pixels, {n_bytes} bytes"))
}

/// The first texts with the keywords `Software` and `Comment`, the pixels in an inch, and the first
/// panorama that an XMP packet states. Invalid chunks are omitted.
pub(crate) fn metadata(file: &[u8]) -> Metadata {
    let mut metadata = Metadata::default();
    let mut rest = file.get(8..).unwrap_or_default();
    while let Some((kind, data, after)) = chunk(rest) {
        rest = after;
        if kind == b"pHYs" {
            metadata.per_inch = metadata.per_inch.or_else(|| per_inch(data));
        }
        if !matches!(kind, b"tEXt" | b"zTXt" | b"iTXt") {
            continue;
        }
        let Some((keyword, text)) = until_zero(data) else { continue };
        let target = match keyword {
            b"Software" => &mut metadata.software,
            b"Comment" => &mut metadata.comment,
            _ if keyword == XMP.as_bytes() => {
                let area = text_of(kind, text).and_then(|text| PanoramaArea::from_xmp(&text));
                metadata.panorama = metadata.panorama.or(area);
                continue;
            }
            _ => continue,
        };
        if target.is_empty() {
            *target = text_of(kind, text).unwrap_or_default();
        }
    }
    metadata
}

/// The pixels in an inch of a chunk `pHYs`, which has pixels in a metre: the whole number that is
/// rounded to these, if there is one. `None` for pixels that are not square, and without a unit.
fn per_inch(data: &[u8]) -> Option<f64> {
    const INCH: f64 = 0.0254;
    let (&[x, y], [1]) = data.as_chunks::<4>() else { return None };
    let per_metre = f64::from(u32::from_be_bytes(x));
    let whole = (per_metre * INCH).round();
    let is_whole = (whole / INCH).round() == per_metre;
    (x == y && per_metre > 0.0).then_some(if is_whole { whole } else { per_metre * INCH })
}

/// What a PNG file says about itself: its colours, its orientation, and the text of an XMP packet.
/// An unusable colour profile becomes a note.
pub(crate) fn declared(file: &[u8], notes: &mut Vec<String>) -> Declared {
    let mut chunks = Vec::new();
    let mut rest = file.get(8..).unwrap_or_default();
    while let Some((kind, data, after)) = chunk(rest) {
        rest = after;
        chunks.push((kind, data));
    }
    let find =
        |name: &[u8; 4]| chunks.iter().find(|(kind, _)| *kind == name).map(|(_, data)| *data);
    let number = |data: &[u8], idx: usize| {
        let four = data.get(4 * idx..4 * idx + 4)?.try_into().ok()?;
        Some(f64::from(u32::from_be_bytes(four)) / 1e5)
    };
    let encoding = if let Some(&[primaries, transfer, ..]) = find(b"cICP") {
        encoding_of_code_points([primaries, transfer], notes)
    } else if let Some((_, packed)) = find(b"iCCP").and_then(until_zero) {
        packed.get(1..).and_then(unpacked).and_then(|profile| encoding_of_profile(&profile, notes))
    } else if find(b"sRGB").is_some() {
        None
    } else {
        let gamma = find(b"gAMA").and_then(|data| number(data, 0)).filter(|gamma| *gamma > 0.0);
        let chromaticities = find(b"cHRM").and_then(|data| {
            let pair = |idx: usize| Some([number(data, 2 * idx)?, number(data, 2 * idx + 1)?]);
            Some([pair(1)?, pair(2)?, pair(3)?, pair(0)?])
        });
        (gamma.is_some() || chromaticities.is_some())
            .then(|| {
                let gamma = gamma.map_or(2.2, |gamma| 1.0 / gamma);
                Encoding::from_chromaticities(
                    chromaticities.unwrap_or(SRGB_CHROMATICITIES),
                    Some(gamma),
                )
            })
            .flatten()
    };
    let xmp = chunks.iter().find_map(|(kind, data)| {
        let (keyword, text) =
            until_zero(data).filter(|_| matches!(*kind, b"tEXt" | b"zTXt" | b"iTXt"))?;
        if keyword == XMP.as_bytes() { text_of(kind, text) } else { None }
    });
    Declared { encoding, orientation: find(b"eXIf").map_or(1, orientation::of_exif), xmp }
}

/// What a picture says about itself.
pub(crate) struct Declared {
    /// Unless it is sRGB.
    pub encoding: Option<Encoding>,
    /// From 1 to 8, as in Exif.
    pub orientation: u8,
    pub xmp: Option<String>,
}

/// The encoding of primaries and a transfer function by their numbers in ITU-T H.273, or a note
/// that it is not read; `None` for sRGB.
fn encoding_of_code_points(codes: [u8; 2], notes: &mut Vec<String>) -> Option<Encoding> {
    const WHITE: [f64; 2] = SRGB_CHROMATICITIES[3];
    let primaries = match codes[0] {
        1 => Some(SRGB_CHROMATICITIES),
        9 => Some([[0.708, 0.292], [0.17, 0.797], [0.131, 0.046], WHITE]),
        12 => Some([[0.68, 0.32], [0.265, 0.69], [0.15, 0.06], WHITE]),
        _ => None,
    };
    let gamma = match codes[1] {
        4 | 13 => Some(2.2),
        8 => Some(1.0),
        _ => None,
    };
    let Some((primaries, gamma)) = primaries.zip(gamma) else {
        let [primaries, transfer] = codes;
        notes.push(format!(
            "the colours of the picture are of kind {primaries}/{transfer} (cICP), which is not read: they count as \
             sRGB"
        ));
        return None;
    };
    Encoding::from_chromaticities(primaries, Some(gamma))
}

/// The encoding of an ICC profile, or a note that says why it is not used.
pub(crate) fn encoding_of_profile(profile: &[u8], notes: &mut Vec<String>) -> Option<Encoding> {
    Encoding::from_icc(profile).unwrap_or_else(|reason| {
        notes
            .push(format!("the colour profile of the picture {reason}: its colours count as sRGB"));
        None
    })
}

/// x, y of the red, green and blue primaries of sRGB, and of its white.
pub(crate) const SRGB_CHROMATICITIES: [[f64; 2]; 4] =
    [[0.64, 0.33], [0.3, 0.6], [0.15, 0.06], [0.3127, 0.329]];

/// The first chunk: its type, its data and what follows.
fn chunk(file: &[u8]) -> Option<(&[u8; 4], &[u8], &[u8])> {
    let (length, rest) = file.split_first_chunk()?;
    let (kind, rest) = rest.split_first_chunk()?;
    let (data, rest) = rest.split_at_checked(u32::from_be_bytes(*length) as usize)?;
    // The checksum is not read: it cannot prove that a text is what its program wrote.
    Some((kind, data, rest.get(4..)?))
}

/// The text of a chunk, after its keyword.
fn text_of(kind: &[u8; 4], data: &[u8]) -> Option<String> {
    match kind {
        b"tEXt" => latin(data),
        // The first byte is the compression method, which is always zlib.
        b"zTXt" => latin(&unpacked(data.get(1..)?)?),
        _ => {
            let (&[is_packed, _method], data) = data.split_first_chunk()?;
            let (_language, data) = until_zero(data)?;
            let (_translated_keyword, data) = until_zero(data)?;
            let text = if is_packed == 0 { data.to_vec() } else { unpacked(data)? };
            String::from_utf8(text).ok().filter(|text| text.len() <= MAX_TEXT)
        }
    }
}

pub(crate) fn until_zero(data: &[u8]) -> Option<(&[u8], &[u8])> {
    let end = data.iter().position(|&byte| byte == 0)?;
    Some((&data[..end], &data[end + 1..]))
}

/// Latin-1 as text.
pub(crate) fn latin(bytes: &[u8]) -> Option<String> {
    (bytes.len() <= MAX_TEXT).then(|| bytes.iter().copied().map(char::from).collect())
}

fn unpacked(data: &[u8]) -> Option<Vec<u8>> {
    decompress_to_vec_zlib_with_limit(data, MAX_TEXT).ok()
}
