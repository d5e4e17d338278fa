//! Which tables of colours (`c_time`) the edges and pieces of faces have.

use std::sync::Arc;

use glam::DVec3;
use rustc_hash::{FxHashMap, FxHashSet};
use ugscene::{ColorId, FaceOrWire, Scene};

use crate::relative_motion::Point;

/// Tables of colours that change, by their rows in the scene, ascending.
pub(crate) type Tables = Arc<[u32]>;

/// The row of the table of a colour that changes.
pub(crate) fn table_row(scene: &Scene, color: Option<ColorId>) -> Option<usize> {
    scene.color_tables.binary_search_by_key(&color?, |table| table.color).ok()
}

/// The tables that all of several vertices have: those of the faces and wires that an edge or a
/// piece between them may belong to.
pub(crate) fn common(tables: &[&Tables]) -> Tables {
    if let [first, rest @ ..] = tables
        && rest.iter().all(|other| Arc::ptr_eq(first, other))
    {
        return Tables::clone(first);
    }
    let Some(fewest) = tables.iter().min_by_key(|tables| tables.len()) else {
        return Tables::default();
    };
    let is_common = |row: &&u32| tables.iter().all(|tables| tables.binary_search(row).is_ok());
    fewest.iter().filter(is_common).copied().collect()
}

/// The tables of the faces and wires that meet at each vertex of the scene, so that an edge is
/// halved alike in all of them; empty if no colour changes. Vertices of one place are one.
pub(crate) fn tables_of_vertices(
    scene: &Scene,
    points: &[Point],
    junctions: &FxHashMap<(u32, u32), Vec<u32>>,
) -> Vec<Tables> {
    if !scene.has_changing_surfaces() {
        return Vec::new();
    }
    let mut places = FxHashMap::default();
    let place = |point: &Point| {
        let n_places = places.len();
        *places
            .entry((point.body, (point.rest + DVec3::ZERO).to_array().map(f64::to_bits)))
            .or_insert(n_places)
    };
    let places: Vec<usize> = points.iter().map(place).collect();
    let mut tables: Vec<Vec<u32>> = vec![Vec::new(); points.len()];
    for FaceOrWire { contours, color, .. } in scene.drawn() {
        let Some(row) = table_row(scene, color) else { continue };
        for corner in scene.contours.corners(contours) {
            tables[places[corner.index()]].push(row as u32);
        }
    }
    let mut tables: Vec<Tables> = tables.into_iter().map(in_order).collect();
    let mut junctions: Vec<_> = junctions.iter().collect();
    junctions.sort_unstable();
    for (&(a, b), on_edge) in junctions {
        let [a, b] = [a, b].map(|end| places[end as usize]);
        let on_edge = on_edge.iter().map(|&row| places[row as usize]);
        let mut all = common(&[&tables[a], &tables[b]]).to_vec();
        on_edge.clone().for_each(|place| all.extend_from_slice(&tables[place]));
        for place in on_edge.chain([a, b]) {
            tables[place] = in_order([&all[..], &tables[place]].concat());
        }
    }
    // Equal ones are shared, for `common`.
    let mut known: FxHashSet<Tables> = FxHashSet::default();
    for tables in &mut tables {
        match known.get(tables) {
            Some(same) => *tables = same.clone(),
            None => drop(known.insert(tables.clone())),
        }
    }
    places.into_iter().map(|place| tables[place].clone()).collect()
}

fn in_order(mut rows: Vec<u32>) -> Tables {
    rows.sort_unstable();
    rows.dedup();
    rows.into()
}
