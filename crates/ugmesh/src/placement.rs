//! Placing a mesh: up axis, scale and centre.

use glam::DVec3;
use ugscene::Scene;

use crate::{Axis, Error};

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

/// Rotates the axis `up` to z, by a cyclic permutation of the axes or by a quarter turn about x.
/// Both are exact.
pub(crate) fn to_z_up(up: Axis, p: DVec3) -> DVec3 {
    match up {
        Axis::X => DVec3::new(p.y, p.z, p.x),
        // Not `-p.z`, which would give −0 for 0.
        Axis::Y => DVec3::new(p.x, 0.0 - p.z, p.y),
        Axis::Z => p,
    }
}

/// The inverse of [`to_z_up`].
pub(crate) fn from_z_up(up: Axis, p: DVec3) -> DVec3 {
    match up {
        Axis::X => DVec3::new(p.z, p.x, p.y),
        Axis::Y => DVec3::new(p.x, p.z, 0.0 - p.y),
        Axis::Z => p,
    }
}

/// Rotates all vertices, their normals, and cameras.
pub(crate) fn rotate(scene: &mut Scene, rotation: impl Fn(DVec3) -> DVec3) {
    for vertex in &mut scene.vertices {
        vertex.position = rotation(vertex.position);
        vertex.normal = vertex.normal.map(&rotation);
    }
    for camera in &mut scene.cameras {
        for vector in [&mut camera.eye, &mut camera.center, &mut camera.up].into_iter().flatten() {
            *vector = rotation(*vector);
        }
    }
}

/// Moves the centre of the mesh's bounding box to the origin if `is_centered`, then scales the mesh
/// about the origin.
pub(crate) fn scale_and_center(scene: &mut Scene, size: Size, is_centered: bool) -> Result<(), Error> {
    let Some((low, high)) = scene.bounds() else { return Ok(()) };
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
    if scene.vertices.iter().all(|vertex| vertex.position.is_finite()) {
        Ok(())
    } else {
        Err(Error::Overflow)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn up_is_a_rotation() {
        let p = DVec3::new(0.1, -0.2, 0.3);
        for (up, axis) in [(Axis::X, DVec3::X), (Axis::Y, DVec3::Y), (Axis::Z, DVec3::Z)] {
            assert_eq!(to_z_up(up, axis), DVec3::Z);
            assert_eq!(from_z_up(up, to_z_up(up, p)), p);
            let [x, y, z] = DVec3::AXES.map(|axis| to_z_up(up, axis));
            assert_eq!(x.cross(y), z, "{up:?} is no mirror");
        }
        assert!(to_z_up(Axis::Y, DVec3::ZERO).y.is_sign_positive());
    }
}
