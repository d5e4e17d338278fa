//! The language, rule by rule: accepted input, its meaning, and the output.

mod arrays;
mod cameras;
mod colors;
mod comments;
mod docs;
mod faces;
mod files;
mod limits;
mod paths;
mod round_trip;
mod rounds;
mod scopes;
mod stage;
mod statements;
mod surfaces;
mod textures;
mod threads;
mod tokens;
mod transforms;

use ugparse::{Options, Parsed, Source};
use ugscene::Scene;

/// Three vertices for faces.
const TRIANGLE: &str = "v a 0 0 0; v b 1 0 0; v c 0 1 0; ";

fn parse_with(text: impl AsRef<[u8]>, lax: bool) -> Parsed {
    let text = text.as_ref();
    let source = Source::new("test.ug", text);
    ugparse::parse(&source, &Options { lax, ..Options::default() }).unwrap_or_else(|found| {
        panic!("{}\n{}", String::from_utf8_lossy(text), found.render(false))
    })
}

fn parse(text: impl AsRef<[u8]>) -> Scene {
    parse_with(text, false).scene
}

fn write(scene: &Scene) -> String {
    String::from_utf8(ugparse::write(scene)).expect("scenes are written as UTF-8")
}

/// The text of a scene with its comments.
fn written(parsed: &Parsed) -> String {
    let text = ugparse::write_with(&parsed.scene, &parsed.passed_on);
    String::from_utf8(text).expect("scenes are written as UTF-8")
}

/// Parses and writes a scene; checks the round trip of the output.
fn flat(text: impl AsRef<[u8]>) -> String {
    let parsed = parse_with(&text, true);
    let out = written(&parsed);
    let again = parse_with(&out, true);
    assert_eq!(written(&again), out, "written, read and written again");
    out
}

/// Checks the output for `text`, line by line.
#[track_caller]
fn check(text: &str, expected: &[&str]) {
    let out = flat(text);
    assert_eq!(out.lines().collect::<Vec<_>>(), expected, "{text}");
}

/// Like [`check`], without the vertices.
#[track_caller]
fn check_rest(text: &str, expected: &[&str]) {
    let out = flat(text);
    let rest: Vec<&str> = out.lines().filter(|line| !line.starts_with("v ")).collect();
    assert_eq!(rest, expected, "{text}");
}

/// The titles of all errors of an invalid scene.
fn errors(text: impl AsRef<[u8]>) -> Vec<String> {
    let text = text.as_ref();
    match ugparse::parse(&Source::new("test.ug", text), &Options::default()) {
        Ok(_) => Vec::new(),
        Err(found) => found.list.into_iter().map(|finding| finding.message).collect(),
    }
}

/// `text` is refused with exactly one message.
#[track_caller]
fn check_error(text: &str, expected: &str) {
    assert_eq!(errors(text), [expected], "{text}");
}

/// The titles of all warnings.
fn warnings(text: &str, lax: bool) -> Vec<String> {
    parse_with(text, lax).warnings.list.into_iter().map(|finding| finding.message).collect()
}
