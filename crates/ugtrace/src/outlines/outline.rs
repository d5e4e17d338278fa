//! Whether a ray passes through a face.

use glam::DVec3;
use ugscene::{closed, unit_normal};

/// Direction of the half plane that begins at a ray. Arbitrary, but unlikely to be parallel to a
/// ray or an edge.
const SIDEWAYS: DVec3 = DVec3::new(0.436_812_907_331, 0.617_203_411_907, 0.654_371_083_561);

/// A face counts as edge-on if the eye is closer to its plane than this part of the size of the
/// face.
const EDGE_ON: f64 = 1e-12;

/// The outline of a face at rest, holes included.
#[derive(Clone, Debug)]
pub struct Outline {
    /// The edges of all contours.
    pub edges: Box<[Edge]>,
    /// The plane of the face: its points p fulfil p·plane = 1. The dot product with a ray is its
    /// depth key.
    pub plane: DVec3,
}

/// An edge. The order of its ends depends only on their positions.
#[derive(Clone, Copy, Debug)]
pub struct Edge {
    /// The ends, relative to the eye.
    pub ends: [DVec3; 2],
    /// Normal of the plane through the eye and the edge.
    pub normal: DVec3,
}

impl Edge {
    fn new(a: DVec3, b: DVec3) -> Self {
        let [a, b] = if a.to_array() <= b.to_array() { [a, b] } else { [b, a] };
        // Not a × b: that loses digits if both are long and nearly parallel.
        Self { ends: [a, b], normal: a.cross(b - a) }
    }
}

impl Outline {
    /// `contours`: corners at rest, relative to the eye; the first contour defines the plane.
    /// `None` if the face has no area or is seen edge-on.
    pub fn new(contours: &[Vec<DVec3>]) -> Option<Self> {
        let first = contours.first()?;
        let normal = unit_normal(first.iter().copied());
        if normal == DVec3::ZERO {
            return None;
        }
        let middle = first.iter().sum::<DVec3>() / first.len() as f64;
        // Closer to edge-on, the distance of the plane would be rounding noise.
        let farthest = first.iter().map(|corner| corner.length()).fold(0.0, f64::max);
        if normal.dot(middle).abs() <= EDGE_ON * farthest {
            return None;
        }
        let plane = normal / normal.dot(middle);
        let edges =
            contours.iter().flat_map(|contour| closed(contour)).map(|[a, b]| Edge::new(a, b));
        plane.is_finite().then(|| Self { edges: edges.collect(), plane })
    }

    /// The inverse of the ray parameter at the plane; 0 or less if the plane is not ahead. `ray`: a
    /// vector at rest.
    #[inline]
    pub fn key(&self, ray: DVec3) -> f64 {
        self.plane.dot(ray)
    }

    /// True if a ray passes through the face; the plane must be ahead of it.
    ///
    /// A face is seen within less than half of all directions, and the direction opposite to the
    /// ray is not among them. So the half plane from the ray sideways ends outside the face, and
    /// the parity of its crossings with the outline decides.
    #[inline]
    pub fn contains(&self, ray: DVec3) -> bool {
        let half_plane = ray.cross(SIDEWAYS);
        self.edges.iter().fold(false, |is_inside, edge| {
            let [a, b] = edge.ends.map(|end| half_plane.dot(end) < 0.0);
            is_inside ^ (a != b && (edge.normal.dot(ray) < 0.0) == a)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(half: f64, z: f64) -> Vec<DVec3> {
        [(-half, -half), (half, -half), (half, half), (-half, half)]
            .map(|(x, y)| DVec3::new(x, y, z))
            .to_vec()
    }

    #[test]
    fn a_hole_is_a_hole_and_what_is_behind_is_not_ahead() {
        let face = Outline::new(&[square(2.0, 4.0), square(1.0, 4.0)]).unwrap();
        let sees = |x: f64| {
            let ray = DVec3::new(x / 4.0, 0.03, 1.0);
            face.key(ray) > 0.0 && face.contains(ray)
        };
        assert_eq!([0.0, 0.9, 1.1, 1.9, 2.1].map(sees), [false, false, true, true, false]);
        assert_eq!(face.key(DVec3::new(0.3, 0.0, 1.0)), 0.25);
        assert!(face.key(DVec3::new(0.0, 0.0, -1.0)) < 0.0);
    }

    #[test]
    fn what_is_edge_on_or_has_no_area_is_nothing() {
        let edge_on = [(0.0, 1.0), (0.0, 2.0), (1.0, 2.0)].map(|(y, z)| DVec3::new(0.0, y, z));
        let line = [1.0, 2.0, 3.0].map(|x| DVec3::new(x, 1.0, 1.0));
        assert!(Outline::new(&[edge_on.to_vec()]).is_none());
        assert!(Outline::new(&[line.to_vec()]).is_none());
    }

    /// A fan of triangles around a point has no gap, however close a ray is to its edges and its
    /// centre.
    #[test]
    fn faces_that_share_edges_leave_no_gap() {
        let middle = DVec3::new(0.1, -0.2, 3.0);
        let rim: Vec<DVec3> = (0..7)
            .map(|i| {
                let angle = f64::from(i) * std::f64::consts::TAU / 7.0;
                DVec3::new(libm::cos(angle), libm::sin(angle), 3.0 + 0.2 * f64::from(i % 3))
            })
            .collect();
        let faces: Vec<Outline> = (0..7)
            .map(|i| Outline::new(&[vec![middle, rim[i], rim[(i + 1) % 7]]]).unwrap())
            .collect();
        for (i, corner) in rim.iter().enumerate() {
            for part in [0.0, 1e-17, 1e-16, 1e-3, 0.3, 0.99] {
                let on_edge = middle + part * (*corner - middle);
                for dx in [-2e-16, -1e-16, 0.0, 1e-16] {
                    let ray = on_edge * (1.0 / 3.0) + DVec3::new(dx, 0.0, 0.0);
                    let n_faces = faces.iter().filter(|face| face.contains(ray)).count();
                    assert_eq!(n_faces % 2, 1, "edge {i} at {part}, {dx}: {n_faces}");
                }
            }
        }
    }
}
