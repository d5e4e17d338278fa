//! Cameras outside definitions take precedence over those inside.

use super::Expander;
use crate::cameras::reorder;
use crate::diagnostic::{Diagnostic, Setting};
use crate::source::Span;

/// A camera placed by an instance.
pub(super) struct NestedCamera {
    /// Row in the table of cameras.
    pub row: usize,
    /// Path of the instance; empty if the camera has a name.
    pub path: String,
}

impl Expander<'_, '_> {
    /// Moves cameras outside definitions before those inside, with a warning, if one inside would
    /// be used instead. Requires that comments are attached already.
    pub(super) fn prefer_outer_camera(&mut self) -> Option<Diagnostic> {
        let used = self.scene.camera_row()?;
        let is_nested = |row: &usize| {
            self.nested_cameras.binary_search_by_key(row, |nested| nested.row).is_ok()
        };
        if !is_nested(&used) {
            return None;
        }
        let (nested, outer): (Vec<usize>, Vec<usize>) =
            (0..self.scene.cameras.len()).partition(is_nested);
        let spans = &self.origins.cameras;
        let Some(&first_outer) = outer.first() else { return several_copies(spans, used) };
        let (span, outer_span) = (spans[used], spans[first_outer]);
        for NestedCamera { row, path } in &self.nested_cameras {
            let name = &mut self.scene.cameras[*row].name;
            // An unnamed camera would still take precedence over a named one.
            *name = name.or_else(|| Some(self.scene.names.add(path)));
        }
        let name = self.scene.cameras[used].name.map_or("", |name| self.scene.names.get(name));
        let warning = Diagnostic::warning(span, "a camera in a definition is not used")
            .label(format!("placed as `{name}`"))
            .other(outer_span, "this one, outside definitions, is used")
            .help(format!("choose this one by its name `{name}`, or remove one of them"))
            .setting(Setting::Camera);
        reorder(
            &mut self.scene,
            &mut self.passed_on,
            &mut self.origins.cameras,
            &[outer, nested].concat(),
        );
        Some(warning)
    }
}

/// The warning if the used camera has several copies.
fn several_copies(spans: &[Span], used: usize) -> Option<Diagnostic> {
    let n_copies = spans.iter().filter(|&&span| span == spans[used]).count();
    (n_copies > 1).then(|| {
        Diagnostic::warning(spans[used], format!("this camera is placed {n_copies} times"))
            .label("the first copy is used")
            .help("write the `cam` that is to be used outside definitions")
    })
}
