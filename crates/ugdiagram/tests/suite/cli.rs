//! The program: streams, exit codes, messages, formats, the table.

use ugtesting::run::{BuiltProgram, messages};

const UGDIAGRAM: BuiltProgram = BuiltProgram::new(env!("CARGO_BIN_EXE_ugdiagram"));

const TWINS: &str = "motion home; motion away -vel .8 0 0; motion far -at 9 0 0;\
    v a 9 0 0; v b 9 1 0; v c 9 0 1; f (a b c) <far>; cam -ep 0 -4 0;";

#[test]
fn a_diagram_says_how_it_was_made() {
    let output = UGDIAGRAM.run("-sz 300 200 -nt 2 -qt", TWINS);
    assert_eq!((output.status.code(), messages(&output).as_str()), (Some(0), ""));
    let (size, metadata) = ugimage::read_png_header(&output.stdout).unwrap();
    assert_eq!(size, [300, 200]);
    assert!(metadata.software.starts_with("ugdiagram "));
    assert!(metadata.comment.starts_with("ugdiagram -sz 300 200\n"), "{}", metadata.comment);
    UGDIAGRAM.ends_at_a_closed_pipe("-qt -sz 300 200", TWINS);
}

#[test]
fn every_format_has_a_diagram() {
    let begins: [(&str, &[u8]); 6] = [
        ("png", b"\x89PNG"),
        ("pdf", b"%PDF"),
        ("svg", b"<svg"),
        ("eps", b"%!PS"),
        ("ppm", b"P6"),
        ("exr", &[0x76, 0x2f, 0x31, 0x01]),
    ];
    for (format, begin) in begins {
        let bytes = UGDIAGRAM.output(&format!("-qt -sz 8.6cm 8cm -dt {format}"), TWINS);
        assert!(bytes.starts_with(begin), "{format}");
    }
    let text = UGDIAGRAM.output("-qt -sz 8.6cm 8cm -dt svg -txt", TWINS);
    let text = String::from_utf8(text).unwrap();
    assert!(text.contains("font-style=\"oblique\"") && text.contains(">ct</text>"), "{text}");
    // 8.6 cm are 244 points.
    assert!(text.contains("244"), "{text}");
}

#[test]
fn options_have_two_spellings_and_bytes_do_not_depend_on_threads() {
    UGDIAGRAM.same(
        "-sz 300 300 -ti 2 -cv .1 0 0 -qt",
        "--size 300 300 --time 2 --camera-velocity .1 0 0 -qt",
        TWINS,
    );
    UGDIAGRAM.same("-sz 300 300 -qt -nt 1", "-sz 300 300 -qt -nt 4", TWINS);
}

#[test]
fn intervals_are_printed_and_listed() {
    let folder = tempfile::tempdir().unwrap();
    let table = folder.path().join("t.csv");
    let options = format!(
        "-sz 400 400 --event A=5,4 --interval away@0 A --frame away -points a -at {} -fo {}",
        table.display(),
        folder.path().join("d.png").display()
    );
    let output = UGDIAGRAM.run(&options, TWINS);
    let printed = messages(&output);
    assert_eq!(output.status.code(), Some(0), "{printed}");
    let expected = "from away@0 to A: timelike, 3 of own time; Δt = 5, Δx = 4 (scene)";
    assert!(printed.contains(expected), "{printed}");
    let text = std::fs::read_to_string(table).unwrap();
    let head = "what,name,line,frame,t,x,y,z,own_time,kind,square";
    assert_eq!(text.lines().next(), Some(head));
    let rows: Vec<Vec<&str>> = text.lines().skip(1).map(|line| line.split(',').collect()).collect();
    assert!(rows.iter().all(|row| row.len() == 11), "{text}");
    let row = |start: [&str; 4]| {
        let found = rows.iter().find(|row| row[..4] == start);
        found.unwrap_or_else(|| panic!("{start:?}: {text}"))
    };
    let number = |word: &str| word.parse::<f64>().unwrap();
    let near = |row: &[&str], expected: &[f64]| {
        let found = row.iter().map(|word| number(word));
        found.zip(expected).all(|(found, expected)| (found - expected).abs() < 1e-12)
    };
    assert!(near(&row(["event", "A", "", "scene"])[4..8], &[5.0, 4.0, 0.0, 0.0]));
    assert!(near(&row(["event", "A", "", "away"])[4..8], &[3.0, 0.0, 0.0, 0.0]));
    let interval = row(["interval", "away@0 to A", "", "away"]);
    assert!(near(&interval[4..9], &[3.0, 0.0, 0.0, 0.0, 3.0]), "{interval:?}");
    assert_eq!((interval[9], number(interval[10]).round()), ("timelike", 9.0));
    // From the eye to a, and back in time.
    let light = row(["emission", "a", "far", "scene"]);
    assert!(near(&light[4..8], &[-(81.0_f64 + 16.0).sqrt(), 9.0, 0.0, 0.0]), "{light:?}");
}

#[test]
fn what_is_wrong_is_said_with_a_remedy() {
    for (options, status, message) in [
        ("-show nobody", 2, "nothing is called `nobody`; there are home, away, far, camera"),
        ("--frame nobody", 2, "nothing is called `nobody`"),
        ("--frame scene@3", 2, "without an own time to choose"),
        ("-axis 0 0 0", 2, "-axis: the axis 0 0 0 has no direction"),
        ("-times 3 3", 2, "the range from 3 to 3 is empty"),
        ("-ticks 0", 2, "ticks are a time above 0 apart"),
        ("-ticks 1e-9", 2, "with 400 at most"),
        ("--event A", 2, "`A` is not NAME=EVENT, such as A=5,4"),
        ("--event A=1,2,3", 2, "has 3 numbers"),
        ("--event A=1,2 --event A=2,1", 2, "two events are called `A`"),
        ("--interval eye B", 2, "no event and no vertex is called `B`"),
        ("-points z", 2, "no event and no vertex is called `z`"),
        ("-cone 1,nan", 2, "`nan` is not a number"),
        ("-sz 20 20", 2, "has no room for a diagram"),
        ("-at x.txt", 2, "must end with .csv"),
        ("-event A=1e200,0", 1, "too far apart"),
        ("-cv 1 0 0", 2, "-cv:"),
    ] {
        let output = UGDIAGRAM.run(&format!("{options} -fo /dev/null"), TWINS);
        let printed = messages(&output);
        assert_eq!(output.status.code(), Some(status), "{options}: {printed}");
        assert!(printed.contains(message), "{options}: {printed}");
    }
    let output = UGDIAGRAM.run("-fo /dev/null", "f (a b c);");
    assert_eq!(output.status.code(), Some(1));
    assert!(messages(&output).contains("vertex `a` is not defined"), "{}", messages(&output));
}

/// Nothing, one resting camera, and a lamp that blinks.
#[test]
fn small_scenes_have_diagrams() {
    let blinking = "c_rgb off 0 0 0; c_rgb on 1 1 1; c_time blink -step -period 2 0 on 1 off;\
        l here 1 0 0 3 .1 blink <.5 0 0>; cam -ep 0 -5 0;";
    for text in ["cam -ep 0 0 0;", blinking, "v a 0 0 0; v b 1 0 0; w (a b);"] {
        let bytes = UGDIAGRAM.output("-qt -sz 200 200", text);
        assert!(bytes.starts_with(b"\x89PNG"), "{text}");
    }
}
