//! Names of formats, sizes and histories of files.

use ugimage::{Format, Frame, Metadata, read_history};

use crate::frames;

#[test]
fn names_round_trip() {
    for format in Format::ALL {
        assert_eq!(Format::from_name(format.name()), Some(format));
        assert_eq!(Format::from_name(&format.name().to_uppercase()), Some(format));
    }
    assert_eq!(Format::from_name("jpg"), None);
    assert_eq!(Format::from_name(""), None);
    assert_eq!(Format::list(), "png, png16, eps, ps, pdf, svg, ppm, exr, pfm, hdr");
}

/// 600 x 300 pixels at 300 to the inch are 144 x 72 points in every format of pages.
#[test]
fn pages_have_the_size_of_their_resolution() {
    let frame = Frame::opaque(600, 300);
    for (per_inch, width, height) in
        [(Some(300.0), 144, 72), (Some(72.0), 600, 300), (None, 600, 300)]
    {
        let metadata = Metadata { per_inch, ..Metadata::default() };
        for (format, expected) in [
            (Format::Pdf, format!("/MediaBox [0 0 {width} {height}]")),
            (Format::Svg, format!("width=\"{width}pt\" height=\"{height}pt\"")),
            (Format::Eps, format!("%%BoundingBox: 0 0 {width} {height}\n")),
            (Format::Ps, format!("/PageSize [{width} {height}]")),
        ] {
            let file = String::from_utf8_lossy(&format.encode(&frame, &metadata)).into_owned();
            assert!(file.contains(&expected), "{format:?}: {expected}");
        }
    }
}

#[test]
fn every_format_with_a_history_gives_it_back() {
    let long = format!("ug -cap 'a (b) \\ c = 1 & 2 < 3 \"d\"; a {}' # é", "long line ".repeat(60));
    for comment in [format!("ug 'a\tb' )(\n{long}"), format!("{long}\nγ\u{1d6fe}")] {
        let metadata =
            Metadata { software: "ug 1".into(), comment: comment.clone(), ..Metadata::default() };
        for (frame, format) in
            frames().iter().flat_map(|frame| Format::ALL.map(|format| (frame, format)))
        {
            let least =
                |most: u32| comment.chars().map(move |c| if u32::from(c) < most { c } else { '?' });
            let expected = match format {
                Format::Pfm => None,
                Format::Eps | Format::Ps => Some(least(128).collect::<String>().replace('\t', "?")),
                Format::Exr => Some(least(256).collect()),
                Format::Ppm | Format::Hdr => Some(comment.replace('\t', "?")),
                _ => Some(comment.clone()),
            };
            assert_eq!(read_history(&format.encode(frame, &metadata)), expected, "{format:?}");
            assert_eq!(
                read_history(&format.encode(frame, &Metadata::default())),
                None,
                "{format:?}"
            );
        }
    }
}

#[test]
fn cut_and_foreign_files_have_none() {
    let metadata =
        Metadata { software: "ug 1".into(), comment: "ug γ".into(), ..Metadata::default() };
    for format in Format::ALL {
        let file = format.encode(&frames()[0], &metadata);
        for length in 0..file.len() {
            if let Some(history) = read_history(&file[..length]) {
                assert!(
                    "ug ??".starts_with(history.replace('γ', "?").trim_end_matches('\u{fffd}'))
                );
            }
        }
    }
    for file in
        [&b""[..], b"GIF89a", b"P6", b"%PDF-1.7 /Subject", b"%PDF /Subject (a\\", b"<svg <desc>"]
    {
        assert_eq!(read_history(file), None);
    }
}
