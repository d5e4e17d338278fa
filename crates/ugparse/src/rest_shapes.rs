//! Warns of bodies that move and are drawn with their shapes at rest.

use ugscene::require_seen_geometry;

use crate::{Diagnostic, Parsed};

/// The warning for bodies that move and are drawn with their shapes at rest; `None` if there are
/// none.
pub fn rest_shapes_warning(parsed: &Parsed) -> Option<Diagnostic> {
    let Parsed { scene, origins, .. } = parsed;
    require_seen_geometry(scene).err()?;
    let mut faces = scene.faces.iter();
    let moving = faces.position(|face| scene.bodies.is_moving(face.body));
    let span = moving.and_then(|row| origins.faces.get(row).copied());
    let message = "bodies in this scene move, and are drawn with their shapes at rest";
    let finding = Diagnostic::warning(span.unwrap_or_default(), message);
    let finding = finding.label("moves");
    #[cfg(feature = "report")]
    let finding = finding.help(ugpipe::remedies::DRAW_AS_SEEN);
    Some(finding)
}
