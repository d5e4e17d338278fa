//! New vertices: made once, shared by all who meet at them.

use glam::DVec3;
use rustc_hash::{FxHashMap, FxHashSet};

use crate::motion::{Motion, Point};

/// New vertices keep this part of the size of what is cut away from the eye, where they would have no direction.
const AT_EYE: f64 = 1e-12;

/// Where an edge is cut that has the eye in its middle. The eye is then well off the middle of the longer part.
const BESIDE_MIDDLE: f64 = 0.375;

/// A quarter of the way from the mean to the middle of the first side.
const BESIDE_MEAN: [f64; 4] = [0.3125, 0.3125, 0.1875, 0.1875];

/// What a new vertex is a mean of. Unused parents have weight 0.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Recipe {
    /// Rows of the parents; all smaller than the row made.
    pub parents: [u32; 4],
    /// Their weights; the sum is 1.
    pub weights: [f64; 4],
}

/// The vertices of the scene and those that cutting adds.
pub(crate) struct RefinedMesh<'a> {
    /// How the bodies move; [`Point::body`] is a row of it.
    pub motions: &'a [Motion],
    /// All vertices, those of the scene first.
    pub points: Vec<Point>,
    /// How the new ones were made.
    pub recipes: Vec<Recipe>,
    middles: FxHashMap<(u32, u32), u32>,
    /// Edges of the scene's faces, and what they were halved into, by their ends in order.
    rims: FxHashSet<(u32, u32)>,
}

impl<'a> RefinedMesh<'a> {
    pub(crate) fn new(motions: &'a [Motion], points: Vec<Point>) -> RefinedMesh<'a> {
        RefinedMesh {
            motions,
            points,
            recipes: Vec::new(),
            middles: FxHashMap::default(),
            rims: FxHashSet::default(),
        }
    }

    pub(crate) fn point(&self, row: u32) -> &Point {
        &self.points[row as usize]
    }

    pub(crate) fn motion(&self, row: u32) -> &Motion {
        &self.motions[self.point(row).body as usize]
    }

    /// Notes that this is an edge of a face of the scene, not one within a face.
    pub(crate) fn add_rim(&mut self, a: u32, b: u32) {
        self.rims.insert((a.min(b), a.max(b)));
    }

    /// Is this a part of an edge of the scene, as far as was noted?
    pub(crate) fn is_rim(&self, a: u32, b: u32) -> bool {
        self.rims.contains(&(a.min(b), a.max(b)))
    }

    /// The vertex in the middle of an edge, or beside it if the eye is there.
    pub(crate) fn middle(&mut self, a: u32, b: u32) -> u32 {
        let key = (a.min(b), a.max(b));
        if let Some(&row) = self.middles.get(&key) {
            return row;
        }
        let (low, high) = (self.point(key.0).rest, self.point(key.1).rest);
        let is_at_eye = low.midpoint(high).length() <= AT_EYE * (high - low).length();
        let part = if is_at_eye { BESIDE_MIDDLE } else { 0.5 };
        let row = self.add(Recipe { parents: [key.0, key.1, 0, 0], weights: [1.0 - part, part, 0.0, 0.0] });
        self.middles.insert(key, row);
        if self.rims.contains(&key) {
            self.add_rim(key.0, row);
            self.add_rim(row, key.1);
        }
        row
    }

    /// The mean of the corners of a convex quadrilateral, not shared; if the eye is there, a point beside it that
    /// still lies between the middles of the sides, so that the pieces round it are convex too.
    pub(crate) fn mean(&mut self, parents: [u32; 4]) -> u32 {
        let [a, b, c, d] = parents.map(|row| self.point(row).rest);
        let is_at_eye = ((a + b + c + d) / 4.0).length() <= AT_EYE * (a - c).length();
        let weights = if is_at_eye { BESIDE_MEAN } else { [0.25; 4] };
        self.add(Recipe { parents, weights })
    }

    /// The mean of the corners of a triangle, or a point beside it if the eye is there, not shared.
    pub(crate) fn center(&mut self, [a, b, c]: [u32; 3]) -> u32 {
        let corners = [a, b, c].map(|row| self.point(row).rest);
        let mean = corners.iter().sum::<DVec3>() / 3.0;
        let is_at_eye = mean.length() <= AT_EYE * (corners[0] - corners[1]).length();
        let [first, other] = if is_at_eye { [0.5, 0.25] } else { [1.0 / 3.0, 1.0 / 3.0] };
        self.add(Recipe { parents: [a, b, c, 0], weights: [first, other, other, 0.0] })
    }

    /// A new vertex of the body of its first parent.
    pub(crate) fn add(&mut self, recipe: Recipe) -> u32 {
        let used = || recipe.parents.into_iter().zip(recipe.weights).filter(|&(_, weight)| weight > 0.0);
        let rest = used().map(|(parent, weight)| self.point(parent).rest * weight).sum();
        let generation = used().map(|(parent, _)| self.point(parent).generation).max().unwrap_or(0) + 1;
        let body = self.point(recipe.parents[0]).body;
        let row = u32::try_from(self.points.len()).expect("cutting stops long before 2^32 vertices");
        let point = self.motions[body as usize].point(body, rest);
        self.points.push(Point { generation, ..point });
        self.recipes.push(recipe);
        row
    }
}
