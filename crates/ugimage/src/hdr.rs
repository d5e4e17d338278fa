//! Radiance HDR (RGBE): eight bits each for red, green, blue and a shared exponent (G. Ward, *Real
//! Pixels*, 1991).

use crate::{LinearFrame, Metadata};

/// Image widths for which the format allows run-length encoding.
const CODED_WIDTHS: std::ops::Range<u32> = 8..0x8000;

/// Largest exponent byte.
const MAX_EXPONENT: i32 = 255;

/// The light as a Radiance HDR file, with a precision of 1/256 of the brightest channel. Negative
/// light is clipped to 0, and transparency is composited over black. The metadata is in the header.
pub fn encode(frame: &LinearFrame, metadata: &Metadata) -> Vec<u8> {
    let mut file = b"#?RADIANCE\n".to_vec();
    if !metadata.software.is_empty() {
        push_line(&mut file, "SOFTWARE=", &metadata.software);
    }
    metadata.comment.lines().for_each(|line| push_line(&mut file, "# ", line));
    file.extend_from_slice(b"PRIMARIES=0.64 0.33 0.30 0.60 0.15 0.06 0.3127 0.3290\n");
    let (width, height) = (frame.width(), frame.height());
    file.extend_from_slice(
        format!("FORMAT=32-bit_rle_rgbe\n\n-Y {height} +X {width}\n").as_bytes(),
    );
    for row in frame.pixels().chunks(width as usize) {
        let row: Vec<[u8; 4]> = row.iter().map(|&pixel| rgbe(frame.light_of(pixel))).collect();
        if CODED_WIDTHS.contains(&width) {
            push_coded(&mut file, &row);
        } else {
            file.extend_from_slice(row.as_flattened());
        }
    }
    file
}

/// Appends a header line. The text must not contain a line break: an empty line ends the header.
fn push_line(file: &mut Vec<u8>, key: &str, text: &str) {
    let text: String = text.chars().map(|c| if c.is_control() { '?' } else { c }).collect();
    file.extend_from_slice(format!("{key}{text}\n").as_bytes());
}

/// Light as 8-bit mantissas m with the exponent of the brightest channel: (m + ½)/256 · 2^(e −
/// 128).
fn rgbe(light: [f32; 3]) -> [u8; 4] {
    let light = light.map(|channel| f64::from(channel.clamp(0.0, f32::MAX)));
    let brightest = light.into_iter().fold(0.0, f64::max);
    // brightest = mantissa · 2^exponent, mantissa in ½…1.
    let (_, exponent) = libm::frexp(brightest);
    let exponent_byte = exponent + 128;
    if brightest == 0.0 || exponent_byte <= 0 {
        return [0; 4];
    }
    let exponent_byte = exponent_byte.min(MAX_EXPONENT);
    let scale = libm::ldexp(256.0, 128 - exponent_byte);
    let [r, g, b] = light.map(|channel| (channel * scale) as u8);
    [r, g, b, exponent_byte as u8]
}

/// A run-length encoded row, channel after channel: either 128 + n and one byte to repeat n times,
/// or n and n literal bytes.
fn push_coded(file: &mut Vec<u8>, row: &[[u8; 4]]) {
    const LONGEST: usize = 127;
    file.extend([2, 2, (row.len() >> 8) as u8, row.len() as u8]);
    for channel in 0..4 {
        let bytes: Vec<u8> = row.iter().map(|pixel| pixel[channel]).collect();
        let mut rest = &bytes[..];
        while let Some(first) = rest.first() {
            let run = run_len(rest, LONGEST);
            if run > 2 {
                file.extend([128 + run as u8, *first]);
                rest = &rest[run..];
            } else {
                let len = (0..rest.len().min(LONGEST))
                    .take_while(|&at| run_len(&rest[at..], 3) < 3)
                    .count();
                file.push(len as u8);
                file.extend_from_slice(&rest[..len]);
                rest = &rest[len..];
            }
        }
    }
}

/// The number of leading bytes equal to the first, counted up to `longest`.
fn run_len(bytes: &[u8], longest: usize) -> usize {
    bytes.iter().take(longest).take_while(|byte| **byte == bytes[0]).count()
}
