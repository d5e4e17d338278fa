//! Text to text in memory: a tile at 0.9 c, as `uglorentz -vel 0.9 0 0` writes it.

use std::error::Error;

use glam::DVec3;

const TILE: &str = "v a -1 1 0; v b 1 1 0; v c 1 1 2; v d -1 1 2; f (a b c d);";

fn main() -> Result<(), Box<dyn Error>> {
    let source = ugparse::Source::new("tile.ug", TILE);
    let parsed = ugparse::read(&source, &ugparse::Options::default(), None)?;
    let velocity = Some(DVec3::new(0.9, 0.0, 0.0));
    let config = uglorentz::Config { velocity, ..uglorentz::Config::default() };
    let (seen, _) = uglorentz::apply(parsed.scene, &config)?;
    ugparse::write_to(&seen, &parsed.passed_on, &mut std::io::stdout())?;
    Ok(())
}
