//! What a picture says about its making.

use ugimage::Metadata;
use ugparse::Scene;

/// Name and version of the program that drew a scene, the command lines of the whole pipe, and the
/// pipe in one line (see [`ugscene::recipe`]). `command_line`: of the program, empty if there is
/// none.
pub fn metadata(scene: &Scene, program: &str, version: &str, command_line: &str) -> Metadata {
    let mut lines = ugscene::history(scene);
    let mut recipe = None;
    if !command_line.is_empty() {
        lines.push(command_line);
        recipe = ugscene::recipe(scene, program, version, command_line);
    }
    lines.extend(recipe.as_deref());
    Metadata { software: format!("{program} {version}"), comment: lines.join("\n") }
}
