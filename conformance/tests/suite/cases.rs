//! The suite is complete and documented, and this project's crates pass it.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use ugconformance::picture::{CASES, DrawnBy};
use ugconformance::precision::Precision;
use ugconformance::scorecard::{Scorecard, read_answers};
use ugconformance::suite::{Case, topics};

/// The least number of cases, to notice lost files.
const LEAST_CASES: usize = 390;

fn cases() -> Vec<Case> {
    let topics = topics().expect("the files of cases are in order");
    topics.into_iter().flat_map(|topic| topic.cases).collect()
}

fn readme() -> String {
    fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("README.md")).expect("a README")
}

#[test]
fn the_suite_is_complete() {
    let topics = topics().unwrap();
    let names: Vec<String> = (1..=38).map(|number| format!("T{number:02}")).collect();
    assert_eq!(
        topics.iter().map(|topic| &topic.name).collect::<Vec<_>>(),
        names.iter().collect::<Vec<_>>()
    );
    let cases = cases();
    assert!(cases.len() >= LEAST_CASES, "{}", cases.len());
    let ids: BTreeSet<&str> = cases.iter().map(|case| case.id.as_str()).collect();
    assert_eq!(ids.len(), cases.len(), "ids are unique");
    for case in &cases {
        assert!((1e-13..=1e-4).contains(&case.tolerance), "{}", case.id);
        // The expected answer passes, and no mistake does.
        assert_eq!(case.error(&case.expected), 0.0, "{}", case.id);
        for (name, wrong) in &case.mistakes {
            assert!(case.error(wrong) > case.tolerance, "{}: {name}", case.id);
            assert!(
                Precision::Double.recognized(case, wrong).contains(&name.as_str()),
                "{}: {name}",
                case.id
            );
        }
    }
}

#[test]
fn every_file_of_cases_is_in_the_suite() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases");
    let paths = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let files: BTreeSet<String> = paths
        .filter(|path| path.extension().is_some_and(|ending| ending == "tsv"))
        .map(|path| path.file_stem().unwrap().to_string_lossy().into_owned())
        .collect();
    assert_eq!(files, topics().unwrap().into_iter().map(|topic| topic.name).collect());
}

#[test]
fn every_kind_and_picture_is_explained() {
    let readme = readme();
    let kinds: BTreeSet<String> = cases().into_iter().map(|case| case.kind).collect();
    assert!(kinds.len() >= 60, "{}", kinds.len());
    let rows: Vec<&str> = readme.lines().filter(|line| line.starts_with("| `")).collect();
    let first_cell = |line: &&str| line[1..].split('|').next().unwrap_or_default().to_string();
    let explained: Vec<String> = rows.iter().map(first_cell).collect();
    for name in kinds.iter().map(String::as_str).chain(CASES.iter().map(|case| case.name)) {
        assert!(explained.iter().any(|cell| cell.contains(&format!("`{name}`"))), "{name}");
    }
    for (name, _) in ugconformance::mistakes::MISTAKES {
        assert!(readme.contains(&format!("\n| {name} |")), "{name}");
    }
}

#[test]
fn our_programs_draw_correctly() {
    for case in &CASES {
        for &drawn_by in case.renderers() {
            let png = case.draw(drawn_by).unwrap();
            let (text, is_right) = ugconformance::score_image(case, &png).unwrap();
            assert!(is_right, "{drawn_by:?} {text}");
        }
    }
}

#[test]
fn missing_answers_are_not_wrong() {
    let topics = topics().unwrap();
    let card_of = |text: &str| {
        let answers = read_answers(text, &topics).unwrap();
        Scorecard::new(&topics, &answers, Precision::Double).counts()
    };
    let n = cases().len();
    assert_eq!(card_of(""), [0, 0, n]);
    assert_eq!(card_of("# nothing\n\nT01.04 -\n"), [0, 0, n]);
    assert_eq!(card_of("T01.04 1.1547005383792515\nT01.01 nan\nT01.02 1 1\n"), [1, 2, n - 3]);
}

#[test]
fn errors_in_answers_have_a_location() {
    let topics = topics().unwrap();
    let refused = |text: &str| read_answers(text, &topics).unwrap_err().to_string();
    assert_eq!(refused("\nT01.01 1 x"), "2:10: `x` is not a number");
    assert_eq!(refused("T01.01 1\nT01.01 1"), "2:1: `T01.01` is answered twice");
    assert_eq!(
        refused(" T99.01 1"),
        "1:2: `T99.01` is not the id of a question; `ugconformance questions` lists them"
    );
}

#[test]
fn a_picture_of_something_else_is_refused() {
    let sphere = &CASES[0];
    let refused = |png: &[u8]| sphere.measure(png).unwrap_err();
    assert!(refused(b"not a picture").starts_with("the picture cannot be read: "));
    let cube = ugconformance::picture::case("cube").unwrap();
    let other = cube.draw(DrawnBy::Pipe).unwrap();
    assert_eq!(refused(&other), "the picture is 800 x 800 pixels; `sphere` is 600 x 600");
    let black = image::RgbImage::new(600, 600);
    let mut png = std::io::Cursor::new(Vec::new());
    black.write_to(&mut png, image::ImageFormat::Png).unwrap();
    assert_eq!(refused(png.get_ref()), "no outline of a sphere is visible");
}

/// A panorama that is mirrored, or turned by 180°, has the outline on the wrong side; one with the
/// rear hemisphere folded into the front one has no circle.
#[test]
fn wrong_panoramas_fail() {
    let case = ugconformance::picture::case("panorama").unwrap();
    let right = image::load_from_memory(&case.draw(DrawnBy::Rays).unwrap()).unwrap().into_rgb8();
    let [width, height] = case.size;
    let drawn = |from: &dyn Fn(u32) -> u32| {
        let wrong = image::RgbImage::from_fn(width, height, |x, y| *right.get_pixel(from(x), y));
        let mut png = std::io::Cursor::new(Vec::new());
        wrong.write_to(&mut png, image::ImageFormat::Png).unwrap();
        ugconformance::score_image(case, png.get_ref()).unwrap()
    };
    let (quarter, half) = (width / 4, width / 2);
    let (text, is_right) = drawn(&|x| x);
    assert!(is_right, "{text}");
    assert!(!drawn(&|x| width - 1 - x).1);
    assert!(!drawn(&|x| (x + half) % width).1);
    assert!(!drawn(&|x| if x < quarter { half - 1 - x } else { x }).1);
}

/// Scenes name the command that draws them, and none causes a warning.
#[test]
fn scenes_are_clean() {
    for case in &CASES {
        let source = ugparse::Source::new(case.name, case.scene);
        let parsed = ugparse::parse(&source, &ugparse::Options::default()).unwrap();
        assert!(parsed.warnings.is_empty(), "{}: {}", case.name, parsed.warnings);
        let [width, height] = case.size;
        let command = format!("-sz {width} {height}");
        let name = case.name;
        assert!(
            case.scene.contains(&command) && case.scene.contains(&format!("> {name}.png")),
            "{name}"
        );
    }
}
