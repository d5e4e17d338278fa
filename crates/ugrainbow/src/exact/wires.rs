//! Lines of moving bodies, which are seen as curves.

use std::sync::Arc;

use glam::DVec3;
use uglight::{ColorForm, Swatch};
use ugphysics::{Event, WorldLine, doppler_at};
use ugpicture::outlines::PictureRays;
use ugscene::{BodyId, CameraPoint};

use crate::lines::{Joint, Line, LineShape};
use crate::painter::Painter;

/// Greatest distance of a piece from the curve, in samples.
const TOLERANCE: f64 = 0.125;

/// Greatest relative error of a piece in depth.
const MOST_OFF_IN_DEPTH: f64 = 1e-4;

/// Greatest change of ln D along a piece.
const MOST_CHANGE: f64 = 2e-3;

/// How often a line is halved at most.
const MOST_HALVINGS: u32 = 12;

/// Approximates lines by polylines. Their pieces are nearly straight in the picture and have nearly
/// one Doppler factor.
pub struct CurvedLines<'a> {
    painter: Painter<'a>,
    frames: Vec<PictureRays>,
}

impl<'a> CurvedLines<'a> {
    /// The lines of a scene.
    pub fn new(painter: Painter<'a>) -> Self {
        let frames = painter.appearance.surface.frames();
        Self { painter, frames: PictureRays::all(frames, painter.view, painter.scene) }
    }
}

impl LineShape for CurvedLines<'_> {
    fn joints(&self, line: &Line) -> Vec<Joint> {
        let painter = &self.painter;
        let surface = &painter.appearance.surface;
        let (frame, world_line) = (&self.frames[line.body.index()], surface.frames().world_line(line.body));
        let rest = line.ends.map(|end| match world_line {
            Some(_) => surface.rest(end),
            None => frame.aligned_from_scene(surface.rest(end)),
        });
        let curve = Curve { frame, world_line, painter, rest, colors: line.colors, rows: line.rows };
        let mut joints = vec![curve.joint(0.0)];
        curve.add([0.0, 1.0], MOST_HALVINGS, &mut joints);
        joints
    }

    fn keeps_light(&self, body: BodyId) -> bool {
        let appearance = self.painter.appearance;
        let is_on_line = appearance.surface.frames().world_line(body).is_some();
        appearance.keeps_light() || !is_on_line && self.frames[body.index()].velocity.is_zero()
    }
}

struct Curve<'a> {
    frame: &'a PictureRays,
    /// Of a body that accelerates or turns.
    world_line: Option<&'a Arc<WorldLine>>,
    painter: &'a Painter<'a>,
    /// The ends at rest, in the axes of the frame; on a world line, in the coordinates of the body.
    rest: [DVec3; 2],
    colors: [Swatch; 2],
    rows: Option<[u32; 2]>,
}

impl Curve<'_> {
    /// Where a point of the line is seen, in the axes of the camera's frame, and its Doppler
    /// factor; NaN if it is never seen.
    fn seen(&self, part: f64) -> (DVec3, f64) {
        let rest = self.rest[0] + part * (self.rest[1] - self.rest[0]);
        let Some(line) = self.world_line else {
            let seen = self.frame.to_camera(self.frame.seen(rest));
            return (seen, doppler_at(seen, self.frame.velocity));
        };
        let seen = line.light(rest, Event { t: 0.0, x: DVec3::ZERO });
        seen.map_or((DVec3::NAN, 1.0), |seen| (seen.event.x, 1.0 / seen.inverse_doppler))
    }

    fn joint(&self, part: f64) -> Joint {
        let rest = Swatch::mean(&self.colors, [1.0 - part, part]);
        let (seen, doppler) = self.seen(part);
        let (stretch, appearance) = (1.0 / doppler, self.painter.appearance);
        let color = match self.rows.filter(|_| appearance.is_spectral()) {
            Some([a, b]) => {
                let light = appearance.seen_light([(a, 1.0 - part), (b, part)], stretch, None);
                Swatch { form: ColorForm::Light(light), ..rest }
            }
            None => appearance.seen(&rest, appearance.wavelength_nm(rest.tint), stretch),
        };
        Joint { seen, color }
    }

    /// Adds the joints after `from` up to `to`, which are parameters of the line.
    fn add(&self, [from, to]: [f64; 2], n_halvings: u32, joints: &mut Vec<Joint>) {
        let middle = 0.5 * (from + to);
        if n_halvings > 0 && self.is_bent([from, middle, to].map(|part| self.seen(part))) {
            self.add([from, middle], n_halvings - 1, joints);
            self.add([middle, to], n_halvings - 1, joints);
        } else {
            joints.push(self.joint(to));
        }
    }

    fn is_bent(&self, seen: [(DVec3, f64); 3]) -> bool {
        let view = self.painter.view;
        let [a, middle, b] = seen.map(|(point, _)| {
            let CameraPoint { x, y, z } = view.place(point);
            DVec3 { x, y, z }
        });
        let n_behind = [a, middle, b].into_iter().filter(|place| place.z <= view.slab.near).count();
        if n_behind > 0 {
            // A piece wholly behind the eye is not drawn; one that reaches in front is halved
            // further.
            return n_behind < 3;
        }
        let keys = [a, middle, b].map(|place| 1.0 / place.z);
        let [a, middle, b] = [a, middle, b].map(|place| (place / place.z).truncate());
        let along = b - a;
        let off = along.perp_dot(middle - a).abs();
        let [first, .., last] = seen.map(|(_, doppler)| doppler);
        // A piece must also be straight in depth, because occlusion is decided by its depth.
        let part = along.dot(middle - a) / along.length_squared();
        let key = keys[0] + part.clamp(0.0, 1.0) * (keys[2] - keys[0]);
        off > TOLERANCE * along.length()
            || (first / last - 1.0).abs() > MOST_CHANGE
            || (along.length() > TOLERANCE && (key / keys[1] - 1.0).abs() > MOST_OFF_IN_DEPTH)
    }
}
