//! PNG files as they are written.

use ugimage::{
    Compression, Format, Frame, LinearFrame, Metadata, PanoramaArea, read_history, read_png_header,
};

use crate::linear_frames;
use crate::read::with_chunks;

/// The keyword of XMP packets.
const XMP: &str = "XML:com.adobe.xmp";

/// Decodes with the `png` crate: pixels, texts, and the colour type.
fn decode(file: &[u8]) -> (png::OutputInfo, Vec<u8>, png::Info<'static>) {
    let mut reader = png::Decoder::new(std::io::Cursor::new(file)).read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    let output = reader.next_frame(&mut pixels).unwrap();
    reader.finish().unwrap();
    (output, pixels, reader.info().clone())
}

/// A smooth image, as rendered images usually are.
#[test]
fn small_files_have_the_same_pixels() {
    let level = |part: f64| (255.0 * part).round() as u8;
    let pixels = (0..200 * 100).map(|idx| {
        let (x, y) = (f64::from(idx % 200) / 199.0, f64::from(idx / 200) / 99.0);
        [level(x * y), level((1.0 - x) * y * y), level((x - y).abs()), 255]
    });
    let frame = Frame::new([200, 100], true, pixels.collect());
    let light = LinearFrame::from(&frame);
    let of_8 = |compression| Format::Png.encode_with(&frame, &Metadata::default(), compression);
    let of_16 =
        |compression| Format::Png16.encode_linear(&light, &Metadata::default(), compression);
    for [fast, small] in [
        [Compression::Fast, Compression::Small].map(of_8),
        [Compression::Fast, Compression::Small].map(of_16),
    ] {
        assert_eq!(decode(&fast).1, decode(&small).1);
        assert!(small.len() < fast.len(), "{} {}", small.len(), fast.len());
    }
}

/// Noise, which cannot be compressed, and which fills several chunks.
fn noise() -> Frame {
    let size = [400, 300];
    let mut state = 1_u32;
    let pixels = (0..size[0] * size[1]).map(|_| {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        let [_, r, g, b] = state.to_le_bytes();
        [r, g, b, 255]
    });
    Frame::new(size, true, pixels.collect())
}

#[test]
fn noise_is_stored() {
    let frame = noise();
    let file = Format::Png.encode(&frame, &Metadata::default());
    let n_bytes = 3 * frame.pixels().len();
    assert!(file.len() < n_bytes + n_bytes / 100, "{} of {n_bytes}", file.len());
    let expected: Vec<u8> = frame.pixels().iter().flat_map(|&[r, g, b, _]| [r, g, b]).collect();
    assert_eq!(decode(&file).1, expected);
}

#[test]
fn sixteen_bits_are_the_nearest_levels() {
    for frame in linear_frames() {
        let (output, bytes, _) =
            decode(&Format::Png16.encode_linear(&frame, &Metadata::default(), Compression::Fast));
        assert_eq!(output.bit_depth, png::BitDepth::Sixteen);
        let channels = if frame.is_opaque() { 3 } else { 4 };
        assert_eq!(bytes.len(), frame.pixels().len() * 2 * channels);
        for (bytes, light) in bytes.chunks(2 * channels).zip(frame.pixels()) {
            let levels: Vec<f64> = bytes
                .chunks(2)
                .map(|pair| f64::from(u16::from_be_bytes([pair[0], pair[1]])))
                .collect();
            for (level, light) in levels.iter().zip(&light[..3]) {
                let back = ugphysics::srgb_decode(level / 65535.0);
                // Half a level, where decoding is steepest: 2.4/1.055 per unit.
                assert!((back - f64::from(*light).clamp(0.0, 1.0)).abs() < 0.51 * 2.3 / 65535.0);
            }
            if let Some(alpha) = levels.get(3) {
                assert_eq!(*alpha, (65535.0 * f64::from(light[3])).round());
            }
        }
    }
}

#[test]
fn metadata_round_trips() {
    let frame = Frame::opaque(1, 1);
    let metadata = Metadata {
        software: "ug 1".into(),
        comment: "ug -vel .9 0 0\nug\u{e9}".into(),
        ..Metadata::default()
    };
    let (_, _, info) = decode(&Format::Png.encode(&frame, &metadata));
    let texts: Vec<_> =
        info.uncompressed_latin1_text.iter().map(|chunk| (&*chunk.keyword, &*chunk.text)).collect();
    assert_eq!(texts, [("Software", "ug 1"), ("Comment", "ug -vel .9 0 0\nug\u{e9}")]);

    let metadata =
        Metadata { software: String::new(), comment: "γ = 2\0".into(), ..Metadata::default() };
    let (_, _, info) = decode(&Format::Png.encode(&frame, &metadata));
    assert!(info.uncompressed_latin1_text.is_empty());
    assert_eq!(info.utf8_text[0].get_text().unwrap(), "γ = 2");
}

/// A panorama has one chunk that says so, read again with the history; other pictures have
/// none.
#[test]
fn panoramas_state_their_area() {
    let area = PanoramaArea { whole: [8, 4], corner: [3, 1] };
    let metadata = Metadata {
        software: "ug 1".into(),
        comment: "ug γ".into(),
        panorama: Some(area),
        ..Metadata::default()
    };
    let frame = Frame::opaque(3, 2);
    let file = Format::Png.encode(&frame, &metadata);
    let (_, pixels, info) = decode(&file);
    assert_eq!(pixels, decode(&Format::Png.encode(&frame, &Metadata::default())).1);
    let xmp = info.utf8_text.iter().filter(|chunk| chunk.keyword == XMP).collect::<Vec<_>>();
    assert_eq!(xmp.len(), 1);
    assert!(!xmp[0].compressed);
    assert_eq!(read_png_header(&file).unwrap().1, metadata);
    assert_eq!(read_history(&file).unwrap(), "ug γ");
    let deep =
        Format::Png16.encode_linear(&LinearFrame::from(&frame), &metadata, Compression::Fast);
    assert_eq!(read_png_header(&deep).unwrap().1, metadata);

    let plain = Format::Png.encode(&frame, &Metadata { panorama: None, ..metadata });
    assert!(!plain.windows(XMP.len()).any(|bytes| bytes == XMP.as_bytes()));
}

#[test]
fn no_date_is_written() {
    let metadata = Metadata { software: "a".into(), comment: "b".into(), ..Metadata::default() };
    let file = Format::Png.encode(&Frame::opaque(3, 2), &metadata);
    assert!(!file.windows(4).any(|kind| kind == b"tIME"));
    assert_eq!(file, Format::Png.encode(&Frame::opaque(3, 2), &metadata));
}

/// The packet as viewers read it: one element with all attributes, which end where they should.
#[test]
fn the_packet_is_well_formed() {
    let area = PanoramaArea { whole: [4096, 2048], corner: [1024, 512] };
    let metadata = Metadata { panorama: Some(area), ..Metadata::default() };
    let file = Format::Png.encode(&Frame::opaque(2048, 1024), &metadata);
    let text = decode(&file).2.utf8_text[0].get_text().unwrap();
    let body = text.split_once("?>").unwrap().1.rsplit_once("<?xpacket").unwrap().0.trim();
    let mut open = Vec::new();
    for tag in body.split('<').skip(1).map(|part| part.split_once('>').unwrap().0) {
        match tag.strip_prefix('/') {
            Some(name) => assert_eq!(open.pop(), Some(name)),
            None if tag.ends_with('/') => assert!(tag.starts_with("rdf:Description ")),
            None => open.push(tag.split_whitespace().next().unwrap()),
        }
    }
    assert!(open.is_empty());
    let description = body.split_once("<rdf:Description ").unwrap().1.split_once("/>").unwrap().0;
    let attributes: Vec<_> = description.split_whitespace().collect();
    assert_eq!(
        attributes,
        [
            "rdf:about=\"\"",
            "xmlns:GPano=\"http://ns.google.com/photos/1.0/panorama/\"",
            "GPano:UsePanoramaViewer=\"True\"",
            "GPano:ProjectionType=\"equirectangular\"",
            "GPano:FullPanoWidthPixels=\"4096\"",
            "GPano:FullPanoHeightPixels=\"2048\"",
            "GPano:CroppedAreaImageWidthPixels=\"2048\"",
            "GPano:CroppedAreaImageHeightPixels=\"1024\"",
            "GPano:CroppedAreaLeftPixels=\"1024\"",
            "GPano:CroppedAreaTopPixels=\"512\"",
        ]
    );
    let read = |text: &str| {
        let chunk = [XMP.as_bytes(), &[0; 5], text.as_bytes()].concat();
        read_png_header(&with_chunks(&[(b"iTXt", chunk)])).unwrap().1.panorama
    };
    assert_eq!(read(&text), Some(area));
    assert_eq!(read(&text.replace("4096", "-1")), None);
    assert_eq!(read("<x:xmpmeta/>"), None);
}
