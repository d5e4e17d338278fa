//! Bodies that accelerate, turn or run on a circle: rays against a hierarchy of triangles in the
//! coordinates of the body, in which rays are curves.  Eq. (P46)

use std::ops::{ControlFlow, Range};
use std::sync::Arc;

use glam::DVec3;
use ugbvh::{Bvh, Curve};
use ugphysics::{Event, Passage, RayStretch, WorldLine, WorldTube};

use crate::path::{Ray, Start, along};

/// How a body moves that has no rest frame.
#[derive(Debug)]
pub struct WorldLineMotion {
    /// In the frame of the camera, with the event of the eye as its origin; coordinates of the body
    /// are relative to the eye.
    pub line: Arc<WorldLine>,
    tube: WorldTube,
    /// What light that arrives at the eye shares; none if the body is beyond the horizon.
    seen_by_eye: Vec<Passage>,
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
    /// `points`: those of the body. `None` if the motion is inertial.
    pub fn new(line: &Arc<WorldLine>, points: &[DVec3]) -> Option<Self> {
        let tube = line.tube(points.iter().copied())?;
        let eye = Event { t: 0.0, x: DVec3::ZERO };
        let seen_by_eye = line.passages(&tube, eye).unwrap_or_default();
        Some(Self { line: line.clone(), tube, seen_by_eye })
    }

    /// Calls `visit` with the hits of a ray at parameters in a range. `visit` returns false for a
    /// hit that ends the search for those behind it, which may still yield hits before it.
    ///
    /// Along a ray in the tube of a body, later parameters have earlier own times, as long as 1 +
    /// a·ξ is positive. `clearance`: own time before which the body of a surface is not met again.
    pub fn visit(
        &self,
        bvh: &Bvh,
        ray: &Ray,
        range: Range<f64>,
        clearance: f64,
        mut visit: impl FnMut(CurveHit) -> Next,
    ) {
        let visit_stretch = |stretch: &RayStretch<'_>, own_times: Range<f64>| {
            let mut is_over = false;
            let parameters = -own_times.end..-own_times.start;
            bvh.visit_on_curve(&StretchCurve(stretch), parameters.clone(), |hit| {
                let at = stretch.at(-hit.t);
                // The own time that passed since the ray left its origin.
                let passed = at.s / at.rate.abs();
                if at.s >= range.end {
                    is_over = true;
                    return hit.t;
                }
                if at.s <= range.start || passed <= clearance {
                    return parameters.end;
                }
                match visit(CurveHit { s: at.s, own_time: -hit.t, hit }) {
                    Next::Everything => parameters.end,
                    Next::Nearer => {
                        is_over = true;
                        hit.t
                    }
                    Next::Nothing => {
                        is_over = true;
                        f64::NEG_INFINITY
                    }
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
fn ends_before(ray: &Ray, end: f64) -> Option<Event> {
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
