//! Placing a mesh: up axis, scale and centre.

use glam::DVec3;
use ugscene::{Beam, LightKind, Scene};

use crate::Error;

/// How a mesh is scaled.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Size {
    /// Not at all.
    #[default]
    Same,
    /// By this factor.
    Times(f64),
    /// So that the longest side of its bounding box has this length.
    Fit(f64),
}

/// Moves the centre of the bounding box of the faces to the origin if `is_centered`, then scales
/// the mesh about the origin. Wires count as well if `has_wires`: meshes are written without them.
pub(crate) fn scale_and_center(
    scene: &mut Scene,
    size: Size,
    is_centered: bool,
    has_wires: bool,
) -> Result<(), Error> {
    let corners = scene.faces.iter().flat_map(|face| scene.face_corners(face));
    let places = corners.map(|corner| scene.vertices[corner.index()].position);
    let faces = places
        .map(|place| (place, place))
        .reduce(|(low, high), (place, _)| (low.min(place), high.max(place)));
    let all = if has_wires { scene.bounds() } else { None };
    let Some((low, high)) = all.or(faces) else { return Ok(()) };
    // Halved before adding, since the sum of two large numbers may overflow.
    let middle = if is_centered { 0.5 * low + 0.5 * high } else { DVec3::ZERO };
    let longest = (high - low).max_element();
    let scale = match size {
        Size::Same => 1.0,
        Size::Times(scale) => scale,
        Size::Fit(_) if longest == 0.0 => 1.0,
        Size::Fit(length) => length / longest,
    };
    if scale == 0.0 {
        // The size of the bounding box overflowed.
        return Err(Error::Overflow);
    }
    if middle == DVec3::ZERO && scale == 1.0 {
        return Ok(());
    }
    for vertex in &mut scene.vertices {
        vertex.position = (vertex.position - middle) * scale + DVec3::ZERO;
    }
    for camera in &mut scene.cameras {
        for point in [&mut camera.eye, &mut camera.center].into_iter().flatten() {
            *point = (*point - middle) * scale + DVec3::ZERO;
        }
        camera.film_size = camera.film_size.map(|sides| sides.map(|side| side * scale));
    }
    for light in &mut scene.lights {
        if let LightKind::Local { position, radius, reference, beam } = &mut light.kind {
            *position = (*position - middle) * scale + DVec3::ZERO;
            *radius *= scale;
            *reference = reference.map(|reference| reference * scale);
            if let Beam::Area(edges) = beam {
                *edges = edges.map(|edge| edge * scale);
            }
        }
    }
    let is_lamp_valid = |kind: LightKind| match kind {
        LightKind::Local { position, reference, beam, .. } => {
            let is_away = reference.is_none_or(|it| it > 0.0 && it.is_finite());
            position.is_finite() && is_away && beam.is_valid()
        }
        LightKind::Ambient | LightKind::Directional(_) => true,
    };
    let is_placed = scene.vertices.iter().all(|vertex| vertex.position.is_finite())
        && scene.lights.iter().all(|light| is_lamp_valid(light.kind));
    if is_placed { Ok(()) } else { Err(Error::Overflow) }
}
