//! Rays against the triangles of a mesh at rest, as `embree.cpp` traces them: the work that
//! `cargo xtask bench rays` measures.

use std::f64::consts::PI;
use std::hint::black_box;
use std::io::{self, Write};

use clap::ValueEnum;
use glam::DVec3;
use rayon::prelude::*;
use ugbvh::{Bvh, Ray};

use crate::mesh::Mesh;

#[derive(Clone, Copy, ValueEnum)]
pub enum Work {
    /// Write the mesh for `embree.cpp`
    Mesh,
    /// Build the hierarchy
    Build,
    /// Trace one ray after the other
    Single,
    /// Trace packets
    Packet,
}

const WIDTH: usize = 1280;
const HEIGHT: usize = 720;

/// Packets have this many rays along a side.
const SIDE: usize = 8;

const EYE: DVec3 = DVec3::new(0.0, -3.2, 0.6);

/// Horizontal view angle, degrees.
const VIEW_ANGLE: f64 = 52.0;

/// Does the work `times` times on a mesh of about `triangles` triangles, and prints the number of
/// hits of a picture.
pub fn write(out: &mut impl Write, work: Work, triangles: u32, times: u32) -> io::Result<()> {
    let Mesh { mut positions, triangles, .. } = Mesh::of_triangles(triangles);
    // Both programs have the same positions.
    positions.iter_mut().for_each(|position| *position = position.as_vec3().as_dvec3());
    if let Work::Mesh = work {
        for count in [positions.len(), triangles.len()] {
            out.write_all(&u32::try_from(count).map_err(io::Error::other)?.to_le_bytes())?;
        }
        let numbers = positions.iter().flat_map(|at| at.as_vec3().to_array());
        numbers.map(f32::to_le_bytes).try_for_each(|bytes| out.write_all(&bytes))?;
        return triangles.iter().flatten().try_for_each(|row| out.write_all(&row.to_le_bytes()));
    }
    let mut bvh = Bvh::new(&positions, &triangles);
    let mut n_hits = 0;
    for _ in 0..times {
        match work {
            Work::Single => n_hits = trace(&bvh, trace_single),
            Work::Packet => n_hits = trace(&bvh, trace_packet),
            Work::Mesh | Work::Build => bvh = Bvh::new(black_box(&positions), &triangles),
        }
    }
    writeln!(out, "{n_hits}")
}

/// The camera of the benchmark.
struct Camera {
    forward: DVec3,
    right: DVec3,
    up: DVec3,
}

impl Camera {
    fn new() -> Self {
        let forward = -EYE.normalize();
        let right = forward.cross(DVec3::Z).normalize();
        let up = right.cross(forward);
        let half = libm::tan(VIEW_ANGLE * PI / 360.0);
        Self { forward, right: right * half, up: up * (half * HEIGHT as f64 / WIDTH as f64) }
    }

    #[inline(always)]
    fn direction(&self, column: usize, row: usize) -> DVec3 {
        let x = 2.0 * (column as f64 + 0.5) / WIDTH as f64 - 1.0;
        let y = 1.0 - 2.0 * (row as f64 + 0.5) / HEIGHT as f64;
        (self.forward + x * self.right + y * self.up).normalize()
    }
}

/// Calls `tile` with the column and row of each tile, on all threads. Returns the number of hits.
fn trace(bvh: &Bvh, tile: impl Fn(&Bvh, &Camera, usize, usize) -> usize + Sync) -> usize {
    let camera = Camera::new();
    let row = |row: usize| -> usize {
        (0..WIDTH).step_by(SIDE).map(|column| tile(bvh, &camera, column, row * SIDE)).sum()
    };
    (0..HEIGHT / SIDE).into_par_iter().map(row).sum()
}

fn trace_single(bvh: &Bvh, camera: &Camera, column: usize, row: usize) -> usize {
    (0..SIDE * SIDE)
        .filter(|idx| {
            let direction = camera.direction(column + idx % SIDE, row + idx / SIDE);
            bvh.closest(&Ray { origin: EYE, direction }, 0.0..f64::INFINITY).is_some()
        })
        .count()
}

fn trace_packet(bvh: &Bvh, camera: &Camera, column: usize, row: usize) -> usize {
    let directions: [DVec3; SIDE * SIDE] =
        std::array::from_fn(|idx| camera.direction(column + idx % SIDE, row + idx / SIDE));
    let mut hits = [None; SIDE * SIDE];
    bvh.closest_packet(EYE, &directions, 0.0..f64::INFINITY, &mut hits);
    hits.iter().flatten().count()
}
