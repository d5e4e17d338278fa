//! Paths: the names of what instances place, `fleet:ship:bow`, and references to vertices by them.

use ugscene::{NameId, Names, Scene, UniqueNames, VertexId};

use super::Expander;
use super::placement::Inherited;
use crate::resolve::{remove_degenerate, undefined};
use crate::scope::{Scope, as_str};
use crate::source::Span;

impl Expander<'_, '_> {
    pub(super) fn name(
        &mut self,
        scope: &Scope<'_>,
        name: NameId,
        inherited: &Inherited,
    ) -> NameId {
        self.scene.names.add_parts(&[
            &inherited.prefix,
            if inherited.prefix.is_empty() { "" } else { ":" },
            scope.names.get(name),
        ])
    }

    pub(super) fn optional_name(
        &mut self,
        scope: &Scope<'_>,
        name: Option<NameId>,
        inherited: &Inherited,
    ) -> Option<NameId> {
        name.map(|name| self.name(scope, name, inherited))
    }

    /// A path, or the generated name of an unnamed colour, may equal a name in the text; the later
    /// one in the table is renamed. `has_unnamed`: the file has colours without a name.
    pub(super) fn make_names_unique(&mut self, has_unnamed: bool) {
        let is_flat = self.scopes.len() == 1;
        let Scene { names, vertices, faces, colors, surfaces, .. } = &mut self.scene;
        // The names in a flat file are unique already, but not the generated ones: of unnamed
        // colours, and of vertices of round faces.
        if !is_flat || has_unnamed {
            rename_duplicates(names, colors.iter_mut().map(|color| &mut color.name));
            rename_duplicates(names, surfaces.iter_mut().map(|surface| &mut surface.name));
        }
        if !is_flat || faces.iter().any(|face| face.shape.is_round()) {
            rename_duplicates(names, vertices.iter_mut().map(|vertex| &mut vertex.name));
        }
    }

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
            let remedy =
                "the path of a vertex is `instance:vertex`, or `array#3:vertex` for copy 3, from 0";
            let text = self.text;
            self.undefined
                .entry(name.start)
                .or_insert_with(|| undefined(text, "vertex", name, remedy));
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

fn rename_duplicates<'n>(names: &mut Names, ids: impl Iterator<Item = &'n mut NameId>) {
    let mut taken = UniqueNames::default();
    for id in ids {
        if let Some(unique) = taken.fresh(names.get(*id)) {
            *id = names.add(&unique);
        }
    }
}
