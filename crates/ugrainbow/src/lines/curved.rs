//! Lines of moving bodies, which are seen as curves.

use glam::DVec3;
use uglight::{ColorForm, Swatch};
use ugphysics::{WorldLineError, doppler_at};
use ugscene::{BodyId, CameraPoint, RelativeMotion};

use super::{Joint, Line};
use crate::painter::Painter;

/// Greatest distance of a piece from the curve, in samples.
const TOLERANCE: f64 = 0.125;

/// Greatest relative error of a piece in depth.
const MOST_OFF_IN_DEPTH: f64 = 1e-4;

/// Greatest change of ln D along a piece.
const MOST_CHANGE: f64 = 2e-3;

/// How often a line is halved at most.
const MOST_HALVINGS: u32 = 12;

/// A line as a polyline, whose pieces are nearly straight in the picture and have nearly one
/// Doppler factor.
pub fn curved(painter: &Painter<'_>, line: &Line) -> Vec<Joint> {
    let surface = &painter.appearance.surface;
    let motion = surface.frames().motion(line.body);
    let rest = line.ends.map(|end| match motion.world_line() {
        Some(_) => surface.rest(end),
        None => motion.turned(surface.rest(end)),
    });
    let curve = Curve { painter, line, motion, rest };
    let mut joints = vec![curve.joint(0.0)];
    curve.add([0.0, 1.0], MOST_HALVINGS, &mut joints);
    joints
}

/// False if colours on this body are Doppler shifted as hues, so that colours given as light have
/// to be converted to hues.
pub fn keeps_light(painter: &Painter<'_>, body: BodyId) -> bool {
    painter.appearance.keeps_light() || !painter.appearance.surface.frames().is_moving(body)
}

struct Curve<'a> {
    painter: &'a Painter<'a>,
    line: &'a Line,
    motion: &'a RelativeMotion,
    /// The ends at rest, in the axes of [`RelativeMotion::turned`]; on a world line, in the
    /// coordinates of the body.
    rest: [DVec3; 2],
}

impl Curve<'_> {
    /// Where a point of the line is seen, in the frame of the camera, and its Doppler factor; NaN if
    /// it is never seen.
    fn seen(&self, part: f64) -> (DVec3, f64) {
        let rest = self.rest[0] + part * (self.rest[1] - self.rest[0]);
        let seen = || {
            let (seen, own_time) = self.motion.light(rest)?;
            let velocity = match self.motion.world_line() {
                Some(line) => line.velocity(rest, own_time)?,
                None => self.motion.velocity(),
            };
            Ok::<_, WorldLineError>((seen, doppler_at(seen, velocity)))
        };
        seen().unwrap_or((DVec3::NAN, 1.0))
    }

    fn joint(&self, part: f64) -> Joint {
        let rest = Swatch::mean(&self.line.colors, [1.0 - part, part]);
        let (seen, doppler) = self.seen(part);
        let (stretch, appearance) = (1.0 / doppler, self.painter.appearance);
        let color = match self.line.rows.filter(|_| appearance.is_spectral()) {
            Some([a, b]) => {
                let light = appearance.seen_light([(a, 1.0 - part), (b, part)], stretch);
                Swatch { form: ColorForm::Light(light), ..rest }
            }
            None => appearance.seen(rest, appearance.wavelength_nm(rest.tint), stretch),
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
