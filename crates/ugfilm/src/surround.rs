//! What players of 360° films are told of a film.

use glam::DVec3;
use ugpipe::{Failure, Words};
use ugscene::{CameraOptions, Scene, View};
use ugsheet::film::{Eyes, FilmProjection, Surround, SurroundMesh};
use ugtrace::lens::{Film, Lens};

use crate::pipe::Pipe;

/// Degrees between the rings of the mesh of a fisheye.
const RING: f64 = 4.0;

/// Vertices of a ring.
const N_AROUND: u32 = 64;

/// What players are told of the pictures of a pipe. `None` for a plain film, and if annotations are
/// in it, or it is a part of a picture.
///
/// # Errors
/// The lens has no directions.
pub fn surround(pipe: &Pipe) -> Result<Option<Surround>, Failure> {
    let Some(program) = pipe.programs().last() else { return Ok(None) };
    let (lens, is_stereo) = program.lens();
    let is_plain = lens == Lens::Pinhole && !is_stereo;
    if is_plain || program.crop().is_some() || pipe.picture.annotations.is_any() {
        return Ok(None);
    }
    let projection = match lens {
        Lens::Pinhole => FilmProjection::Flat,
        Lens::Panorama => FilmProjection::Equirectangular,
        Lens::Fisheye { .. } | Lens::Cube => {
            // Eyes have half of the width each.
            let [width, height] = pipe.picture.size;
            let size = [if is_stereo { width / 2 } else { width }, height];
            FilmProjection::Mesh(mesh(lens, size).map_err(|error| Failure::failed(error.words()))?)
        }
    };
    let eyes = match (is_stereo, lens) {
        (false, _) => Eyes::One,
        (true, Lens::Panorama) => Eyes::TopBottom,
        (true, _) => Eyes::LeftRight,
    };
    Ok(Some(Surround { projection, eyes, source: env!("CARGO_PKG_NAME") }))
}

/// A mesh that shows the picture of one eye. `size`: of this picture.
fn mesh(lens: Lens, size: [u32; 2]) -> Result<SurroundMesh, ugscene::CameraError> {
    let camera = CameraOptions {
        eye: Some(DVec3::ZERO),
        center: Some(DVec3::NEG_Z),
        up: Some(DVec3::Y),
        ..CameraOptions::default()
    };
    let [across, down] = lens.frames(false);
    let frame = [size[0] / across, size[1] / down];
    let view = View::new(&Scene::default(), &camera, frame)?;
    let film = Film::new(lens, None, &view, frame);
    let [width, height] = size.map(f64::from);
    let mut mesh = SurroundMesh::default();
    let add = |mesh: &mut SurroundMesh, [x, y]: [f64; 2]| {
        let direction = film.sight([x, y]).map_or(DVec3::ZERO, |sight| sight.direction);
        let [right, up, back] = direction.to_array();
        mesh.vertices.push([right, up, back, x / width, 1.0 - y / height].map(|it| it as f32));
        mesh.vertices.len() as u32 - 1
    };
    // Just inside, since places on an edge belong to another side, or to none.
    const INSIDE: f64 = 1.0 - 1e-9;
    if let Lens::Fisheye { angle } = lens {
        let n_rings = (0.5 * angle.to_degrees() / RING).ceil().max(1.0) as u32;
        let radius = 0.5 * INSIDE * width.min(height);
        let middle = [0.5 * width, 0.5 * height];
        add(&mut mesh, middle);
        for ring in 1..=n_rings {
            let part = radius * f64::from(ring) / f64::from(n_rings);
            for step in 0..N_AROUND {
                let (sin, cos) =
                    libm::sincos(core::f64::consts::TAU * f64::from(step) / f64::from(N_AROUND));
                add(&mut mesh, [middle[0] + part * cos, middle[1] - part * sin]);
            }
        }
        let at = |ring: u32, step: u32| match ring {
            0 => 0,
            ring => 1 + (ring - 1) * N_AROUND + step % N_AROUND,
        };
        for (ring, step) in (0..n_rings).flat_map(|ring| (0..N_AROUND).map(move |it| (ring, it))) {
            let [inner, outer, next] = [at(ring, step), at(ring + 1, step), at(ring + 1, step + 1)];
            mesh.triangles.push([inner, outer, next]);
            if ring > 0 {
                mesh.triangles.push([inner, next, at(ring, step + 1)]);
            }
        }
        return Ok(mesh);
    }
    let [width, height] = frame.map(f64::from);
    for side in 0..across {
        let at = |[x, y]: [f64; 2]| {
            let inside = |part: f64| 0.5 + INSIDE * (part - 0.5);
            [width * (f64::from(side) + inside(x)), height * inside(y)]
        };
        let corners = [[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0]];
        let [a, b, c, d] = corners.map(|corner| add(&mut mesh, at(corner)));
        mesh.triangles.extend([[a, b, c], [a, c, d]]);
    }
    Ok(mesh)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The place of a frame that a mesh shows in a direction: its triangle's weighted mean.
    fn shown(mesh: &SurroundMesh, direction: DVec3) -> Option<[f64; 2]> {
        let vertex = |row: u32| mesh.vertices[row as usize].map(f64::from);
        mesh.triangles.iter().find_map(|corners| {
            let corners = corners.map(vertex);
            let [a, b, c] = corners.map(|[x, y, z, ..]| DVec3::new(x, y, z));
            let volume = |a: DVec3, b: DVec3, c: DVec3| a.dot(b.cross(c));
            let parts = [volume(direction, b, c), volume(a, direction, c), volume(a, b, direction)];
            // Seen from inside, counterclockwise corners have a negative volume.
            let sum: f64 = parts.iter().sum();
            let is_inside = sum != 0.0 && parts.iter().all(|part| part / sum >= -1e-9);
            let is_ahead = direction.dot(a + b + c) > 0.0;
            (is_inside && is_ahead).then(|| {
                [3, 4].map(|at| (0..3).map(|row| parts[row] / sum * corners[row][at]).sum())
            })
        })
    }

    fn directions() -> impl Iterator<Item = DVec3> {
        (1..200).map(|seed| {
            let part = |factor: f64| 2.0 * (f64::from(seed) * factor).fract() - 1.0;
            DVec3::new(part(0.618_034), part(0.414_214), part(0.302_776)).normalize()
        })
    }

    /// Cube maps: in the middle of each side and all over them, exact.
    #[test]
    fn meshes_of_cubes_show_cube_maps() {
        let mesh = mesh(Lens::Cube, [60, 10]).expect("a mesh");
        let ahead = DVec3::NEG_Z;
        for (side, middle) in
            [DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y, ahead, -ahead].into_iter().enumerate()
        {
            let [u, v] = shown(&mesh, middle).expect("a place");
            assert!((u - (side as f64 + 0.5) / 6.0).abs() < 1e-6 && (v - 0.5).abs() < 1e-6);
        }
        // To the right of the view, and above it.
        let [u, v] = shown(&mesh, DVec3::new(0.5, 0.25, -1.0)).expect("a place");
        assert!((u - (4.0 + 0.75) / 6.0).abs() < 1e-6 && (v - 0.625).abs() < 1e-6, "{u} {v}");
        assert_eq!(directions().filter(|&direction| shown(&mesh, direction).is_none()).count(), 0);
    }

    /// Equidistant: the radius is the angle to the view, within a thousandth of the circle; three if
    /// the circle shows what is behind.
    #[test]
    fn meshes_of_domes_show_angles_as_radii() {
        for (degrees, most) in [(180.0_f64, 1e-3), (240.0, 1e-3), (360.0, 3e-3)] {
            let angle = degrees.to_radians();
            let mesh = mesh(Lens::Fisheye { angle }, [40, 20]).expect("a mesh");
            for direction in directions() {
                let off = libm::acos(-direction.z);
                let found = shown(&mesh, direction);
                if off > 0.5 * angle {
                    assert!(found.is_none_or(|_| off < 0.51 * angle));
                    continue;
                }
                // The circle is as high as the frame, which is twice as wide.
                let radius = off / angle;
                let around = libm::atan2(direction.y, direction.x);
                let expected =
                    [0.5 + 0.5 * radius * libm::cos(around), 0.5 + radius * libm::sin(around)];
                let near = |[u, v]: [f64; 2]| {
                    (u - expected[0]).abs() < most && (v - expected[1]).abs() < most
                };
                assert!(found.is_some_and(near) || off > 0.498 * angle, "{direction} {found:?}");
            }
        }
    }

    /// Triangles are counterclockwise in the picture.
    #[test]
    fn triangles_are_counterclockwise() {
        for lens in [Lens::Cube, Lens::Fisheye { angle: 3.0 }] {
            let mesh = mesh(lens, [60, 10]).expect("a mesh");
            for corners in &mesh.triangles {
                let [a, b, c] = corners.map(|row| mesh.vertices[row as usize]);
                let area = (b[3] - a[3]) * (c[4] - a[4]) - (c[3] - a[3]) * (b[4] - a[4]);
                assert!(area > 0.0, "{lens:?} {corners:?}");
            }
        }
    }
}
