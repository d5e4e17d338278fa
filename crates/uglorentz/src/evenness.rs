//! Faces whose corners look alike: only these are cut without regard to their triangles.

use std::sync::OnceLock;

use ugscene::{Face, Scene};

/// Tells faces whose corners differ in colour or normal.
#[derive(Clone, Debug, Default)]
pub(crate) struct Evenness {
    /// For each vertex, whether colours of several faces are mixed there; empty if nowhere. Found
    /// when the first face is cut.
    is_mixing: OnceLock<Vec<bool>>,
}

impl Evenness {
    /// `is_apart`: downstream, colours of faces are not mixed at their common vertices (`-vr`).
    pub(crate) fn new(is_apart: bool) -> Self {
        Self { is_mixing: if is_apart { Vec::new().into() } else { OnceLock::new() } }
    }

    /// Do all corners of a face have the same colour and normal?
    pub(crate) fn is_even(&self, scene: &Scene, face: &Face) -> bool {
        let corners = scene.face_corners(face);
        let Some(first) = corners.first() else { return true };
        let first = &scene.vertices[first.index()];
        let is_mixing = self.is_mixing.get_or_init(|| ugscene::mixing_vertices(scene));
        corners.iter().all(|corner| {
            let vertex = &scene.vertices[corner.index()];
            let is_mixing = is_mixing.get(corner.index()) == Some(&true);
            !is_mixing && vertex.color == first.color && vertex.normal == first.normal
        })
    }
}
