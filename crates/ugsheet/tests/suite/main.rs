//! Tests of sheets (positions of pictures and labels) and of the program.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking, its helpers too")]

mod films;

use std::fs;

use ugimage::{Format, Frame, Metadata, PictureLimits, read_png};
use ugsheet::{Config, Error, Labels, Sheet};
use ugtesting::Random;
use ugtesting::run::BuiltProgram;

const UGSHEET: BuiltProgram = BuiltProgram::new(env!("CARGO_BIN_EXE_ugsheet"));

/// A picture with its pixels.
#[derive(Clone)]
struct Picture {
    name: String,
    frame: Frame,
}

fn sheet(config: &Config, pictures: &[Picture]) -> Result<Frame, Error> {
    let headers = pictures.iter().map(|Picture { name, frame }| ugsheet::Picture {
        name: name.clone(),
        size: [frame.width(), frame.height()],
        motion: ugsheet::Motion::default(),
        history: Metadata::default(),
    });
    Sheet::new(config, &headers.collect::<Vec<_>>())?.draw(|idx| Ok(pictures[idx].frame.clone()))
}

/// A picture of noise, so that it occurs only once on a sheet.
fn picture(name: &str, width: u32, height: u32, seed: u64) -> Picture {
    let mut frame = Frame::opaque(width, height);
    let mut random = Random(seed);
    for pixel in frame.pixels_mut() {
        let [r, g, b, ..] = random.bits().to_be_bytes();
        *pixel = [r, g, b | 1, 255];
    }
    Picture { name: name.into(), frame }
}

/// The positions at which a sheet contains exactly the pixels of a picture.
fn places(picture: &Frame, sheet: &Frame) -> Vec<[u32; 2]> {
    let is_at = |x: u32, y: u32| {
        (0..picture.height())
            .all(|j| (0..picture.width()).all(|i| picture.pixel(i, j) == sheet.pixel(x + i, y + j)))
    };
    let rows = 0..=sheet.height().saturating_sub(picture.height());
    rows.flat_map(|y| (0..=sheet.width().saturating_sub(picture.width())).map(move |x| [x, y]))
        .filter(|&[x, y]| is_at(x, y))
        .collect()
}

#[test]
fn pictures_keep_their_pixels_and_order() {
    let pictures: Vec<Picture> =
        (0..5).map(|idx| picture(&format!("p{idx}"), 60, 40, idx)).collect();
    for (columns, expected) in [(None, 3), (Some(1), 1), (Some(2), 2), (Some(9), 5)] {
        let config = Config {
            columns,
            title: "Title".into(),
            caption: "Caption".into(),
            ..Config::default()
        };
        let sheet = sheet(&config, &pictures).unwrap();
        let found: Vec<[u32; 2]> = pictures
            .iter()
            .map(|picture| {
                let places = places(&picture.frame, &sheet);
                assert_eq!(places.len(), 1);
                places[0]
            })
            .collect();
        let in_first_row = found.iter().filter(|place| place[1] == found[0][1]).count();
        assert_eq!(in_first_row, expected);
        for (idx, place) in found.iter().enumerate() {
            let above = found[idx - idx % expected];
            assert_eq!(place[1], above[1], "row of {idx}");
            assert!(idx % expected == 0 || place[0] > found[idx - 1][0], "column of {idx}");
        }
    }
}

#[test]
fn without_text_and_margin_a_sheet_is_its_pictures() {
    let pictures = [picture("a", 30, 20, 1), picture("b", 30, 20, 2)];
    let config = Config {
        labels: Labels::None,
        gap: Some([4, 0]),
        background: [64; 3],
        ..Config::default()
    };
    let sheet = sheet(&config, &pictures).unwrap();
    assert_eq!([sheet.width(), sheet.height()], [64, 20]);
    assert_eq!(places(&pictures[0].frame, &sheet), [[0, 0]]);
    assert_eq!(places(&pictures[1].frame, &sheet), [[34, 0]]);
    assert!((0..20).all(|y| (30..34).all(|x| sheet.pixel(x, y) == [64, 64, 64, 255])));
}

/// Pictures of different sizes are centred in their cells, and labels are centred below them.
#[test]
fn pictures_and_labels_are_centred() {
    let pictures = [picture("a", 100, 50, 1), picture("b", 40, 80, 2), picture("c", 60, 30, 3)];
    for background in [[255; 3], [0; 3]] {
        let config = Config {
            columns: Some(2),
            labels: Labels::Given(vec!["at rest".into(), "β".into(), "γ = 7".into()]),
            background,
            ..Config::default()
        };
        let sheet = sheet(&config, &pictures).unwrap();
        let found: Vec<[u32; 2]> =
            pictures.iter().map(|picture| places(&picture.frame, &sheet)[0]).collect();
        assert_eq!(found[0][1] + 25, found[1][1] + 40, "middles of a row");
        assert_eq!(found[0][0] + 50, found[2][0] + 30, "middles of a column");
        for (picture, [x, y]) in pictures.iter().zip(&found).skip(1) {
            let (middle, bottom) = (x + picture.frame.width() / 2, y + picture.frame.height());
            // A label with a text size of 10 pixels lies within the next 16 rows.
            let columns = middle - 20..(middle + 20).min(sheet.width());
            let is_ink = |x: u32, y: u32| sheet.pixel(x, y)[..3] != background;
            let ink: Vec<u32> =
                columns.filter(|&x| (bottom..bottom + 16).any(|y| is_ink(x, y))).collect();
            let (left, right) = (ink[0], ink[ink.len() - 1]);
            assert!((left + right).abs_diff(2 * middle) <= 4, "{left} {right} {middle}");
        }
    }
}

#[test]
fn transparent_pixels_show_the_background() {
    let mut clear = picture("a", 8, 8, 1);
    clear.frame = Frame::clear(8, 8);
    clear.frame.pixels_mut()[0] = [10, 20, 30, 255];
    let config = Config {
        labels: Labels::None,
        gap: Some([0; 2]),
        background: [200, 100, 0],
        ..Config::default()
    };
    let sheet = sheet(&config, &[clear]).unwrap();
    assert_eq!(sheet.pixel(0, 0), [10, 20, 30, 255]);
    assert_eq!(sheet.pixel(5, 5), [200, 100, 0, 255]);
}

#[test]
fn invalid_requests_are_errors() {
    let pictures = [picture("a", 20, 20, 1), picture("漢", 20, 20, 2)];
    assert_eq!(sheet(&Config::default(), &[]), Err(Error::Empty));
    let one = Config { labels: Labels::Given(vec!["x".into()]), ..Config::default() };
    assert_eq!(sheet(&one, &pictures), Err(Error::Count { labels: 1, pictures: 2 }));
    let error = sheet(&Config::default(), &pictures).unwrap_err();
    assert!(error.to_string().starts_with("in `漢`: the font has no `漢` (U+6F22)"), "{error}");
    assert!(sheet(&Config { labels: Labels::None, ..Config::default() }, &pictures).is_ok());
    let wide = Config {
        labels: Labels::None,
        gap: Some([10_000; 2]),
        columns: Some(1),
        ..Config::default()
    };
    assert_eq!(sheet(&wide, &[&pictures[..]; 10].concat()), Err(Error::Size));
    // No pixels are read for a sheet that is too large.
    let huge = ugsheet::Picture {
        name: String::new(),
        size: [1 << 14, 1 << 14],
        motion: ugsheet::Motion::default(),
        history: Metadata::default(),
    };
    let sheet = Sheet::new(&Config::default(), &[huge.clone(), huge]);
    assert_eq!(
        sheet.and_then(|sheet| sheet.draw(|_| unreachable!("nothing is read"))),
        Err(Error::Size)
    );
}

/// Sheets have the width asked for, and the height; pictures keep their shape and their light.
#[test]
fn sheets_have_the_size_asked_for() {
    let pictures =
        [picture("a", 300, 200, 1), picture("b", 150, 250, 2), picture("c", 300, 200, 3)];
    for width in [151, 1016] {
        for columns in [1, 3] {
            let config =
                Config { columns: Some(columns), size: Some((width, None)), ..Config::default() };
            let drawn = sheet(&config, &pictures).unwrap();
            assert_eq!(drawn.width(), width, "{columns} columns");
            let config = Config { size: Some((width, Some(500))), is_even: true, ..config };
            assert_eq!(
                [sheet(&config, &pictures).unwrap()].map(|s| [s.width(), s.height()]),
                [[width.next_multiple_of(2), 500]]
            );
        }
    }
    // An even picture stays even, and the mean of light is that of the picture.
    let mut grey = picture("grey", 64, 64, 1);
    grey.frame.pixels_mut().fill([90, 90, 90, 255]);
    let mut checks = grey.clone();
    for (idx, pixel) in checks.frame.pixels_mut().iter_mut().enumerate() {
        *pixel = if (idx + idx / 64) % 2 == 0 { [0, 0, 0, 255] } else { [255, 255, 255, 255] };
    }
    for (picture, expected) in [(grey, 90), (checks, 188)] {
        let config = Config {
            labels: Labels::None,
            gap: Some([0; 2]),
            size: Some((16, None)),
            ..Config::default()
        };
        let drawn = sheet(&config, &[picture]).unwrap();
        assert_eq!([drawn.width(), drawn.height()], [16, 16]);
        assert!(
            drawn.pixels().iter().all(|pixel| pixel[0].abs_diff(expected) < 3),
            "{:?}",
            drawn.pixel(3, 3)
        );
    }
    // Pictures that nearly fill the sheet keep their pixels.
    let config = Config { columns: Some(1), size: Some((330, None)), ..Config::default() };
    assert_eq!(places(&pictures[0].frame, &sheet(&config, &pictures).unwrap()).len(), 1);
    let config = Config { size: Some((9, None)), ..Config::default() };
    assert_eq!(sheet(&config, &pictures), Err(Error::Narrow));
}

/// The resolution of the pictures is that of the sheet; a length has 300 pixels to the inch
/// otherwise, and its labels have 8 points.
#[test]
fn sheets_state_their_resolution() {
    let folder = tempfile::tempdir().unwrap();
    for (name, per_inch) in [("a", Some(300.0)), ("b", Some(600.0)), ("c", None)] {
        let metadata = Metadata { per_inch, ..Metadata::default() };
        let file = Format::Png.encode(&picture(name, 90, 70, 5).frame, &metadata);
        fs::write(folder.path().join(format!("{name}.png")), file).unwrap();
    }
    let ugsheet = UGSHEET.in_folder(&folder);
    for (args, width, per_inch) in [
        ("-gap 0 a.png a.png", 180, Some(300.0)),
        ("-gap 0 b.png c.png", 180, Some(600.0)),
        ("-gap 0 c.png c.png", 180, None),
        ("-gap 0 a.png b.png", 180, None),
        ("-sz 8.6cm a.png a.png", 1016, Some(300.0)),
        ("-sz 8.6cm b.png", 2031, Some(600.0)),
        ("-sz 1in a.png b.png", 300, Some(300.0)),
        ("-sz 200 a.png", 200, None),
    ] {
        let file = ugsheet.output(args, "");
        let (frame, metadata) = read_png(&file, &PictureLimits::default()).unwrap();
        assert_eq!((frame.width(), metadata.per_inch), (width, per_inch), "{args}");
    }
    let notes = ugsheet.notes("a.png b.png", "");
    assert!(notes.contains("different resolutions, so the sheet states none"), "{notes}");
    let notes = ugsheet.notes("-sz 8.6cm c.png c.png", "");
    assert!(notes.contains("; drawn with -sz "), "{notes}");
    ugsheet.output("-sz 2in 72pt c.png -fo a.svg", "");
    let svg = fs::read_to_string(folder.path().join("a.svg")).unwrap();
    assert!(svg.contains("width=\"144pt\" height=\"72pt\""));
    ugsheet.refuses(
        "-sz 8.6cm 600 c.png",
        "",
        2,
        "-sz: one side has a unit and the other has none",
    );
}

/// A folder with `rest.png` and `fast.png`, which have histories.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (name, line) in [("rest", "uglorentz"), ("fast", "uglorentz -vel .9 0 0")] {
        let metadata =
            Metadata { software: "ugrainbow".into(), comment: line.into(), ..Metadata::default() };
        let file = Format::Png.encode(&picture(name, 90, 70, 5).frame, &metadata);
        fs::write(folder.path().join(format!("{name}.png")), file).unwrap();
    }
    folder
}

#[test]
fn the_program_reads_files_and_standard_input() {
    let folder = folder();
    let ugsheet = UGSHEET.in_folder(&folder);
    assert_eq!(ugsheet.notes("-cols 2 rest.png fast.png", ""), "");
    let named = ugsheet.output("-cols 2 rest.png fast.png", "");
    let rest = fs::read(folder.path().join("rest.png")).unwrap();
    assert_eq!(named, ugsheet.output("-cols 2 - fast.png", &rest));
    let (sheet, history) = read_png(&named, &PictureLimits::default()).unwrap();
    assert_eq!(history.comment, "uglorentz\nuglorentz -vel .9 0 0\nugsheet --cols 2");
    // The labels come from the histories, not from the file names.
    let given = ugsheet.output("-cols 2 -label 'at rest' -label 'β = 0.9' rest.png fast.png", "");
    assert_eq!(read_png(&given, &PictureLimits::default()).unwrap().0, sheet);
    ugsheet.ends_at_a_closed_pipe("-", &rest);
}

#[test]
fn errors_have_messages_and_exit_status() {
    let folder = folder();
    fs::write(folder.path().join("text.png"), "no picture").unwrap();
    for format in [Format::Pdf, Format::Svg, Format::Eps] {
        let file = format.encode(&picture("figure", 90, 70, 5).frame, &Metadata::default());
        fs::write(folder.path().join(format!("figure.{}", format.name())), file).unwrap();
    }
    for (args, status, message) in [
        ("text.png", 1, "`text.png`: not a PNG file"),
        ("rest.png none.png", 1, "none.png"),
        ("rest.png figure.pdf", 1, "`figure.pdf` is a PDF file, and a sheet consists of PNG files"),
        ("figure.svg", 1, "each with `\\includegraphics` in a `minipage`"),
        ("figure.eps", 1, "`figure.eps` is a PostScript file"),
        ("--tiles figure.pdf", 1, "`figure.pdf` is a PDF file"),
        ("-label x rest.png fast.png", 2, "1 label for 2 pictures: give -label once"),
        ("-cap 漢 rest.png", 2, "the font has no `漢`"),
        ("-fo sheet.exr rest.png", 2, "name one with -dt"),
        ("-bg 2 rest.png", 2, "from 0 to 1"),
        ("-cols 0 rest.png", 2, "`0` is not valid for `-cols`: must be a whole number, 1 or more"),
    ] {
        UGSHEET.in_folder(&folder).refuses(args, "", status, message);
    }
}

#[test]
fn the_program_writes_other_formats() {
    let folder = folder();
    for (file, start) in
        [("a.pdf", "%PDF-1."), ("a.svg", "<"), ("a.eps", "%!PS-Adobe"), ("a.ppm", "P6")]
    {
        UGSHEET.in_folder(&folder).output(&format!("rest.png fast.png -fo {file}"), "");
        assert!(
            fs::read(folder.path().join(file)).unwrap().starts_with(start.as_bytes()),
            "{file}"
        );
    }
}
