//! Warnings about faces: those that are not flat, and those that move and are drawn with their
//! shapes at rest.

use ugscene::{BentFace, require_seen_geometry};

use crate::diagnostic::Diagnostic;
use crate::expand::Origins;
use crate::resolve::face_name;
use crate::source::Span;
use crate::{Parsed, Source};

/// A face that is less flat than this causes a warning. Coordinates are rounded in files, so
/// smaller deviations are common.
pub const FLAT: f64 = 1e-3;

/// A single warning for all that are not flat.
pub(crate) fn bent_warning(
    source: &Source,
    origins: &Origins,
    bent: &[BentFace],
) -> Option<Diagnostic> {
    let mut warned = bent.iter().filter(|face| face.thickness > FLAT);
    let first = warned.next()?;
    let span = origins.faces[first.row];
    let name = face_name(&source.text, span);
    let shown = name.map_or(String::new(), |name| format!(" `{}`", source.slice(name)));
    let others = match warned.count() {
        0 => " is".to_string(),
        1 => " and one other are".to_string(),
        others => format!(" and {others} others are"),
    };
    let place = name.unwrap_or(Span { start: span.start, end: span.start + 1 });
    let label = format!("a corner is off by {:.1e} of its size", first.thickness);
    let help =
        "cut it into triangles: it is drawn as triangles, perhaps not as those that are meant";
    Some(
        Diagnostic::warning(place, format!("face{shown}{others} not flat")).label(label).help(help),
    )
}

/// The warning for bodies that move and are drawn with their shapes at rest; `None` if there are
/// none.
pub fn rest_shapes_warning(parsed: &Parsed) -> Option<Diagnostic> {
    let Parsed { scene, origins, .. } = parsed;
    require_seen_geometry(scene).err()?;
    let mut faces = scene.faces.iter();
    let moving = faces.find(|face| scene.bodies.is_moving(face.body));
    let span = moving.and_then(|face| origins.face(face));
    let message = "bodies in this scene move, and are drawn with their shapes at rest";
    let finding = Diagnostic::warning(span.unwrap_or_default(), message);
    let finding = finding.label("moves");
    #[cfg(feature = "report")]
    let finding = finding.help(ugpipe::remedies::DRAW_AS_SEEN);
    Some(finding)
}
