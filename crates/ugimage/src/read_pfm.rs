//! Reads PFM files: a header of three lines and 32-bit floating point samples, rows from bottom to
//! top.

use crate::read::{PictureLimits, ReadError, reserved};

const N_BYTES_OF_SAMPLE: usize = 4;

/// The size and the light of a file, in colour (`PF`) or grey (`Pf`).
///
/// # Errors
/// [`ReadError`] if the file is truncated or corrupt, or exceeds a limit.
pub(crate) fn read(
    file: &[u8],
    limits: &PictureLimits,
) -> Result<([u32; 2], Vec<[f32; 4]>), ReadError> {
    let Samples { size, n_channels, scale, data } = samples(file, limits)?;
    let sample = |bytes: &[u8]| {
        let bytes = bytes.try_into().unwrap_or_default();
        if scale < 0.0 { f32::from_le_bytes(bytes) } else { f32::from_be_bytes(bytes) }
    };
    let [width, height] = size.map(|side| side as usize);
    let n_bytes_of_row = N_BYTES_OF_SAMPLE * n_channels * width;
    let mut pixels = reserved(width * height)?;
    for row in data.chunks_exact(n_bytes_of_row.max(1)).rev() {
        pixels.extend(row.chunks_exact(N_BYTES_OF_SAMPLE * n_channels).map(|bytes| {
            let channel = |idx: usize| {
                let start = N_BYTES_OF_SAMPLE * (idx % n_channels);
                sample(&bytes[start..start + N_BYTES_OF_SAMPLE])
            };
            [channel(0), channel(1), channel(2), 1.0]
        }));
    }
    Ok((size, pixels))
}

/// A file whose header was read.
struct Samples<'f> {
    size: [u32; 2],
    n_channels: usize,
    scale: f32,
    data: &'f [u8],
}

/// The size of a file that [`read`] can read; the samples are not converted.
///
/// # Errors
/// As [`read`].
pub(crate) fn check(file: &[u8], limits: &PictureLimits) -> Result<[u32; 2], ReadError> {
    Ok(samples(file, limits)?.size)
}

fn samples<'f>(file: &'f [u8], limits: &PictureLimits) -> Result<Samples<'f>, ReadError> {
    let mut rest = file;
    let n_channels = match word(&mut rest) {
        Some("PF") => 3,
        Some("Pf") => 1,
        _ => return Err(broken("it begins with another word than PF or Pf")),
    };
    let mut side = || word(&mut rest).and_then(|word| word.parse::<u32>().ok());
    let (Some(width), Some(height)) = (side(), side()) else {
        return Err(broken("its size is not two numbers"));
    };
    let (width, height) = (width as usize, height as usize);
    let size = limits.check([width, height], size_of::<[f32; 4]>() as u64)?;
    // The scale has no defined unit; its sign is the byte order.
    let Some(scale) = word(&mut rest).and_then(|word| word.parse::<f32>().ok()) else {
        return Err(broken("its scale is not a number"));
    };
    // The line of the scale may end with CR LF, or with blanks before the line feed.
    let n_bytes = N_BYTES_OF_SAMPLE * n_channels * width * height;
    let n_more = rest.len().saturating_sub(n_bytes);
    let has_ended = file[..file.len() - rest.len()].ends_with(b"\n");
    let n_blank = rest.iter().take(n_more).take_while(|byte| byte.is_ascii_whitespace()).count();
    if let Some(end) = rest[..n_blank].iter().position(|byte| *byte == b'\n').filter(|_| !has_ended)
    {
        rest = &rest[end + 1..];
    }
    let (data, after) = rest
        .split_at_checked(n_bytes)
        .ok_or_else(|| broken("the file is truncated, or its header is wrong"))?;
    if !after.trim_ascii().is_empty() {
        return Err(broken(
            "it goes on after its pixels: its size or its number of channels is wrong",
        ));
    }
    Ok(Samples { size, n_channels, scale, data })
}

fn broken(what: &str) -> ReadError {
    ReadError::new(&format!("not a readable PFM file: {what}"))
}

/// The next word, and the one blank or line feed after it, which ends the header after the last.
fn word<'f>(rest: &mut &'f [u8]) -> Option<&'f str> {
    let start = rest.iter().position(|byte| !byte.is_ascii_whitespace())?;
    let text = &rest[start..];
    let end = text.iter().position(u8::is_ascii_whitespace)?;
    *rest = &text[end + 1..];
    str::from_utf8(&text[..end]).ok()
}
