//! The pipe in one process: `cargo run --release --example in_memory < scenes/cubes.ug > cubes.png`
//! draws the pixels of `uglorentz -vel .3 -.2 0 -in < cubes.ug | ugdoppler -ir | ugrainbow -sz 160
//! 120`.

use std::error::Error;
use std::io::{Read, Write};

/// The PNG file of the scene of a text.
pub fn png(text: &[u8]) -> Result<Vec<u8>, Box<dyn Error>> {
    let source = ugparse::Source::new("scene", text);
    let scene = ugparse::read(&source, &ugparse::Options::default(), None)?.scene;
    let velocity = Some(glam::DVec3::new(0.3, -0.2, 0.0));
    let lorentz = uglorentz::Config { velocity, in_place: true, ..Default::default() };
    let (seen, _) = uglorentz::apply(scene, &lorentz)?;
    let (colored, _) = ugdoppler::apply(seen, &ugdoppler::Config { iris: true, ..Default::default() })?;
    let picture = ugrainbow::PictureOptions { size: [160, 120], ..Default::default() };
    let rendering = ugrainbow::render(&colored, &ugrainbow::Config { picture, ..Default::default() })?;
    Ok(rendering.into_file())
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut text = Vec::new();
    std::io::stdin().read_to_end(&mut text)?;
    Ok(std::io::stdout().write_all(&png(&text)?)?)
}
