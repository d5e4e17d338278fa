//! Subdivision of every edge into N equal pieces (`-sd N`): triangles into N² triangles, convex
//! quadrilaterals with corners of one colour and normal into N² quadrilaterals, other polygons into
//! triangles first.

use rustc_hash::FxHashMap;
use ugscene::Scene;

use crate::adaptive::MAX_PIECES;
use crate::evenness::Evenness;
use crate::pieces::{Cut, Outcome, Piece, Polyline, Shape, shape};
use crate::refined_mesh::{Recipe, RefinedMesh};

/// Subdivides all edges into `n` pieces.
///
/// # Errors
/// The number of pieces, if it is above [`MAX_PIECES`].
pub(crate) fn cut(
    scene: &Scene,
    evenness: &Evenness,
    mesh: &mut RefinedMesh,
    n: u32,
) -> Result<Outcome, usize> {
    if n <= 1 {
        return Ok(Outcome::default());
    }
    let rest = |vertex: ugscene::VertexId| mesh.point(vertex.0).rest;
    let mut shapes: Vec<Piece> = Vec::new();
    let mut lines: Vec<Polyline> = Vec::new();
    for (idx, face) in scene.faces.iter().enumerate() {
        match shape(scene, face, evenness.is_even(scene, face), rest) {
            Some(Cut::Pieces(list)) => {
                shapes.extend(list.into_iter().map(|shape| Piece { face: idx as u32, shape }));
            }
            Some(Cut::EdgeOn(list) | Cut::Contours(list)) => lines.extend(list),
            None => {}
        }
    }
    let wires = scene.wires.iter().flat_map(|wire| wire.contours.clone());
    lines.extend(wires.map(|row| Polyline::open(row, scene.contours.get(row))));

    let n_edges: usize = lines.iter().map(|line| line.edges().count()).sum();
    let n = n as usize;
    let n_pieces =
        shapes.len().saturating_mul(n.saturating_mul(n)).saturating_add(n_edges.saturating_mul(n));
    if n_pieces > MAX_PIECES {
        return Err(n_pieces);
    }

    let mut subdivision = UniformSubdivision { mesh, n, edges: FxHashMap::default() };
    let mut outcome = Outcome::default();
    for Piece { face, shape } in shapes {
        let pieces = match shape {
            Shape::Triangle(corners) => subdivision.triangle(corners),
            Shape::Quad(corners) => subdivision.quad(corners),
        };
        outcome.pieces.extend(pieces.into_iter().map(|shape| Piece { face, shape }));
    }
    outcome.lines = lines.into_iter().map(|line| subdivision.line(&line)).collect();
    Ok(outcome)
}

/// Creates the vertices of the pieces.
struct UniformSubdivision<'a, 'b> {
    mesh: &'a mut RefinedMesh<'b>,
    n: usize,
    /// The first of the N − 1 consecutive new vertices of an edge, from the lower to the higher end
    /// row.
    edges: FxHashMap<(u32, u32), u32>,
}

impl UniformSubdivision<'_, '_> {
    /// Vertex `k` of 0…N from `a` to `b`, shared by all faces at the edge.
    fn on_edge(&mut self, a: u32, b: u32, k: usize) -> u32 {
        if k == 0 {
            return a;
        }
        if k == self.n {
            return b;
        }
        let (low, high) = (a.min(b), a.max(b));
        let k = if a == low { k } else { self.n - k };
        if let Some(first) = self.edges.get(&(low, high)) {
            return first + (k - 1) as u32;
        }
        let first = self.mesh.points.len() as u32;
        self.edges.insert((low, high), first);
        for step in 1..self.n {
            let part = step as f64 / self.n as f64;
            self.mesh
                .add(Recipe { parents: [low, high, 0, 0], weights: [1.0 - part, part, 0.0, 0.0] });
        }
        first + (k - 1) as u32
    }

    /// Rows of vertices run along a → b, and follow each other along a → c.
    fn triangle(&mut self, [a, b, c]: [u32; 3]) -> Vec<Shape> {
        let n = self.n;
        let rows: Vec<Vec<u32>> = (0..=n)
            .map(|j| (0..=n - j).map(|i| self.in_triangle([a, b, c], i, j)).collect())
            .collect();
        let mut shapes = Vec::with_capacity(n * n);
        for (row, above) in rows.iter().zip(&rows[1..]) {
            for i in 0..above.len() {
                shapes.push(Shape::Triangle([row[i], row[i + 1], above[i]]));
                if i + 1 < above.len() {
                    shapes.push(Shape::Triangle([row[i + 1], above[i + 1], above[i]]));
                }
            }
        }
        shapes
    }

    /// Vertex `i` steps from a towards b and `j` towards c.
    fn in_triangle(&mut self, [a, b, c]: [u32; 3], i: usize, j: usize) -> u32 {
        let n = self.n;
        if j == 0 {
            self.on_edge(a, b, i)
        } else if i == 0 {
            self.on_edge(a, c, j)
        } else if i + j == n {
            self.on_edge(b, c, j)
        } else {
            let part = |k: usize| k as f64 / n as f64;
            let weights = [part(n - i - j), part(i), part(j), 0.0];
            self.mesh.add(Recipe { parents: [a, b, c, 0], weights })
        }
    }

    /// Rows of vertices run along a → b, and follow each other along a → d.
    fn quad(&mut self, corners: [u32; 4]) -> Vec<Shape> {
        let n = self.n;
        let rows: Vec<Vec<u32>> =
            (0..=n).map(|j| (0..=n).map(|i| self.in_quad(corners, i, j)).collect()).collect();
        let mut shapes = Vec::with_capacity(n * n);
        for (row, above) in rows.iter().zip(&rows[1..]) {
            for (low, high) in row.windows(2).zip(above.windows(2)) {
                shapes.push(Shape::Quad([low[0], low[1], high[1], high[0]]));
            }
        }
        shapes
    }

    /// Vertex `i` steps along ab and `j` along ad.
    fn in_quad(&mut self, [a, b, c, d]: [u32; 4], i: usize, j: usize) -> u32 {
        let n = self.n;
        match (i, j) {
            (_, 0) => self.on_edge(a, b, i),
            (_, j) if j == n => self.on_edge(d, c, i),
            (0, _) => self.on_edge(a, d, j),
            (i, _) if i == n => self.on_edge(b, c, j),
            _ => {
                let (s, t) = (i as f64 / n as f64, j as f64 / n as f64);
                let weights = [(1.0 - s) * (1.0 - t), s * (1.0 - t), s * t, (1.0 - s) * t];
                self.mesh.add(Recipe { parents: [a, b, c, d], weights })
            }
        }
    }

    fn line(&mut self, line: &Polyline) -> Polyline {
        let mut corners = Vec::with_capacity(line.corners.len() * self.n);
        for (a, b) in line.edges() {
            corners.extend((0..self.n).map(|k| self.on_edge(a, b, k)));
        }
        if !line.is_closed {
            corners.extend(line.corners.last());
        }
        Polyline { corners, ..*line }
    }
}
