//! Round faces cut into polygons.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3};

use crate::split::vertex_names;
use crate::words::messages;
use crate::{
    Face, FaceShape, NameId, RelativeMotion, RestFrames, RoundShape, Scene, UniqueNames, Vertex,
    VertexId, rest_positions,
};

/// The sagitta of round faces where no eye is known, relative to their radius: the greatest
/// distance of a polygon from the surface.
const DEFAULT_SAGITTA: f64 = 1e-3;

/// The angle of it at the eye, if one is known: 0.1 milliradians, in radians.
const DEFAULT_ERROR: f64 = 1e-4;

/// The sagitta, relative to the radius, where pictures need it to be invisible, but cannot be drawn
/// with the exact shape.
pub const FINE_SAGITTA: f64 = 2.5e-4;

/// The greatest sagitta, relative to the radius: coarser shapes would be shaded unevenly.
pub const COARSEST_SAGITTA: f64 = 1e-2;

/// Round faces may become so many polygons in all. If they would be more, all are coarser.
const MOST_POLYGONS: usize = 1_000_000;

/// The least number of segments of a circle.
const LEAST_SEGMENTS: usize = 8;

/// The round faces of a scene would become more than a million polygons: so many.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TooManyPolygons(pub usize);

messages! { TooManyPolygons {
    Self(n) => "the round faces of the scene would become {n} polygons, of {MOST_POLYGONS} at most";
} }

/// Cuts round faces into polygons with corners on the surface and normals of the surface there. In
/// a scene as seen, the polygons are those at rest, with corners where they are seen.
///
/// `sagitta`: of a face, its row and its shape at rest, relative to the radius, how far a polygon
/// may be from the surface, at least 9.6·10⁻⁵ (spheres) or 4.7·10⁻⁶ (others); `None` keeps the
/// face.
///
/// # Errors
/// Too many polygons; the scene is unchanged.
pub fn cut_rounds(
    scene: &mut Scene,
    sagitta: impl Fn(usize, &Face, &RoundShape) -> Option<f64>,
) -> Result<(), TooManyPolygons> {
    let is_seen = scene.has_rounds() && scene.stage.seen_geometry().is_some();
    let seen = is_seen.then(|| {
        let (eye, frames) = (crate::eye(scene, None), RestFrames::new(scene));
        (eye, rest_positions(scene, eye, &frames), frames)
    });
    let position = |vertex: VertexId| match &seen {
        Some((eye, rest, _)) => *eye + rest[vertex.index()],
        None => scene.vertices[vertex.index()].position,
    };
    let cut = |(row, face): (usize, &Face)| {
        let shape = scene.round_shape(face, position)?;
        Some((shape, n_segments(face.shape, sagitta(row, face, &shape)?)))
    };
    // Scenes have fewer than 2^32 faces.
    let mut cuts: Vec<Option<(RoundShape, usize)>> =
        scene.faces.iter().enumerate().map(cut).collect();
    if cuts.iter().all(Option::is_none) {
        return Ok(());
    }
    let polygons = |(round, n): &(RoundShape, usize)| match round.shape {
        FaceShape::Sphere => n * n / 2,
        FaceShape::Cylinder => n + 2,
        FaceShape::Tube => *n,
        FaceShape::Disc | FaceShape::Ring | FaceShape::Polygon => 1,
    };
    let count =
        |cuts: &[Option<(RoundShape, usize)>]| cuts.iter().flatten().map(polygons).sum::<usize>();
    let n_polygons = count(&cuts);
    if n_polygons > MOST_POLYGONS {
        let part = (MOST_POLYGONS as f64 / n_polygons as f64).sqrt();
        let coarser = |n: usize| (part * n as f64) as usize / 4 * 4;
        cuts.iter_mut().flatten().for_each(|(_, n)| *n = coarser(*n).max(LEAST_SEGMENTS));
    }
    let n_polygons = count(&cuts);
    if n_polygons > MOST_POLYGONS {
        return Err(TooManyPolygons(n_polygons));
    }
    let mut names = vertex_names(scene);
    for (face, cut) in std::mem::take(&mut scene.faces).into_iter().zip(cuts) {
        match cut {
            Some((round, n)) => {
                let corners = scene.contours.corners(face.contours.clone()).iter().copied();
                let corners = round.units().into_iter().zip(corners).collect();
                let seen = seen.as_ref().map(|(eye, _, frames)| (*eye, frames.motion(face.body)));
                Cutter { scene, names: &mut names, face, round, n, corners, seen }.cut();
            }
            None => scene.faces.push(face),
        }
    }
    Ok(())
}

/// The sagitta of a shape at rest, relative to its radius, that is seen from `eye` within the angle
/// `error`, radians; at most a hundredth.
pub fn seen_sagitta(round: &RoundShape, eye: DVec3, error: f64) -> f64 {
    let [low, high] = round.bounds();
    let radius = round.stretch();
    let beside_box = ugphysics::length(eye.clamp(low, high) - eye);
    let distance = match round.shape {
        FaceShape::Sphere => (ugphysics::length(eye - round.origin) - radius).abs().max(beside_box),
        _ => beside_box,
    };
    (error * (distance / radius)).min(COARSEST_SAGITTA)
}

/// The sagitta of a shape on a world line, relative to its radius, that is seen within the angle
/// `error`, radians; at least [`FINE_SAGITTA`], and less than `most`. `round`: at rest, relative to
/// the eye.
pub fn seen_sagitta_on_world_line(
    round: &RoundShape,
    motion: &RelativeMotion,
    error: f64,
    most: f64,
) -> f64 {
    let [low, high] = round.bounds();
    let around = 0.5 * (high - low).length();
    let distance = match motion.light(low.midpoint(high)) {
        // Eq. (P11): an angle at the eye is length over distance at emission.
        Ok((seen, _)) => (seen.length() - around).max(0.0),
        Err(_) => 0.0,
    };
    (error * distance / round.stretch()).clamp(FINE_SAGITTA, most)
}

/// Cuts all round faces of a scene: within 0.1 milliradians at the eye, or if that is not
/// known within a thousandth of their radius.
///
/// # Errors
/// See [`cut_rounds`].
pub fn cut_rounds_at_rest(scene: &mut Scene, eye: Option<DVec3>) -> Result<(), TooManyPolygons> {
    cut_rounds(scene, |_, _, round| {
        Some(eye.map_or(DEFAULT_SAGITTA, |eye| seen_sagitta(round, eye, DEFAULT_ERROR)))
    })
}

/// Segments of a full circle, a multiple of 4, so that the extreme points are corners.
fn n_segments(shape: FaceShape, sagitta: f64) -> usize {
    // A quadrilateral at the equator of a sphere is cos² of half a segment from its centre.
    let (angle, most) = match shape {
        FaceShape::Sphere => (libm::asin(sagitta.clamp(0.0, 1.0).sqrt()), 320),
        _ => (libm::acos(1.0 - sagitta.clamp(0.0, 1.0)), 1024),
    };
    // The cast saturates.
    let n = (PI / angle).ceil().clamp(LEAST_SEGMENTS as f64, f64::from(most)) as usize;
    n.next_multiple_of(4)
}

/// Cosine and sine of `at` of `n` parts of a circle, exact at quarters.
fn circle(at: usize, n: usize) -> [f64; 2] {
    let (sin, cos) = libm::sincos(TAU * (at % (n / 4)) as f64 / n as f64);
    match at / (n / 4) % 4 {
        0 => [cos, sin],
        1 => [-sin, cos],
        2 => [-cos, -sin],
        _ => [sin, -cos],
    }
}

struct Cutter<'a> {
    scene: &'a mut Scene,
    names: &'a mut UniqueNames,
    face: Face,
    round: RoundShape,
    n: usize,
    /// The corners of the face, which become corners of polygons, by place in the unit shape.
    corners: Vec<(DVec3, VertexId)>,
    /// In a scene as seen, the eye and the motion of the body.
    seen: Option<(DVec3, &'a RelativeMotion)>,
}

impl Cutter<'_> {
    fn cut(&mut self) {
        let n = self.n;
        let rim = |z: f64| (0..n).map(move |at| DVec2::from(circle(at, n)).extend(z));
        let side = |unit: DVec3| Some(unit.with_z(0.0));
        match self.round.shape {
            FaceShape::Polygon => {}
            FaceShape::Sphere => {
                let rings: Vec<Vec<VertexId>> = (0..=n / 2)
                    .map(|row| {
                        let [z, radius] = circle(row, n);
                        let ring =
                            rim(z).map(|unit| DVec3::new(radius * unit.x, radius * unit.y, z));
                        // The rings of the poles are single vertices.
                        let len = if radius == 0.0 { 1 } else { n };
                        ring.take(len).map(|unit| self.vertex(unit, Some(unit))).collect()
                    })
                    .collect();
                rings.windows(2).for_each(|rings| self.band(&rings[1], &rings[0]));
            }
            FaceShape::Cylinder | FaceShape::Tube => {
                let [foot, head] = [0.0, 1.0]
                    .map(|z| rim(z).map(|unit| self.vertex(unit, side(unit))).collect::<Vec<_>>());
                self.band(&foot, &head);
                if self.round.shape == FaceShape::Cylinder {
                    // Ends have corners without normals at the same places.
                    let ends = [foot, head].map(|rim| {
                        let copies = rim.iter().map(|&corner| {
                            let name = self.name();
                            let copy = self.scene.copy_vertex(corner, name);
                            self.scene.vertices[copy.index()].normal = None;
                            copy
                        });
                        copies.collect::<Vec<_>>()
                    });
                    let [foot, head] = ends;
                    self.polygon([foot.into_iter().rev().collect()]);
                    self.polygon([head]);
                }
            }
            FaceShape::Disc => {
                let rim = rim(0.0).map(|unit| self.vertex(unit, None)).collect();
                self.polygon([rim]);
            }
            FaceShape::Ring => {
                let rims = [1.0, self.round.inner]
                    .map(|radius| rim(0.0).map(|unit| self.vertex(radius * unit, None)).collect());
                self.polygon(rims);
            }
        }
    }

    fn vertex(&mut self, unit: DVec3, normal: Option<DVec3>) -> VertexId {
        let normal = normal.map(|normal| self.round.normal(normal));
        if let Some(at) = self.corners.iter().position(|corner| corner.0 == unit) {
            let corner = self.corners[at].1;
            self.scene.vertices[corner.index()].normal = normal;
            return corner;
        }
        let (name, color) = (self.name(), self.scene.vertices[self.corners[0].1.index()].color);
        let mut position = self.round.place(unit);
        if let Some((eye, motion)) = self.seen
            && let Ok((seen, own_time)) = motion.light(motion.turned(position - eye))
        {
            // Columns of a scene that was not read from text.
            if !self.scene.rest.is_empty() {
                self.scene.rest.push(position - eye);
            }
            if !self.scene.own_times.is_empty() {
                self.scene.own_times.push(motion.world_line().map_or(f64::NAN, |_| own_time));
            }
            position = eye + seen;
        }
        self.scene.add_vertex(Vertex { name, normal, ..Vertex::at(position, color) })
    }

    /// A name for a vertex.
    fn name(&mut self) -> NameId {
        let first = self.scene.vertices[self.corners[0].1.index()].name;
        self.names.add_copy(first, &mut self.scene.names)
    }

    /// The polygons between two rings, each of which may be a single vertex.
    fn band(&mut self, below: &[VertexId], above: &[VertexId]) {
        for at in 0..self.n {
            let of = |ring: &[VertexId], at: usize| ring[at % ring.len()];
            let mut corners =
                vec![of(below, at), of(below, at + 1), of(above, at + 1), of(above, at)];
            corners.dedup();
            self.polygon([corners]);
        }
    }

    /// Adds a polygon, counterclockwise seen from outside unless the shape is mirrored.
    fn polygon<const N: usize>(&mut self, mut corners: [Vec<VertexId>; N]) {
        if self.round.axes.determinant() < 0.0 {
            corners.iter_mut().for_each(|contour| contour.reverse());
        }
        let rows = self.scene.contours.push_all(corners);
        self.scene.faces.push(Face {
            contours: rows,
            shape: FaceShape::Polygon,
            ..self.face.clone()
        });
    }
}
