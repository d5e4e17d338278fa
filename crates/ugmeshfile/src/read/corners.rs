//! Corners of faces with normals and texture coordinates of their own.

use glam::DVec3;
use rustc_hash::FxHashMap;
use ugscene::VertexId;

use crate::builder::Builder;
use crate::error::Problem;

/// The bits of a normal and of texture coordinates, by which equal ones with different indices are
/// identified.
type CornerBits = (Option<[u64; 3]>, Option<[u32; 2]>);

/// Splits a vertex with several normals or texture coordinates into several vertices. The vertex of
/// the file gets the first of them, so that vertices keep their order; the copies are appended at
/// the end.
pub(super) struct CornerSplitter {
    first: Vec<Option<CornerBits>>,
    copies: FxHashMap<(VertexId, CornerBits), VertexId>,
}

impl CornerSplitter {
    pub fn new(n_vertices: usize) -> Self {
        Self { first: vec![None; n_vertices], copies: FxHashMap::default() }
    }

    /// The vertex with these at the position of `vertex`.
    pub fn vertex(
        &mut self,
        builder: &mut Builder,
        vertex: VertexId,
        normal: Option<DVec3>,
        uv: Option<[f32; 2]>,
    ) -> Result<VertexId, Problem> {
        let bits =
            (normal.map(|n| n.to_array().map(f64::to_bits)), uv.map(|uv| uv.map(f32::to_bits)));
        let first = self.first[vertex.index()].get_or_insert_with(|| {
            builder.set_normal(vertex, normal);
            builder.set_uv(vertex, uv);
            bits
        });
        if *first == bits {
            return Ok(vertex);
        }
        if let Some(&copy) = self.copies.get(&(vertex, bits)) {
            return Ok(copy);
        }
        let copy = builder.copy(vertex, normal, uv)?;
        self.copies.insert((vertex, bits), copy);
        Ok(copy)
    }
}
