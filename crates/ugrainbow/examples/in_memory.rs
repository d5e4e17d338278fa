//! The pipe in one process: `cargo run --release --example in_memory < scenes/cubes.ug > cubes.png`
//! writes the bytes of `uglorentz -vel .3 -.2 0 -in < cubes.ug | ugdoppler -ir | ugrainbow -sz 160
//! 120`.

use std::error::Error;
use std::io::{Read, Write};

/// The PNG file of the scene of a text, with the history that the shell pipe writes.
pub fn png(text: &[u8]) -> Result<Vec<u8>, Box<dyn Error>> {
    const VERSION: &str = env!("CARGO_PKG_VERSION");
    let scene =
        ugscene::read(&ugparse::Source::new("scene", text), &ugparse::Options::default(), None)?.scene;
    let velocity = Some(glam::DVec3::new(0.3, -0.2, 0.0));
    let lorentz = uglorentz::Config { velocity, in_place: true, ..Default::default() };
    let (mut scene, _) = uglorentz::apply(scene, &lorentz)?;
    ugscene::record(&mut scene, "uglorentz", VERSION, "uglorentz -vel .3 -.2 0 -in");
    let (mut scene, _) = ugdoppler::apply(scene, &ugdoppler::Config { iris: true, ..Default::default() })?;
    ugscene::record(&mut scene, "ugdoppler", VERSION, "ugdoppler -ir");
    let picture = ugrainbow::PictureOptions { size: [160, 120], ..Default::default() };
    let rendering = ugrainbow::render(&scene, &ugrainbow::Config { picture, ..Default::default() })?;
    Ok(rendering.into_file(&ugrainbow::metadata(&scene, "ugrainbow -sz 160 120")))
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut text = Vec::new();
    std::io::stdin().read_to_end(&mut text)?;
    Ok(std::io::stdout().write_all(&png(&text)?)?)
}
