//! Triangles of polygons with many corners, by a constrained Delaunay triangulation: its time is
//! near linear in the number of corners, where that of ear cutting is not.

use glam::DVec2;
use spade::{ConstrainedDelaunayTriangulation, HasPosition, Point2, Triangulation};

use super::Triangle;

/// A corner of the polygon.
struct Corner {
    number: u32,
    position: DVec2,
}

impl HasPosition for Corner {
    type Scalar = f64;

    fn position(&self) -> Point2<f64> {
        Point2::new(self.position.x, self.position.y)
    }
}

/// Appends the triangles inside an outline and outside its holes, counterclockwise.
///
/// Each contour is a list of corner numbers with positions. `None` where corners coincide or sides
/// cross: then the polygon is not simple.
pub(super) fn triangulate(
    contours: &[Vec<(u32, DVec2)>],
    triangles: &mut Vec<Triangle>,
) -> Option<()> {
    let mut corners = Vec::new();
    let mut sides: Vec<[usize; 2]> = Vec::new();
    for contour in contours {
        let (first, n) = (corners.len(), contour.len());
        sides.extend((0..n).map(|idx| [first + idx, first + (idx + 1) % n]));
        corners.extend(contour.iter().map(|&(number, position)| Corner { number, position }));
    }
    let n_corners = corners.len();
    let distinct = corners.iter().map(|corner| corner.position.to_array().map(f64::to_bits));
    if distinct.collect::<rustc_hash::FxHashSet<_>>().len() < n_corners {
        return None;
    }
    let mut n_conflicts = 0;
    let mesh =
        ConstrainedDelaunayTriangulation::<Corner>::try_bulk_load_cdt(corners, sides, |_| {
            n_conflicts += 1
        })
        .ok()
        .filter(|mesh| mesh.num_vertices() == n_corners)?;
    if n_conflicts > 0 {
        return None;
    }
    let is_inside = inside(&mesh);
    let faces = mesh.inner_faces().filter(|face| is_inside[face.index()]);
    triangles.extend(faces.map(|face| face.vertices().map(|corner| corner.data().number)));
    Some(())
}

/// For each triangle of the mesh, whether it is inside: whether a path to it from outside crosses
/// an odd number of sides.
fn inside(mesh: &ConstrainedDelaunayTriangulation<Corner>) -> Vec<bool> {
    let mut is_inside = vec![false; mesh.num_all_faces()];
    let mut is_seen = vec![false; mesh.num_all_faces()];
    let mut todo = Vec::new();
    let mut visit = |face: usize, inside: bool, edges: &mut Vec<_>, from: Vec<_>| {
        if !std::mem::replace(&mut is_seen[face], true) {
            is_inside[face] = inside;
            edges.extend(from.into_iter().map(|edge| (edge, inside)));
        }
    };
    visit(mesh.outer_face().index(), false, &mut todo, mesh.convex_hull().collect());
    while let Some((edge, was_inside)) = todo.pop() {
        // Behind the edge lies the neighbour.
        let behind = edge.rev();
        if let Some(face) = behind.face().as_inner() {
            let inside = was_inside != edge.is_constraint_edge();
            visit(face.index(), inside, &mut todo, face.adjacent_edges().to_vec());
        }
    }
    is_inside
}
