//! The colours of a scene as seen, from text to text in memory.

use std::error::Error;

use ugdoppler::{Config, apply};
use ugparse::{Options, Source};

const SHIP: &str = "(ugstage 1 geometry as-seen eye 0 0 0) c green 0.5 120;
    v a 9 0 0; v b 9 1 0; v c 9 0 1; f (a b c) green <-0.3 0 0>;";

/// What `ugdoppler -gw` writes, without its history.
fn colored(text: &str) -> Result<Vec<u8>, Box<dyn Error>> {
    let source = Source::new("ship.ug", text);
    let scene = ugparse::read(&source, &Options::default(), None)?.scene;
    let (scene, _) = apply(scene, &Config { wavelengths: true, ..Config::default() })?;
    Ok(ugparse::write(&scene))
}

fn main() -> Result<(), Box<dyn Error>> {
    let text = String::from_utf8(colored(SHIP)?)?;
    // It moves straight at the eye: D = √(1.3/0.7), and 546.1 nm is seen at 400.7 nm.
    assert!(text.contains(" 0.681") && text.contains(" 400.7"), "{text}");
    Ok(())
}
