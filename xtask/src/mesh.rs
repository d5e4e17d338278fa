//! A bumpy sphere of any number of triangles, for benchmarks and counts of instructions.

use std::f64::consts::{PI, TAU};
use std::fmt::{Error, Write as _};

use glam::DVec3;

/// r = 1 + 0.1 sin 7θ cos 5φ.
pub struct Mesh {
    pub positions: Vec<DVec3>,
    /// Counterclockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    n_columns: u32,
}

impl Mesh {
    /// A mesh of about this number of triangles.
    pub fn of_triangles(triangles: u32) -> Self {
        Self::of_rows((f64::from(triangles) / 4.0).sqrt().round() as u32)
    }

    /// A mesh of n rows from pole to pole and 2n columns, with 4n(n − 1) triangles.
    pub fn of_rows(n: u32) -> Self {
        let n_columns = 2 * n;
        let position = |i: u32, j: u32| {
            let (theta, phi) =
                (PI * f64::from(i) / f64::from(n), TAU * f64::from(j) / f64::from(n_columns));
            let radius = 1.0 + 0.1 * libm::sin(7.0 * theta) * libm::cos(5.0 * phi);
            let [x, y] = [libm::cos(phi), libm::sin(phi)].map(|part| libm::sin(theta) * part);
            radius * DVec3::new(x, y, libm::cos(theta))
        };
        let cell = |i: u32, j: u32| {
            let at = |row: u32, column: u32| row * n_columns + column % n_columns;
            let south = (i + 1 < n).then(|| [at(i, j), at(i + 1, j), at(i + 1, j + 1)]);
            let north = (i > 0).then(|| [at(i, j), at(i + 1, j + 1), at(i, j + 1)]);
            south.into_iter().chain(north)
        };
        let grid = |n_rows: u32| (0..n_rows).flat_map(move |i| (0..n_columns).map(move |j| (i, j)));
        Self {
            positions: grid(n + 1).map(|(i, j)| position(i, j)).collect(),
            triangles: grid(n).flat_map(|(i, j)| cell(i, j)).collect(),
            n_columns,
        }
    }

    /// As a scene with two lamps. Its faces have 36 colours, so that several meet at most vertices;
    /// or every vertex has a colour of its own.
    pub fn scene(&self, has_own_colors: bool) -> Result<String, Error> {
        let mut text = String::from(
            "{ A bumpy sphere, to measure speed on. CC0 1.0. }\n\
             l lamp 1 3 3 3 0 ;\nl sun .7 1 1 1 ;\n",
        );
        let n_colors = if has_own_colors { self.positions.len() } else { 36 };
        for k in 0..n_colors {
            let [red, green] = [k % 6, k / 6 % 6].map(|step| 0.2 + 0.16 * step as f64);
            let blue = 0.5 + 0.5 * (k / 36 * 36) as f64 / n_colors as f64;
            writeln!(text, "c_rgb k{k} {red:.2} {green:.2} {blue:.6} ;")?;
        }
        for (k, DVec3 { x, y, z }) in self.positions.iter().enumerate() {
            let color = if has_own_colors { format!("k{k}") } else { String::new() };
            writeln!(text, "v v{k} {x:.6} {y:.6} {z:.6} {color};")?;
        }
        for [a, b, c] in &self.triangles {
            let (row, column) = (a / self.n_columns, a % self.n_columns);
            let color =
                if has_own_colors { String::new() } else { format!("k{}", (row + column) % 36) };
            writeln!(text, "f (v{a} v{b} v{c}) {color};")?;
        }
        Ok(text)
    }
}

#[cfg(test)]
mod tests {
    use super::Mesh;
    use std::collections::BTreeSet;

    /// Every edge of a closed surface is used once in each direction.
    #[test]
    fn closed() {
        let mesh = Mesh::of_rows(6);
        assert_eq!(mesh.triangles.len(), 4 * 6 * 5);
        let last = mesh.positions.len() as u32 - 12;
        // The vertices of a pole are one.
        let vertex = |row: u32| if row < 12 { 0 } else { row.min(last) };
        let sides =
            |[a, b, c]: [u32; 3]| [(a, b), (b, c), (c, a)].map(|(a, b)| (vertex(a), vertex(b)));
        let edges: BTreeSet<_> =
            mesh.triangles.iter().flat_map(|&triangle| sides(triangle)).collect();
        assert_eq!(edges.len(), 3 * mesh.triangles.len());
        assert!(edges.iter().all(|&(a, b)| edges.contains(&(b, a))));
    }
}
