//! The record in a picture of how it was made.

use ugimage::Metadata;
use ugscene::{Head, Provenance};

/// Name and version of the program that drew a scene, the command lines of the whole pipe, hash and
/// name of every other file that was read, and the pipe in one line with those of its input (see
/// [`ugscene::Head::recipe`]).
pub fn metadata(head: &Head, drawn_by: Provenance<'_>) -> Metadata {
    let recipe = head.recipe(drawn_by);
    let mut lines = head.history();
    lines.extend(drawn_by.command);
    lines.extend(head.other_files(drawn_by).filter(|_| drawn_by.command.is_some()));
    lines.extend(recipe.as_deref());
    let software = format!("{} {}", drawn_by.program, drawn_by.version).trim().to_owned();
    Metadata { software, comment: lines.join("\n"), ..Metadata::default() }
}
