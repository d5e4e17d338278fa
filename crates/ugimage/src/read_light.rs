//! Reads pictures of several formats: PNG, JPEG, Radiance HDR, OpenEXR and PFM.

use zune_jpeg::JpegDecoder;
use zune_jpeg::zune_core::bytestream::ZCursor;
use zune_jpeg::zune_core::colorspace::ColorSpace;
use zune_jpeg::zune_core::options::DecoderOptions;

use crate::encoding::Encoding;
use crate::orientation::{self, upright};
use crate::panorama::part_of_xmp;
use crate::pixels::Pixels;
use crate::read::{
    self, Declared, PictureLimits, ReadError, check_packed, encoding_of_profile, is_png_deep,
    read_png, read_png_light, reserved, unreadable,
};
use crate::{read_exr, read_hdr, read_pfm};

/// A picture that was read.
#[derive(Clone, Debug, PartialEq)]
pub struct ReadPicture {
    /// Width and height.
    pub size: [u32; 2],
    /// Its pixels.
    pub pixels: Pixels,
    /// The part of a whole equirectangular panorama that the file says it shows (GPano): its left,
    /// right, upper and lower edge, as fractions of the whole.
    pub part: Option<[f64; 4]>,
    /// What the file says and is not used, one sentence each.
    pub notes: Vec<String>,
}

/// Reads a picture, by the first bytes of its file: PNG, JPEG, Radiance HDR, OpenEXR or PFM.
/// Memory is used only for pixels that the file has.
///
/// What the file says about itself is applied: the orientation that cameras note, the colours of
/// ICC profiles with primaries and curves, gamma and chromaticities of PNG, chromaticities and
/// windows of EXR. Without these, colours of PNG and JPEG are sRGB, and those of the others linear
/// light with the primaries of sRGB. Colours that are not sRGB, and 16 bits per channel, become
/// light.
///
/// # Errors
/// [`ReadError`] if the file is of another kind, is truncated or corrupt, exceeds the limits, or
/// does not fit in memory.
pub fn read_picture(file: &[u8], limits: &PictureLimits) -> Result<ReadPicture, ReadError> {
    let mut notes = Vec::new();
    let light = |(size, pixels)| (size, Pixels::Light(pixels));
    let mut declared = Declared { encoding: None, orientation: 1, xmp: None };
    let ([width, height], pixels) = match file {
        [0x89, b'P', b'N', b'G', ..] => {
            declared = read::declared(file, &mut notes);
            if is_png_deep(file) {
                let (size, pixels) = read_png_light(file, limits, declared.encoding.as_ref())?;
                (size, Pixels::Light(pixels))
            } else {
                let (frame, _) = read_png(file, limits)?;
                ([frame.width(), frame.height()], Pixels::Srgb(frame.into_pixels()))
            }
        }
        [0xff, 0xd8, 0xff, ..] => jpeg(file, limits, &mut declared, &mut notes)?,
        [b'#', b'?', ..] => read_hdr::read(file, limits, &mut declared).map(light)?,
        [0x76, 0x2f, 0x31, 0x01, ..] => {
            read_exr::read(file, limits, &mut declared, &mut notes).map(light)?
        }
        [b'P', b'F' | b'f', b' ' | b'\r' | b'\n', ..] => read_pfm::read(file, limits).map(light)?,
        _ => return Err(not_a_picture(file)),
    };
    let pixels = match &declared.encoding {
        None => pixels,
        Some(encoding) => {
            limits.check([width as usize, height as usize], size_of::<[f32; 4]>() as u64)?;
            Pixels::Light(encoding.light(pixels))
        }
    };
    let (size, pixels) = match pixels {
        Pixels::Srgb(pixels) => {
            upright(declared.orientation, [width, height], pixels, Pixels::Srgb)
        }
        Pixels::Light(pixels) => {
            upright(declared.orientation, [width, height], pixels, Pixels::Light)
        }
    };
    let part = declared.xmp.as_deref().and_then(|xmp| part_of_xmp(xmp, size));
    Ok(ReadPicture { size, pixels, part, notes })
}

/// The size of a picture, known before its pixels are decoded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PictureHeader {
    /// Width and height as stored, before the picture is turned upright.
    pub size: [u32; 2],
    /// Bytes of a decoded pixel: 4 with 8 bits per channel, and 16 as light.
    pub n_bytes_of_pixel: u64,
}

impl PictureHeader {
    /// Bytes of the decoded pixels with those of all mip levels, which are light: each level has
    /// half the columns and rows of the one before, down to one pixel.
    pub fn n_bytes_with_levels(&self) -> u64 {
        let n_pixels = |[width, height]: [u32; 2]| u64::from(width) * u64::from(height);
        let (mut size, mut n_in_levels) = (self.size, 0);
        while size.iter().any(|&side| side > 1) {
            size = size.map(|side| side.div_ceil(2));
            n_in_levels += n_pixels(size);
        }
        self.n_bytes_of_pixel * n_pixels(self.size) + N_BYTES_OF_LIGHT * n_in_levels
    }
}

/// Bytes of a pixel of light.
const N_BYTES_OF_LIGHT: u64 = size_of::<[f32; 4]>() as u64;

/// Checks a picture by its headers, without decoding its pixels: its kind, its size, whether the
/// file can hold as many pixels and, of EXR, whether it has colours.
///
/// # Errors
/// [`ReadError`] for files that [`read_picture`] refuses for these reasons.
pub fn check_picture(file: &[u8], limits: &PictureLimits) -> Result<PictureHeader, ReadError> {
    let light = |size| PictureHeader { size, n_bytes_of_pixel: N_BYTES_OF_LIGHT };
    let header = match file {
        [0x89, b'P', b'N', b'G', ..] => {
            let is_light =
                is_png_deep(file) || read::declared(file, &mut Vec::new()).encoding.is_some();
            let n_bytes_of_pixel = if is_light { N_BYTES_OF_LIGHT } else { N_BYTES_OF_BYTES };
            PictureHeader { size: read::check_png(file, limits)?, n_bytes_of_pixel }
        }
        [0xff, 0xd8, 0xff, ..] => {
            let mut jpeg = Jpeg::new(file, limits)?;
            let is_light = jpeg.encoding(&mut Vec::new()).is_some();
            let n_bytes_of_pixel = if is_light { N_BYTES_OF_LIGHT } else { N_BYTES_OF_BYTES };
            PictureHeader { size: jpeg.size, n_bytes_of_pixel }
        }
        [b'#', b'?', ..] => light(read_hdr::check(file, limits)?),
        [0x76, 0x2f, 0x31, 0x01, ..] => light(read_exr::check(file, limits)?),
        [b'P', b'F' | b'f', b' ' | b'\r' | b'\n', ..] => light(read_pfm::check(file, limits)?),
        _ => return Err(not_a_picture(file)),
    };
    limits.check(header.size.map(|side| side as usize), header.n_bytes_of_pixel)?;
    Ok(header)
}

fn not_a_picture(file: &[u8]) -> ReadError {
    match foreign_kind(file) {
        Some(kind) => ReadError::new(&format!("it is {}; {}", kind.what, kind.remedy)),
        None => ReadError::new("not a picture of a kind that is read: PNG, JPEG, HDR, EXR or PFM"),
    }
}

/// Bytes of a pixel with 8 bits per channel: red, green, blue and alpha.
const N_BYTES_OF_BYTES: u64 = size_of::<[u8; 4]>() as u64;

/// A JPEG file whose headers were read.
struct Jpeg<'f> {
    decoder: JpegDecoder<ZCursor<&'f [u8]>>,
    size: [u32; 2],
    /// Bytes of a pixel while it is decoded.
    n_bytes: usize,
}

impl<'f> Jpeg<'f> {
    fn new(file: &'f [u8], limits: &PictureLimits) -> Result<Self, ReadError> {
        /// Bytes of the coefficients of a pixel, which a progressive file needs all at once.
        const N_BYTES_OF_COEFFICIENTS: usize = 6;
        let broken = |error: &dyn std::fmt::Display| unreadable("JPEG", error);
        // The decoder fills what is missing of a truncated file with grey.
        let Some(Packed { n_bytes: n_packed, is_progressive }) = packed(file) else {
            return Err(broken(&"the file is truncated"));
        };
        let options = DecoderOptions::default()
            .jpeg_set_out_colorspace(ColorSpace::RGB)
            .set_max_width(usize::from(u16::MAX))
            .set_max_height(usize::from(u16::MAX));
        let mut decoder = JpegDecoder::new_with_options(ZCursor::new(file), options);
        decoder.decode_headers().map_err(|error| broken(&error))?;
        let (width, height) = decoder.dimensions().ok_or_else(|| broken(&"it has no size"))?;
        let n_more = if is_progressive { N_BYTES_OF_COEFFICIENTS } else { 0 };
        let n_bytes = N_BYTES_OF_BYTES as usize + n_more;
        let size = limits.check([width, height], n_bytes as u64)?;
        let n_pixels = width * height;
        // Each block of 64 pixels has a bit or more.
        check_packed(n_packed, n_pixels as u64, 8 * 64)?;
        if decoder.output_buffer_size() != Some(3 * n_pixels) {
            return Err(broken(&"its colours are not red, green and blue"));
        }
        Ok(Self { decoder, size, n_bytes })
    }

    /// The encoding that its profile states, unless it is sRGB.
    fn encoding(&mut self, notes: &mut Vec<String>) -> Option<Encoding> {
        // Profiles of CMYK are for the inks, which the decoder converts without one.
        let space = self.decoder.input_colorspace();
        let is_ink = matches!(space, Some(ColorSpace::CMYK | ColorSpace::YCCK));
        let profile = self.decoder.icc_profile().filter(|_| !is_ink);
        profile.and_then(|profile| encoding_of_profile(&profile, notes))
    }
}

fn jpeg(
    file: &[u8],
    limits: &PictureLimits,
    declared: &mut Declared,
    notes: &mut Vec<String>,
) -> Result<([u32; 2], Pixels), ReadError> {
    const N_BYTES: usize = N_BYTES_OF_BYTES as usize;
    let mut jpeg = Jpeg::new(file, limits)?;
    let n_pixels = jpeg.size[0] as usize * jpeg.size[1] as usize;
    // Reserved before the decoder allocates as much.
    drop(reserved::<u8>(jpeg.n_bytes * n_pixels)?);
    let mut pixels = vec![[0; N_BYTES]; n_pixels];
    let bytes = pixels.as_flattened_mut();
    let decoded = jpeg.decoder.decode_into(&mut bytes[..3 * n_pixels]);
    decoded.map_err(|error| unreadable("JPEG", &error))?;
    // The decoder has no alpha for all kinds of colours, so pixels are spread in their place.
    for idx in (0..n_pixels).rev() {
        let [red, green, blue] = [bytes[3 * idx], bytes[3 * idx + 1], bytes[3 * idx + 2]];
        bytes[N_BYTES * idx..N_BYTES * (idx + 1)].copy_from_slice(&[red, green, blue, u8::MAX]);
    }
    declared.encoding = jpeg.encoding(notes);
    let Jpeg { decoder, size, .. } = jpeg;
    declared.orientation = decoder.exif().map_or(1, |exif| orientation::of_exif(exif));
    declared.xmp = decoder.xmp().map(|xmp| String::from_utf8_lossy(xmp).into_owned());
    if has_gain_map(file) {
        notes.push(
            "its gain map is not read: bright light is that of the picture itself".to_owned(),
        );
    }
    Ok((size, Pixels::Srgb(pixels)))
}

/// True if the segments before the pixels of a JPEG file announce a gain map (Ultra HDR, ISO
/// 21496-1, or that of Apple's telephones).
fn has_gain_map(file: &[u8]) -> bool {
    /// In texts of XMP, and in a segment of its own.
    const MARKS: [&[u8]; 3] = [
        b"http://ns.adobe.com/hdr-gain-map/",
        b"urn:iso:std:iso:ts:21496:-1",
        b"http://ns.apple.com/HDRGainMap/",
    ];
    let mut at = 2;
    while let Some(&[0xff, marker, high, low]) = file.get(at..at + 4) {
        let length = usize::from(u16::from_be_bytes([high, low]));
        let segment = file.get(at + 4..(at + 2).saturating_add(length)).unwrap_or_default();
        let has = |mark: &&[u8]| segment.windows(mark.len()).any(|window| window == *mark);
        if (0xe1..=0xef).contains(&marker) && MARKS.iter().any(has) {
            return true;
        }
        // The start of the pixels.
        if marker == 0xda {
            return false;
        }
        at += 2 + length.max(2);
    }
    false
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
        let skip =
            pairs.position(|pair| pair[0] == 0xff && !matches!(pair[1], 0 | 0xd0..=0xd7 | 0xff))?;
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

/// A kind of files that no program reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ForeignKind {
    /// What such a file is, as in `a web page`.
    pub what: &'static str,
    /// What to do with it, as in `download the file itself`.
    pub remedy: &'static str,
    /// It holds pictures.
    pub is_picture: bool,
}

const WEB_PAGE: [&str; 2] = ["a web page", "download the file itself"];
const GIT_LFS: [&str; 2] = ["a Git LFS pointer", "fetch the file itself with `git lfs pull`"];
const UTF_16: [&str; 2] = ["UTF-16 text", "save it as UTF-8 or ASCII"];
const COMPRESSED: [&str; 2] = ["compressed data", "decompress it first"];
const CONVERT: &str = "convert it to PNG, JPEG, HDR, EXR or PFM";

/// Kinds by the bytes of files from a place on.
const KINDS: [(usize, &[u8], [&str; 2]); 17] = [
    (0, b"version https://git-lfs.github.com/spec/", GIT_LFS),
    (0, b"\xff\xfe", UTF_16),
    (0, b"\xfe\xff", UTF_16),
    (0, b"\x1f\x8b", COMPRESSED),
    (0, b"PK\x03\x04", COMPRESSED),
    (0, b"\xfd7zXZ", COMPRESSED),
    (0, b"\x28\xb5\x2f\xfd", COMPRESSED),
    (0, b"BZh", COMPRESSED),
    (0, b"7z\xbc\xaf", COMPRESSED),
    (0, b"GIF8", ["a GIF picture", CONVERT]),
    (0, b"II*\0", ["a TIFF picture", CONVERT]),
    (0, b"MM\0*", ["a TIFF picture", CONVERT]),
    (8, b"WEBP", ["a WebP picture", CONVERT]),
    (4, b"ftyp", ["a HEIC or AVIF picture", CONVERT]),
    (4, b"JXL ", ["a JPEG XL picture", CONVERT]),
    (0, b"8BPS", ["a Photoshop picture", CONVERT]),
    (0, b"%PDF", ["a PDF document", CONVERT]),
];

/// What a file is by its first bytes; `None` if it may be one that is read.
pub fn foreign_kind(file: &[u8]) -> Option<ForeignKind> {
    let start = file.trim_ascii_start();
    let begins =
        |word: &&[u8]| start.get(..word.len()).is_some_and(|it| it.eq_ignore_ascii_case(word));
    let page = [&b"<!doctype html"[..], b"<html"].iter().any(begins).then_some(WEB_PAGE);
    let is_kind = |(at, bytes, _): &&(usize, &[u8], _)| {
        file.get(*at..).is_some_and(|it| it.starts_with(bytes))
    };
    let [what, remedy] = page.or_else(|| KINDS.iter().find(is_kind).map(|(.., words)| *words))?;
    Some(ForeignKind { what, remedy, is_picture: remedy == CONVERT })
}
