//! Generates the Utah teapot as a scene.

mod patches;

use crate::short::ShortPoint;
use glam::DVec3;
use patches::{Part, Patch};
use std::collections::BTreeMap;
use std::io::{self, Write};

/// Writes the teapot with `squares` × `squares` squares per patch.
pub fn write(out: &mut impl Write, squares: u32) -> io::Result<()> {
    writeln!(
        out,
        "{{ The Utah teapot: Martin Newell's 32 Bezier patches (1975, public data), {squares} x {squares} squares each.

    uglorentz -in -vel .95 0 0 < teapot.ug | ugrainbow > teapot.png

  turns the spout away and the handle toward you, though the pot flies spout first.
  z is up, the spout points along +x; faces run counterclockwise seen from outside; vertices
  carry the normals of the patches, so that it is shaded smooth.
  Made by `cargo xtask teapot --squares {squares}`. CC0 1.0.
}}
c 0.95 35 0.55 ;"
    )?;
    for part in patches::parts() {
        let mesh = Mesh::of(&part, squares);
        let initial = part.name.chars().next().unwrap_or('v');
        writeln!(out, "{{ {} }}", part.name)?;
        for (i, (point, normal)) in (0..).zip(&mesh.vertices) {
            writeln!(out, "v {initial}{i} {} {} ;", ShortPoint(*point), Coarse(*normal))?;
        }
        for [a, b, c] in &mesh.triangles {
            writeln!(out, "f ({initial}{a} {initial}{b} {initial}{c}) ;")?;
        }
    }
    writeln!(
        out,
        "l 0.3 ;
l sun 0.7 -0.2 -0.8 0.7 ;
cam -ep 0 -12 4.5 -vc 0.2 0 1.5 -ud 0 0 1 -ps -va 38 29 ;"
    )
}

/// Displays a normal rounded to thousandths, which is precise enough for shading.
struct Coarse(DVec3);

impl std::fmt::Display for Coarse {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self(normal) = *self;
        ShortPoint((normal * 1000.0).round() / 1000.0).fmt(f)
    }
}

/// The triangles of one part; patches share the vertices of their common edges.
#[derive(Default)]
struct Mesh {
    /// Points with unit normals.
    vertices: Vec<(DVec3, DVec3)>,
    triangles: Vec<[usize; 3]>,
}

impl Mesh {
    fn of(part: &Part, squares: u32) -> Self {
        let mut mesh = Self::default();
        let mut known = BTreeMap::new();
        for patch in &part.patches {
            mesh.add(patch, squares, &mut known);
        }
        for (_, normal) in &mut mesh.vertices {
            *normal = normal.normalize();
        }
        mesh
    }

    fn add(&mut self, patch: &Patch, squares: u32, known: &mut BTreeMap<[i64; 3], usize>) {
        let parameter = |i: u32| f64::from(i) / f64::from(squares);
        let mut corner = |i: u32, j: u32| self.vertex(patch, parameter(i), parameter(j), known);
        let mut triangles = Vec::new();
        for i in 0..squares {
            for j in 0..squares {
                let [a, b, c, d] = [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
                triangles.extend([[a, d, c], [a, c, b]]);
            }
        }
        // If an edge of a patch is a single point (the tip of the lid), half of its triangles are
        // degenerate.
        self.triangles.extend(triangles.into_iter().filter(|[a, b, c]| a != b && b != c && c != a));
    }

    fn vertex(&mut self, patch: &Patch, s: f64, t: f64, known: &mut BTreeMap<[i64; 3], usize>) -> usize {
        let point = on_patch(patch, s, t);
        let key = (point * 1e6).round().to_array().map(|coordinate| coordinate as i64);
        let idx = *known.entry(key).or_insert(self.vertices.len());
        if idx == self.vertices.len() {
            self.vertices.push((point, DVec3::ZERO));
        }
        self.vertices[idx].1 += normal(patch, s, t);
        idx
    }
}

/// The unit normal. Where an edge of the patch is a single point, the tangent plane exists only as
/// a limit, so the derivatives are taken a step inside.
fn normal(patch: &Patch, s: f64, t: f64) -> DVec3 {
    const STEP: f64 = 1e-4;
    let (s, t) = (s.clamp(STEP, 1.0 - STEP), t.clamp(STEP, 1.0 - STEP));
    let along_s = on_patch(patch, s + STEP, t) - on_patch(patch, s - STEP, t);
    let along_t = on_patch(patch, s, t + STEP) - on_patch(patch, s, t - STEP);
    along_t.cross(along_s).normalize()
}

fn on_patch(patch: &Patch, s: f64, t: f64) -> DVec3 {
    on_curve(patch.map(|row| on_curve(row, t)), s)
}

/// De Casteljau's algorithm.
fn on_curve([a, b, c, d]: [DVec3; 4], t: f64) -> DVec3 {
    let (ab, bc, cd) = (a.lerp(b, t), b.lerp(c, t), c.lerp(d, t));
    ab.lerp(bc, t).lerp(bc.lerp(cd, t), t)
}

#[cfg(test)]
mod tests {
    use super::{Mesh, patches};

    /// 32 patches, without the degenerate triangles at the lid's tip and the foot's centre.
    #[test]
    fn number_of_triangles() {
        let squares = 4;
        let parts = patches::parts();
        assert_eq!(parts.iter().map(|part| part.patches.len()).sum::<usize>(), 32);
        let n: usize = parts.iter().map(|part| Mesh::of(part, squares).triangles.len()).sum();
        assert_eq!(n, 32 * 16 * 2 - 8 * 4);
    }

    /// The body is a bowl around the z axis: all of it except the inner side of its rim faces away
    /// from the axis.
    #[test]
    fn faces_point_outward() {
        for part in patches::parts() {
            let mesh = Mesh::of(&part, 6);
            for &[a, b, c] in &mesh.triangles {
                let [a, b, c] = [a, b, c].map(|i| mesh.vertices[i]);
                let face = (b.0 - a.0).cross(c.0 - a.0);
                assert!(
                    face.dot(a.1 + b.1 + c.1) > 0.0,
                    "{}: the orientation of a face contradicts its normals",
                    part.name
                );
            }
        }
        let body = Mesh::of(&patches::parts()[0], 6);
        for (point, normal) in &body.vertices {
            let below_rim = point.z < 2.3;
            let outward = point.with_z(point.z - 1.0).dot(*normal) > 0.0;
            assert!(!below_rim || outward, "at {point}");
        }
    }
}
