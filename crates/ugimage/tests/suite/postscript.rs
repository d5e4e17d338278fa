//! PostScript and PPM: pictures over white.

use ugimage::{Format, Frame, Metadata};
use ugphysics::{srgb_decode, srgb_encode};

use crate::frames;

/// The bytes of base 85 text.
pub fn decoded_85(text: &str) -> Vec<u8> {
    let mut bytes = Vec::new();
    let text = text.replace('z', "!!!!!");
    let digits: Vec<u64> =
        text.bytes().filter(u8::is_ascii_graphic).map(|c| u64::from(c - b'!')).collect();
    for group in digits.chunks(5) {
        let word = (0..5).fold(0, |word, at| 85 * word + group.get(at).copied().unwrap_or(84));
        bytes.extend(&u32::try_from(word).unwrap().to_be_bytes()[..group.len() - 1]);
    }
    bytes
}

/// What the filter `RunLengthDecode` makes of bytes.
fn unpacked(mut coded: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::new();
    loop {
        let n = usize::from(coded[0]);
        coded = match n {
            128 => break,
            0..128 => {
                bytes.extend(&coded[1..n + 2]);
                &coded[n + 2..]
            }
            _ => {
                bytes.extend([coded[1]].repeat(257 - n));
                &coded[2..]
            }
        };
    }
    assert_eq!(coded, [128], "the end of the data");
    bytes
}

/// What interpreters read of PostScript, and another reader of PPM, is the picture over white.
/// Bytes that are alike take less space, and no line of data looks like a comment.
#[test]
fn pictures_are_over_white() {
    for frame in frames() {
        let over_white = |level: u8, alpha: u8| {
            let alpha = f64::from(alpha) / 255.0;
            255.0 * srgb_encode(alpha * srgb_decode(f64::from(level) / 255.0) + 1.0 - alpha)
        };
        let expected: Vec<f64> = frame
            .pixels()
            .iter()
            .flat_map(|&[r, g, b, a]| [r, g, b].map(|level| over_white(level, a)))
            .collect();
        let check = |found: &[u8]| {
            assert_eq!(found.len(), expected.len());
            assert!(
                found.iter().zip(&expected).all(|(a, b)| (f64::from(*a) - b).abs() < 0.51),
                "{found:?}"
            );
        };
        let file = String::from_utf8(Format::Eps.encode(&frame, &Metadata::default())).unwrap();
        let data = file.split_once("\nUgImage\n").unwrap().1.split_once("~>").unwrap().0;
        assert!(data.lines().all(|line| !line.starts_with('%') && line.len() <= 100));
        let coded = decoded_85(data);
        check(&unpacked(&coded));
        assert!(coded.len() <= expected.len() + expected.len() / 100 + 2);
        let is_plain = frame.pixels().iter().all(|pixel| *pixel == frame.pixels()[0]);
        assert!(!is_plain || coded.len() <= 4 + expected.len() / 60);
        let file = Format::Ppm.encode(&frame, &Metadata::default());
        let read = image::load_from_memory_with_format(&file, image::ImageFormat::Pnm)
            .unwrap()
            .into_rgb8();
        assert_eq!(read.dimensions(), (frame.width(), frame.height()));
        check(read.as_raw());
    }
}

#[test]
fn metadata_is_in_comments() {
    let comments = |software: &str, comment: &str| {
        let metadata =
            Metadata { software: software.into(), comment: comment.into(), ..Metadata::default() };
        String::from_utf8(Format::Eps.encode(&Frame::opaque(1, 1), &metadata)).unwrap()
    };
    let file = comments("ug\n1", "a -vel .9\nγ");
    assert!(
        file.contains("\n%%Creator: ug?1\n") && file.contains("%%EndComments\n% a -vel .9\n% ?\n"),
        "{file}"
    );
    let long = comments("", &"x".repeat(1000));
    let lines: Vec<_> =
        long.lines().filter(|line| line.contains("xx") && line.starts_with('%')).collect();
    assert!(lines.iter().all(|line| line.len() <= 255) && !long.contains("Creator"));
    assert_eq!(lines.concat().matches("x").count(), 1000);
}
