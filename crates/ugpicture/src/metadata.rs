//! What a picture says about its making.

use ugimage::Metadata;
use ugparse::{Provenance, Scene};

/// Name and version of the program that drew a scene, the command lines of the whole pipe, and the
/// pipe in one line (see [`ugscene::recipe`]).
pub fn metadata(scene: &Scene, drawn_by: Provenance<'_>) -> Metadata {
    let recipe = ugscene::recipe(scene, drawn_by);
    let mut lines = ugscene::history(scene);
    lines.extend(drawn_by.command);
    lines.extend(recipe.as_deref());
    let software = format!("{} {}", drawn_by.program, drawn_by.version).trim().to_owned();
    Metadata { software, comment: lines.join("\n") }
}
