//! Colours that are pictures, and texture coordinates.

use std::io;
use std::path::Path;

use ugparse::{Options, RequestKind, Source};
use ugscene::{AlphaMode, Scene, Wrap};
use ugtesting::Random;

use crate::language::{check_error, flat, parse, write};

/// The smallest picture: PFM with one pixel.
const PICTURE: &[u8] = b"PF\n1 1\n-1\n\0\0\0\0\0\0\0\0\0\0\0\0";

/// A scene with its files.
fn with_files(name: &str, text: &str, files: &[(&str, &[u8])]) -> Result<Scene, String> {
    let source = Source::new(name, text);
    let load = |request: &ugparse::Request<'_>| {
        let found = files.iter().find(|(name, _)| Path::new(name) == request.path);
        assert!(
            found.is_none() || matches!(request.kind, RequestKind::Image | RequestKind::Include)
        );
        let bytes = found.map(|(_, bytes)| bytes.to_vec());
        bytes.ok_or_else(|| io::Error::other("no such file").into())
    };
    let whole = ugparse::include(source, &Options::default(), load);
    let parsed = whole.and_then(|whole| ugparse::parse(&whole, &Options::default()));
    parsed.map(|parsed| parsed.scene).map_err(|found| found.render(false))
}

#[test]
fn statements_are_read_and_written() {
    for (text, expected) in [
        ("c_rgb w 1 1 1; c_tex w a.png ;", "c_rgb w 1 1 1;\nc_tex w \"a.png\";\n"),
        (
            "c_tex w \"a b.png\" -wrap clamp -mask -factor 1 +.5 .25 ; c_rgb w 1 1 1;",
            "c_rgb w 1 1 1;\nc_tex w \"a b.png\" -wrap clamp -factor 1 0.5 0.25 -mask 0.5;\n",
        ),
        (
            "c w 1; c_tex w { of the wall } a.glb -nearest -blend -wrap mirror repeat -image 2 -factor 0 0 0 .1;",
            "c w 1;\nc_tex w \"a.glb\" -image 2 -wrap mirror repeat -factor 0 0 0 0.1 -blend -nearest;\n{ of the wall }\n",
        ),
        ("c b 1; c_emit b a ; c a 2;", "c b 1;\nc a 2;\nc_emit b a;\n"),
        ("v a 0 0 0 (.1 -1e-9);", "v a 0 0 0 (0.1 -1e-9);\n"),
        ("c r 1; v a 0 0 0 r 0 0 1 (16777216 3);", "c r 1;\nv a 0 0 0 r 0 0 1 (16777216 3);\n"),
    ] {
        assert_eq!(flat(text), expected, "{text}");
    }
    let scene = parse("c w 1; c_tex w a.png -wrap mirror clamp -mask .25;");
    let texture = &scene.textures[0];
    assert_eq!((texture.wrap, texture.alpha), ([Wrap::Mirror, Wrap::Clamp], AlphaMode::Mask(0.25)));
}

/// Coordinates of any bits, in the fast form of a vertex and in the others, keep them.
#[test]
fn coordinates_keep_their_bits() {
    let mut random = Random(7);
    for round in 0..20_000_u32 {
        let uv = [0; 2].map(|_| {
            loop {
                let value = f32::from_bits(random.bits() as u32);
                if value.is_finite() {
                    return value;
                }
            }
        });
        let mut scene = parse(if round % 2 == 0 { "v a 0 0 0;" } else { "v a 0 0 0 0 0 1;" });
        scene.vertices[0].uv = Some(uv);
        let again = parse(write(&scene)).vertices[0].uv.unwrap();
        assert_eq!(again.map(f32::to_bits), uv.map(f32::to_bits), "{uv:?}");
    }
}

/// Names are relative to the file with the statement; written, to the current folder.
#[test]
fn pictures_are_found_from_their_scene() {
    let house = "include parts/wall.ug; c_tex roof tiles.png; c roof 1;";
    let files: [(&str, &[u8]); 3] = [
        ("house/parts/wall.ug", b"c wall 1; c_tex wall ./brick.png;"),
        ("house/parts/brick.png", PICTURE),
        ("house/tiles.png", PICTURE),
    ];
    let scene = with_files("house/house.ug", house, &files).unwrap();
    let text = write(&scene);
    assert!(text.contains("c_tex wall \"house/parts/brick.png\";"), "{text}");
    assert!(text.contains("c_tex roof \"house/tiles.png\";"), "{text}");
    assert!(scene.textures.iter().all(|texture| *texture.image.bytes == *PICTURE));
    // The next program of a pipe finds them by these names.
    let piped = with_files("<stdin>", &text, &files).unwrap();
    assert_eq!(write(&piped), text);
    // Without a reader of files the scene is complete, but for the bytes.
    assert!(parse(&text).textures.iter().all(|texture| texture.image.bytes.is_empty()));
    // Definitions see the colours around them.
    let scene = parse("c w 1; def d; c_tex w a.png; c own 1; c_tex own b.png; end;");
    let names: Vec<_> = scene
        .textures
        .iter()
        .map(|it| scene.names.get(scene.colors[it.color.index()].name))
        .collect();
    assert_eq!(names, ["w", "d:own"]);
}

#[test]
fn errors_have_a_place_and_a_remedy() {
    for (text, message) in [
        ("c_tex w a.png;", "colour `w` is not defined"),
        ("c w 1; c_tex w a.png; c_tex w b.png;", "colour `w` has two pictures"),
        ("c w 1; c_emit w v;", "colour `v` is not defined"),
        ("c w 1; c_emit v w;", "colour `v` is not defined"),
        ("c w 1; c_emit w w; c_emit w w;", "colour `w` emits two colours"),
        (
            "c w 1; c_emit w;",
            "expected a name that begins with a letter, `:`, `_` or `#`, found `;`",
        ),
        ("c w 1; c_tex w;", "expected the file of a picture, found `;`"),
        (
            "c w 1; c_tex w a.png -wrap round;",
            "expected `repeat`, `clamp` or `mirror`, found `round`",
        ),
        ("c w 1; c_tex w a.png -factor 1 -1 1;", "the number `-1` is out of range"),
        ("c w 1; c_tex w a.png -image -1;", "expected the number of a picture, from 0, found `-1`"),
        (
            "c w 1; c_tex w a.png -glow;",
            "expected `;` or an option of a picture (-image -wrap -factor -mask -blend -nearest), found `-glow`",
        ),
        ("v a 0 0 0 (1);", "expected a number, found `)`"),
        ("v a 0 0 0 (nan 0);", "expected a number, found `nan`"),
        ("v a 0 0 0 (0 1e300);", "the number `1e300` is out of range"),
        ("v a 0 0 0 (0 1e999);", "the number `1e999` is too large"),
        ("v a 0 0 0 (0 0 0);", "expected `)`, found `0`"),
    ] {
        check_error(text, message);
    }
    let error = |file: &[u8]| {
        with_files("a.ug", "c w 1;\nc_tex w a.png;", &[("a.png", file)]).expect_err("no picture")
    };
    let shown = error(b"v a 0 0 0;");
    assert!(shown.contains("cannot read `a.png`: not a picture of a kind that is read"), "{shown}");
    assert!(
        shown.contains("--> a.ug:2:9") && shown.contains("help: give a picture (PNG,"),
        "{shown}"
    );
    let missing = with_files("a.ug", "c w 1;\nc_tex w b.png;", &[]).unwrap_err();
    assert!(
        missing.contains("cannot read `b.png`: no such file") && missing.contains("a.ug:2:9"),
        "{missing}"
    );
    // A header that claims 60,000 x 60,000 pixels.
    let mut png =
        b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\xea\x60\0\0\xea\x60\x08\x02\0\0\0\0\0\0\0".to_vec();
    let crc = png_crc(&png[12..29]);
    png[29..33].copy_from_slice(&crc.to_be_bytes());
    png.extend(b"\0\0\0\0IDAT\x35\xaf\x06\x1e");
    let shown = error(&png);
    assert!(shown.contains("60000 x 60000 pixels exceed the limit of 268435456"), "{shown}");
    // A mesh without pictures.
    let text = "c w 1; c_tex w a.gltf -image 3;";
    let shown =
        with_files("a.ug", text, &[("a.gltf", b"{\"asset\":{\"version\":\"2.0\"}}")]).unwrap_err();
    assert!(shown.contains("`images[3]` does not exist"), "{shown}");
}

/// The checksum of a chunk of PNG.
fn png_crc(bytes: &[u8]) -> u32 {
    let step = |crc: u32, byte: &u8| {
        (0..8).fold(crc ^ u32::from(*byte), |crc, _| {
            if crc & 1 == 1 { crc >> 1 ^ 0xedb8_8320 } else { crc >> 1 }
        })
    };
    !bytes.iter().fold(!0, step)
}

/// Pictures are checked by their headers as renderers read them, and all together against the
/// limit of memory, before any is decoded.
#[test]
fn pictures_that_renderers_refuse_are_refused() {
    let check = |files: &[(&str, &[u8])], limit: u64, expected: &str| {
        let text = "c a 1; c_tex a a.pfm; c b 1; c_tex b b.pfm;";
        let options = Options {
            limits: Options::default().limits.with(ugparse::Limit::Memory, limit),
            ..Options::default()
        };
        let load = |request: &ugparse::Request<'_>| {
            let found = files.iter().find(|(name, _)| Path::new(name) == request.path);
            Ok(found.expect("the file of a row").1.to_vec())
        };
        let found = ugparse::include(Source::new("s.ug", text), &options, load);
        match found {
            Ok(_) => assert_eq!(expected, ""),
            Err(found) => {
                let found = found.render(false);
                assert!(!expected.is_empty() && found.contains(expected), "{found}");
            }
        }
    };
    let of_size = |side: usize| {
        [format!("PF\n{side} {side}\n-1\n").as_bytes(), &vec![0; 12 * side * side]].concat()
    };
    // 4 x 4 pixels of light and two smaller levels: 16 (16 + 4 + 1) bytes, and again.
    let picture = of_size(4);
    let both: [(&str, &[u8]); 2] = [("a.pfm", &picture), ("b.pfm", &picture)];
    check(&both, 100_000, "");
    check(&both, 2 * 336 + 208, "");
    check(
        &both,
        2 * 336 - 1,
        "`b.pfm` and of all pictures before it are 672 bytes with mip levels",
    );
    let with = |bytes: &[u8], expected: &str| check(&[("a.pfm", bytes)], 1 << 30, expected);
    with(b"PF\n60000 60000\n-1.0\n", "60000 x 60000 pixels exceed the limit");
    with(b"PF\n6 6\n-1.0\n", "the file is truncated, or its header is wrong");
    with(b"#?RADIANCE\n\n-Y 99 +X 99\n\0", "the file is truncated, or its header is wrong");
    with(b"v/1\x01", "not a readable EXR file");
}
