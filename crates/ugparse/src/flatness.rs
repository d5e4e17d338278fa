//! Warns of faces that are not flat.

use ugscene::BentFace;

use crate::Source;
use crate::diagnostic::Diagnostic;
use crate::expand::Origins;
use crate::resolve::face_name;
use crate::source::Span;

/// A face that is less flat than this causes a warning. Coordinates are rounded in files, so
/// smaller deviations are common.
pub const FLAT: f64 = 1e-3;

/// A single warning for all that are not flat.
pub(crate) fn warning(source: &Source, origins: &Origins, bent: &[BentFace]) -> Option<Diagnostic> {
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
    let help = "cut it into triangles: it is drawn as triangles, perhaps not as those that are meant";
    Some(Diagnostic::warning(place, format!("face{shown}{others} not flat")).label(label).help(help))
}
