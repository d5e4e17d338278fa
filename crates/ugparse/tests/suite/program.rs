//! The program: the output and exit status of each command.

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::{Value, json};
use ugparse::{Options, Source};
use ugtesting::run::{BuiltProgram, messages};

const UGPARSE: BuiltProgram = BuiltProgram::new(env!("CARGO_BIN_EXE_ugparse"));

fn repository() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
}

/// The report of a run, which may have found an error.
#[track_caller]
fn report(args: &str, input: &str) -> Value {
    serde_json::from_slice(&UGPARSE.run(args, input).stdout).unwrap()
}

/// The scenes of the repository: those in the table of `scenes/README.md`.
fn scenes() -> Vec<PathBuf> {
    let folder = repository().join("scenes");
    let list = fs::read_to_string(folder.join("README.md")).unwrap();
    let rows = list.lines().filter_map(|line| line.strip_prefix("| `")?.split_once('`'));
    let scenes: Vec<PathBuf> = rows.map(|(name, _)| folder.join(name)).collect();
    assert!(scenes.len() >= 9, "{scenes:?}");
    scenes
}

fn flat(text: &[u8]) -> Vec<u8> {
    let parsed = ugparse::parse(&Source::new("scene.ug", text), &Options::default());
    let parsed = parsed.unwrap_or_else(|findings| panic!("{findings}"));
    ugparse::write_with(&parsed.scene, &parsed.passed_on)
}

const BAD: &str = "v a 0 0 0;\nv b 1 0 0;\nv c 0 1 0;\nf (a b c) red;\nf (a b d);\n";
const POOR: &str = "v a 0 0 0;\nv b 1 0 0;\nf (a b);\n";

#[test]
fn check_is_the_default_command() {
    let ugparse = UGPARSE.in_folder(repository());
    for args in ["scenes/ship.ug", "check scenes/ship.ug", "-fi scenes/ship.ug -nt 1"] {
        let out = ugparse.run(args, "");
        assert_eq!(
            messages(&out),
            "ugparse: note: scenes/ship.ug can be used: 0 errors, 0 warnings\n",
            "{args}"
        );
        assert_eq!((out.status.code(), out.stdout.len()), (Some(0), 0), "{args}");
    }
}

#[test]
fn a_check_prints_findings_as_other_programs_do() {
    let findings = ugparse::parse(&Source::new("<stdin>", BAD), &Options::default()).unwrap_err();
    UGPARSE.refuses("-qt", BAD, 1, &format!("{findings}\n").replace("error: ", "ugparse: error: "));
    let notes = UGPARSE.notes("", POOR);
    assert!(notes.contains("<stdin> can be used: 0 errors, 1 warning\n"), "{notes}");
    assert!(notes.contains("warning: ") && notes.contains("<stdin>:3:"), "{notes}");
}

#[test]
fn check_can_print_json() {
    let out = UGPARSE.run("check -format json", BAD);
    assert_eq!((out.status.code(), out.stderr.len()), (Some(1), 0));
    let found: Value = serde_json::from_slice(&out.stdout).unwrap();
    let rows = found["findings"].as_array().unwrap();
    let places: Vec<_> = rows.iter().map(|row| (&row["line"], &row["column"])).collect();
    assert_eq!(places, [(&json!(4), &json!(11)), (&json!(5), &json!(8))]);
    let mut row = rows[1].clone();
    let help = row.as_object_mut().unwrap().remove("help").unwrap();
    assert!(help.as_str().unwrap().contains("`v` statement"), "{help}");
    let expected = json!({ "severity": "error", "message": "vertex `d` is not defined", "file": "<stdin>",
        "line": 5, "column": 8, "label": "used here" });
    for (key, value) in expected.as_object().unwrap() {
        assert_eq!(&row[key], value, "{key}");
    }
    assert_eq!(
        (&row["other"], &found["omitted"], &found["usable"]),
        (&Value::Null, &json!(0), &json!(false))
    );

    let good = json!({ "usable": true, "findings": [], "omitted": 0 });
    assert_eq!(report("--format json", "v a 0 0 0;"), good);
    let poor = report("-format=json", POOR);
    assert_eq!(
        (&poor["findings"][0]["severity"], &poor["usable"]),
        (&json!("warning"), &json!(true))
    );
}

#[test]
fn check_as_json_has_second_locations_and_omitted_findings() {
    let row = &report("-format json", "v a 0 0 0;\n# 7 \"old.ug\"\n v a 1 0 0;\n")["findings"][0];
    assert_eq!((&row["file"], &row["line"]), (&json!("old.ug"), &json!(7)));
    let first = json!({ "file": "<stdin>", "line": 1, "column": 3, "label": "first here" });
    assert_eq!(row["other"], first);

    let many = report("-format json", &format!("f ({});", "nothing ".repeat(100)));
    assert_eq!((many["findings"].as_array().unwrap().len(), &many["omitted"]), (20, &json!(80)));
}

#[test]
fn findings_are_placed_in_the_file_that_has_them() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    fs::write(path("house.ug"), "c red 1 0;\ninclude \"the walls.ug\";\nf (a b e);\n").unwrap();
    fs::write(path("the walls.ug"), "v a 0 0 0;\nv b 1 0 0; f (a b d);\n").unwrap();
    let args = "check -format json -fo report.json house.ug";
    assert_eq!(UGPARSE.in_folder(&folder).run(args, "").status.code(), Some(1));
    // The report is written even for an invalid scene.
    let report: Value = serde_json::from_slice(&fs::read(path("report.json")).unwrap()).unwrap();
    let place = |row: usize| (&report["findings"][row]["file"], &report["findings"][row]["line"]);
    assert_eq!(place(0), (&json!("the walls.ug"), &json!(2)));
    assert_eq!(place(1), (&json!("house.ug"), &json!(3)));
}

/// A folder with a scene that runs the script `stars`.
fn scene_with_program(script: &str) -> tempfile::TempDir {
    use std::os::unix::fs::PermissionsExt;
    let folder = tempfile::tempdir().unwrap();
    let program = folder.path().join("stars");
    fs::write(&program, format!("#!/bin/sh\n{script}\n")).unwrap();
    fs::set_permissions(&program, fs::Permissions::from_mode(0o755)).unwrap();
    fs::write(folder.path().join("sky.ug"), "{ sky }\nexecute stars ;\n").unwrap();
    folder
}

#[test]
fn programs_of_a_scene_are_run_only_if_allowed() {
    let check = |script: &str, options: &str, status: i32, expected: &str| {
        let folder = scene_with_program(script);
        let out =
            UGPARSE.in_folder(&folder).run(&format!("{options} flatten sky.ug"), "never read");
        let printed = String::from_utf8_lossy(if status == 0 { &out.stdout } else { &out.stderr });
        assert_eq!(out.status.code(), Some(status), "{script}: {printed}");
        assert!(printed.starts_with(expected), "{script}: {printed}");
        messages(&out)
    };
    let run = "-allow-execute";
    check("echo 'v a 1 2 3;'", run, 0, "{ sky }\nv a 1 2 3;\n");
    check(
        "echo 'v a 1 2 3;'",
        "",
        1,
        "ugparse: error: program `stars` is not run\n --> sky.ug:2:9",
    );
    // It gets no arguments and no input, and runs in the current folder.
    check("echo \"{ $# $(cat) }\"; test -f sky.ug || exit 1", run, 0, "{ sky }\n{ 0  }\n");
    let failed =
        "ugparse: error: program `stars` failed with exit status: 3: no fuel\n --> sky.ug:2:9";
    check("echo no fuel >&2; exit 3", run, 1, failed);
    check("echo 'v a 0;'", run, 1, "ugparse: error: expected a number, found `;`\n --> stars:1:6");
    let endless = "while :; do echo '{}'; done";
    let limited = "-allow-execute -limit text=1000";
    check(endless, limited, 1, "ugparse: error: with the text of `stars`");
    let said = check("echo 'some are faint' >&2", run, 0, "{ sky }\n");
    assert!(
        said.starts_with("ugparse: note: ") && said.ends_with("stars says: some are faint\n"),
        "{said}"
    );
}

#[test]
fn limits_are_set_on_the_command_line() {
    let bomb = "def d; v a 0 0 0; end;\na (d) 100;\n";
    let status = |args: &str| UGPARSE.run(args, bomb).status.code();
    assert_eq!(status("flatten"), Some(0));
    assert_eq!(status("flatten -limit statements=200"), Some(1));
    assert_eq!(status("--limit=statements=200 -limit statements=300 flatten"), Some(0));
    for wrong in ["statements", "statements=-1", "statements=9999999999", "words=3"] {
        assert_eq!(status(&format!("flatten -limit {wrong}")), Some(2), "{wrong}");
    }
    let help = UGPARSE.text("--help", "");
    for limit in ugparse::Limit::all() {
        assert!(help.contains(&format!(" {}", limit.name())), "{}\n{help}", limit.name());
    }
}

#[test]
fn inputs_that_are_not_scenes_have_one_error() {
    let folder = tempfile::tempdir().unwrap();
    let ugparse = UGPARSE.in_folder(&folder);
    let check = |name: &str, bytes: &[u8], what: &str, help: &str| {
        fs::write(folder.path().join(name), bytes).unwrap();
        // Statements are not flattened, so a mesh has none.
        let out = ugparse.run(&format!("tidy -qt {name}"), "");
        let shown = messages(&out).replace(name, "FILE");
        let title = format!("ugparse: error: this is not a UniGrafix scene but {what}\n");
        assert!(
            shown.starts_with(&title) && shown.ends_with(&format!("help: {help}\n")),
            "{shown}"
        );
        assert_eq!((shown.matches("error").count(), out.status.code()), (1, Some(1)), "{shown}");
    };
    let wide: Vec<u8> =
        format!("\u{feff}{BAD}").encode_utf16().flat_map(u16::to_le_bytes).collect();
    check("scene.ug", &wide, "UTF-16 text", "save it as UTF-8 or ASCII");
    check("scene.ug.gz", b"\x1f\x8b\x08\0\0\0\0\0", "compressed data", "decompress it first");
    check(
        "ship.png",
        b"\x89PNG\r\n\x1a\n",
        "a picture",
        "`ugwarp FILE` shows it as the sky around an observer in motion; if it was drawn of a scene, give that: \
         `ugsheet --history FILE` prints its name",
    );
    let convert = "`ugmesh FILE` writes it as a scene, for the rest of the pipe";
    check("ship.obj", b"v 0 0 0\nv 1 0 0\n", "a mesh", convert);
    check("ship", b"# a comment; another\nv 0 0 0\nv 1 0 0\n", "a mesh", convert);
    check("ship", b"ply\nformat ascii 1.0\n", "a mesh", convert);
    check("ship", b"OFF\n3 1 0\n", "a mesh", convert);
    // A scene may have any name, and its errors are then those of a scene.
    fs::write(folder.path().join("scene.obj"), BAD).unwrap();
    ugparse.refuses("-qt scene.obj", "", 1, "ugparse: error: colour `red` is not defined");
    UGPARSE.refuses("", "include . ;\n", 1, "error: cannot read `.`: ");
}

#[test]
fn carriage_returns_end_line_marks() {
    let (first, rest) = ("v a 0 0 0;", "v b 1 0 0;v c 0 1 0;f (a b c);f (a b d);");
    for ends in ["\n", "\r\n", "\r"] {
        let scene = format!("{first}{ends}# 7 \"house.ug\"{ends}{rest}{ends}");
        UGPARSE.refuses(
            "-qt",
            scene,
            1,
            "ugparse: error: vertex `d` is not defined\n --> house.ug:7:",
        );
    }
}

#[test]
fn normals_may_be_too_long() {
    let scene = "def d; v a 0 0 0 1e300 0 0; end; i (d -sy 1e-10 -sz 1e-10);";
    let (out, too_long) = (UGPARSE.run("-qt", scene), "this normal or direction becomes too long");
    assert!(out.status.success() || messages(&out).contains(too_long), "{}", messages(&out));
    UGPARSE.refuses("-qt", "def d; l 1 1e300 0 0; end; i (d -sa 1e10);", 1, too_long);
}

#[test]
fn wrong_usage_has_status_2() {
    let wrong = "tidy -format json,flatten -format json,count -format xml,-nonsense,ship.ug tidy,-fi ship.ug tidy dice.ug,\
        tidy -fi ship.ug dice.ug,tidy ship.ug dice.ug";
    for args in wrong.split(',') {
        UGPARSE.in_folder(repository().join("scenes")).refuses(args, "", 2, "ugparse: error: ");
    }
}

#[test]
fn options_may_precede_or_follow_the_command() {
    let unknown = "shine 1;\n";
    for args in
        ["tidy -lax -qt", "-lax -qt tidy", "-lax tidy -qt -", "-nt 1 -lax -qt flatten -fi -"]
    {
        let out = UGPARSE.run(args, unknown);
        assert_eq!((&out.stdout[..], &out.stderr[..]), (unknown.as_bytes(), &b""[..]), "{args}");
    }
    UGPARSE.same("-format json count -", "count -fi - -format json", BAD.lines().next().unwrap());
}

#[test]
fn invalid_scenes_give_no_output() {
    for job in ["flatten", "count"] {
        UGPARSE.refuses(job, BAD, 1, "is not defined");
    }
    // `tidy` does not resolve names: only syntax errors are refused.
    assert_eq!(UGPARSE.text("tidy", BAD), BAD);
    UGPARSE.refuses("tidy", "v a 0 0;\n", 1, "expected a number");
}

#[test]
fn flatten_writes_the_flat_scene() {
    for path in scenes() {
        let expected = flat(&fs::read(&path).unwrap());
        let (folder, name) = (path.parent().unwrap(), path.file_name().unwrap());
        let found = UGPARSE.in_folder(folder).output(&format!("flatten {}", name.display()), "");
        assert!(found == expected, "{}", path.display());
    }
}

#[test]
fn flatten_writes_colours_of_a_display_as_hues() {
    let text = "c_rgb a 0 0.5 0.5; c_rgb g 0.25 0.25 0.25; c b 1 20; v p 0 0 0 a;";
    let flat = UGPARSE.text("flatten --hues", text);
    assert!(flat.contains("c a 0.5 180 1;") && flat.contains("c g 0.25;"), "{flat}");
    assert!(flat.contains("c b 1 20"), "{flat}");
}

#[test]
fn tidy_keeps_scenes_and_is_idempotent() {
    for path in scenes() {
        let text = fs::read(&path).unwrap();
        let tidy = UGPARSE.in_folder(repository()).text(&format!("tidy {}", path.display()), "");
        assert!(flat(tidy.as_bytes()) == flat(&text), "{}", path.display());
        assert_eq!(UGPARSE.text("tidy", &tidy), tidy, "{}", path.display());
        assert_eq!(tidy.matches('{').count(), String::from_utf8_lossy(&text).matches('{').count());
        for keyword in ["def", "i", "a"] {
            let count =
                |text: &str| text.split_whitespace().filter(|word| *word == keyword).count();
            assert!(
                count(&tidy) >= count(&String::from_utf8_lossy(&text)),
                "{}: {keyword}",
                path.display()
            );
        }
    }
}

#[test]
#[rustfmt::skip] // rows of a table
fn tidy_formats() {
    #[track_caller]
    fn check(text: &str, expected: &str) {
        let tidy = |text: &str| UGPARSE.text("tidy -lax -qt", text);
        assert_eq!(tidy(text), expected);
        assert_eq!(tidy(expected), expected);
        let scene = |text: &str| {
            let options = Options { lax: true, ..Options::default() };
            ugparse::parse(&Source::new("scene.ug", text), &options)
                .ok()
                .map(|parsed| ugparse::write_with(&parsed.scene, &parsed.passed_on))
        };
        assert!(scene(text) == scene(expected), "{text}");
    }
    // An empty scene is something, or the next program would take it for the end of a broken pipe.
    for text in ["", " \n\n", "\r"] {
        for job in ["tidy", "flatten"] {
            assert_eq!(UGPARSE.text(job, format!(" {text}")), "\n");
        }
    }
    check("{ only a comment }", "{ only a comment }\n");
    // One statement per line, one blank between words.
    check("v a 0 0 0;v b 1 0 0 ;\tv\tc\n0 1 0\n;", "v a 0 0 0;\nv b 1 0 0;\nv c 0 1 0;\n");
    check(
        "c red 1 0; v a 0 0 0; v b 1 0 0; v c 0 1 0; f up( a b c )( c b a )red < 0 .5 0 > ;",
        "c red 1 0;\nv a 0 0 0;\nv b 1 0 0;\nv c 0 1 0;\nf up (a b c) (c b a) red <0 0.5 0>;\n",
    );
    check("v\x0Ba 0\x0C0 0;\r\nv b 0 0 1;\r\n", "v a 0 0 0;\nv b 0 0 1;\n");
    check(";;v a 0 0 0;;", "v a 0 0 0;\n");
    // A carriage return without a line feed ends a line, too: the comment must not become part of
    // the directive.
    check("# pragma\r{ one\ntwo } v a 0 0 0; { a }\r{ b }", "# pragma\n{ one\ntwo }\nv a 0 0 0; { a }\n{ b }\n");
    // Numbers are as short as possible, with the same value.
    check("v a +1.50 -0 1E3;", "v a 1.5 -0 1000;\n");
    check("v a .10000000000000001 1e-7 123456789;", "v a 0.1 1e-7 123456789;\n");
    check("cam -ep 01 2. 3 -va 040 30 -ps;", "cam -ep 1 2 3 -va 40 30 -ps;\n");
    check("def t; end; a(t)004 -tx 1.0;", "def t;\nend;\na (t) 4 -tx 1;\n");
    check("def t; end; a (t) 0 -tx 1;", "def t;\nend;\na (t) 0 -tx 1;\n");
    // Definitions are indented; several empty lines become one.
    check("\n\ndef a;def b;v x 0 0 0;end;\n\n\ni (b);end;\ni (a);\n\n", "def a;\n  def b;\n    v x 0 0 0;\n  end;\n\n  i (b);\nend;\ni (a);\n");
    // Comments keep their place and text.
    check(
        "{ head }\n{two}{three}\nv a 0 0 0;  {behind}  {too}\n  {above}v b 0 0 1;",
        "{ head }\n{two} {three}\nv a 0 0 0; {behind} {too}\n{above}\nv b 0 0 1;\n",
    );
    check("v{n}a 0{x}0 {y}\n 0{ z\n};", "v {n} a 0 {x} 0 {y} 0 { z\n};\n");
    check("def t;{what}\nv a 0 0 0;{ {nested}\n  lines }\nend;{t}\n", "def t; {what}\n  v a 0 0 0; { {nested}\n  lines }\nend; {t}\n");
    // Text for other programs does not change.
    check("(  for  (others) 1.0 ; { ) {mine}\nv a 0 0 0;", "(  for  (others) 1.0 ; { ) {mine}\nv a 0 0 0;\n");
    check("shine  a 1.0 {x;}\n  2 ; v a 0 0 0;", "shine  a 1.0 {x;}\n  2 ;\nv a 0 0 0;\n");
    check("v a 0 0 0; # pragma  once \nv b 0 0 1;", "v a 0 0 0;\n# pragma  once \nv b 0 0 1;\n");
    check("# 1 \"a b.ug\"\nv a 0 0 0;\n#line 7\n{x} v b 0 0 1;", "# 1 \"a b.ug\"\nv a 0 0 0;\n#line 7\n{x}\nv b 0 0 1;\n");
    check("include  007;include\"a; {b}.ug\" ;", "include 007;\ninclude \"a; {b}.ug\";\n");
}

/// A cube of side 2 with the given statement for its face `top`.
fn cube(top: &str) -> String {
    let mut text = String::new();
    for row in 0..8 {
        let side = |bit: usize| if row >> bit & 1 == 1 { 1 } else { -1 };
        text += &format!("v p{row} {} {} {};\n", side(0), side(1), side(2));
    }
    text + "f bottom (p0 p2 p3 p1);\nf front (p0 p1 p5 p4);\nf back (p2 p6 p7 p3);\n\
            f left (p0 p4 p6 p2);\nf right (p1 p3 p7 p5);\n"
        + top
}

#[test]
fn count_finds_turned_faces() {
    #[track_caller]
    fn check(top: &str, [opposite, same, border, more]: [u32; 4], turned: Value) {
        let counts = report("count -format json", &cube(top));
        let expected =
            json!({ "opposite": opposite, "same": same, "border": border, "more_than_two": more });
        assert_eq!(counts["edges"], expected, "{top}");
        assert_eq!(counts["turned"], turned, "{top}");
    }
    let at_line_14 = |edges: u32| json!({ "edges": edges, "face": { "name": "top", "file": "<stdin>", "line": 14 } });
    check("f top (p4 p5 p7 p6);", [12, 0, 0, 0], Value::Null);
    check("f top (p6 p7 p5 p4);", [8, 4, 0, 0], at_line_14(4));
    check("\n", [8, 0, 4, 0], Value::Null);
    check("f top (p4 p5 p7 p6); f top (p4 p5 p7 p6);", [8, 0, 0, 4], Value::Null);
    // Other vertices at the same positions.
    check(
        "v a -1 -1 1; v b 1 -1 1; v c 1 1 1; v d -1 1 1;\nf top (a b c d);",
        [12, 0, 0, 0],
        Value::Null,
    );
    // A hole has edges, in either direction.
    let hole = "v a -.5 -.5 1; v b .5 -.5 1; v c .5 .5 1; v d -.5 .5 1; f lid (a b c d);";
    check(&format!("{hole} f top (p4 p5 p7 p6) (a b c d);"), [16, 0, 0, 0], Value::Null);
    check(&format!("{hole} f top (p4 p5 p7 p6) (d c b a);"), [16, 0, 0, 0], Value::Null);
}

#[test]
fn count_counts_and_measures() {
    let text = "{ two squares, one of them bent }
        c red 1 0; surf s 1 0 0; def tile; v a 0 0 0; v b 1 0 0; v c 1 1 0; v d 0 1 0; f flat (a b c d) red s; end;
        a (tile) 3 -tx 2 <.5 0 0>; i (tile -tz 1);
        v p 0 0 5; v q 3 0 5.5; v r 3 4 5; v s 0 4 5.5;
        f bent (p q r s) <0 .25 0>; w (p r); label \"p\" p;
        l 1; cam -ep 0 0 9; (an escape)";
    let counts = report("count -format json", text);
    let written = json!({ "colours": 1, "surfaces": 1, "vertices": 8, "faces": 2, "wires": 1, "labels": 1, "lights": 1, "cameras": 1,
        "escapes": 1, "unknown": 0, "definitions": 1, "instances": 1, "arrays": 1 });
    let placed = json!({ "colours": 1, "surfaces": 1, "vertices": 20, "faces": 5, "wires": 1, "labels": 1, "lights": 1, "cameras": 1,
        "escapes": 1, "unknown": 0 });
    assert_eq!((&counts["written"], &counts["placed"]), (&written, &placed));
    assert_eq!((&counts["corners"], &counts["faces_with_holes"]), (&json!(20), &json!(0)));
    assert_eq!(counts["box"], json!([[0.0, 0.0, 0.0], [5.0, 4.0, 5.5]]));
    // By symmetry the plane is z = 5.25, with all corners at distance 0.25.
    let face = json!({ "name": "bent", "file": "<stdin>", "line": 5 });
    assert_eq!(counts["least_flat"]["face"], face);
    let thickness = counts["least_flat"]["thickness_over_size"].as_f64().unwrap();
    assert!((thickness - 0.25 / 25.25_f64.sqrt()).abs() < 1e-15, "{thickness}");
    let body = |velocity: Value, faces: u32, wires: u32| json!({ "velocity": velocity, "faces": faces, "wires": wires });
    let bodies = counts["bodies"].as_array().unwrap();
    assert_eq!(bodies.len(), 3, "{bodies:?}");
    for expected in [
        body(Value::Null, 1, 1),
        body(json!([0.5, 0.0, 0.0]), 3, 0),
        body(json!([0.0, 0.25, 0.0]), 1, 0),
    ] {
        assert!(bodies.contains(&expected), "{bodies:?}");
    }

    let table = UGPARSE.text("count", text);
    for row in
        ["vertices 8 20", "arrays 1 -", "least flat face 5.0e-2 of its size: `bent`, <stdin>:5"]
    {
        let words = |line: &str| line.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(table.lines().any(|line| words(line) == row), "{row}\n{table}");
    }
}

#[test]
fn count_of_nothing() {
    let counts = report("count -format json", "\n");
    assert_eq!((&counts["box"], &counts["least_flat"]), (&Value::Null, &Value::Null));
    assert_eq!((&counts["bodies"], &counts["turned"]), (&json!([]), &Value::Null));
}

#[test]
fn every_example_has_a_subject() {
    let list = UGPARSE.text("example", "");
    let subjects: Vec<&str> =
        list.lines().filter_map(|line| Some(line.trim().split_once("  ")?.1.trim())).collect();
    assert!(subjects.len() > 9 && subjects.iter().all(|subject| subject.len() >= 20), "{list}");
}
