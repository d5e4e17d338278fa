//! Colours and spectra of scenes in motion, and the program.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking, its helpers too")]

mod cli;
mod colours;
mod spectra;

use ugdoppler::{Config, apply};
use ugparse::{Options, Source};
use ugpipe::Words;
use ugscene::Scene;

/// A scene with its colours as seen, written and read again, and the notes.
fn colour(text: &str, config: &Config) -> (Scene, Vec<String>) {
    let (scene, notes) =
        apply(parsed("t.ug", text), config).unwrap_or_else(|error| panic!("{error}"));
    // `moving` gives velocities to scenes with positions as seen that state none.
    let others = notes.iter().filter(|note| **note != ugdoppler::Note::TakenAsSeen);
    (parsed("out.ug", ugparse::write(&scene)), others.map(Words::words).collect())
}

fn parsed(name: &str, text: impl Into<Vec<u8>>) -> Scene {
    let scene = ugparse::parse(&Source::new(name, text), &Options::default());
    scene.unwrap_or_else(|findings| panic!("{findings}")).scene
}
