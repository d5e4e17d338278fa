//! Names of expanded rows: paths.

use ugscene::{NameId, Names, Scene, UniqueNames};

use super::Expander;
use super::placement::Inherited;
use crate::scope::Scope;

impl Expander<'_, '_> {
    pub(super) fn name(&mut self, scope: &Scope<'_>, name: NameId, inherited: &Inherited) -> NameId {
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
}

fn rename_duplicates<'n>(names: &mut Names, ids: impl Iterator<Item = &'n mut NameId>) {
    let mut taken = UniqueNames::default();
    for id in ids {
        if let Some(unique) = taken.fresh(names.get(*id)) {
            *id = names.add(&unique);
        }
    }
}
