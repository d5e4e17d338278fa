//! Moves colours and surfaces from the scopes to the scene, and resolves their names.

use rayon::prelude::*;
use ugscene::{
    Color, ColorId, ColorTable, Mix, NameId, Names, Scene, Shading, SurfaceId, SurfaceProperties,
};

use super::corners::LEAST_ROWS;
use super::enclosing;
use crate::diagnostic::Diagnostic;
use crate::options::{Limit, Limits};
use crate::rows::{Named, Rows};
use crate::scope::{Scope, shifted};
use crate::source::{Images, Span};

/// The limit for names of colours and surfaces, paths included, is the limit for all names divided
/// by this.
const PART_OF_NAMES: u64 = 4;

/// For each scope, the row of its first colour, and of its first surface, in the scene.
#[derive(Default)]
pub(super) struct Firsts {
    pub colors: Vec<usize>,
    pub surfaces: Vec<usize>,
}

/// Moves the colours and surfaces of all scopes to the scene.
pub(super) fn gather_named(
    text: &[u8],
    scopes: &mut [Scope<'_>],
    scene: &mut Scene,
    limits: &Limits,
) -> Result<Firsts, Diagnostic> {
    let mut firsts = Firsts::default();
    let mut room = limits.get(Limit::Names) / PART_OF_NAMES;
    for row in 0..scopes.len() {
        firsts.colors.push(scene.colors.len());
        firsts.surfaces.push(scene.surfaces.len());
        let scope = &scopes[row];
        if scope.colors.spans.is_empty() && scope.surfaces.spans.is_empty() {
            continue;
        }
        let prefix = scope_prefix(text, scopes, row);
        let scope = &mut scopes[row];
        let mut name = |names: &mut Names, own: &str, span: Span| {
            let taken = (prefix.len() + own.len()) as u64;
            room = room.checked_sub(taken).ok_or_else(|| long_names(span, limits))?;
            Ok::<NameId, Diagnostic>(names.add_parts(&[&prefix, own]))
        };
        let first_sample = scene.samples.len();
        scene.samples.append(&mut scope.samples);
        let colors = std::mem::take(&mut scope.colors.table.rows).into_iter();
        for ((color, &span), own) in colors.zip(&scope.colors.table.spans).zip(&scope.colors.spans)
        {
            let own = match own {
                Some(own) => own.lossy(text),
                None => format!("unnamed#{}", scene.colors.len()),
            };
            let name = name(&mut scene.names, &own, span)?;
            let value = shifted(color.value, first_sample).with_tint_in(scene.stage.hue_scale());
            scene.colors.push(Color { name, value, ..color });
        }
        let surfaces = std::mem::take(&mut scope.surfaces.table.rows).into_iter();
        for ((surface, &span), own) in
            surfaces.zip(&scope.surfaces.table.spans).zip(scope.surfaces.spans.iter().flatten())
        {
            let name = name(&mut scene.names, &own.lossy(text), span)?;
            scene.surfaces.push(SurfaceProperties { name, ..surface });
        }
    }
    Ok(firsts)
}

fn long_names(span: Span, limits: &Limits) -> Diagnostic {
    let else_do = "use shorter names for definitions that hold colours or surfaces; \
                   theirs may have a quarter of all bytes";
    Diagnostic::error(
        span,
        "the names of colours and surfaces, with those of their definitions before them, are too long",
    )
    .label("this one exceeds the limit")
    .limited(limits, Limit::Names, else_do)
}

/// `outer:inner:` for the colours and surfaces of a nested definition, empty for the file's.
fn scope_prefix(text: &[u8], scopes: &[Scope<'_>], row: usize) -> String {
    enclosing(scopes, row)
        .filter(|&scope| scopes[scope].parent.is_some())
        .fold(String::new(), |inner, scope| format!("{}:{inner}", scopes[scope].name.lossy(text)))
}

/// For each name of a kind in a scope, the row in the scene to which it refers.
pub(super) fn visible<'g, T: 'g>(
    scopes: &'g [Scope<'_>],
    row: usize,
    kind: impl Fn(&'g Scope<'_>) -> &'g Named<'g, T>,
    firsts: &[usize],
) -> Vec<Option<usize>> {
    let find = |name: &&[u8]| {
        enclosing(scopes, row)
            .find_map(|scope| Some(firsts[scope] + kind(&scopes[scope]).row(name)?))
    };
    kind(&scopes[row]).names.list.iter().map(find).collect()
}

/// The row of a colour that is not defined; no table has as many.
const UNDEFINED: usize = u32::MAX as usize - 1;

/// Replaces names of colours by rows; returns false if one is not defined.
pub(super) fn paint(scope: &mut Scope<'_>, colors: &[Option<usize>]) -> bool {
    if colors.iter().enumerate().all(|(row, color)| *color == Some(row)) {
        return true;
    }
    let rows: Vec<_> =
        colors.iter().map(|row| ColorId::from_index(row.unwrap_or(UNDEFINED))).collect();
    let paint = |color: &mut ColorId| *color = rows[color.index()];
    let vertices = scope.vertices.rows.par_iter_mut().with_min_len(LEAST_ROWS);
    vertices.for_each(|vertex| vertex.color.iter_mut().for_each(paint));
    let faces = scope.faces.rows.par_iter_mut().with_min_len(LEAST_ROWS);
    faces.for_each(|face| face.color.iter_mut().for_each(paint));
    scope.wires.rows.iter_mut().flat_map(|wire| &mut wire.color).for_each(paint);
    scope.lights.rows.iter_mut().flat_map(|light| &mut light.color).for_each(paint);
    scope.calls.rows.iter_mut().flat_map(|call| &mut call.color).for_each(paint);
    scope.emissions.rows.iter_mut().flatten().for_each(paint);
    scope.textures.rows.iter_mut().for_each(|texture| paint(&mut texture.color));
    for Mix { color, parts } in &mut scope.mixes.rows {
        parts.iter_mut().map(|part| &mut part.0).chain([color]).for_each(paint);
    }
    for ColorTable { color, rows, .. } in &mut scope.color_tables.rows {
        rows.iter_mut().map(|row| &mut row.1).chain([color]).for_each(paint);
    }
    colors.iter().all(Option::is_some)
}

/// Moves what a scope states of its colours to the scene. Returns errors where it is stated twice
/// of one colour.
pub(super) fn gather_of_colors(
    scope: &mut Scope<'_>,
    images: &Images,
    scene: &mut Scene,
) -> impl Iterator<Item = Diagnostic> + use<> {
    let Scope { mixes, textures, emissions, color_tables, .. } = scope;
    for image in textures.rows.iter_mut().map(|texture| &mut texture.image) {
        let key = (image.file.clone().unwrap_or_default(), image.row);
        image.bytes = images.get(&key).cloned().unwrap_or_default();
    }
    let twice = [
        stated_twice(mixes, |mix| mix.color, "is mixed twice", scene),
        stated_twice(textures, |texture| texture.color, "has two pictures", scene),
        stated_twice(emissions, |emission| emission[0], "emits two colours", scene),
    ];
    scene.mixes.extend_from_slice(&mixes.rows);
    scene.textures.append(&mut textures.rows);
    scene.emissions.append(&mut emissions.rows);
    scene.color_tables.extend_from_slice(&color_tables.rows);
    twice.into_iter().flatten()
}

/// The error of the first colour that is stated twice in rows of a scope.
fn stated_twice<T>(
    Rows { rows, spans }: &Rows<T>,
    color: impl Fn(&T) -> ColorId,
    what: &str,
    scene: &Scene,
) -> Option<Diagnostic> {
    let mut order: Vec<usize> = (0..rows.len()).collect();
    order.sort_by_key(|&row| color(&rows[row]));
    let twice = order.windows(2).find(|pair| color(&rows[pair[0]]) == color(&rows[pair[1]]))?;
    let name = scene.names.get(scene.colors[color(&rows[twice[0]]).index()].name);
    let places = [spans[twice[1]], spans[twice[0]]];
    Some(Diagnostic::again(places, format!("colour `{name}` {what}"), "remove one of them"))
}

/// Replaces names of surfaces by rows; returns false if one is not defined.
pub(super) fn name_surfaces(scope: &mut Scope<'_>, surfaces: &[Option<usize>]) -> bool {
    for shading in &mut scope.shadings {
        if let Shading::Surface(id) = shading
            && let Some(row) = surfaces[id.index()]
        {
            *id = SurfaceId::from_index(row);
        }
    }
    surfaces.iter().all(Option::is_some)
}

/// Applies unnamed colours to the faces and wires of the file. Those of definitions get them during
/// expansion, because the colours of calls take precedence.
pub(super) fn apply_default_colors(file: &mut Scope<'_>) {
    let Scope { defaults, faces, wires, .. } = file;
    for (idx, default) in defaults.iter().enumerate() {
        let next = defaults.get(idx + 1);
        // The file's colours are the first in the scene.
        let color = Some(ColorId::from_index(default.color as usize));
        let end = next.map_or(faces.len(), |next| next.first_face);
        for face in &mut faces.rows[default.first_face..end] {
            face.color = face.color.or(color);
        }
        let end = next.map_or(wires.len(), |next| next.first_wire);
        for wire in &mut wires.rows[default.first_wire..end] {
            wire.color = wire.color.or(color);
        }
    }
}
