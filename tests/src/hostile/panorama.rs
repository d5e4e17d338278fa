//! Panoramas and lists of stars for `ugwarp`: PNG, JPEG, HDR, EXR and CSV files.

use std::fmt::Write;

use ugimage::{Compression, Format, Frame, LinearFrame, Metadata};
use ugrandom::Random;

use super::{Files, bytes, words};

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

/// A panorama of any format, sometimes of a shape that is none, or with light that is not finite.
pub fn file(random: &mut Random) -> Vec<u8> {
    let size = *random.pick(&[[64, 32], [16, 8], [2, 1], [48, 8], [32, 24], [8, 8], [1, 1], [40, 1]]);
    encoded(random, size)
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
