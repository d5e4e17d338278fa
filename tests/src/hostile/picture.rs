//! Hostile pictures with recorded commands, the input of `ugsheet`.

use ugimage::{Format, Frame, Metadata};
use ugtesting::Random;

use super::{Files, bytes, words};

/// One to three pictures.
pub fn files(random: &mut Random) -> (Files, &'static str) {
    let n = 1 + random.below(3);
    let picture = |idx: usize, random: &mut Random| {
        let mut bytes = png(random);
        if random.one_in(2) {
            bytes::damage(random, &mut bytes);
        }
        (format!("{idx}.png"), bytes)
    };
    ((0..n).map(|idx| picture(idx, random)).collect(), "pictures")
}

/// A picture with its history.
pub fn png(random: &mut Random) -> Vec<u8> {
    let side = *random.pick(&[1, 2, 7, 40]);
    let mut pixels = image::RgbImage::new(side, side);
    pixels.pixels_mut().for_each(|pixel| *pixel = image::Rgb([random.below(256) as u8, 0, 99]));
    let mut bytes = Vec::new();
    pixels
        .write_to(&mut std::io::Cursor::new(&mut bytes), image::ImageFormat::Png)
        .unwrap_or_else(|error| panic!("a picture of {side} pixels is encoded: {error}"));
    let text = format!("Comment\0uglorentz -vel {}\n{}", words::beta(random), words::name(random));
    // Behind the signature and the header.
    drop(bytes.splice(33..33, chunk(*b"tEXt", text.as_bytes())));
    bytes
}

/// A picture of any format, with its history.
pub fn with_history(random: &mut Random) -> Vec<u8> {
    let comment = format!("ugrainbow -cap {}\n{}", words::name(random), words::number(random));
    let history = Metadata { software: "ugrainbow".to_owned(), comment, ..Metadata::default() };
    random.pick(&Format::ALL).encode(&Frame::new([2, 1], false, vec![[9, 99, 199, 255]; 2]), &history)
}

fn chunk(kind: [u8; 4], data: &[u8]) -> Vec<u8> {
    let mut body = kind.to_vec();
    body.extend(data);
    let mut bytes = (data.len() as u32).to_be_bytes().to_vec();
    bytes.extend(&body);
    bytes.extend(crc(&body).to_be_bytes());
    bytes
}

/// CRC-32 as PNG has it.
pub fn crc(bytes: &[u8]) -> u32 {
    let step = |crc: u32| if crc & 1 == 1 { 0xedb8_8320 ^ (crc >> 1) } else { crc >> 1 };
    !bytes.iter().fold(!0, |crc, &byte| (0..8).fold(crc ^ u32::from(byte), |crc, _| step(crc)))
}
