//! Clipping in depth, before the division by it.

use ugscene::{CameraPoint, Slab};

use crate::planar::clip_edges;

use ugraster::Corner;

/// A corner before projection, with the numbers to interpolate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vertex<const N: usize> {
    pub place: CameraPoint,
    pub values: [f64; N],
}

impl<const N: usize> Vertex<N> {
    /// The point between two vertices at depth `z`.
    fn between(inside: &Self, outside: &Self, z: f64) -> Self {
        let (a, b) = (inside.place, outside.place);
        let part = (z - a.z) / (b.z - a.z);
        let mix = |a: f64, b: f64| a + (b - a) * part;
        Self {
            // The depth itself is set, not computed: next to a far point
            // rounding could put it behind the eye.
            place: CameraPoint { x: mix(a.x, b.x), y: mix(a.y, b.y), z },
            values: std::array::from_fn(|i| mix(inside.values[i], outside.values[i])),
        }
    }

    /// The corner in the picture.
    pub fn project(&self, is_perspective: bool) -> Corner<N> {
        let CameraPoint { x, y, z } = self.place;
        if is_perspective {
            let key = 1.0 / z;
            Corner { x: x * key, y: y * key, key, values: self.values.map(|value| value * key) }
        } else {
            Corner { x, y, key: -z, values: self.values }
        }
    }
}

/// Clips a polygon to the slab.
///
/// Where a concave polygon falls apart, the parts stay joined along the plane, forth and back, and
/// the even-odd rule draws nothing there.
pub fn clip_polygon<const N: usize>(
    slab: Slab,
    polygon: &mut Vec<Vertex<N>>,
    scratch: &mut Vec<Vertex<N>>,
) {
    if polygon.iter().all(|vertex| slab.near <= vertex.place.z && vertex.place.z <= slab.far) {
        return;
    }
    clip(polygon, scratch, slab.near, |z| z >= slab.near);
    clip(scratch, polygon, slab.far, |z| z <= slab.far);
}

/// The part of a line segment inside the slab.
pub fn clip_segment<const N: usize>(
    slab: Slab,
    mut ends: [Vertex<N>; 2],
) -> Option<[Vertex<N>; 2]> {
    let planes: [(f64, &dyn Fn(f64) -> bool); 2] =
        [(slab.near, &|z| z >= slab.near), (slab.far, &|z| z <= slab.far)];
    for (z, is_inside) in planes {
        let [a, b] = ends;
        ends = match (is_inside(a.place.z), is_inside(b.place.z)) {
            (true, true) => [a, b],
            (true, false) => [a, Vertex::between(&a, &b, z)],
            (false, true) => [Vertex::between(&b, &a, z), b],
            (false, false) => return None,
        };
    }
    Some(ends)
}

/// Clips `polygon` by one plane into `kept`.
fn clip<const N: usize>(
    polygon: &[Vertex<N>],
    kept: &mut Vec<Vertex<N>>,
    z: f64,
    is_inside: impl Fn(f64) -> bool,
) {
    kept.clear();
    let before = polygon.last().into_iter().chain(polygon).copied();
    let is_inside = |vertex: &Vertex<N>| is_inside(vertex.place.z);
    let crossing = |inside: &Vertex<N>, outside: &Vertex<N>| Vertex::between(inside, outside, z);
    clip_edges(before.zip(polygon.iter().copied()), is_inside, crossing, kept);
}

#[cfg(test)]
mod tests {
    use super::*;

    const SLAB: Slab = Slab { near: 1.0, far: 5.0 };

    fn at(x: f64, z: f64) -> Vertex<1> {
        Vertex { place: CameraPoint { x, y: 0.0, z }, values: [10.0 * x] }
    }

    #[test]
    fn polygons_are_cut() {
        #[track_caller]
        fn check(polygon: &[(f64, f64)], expected: &[(f64, f64)]) {
            let mut polygon: Vec<_> = polygon.iter().map(|&(x, z)| at(x, z)).collect();
            clip_polygon(SLAB, &mut polygon, &mut Vec::new());
            let expected: Vec<_> = expected.iter().map(|&(x, z)| at(x, z)).collect();
            assert_eq!(polygon, expected);
        }
        check(&[(0.0, 2.0), (1.0, 3.0), (0.0, 4.0)], &[(0.0, 2.0), (1.0, 3.0), (0.0, 4.0)]);
        check(&[(0.0, 1.0), (1.0, 5.0), (0.0, 3.0)], &[(0.0, 1.0), (1.0, 5.0), (0.0, 3.0)]);
        check(&[(0.0, 0.0), (1.0, -3.0), (0.0, 0.5)], &[]);
        check(&[(0.0, 6.0), (1.0, 7.0), (0.0, 8.0)], &[]);
        // From 0 to 2 deep the plane is met half way.
        check(
            &[(0.0, 0.0), (4.0, 2.0), (4.0, 4.0)],
            &[(1.0, 1.0), (2.0, 1.0), (4.0, 2.0), (4.0, 4.0)],
        );
        check(&[], &[]);
    }

    #[test]
    fn a_shared_edge_is_cut_at_one_point() {
        let (a, b) = (at(0.1, -0.3), at(0.7, 3.1));
        let others = [at(-2.0, 2.0), at(5.0, 0.2)];
        let [one, other] = [[a, b, others[0]], [b, a, others[1]]].map(|face| {
            let mut face = face.to_vec();
            clip_polygon(SLAB, &mut face, &mut Vec::new());
            face
        });
        let cut = clip_segment(SLAB, [a, b]).unwrap()[0];
        assert!(one.contains(&cut) && other.contains(&cut));
        assert_eq!(cut, clip_segment(SLAB, [b, a]).unwrap()[1]);
    }

    #[test]
    fn segments_are_cut() {
        let rows = [
            ((0.0, 2.0), (1.0, 3.0), Some(((0.0, 2.0), (1.0, 3.0)))),
            ((0.0, 0.0), (4.0, 4.0), Some(((1.0, 1.0), (4.0, 4.0)))),
            ((0.0, 0.0), (8.0, 8.0), Some(((1.0, 1.0), (5.0, 5.0)))),
            ((8.0, 8.0), (0.0, 0.0), Some(((5.0, 5.0), (1.0, 1.0)))),
            ((0.0, 0.0), (4.0, 0.5), None),
            ((0.0, 6.0), (4.0, 7.0), None),
        ];
        for (a, b, expected) in rows {
            let kept = clip_segment(SLAB, [at(a.0, a.1), at(b.0, b.1)]);
            assert_eq!(kept, expected.map(|(a, b)| [at(a.0, a.1), at(b.0, b.1)]));
        }
    }

    #[test]
    fn a_cut_lies_in_front_of_the_eye_however_far_the_other_end() {
        let slab = Slab { near: 1e-6, far: f64::INFINITY };
        let [a, _] = clip_segment(slab, [at(0.0, -1e12), at(1.0, 1.0)]).unwrap();
        assert_eq!(a.place.z, 1e-6);
        assert!(a.project(true).key > 0.0);
    }
}
