//! Panoramas and lists of stars for `ugwarp`: PNG, JPEG, HDR, EXR and CSV files.

use std::fmt::Write;

use ugimage::{Compression, Format, Frame, LinearFrame, Metadata};
use ugtesting::Random;

use super::{Files, bytes, picture, words};

/// A JPEG file of 64 x 32 pixels.
const JPEG: &[u8] = include_bytes!("../../../crates/ugimage/tests/bars.jpg");

/// A panorama, or the six sides of a cube.
pub fn files(random: &mut Random) -> (Files, &'static str) {
    let n = if random.one_in(5) { 6 } else { 1 };
    let file = |idx: usize, random: &mut Random| {
        let mut bytes = if random.one_in(4) { stars(random).into_bytes() } else { file(random) };
        if random.one_in(2) {
            bytes::damage(random, &mut bytes);
        }
        (format!("{idx}.sky"), bytes)
    };
    ((0..n).map(|idx| file(idx, random)).collect(), "panorama")
}

/// A list of stars, mostly valid.
pub fn stars(random: &mut Random) -> String {
    let head = *random.pick(&[
        "ra,dec,mag,kelvin",
        "ra_hours,dec,mag,b-v",
        "lon,lat,mag,kelvin",
        "x,y,z,mag,kelvin",
        "ra,dec,mag",
        "name,ra,dec,mag,kelvin,ra",
    ]);
    let mut text = format!("{head}\n");
    let n_columns = head.split(',').count();
    let is_wild = random.one_in(2);
    for _ in 0..random.below(12) {
        let number = |random: &mut Random| match is_wild {
            true => words::number(random),
            false => format!("{:.3}", random.between(0.1, 20.0)),
        };
        let mut fields: Vec<String> = (0..n_columns).map(|_| number(random)).collect();
        if let Some(kelvin) = fields.last_mut() {
            *kelvin = if head.ends_with("kelvin") { "6000".to_owned() } else { kelvin.clone() };
        }
        if random.one_in(40) {
            fields.push(words::name(random));
        }
        let _ = writeln!(text, "{}", fields.join(","));
    }
    text
}

/// A panorama of any format, sometimes of a shape that is none, with light that is not finite, or
/// with a header that lies about its size.
pub fn file(random: &mut Random) -> Vec<u8> {
    let size = *random.pick(&[[64, 32], [16, 8], [2, 1], [48, 8], [32, 24], [8, 8], [1, 1], [40, 1]]);
    let mut bytes = encoded(random, size);
    if random.one_in(5) {
        let stated = *random.pick(&[
            [1 << 14, 1 << 13],
            [1 << 28, 1],
            [1, 1 << 28],
            [65_535, 4096],
            [4000, 2000],
            [0, 0],
            [u32::MAX, u32::MAX],
        ]);
        state_size(&mut bytes, stated);
        // Bytes without meaning, so that a file is long enough to be believed.
        if random.one_in(3) {
            let n_bytes = 1000 << random.below(10);
            bytes.extend((0..n_bytes).map(|_| random.below(256) as u8));
        }
    }
    bytes
}

/// Writes another size into the header of a picture.
fn state_size(bytes: &mut Vec<u8>, [width, height]: [u32; 2]) {
    match bytes.get(..4) {
        Some([0x89, b'P', b'N', b'G']) => {
            bytes[16..24].copy_from_slice(&[width.to_be_bytes(), height.to_be_bytes()].concat());
            let checksum = picture::crc(&bytes[12..29]);
            bytes[29..33].copy_from_slice(&checksum.to_be_bytes());
        }
        Some([0xff, 0xd8, ..]) => {
            if let Some(at) = bytes.windows(2).position(|pair| matches!(pair, [0xff, 0xc0..=0xc2])) {
                let [width, height] = [width, height].map(|side| side.min(65_535) as u16);
                // Progressive, or not.
                bytes[at + 1] = if width.is_multiple_of(2) { 0xc0 } else { 0xc2 };
                bytes[at + 5..at + 9].copy_from_slice(&[height.to_be_bytes(), width.to_be_bytes()].concat());
            }
        }
        Some([b'#', b'?', ..]) => {
            if let Some(start) = bytes.windows(3).position(|word| word == b"-Y ")
                && let Some(length) = bytes[start..].iter().position(|&byte| byte == b'\n')
            {
                let line = format!("-Y {height} +X {width}").into_bytes();
                drop(bytes.splice(start..start + length, line));
            }
        }
        Some([0x76, 0x2f, 0x31, 0x01]) => {
            const KIND: &[u8] = b"Window\0box2i\0";
            let ends = [width, height].map(|side| side.wrapping_sub(1).to_le_bytes()).concat();
            for at in 0..bytes.len().saturating_sub(KIND.len() + 20) {
                if bytes[at..].starts_with(KIND) {
                    // The length of the attribute, and the first corner, come before the other.
                    let corner = at + KIND.len() + 12;
                    bytes[corner..corner + 8].copy_from_slice(&ends);
                }
            }
        }
        _ => {}
    }
}

/// A panorama of a format in which all pixels are valid.
pub fn valid(random: &mut Random) -> Vec<u8> {
    let size = *random.pick(&[[64, 32], [128, 64], [66, 33]]);
    let level = random.unit();
    match random.below(5) {
        0 => JPEG.to_vec(),
        1 => b"ra,dec,mag,kelvin\n10,20,1,5000\n0,-90,-1.5,40000\n".to_vec(),
        2 => light(random, size, |random| (level * random.unit()) as f32),
        _ => srgb(random, size),
    }
}

fn encoded(random: &mut Random, size: [u32; 2]) -> Vec<u8> {
    match random.below(6) {
        0 => JPEG.to_vec(),
        1 | 2 => srgb(random, size),
        _ => light(random, size, |random| match random.below(40) {
            0 => f32::NAN,
            1 => f32::INFINITY,
            2 => f32::NEG_INFINITY,
            3 => -1.0,
            // Out of the range of single precision it is infinite or 0.
            4 | 5 => words::number(random).parse().unwrap_or(f32::MAX),
            _ => random.unit() as f32,
        }),
    }
}

fn srgb(random: &mut Random, size: [u32; 2]) -> Vec<u8> {
    let channel = |random: &mut Random| random.below(256) as u8;
    let pixel = |random: &mut Random| [channel(random), channel(random), 99, channel(random) | 15];
    let pixels = (0..size[0] * size[1]).map(|_| pixel(random)).collect();
    let format = if random.one_in(4) { Format::Png16 } else { Format::Png };
    format.encode(&Frame::new(size, false, pixels), &Metadata::default())
}

fn light(random: &mut Random, size: [u32; 2], part: impl Fn(&mut Random) -> f32) -> Vec<u8> {
    let pixel = |random: &mut Random| [part(random), part(random), part(random), 1.0];
    let pixels = (0..size[0] * size[1]).map(|_| pixel(random)).collect();
    let frame = LinearFrame::new(size, true, pixels);
    let format = *random.pick(&[Format::Hdr, Format::Exr, Format::Exr]);
    format.encode_linear(&frame, &Metadata::default(), Compression::Fast)
}
