//! Wires, bent as they are seen.

use glam::DVec3;
use ugparse::{VertexId, Wire};
use ugphysics::doppler_at;

use super::frame::{Frame, frame_of, frames};
use super::motion::Motion;
use crate::config::Exact;
use crate::painter::Painter;
use crate::palette::Swatch;

/// Samples by which a piece may be off the wire.
const TOLERANCE: f64 = 0.125;

/// Change of ln D along a piece.
const MOST_CHANGE: f64 = 2e-3;

/// How often a line is halved at most.
const MOST_HALVINGS: u32 = 12;

/// Cuts wires into pieces that are straight in the picture, and of one Doppler factor, as far as one can see.
pub struct Bend<'a> {
    painter: Painter<'a>,
    motion: Motion<'a>,
    frames: Vec<Frame>,
}

/// A point of a wire.
#[derive(Clone, Copy, Debug)]
pub struct Joint {
    /// Where it is seen, relative to the eye.
    pub seen: DVec3,
    /// Its colour as seen.
    pub color: Swatch,
}

impl<'a> Bend<'a> {
    /// The wires of a scene.
    pub fn new(painter: Painter<'a>, exact: Exact) -> Self {
        Self { painter, motion: Motion::new(exact, painter.palette), frames: frames(&painter) }
    }

    /// The joints of a line of a wire.
    pub fn joints(&self, wire: &Wire, ends: [VertexId; 2]) -> Vec<Joint> {
        let painter = &self.painter;
        let frame = &self.frames[frame_of(wire.velocity)];
        let color = painter.wire_swatch(wire);
        let is_changed = !frame.velocity.is_zero() && !self.motion.keeps_colors();
        let is_light = !is_changed && painter.is_light_wire(wire, &color);
        let colors = ends.map(|end| {
            let swatch = painter.wire_end(end, &color);
            if is_light { painter.as_light(swatch) } else { Swatch { light: None, ..swatch } }
        });
        let rest = ends.map(|end| frame.axes_from_scene(painter.surface.rest(end)));
        let line = Line { frame, motion: self.motion, rest, colors, near: painter.view.slab.near };
        let mut joints = vec![line.joint(0.0)];
        line.add([0.0, 1.0], MOST_HALVINGS, &mut joints);
        joints
    }
}

struct Line<'a> {
    frame: &'a Frame,
    motion: Motion<'a>,
    /// In the axes of the frame.
    rest: [DVec3; 2],
    colors: [Swatch; 2],
    near: f64,
}

impl Line<'_> {
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
            light: a.light.zip(b.light).map(|(a, b)| a + part * (b - a)),
        };
        let seen = self.point(part);
        let color = self.motion.seen(&rest, self.motion.wavelength_nm(rest.tint), 1.0 / self.doppler(seen));
        Joint { seen: self.frame.to_camera(seen), color }
    }

    /// Adds the joints behind the first of two parts of the line, up to the second.
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
            // What is behind the eye is not drawn; what comes from there is.
            return n_behind < 3;
        }
        let [a, middle, b] = [a, middle, b].map(|place| (place / place.z).truncate());
        let along = b - a;
        let off = along.perp_dot(middle - a).abs();
        let [first, .., last] = seen.map(|point| self.doppler(point));
        off > TOLERANCE * along.length() || (first / last - 1.0).abs() > MOST_CHANGE
    }
}
