//! The mesh of a globe: one vertex at each pole, rings of vertices between, and the cells that
//! connect them.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

/// A division of the sphere into bands from pole to pole and sectors of longitude.
pub struct Globe {
    pub bands: u32,
    pub sectors: u32,
}

/// A direction by colatitude and longitude, in radians.
#[derive(Clone, Copy)]
pub struct Direction {
    pub theta: f64,
    pub phi: f64,
}

impl Direction {
    /// The unit vector in this direction.
    pub fn unit(self) -> DVec3 {
        let (sin_theta, cos_theta) = libm::sincos(self.theta);
        let (sin_phi, cos_phi) = libm::sincos(self.phi);
        DVec3::new(sin_theta * cos_phi, sin_theta * sin_phi, cos_theta)
    }
}

impl Globe {
    /// Twice as many sectors as bands, so that cells at the equator are about square.
    pub fn with_bands(bands: u32) -> Self {
        Self { bands, sectors: 2 * bands }
    }

    /// The directions of all vertices by index: the north pole, the rings southward, the south
    /// pole.
    pub fn directions(&self) -> impl Iterator<Item = Direction> {
        let ring = move |i: u32| {
            let theta = PI * f64::from(i) / f64::from(self.bands);
            (0..self.sectors)
                .map(move |j| Direction { theta, phi: TAU * f64::from(j) / f64::from(self.sectors) })
        };
        let north = Direction { theta: 0.0, phi: 0.0 };
        let south = Direction { theta: PI, phi: 0.0 };
        std::iter::once(north).chain((1..self.bands).flat_map(ring)).chain([south])
    }

    /// The cells of one band, counterclockwise seen from outside: triangles at
    /// the poles, quadrilaterals elsewhere.
    pub fn cells(&self, band: u32) -> impl Iterator<Item = Vec<u32>> {
        (0..self.sectors).map(move |j| {
            let k = (j + 1) % self.sectors;
            let corners = [
                self.vertex(band, j),
                self.vertex(band + 1, j),
                self.vertex(band + 1, k),
                self.vertex(band, k),
            ];
            let mut cell = corners.to_vec();
            cell.dedup();
            // At the north pole the first and the last corner are one vertex.
            if cell.first() == cell.last() {
                cell.pop();
            }
            cell
        })
    }

    fn vertex(&self, ring: u32, sector: u32) -> u32 {
        match ring {
            0 => 0,
            r if r == self.bands => 1 + self.sectors * (self.bands - 1),
            r => 1 + self.sectors * (r - 1) + sector,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Globe;
    use std::collections::BTreeMap;

    /// A closed surface uses every edge once in each direction, and V − E + F = 2.
    #[test]
    fn closed() {
        let globe = Globe::with_bands(6);
        let mut edges = BTreeMap::new();
        let mut n_faces = 0;
        for cell in (0..globe.bands).flat_map(|band| globe.cells(band)) {
            n_faces += 1;
            for (i, &from) in cell.iter().enumerate() {
                *edges.entry((from, cell[(i + 1) % cell.len()])).or_insert(0) += 1;
            }
        }
        for (&(from, to), &count) in &edges {
            assert_eq!((count, edges.get(&(to, from))), (1, Some(&1)), "edge {from}-{to}");
        }
        assert_eq!(globe.directions().count() + n_faces, edges.len() / 2 + 2);
    }
}
