//! Reading for programs that move or draw faces: bent faces become triangles. Round ones stay, so
//! that every program decides by itself whether it draws them exactly.

use std::ops::Range;

use glam::DVec3;
use ugscene::{Face, Scene, TooManyPolygons, VertexId};

use crate::{Diagnostic, Diagnostics, Options, Parsed, Source, Span};

/// Reads a scene and cuts bent faces ([`Parsed::bent`]) into their triangles, since their shape
/// would depend on the side they are seen from. The triangles keep all properties of the face,
/// including its name. Round faces stay as they are; programs that need polygons cut them, as
/// [`Parsed::cut_rounds`] does.
///
/// `camera`: the name of the camera to use, see [`Parsed::choose_camera`].
///
/// # Errors
/// See [`crate::parse`] and [`Parsed::choose_camera`].
pub fn read(
    source: &Source,
    options: &Options,
    camera: Option<&str>,
) -> Result<Parsed, Diagnostics> {
    let mut parsed = crate::parse(source, options)?;
    if let Some(name) = camera {
        parsed.choose_camera(source, name)?;
    }
    let rows: Vec<usize> = parsed.bent.iter().map(|face| face.row).collect();
    if !rows.is_empty() {
        cut_faces(&mut parsed.scene, &rows);
    }
    Ok(parsed)
}

impl Parsed {
    /// Cuts round faces into polygons that differ from them by up to 0.1 milliradians at the eye,
    /// or without an eye by up to a thousandth of their radius.
    ///
    /// # Errors
    /// There are too many.
    pub fn cut_rounds(&mut self, source: &Source, eye: Option<DVec3>) -> Result<(), Diagnostics> {
        if !self.scene.has_rounds() {
            return Ok(());
        }
        let span = self.first_round();
        let Self { scene, origins, .. } = self;
        let n_vertices = scene.vertices.len();
        let cut = ugscene::cut_rounds_at_rest(scene, eye);
        cut.map_err(|error| too_many_polygons(source, span, error))?;
        origins.vertices.resize(n_vertices, span);
        origins.vertices.resize(scene.vertices.len(), span);
        Ok(())
    }

    /// The place of the first round face in the text.
    pub fn first_round(&self) -> Span {
        let first = self.scene.faces.iter().find(|face| face.shape.is_round());
        first.and_then(|face| self.origins.face(face)).unwrap_or_default()
    }
}

/// The error at the first round face of a text, if all of them would become too many polygons.
pub fn too_many_polygons(source: &Source, first: Span, error: TooManyPolygons) -> Diagnostics {
    let finding = Diagnostic::error(first, error.to_string()).label("the first of them");
    Diagnostics::one(source, finding.help("split the scene"))
}

/// Triangulates the faces of these rows, which are in order, where possible.
fn cut_faces(scene: &mut Scene, rows: &[usize]) {
    for (row, face) in std::mem::take(&mut scene.faces).into_iter().enumerate() {
        let pieces = if rows.binary_search(&row).is_ok() { triangles(scene, &face) } else { None };
        match pieces {
            Some(pieces) => {
                scene.faces.extend(pieces.map(|contours| Face { contours, ..face.clone() }));
            }
            None => scene.faces.push(face),
        }
    }
}

/// The triangles of a face, as contours; `None` if it intersects itself.
fn triangles(scene: &mut Scene, face: &Face) -> Option<impl Iterator<Item = Range<u32>> + use<>> {
    let corners: Vec<VertexId> = scene.face_corners(face).to_vec();
    let triangles =
        ugpolygon::face_triangles(scene, face, |vertex| scene.vertices[vertex.index()].position)?;
    let cut = triangles.iter().map(|triangle| triangle.map(|corner| corners[corner as usize]));
    let rows = scene.contours.push_all(cut);
    Some(rows.map(|row| row..row + 1))
}
