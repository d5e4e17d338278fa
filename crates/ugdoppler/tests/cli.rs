//! The program itself: usage, streams, exit status.

use std::process::{Command, Output};

fn ugdoppler(args: &[&str], input: &str) -> Output {
    ugtesting::run::fed(Command::new(env!("CARGO_BIN_EXE_ugdoppler")).args(args), input)
}

const SCENE: &str = "{ a licence }\nc green 1 120;\nv a 9 0 0;\nv b 9 1 0;\nv c 9 1 1;\nf (a b c) green;\n";

#[test]
fn a_scene_goes_through() {
    let out = ugdoppler(&["-vel", "-.5", "0", "0", "-ep", "0", "0", "0", "-nt", "1", "-gw"], SCENE);
    assert_eq!(
        String::from_utf8_lossy(&out.stderr),
        "ugdoppler: note: max intensity is 1.73, clip to 1.0\nugdoppler: note: positions in this scene are taken as \
         seen already; for a scene at rest give -vel to uglorentz\n"
    );
    assert!(out.status.success());
    let text = String::from_utf8(out.stdout).unwrap();
    let head: Vec<&str> = text.lines().take(3).collect();
    let version = env!("CARGO_PKG_VERSION");
    assert!(head[1].starts_with("{ SHA-256 ") && head[1].ends_with(" - }"), "{}", head[1]);
    assert_eq!(
        [head[0], head[2]],
        ["{ a licence }", &format!("{{ ugdoppler {version}: ugdoppler -vel -.5 0 0 -ep 0 0 0 -gw }}")]
    );
}

#[test]
fn a_vertex_at_the_eye_is_shown_in_the_text() {
    let text =
        "v a 0 0 0; v b 1 0 0;\nv c 0 1 0; f (a b c) <0.5 0 0>; (ugstage 1 geometry as-seen eye 0 0 0)";
    let out = ugdoppler(&[], text);
    assert_eq!(out.status.code(), Some(1));
    assert_eq!(
        String::from_utf8_lossy(&out.stderr),
        "ugdoppler: error: vertex `a` lies at the eye, where no direction to it exists
 --> <stdin>:1:3
  |
1 | v a 0 0 0; v b 1 0 0;
  |   ^ here
  |
help: move the eye (-ep) or the vertex
"
    );
}

#[test]
fn bad_usage_is_status_2() {
    for (args, message) in [
        (&["-vel", "1.2", "0", "0"][..], "speed is 1.2 c"),
        (&["-vel", ".5", "0"][..], "takes three values, not two"),
        (&["-vel", "nan", "0", "0"][..], "not a finite number"),
        (&["-br", "bright"][..], "none of the laws report, photon, bolometric, none"),
        (&["-ct", "-1"][..], "a colour tolerance (-ct) is between 0 and 100"),
        (&["-ct", "1e300"], "a colour tolerance (-ct) is between 0 and 100"),
        (&["-sp", "-gw"][..], "-sp writes X, Y, Z and -gw writes wavelengths of hues"),
        (&["-sp", "-br", "report"][..], "`-sp` and `-br` cannot be given together"),
        (&["-ir", "-hd"][..], "-ir scales intensities to 1 and -hd keeps them"),
        (&["-nonsense"][..], "there is no option"),
    ] {
        let out = ugdoppler(args, SCENE);
        let error = String::from_utf8_lossy(&out.stderr).into_owned();
        assert_eq!(out.status.code(), Some(2), "{args:?}: {error}");
        assert!(error.contains(message), "{args:?}: {error}");
        assert!(out.stdout.is_empty(), "{args:?}");
    }
}

#[test]
fn a_bad_scene_is_status_1_and_writes_nothing() {
    let out = ugdoppler(&[], "v a 0 0 0;\nf (a b c);\n");
    assert_eq!(out.status.code(), Some(1));
    assert!(out.stdout.is_empty());
    let error = String::from_utf8_lossy(&out.stderr).into_owned();
    assert!(error.contains("vertex `b` is not defined") && error.contains("<stdin>:2:6"), "{error}");
}
