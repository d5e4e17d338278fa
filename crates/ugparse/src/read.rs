//! Reading for programs that move or draw faces: bent faces become triangles, and round ones
//! polygons.

use std::ops::Range;

use glam::DVec3;
use ugscene::{Face, Scene, VertexId};

use crate::{Diagnostic, Diagnostics, Options, Parsed, Source};

/// Reads a scene and cuts bent faces ([`Parsed::bent`]) into their triangles, since their shape
/// would depend on the side they are seen from. The triangles keep all properties of the face,
/// including its name. So do the polygons of round faces, see [`Parsed::cut_rounds`], unless
/// `options` keeps them.
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
    if !options.keeps_rounds {
        let eye = parsed.scene.camera().and_then(|camera| camera.eye);
        parsed.cut_rounds(source, eye)?;
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
        let Self { scene, origins, .. } = self;
        let Some(first) = scene.faces.iter().find(|face| face.shape.is_round()) else {
            return Ok(());
        };
        let span = origins.face(first).unwrap_or_default();
        let n_vertices = scene.vertices.len();
        ugscene::cut_rounds_at_rest(scene, eye).map_err(|error| {
            let finding = Diagnostic::error(span, error.to_string()).label("the first of them");
            Diagnostics::one(source, finding.help("split the scene"))
        })?;
        origins.vertices.resize(n_vertices, span);
        origins.vertices.resize(scene.vertices.len(), span);
        Ok(())
    }
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
