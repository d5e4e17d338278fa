//! The program itself: usage, streams, exit status.

use ugtesting::run::{BuiltProgram, messages};

const UGDOPPLER: BuiltProgram = BuiltProgram::new(env!("CARGO_BIN_EXE_ugdoppler"));
const SCENE: &str =
    "{ a licence }\nc green 1 120;\nv a 9 0 0;\nv b 9 1 0;\nv c 9 1 1;\nf (a b c) green;\n";

#[test]
fn a_scene_goes_through() {
    let out = UGDOPPLER.run("-vel -.5 0 0 -ep 0 0 0 -nt 1 -gw", SCENE);
    assert_eq!(
        messages(&out),
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
        [
            "{ a licence }",
            &format!("{{ ugdoppler {version}: ugdoppler -vel -.5 0 0 -ep 0 0 0 -gw }}")
        ]
    );
    UGDOPPLER.ends_at_a_closed_pipe("-qt", SCENE);
}

#[test]
fn mistakes_have_answers() {
    let at_the_eye = "v a 0 0 0; v b 1 0 0;\nv c 0 1 0; f (a b c) <0.5 0 0>; (ugstage 1 geometry as-seen eye 0 0 0)";
    let shown = "ugdoppler: error: vertex `a` lies at the eye, where no direction to it exists
 --> <stdin>:1:3
  |
1 | v a 0 0 0; v b 1 0 0;
  |   ^ here
  |
help: move the eye (-ep) or the vertex
";
    UGDOPPLER.refuses("", at_the_eye, 1, shown);
    UGDOPPLER.refuses(
        "",
        "v a 0 0 0;\nf (a b c);\n",
        1,
        "vertex `b` is not defined\n --> <stdin>:2:6",
    );
    for (args, message) in [
        ("-vel 1.2 0 0", "speed is 1.2 c"),
        ("-vel .5 0", "takes three values, not two"),
        ("-vel nan 0 0", "not a finite number"),
        ("-br bright", "none of the laws report, photon, bolometric, none"),
        ("-ct -1", "a colour tolerance (-ct) is between 0 and 100"),
        ("-ct 1e300", "a colour tolerance (-ct) is between 0 and 100"),
        ("-sp -gw", "-sp writes X, Y, Z and -gw writes wavelengths of hues"),
        ("-sp -br report", "`-sp` and `-br` cannot be given together"),
        ("-ir -hd", "-ir scales intensities to 1 and -hd keeps them"),
        ("-nonsense", "there is no option"),
    ] {
        UGDOPPLER.refuses(args, SCENE, 2, message);
    }
}
