//! Resolves names after the whole text is parsed: replaces the colours, vertices and definitions of
//! every scope by rows, and checks each once, however often a definition is placed.

mod calls;
mod corners;
mod degenerate;
mod named;
mod sizes;
mod tables;
mod undefined;

use ugscene::Scene;

use crate::diagnostic::Diagnostic;
use crate::options::Limits;
use crate::scope::Scope;
use crate::source::Source;

pub(crate) use degenerate::{degeneracy, face_name, is_short, remove_degenerate, short_wire};
pub(crate) use undefined::{undefined, undefined_like};

use calls::link_calls;
use corners::{link_corners, path_corners};
use named::{apply_default_colors, gather_named, gather_of_colors, name_surfaces, paint, visible};
use sizes::Sizes;
use undefined::UndefinedNames;

/// What expansion needs besides the scopes.
#[derive(Default)]
pub(crate) struct Links {
    /// For each scope, the row of its first colour in the scene.
    pub first_colors: Vec<usize>,
    /// Length of the longest chain of nested instances.
    pub levels: usize,
}

/// Resolves all names of `scopes`, and moves their colours and surfaces to `scene`.
pub(crate) fn resolve(
    Source { text, images, .. }: &Source,
    scopes: &mut [Scope<'_>],
    scene: &mut Scene,
    limits: &Limits,
    findings: &mut Vec<Diagnostic>,
) -> Links {
    findings.extend(scopes.iter_mut().flat_map(|scope| scope.duplicates.drain(..)));
    let own_sizes = scopes.iter().map(Scope::own_size).collect();
    // The names of the file come first, so that their ids do not change.
    scene.names = std::mem::take(&mut scopes[0].names);
    let firsts = match gather_named(text, scopes, scene, limits) {
        Ok(firsts) => firsts,
        Err(finding) => {
            findings.push(finding);
            return Links::default();
        }
    };
    for row in 0..scopes.len() {
        let colors = visible(scopes, row, |scope| &scope.colors, &firsts.colors);
        let surfaces = visible(scopes, row, |scope| &scope.surfaces, &firsts.surfaces);
        let scope = &mut scopes[row];
        let has_colors = paint(scope, &colors);
        if has_colors {
            findings.extend(gather_of_colors(scope, images, scene));
        }
        let has_surfaces = name_surfaces(scope, &surfaces);
        let has_corners = link_corners(scope);
        if !(has_colors && has_surfaces && has_corners) {
            UndefinedNames { text, scopes, row, findings }.report_all();
            scopes[row].paths = path_corners(text, &scopes[row]);
        }
        let scope = &mut scopes[row];
        let vertices = std::mem::take(&mut scope.vertices.rows);
        findings.extend(remove_degenerate(text, scope, &vertices, has_corners));
        scope.vertices.rows = vertices;
    }
    scene.mixes.sort_by_key(|mix| mix.color);
    scene.textures.sort_by_key(|texture| texture.color);
    scene.emissions.sort();
    tables::check(text, scopes, scene, findings);
    apply_default_colors(&mut scopes[0]);
    (0..scopes.len()).for_each(|row| link_calls(text, scopes, row, findings));
    let mut links = Links { first_colors: firsts.colors, levels: 0 };
    match (Sizes { text, scopes, own_sizes, limits }).check_calls() {
        Ok(levels) => links.levels = levels,
        Err(finding) => findings.push(finding),
    }
    links
}

/// A scope and its enclosing scopes, from the inner to the outer.
fn enclosing<'g>(scopes: &'g [Scope<'_>], row: usize) -> impl Iterator<Item = usize> + use<'g> {
    std::iter::successors(Some(row), |&scope| scopes[scope].parent)
}
