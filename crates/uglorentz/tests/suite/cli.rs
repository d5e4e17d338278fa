//! What a user and a shell see of the program.

use ugtesting::run::{BuiltProgram, messages};

const UGLORENTZ: BuiltProgram = BuiltProgram::new(env!("CARGO_BIN_EXE_uglorentz"));
const TILE: &str = "v a 3 0 1; v b 4 0 1; v c 3 1 1;\nf (a b c) ;\n";

#[test]
fn scenes_come_out_as_seen() {
    let args = "-vel -0.6 0 0 -ep 0 0 1 -sd 1";
    assert_eq!(UGLORENTZ.notes(args, TILE), "");
    let text = UGLORENTZ.text(args, TILE);
    let (origin, text) = text.split_once('\n').unwrap();
    assert!(origin.starts_with("{ SHA-256 ") && origin.ends_with(" - }"), "{origin}");
    assert_eq!(
        text,
        "{ uglorentz 0.1.0: uglorentz -vel -0.6 0 0 -ep 0 0 1 -sd 1 }
(ugstage 1 geometry as-seen eye 0 0 1)
v a 6 0 1;
v b 8 0 1;
v c 6.1217082451262845 1 1;
f (a b c) <-0.6 0 0>;
cam -ep 0 0 1;
"
    );
}

#[test]
fn a_scene_without_a_camera_is_seen_by_the_default_one() {
    let note = UGLORENTZ.notes("-vel .5 0 0 -in", TILE);
    let camera =
        note.strip_prefix("uglorentz: note: no camera in the scene: seen as with ").unwrap();
    let text = UGLORENTZ.text("-vel .5 0 0 -in", TILE);
    let statement = text.lines().find(|line| line.starts_with("cam ")).unwrap();
    let eye = |options: &str| {
        options.split_whitespace().skip(1).take(3).map(str::to_owned).collect::<Vec<_>>()
    };
    assert_eq!(eye(camera), eye(&statement[4..]), "{note} {text}");
}

#[test]
fn options_have_two_spellings() {
    let check = |historical: &str, descriptive: &str| UGLORENTZ.same(historical, descriptive, TILE);
    check("-vel .5 0 0", "--velocity .5 0 0");
    check("-vel .5 0 0 -ti -2.5 -ep 0 0 -1", "--velocity .5 0 0 --time -2.5 --eye 0 0 -1");
    check("-vel .5 0 0 -in", "--velocity .5 0 0 --keep-in-view");
    check("-vel .5 0 0 -in -an 3 0 1 -se 1", "--vel .5 0 0 --in-place --anchor 3 0 1 --error 1");
    check("-vel .5 0 0 -an center -sd 2 -sm", "--vel .5 0 0 --anchor center --pieces 2 --smooth");
    check("-cv .5 0 0", "--camera-velocity .5 0 0");
    check(
        "-cull -vc 3 1 1 -ud 0 1 0 -va 50 40 -og -sz 4 3",
        "--cull --center 3 1 1 --up 0 1 0 --view-angle 50 40 --orthographic --size 4 3",
    );
    check("-vel .5 0 0 -sc .5", "--vel .5 0 0 --color-error .5");
    check("-vel .5 0 0 -sc off", "--velocity .5 0 0 --color-error off");
    check("-vel .5 0 0 -nc -no-flight-time", "--vel .5 0 0 --no-contraction --no-flight-time");
}

/// A chosen camera's eye is the one from which things are seen, here and in the programs behind.
#[test]
fn one_of_several_cameras_can_be_chosen() {
    let text = UGLORENTZ
        .text("-vel .5 0 0 -cam side", format!("{TILE} cam -ep 0 -9 0; cam side -ep 7 1 0;"));
    let body = |text: &str| {
        text.lines().filter(|line| !line.starts_with('{')).map(str::to_owned).collect::<Vec<_>>()
    };
    assert!(text.contains("cam -ep 7 1 0;\ncam -ep 0 -9 0;\n"), "{text}");
    let alone = UGLORENTZ.text("-vel .5 0 0", format!("{TILE} cam -ep 7 1 0; cam -ep 0 -9 0;"));
    assert_eq!(body(&text), body(&alone));
}

#[test]
fn complaints() {
    let check = |args: &str, scene: &str, status: i32, expected: &str| {
        UGLORENTZ.refuses(args, scene, status, expected)
    };
    check("-vel 1 0 0", TILE, 2, "error: -vel: speed is 1 c: it must be below 1");
    check("-vel nan 0 0", TILE, 2, "not a finite number");
    check("-vel .5 0", TILE, 2, "takes three values, not two");
    check("-se 0", TILE, 2, "the bound of -se is 0 milliradians: give a number above 0");
    check("-se -1", TILE, 2, "the bound of -se is -1 milliradians: give a number above 0");
    check("-ud 0 0 0", TILE, 2, "-ud 0 0 0 has no direction; give one, such as -ud 0 0 1");
    let no_direction = "the eye point 1 1e-300 1 is also the view centre, so there is no direction to look in; \
                        move the eye with -ep or the centre with -vc";
    check("-ep 1 1e-300 1 -vc 1 1e-300 1", TILE, 1, no_direction);
    check("-ep 1 1e-300 1", &format!("{TILE} cam -vc 1 1e-300 1;"), 1, no_direction);
    check("-va 5e-324", TILE, 1, "degrees cannot be projected on a flat picture");
    check("-sd 0", TILE, 2, "-sd 0 would make no pieces: give 1 or more");
    check("-sd 2 -se 1", TILE, 2, "cannot be given together");
    check(
        "-an nose",
        TILE,
        2,
        "`nose` is not an anchor: -an takes eye, origin, center or three numbers",
    );
    check("-an 1 2", TILE, 2, "`1 2` is not an anchor");
    check("-cam side", TILE, 1, "no camera is called `side`");
    check("-speed 3", TILE, 2, "there is no option");
    check("-vel .5 0 0 no-such-file.ug", TILE, 1, "no-such-file.ug");
    check("", "v a 0 0 0;\nf (a b c);", 1, "<stdin>:2:");
    check("", "v a 1 0 0; v b 1 1 0; v c 0 1 0;\nf (a b c) <0 1.5 0>;", 1, "<stdin>:2:");
    check(
        "-vel .5 0 0 -ep 3 0 1",
        TILE,
        1,
        "vertex `a` lies at the eye, where no direction to it exists",
    );
    check("-vel .5 0 0 -ep 3 0 1", TILE, 1, "move the eye (-ep) or the vertex");
}

#[test]
fn warnings_do_not_stop_it() {
    let bent = "v a 3 0 1; v b 4 0 1; v c 4 1 1.02; v d 3 1 1; f (a b c d);";
    let warned = UGLORENTZ.run("-vel .5 0 0", bent);
    assert!(warned.status.success() && messages(&warned).contains("face is not flat"));
    let quiet = UGLORENTZ.run("-vel .5 0 0 -qt", bent);
    assert_eq!((quiet.stdout, quiet.stderr), (warned.stdout, Vec::new()));
    // The vertex d of the second face is on the edge from a to c.
    let junction = "v a 3 0 1; v b 4 1 1; v c 3 2 1; v d 3 1 1; v e 2 1 1;
        f (a b c) <.5 0 0>; f (a d e) <.5 0 0>; f (d c e) <.5 0 0>;";
    for (pieces, has_note) in [("", false), ("-sd 1", false), ("-sd 3", true)] {
        let notes = UGLORENTZ.notes(pieces, junction);
        let note = "-sd leaves cracks where vertices of other faces are on an edge (edges: 1): give -se instead";
        assert_eq!(notes.contains(note), has_note, "{pieces}: {notes}");
    }
    let talk = UGLORENTZ.notes("-vel .5 0 0 -vb", TILE);
    assert!(talk.contains("subdivision added"), "{talk}");
}

#[test]
fn a_closed_pipe_ends_it_quietly() {
    UGLORENTZ.ends_at_a_closed_pipe("-vel .5 0 0 -ep 0 0 0", TILE);
}

#[test]
fn measurements_go_to_a_file_that_does_not_change_the_scene() {
    let folder = tempfile::tempdir().unwrap();
    let uglorentz = UGLORENTZ.in_folder(&folder);
    let plain = uglorentz.output("-vel .6 0 0 -ep 0 0 0", TILE);
    let output = uglorentz.run("-vel .6 0 0 -ep 0 0 0 -at t.csv", TILE);
    assert_eq!((messages(&output).as_str(), output.stdout), ("", plain));
    assert!(
        std::fs::read_to_string(folder.path().join("t.csv")).unwrap().starts_with("name,x,y,z,")
    );

    uglorentz.refuses(
        "-at t.txt",
        TILE,
        2,
        "the name of its file must end with .csv, .ply or .vtp",
    );
    uglorentz.refuses("-at both.ply -fo both.ply", TILE, 2, "two outputs cannot go to one file");
    uglorentz.refuses("-at none.csv", "f (a b c);", 1, "`a` is not defined");
    uglorentz.refuses("-at no/folder.csv", TILE, 1, "cannot write");
    // The scene could not be written, so there is no table either.
    uglorentz.refuses("-at late.csv -fo no/scene.ug", TILE, 1, "cannot write");
    let left: Vec<_> =
        std::fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    assert_eq!(left, ["t.csv"]);
}
