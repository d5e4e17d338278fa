//! What every filter does round its own work.

use ugparse::{Diagnostics, Options, Parsed, Scene, Source};

/// What a filter gives back.
#[derive(Clone, Debug)]
pub struct Filtered {
    /// The scene as text.
    pub text: Vec<u8>,
    /// What the user should know.
    pub notes: Vec<String>,
    /// What was wrong with the scene, and mended.
    pub warnings: Diagnostics,
}

/// Reads a scene, lets `work` change it, writes it.
///
/// # Errors
/// What is wrong with the text, or what `work` finds.
pub fn filter<E: From<Diagnostics>>(
    source: &Source,
    options: &Options,
    work: impl FnOnce(&Parsed) -> Result<(Scene, Vec<String>), E>,
) -> Result<Filtered, E> {
    let parsed = ugparse::parse(source, options)?;
    let (scene, notes) = work(&parsed)?;
    Ok(Filtered { text: ugparse::write(&scene), notes, warnings: parsed.warnings })
}
