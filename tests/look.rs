//! `-look`: the options that docs/pipeline.md lists, and no others.

use std::fmt::Debug;
use std::fs;

use ugpipe::{ToolArgs, parse_words};
use ugtests::scenes;

/// Arguments without the word of the look itself.
fn parsed<A: ToolArgs + Debug>(words: &[&str]) -> String {
    let args: A = parse_words(words.iter().map(|word| (*word).into())).unwrap_or_else(|error| {
        panic!("{words:?}: {error:?}");
    });
    let shown = format!("{args:?}");
    assert_eq!(shown.matches("LookArgs").count(), 1, "{shown}");
    ["Light", "Shape", "Report"]
        .iter()
        .fold(shown, |shown, look| shown.replace(&format!("Some({look})"), "None"))
}

fn of_program(words: &[&str]) -> String {
    match words[0] {
        "uglorentz" => parsed::<uglorentz::Args>(words),
        "ugdoppler" => parsed::<ugdoppler::Args>(words),
        "ugrainbow" => parsed::<ugrainbow::Args>(words),
        "ugphoton" => parsed::<ugphoton::Args>(words),
        "ugwarp" => parsed::<ugwarp::Args>(words),
        "ugfilm" => parsed::<ugfilm::Args>(words),
        name => panic!("{name}"),
    }
}

fn check(words: &[&str], options: &[&str]) {
    let (name, others) = words.split_first().unwrap();
    // The options of a look come first.
    let others = others.iter().filter(|word| !is_look(word)).copied();
    let spelt: Vec<&str> =
        [&[*name, "-look=1988"], options].concat().into_iter().chain(others).collect();
    assert_eq!(of_program(words), of_program(&spelt), "{words:?} is not {spelt:?}");
}

fn is_look(word: &str) -> bool {
    word.starts_with("-look")
}

#[test]
fn looks_stand_for_the_options_of_the_manual() {
    let text = fs::read_to_string(scenes::root().join("docs/pipeline.md")).unwrap();
    let table = text.split("| `-look shape` |\n").nth(1).unwrap();
    let rows: Vec<&str> = table.lines().skip(1).take_while(|line| line.starts_with('|')).collect();
    assert_eq!(rows.len(), 8, "the rows of the table");
    for row in rows {
        let cells: Vec<&str> =
            row.trim_matches('|').split('|').map(|cell| cell.trim().trim_matches('`')).collect();
        let program: Vec<&str> = cells[0].split(' ').collect();
        for (look, options) in
            [("-look=light", cells[1]), ("-look=shape", cells[2]), ("-look=1988", "no change")]
        {
            let options: Vec<&str> =
                if options == "no change" { Vec::new() } else { options.split(' ').collect() };
            check(&[&program, &[look][..]].concat(), &options);
        }
    }
}

#[test]
fn programs_have_looks_of_their_own() {
    check(&["ugphoton"], &["-sp", "-vr", "-ex", "auto", "-tc", "filmic"]);
    check(&["ugphoton", "-crop", "0", "0", "9", "9"], &["-sp", "-vr", "-tc", "filmic"]);
    check(&["ugwarp"], &["-sp", "-ex", "auto", "-tc", "filmic"]);
    check(&["ugfilm"], &["-sp", "-vr", "-ex", "auto", "-tc", "filmic"]);
    for name in ["uglorentz", "ugdoppler", "ugrainbow"] {
        check(&[name], &[]);
    }
}

#[test]
fn options_that_are_given_come_first() {
    check(&["ugphoton", "-look=light", "-ex", "-2"], &["-sp", "-vr", "-tc", "filmic"]);
    check(&["ugphoton", "-look=light", "--exposure", "1", "-tc", "clip"], &["-sp", "-vr"]);
    check(&["ugphoton", "-look=light", "-br", "photon"], &["-vr", "-ex", "auto", "-tc", "filmic"]);
    check(&["ugdoppler", "-look=light", "-gw"], &["-vr"]);
    check(&["ugphoton", "-look=shape", "-br", "photon"], &["--no-doppler", "-vr"]);
    for linear in [["-dt", "exr"], ["-fo", "light.pfm"], ["-fo", "light.HDR"]] {
        check(&[&["ugphoton", "-look=light"], &linear[..]].concat(), &["-sp", "-vr"]);
    }
    check(
        &["ugphoton", "-look=light", "-fo", "light.hdr", "-dt", "png"],
        &["-sp", "-vr", "-ex", "auto", "-tc", "filmic"],
    );
}
