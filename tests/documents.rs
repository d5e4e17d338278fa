//! How commands of the documentation are changed for its tests.

use std::path::PathBuf;

use ugtests::documents::{resized, shortened, with_options, written_files};

#[test]
fn sizes_are_scaled() {
    let check = |command: &str, expected: &str| assert_eq!(resized(command, [640, 480], 0.5), expected);
    check("ugrainbow a.ug > a.png", "ugrainbow -sz 320 240 a.ug > a.png");
    check("uglorentz a.ug | ugrainbow -sz 400 300 -va 9", "uglorentz a.ug | ugrainbow -sz 200 150 -va 9");
    check("uglorentz a.ug | ugrainbow -va 9 -sz 5 3", "uglorentz a.ug | ugrainbow -va 9 -sz 3 2");
    check("ugphoton a.ug > a.png", "ugphoton -sz 320 240 a.ug > a.png");
    check("ugphoton -in -sz 400 300 -va 9 <(b)", "ugphoton -in -sz 200 150 -va 9 <(b)");
    check("ugsheet a.png > b.png", "ugsheet a.png > b.png");
    check("ugrainbow --explain 1,2 a.ug", "ugrainbow --explain 1,2 a.ug");
}

#[test]
fn films_are_shortened() {
    assert_eq!(shortened("ugfilm -frames 72 -ti 0..3 a.ug"), "ugfilm -frames 4 -ti 0..3 a.ug");
    assert_eq!(shortened("ugfilm -frames 3"), "ugfilm -frames 3");
    assert_eq!(shortened("ugrainbow a.ug"), "ugrainbow a.ug");
}

#[test]
fn options_are_added() {
    let check = |command: &str, expected: &str| assert_eq!(with_options(command, "-aa 1"), expected);
    check("uglorentz a.ug | ugrainbow > a.png", "uglorentz a.ug | ugrainbow -aa 1 > a.png");
    check("ugphoton a.ug; ugphoton b.ug", "ugphoton -aa 1 a.ug; ugphoton -aa 1 b.ug");
    check("ugsheet a.png > b.png", "ugsheet a.png > b.png");
}

#[test]
fn files_of_loops() {
    let check = |command: &str, expected: &[&str]| {
        let expected: Vec<PathBuf> = expected.iter().map(PathBuf::from).collect();
        assert_eq!(written_files(command), expected, "{command}");
    };
    check("ugrainbow a.ug > a.png", &["a.png"]);
    check("ugrainbow a.ug -fo a.png", &["a.png"]);
    check("for v in 1 2; do ugrainbow -fo a$v.png; done", &["a1.png", "a2.png"]);
    check(
        "for v in 1 2; do for t in 3 4; do x > $v-$t.png; done; done",
        &["1-3.png", "1-4.png", "2-3.png", "2-4.png"],
    );
    check("ugparse check a.ug", &[]);
}
