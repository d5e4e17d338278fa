//! Files of light: Radiance HDR, OpenEXR and PFM.

use exr::prelude::{FlatSamples, ReadChannels, ReadLayers, Vec2};
use image::ImageDecoder;
use image::codecs::hdr::HdrDecoder;
use ugimage::{
    Compression, Format, LinearFrame, Metadata, PictureLimits, Plane, Samples, SpectralPicture,
    read_spectrum,
};

use crate::{linear_frames, read_light};

fn encoded(format: Format, frame: &LinearFrame, metadata: &Metadata) -> Vec<u8> {
    format.encode_linear(frame, metadata, Compression::Fast)
}

fn hdr(size: [u32; 2], rows: &[u8]) -> Vec<u8> {
    let [width, height] = size;
    let header = format!("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {height} +X {width}\n");
    [header.as_bytes(), rows].concat()
}

/// The pixels that `image` reads.
fn expected(file: &[u8], n_pixels: usize) -> Option<Vec<[f32; 3]>> {
    let mut bytes = vec![0; 12 * n_pixels];
    HdrDecoder::new(std::io::Cursor::new(file)).ok()?.read_image(&mut bytes).ok()?;
    let parts: Vec<f32> =
        bytes.chunks_exact(4).map(|part| f32::from_ne_bytes(part.try_into().unwrap())).collect();
    Some(parts.chunks_exact(3).map(|part| part.try_into().unwrap()).collect())
}

#[test]
fn pixels_are_those_of_another_reader() {
    #[track_caller]
    fn check(size: [u32; 2], rows: &[u8]) {
        let file = hdr(size, rows);
        let n_pixels = size[0] as usize * size[1] as usize;
        let found = read_light(&file).ok().map(|(_, pixels)| pixels);
        let found = found.map(|pixels| pixels.iter().map(|&[r, g, b, _]| [r, g, b]).collect());
        assert_eq!(found, expected(&file, n_pixels), "{rows:?}");
    }
    let every = |exponent: u8| [200, 100, 50, exponent];
    let all: Vec<u8> = (0..=255).flat_map(every).collect();
    check([256, 1], &all);
    check([16, 16], &all);
    // Runs of channels.
    let channel = [[131, 7].as_slice(), &[2, 8, 9], &[0], &[129, 130]].concat();
    check([6, 1], &[[2, 2, 0, 6].as_slice(), &channel, &channel, &channel, &channel].concat());
    check([5, 1], &[[2, 2, 0, 6].as_slice(), &channel, &channel, &channel, &channel].concat());
    // Runs of pixels.
    check([4, 1], &[9, 9, 9, 130, 1, 1, 1, 3]);
    check([301, 1], &[[9, 9, 9, 130], [1, 1, 1, 44], [1, 1, 1, 1]].concat());
    check([3, 1], &[9, 9, 9, 130, 1, 1, 1, 3]);
    check([4, 1], &[1, 1, 1, 3]);
    // Truncated.
    check([4, 1], &[9, 9, 9, 130, 1, 1, 1, 2]);
    check([4, 2], &[9, 9, 9, 130, 1, 1, 1, 3]);
    check([0, 0], &[]);
}

/// What the header says of the pixels is applied: factors, axes and primaries.
#[test]
fn headers_of_radiance_are_applied() {
    // Two rows of three pixels as stored, told apart by their red.
    let rows: Vec<u8> = (1..=6).flat_map(|n| [n * 16, 64, 64, 129]).collect();
    let read = |header: &str, size: &str| {
        let file = [format!("#?RADIANCE\r\n{header}\n\r\n{size}\n").as_bytes(), &rows].concat();
        let (size, pixels) = read_light(&file)?;
        let reds: Vec<f32> = pixels.iter().map(|pixel| pixel[0] * 8.0).collect();
        Ok::<_, String>((size, reds, pixels[0]))
    };
    let wide = |reds: [u8; 6]| ([3, 2], reds.map(f32::from).to_vec());
    let high = |reds: [u8; 6]| ([2, 3], reds.map(f32::from).to_vec());
    for (axes, expected) in [
        ("-Y 2 +X 3", wide([1, 2, 3, 4, 5, 6])),
        ("-Y 2 -X 3", wide([3, 2, 1, 6, 5, 4])),
        ("+Y 2 -X 3", wide([6, 5, 4, 3, 2, 1])),
        ("+Y 2 +X 3", wide([4, 5, 6, 1, 2, 3])),
        ("+X 2 -Y 3", high([1, 4, 2, 5, 3, 6])),
        ("-X 2 -Y 3", high([4, 1, 5, 2, 6, 3])),
        ("-X 2 +Y 3", high([6, 3, 5, 2, 4, 1])),
        ("+X 2 +Y 3", high([3, 6, 2, 5, 1, 4])),
    ] {
        let (size, reds, _) = read("FORMAT=32-bit_rle_rgbe", axes).unwrap();
        assert_eq!((size, reds), expected, "{axes}");
    }
    let first = |header: &str| read(header, "-Y 2 +X 3").map(|(.., pixel)| pixel);
    assert_eq!(first("EXPOSURE=2\nEXPOSURE= .5\nEXPOSURE=4"), Ok([0.03125, 0.125, 0.125, 1.0]));
    assert_eq!(first("COLORCORR=.5 2 4"), Ok([0.25, 0.25, 0.125, 1.0]));
    // Radiance's own primaries count as sRGB.
    let radiance = "PRIMARIES=0.640 0.330 0.290 0.600 0.150 0.060 0.333 0.333";
    assert_eq!(first(radiance), Ok([0.125, 0.5, 0.5, 1.0]));
    let xyz = ugphysics::xyz_to_linear_srgb([0.125, 0.5, 0.5]);
    for header in ["FORMAT=32-bit_rle_xyze", "PRIMARIES=1 0 0 1 0 0 .3333 .3333"] {
        let found = first(header).unwrap();
        assert!(
            (0..3).all(|part| (f64::from(found[part]) - xyz[part]).abs() < 1e-6),
            "{found:?} {xyz:?}"
        );
    }
    assert!(first("EXPOSURE=0").unwrap_err().contains("not above 0"));
    assert!(first("FORMAT=x").unwrap_err().contains("FORMAT"));
    for size in ["-Y 2 -Y 3", "-Y 2 +X", "-Y 2 +X three", "2 3"] {
        assert!(read("", size).unwrap_err().contains("its size is not two numbers"), "{size}");
    }
}

/// Ten zeros of a run, whose number would need 80 bits.
#[test]
fn numbers_of_runs_do_not_overflow() {
    let rows = [[9, 9, 9, 130].as_slice(), &[1, 1, 1, 0].repeat(10), &[1, 1, 1, 1]].concat();
    assert!(read_light(&hdr([4, 1], &rows)).is_err());
}

#[test]
fn special_values_are_encoded() {
    for (light, expected) in [
        ([0.0; 3], [0; 4]),
        ([1.0; 3], [128, 128, 128, 129]),
        ([-1.0, 0.5, f32::NAN], [0, 128, 0, 128]),
        ([1e-45; 3], [0; 4]),
        ([f32::INFINITY, 0.0, 0.0], [255, 0, 0, 255]),
    ] {
        let [red, green, blue] = light;
        let frame = LinearFrame::new([1, 1], true, vec![[red, green, blue, 1.0]]);
        assert!(
            encoded(Format::Hdr, &frame, &Metadata::default()).ends_with(&expected),
            "{light:?}"
        );
    }
}

fn decode(file: &[u8]) -> exr::prelude::FlatImage {
    exr::prelude::read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .all_layers()
        .all_attributes()
        .non_parallel()
        .from_buffered(std::io::Cursor::new(file))
        .unwrap()
}

#[test]
fn values_round_trip() {
    let metadata = Metadata {
        software: "ug 1".into(),
        comment: "ug é\nug γ".into(),
        camera: Some(Box::new([[2.0; 16], [3.0; 16]])),
        ..Metadata::default()
    };
    for mut frame in linear_frames() {
        let n_pixels = frame.pixels().len() as u32;
        frame.push_plane(Plane {
            name: "id".into(),
            samples: Samples::Whole((0..n_pixels).rev().collect()),
        });
        let times: Vec<f32> = (0..n_pixels).map(|idx| -(idx as f32)).collect();
        frame.push_plane(Plane { name: "time".into(), samples: Samples::Float(times.clone()) });
        let file = encoded(Format::Exr, &frame, &metadata);
        assert_eq!(file, encoded(Format::Exr, &frame, &metadata));
        let read = decode(&file);
        let layer = &read.layer_data[0];
        assert_eq!(layer.attributes.comments.as_ref().unwrap().to_string(), "ug é\nug ?");
        assert_eq!(layer.attributes.world_to_camera, Some([2.0; 16]));
        assert_eq!(layer.attributes.world_to_normalized_device, Some([3.0; 16]));
        assert_eq!(layer.size, Vec2(frame.width() as usize, frame.height() as usize));
        let channel = |name: &str| {
            layer.channel_data.list.iter().find(|c| c.name.eq(name)).map(|c| &c.sample_data)
        };
        for (idx, name) in ["R", "G", "B"].into_iter().enumerate() {
            let light: Vec<f32> =
                frame.pixels().iter().map(|&pixel| frame.light_of(pixel)[idx]).collect();
            assert_eq!(channel(name), Some(&FlatSamples::F32(light)));
        }
        assert_eq!(channel("A").is_some(), !frame.is_opaque());
        assert_eq!(channel("id"), Some(&FlatSamples::U32((0..n_pixels).rev().collect())));
        assert_eq!(channel("time"), Some(&FlatSamples::F32(times)));
    }
}

fn spectral(names: &[&str]) -> Vec<u8> {
    let mut frame = LinearFrame::new([4, 2], true, vec![[0.0, 0.5, 1.0, 1.0]; 8]);
    for (row, name) in names.iter().enumerate() {
        let numbers = (0..8).map(|idx| (10 * row + idx) as f32).collect();
        frame.push_plane(Plane { name: (*name).to_owned(), samples: Samples::Float(numbers) });
    }
    encoded(Format::Exr, &frame, &Metadata::default())
}

#[test]
fn channels_are_read_in_the_order_of_wavelengths() {
    let limits = PictureLimits::default();
    let names = ["S0.1000nm", "S0.450nm", "S0.449,5nm", "S1.450nm", "S0.95nm", "S0.nm", "S0.-1nm"];
    let file = spectral(&names);
    let picture = read_spectrum(&file, &limits).unwrap();
    let found: Vec<(f64, f32)> =
        picture.samples.iter().map(|(nm, values)| (*nm, values[7])).collect();
    assert_eq!(
        (picture.size, found),
        ([4, 2], vec![(95.0, 47.0), (449.5, 27.0), (450.0, 17.0), (1000.0, 7.0)])
    );
    // Three are colours.
    assert_eq!(read_spectrum(&spectral(&names[..3]), &limits).unwrap(), SpectralPicture::default());
    assert_eq!(read_spectrum(b"\x89PNG", &limits).unwrap(), SpectralPicture::default());
    for length in (4..file.len() - 1).step_by(5) {
        assert!(read_spectrum(&file[..length], &limits).is_err(), "{length}");
    }
    let small = PictureLimits { bytes: 300, ..limits };
    assert!(read_spectrum(&file, &small).is_err());
}

#[test]
fn files_are_read_as_they_were_written() {
    for frame in linear_frames() {
        let (size, pixels) =
            read_light(&encoded(Format::Pfm, &frame, &Metadata::default())).unwrap();
        assert_eq!(size, [frame.width(), frame.height()]);
        let bits = |light: [f32; 3]| light.map(f32::to_bits);
        let written: Vec<_> =
            frame.pixels().iter().map(|&pixel| bits(frame.light_of(pixel))).collect();
        let read: Vec<_> = pixels.iter().map(|&[r, g, b, _]| bits([r, g, b])).collect();
        assert_eq!(read, written);
    }
}

#[test]
fn grey_and_the_other_byte_order_are_read() {
    let file = [&b"Pf 1 2\r\n1.0\n"[..], &2.0_f32.to_be_bytes(), &0.5_f32.to_be_bytes()].concat();
    // Rows run from bottom to top.
    assert_eq!(read_light(&file), Ok(([1, 2], vec![[0.5, 0.5, 0.5, 1.0], [2.0, 2.0, 2.0, 1.0]])));
    assert_eq!(read_light(b"PF 0 0 -1\n"), Ok(([0, 0], Vec::new())));
    // Blanks at the end of the header, or data that begin as blanks, and a line feed at the end.
    for file in [&b"Pf 1 1\n-1.0 \n   A"[..], b"Pf 1 1\n-1.0\n   A", b"Pf 1 1 -1 \r\n   A\n"] {
        let light = f32::from_le_bytes(*b"   A");
        assert_eq!(read_light(file), Ok(([1, 1], vec![[light, light, light, 1.0]])), "{file:?}");
    }
}

#[test]
fn invalid_files_are_refused() {
    for (file, problem) in [
        (&b"PF\n"[..], "its size is not two numbers"),
        (b"PF\n2 -1\n-1.0\n", "its size is not two numbers"),
        (b"PF\n2 1\nx\n", "its scale is not a number"),
        (b"PF\n2 1\n-1.0\n0123", "the file is truncated, or its header is wrong"),
        (
            b"Pf\n1 1\n-1.0\n01234567",
            "it goes on after its pixels: its size or its number of channels is wrong",
        ),
    ] {
        assert_eq!(read_light(file), Err(format!("not a readable PFM file: {problem}")));
    }
    let large = read_light(b"PF 4294967295 4294967295 -1 ").unwrap_err();
    assert!(large.contains("exceed the limit"), "{large}");
}
