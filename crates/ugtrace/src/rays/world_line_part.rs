//! Bodies that accelerate, turn or run on a circle: rays against a hierarchy of triangles in the
//! coordinates of the body, in which rays are curves.  Eq. (P46)

use std::ops::{ControlFlow, Range};
use std::sync::Arc;

use glam::DVec3;
use rayon::prelude::*;
use ugbvh::{Bvh, Curve, DisplacedBvh};
use ugphysics::{Event, RayStretch, SeenTriangle, SmoothStretch, WorldLine, WorldTube};

use super::path::{PastRay, Start, along};

/// How a body moves that has no rest frame.
#[derive(Debug)]
pub struct WorldLineMotion {
    /// In the frame of the camera, with the event of the eye as its origin; coordinates of the body
    /// are relative to the eye.
    pub line: Arc<WorldLine>,
    tube: WorldTube,
    /// What light that arrives at the eye shares; none if the body is beyond the horizon.
    seen_by_eye: Vec<SmoothStretch>,
    /// The triangles where the eye sees them; `None` if light leaves a triangle at very different
    /// own times.
    pub seen: Option<SeenMesh>,
}

/// The triangles of a body where the eye sees them. There light runs straight.
#[derive(Debug)]
pub struct SeenMesh {
    triangles: DisplacedBvh,
    /// When light leaves each triangle.
    own_times: Vec<Range<f64>>,
    /// Of rays in the coordinates of the body.
    bend: f64,
}

impl SeenMesh {
    /// Triangles that are far from flat, besides an eighth of all. With more, rays are faster as
    /// curves.
    const MOST_CURVED: usize = 16;

    /// How often these are divided for closer bounds.
    const LEVELS: u32 = 3;

    fn new(
        line: &WorldLine,
        tube: &WorldTube,
        passages: &[SmoothStretch],
        bvh: &Bvh,
        points: &[DVec3],
        corners: &[[u32; 3]],
    ) -> Option<Self> {
        let seen =
            |point: &DVec3| line.light(*point, Event::ORIGIN).ok().map(|seen| (*point, seen));
        let n_triangles = corners.len();
        let seen: Vec<_> = points.par_iter().map(seen).collect::<Option<_>>()?;
        let corners = |row: usize| corners[row].map(|row| seen[row as usize]);
        let triangle = |row: usize, levels| {
            line.seen_triangle(tube, passages, &corners(row), Event::ORIGIN, levels)
        };
        let rows = 0..n_triangles;
        let mut triangles: Vec<SeenTriangle> =
            rows.into_par_iter().map(|row| triangle(row, 0)).collect::<Option<_>>()?;
        let curved: Vec<usize> =
            (0..n_triangles).filter(|&row| !triangles[row].is_flat(&corners(row))).collect();
        if curved.len() > Self::MOST_CURVED + n_triangles / 8 {
            return None;
        }
        let finer = curved.par_iter().map(|&row| triangle(row, Self::LEVELS));
        for (row, finer) in curved.iter().zip(finer.collect::<Option<Vec<_>>>()?) {
            triangles[*row] = finer;
        }
        let places: Vec<DVec3> = seen.iter().map(|(_, seen)| seen.event.x).collect();
        let deviations: Vec<f64> = triangles.iter().map(|triangle| triangle.deviation).collect();
        let own_times = triangles.into_iter().map(|triangle| triangle.own_times).collect();
        let triangles = DisplacedBvh::new(bvh, &places, &deviations);
        Some(Self { triangles, own_times, bend: line.bend(tube, passages) })
    }
}

/// Where a ray meets a triangle of such a body.
#[derive(Clone, Copy, Debug)]
pub struct CurveHit {
    /// The parameter of the ray.
    pub s: f64,
    /// The own time of the body.
    pub own_time: f64,
    /// The triangle, with the own time, counted backwards, as parameter.
    pub hit: ugbvh::Hit,
}

impl WorldLineMotion {
    /// `points`: those of the body; `corners`: of the triangles of the hierarchy. `None` if the
    /// motion is inertial.
    pub fn new(
        line: &Arc<WorldLine>,
        bvh: &Bvh,
        points: &[DVec3],
        corners: &[[u32; 3]],
    ) -> Option<Self> {
        let tube = line.tube(points.iter().copied())?;
        let seen_by_eye = line.smooth_stretches(&tube, Event::ORIGIN).unwrap_or_default();
        let seen = SeenMesh::new(line, &tube, &seen_by_eye, bvh, points, corners);
        Some(Self { line: line.clone(), tube, seen_by_eye, seen })
    }

    /// Calls `visit` with the hits of a ray at parameters in a range. `visit` returns false for a
    /// hit that ends the search for those behind it, which may still yield hits before it.
    ///
    /// Along a ray in the tube of a body, later parameters have earlier own times, as long as 1 +
    /// a·ξ is positive. `clearance`: own time before which the body of a surface is not met again.
    pub fn visit(
        &self,
        bvh: &Bvh,
        ray: &PastRay,
        range: Range<f64>,
        clearance: f64,
        mut visit: impl FnMut(CurveHit) -> Next,
    ) {
        let mut visit_hit = |stretch: &RayStretch<'_>, hit: ugbvh::Hit| {
            let at = stretch.at(-hit.t);
            // The own time that passed since the ray left its origin.
            let passed = at.s / at.rate.abs();
            if at.s >= range.end {
                return (Next::Nearer, range.end);
            }
            if at.s <= range.start || passed <= clearance {
                return (Next::Everything, range.end);
            }
            (visit(CurveHit { s: at.s, own_time: -hit.t, hit }), at.s)
        };
        if matches!(ray.start, Start::Eye)
            && let Some(seen) = &self.seen
        {
            return self.visit_seen(seen, bvh, ray, range.clone(), visit_hit);
        }
        let visit_stretch = |stretch: &RayStretch<'_>, own_times: Range<f64>| {
            let mut is_over = false;
            let parameters = -own_times.end..-own_times.start;
            bvh.visit_on_curve(&StretchCurve(stretch), parameters.clone(), |hit| {
                let next = visit_hit(stretch, hit).0;
                is_over |= next != Next::Everything;
                match next {
                    Next::Everything => parameters.end,
                    Next::Nearer => hit.t,
                    Next::Nothing => f64::NEG_INFINITY,
                }
            });
            if is_over { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        if matches!(ray.start, Start::Eye) {
            self.line.visit_light(&self.tube, &self.seen_by_eye, ray.step, visit_stretch);
            return;
        }
        let end = ends_before(ray, range.end);
        // A body beyond the horizon of its motion has no events, so no ray meets it.
        let _ = self.line.visit_ray(&self.tube, ray.origin, ray.step, end, visit_stretch);
    }

    /// [`WorldLineMotion::visit`] for a ray to the eye. `visit_hit` returns its parameter, too.
    fn visit_seen(
        &self,
        seen: &SeenMesh,
        bvh: &Bvh,
        ray: &PastRay,
        range: Range<f64>,
        mut visit_hit: impl FnMut(&RayStretch<'_>, ugbvh::Hit) -> (Next, f64),
    ) {
        let mut end = range.end;
        let line = ugbvh::Ray { origin: DVec3::ZERO, direction: ray.step.x };
        seen.triangles.visit(bvh, &line, range, |candidate| {
            let own_times = &seen.own_times[candidate.index() as usize];
            for passage in &self.seen_by_eye {
                let Some((stretch, of_passage)) = self.line.stretch(passage, ray.step) else {
                    break;
                };
                let parameters =
                    -own_times.end.min(of_passage.end)..-own_times.start.max(of_passage.start);
                if parameters.start >= parameters.end {
                    continue;
                }
                candidate.visit_on_curve(
                    &StretchCurve(&stretch),
                    parameters.clone(),
                    seen.bend,
                    |hit| {
                        match visit_hit(&stretch, hit) {
                            (Next::Everything, _) => {}
                            // Triangles at the same place are visited, too.
                            (Next::Nearer, s) => end = end.min(s.next_up()),
                            (Next::Nothing, _) => end = f64::NEG_INFINITY,
                        }
                        parameters.end
                    },
                );
            }
            end
        });
    }
}

/// Which hits are wanted after one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Next {
    /// All.
    Everything,
    /// Only those before it.
    Nearer,
    /// None.
    Nothing,
}

/// The event beyond which a ray is not followed; `None` for a ray in a vacuum, which meets a body
/// only where it is seen.
fn ends_before(ray: &PastRay, end: f64) -> Option<Event> {
    /// Light in a medium without an end is followed so far, in distances from the eye.
    const FAR: f64 = 1e4;
    /// Steps of light in a vacuum, up to rounding.
    const ROUNDING: f64 = 1e-9;
    let length = ray.step.x.length();
    if (length + ray.step.t).abs() <= ROUNDING * length {
        return None;
    }
    let far = FAR * (1.0 + ray.origin.x.length()) / length;
    Some(along(ray.origin, ray.step, end.min(far)))
}

/// A stretch of a ray, with its own time counted backwards as parameter.
struct StretchCurve<'s>(&'s RayStretch<'s>);

impl Curve for StretchCurve<'_> {
    fn at(&self, parameter: f64) -> (DVec3, DVec3) {
        let at = self.0.at(-parameter);
        (at.point, -at.derivative)
    }

    fn bend(&self, ends: [(f64, DVec3); 2]) -> f64 {
        self.0.bend(ends.map(|(parameter, point)| (-parameter, point)))
    }
}
