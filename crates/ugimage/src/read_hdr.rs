//! Reads Radiance HDR files: red, green and blue with a common exponent, in runs.
//!
//! Not with a crate, because those allocate the whole picture, twice, before they find that a short
//! file has no pixels.

use crate::encoding::{Encoding, XYZ_CHROMATICITIES};
use crate::read::{Declared, PictureLimits, ReadError, SRGB_CHROMATICITIES, reserved, room_for};

/// The size and the light of a file, divided by what its header says it was multiplied by. The
/// rows are as stored.
///
/// # Errors
/// [`ReadError`] if the file is truncated or corrupt, or exceeds a limit.
pub(crate) fn read(
    file: &[u8],
    limits: &PictureLimits,
    declared: &mut Declared,
) -> Result<([u32; 2], Vec<[f32; 4]>), ReadError> {
    let Checked { size, factors, mut rest } = checked(file, limits, declared)?;
    let [width, height] = size.map(|side| side as usize);
    // A header that lies reserves as many pixels as the file has bytes. Runs may fill more.
    let n_pixels = width * height;
    let mut pixels = reserved(n_pixels.min(rest.len()))?;
    if width > 0 {
        for _ in 0..height {
            room_for(width, n_pixels, &mut pixels)?;
            row(&mut rest, width, &mut pixels)?;
        }
    }
    if factors != [1.0; 3] {
        for pixel in &mut pixels {
            pixel.iter_mut().zip(factors).for_each(|(part, factor)| *part /= factor);
        }
    }
    Ok((size, pixels))
}

/// The size of a file by its header; the pixels are not unpacked.
///
/// # Errors
/// As [`read`], except for corrupt pixels.
pub(crate) fn check(file: &[u8], limits: &PictureLimits) -> Result<[u32; 2], ReadError> {
    let mut declared = Declared { encoding: None, orientation: 1, xmp: None };
    Ok(checked(file, limits, &mut declared)?.size)
}

/// A file whose header has been read.
struct Checked<'f> {
    size: [u32; 2],
    /// By which red, green and blue were multiplied.
    factors: [f32; 3],
    /// The packed pixels.
    rest: &'f [u8],
}

fn checked<'f>(
    file: &'f [u8],
    limits: &PictureLimits,
    declared: &mut Declared,
) -> Result<Checked<'f>, ReadError> {
    let mut rest = file;
    let ([width, height], factors) = header(&mut rest, declared)?;
    let size = limits.check([width, height], 16)?;
    // A row is a pixel or more.
    if rest.len() as u64 / 4 < height as u64 {
        return Err(truncated());
    }
    Ok(Checked { size, factors, rest })
}

fn broken(what: &str) -> ReadError {
    ReadError::new(&format!("not a readable HDR file: {what}"))
}

fn truncated() -> ReadError {
    broken("the file is truncated, or its header is wrong")
}

/// The axes of pixels, from row to row and within a row, in the order of the orientations that
/// cameras note.
const AXES: [&str; 8] = ["-Y +X", "-Y -X", "+Y -X", "+Y +X", "+X -Y", "-X -Y", "-X +Y", "+X +Y"];

/// Reads the header: width and height as stored, and the factors by which red, green and blue were
/// multiplied. What is left of `rest` are the pixels.
fn header(rest: &mut &[u8], declared: &mut Declared) -> Result<([usize; 2], [f32; 3]), ReadError> {
    let mut next_line = || {
        let end = rest.iter().position(|&byte| byte == b'\n').ok_or_else(truncated)?;
        let line = String::from_utf8_lossy(&rest[..end]);
        *rest = &rest[end + 1..];
        Ok(line.trim_end_matches('\r').to_owned())
    };
    if !matches!(&*next_line()?, "#?RADIANCE" | "#?RGBE") {
        return Err(broken("it begins with another word than #?RADIANCE"));
    }
    let mut factors = [1.0; 3];
    loop {
        let line = next_line()?;
        if line.is_empty() {
            break;
        }
        let (name, value) = line.split_once('=').unwrap_or_default();
        let numbers: Vec<f64> =
            value.split_whitespace().map_while(|word| word.parse().ok()).collect();
        let mut multiply =
            |by: [f64; 3]| factors.iter_mut().zip(by).for_each(|(part, by)| *part *= by as f32);
        match (name, &numbers[..]) {
            ("FORMAT", _) if value.trim() == "32-bit_rle_xyze" => {
                declared.encoding = Encoding::from_chromaticities(XYZ_CHROMATICITIES, None);
            }
            ("FORMAT", _) if value.trim() != "32-bit_rle_rgbe" => {
                return Err(broken("its FORMAT is neither 32-bit_rle_rgbe nor 32-bit_rle_xyze"));
            }
            ("EXPOSURE", &[all]) => multiply([all; 3]),
            ("COLORCORR", &[red, green, blue]) => multiply([red, green, blue]),
            ("PRIMARIES", &[rx, ry, gx, gy, bx, by, wx, wy]) => {
                let primaries = [[rx, ry], [gx, gy], [bx, by], [wx, wy]];
                let srgb = SRGB_CHROMATICITIES.as_flattened();
                // Radiance's own, with a white of equal energy, count as sRGB everywhere.
                if numbers.iter().zip(srgb).any(|(stated, srgb)| (stated - srgb).abs() > 0.021) {
                    declared.encoding = Encoding::from_chromaticities(primaries, None);
                }
            }
            _ => {}
        }
    }
    if !factors.iter().all(|factor| factor.is_normal() && *factor > 0.0) {
        return Err(broken("its EXPOSURE or COLORCORR is not above 0"));
    }
    let line = next_line()?;
    let words: Vec<&str> = line.split_whitespace().collect();
    let size = match words[..] {
        [first, rows, second, columns] => {
            let orientation = AXES.iter().position(|axes| *axes == format!("{first} {second}"));
            let sides = columns.parse::<u32>().ok().zip(rows.parse::<u32>().ok());
            orientation.zip(sides)
        }
        _ => None,
    };
    let (orientation, (width, height)) =
        size.ok_or_else(|| broken("its size is not two numbers, as in -Y 512 +X 1024"))?;
    declared.orientation = orientation as u8 + 1;
    Ok(([width, height].map(|side| side as usize), factors))
}

/// Reads the first `N` bytes.
fn take<const N: usize>(rest: &mut &[u8]) -> Result<[u8; N], ReadError> {
    let (bytes, behind) = rest.split_first_chunk().ok_or_else(truncated)?;
    *rest = behind;
    Ok(*bytes)
}

/// Appends the pixels of a row.
fn row(rest: &mut &[u8], width: usize, pixels: &mut Vec<[f32; 4]>) -> Result<(), ReadError> {
    match take(rest)? {
        // A pixel that does not occur announces runs of each channel.
        [2, 2, 0..=127, _] => {
            let start = pixels.len();
            for channel in 0..4 {
                channel_of_row(rest, width, channel, start, pixels)?;
            }
            for pixel in &mut pixels[start..] {
                *pixel = light(pixel.map(|byte| byte as u8));
            }
            Ok(())
        }
        first => pixels_of_row(rest, width, first, pixels),
    }
}

/// Reads one of the four bytes of every pixel of a row. The first channel appends the pixels.
fn channel_of_row(
    rest: &mut &[u8],
    width: usize,
    channel: usize,
    start: usize,
    pixels: &mut Vec<[f32; 4]>,
) -> Result<(), ReadError> {
    let mut at = 0;
    let mut set = |byte: u8| {
        if channel == 0 {
            pixels.push([0.0; 4]);
        }
        pixels[start + at][channel] = f32::from(byte);
        at += 1;
        at
    };
    let mut n_set = 0;
    while n_set < width {
        let [code] = take(rest)?;
        let is_run = code > 128;
        let count = usize::from(if is_run { code - 128 } else { code });
        if n_set + count > width {
            return Err(broken("a row has more pixels than its width"));
        }
        if is_run {
            let [byte] = take(rest)?;
            (0..count).for_each(|_| n_set = set(byte));
        } else {
            let (bytes, behind) = rest.split_at_checked(count).ok_or_else(truncated)?;
            *rest = behind;
            bytes.iter().for_each(|&byte| n_set = set(byte));
        }
    }
    Ok(())
}

/// Appends a row of pixels and of pixels `1 1 1 n`, which repeat the one before n times. Several
/// of these in a row have the digits of a number with base 256, the last first.
fn pixels_of_row(
    rest: &mut &[u8],
    width: usize,
    first: [u8; 4],
    pixels: &mut Vec<[f32; 4]>,
) -> Result<(), ReadError> {
    let end = pixels.len() + width;
    let (mut last, mut digit) = (light(first), 0_u32);
    if first[..3] == [1, 1, 1] {
        return Err(broken("a row begins with a run"));
    }
    pixels.push(last);
    while pixels.len() < end {
        match take(rest)? {
            [1, 1, 1, count] => {
                let count = usize::from(count).checked_shl(8 * digit).filter(|_| digit < 4);
                let count = count.filter(|count| *count <= end - pixels.len());
                let count = count.ok_or_else(|| broken("a row has more pixels than its width"))?;
                pixels.resize(pixels.len() + count, last);
                digit += 1;
            }
            pixel => {
                (last, digit) = (light(pixel), 0);
                pixels.push(last);
            }
        }
    }
    Ok(())
}

/// Linear light: m · 2^(e − 136), and black without an exponent.
fn light([red, green, blue, exponent]: [u8; 4]) -> [f32; 4] {
    // 2^(e − 128), which is subnormal for e = 1.
    let bits = if exponent > 1 { u32::from(exponent - 1) << 23 } else { u32::from(exponent) << 22 };
    let unit = f32::from_bits(bits) / 256.0;
    let [red, green, blue] = [red, green, blue].map(|part| unit * f32::from(part));
    [red, green, blue, 1.0]
}
