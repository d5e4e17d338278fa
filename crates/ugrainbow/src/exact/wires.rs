//! Lines of moving bodies, which are seen as curves.

use glam::DVec3;
use uglight::{Appearance, Swatch};
use ugphysics::doppler_at;
use ugpicture::outlines::PictureRays;
use ugscene::BodyId;

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
        let frame = &self.frames[line.body.index()];
        let rest = line.ends.map(|end| frame.aligned_from_scene(painter.appearance.surface.rest(end)));
        let near = painter.view.slab.near;
        let appearance = painter.appearance;
        let curve = Curve { frame, appearance, rest, colors: line.colors, rows: line.rows, near };
        let mut joints = vec![curve.joint(0.0)];
        curve.add([0.0, 1.0], MOST_HALVINGS, &mut joints);
        joints
    }

    fn keeps_light(&self, body: BodyId) -> bool {
        self.painter.appearance.keeps_light() || self.frames[body.index()].velocity.is_zero()
    }
}

struct Curve<'a> {
    frame: &'a PictureRays,
    appearance: &'a Appearance,
    /// The ends at rest, in the axes of the frame.
    rest: [DVec3; 2],
    colors: [Swatch; 2],
    rows: Option<[u32; 2]>,
    near: f64,
}

impl Curve<'_> {
    fn point(&self, part: f64) -> DVec3 {
        self.frame.seen(self.rest[0] + part * (self.rest[1] - self.rest[0]))
    }

    fn doppler(&self, seen: DVec3) -> f64 {
        doppler_at(self.frame.to_camera(seen), self.frame.velocity)
    }

    fn joint(&self, part: f64) -> Joint {
        let [a, b] = self.colors;
        let mix = |a: f64, b: f64| a + part * (b - a);
        let rest = Swatch {
            tint: mix(a.tint, b.tint),
            saturation: mix(a.saturation, b.saturation),
            value: mix(a.value, b.value),
            factor: mix(a.factor, b.factor),
            translucency: 0.0,
            is_display: a.is_display,
            light: a.light.zip(b.light).map(|(a, b)| a + part * (b - a)),
        };
        let seen = self.point(part);
        let stretch = 1.0 / self.doppler(seen);
        let color = match self.rows.filter(|_| self.appearance.is_spectral()) {
            Some([a, b]) => {
                let light = self.appearance.seen_light([(a, 1.0 - part), (b, part)], stretch, None);
                Swatch { light: Some(light), ..rest }
            }
            None => self.appearance.seen(&rest, self.appearance.wavelength_nm(rest.tint), stretch),
        };
        Joint { seen: self.frame.to_camera(seen), color }
    }

    /// Adds the joints after `from` up to `to`, which are parameters of the line.
    fn add(&self, [from, to]: [f64; 2], n_halvings: u32, joints: &mut Vec<Joint>) {
        let middle = 0.5 * (from + to);
        if n_halvings > 0 && self.is_bent([from, middle, to].map(|part| self.point(part))) {
            self.add([from, middle], n_halvings - 1, joints);
            self.add([middle, to], n_halvings - 1, joints);
        } else {
            joints.push(self.joint(to));
        }
    }

    fn is_bent(&self, seen: [DVec3; 3]) -> bool {
        let [a, middle, b] = seen.map(|point| self.frame.place(point));
        let n_behind = [a, middle, b].into_iter().filter(|place| place.z <= self.near).count();
        if n_behind > 0 {
            // A piece wholly behind the eye is not drawn; one that reaches in front is halved
            // further.
            return n_behind < 3;
        }
        let keys = [a, middle, b].map(|place| 1.0 / place.z);
        let [a, middle, b] = [a, middle, b].map(|place| (place / place.z).truncate());
        let along = b - a;
        let off = along.perp_dot(middle - a).abs();
        let [first, .., last] = seen.map(|point| self.doppler(point));
        // A piece must also be straight in depth, because occlusion is decided by its depth.
        let part = along.dot(middle - a) / along.length_squared();
        let key = keys[0] + part.clamp(0.0, 1.0) * (keys[2] - keys[0]);
        off > TOLERANCE * along.length()
            || (first / last - 1.0).abs() > MOST_CHANGE
            || (along.length() > TOLERANCE && (key / keys[1] - 1.0).abs() > MOST_OFF_IN_DEPTH)
    }
}
