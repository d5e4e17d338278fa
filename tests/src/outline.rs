//! How far the edges that the programs draw are from where the oracle sees them.
//!
//! Only positions in the written scene are used. An edge of a piece counts if both its ends, carried back into
//! the rest frame by the oracle's matrix, lie on one edge of the face as it was; edges within a face show nothing.

use glam::DVec3;
use rayon::prelude::*;
use ugparse::Scene;

use crate::oracle::{Oracle, Outline, Pinhole};

/// Points along each drawn edge that are measured.
const N_POINTS: u32 = 12;

/// The greatest errors of drawn outlines.
#[derive(Clone, Copy, Debug, Default)]
pub struct Errors {
    /// Angle at the eye, radians, in all directions.
    pub angle: f64,
    /// Pixels, within the picture.
    pub pixels: f64,
    /// Drawn edges on outlines.
    pub n_edges: usize,
}

impl Errors {
    /// The larger of each, and the sum of the edges.
    #[must_use]
    pub fn and(self, other: Errors) -> Errors {
        Errors {
            angle: self.angle.max(other.angle),
            pixels: self.pixels.max(other.pixels),
            n_edges: self.n_edges + other.n_edges,
        }
    }
}

/// Measures every edge of `seen`, which is relative to `eye`. `origin`: which face of the oracle's scene each
/// face is a piece of.
pub fn errors(seen: &Scene, origin: &[usize], eye: DVec3, oracle: &Oracle, camera: &Pinhole) -> Errors {
    let n_faces = origin.iter().max().map_or(0, |last| last + 1);
    let outlines: Vec<Option<Outline>> =
        (0..n_faces).into_par_iter().map(|face| oracle.outline(face)).collect();
    let of_face = |(row, &face): (usize, &usize)| {
        let Some(outline) = outlines[face] else { return Errors::default() };
        let contours = seen.face_contours(&seen.faces[row]);
        let ends = contours.flat_map(|corners| corners.iter().zip(corners.iter().cycle().skip(1)));
        let place = |id: &ugparse::VertexId| seen.vertices[id.index()].position - eye;
        ends.map(|(a, b)| of_chord(&outline, [place(a), place(b)], camera))
            .fold(Errors::default(), Errors::and)
    };
    origin.par_iter().enumerate().map(of_face).reduce(Errors::default, Errors::and)
}

fn of_chord(outline: &Outline, ends: [DVec3; 2], camera: &Pinhole) -> Errors {
    let edge = (0..outline.n_edges()).find(|&edge| outline.parts(edge, ends).is_some());
    edge.map_or_else(Errors::default, |edge| chord_error(outline, edge, ends, camera))
}

/// The error of a straight line between two seen points of one edge.
pub fn chord_error(outline: &Outline, edge: usize, ends: [DVec3; 2], camera: &Pinhole) -> Errors {
    let [width, height] = camera.size().map(f64::from);
    let mut errors = Errors { n_edges: 1, ..Errors::default() };
    // In equal steps of the picture, not of space: directions between those of the ends.
    let [from, to] = ends.map(DVec3::normalize);
    for step in 1..N_POINTS {
        let drawn = from.lerp(to, f64::from(step) / f64::from(N_POINTS)).normalize();
        let exact = outline.nearest(edge, drawn).normalize();
        errors.angle = errors.angle.max(libm::atan2(drawn.cross(exact).length(), drawn.dot(exact)));
        if let Some(pixel) = camera.pixel(drawn)
            && (0.0..=width).contains(&pixel.x)
            && (0.0..=height).contains(&pixel.y)
        {
            let exact = camera.pixel(exact);
            errors.pixels = errors.pixels.max(exact.map_or(f64::INFINITY, |exact| exact.distance(pixel)));
        }
    }
    errors
}
