//! Resolves vertices of instances by their paths.

use ugscene::VertexId;

use super::Expander;
use crate::resolve::{remove_degenerate, undefined};
use crate::scope::{Scope, as_str};
use crate::source::Span;

impl Expander<'_, '_> {
    /// Indexes expanded vertices by path, if the scene uses paths.
    pub(super) fn enter_paths(&mut self, file: &Scope<'_>) {
        if file.paths.is_empty() && self.scopes.iter().all(|scope| scope.paths.is_empty()) {
            return;
        }
        for (row, vertex) in self.scene.vertices.iter().enumerate().skip(self.next_vertex) {
            let path = self.scene.names.get(vertex.name).to_string();
            self.path_rows.entry(path).or_insert(VertexId::from_index(row));
        }
    }

    /// The vertex with this path, relative to `prefix`.
    pub(super) fn find_path(&mut self, prefix: &str, name: Span) -> Option<VertexId> {
        let own = as_str(name.of(self.text));
        let colon = if prefix.is_empty() { "" } else { ":" };
        let found = self.path_rows.get(&format!("{prefix}{colon}{own}")).copied();
        if found.is_none() {
            let remedy = "the path of a vertex is `instance:vertex`, or `array#3:vertex` for copy 3, from 0";
            let text = self.text;
            self.undefined.entry(name.start).or_insert_with(|| undefined(text, "vertex", name, remedy));
        }
        found
    }

    /// Resolves the file's corners that name vertices of instances. Removes faces that then have no
    /// area, and wires that are too short.
    pub(super) fn link_paths(&mut self, file: &mut Scope<'_>) {
        for path in std::mem::take(&mut file.paths) {
            let Some(vertex) = self.find_path("", path.name) else { continue };
            file.contours.all_corners_mut()[path.corner] = vertex;
            self.has_linked_paths = true;
        }
        if !self.has_linked_paths || !self.undefined.is_empty() {
            return;
        }
        let found = remove_degenerate(self.text, file, &self.scene.vertices, true);
        self.degenerate.extend(found.into_iter().map(|warning| (warning.span.start, warning)));
    }
}
