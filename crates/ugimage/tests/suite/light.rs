//! Pictures as they are read: light, orientations, colour profiles, limits.

use ugimage::{Compression, Format, LinearFrame, Metadata, PictureLimits, Pixels};

use crate::{read_light, read_picture as read};

/// Bars of 64 x 32 pixels; the upper left is black.
const BARS: &[u8] = include_bytes!("../bars.jpg");

#[test]
fn jpeg_files_are_read_whole_or_not_at_all() {
    let file = BARS;
    let (size, pixels) = read(file).unwrap();
    let Pixels::Srgb(pixels) = pixels else { panic!("8 bits") };
    assert_eq!((size, pixels.len()), ([64, 32], 64 * 32));
    // Colours of several bars, at the lower edge.
    let bottom = &pixels[31 * 64..];
    assert!(bottom.iter().any(|pixel| pixel[0] > 150) && bottom.iter().any(|pixel| pixel[2] > 150));
    for length in 0..file.len() {
        assert!(read(&file[..length]).is_err(), "{length}");
    }
    // What telephones append is not looked at.
    let longer = [file, b"and a film"].concat();
    assert_eq!(read(&longer).unwrap(), (size, Pixels::Srgb(pixels)));
}

#[test]
fn light_is_read_as_it_was_written() {
    let pixel = |idx: u32| [idx as f32 * 0.25, 1.5, 0.0, 1.0];
    let frame = LinearFrame::new([8, 4], true, (0..32).map(pixel).collect());
    for format in [Format::Exr, Format::Hdr] {
        let file = format.encode_linear(&frame, &Metadata::default(), Compression::Fast);
        let (size, pixels) = read_light(&file).unwrap();
        assert_eq!(size, [8, 4]);
        for (found, expected) in pixels.iter().zip(frame.pixels()) {
            let error = (0..4).map(|i| (found[i] - expected[i]).abs()).fold(0.0, f32::max);
            assert!(error <= 0.01 * expected[0].max(1.5), "{format:?}: {found:?} {expected:?}");
        }
        for length in (0..file.len() - 1).step_by(7) {
            assert!(read(&file[..length]).is_err(), "{format:?} {length}");
        }
    }
}

/// 16 bits are not rounded to 8.
#[test]
fn deep_png_files_are_light() {
    for is_opaque in [true, false] {
        let alpha = if is_opaque { 1.0 } else { 0.25 };
        let pixel = |idx: u32| [0.002 + 1e-5 * idx as f32, 0.5 + 1e-4 * idx as f32, 1.0, alpha];
        let frame = LinearFrame::new([8, 4], is_opaque, (0..32).map(pixel).collect());
        let file = Format::Png16.encode_linear(&frame, &Metadata::default(), Compression::Fast);
        let (size, pixels) = read_light(&file).unwrap();
        assert_eq!(size, [8, 4]);
        for (found, expected) in pixels.iter().zip(frame.pixels()) {
            let error = (0..4).map(|i| (found[i] - expected[i]).abs()).fold(0.0, f32::max);
            assert!(error < 2e-5, "{found:?} {expected:?}");
        }
        for length in (0..file.len() - 12).step_by(7) {
            assert!(read(&file[..length]).is_err(), "{length}");
        }
    }
}

/// Headers of pictures that are too large for their files, or for any.
#[test]
fn large_headers_are_refused() {
    let hdr = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1000000 +X 1000000\n";
    assert!(read(hdr).unwrap_err().to_string().contains("exceed the limit"));
    let hdr = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 5000 +X 20000\n";
    assert!(read(hdr).unwrap_err().to_string().contains("truncated"));
    let hdr = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 10000 +X 20000\n";
    assert_eq!(read(hdr).unwrap_err().needed_memory(), Some(3_200_000_000));
    // The size in the header of a small file, changed.
    let frame = LinearFrame::new([8, 4], true, vec![[0.25, 1.5, 0.0, 1.0]; 32]);
    let mut exr = Format::Exr.encode_linear(&frame, &Metadata::default(), Compression::Fast);
    let corner = |x: u32| [x.to_le_bytes(), 3_u32.to_le_bytes()].concat();
    while let Some(at) = exr.windows(8).position(|bytes| bytes == corner(7)) {
        exr[at..at + 8].copy_from_slice(&corner(0xf_ffff));
    }
    assert!(read(&exr).unwrap_err().to_string().contains("header is wrong"));
    let mut jpeg = BARS.to_vec();
    let frame = jpeg.windows(2).position(|pair| matches!(pair, [0xff, 0xc0..=0xc2])).unwrap();
    jpeg[frame + 5..frame + 9].copy_from_slice(&[0x0f, 0xff, 0xff, 0xff]);
    assert!(read(&jpeg).unwrap_err().to_string().contains("header is wrong"));
}

#[test]
fn a_sample_for_no_pixels_is_refused() {
    let frame = LinearFrame::new([8, 4], true, vec![[0.25, 1.5, 0.0, 1.0]; 32]);
    let mut exr = Format::Exr.encode_linear(&frame, &Metadata::default(), Compression::Fast);
    // The first channel: its name, its type, whether it is linear, and a pixel for each sample.
    let channel = b"B\0\x02\0\0\0\0\0\0\0\x01\0\0\0\x01\0\0\0";
    let at = exr.windows(channel.len()).position(|bytes| bytes == channel).unwrap();
    exr[at + 10] = 0;
    assert!(read(&exr).is_err());
}

/// The smallest files of large pictures are read: of one colour, as packed as their formats
/// allow.
#[test]
fn plain_pictures_are_read() {
    let frame = LinearFrame::new([2048, 1024], true, vec![[0.0, 0.0, 0.0, 1.0]; 2048 * 1024]);
    for format in [Format::Exr, Format::Hdr, Format::Png, Format::Png16] {
        let file = format.encode_linear(&frame, &Metadata::default(), Compression::Small);
        assert_eq!(read(&file).unwrap().0, [2048, 1024], "{format:?}");
    }
}

/// A JPEG file with another segment after its first marker.
fn with_segment(marker: u8, data: &[u8]) -> Vec<u8> {
    let length = u16::try_from(data.len() + 2).unwrap().to_be_bytes();
    [&BARS[..2], &[0xff, marker], &length, data, &BARS[2..]].concat()
}

fn srgb(file: &[u8]) -> ([u32; 2], Vec<[u8; 4]>) {
    let (size, pixels) = read(file).unwrap();
    let Pixels::Srgb(pixels) = pixels else { panic!("8 bits") };
    (size, pixels)
}

/// The same picture in CMYK, as Adobe inverts it, and in red, green and blue.
#[test]
fn colours_of_jpeg_are_understood() {
    let (size, expected) = srgb(BARS);
    for file in [&include_bytes!("../cmyk.jpg")[..], include_bytes!("../rgb.jpg")] {
        let (found_size, found) = srgb(file);
        assert_eq!(found_size, size);
        let difference = |(a, b): (&[u8; 4], &[u8; 4])| {
            (0..4).map(|i| u32::from(a[i].abs_diff(b[i]))).sum::<u32>()
        };
        let sum: u32 = found.iter().zip(&expected).map(difference).sum();
        assert!(sum < 6 * expected.len() as u32, "{sum}");
    }
}

/// Each orientation moves the upper left corner of what is stored to another place.
#[test]
fn orientations_of_cameras_are_applied() {
    let (_, stored) = srgb(BARS);
    for little in [true, false] {
        // Where the stored first pixel and the end of the first row are seen.
        for (orientation, first, end) in [
            (1, [0, 0], [63, 0]),
            (2, [63, 0], [0, 0]),
            (3, [63, 31], [0, 31]),
            (4, [0, 31], [63, 31]),
            (5, [0, 0], [0, 63]),
            (6, [31, 0], [31, 63]),
            (7, [31, 63], [31, 0]),
            (8, [0, 63], [0, 0]),
        ] {
            let number = |n: u32, n_bytes: usize| {
                let bytes = if little { n.to_le_bytes() } else { n.to_be_bytes() };
                if little { bytes[..n_bytes].to_vec() } else { bytes[4 - n_bytes..].to_vec() }
            };
            let head = if little { b"Exif\0\0II" } else { b"Exif\0\0MM" };
            let entry = [
                number(0x112, 2),
                number(3, 2),
                number(1, 4),
                number(orientation, 2),
                number(0, 2),
            ]
            .concat();
            let exif =
                [head.to_vec(), number(42, 2), number(8, 4), number(1, 2), entry, number(0, 4)]
                    .concat();
            let (size, pixels) = srgb(&with_segment(0xe1, &exif));
            assert_eq!(size, if orientation < 5 { [64, 32] } else { [32, 64] });
            let at = |[x, y]: [u32; 2]| pixels[(y * size[0] + x) as usize];
            assert_eq!((at(first), at(end)), (stored[0], stored[63]), "{orientation}");
        }
    }
}

/// An ICC profile with primaries of red, green and blue, and a gamma.
fn profile(columns: [[f64; 3]; 3], gamma: f64) -> Vec<u8> {
    let fixed = |x: f64| ((x * 65536.0).round() as i32).to_be_bytes();
    let mut data = Vec::new();
    let mut tags = Vec::new();
    let start = 132 + 12 * 6;
    for (name, column) in [b"rXYZ", b"gXYZ", b"bXYZ"].into_iter().zip(columns) {
        tags.push((name, start + data.len()));
        data.extend(
            [*b"XYZ ", [0; 4], fixed(column[0]), fixed(column[1]), fixed(column[2])].concat(),
        );
    }
    for name in [b"rTRC", b"gTRC", b"bTRC"] {
        tags.push((name, start + data.len()));
        let parts = [gamma, 1.0, 0.0, 0.0, 0.0].map(fixed);
        data.extend([*b"para", [0; 4], [0, 3, 0, 0]].concat());
        data.extend(parts.concat());
    }
    let mut file = vec![0; 128];
    file[16..20].copy_from_slice(b"RGB ");
    file.extend(6_u32.to_be_bytes());
    for (name, at) in tags {
        file.extend([*name, (at as u32).to_be_bytes(), 32_u32.to_be_bytes()].concat());
    }
    file.extend(data);
    file
}

/// Display P3 with a gamma of 2.2: its light in sRGB, by the published matrix.
#[test]
fn colour_profiles_are_applied() {
    const P3: [[f64; 3]; 3] =
        [[0.51512, 0.2412, -0.00105], [0.29198, 0.69225, 0.04189], [0.1571, 0.06657, 0.78407]];
    const SRGB_FROM_P3: [[f64; 3]; 3] =
        [[1.2249, -0.2247, 0.0], [-0.0420, 1.0419, 0.0], [-0.0197, -0.0786, 1.0979]];
    let (_, stored) = srgb(BARS);
    let segment = [b"ICC_PROFILE\0\x01\x01", &profile(P3, 2.2)[..]].concat();
    let (_, pixels) = read_light(&with_segment(0xe2, &segment)).unwrap();
    for (pixel, level) in pixels.iter().zip(&stored) {
        let light = [0, 1, 2].map(|idx| libm::pow(f64::from(level[idx]) / 255.0, 2.2));
        for (found, row) in pixel.iter().zip(SRGB_FROM_P3) {
            let expected: f64 = row.iter().zip(light).map(|(part, light)| part * light).sum();
            assert!((f64::from(*found) - expected).abs() < 2e-3, "{pixel:?} {level:?}");
        }
    }
    // One of sRGB changes nothing; one for inks is told.
    let damaged = [b"ICC_PROFILE\0\x01\x01", &[0; 200][..]].concat();
    let picture =
        ugimage::read_picture(&with_segment(0xe2, &damaged), &PictureLimits::default()).unwrap();
    assert_eq!(picture.pixels, Pixels::Srgb(stored));
    assert_eq!(picture.notes.len(), 1);
}

/// A panorama that says which part of the sphere it shows, as attributes and as elements.
#[test]
fn parts_of_panoramas_are_read() {
    let numbers =
        [("FullPanoWidthPixels", 128), ("FullPanoHeightPixels", 64), ("CroppedAreaLeftPixels", 32)];
    let numbers =
        [&numbers[..], &[("CroppedAreaTopPixels", 16), ("CroppedAreaImageWidthPixels", 64)]]
            .concat();
    let attributes: String =
        numbers.iter().map(|(name, n)| format!(" GPano:{name}=\"{n}\"")).collect();
    let elements: String =
        numbers.iter().map(|(name, n)| format!("<GPano:{name}>{n}</GPano:{name}>")).collect();
    for text in [attributes, elements] {
        let xmp = [b"http://ns.adobe.com/xap/1.0/\0", text.as_bytes()].concat();
        let picture =
            ugimage::read_picture(&with_segment(0xe1, &xmp), &PictureLimits::default()).unwrap();
        assert_eq!(picture.part, Some([0.25, 0.75, 0.25, 0.75]), "{text}");
    }
}

/// A PNG file of gamma 1 has linear light; one of gamma 1/2.2 has the levels of sRGB.
#[test]
fn gamma_of_png_is_applied() {
    let file = |gamma: f32| {
        let mut file = Vec::new();
        let mut encoder = png::Encoder::new(&mut file, 2, 1);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_source_gamma(png::ScaledFloat::new(gamma));
        encoder.write_header().unwrap().write_image_data(&[0, 51, 255, 102, 204, 0]).unwrap();
        file
    };
    let (_, pixels) = read_light(&file(1.0)).unwrap();
    for (found, expected) in pixels.iter().zip([[0.0, 0.2, 1.0], [0.4, 0.8, 0.0]]) {
        assert!((0..3).all(|idx| (found[idx] - expected[idx]).abs() < 1e-4), "{found:?}");
    }
    assert!(matches!(read(&file(0.45455)).unwrap().1, Pixels::Srgb(_)));
}

/// Colour spaces by number in PNG files (cICP) come before gamma; others than those read have a
/// note.
#[test]
fn code_points_of_png_are_applied() {
    let file = |codes: [u8; 4]| {
        let mut file = Vec::new();
        let mut encoder = png::Encoder::new(&mut file, 1, 1);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_source_gamma(png::ScaledFloat::new(0.3));
        let mut writer = encoder.write_header().unwrap();
        writer.write_chunk(png::chunk::ChunkType(*b"cICP"), &codes).unwrap();
        writer.write_image_data(&[51, 51, 204]).unwrap();
        drop(writer);
        ugimage::read_picture(&file, &PictureLimits::default()).unwrap()
    };
    assert_eq!(file([1, 13, 0, 1]).pixels, Pixels::Srgb(vec![[51, 51, 204, 255]]));
    // The sum of the three published rows of each matrix is 1, so that greys are kept.
    for (primaries, expected) in
        [(1, [0.2, 0.2, 0.8]), (9, [0.15625, 0.19490, 0.87118]), (12, [0.2, 0.2, 0.85874])]
    {
        let Pixels::Light(pixels) = file([primaries, 8, 0, 1]).pixels else { panic!("light") };
        let difference = expected.iter().zip(pixels[0]).map(|(a, b): (&f32, f32)| (a - b).abs());
        assert!(difference.fold(0.0, f32::max) < 1e-3, "{primaries} {pixels:?}");
    }
    let picture = file([9, 16, 0, 1]);
    assert_eq!(picture.pixels, Pixels::Srgb(vec![[51, 51, 204, 255]]));
    assert!(
        picture.notes[0].contains("of kind 9/16 (cICP), which is not read"),
        "{:?}",
        picture.notes
    );
}

/// What a file is instead of a picture, in the message.
#[test]
fn files_that_are_no_pictures_are_named() {
    for (file, expected) in [
        (
            &b"RIFF\x10\0\0\0WEBPVP8 "[..],
            "it is a WebP picture; convert it to PNG, JPEG, HDR, EXR or PFM",
        ),
        (b"II*\0\x08\0\0\0", "it is a TIFF picture; convert it"),
        (b"\0\0\0\x1cftypheic", "it is a HEIC or AVIF picture; convert it"),
        (
            b"version https://git-lfs.github.com/spec/v1\n",
            "it is a Git LFS pointer; fetch the file itself",
        ),
        (b"\r\n<!DOCTYPE HTML>", "it is a web page; download the file itself"),
        (b"\x1f\x8b\x08", "it is compressed data; decompress it first"),
        (b"v a 0 0 0 ;", "not a picture of a kind that is read: PNG, JPEG, HDR, EXR or PFM"),
    ] {
        let message = read(file).unwrap_err().to_string();
        assert!(message.starts_with(expected), "{message}");
    }
}

/// Of several parts, the first with colours is read, before those with one channel.
#[test]
fn the_part_with_colours_is_read() {
    use exr::prelude::*;

    let attributes =
        |name: &str| LayerAttributes { layer_name: Some(name.into()), ..Default::default() };
    let depth = AnyChannel::new("Z", FlatSamples::F32(vec![7.0; 2]));
    let colors =
        ["R", "G", "B"].map(|name| AnyChannel::new(name, FlatSamples::F32(vec![0.25, 0.5])));
    let part = |name: &str, list: Vec<AnyChannel<FlatSamples>>| {
        Layer::new((2, 1), attributes(name), Encoding::UNCOMPRESSED, AnyChannels::sort(list.into()))
    };
    let layers = vec![part("depth", vec![depth]), part("colours", colors.into())];
    let image =
        Image::from_layers(ImageAttributes::new(IntegerBounds::from_dimensions((2, 1))), layers);
    let mut file = std::io::Cursor::new(Vec::new());
    image.write().to_buffered(&mut file).unwrap();
    let (_, pixels) = read_light(file.get_ref()).unwrap();
    assert_eq!(pixels, [[0.25, 0.25, 0.25, 1.0], [0.5, 0.5, 0.5, 1.0]]);
    // One channel is grey, whatever it is called.
    for name in ["Z", "A", "+1", "\u{1}", "A+1"] {
        let list = AnyChannels::sort(
            vec![AnyChannel::new(name, FlatSamples::F32(vec![0.25, 0.5]))].into(),
        );
        let mut file = std::io::Cursor::new(Vec::new());
        Image::from_channels((2, 1), list).write().to_buffered(&mut file).unwrap();
        let (_, pixels) = read_light(file.get_ref()).unwrap();
        assert_eq!(pixels, [[0.25, 0.25, 0.25, 1.0], [0.5, 0.5, 0.5, 1.0]], "{name}");
    }
}

/// What EXR files have and is not read is told by name: channels of files that are refused, and
/// pictures for another eye, in parts or in channels.
#[test]
fn what_is_not_read_of_exr_is_told() {
    use exr::prelude::*;

    let channels = |names: &[&str]| {
        let channel = |name: &&str| AnyChannel::new(*name, FlatSamples::F32(vec![0.25, 0.5]));
        AnyChannels::sort(names.iter().map(channel).collect())
    };
    let write = |parts: &[(&str, &[&str])]| {
        let layer = |&(view, names): &(&str, &[&str])| {
            let attributes = LayerAttributes {
                layer_name: Some(format!("part {view}").as_str().into()),
                view_name: (!view.is_empty()).then(|| view.into()),
                ..Default::default()
            };
            Layer::new((2, 1), attributes, Encoding::UNCOMPRESSED, channels(names))
        };
        let layers: Vec<_> = parts.iter().map(layer).collect();
        let attributes = ImageAttributes::new(IntegerBounds::from_dimensions((2, 1)));
        let mut file = std::io::Cursor::new(Vec::new());
        Image::from_layers(attributes, layers).write().to_buffered(&mut file).unwrap();
        file.into_inner()
    };
    let notes = |parts: &[(&str, &[&str])]| {
        let picture = ugimage::read_picture(&write(parts), &PictureLimits::default()).unwrap();
        let grey = [[0.25, 0.25, 0.25, 1.0], [0.5, 0.5, 0.5, 1.0]];
        assert_eq!(picture.pixels, Pixels::Light(grey.to_vec()));
        picture.notes
    };
    const RGB: &[&str] = &["R", "G", "B"];
    assert_eq!(notes(&[("", RGB)]), [""; 0]);
    assert_eq!(notes(&[("", &["r", "g", "b"])]), [""; 0]);
    let two = "of the parts of the file `left` is read, not `right`";
    assert_eq!(notes(&[("left", RGB), ("right", RGB)]), [two]);
    let both = [RGB, &["right.R", "right.G", "right.B"]].concat();
    assert_eq!(notes(&[("", &both)]), ["the picture for another eye is not read: `right`"]);
    let refused = write(&[("", &["N.X", "N.Y", "id"])]);
    let refused =
        ugimage::read_picture(&refused, &PictureLimits::default()).unwrap_err().to_string();
    assert_eq!(
        refused,
        "not a readable EXR file: it has no channels of colours (`R`, `G`, `B`, or `Y`): its \
         channels are `N.X`, `N.Y`, `id`"
    );
}

/// The picture of a JPEG file with a gain map is read without it, with a note.
#[test]
fn gain_maps_are_told() {
    let notes = |kind: u8, text: &[u8]| {
        ugimage::read_picture(&with_segment(kind, text), &PictureLimits::default()).unwrap().notes
    };
    let told = ["its gain map is not read: bright light is that of the picture itself"];
    let xmp =
        b"http://ns.adobe.com/xap/1.0/\0<x xmlns:hdrgm=\"http://ns.adobe.com/hdr-gain-map/1.0/\"";
    assert_eq!(notes(0xe1, xmp), told);
    assert_eq!(notes(0xe2, b"urn:iso:std:iso:ts:21496:-1\0"), told);
    assert_eq!(notes(0xe1, b"http://ns.adobe.com/xap/1.0/\0<x>"), [""; 0]);
    // In a comment it is only text.
    assert_eq!(notes(0xfe, xmp), [""; 0]);
}

/// A layer beside the middle of its display window, in X, Y and Z.
#[test]
fn windows_and_chromaticities_of_exr_are_applied() {
    use exr::prelude::*;

    let white = ugphysics::WHITE_XYZ.map(|part| part as f32);
    let channels = SpecificChannels::rgb(move |_| (white[0], white[1], white[2]));
    let attributes = LayerAttributes { layer_position: Vec2(11, 21), ..Default::default() };
    let layer = Layer::new((2, 1), attributes, Encoding::UNCOMPRESSED, channels);
    let mut image = Image::from_layer(layer);
    image.attributes.display_window = IntegerBounds::new((10, 20), (4, 3));
    image.attributes.chromaticities = Some(attribute::Chromaticities {
        red: Vec2(1.0, 0.0),
        green: Vec2(0.0, 1.0),
        blue: Vec2(0.0, 0.0),
        white: Vec2(1.0 / 3.0, 1.0 / 3.0),
    });
    let mut file = std::io::Cursor::new(Vec::new());
    image.write().to_buffered(&mut file).unwrap();
    let (size, pixels) = read_light(file.get_ref()).unwrap();
    assert_eq!(size, [4, 3]);
    for (idx, pixel) in pixels.iter().enumerate() {
        let expected = if matches!(idx, 5 | 6) { 1.0 } else { 0.0 };
        assert!((0..3).all(|part| (pixel[part] - expected).abs() < 1e-5), "{idx} {pixel:?}");
    }
}
