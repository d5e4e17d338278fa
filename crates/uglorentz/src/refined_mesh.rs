//! The vertices of the subdivided scene. Faces that share an edge share its new vertices.

use glam::DVec3;
use rustc_hash::{FxHashMap, FxHashSet};
use ugscene::BodyId;

use crate::relative_motion::{Point, RelativeMotion};
use crate::tables::{self, Tables};

/// New vertices are at least this fraction of the size of what is subdivided away from the eye,
/// where their direction would be undefined.
const AT_EYE: f64 = 1e-12;

/// Where an edge is divided that has the eye at its midpoint. The eye is then well off the midpoint
/// of the longer part.
const BESIDE_MIDDLE: f64 = 0.375;

/// A quarter of the way from the mean to the midpoint of the first side.
const BESIDE_MEAN: [f64; 4] = [0.3125, 0.3125, 0.1875, 0.1875];

/// A new vertex as a weighted mean. Unused parents have weight 0.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Recipe {
    /// Rows of the parents; all smaller than the row of the new vertex.
    pub parents: [u32; 4],
    /// Their weights; the sum is 1.
    pub weights: [f64; 4],
}

/// The vertices of the scene and those added by subdivision.
pub(crate) struct RefinedMesh<'a> {
    /// The motion of each body.
    pub motions: &'a [RelativeMotion],
    /// All vertices, those of the scene first.
    pub points: Vec<Point>,
    /// One for each new vertex.
    pub recipes: Vec<Recipe>,
    middles: FxHashMap<(u32, u32), u32>,
    /// Edges of the scene's faces and the parts they were halved into, by their ordered ends.
    rims: FxHashSet<(u32, u32)>,
    /// Vertices on edges, from the first of their ordered ends to the second, see
    /// [`crate::junctions`].
    pub junctions: FxHashMap<(u32, u32), Vec<u32>>,
    /// Of each vertex, see [`tables::tables_of_vertices`]; empty if no colour changes.
    pub tables: Vec<Tables>,
}

impl<'a> RefinedMesh<'a> {
    pub(crate) fn new(motions: &'a [RelativeMotion], points: Vec<Point>) -> RefinedMesh<'a> {
        RefinedMesh {
            motions,
            points,
            recipes: Vec::new(),
            middles: FxHashMap::default(),
            rims: FxHashSet::default(),
            junctions: FxHashMap::default(),
            tables: Vec::new(),
        }
    }

    pub(crate) fn point(&self, row: u32) -> &Point {
        &self.points[row as usize]
    }

    /// `None` if no colour changes.
    pub(crate) fn tables_of<const N: usize>(&self, rows: [u32; N]) -> Option<[&Tables; N]> {
        (!self.tables.is_empty()).then(|| rows.map(|row| &self.tables[row as usize]))
    }

    pub(crate) fn motion(&self, row: u32) -> &RelativeMotion {
        self.motion_of(self.point(row).body)
    }

    pub(crate) fn motion_of(&self, body: BodyId) -> &RelativeMotion {
        &self.motions[body.index()]
    }

    /// Report that this is an edge of a face of the scene, not one within a face.
    pub(crate) fn add_rim(&mut self, a: u32, b: u32) {
        self.rims.insert((a.min(b), a.max(b)));
    }

    /// Is this part of an edge that was added?
    pub(crate) fn is_rim(&self, a: u32, b: u32) -> bool {
        self.rims.contains(&(a.min(b), a.max(b)))
    }

    /// True if a vertex of another face is on this edge.
    pub(crate) fn has_junction(&self, a: u32, b: u32) -> bool {
        !self.junctions.is_empty() && self.junctions.contains_key(&(a.min(b), a.max(b)))
    }

    /// A new vertex at the middle one of those on an edge; those beside it are on its parts.
    fn junction(&mut self, (low, high): (u32, u32)) -> Option<u32> {
        let on_edge = self.junctions.get(&(low, high))?.clone();
        let (before, from) = on_edge.split_at(on_edge.len() / 2);
        let (&middle, behind) = from.split_first()?;
        let [a, b, at] = [low, high, middle].map(|row| self.point(row).rest);
        let part = ((at - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
        let row =
            self.add(Recipe { parents: [low, high, 0, 0], weights: [1.0 - part, part, 0.0, 0.0] });
        // The same bits as for the faces that have the vertex.
        let body = self.point(row).body;
        self.points[row as usize] = Point::new(self.motion_of(body), body, at);
        for (end, part) in [(low, before.to_vec()), (high, behind.iter().rev().copied().collect())]
        {
            if !part.is_empty() {
                self.junctions.insert((end, row), part);
            }
        }
        Some(row)
    }

    /// The vertex at the midpoint of an edge, or beside it if the eye is there. A vertex of another
    /// face on the edge comes first.
    pub(crate) fn middle(&mut self, a: u32, b: u32) -> u32 {
        let key = (a.min(b), a.max(b));
        if let Some(&row) = self.middles.get(&key) {
            return row;
        }
        let row = self.junction(key).unwrap_or_else(|| {
            let (low, high) = (self.point(key.0).rest, self.point(key.1).rest);
            let is_at_eye = low.midpoint(high).length() <= AT_EYE * (high - low).length();
            let part = if is_at_eye { BESIDE_MIDDLE } else { 0.5 };
            self.add(Recipe {
                parents: [key.0, key.1, 0, 0],
                weights: [1.0 - part, part, 0.0, 0.0],
            })
        });
        self.middles.insert(key, row);
        if self.rims.contains(&key) {
            self.add_rim(key.0, row);
            self.add_rim(row, key.1);
        }
        row
    }

    /// A vertex at the mean of the corners of a convex quadrilateral, not shared. If the eye is
    /// there, it is beside the mean, still between the midpoints of the sides, so that the pieces
    /// around it are convex.
    pub(crate) fn mean(&mut self, parents: [u32; 4]) -> u32 {
        let [a, b, c, d] = parents.map(|row| self.point(row).rest);
        let is_at_eye = ((a + b + c + d) / 4.0).length() <= AT_EYE * (a - c).length();
        let weights = if is_at_eye { BESIDE_MEAN } else { [0.25; 4] };
        self.add(Recipe { parents, weights })
    }

    /// A vertex at the mean of the corners of a triangle, or beside it if the eye is there, not
    /// shared.
    pub(crate) fn center(&mut self, [a, b, c]: [u32; 3]) -> u32 {
        let corners = [a, b, c].map(|row| self.point(row).rest);
        let mean = corners.iter().sum::<DVec3>() / 3.0;
        let is_at_eye = mean.length() <= AT_EYE * (corners[0] - corners[1]).length();
        let [first, other] = if is_at_eye { [0.5, 0.25] } else { [1.0 / 3.0, 1.0 / 3.0] };
        self.add(Recipe { parents: [a, b, c, 0], weights: [first, other, other, 0.0] })
    }

    /// A new vertex of the body of its first parent.
    pub(crate) fn add(&mut self, recipe: Recipe) -> u32 {
        let used =
            || recipe.parents.into_iter().zip(recipe.weights).filter(|&(_, weight)| weight > 0.0);
        let rest = used().map(|(parent, weight)| self.point(parent).rest * weight).sum();
        let generation =
            used().map(|(parent, _)| self.point(parent).generation).max().unwrap_or(0) + 1;
        let body = self.point(recipe.parents[0]).body;
        let row =
            u32::try_from(self.points.len()).expect("subdivision stops long before 2^32 vertices");
        let point = Point::new(self.motion_of(body), body, rest);
        self.points.push(Point { generation, ..point });
        if !self.tables.is_empty() {
            let parents: Vec<&Tables> =
                used().map(|(parent, _)| &self.tables[parent as usize]).collect();
            self.tables.push(tables::common(&parents));
        }
        self.recipes.push(recipe);
        row
    }
}
