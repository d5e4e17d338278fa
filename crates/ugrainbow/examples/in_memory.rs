//! The pipe in one process: `cargo run --release --example in_memory < scenes/cubes.ug > cubes.png`
//! draws the pixels of `uglorentz -vel .3 -.2 0 -in < cubes.ug | ugdoppler -ir | ugrainbow -sz 160
//! 120`.

use std::error::Error;
use std::io::{self, Read, Write};

/// The PNG file of the scene of a text.
pub fn png(text: &[u8]) -> Result<Vec<u8>, Box<dyn Error>> {
    let scene =
        ugparse::read(&ugparse::Source::new("scene", text), &Default::default(), None)?.scene;
    let velocity = Some(glam::DVec3::new(0.3, -0.2, 0.0));
    let motion = uglorentz::Config { velocity, in_place: true, ..Default::default() };
    let (seen, _) = uglorentz::apply(scene, &motion)?;
    let (colored, _) =
        ugdoppler::apply(seen, &ugdoppler::Config { iris: true, ..Default::default() })?;
    let mut config = ugrainbow::Config::default();
    config.picture.size = [160, 120];
    Ok(ugrainbow::render(&colored, &config)?.into_file())
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut text = Vec::new();
    io::stdin().read_to_end(&mut text)?;
    Ok(io::stdout().write_all(&png(&text)?)?)
}
