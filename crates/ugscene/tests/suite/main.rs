//! Tests of functions on scenes, with scenes from text.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking, its helpers too")]

mod bodies;
mod body_boxes;
mod builder;
mod color_mix;
mod default_camera;
mod geometry;
mod history;
mod normals;
mod rounds;
mod view;
mod view_ahead;

use ugscene::{Scene, shorten};

/// The scene of a text without errors.
fn parse(text: &str) -> Scene {
    let source = ugparse::Source::new("t.ug", text);
    let parsed = ugparse::parse(&source, &ugparse::Options::default());
    parsed.unwrap_or_else(|findings| panic!("{findings}")).scene
}

#[test]
fn long_words_are_cut_between_characters() {
    assert_eq!(shorten(&"γ".repeat(40)), "γ".repeat(40));
    assert_eq!(shorten(&"γ".repeat(41)), "γ".repeat(40) + "…");
}
