//! The program: its commands, files and exit status.

use std::fs;
use std::os::unix::fs::{PermissionsExt, symlink};
use std::process::{Command, Output};

use ugimage::{Compression, Format, LinearFrame, Metadata};

fn run(args: &[&str], input: &[u8]) -> Output {
    ugtesting::run::fed(Command::new(env!("CARGO_BIN_EXE_ugconformance")).args(args), input)
}

fn text(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).into_owned()
}

#[test]
fn right_answers_pass() {
    let questions = run(&["questions"], b"");
    assert!(questions.status.success());
    assert!(text(&questions).starts_with("T01.01 gamma 0\n"));
    let topics = ugconformance::suite::topics().expect("the files of cases are in order");
    let cases = topics.iter().flat_map(|topic| &topic.cases);
    let expected = |case: &ugconformance::suite::Case| {
        let numbers: Vec<String> =
            case.expected.iter().map(|number| format!("{number:?}")).collect();
        format!("{} {}\n", case.id, numbers.join(" "))
    };
    let answers: String = cases.map(expected).collect();
    assert_eq!(answers.lines().count(), text(&questions).lines().count());
    let card = run(&["score"], answers.as_bytes());
    assert!(card.status.success(), "{}", text(&card));
    assert!(text(&card).starts_with(
        "topic  passed  failed  unanswered  worst error  about\nT01        10       0"
    ));
}

/// The commands of the page, in a folder with a reader's program and pictures.
#[test]
fn commands_of_the_page_work() {
    let page = fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/README.md"));
    let page = page.expect("the page");
    let lines = page.lines().filter_map(|line| line.strip_prefix("    "));
    let commands: Vec<&str> = lines.filter(|line| line.starts_with("ugconformance ")).collect();
    assert!(commands.len() >= 8, "{commands:?}");
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name);
    // It answers every question with 1, some of them rightly.
    let program = "#!/bin/sh\nsed 's/ .*/ 1/'\n";
    fs::write(path("my-program"), program).expect("a program");
    fs::set_permissions(path("my-program"), PermissionsExt::from_mode(0o755)).expect("a program");
    symlink(env!("CARGO_BIN_EXE_ugconformance"), path("ugconformance")).expect("a link");
    let drawn = run(&["draw", "sphere"], b"");
    for name in ["sphere.png", "mine.png", "truth.png"] {
        fs::write(path(name), &drawn.stdout).expect("a picture");
    }
    let light = LinearFrame::new([4, 4], true, vec![[0.5, 0.25, 2.0, 1.0]; 16]);
    let exr = Format::Exr.encode_linear(&light, &Metadata::default(), Compression::Fast);
    for name in ["mine.exr", "truth.exr"] {
        fs::write(path(name), &exr).expect("a picture");
    }
    for command in commands {
        let output = Command::new("sh")
            .args(["-c", command])
            .current_dir(folder.path())
            .env("PATH", format!("{}:/usr/bin:/bin", folder.path().display()))
            .output()
            .expect("a shell");
        let messages = String::from_utf8_lossy(&output.stderr);
        // Wrong answers are a status of 1 with a card.
        let is_scored = command.contains("my-program") && text(&output).contains("unanswered");
        assert!(messages.is_empty(), "{command}: {messages}");
        assert!(output.status.success() || is_scored, "{command}: {}", output.status);
        let file = command.split_once("> ").map(|(_, name)| fs::read(path(name)).expect("a file"));
        assert!(file.unwrap_or(output.stdout).len() > 20, "{command}");
    }
}

#[test]
fn mistakes_are_named() {
    let card = run(&["score"], b"T01.04 1.33333333333333\n");
    assert_eq!(card.status.code(), Some(1));
    let shown = "
T01.04 gamma 0.5
  answered 1.33333333333333
  expected 1.1547005383792515  (Einstein 1905, sec. 4)
  error 1.5e-1, tolerance 1e-12
  looks like M2: gamma without its square root
";
    assert!(text(&card).ends_with(shown), "{}", text(&card));
    let card = run(&["score", "-format", "json"], b"T01.04 1.33333333333333\nT01.05 nan\n");
    assert_eq!(card.status.code(), Some(1));
    let card: serde_json::Value = serde_json::from_slice(&card.stdout).expect("JSON");
    assert_eq!(card["failures"][0]["looks_like"][0]["name"], "M2");
    assert_eq!(card["failures"][1]["answered"][0], serde_json::Value::Null);
    assert_eq!(card["topics"][0]["failed"], 2);
}

#[test]
fn invalid_answers_are_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("answers");
    fs::write(&file, "T01.01 one\n").expect("a file");
    let name = file.to_string_lossy().into_owned();
    let card = run(&["score", &name], b"");
    assert_eq!(card.status.code(), Some(1));
    assert_eq!(text(&card), "");
    let talk = String::from_utf8_lossy(&card.stderr).into_owned();
    assert_eq!(talk, format!("ugconformance: error: {name}:1:8: `one` is not a number\n"));
}

#[test]
fn pictures_are_drawn_and_measured() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("cube.png").to_string_lossy().into_owned();
    let mut drawn = Vec::new();
    for draw in [&["draw", "--rays", "cube", "-fo", &file][..], &["draw", "cube", "-fo", &file]] {
        assert!(run(draw, b"").status.success());
        let score = run(&["score-image", "cube", &file], b"");
        assert!(score.status.success(), "{}", text(&score));
        drawn.push(fs::read(&file).expect("a picture"));
    }
    // The history in the pictures names the scene as each program read it.
    assert_ne!(drawn[0], drawn[1], "two renderers");
    let score = run(&["score-image", "cube", &file], b"");
    assert!(text(&score).starts_with("cube: T08, T09: "));
    // Mirrored, the trailing side is on the wrong side.
    let picture = image::open(&file).expect("a picture").fliph();
    picture.save(&file).expect("a picture");
    let score = run(&["score-image", "cube", &file], b"");
    assert_eq!(score.status.code(), Some(1));
    assert!(
        text(&score).contains("FAILED  trailing side is on the left (1) or not (0): 0.0000"),
        "{}",
        text(&score)
    );
}

#[test]
fn text_from_outside_cannot_command_the_terminal() {
    let bad = "a\u{1b}[2J\u{7}\u{9b}31m\u{202e}\u{200b}b";
    let shown = "a\u{fffd}[2J\u{fffd}\u{fffd}31m\u{fffd}\u{fffd}b";
    for (args, input) in [
        (&["score"][..], format!("{bad} 1\n")),
        (&["score"], format!("T01.01 {bad}\n")),
        (&["score", bad], String::new()),
        (&["score-image", bad], String::new()),
        (&["score-image", "sphere", bad], String::new()),
        (&[bad], String::new()),
        (&["score", "-limit", bad], String::new()),
    ] {
        let output = run(args, input.as_bytes());
        let talk = String::from_utf8(output.stderr).expect("UTF-8");
        assert!(
            talk.contains(shown) && !talk.contains(['\u{1b}', '\u{9b}', '\u{202e}']),
            "{talk:?}"
        );
    }
}

#[test]
fn wrong_usage_is_reported() {
    for (args, message) in [
        (&["table", "moons"][..], "none of the tables objects, cameras"),
        (&["score-image", "moon"], "none of the pictures sphere, panorama, cube, "),
        (&["sphere.png"], "`sphere.png` is not a command; commands are questions, score"),
        (&[], "a command is missing; commands are questions, score"),
    ] {
        let output = run(args, b"");
        assert_eq!(output.status.code(), Some(2), "{args:?}");
        assert!(String::from_utf8_lossy(&output.stderr).contains(message), "{args:?}");
    }
}

#[test]
fn short_help_is_one_screenful() {
    let help = run(&["-h"], b"");
    assert!(help.status.success());
    let help = text(&help);
    assert!(help.lines().count() <= 24, "{help}");
    assert!(help.lines().all(|line| line.chars().count() <= 100), "{help}");
    let manual = ugpipe::manual::<ugconformance::Args>();
    assert_eq!(manual.essential_options().len(), manual.essential.len());
    for command in &manual.commands {
        let (_, name) = command.name.split_once(' ').expect("the program and its command");
        assert!(help.contains(&format!("\n  {name} ")), "{help}");
    }
}

#[test]
fn single_precision_has_its_own_tolerances() {
    let answer = b"T01.04 1.1547005\nT01.05 1.5625\n";
    let card = run(&["score", "-precision", "single"], answer);
    assert_eq!(card.status.code(), Some(1));
    let shown = "
The worst error is in units of the tolerance for single precision: up to 1 is correct.

T01.05 gamma 0.6
  answered 1.5625
  expected 1.25  (Einstein 1905, sec. 4)
  error 2.5e-1, tolerance 7.5e-7
  looks like M2: gamma without its square root
";
    assert!(text(&card).ends_with(shown), "{}", text(&card));
    let card = text(&run(&["score"], answer));
    assert!(card.contains("answered 1.1547005\n") && card.contains("looks like M16: "), "{card}");
    let bad = run(&["score", "-precision", "half"], answer);
    assert_eq!(bad.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&bad.stderr).contains("double, single"));
}

#[test]
fn pictures_are_compared() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    let (mine, truth, jpeg) = (file("mine.png"), file("truth.png"), file("mine.jpg"));
    let mut picture = image::RgbImage::from_pixel(4, 5, image::Rgb([255, 0, 0]));
    picture.save(&truth).expect("a picture");
    picture.put_pixel(3, 2, image::Rgb([0, 0, 0]));
    picture.save(&mine).expect("a picture");
    fs::write(&jpeg, b"\xff\xd8\xff\xe0 and so on").expect("a file");

    let same = run(&["compare", &truth, &truth], b"");
    assert!(same.status.success());
    assert_eq!(
        text(&same),
        "size: 4 x 5 pixels\nmean difference: 0.000000\nlargest difference: 0.000000\n\
         pixels that differ by more than 0.01: 0 of 20, 0.0000 %\n"
    );
    let other = run(&["compare", &mine, &truth], b"");
    assert_eq!(other.status.code(), Some(1));
    assert!(
        text(&other).ends_with(
            "mean difference: 0.050000\nlargest difference: 1.000000, at column 3, row 2: \
             0.000000 0.000000 0.000000 instead of 1.000000 0.000000 0.000000\n\
             pixels that differ by more than 0.01: 1 of 20, 5.0000 %\n"
        ),
        "{}",
        text(&other)
    );
    // The first picture may come through a pipe, and a few pixels may differ.
    let bytes = fs::read(&mine).expect("a picture");
    assert!(run(&["compare", "-share", ".05", "-", &truth], &bytes).status.success());
    assert!(run(&["compare", "-tolerance", "1", &mine, &truth], b"").status.success());

    for (args, status, message) in [
        (
            &["compare", &jpeg, &truth][..],
            1,
            "a JPEG cannot be scored: its compression changes the pixels",
        ),
        (&["score-image", "cube", &jpeg], 1, "write the picture as PNG\n"),
        (
            &["compare", &mine],
            2,
            "compare requires two pictures: `ugconformance compare MINE TRUTH`",
        ),
        (&["compare", "-share", "2", &mine, &truth], 2, "must be from 0 to 1"),
    ] {
        let output = run(args, b"");
        let talk = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(output.status.code() == Some(status) && talk.contains(message), "{args:?}: {talk}");
        assert!(output.stdout.is_empty());
    }
}

#[test]
fn scenes_are_written_for_other_renderers() {
    assert!(text(&run(&["mesh", "edge"], b"")).contains("\nusemtl white\nf 1 2 3 4\n"));
    assert!(
        text(&run(&["table", "objects"], b"")).contains("\nedge,white,0.9,0.0,0.0,grey 1.0,,\n")
    );
    assert!(
        text(&run(&["table", "cameras"], b""))
            .contains("\nedge,600,450,0.0,0.0,0.0,-2.4,0.0,1.0,0.0,0.0,1.0,pinhole,44.0\n")
    );
}

/// A picture of an edge that was not subdivided is recognised, and so is one of a sphere that is
/// not contracted.
#[test]
fn mistakes_in_pictures_are_recognized() {
    let geometry = ugscene::ShownEffects { contraction: false, ..Default::default() };
    let whole = uglorentz::Config { pieces: uglorentz::Pieces::PerEdge(1), ..Default::default() };
    let galilean = uglorentz::Config { geometry, ..Default::default() };
    for (name, size, config, expected) in [
        ("edge", [600, 450], whole, "looks like M13: "),
        ("sphere", [600, 600], galilean, "looks like M9: "),
    ] {
        let path = format!("{}/scenes/{name}.ug", env!("CARGO_MANIFEST_DIR"));
        let source = ugparse::Source::new(name, fs::read(path).expect("a scene"));
        let scene = ugparse::parse(&source, &ugparse::Options::default()).expect("a scene").scene;
        let (seen, _) = uglorentz::apply(scene, &config).expect("a scene as seen");
        let picture = ugrainbow::PictureOptions { size, ..Default::default() };
        let config = ugrainbow::Config { picture, ..Default::default() };
        let source = ugparse::Source::new(name, ugparse::write(&seen));
        let drawn = ugrainbow::run(&config, &source).expect("a picture").bytes;
        let score = run(&["score-image", name], &drawn);
        assert_eq!(score.status.code(), Some(1));
        assert!(text(&score).contains(expected), "{}", text(&score));
        assert_eq!(text(&score).matches("looks like").count(), 1, "{}", text(&score));
    }
}
