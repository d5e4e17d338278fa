//! The record in a picture of how it was made.

use ugimage::Metadata;
use ugscene::{Provenance, Remarks};

/// Name and version of the program that drew a scene, the command lines of the whole pipe, and the
/// pipe in one line (see [`ugscene::Remarks::recipe`]).
pub fn metadata(remarks: &Remarks, drawn_by: Provenance<'_>) -> Metadata {
    let recipe = remarks.recipe(drawn_by);
    let mut lines = remarks.history();
    lines.extend(drawn_by.command);
    lines.extend(recipe.as_deref());
    let software = format!("{} {}", drawn_by.program, drawn_by.version).trim().to_owned();
    Metadata { software, comment: lines.join("\n"), ..Metadata::default() }
}
