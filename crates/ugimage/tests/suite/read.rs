//! PNG files as they are read.

use ugimage::{Format, Frame, Metadata, PictureLimits, ReadError, read_png, read_png_header};

use crate::frames;

/// Bytes of texts that are read.
const MAX_TEXT: usize = 1 << 20;

fn read(file: &[u8]) -> Result<(Frame, Metadata), ReadError> {
    read_png(file, &PictureLimits::default())
}

#[test]
fn png_round_trip() {
    for comment in ["uglorentz -vel .9 0 0\nugrainbow", "γ = 2", ""] {
        let metadata =
            Metadata { software: "ug 1".into(), comment: comment.into(), ..Metadata::default() };
        for frame in frames() {
            assert_eq!(
                read(&Format::Png.encode(&frame, &metadata)).unwrap(),
                (frame, metadata.clone())
            );
        }
    }
}

#[test]
fn sixteen_bits_and_greys_are_read() {
    for frame in frames() {
        let (deep, _) = read(&Format::Png16.encode(&frame, &Metadata::default())).unwrap();
        let near = |(a, b): (&[u8; 4], &[u8; 4])| a.iter().zip(b).all(|(a, b)| a.abs_diff(*b) <= 1);
        assert!(deep.pixels().iter().zip(frame.pixels()).all(near));
    }
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, 3, 1);
    encoder.set_color(png::ColorType::Grayscale);
    encoder.set_depth(png::BitDepth::Two);
    encoder.write_header().unwrap().write_image_data(&[0b0001_1100]).unwrap();
    let (frame, _) = read(&file).unwrap();
    assert_eq!(frame.pixels(), [[0, 0, 0, 255], [85, 85, 85, 255], [255, 255, 255, 255]]);
}

#[test]
fn broken_files_are_refused() {
    let file = Format::Png.encode(&frames()[2], &Metadata::default());
    assert!(read(b"").is_err());
    assert_eq!(
        read(b"GIF89a").unwrap_err().to_string(),
        "not a PNG file, the only kind that is read"
    );
    assert!(
        read(b"\x89PNG\r\n\x1a\n")
            .unwrap_err()
            .to_string()
            .starts_with("not a readable PNG file: ")
    );
    for length in 0..file.len() - 30 {
        assert!(read(&file[..length]).is_err(), "{length}");
    }
    let mut huge = file;
    huge[16..20].copy_from_slice(&0x7fff_ffff_u32.to_be_bytes());
    assert!(read(&huge).is_err());
}

#[test]
fn palettes_have_whole_colors_and_256_at_most() {
    for n_bytes in [1, 2, 3, 7, 8, 768, 769, 771, 3000] {
        let mut file = Vec::new();
        let mut encoder = png::Encoder::new(&mut file, 3, 1);
        encoder.set_color(png::ColorType::Indexed);
        encoder.set_palette(vec![9; n_bytes]);
        encoder.set_trns(vec![128]);
        encoder.write_header().unwrap().write_image_data(&[0; 3]).unwrap();
        assert_eq!(read(&file).is_ok(), [3, 768].contains(&n_bytes), "{n_bytes} bytes");
    }
}

/// A PNG of one pixel with these chunks after its header.
pub fn with_chunks(chunks: &[(&[u8; 4], Vec<u8>)]) -> Vec<u8> {
    let file = Format::Png.encode(&Frame::opaque(1, 1), &Metadata::default());
    let (header, rest) = file.split_at(33);
    let mut whole = header.to_vec();
    for (kind, data) in chunks {
        whole.extend_from_slice(&(data.len() as u32).to_be_bytes());
        whole.extend_from_slice(*kind);
        whole.extend_from_slice(data);
        whole.extend_from_slice(&crc32(&[&kind[..], data].concat()).to_be_bytes());
    }
    whole.extend_from_slice(rest);
    whole
}

/// The checksum of a PNG chunk (CRC-32), computed bit by bit.
fn crc32(bytes: &[u8]) -> u32 {
    let step = |crc: u32, _| if crc & 1 == 0 { crc >> 1 } else { crc >> 1 ^ 0xedb8_8320 };
    !bytes.iter().fold(u32::MAX, |crc, &byte| (0..8).fold(crc ^ u32::from(byte), step))
}

fn packed(text: &[u8]) -> Vec<u8> {
    miniz_oxide::deflate::compress_to_vec_zlib(text, 6)
}

#[test]
fn texts_of_every_kind_are_read() {
    let ztxt = |keyword: &str, text: &[u8]| [keyword.as_bytes(), b"\0\0", &packed(text)].concat();
    let itxt = |flag: u8, text: Vec<u8>| {
        [&b"Comment\0"[..], &[flag, 0], b"el\0\xce\xb3\0", &text].concat()
    };
    let comment = |chunks: &[(&[u8; 4], Vec<u8>)]| {
        let file = with_chunks(chunks);
        let (size, metadata) = read_png_header(&file).unwrap();
        assert_eq!((size, read(&file).unwrap().1), ([1, 1], metadata.clone()));
        metadata.comment
    };
    assert_eq!(comment(&[(b"tEXt", b"Comment\0caf\xe9".to_vec())]), "café");
    assert_eq!(comment(&[(b"zTXt", ztxt("Comment", b"caf\xe9"))]), "café");
    assert_eq!(comment(&[(b"iTXt", itxt(0, "γ = 2".into()))]), "γ = 2");
    assert_eq!(comment(&[(b"iTXt", itxt(1, packed("γ = 2".as_bytes())))]), "γ = 2");
    assert_eq!(
        comment(&[(b"tEXt", b"Author\0me".to_vec()), (b"tEXt", b"Comment\0x".to_vec())]),
        "x"
    );
    // Invalid chunks are skipped, and those after them are read.
    let valid = (b"tEXt", b"Comment\0valid".to_vec());
    for invalid in
        [b"".to_vec(), b"Comment".to_vec(), b"Comment\0".to_vec(), b"Comment\0\0broken".to_vec()]
    {
        assert_eq!(comment(&[(b"zTXt", invalid.clone()), valid.clone()]), "valid");
        assert_eq!(comment(&[(b"iTXt", invalid), valid.clone()]), "valid");
    }
    assert_eq!(comment(&[(b"iTXt", itxt(0, b"\xff".to_vec())), valid]), "valid");
}

/// Each chunk is small and unpacks to more than is read.
#[test]
fn packed_texts_and_profiles_are_unpacked_up_to_a_limit() {
    let bomb = packed(&vec![b'a'; MAX_TEXT + 1]);
    assert!(bomb.len() < 10_000);
    let file = |length: usize| {
        let text = packed(&vec![b'a'; length]);
        with_chunks(&[(b"zTXt", [b"Comment\0\0", &text[..]].concat())])
    };
    assert_eq!(read_png_header(&file(MAX_TEXT)).unwrap().1.comment.len(), MAX_TEXT);
    assert_eq!(read_png_header(&file(MAX_TEXT + 1)).unwrap().1.comment, "");
    let profile = with_chunks(&[
        (b"iCCP", [b"name\0\0", &bomb[..]].concat()),
        (b"iTXt", [b"Comment\0\x01\0\0\0", &bomb[..]].concat()),
        (b"zTXt", [b"Other\0\0", &bomb[..]].concat()),
    ]);
    assert_eq!(read(&profile).unwrap(), (Frame::opaque(1, 1), Metadata::default()));
}
