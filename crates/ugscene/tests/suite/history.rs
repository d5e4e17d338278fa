//! What made a scene.

use ugscene::{Head, Provenance};

fn made<'s>(program: &'s str, version: &'s str, command: &'s str) -> Provenance<'s> {
    Provenance { program, version, command: Some(command), ..Provenance::default() }
}

fn licensed() -> Head {
    Head { comments: vec![" A licence: free for all ".to_string()], ..Head::default() }
}

#[test]
fn history_is_what_was_recorded() {
    let mut head = licensed();
    head.record(made("uglorentz", "0.1.0", "uglorentz -vel .9 0 0"));
    head.record(made("ugdoppler", "0.1.0", "ugdoppler"));
    assert_eq!(head.history(), ["uglorentz -vel .9 0 0", "ugdoppler"]);
    assert_eq!(head.comments[0], " A licence: free for all ");
    assert_eq!(head.recipe(made("ugrainbow", "0.1.0", "ugrainbow")), None);
}

#[test]
fn recipes_are_pipes() {
    let hash = "0123456789abcdef".repeat(4);
    let check = |name: &str, first: &str| {
        let mut head = licensed();
        head.files = vec![format!("SHA-256 {hash} {name}")];
        let alone = head.recipe(made("ugrainbow", "0.1.0", "ugrainbow")).expect("an origin");
        assert!(alone.starts_with("ugrainbow ") && alone.ends_with("; ugrainbow 0.1.0"), "{alone}");
        head.record(made("uglorentz", "0.1.0", "uglorentz -vel .9 0 0"));
        // What a program downstream reads is not the input of the pipe.
        head.files = vec![format!("SHA-256 {} -", "0".repeat(64))];
        head.record(made("ugdoppler", "0.2.0", "ugdoppler"));
        let line = head.recipe(made("ugrainbow", "0.1.0", "ugrainbow -sz 9 9"));
        assert_eq!(
            line.expect("an origin"),
            format!(
                "{first} | ugdoppler | ugrainbow -sz 9 9 # SHA-256 {hash} {name}; \
                 uglorentz 0.1.0, ugdoppler 0.2.0, ugrainbow 0.1.0"
            )
        );
    };
    check("ship.ug", "uglorentz ship.ug -vel .9 0 0");
    check("'my ship.ug'", "uglorentz 'my ship.ug' -vel .9 0 0");
    check("-", "uglorentz -vel .9 0 0");
}

/// Every file is recorded by the first program of a pipe that reads it, in the order in which it
/// does; files that could not be read, too.
#[test]
fn files_are_recorded_once() {
    let file = |digit: &str, name: &str| format!("SHA-256 {} {name}", digit.repeat(64));
    let (ship, hull, sky) = (file("1", "ship.ug"), file("2", "hull.png"), file("3", "sky.hdr"));
    let missing = ["SHA-256 none a.png", "SHA-256 none b.png"].map(str::to_owned);
    let mut head = licensed();
    head.files = vec![ship.clone(), hull.clone()];
    let read = [missing[0].clone()];
    let lorentz = made("uglorentz", "0.1.0", "uglorentz");
    head.record(Provenance { files: &read, ..lorentz });
    assert_eq!(head.comments.len(), 5);
    assert_eq!(head.comments[1..4], [&ship, &hull, &missing[0]].map(|words| format!(" {words} ")));
    // Of two files with one name and content in other folders, one may change.
    let read = [hull.clone(), sky.clone(), sky.clone(), missing[1].clone(), ship.clone()];
    let last = Provenance { files: &read, ..made("ugrainbow", "0.1.0", "ugrainbow -sky sky.hdr") };
    let others: Vec<&str> = head.other_files(last).collect();
    assert_eq!(others, [&hull, &missing[0], &sky, &sky, &missing[1]]);
    let recipe = head.recipe(last).unwrap();
    assert!(recipe.starts_with("uglorentz ship.ug | ugrainbow -sky sky.hdr # "), "{recipe}");
    // A library states no command, and what it read is not known.
    let others: Vec<&str> = head.other_files(Provenance { command: None, ..last }).collect();
    assert_eq!(others, [&hull, &missing[0]]);
}

/// A scene with a history that was changed by hand: the pipe in its history did not read it.
#[test]
fn a_scene_that_was_read_again_is_recorded() {
    let file = |digit: &str, name: &str| format!("SHA-256 {} {name}", digit.repeat(64));
    let mut head = Head { files: vec![file("1", "ship.obj")], ..Head::default() };
    head.record(made("ugmesh", "0.1.0", "ugmesh"));
    head.files = vec![file("2", "ship.ug")];
    let last = made("ugphoton", "0.1.0", "ugphoton");
    assert_eq!(head.other_files(last).collect::<Vec<_>>(), [&file("2", "ship.ug")]);
    assert!(head.recipe(last).unwrap().starts_with("ugmesh ship.obj | ugphoton # SHA-256 1111"));
    // Without the record of its input, the pipe is not known.
    head.comments.remove(0);
    assert_eq!(head.recipe(last), None);
    assert_eq!(head.other_files(last).collect::<Vec<_>>(), [&file("2", "ship.ug")]);
}
