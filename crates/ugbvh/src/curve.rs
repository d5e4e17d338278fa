//! Searches along a curve.
//!
//! # Why no hit is lost
//!
//! Between two parameters the curve is nowhere farther than M Δ²/8 from the point of its chord at
//! the same fraction, where M bounds its second derivative and Δ is the difference of the
//! parameters. So the chord is a ray that meets every box and triangle that the curve meets, if
//! they are grown by this distance: twice it, since the projection to a plane adds it to itself at
//! most. Sections of the curve are halved until it is small compared with the box that is entered.
//!
//! In a section the height of the curve above the plane of a triangle is a function g with |g''| ≤
//! |n| M. It has no root where it is greater at both ends, with the same sign, than its deviation
//! from the chord; and one or none where its slope cannot change sign. Otherwise the section is
//! halved. A root lies in a section if the signs at its ends differ. Sections share their ends, bit
//! for bit, so a root at an end is in one of them.
//!
//! # Watertight edges
//!
//! Close to a root the curve is replaced by its tangent, and the triangle is tested as for a
//! straight ray. Parameters at which tangents touch are multiples of a step, so a curve through a
//! common edge of two triangles has the same tangent for both, and crosses one of them. The step is
//! so small that the tangent is within 2⁻⁴⁴ sizes of the mesh. Halves of a section have its step,
//! since triangles that meet at a corner may be tested with sections of different lengths.

use std::ops::Range;

use fearless_simd::{Simd, dispatch};
use glam::DVec3;

use crate::box_ray::{BoxRay, Line};
use crate::closest::lowest;
use crate::frame::{exponent, power_of_two};
use crate::nodes::{IS_BLOCK, SimdRay};
use crate::shear::{Crossing, Shear};
use crate::{Bvh, Triangle};

/// A curve in the coordinates of a mesh, with a continuous derivative.
pub trait Curve {
    /// The point at a parameter, and the derivative there.
    fn at(&self, parameter: f64) -> (DVec3, DVec3);

    /// An upper bound of the length of the second derivative between two parameters, whose points
    /// are passed as well. It may be infinite, unless the parameters are close to each other.
    fn bend(&self, ends: [(f64, DVec3); 2]) -> f64;
}

/// A section is halved for boxes whose extent times this is below its deviation. Found by trial on
/// a spinning sphere of 100 000 triangles; the time changes little between a half and twice of it.
const NODE_SLACK: f32 = 0.07;

/// The same for blocks of triangles.
const BLOCK_SLACK: f32 = 0.05;

/// Deviation of the sections that a search begins with, in box coordinates, and the most of them.
const FIRST_DEVIATION: f64 = 0.04;
const MOST_FIRST: f64 = 64.0;

/// Greatest deviation of a section whose chord is tested, in box coordinates.
const MAX_DEVIATION: f64 = 64.0;

/// Halvings of a section, down to rounding.
const MOST_HALVINGS: u32 = 64;

/// Sections that deviate less are not halved for any box.
const LEAST_DEVIATION: f32 = power_of_two(-24) as f32;

/// Most sections of a curve, so that every search ends. Then those that deviate too much from their
/// chord for a test hit nothing: of curves that run around the mesh thousands of times.
const MOST_SECTIONS: usize = 1 << 16;

/// Most halvings of a section for one triangle, so that every search ends. A curve that touches a
/// plane takes some hundred of them. A curve in the plane is detected before, unless rounding errors
/// hide it.
const MOST_HALVINGS_AT_A_TRIANGLE: u32 = 1 << 11;

/// A section that could leave a plane by so many rounding errors, but does not, is in it.
const MANY_ROUNDINGS: f64 = power_of_two(20);

/// Distance of tangents from the curve, in box coordinates.
const TANGENT_ERROR: f64 = power_of_two(-44);

/// Calls `visit` with hits in a range and their triangles, roughly the first ones first. `visit`
/// returns the end of the range from then on.
pub fn visit<C: Curve>(
    bvh: &Bvh,
    curve: &C,
    range: Range<f64>,
    visit: impl FnMut(Crossing, u32) -> f64,
) {
    let is_finite = range.start.is_finite() && range.end.is_finite();
    if bvh.nodes.is_empty() || !is_finite || range.start >= range.end {
        return;
    }
    let end = range.end;
    let (sections, stack) = (Vec::with_capacity(32), Vec::with_capacity(64));
    let mut search = Search { bvh, curve, range, end, sections, stack, halvings_left: 0, visit };
    dispatch!(bvh.level, simd => search.run(simd));
}

/// Calls `visit` with crossings of a curve and a triangle; see [`visit`]. `step`: between parameters
/// of tangents, see [`tangent_step`].
pub fn visit_triangle<C: Curve>(
    bvh: &Bvh,
    curve: &C,
    triangle: &Triangle,
    range: Range<f64>,
    step: f64,
    visit: impl FnMut(Crossing, u32) -> f64,
) {
    let ends = [range.start, range.end].map(|parameter| (parameter, curve.at(parameter).0));
    let bend = curve.bend(ends);
    let end = range.end;
    let (sections, stack) = (Vec::new(), Vec::new());
    let mut search = Search { bvh, curve, range, end, sections, stack, halvings_left: 0, visit };
    search.cross(&Arc { ends, bend, halvings: 0, step }, triangle);
}

/// The step between parameters of tangents to curves whose second derivative is no longer than
/// `bend`: a power of two.
pub fn tangent_step(bvh: &Bvh, bend: f64) -> f64 {
    power_of_two(exponent(longest_step(bvh, bend)).clamp(-1000, 1000))
}

/// At half a step from where it touches, a tangent is M step²/8 from the curve.
fn longest_step(bvh: &Bvh, bend: f64) -> f64 {
    (8.0 * TANGENT_ERROR / (bend * bvh.frame.scale)).sqrt()
}

struct Search<'a, C, V> {
    bvh: &'a Bvh,
    curve: &'a C,
    range: Range<f64>,
    /// Greatest parameter of interest.
    end: f64,
    sections: Vec<Section>,
    stack: Vec<Entry>,
    /// For the current triangle.
    halvings_left: u32,
    visit: V,
}

/// A part of the hierarchy that a section of the curve may meet.
#[derive(Clone, Copy)]
struct Entry {
    /// Least parameter of a hit.
    key: f64,
    child: u32,
    /// Its node, and its position there; `None` for the root.
    parent: Option<(u32, u32)>,
    section: u32,
    /// Greatest extent of its box.
    extent: f32,
}

/// A section of the curve.
#[derive(Clone, Copy)]
struct Section {
    ends: [(f64, DVec3); 2],
    /// M
    bend: f64,
    /// In box coordinates; infinite if the section has to be halved in any case.
    deviation: f32,
    halvings: u32,
    /// Between parameters of tangents; NaN if M is infinite.
    step: f64,
    chord: Option<Chord>,
    /// Rows of its halves; `None` for a half that misses the mesh.
    halves: Option<[Option<u32>; 2]>,
}

/// The chord of a section as a ray.
#[derive(Clone, Copy)]
struct Chord {
    ray: BoxRay,
    depths: [f32; 2],
    /// τ of both ends, before which boxes may be entered by `margin`.
    at: [f64; 2],
    margin: f64,
}

impl Section {
    /// The least parameter of a hit in a box that the chord enters at τ = `near`.
    fn parameter(&self, near: f32) -> f64 {
        let [(from, _), (to, _)] = self.ends;
        let Some(chord) = &self.chord else { return from };
        let fraction = (f64::from(near) - chord.margin - chord.at[0]) / (chord.at[1] - chord.at[0]);
        if fraction > 0.0 { from + fraction.min(1.0) * (to - from) } else { from }
    }
}

impl<C: Curve, V: FnMut(Crossing, u32) -> f64> Search<'_, C, V> {
    /// Adds a section, unless it misses the mesh. Returns its row. `step`: of the section that it is
    /// a half of, or NaN.
    fn section(&mut self, ends: [(f64, DVec3); 2], halvings: u32, step: f64) -> Option<u32> {
        let [(from, start), (to, end)] = ends;
        let bend = self.curve.bend(ends);
        let deviation = bend * ((to - from) * (to - from) * 0.125) * self.bvh.frame.scale;
        let chord = if deviation <= MAX_DEVIATION {
            match self.chord([start, end], deviation) {
                Ok(chord) => Some(chord?),
                Err(NoDirection) => None,
            }
        } else {
            None
        };
        let has_middle = halvings < MOST_HALVINGS && start.is_finite() && end.is_finite();
        if chord.is_none() && !has_middle {
            return None;
        }
        let deviation = if chord.is_some() { deviation as f32 } else { f32::INFINITY };
        let step = if step.is_nan() { self.step(ends, bend) } else { step };
        self.sections.push(Section { ends, bend, deviation, halvings, step, chord, halves: None });
        u32::try_from(self.sections.len() - 1).ok()
    }

    /// The chord as a ray; `Ok(None)` if it misses the mesh.
    fn chord(
        &self,
        [start, end]: [DVec3; 2],
        deviation: f64,
    ) -> Result<Option<Chord>, NoDirection> {
        let direction = (end - start).to_array();
        let shear = Shear::new(&self.bvh.frame, start.to_array(), direction).ok_or(NoDirection)?;
        // More than twice, for its rounding.
        let margin = 2.001 * deviation;
        let Some(ray) = BoxRay::with_margin(&shear, direction, margin) else { return Ok(None) };
        let depths = ray.limits(&shear, &(0.0..1.0));
        let at = [ray.depth(shear.z(0.0)), ray.depth(shear.z(1.0))];
        let is_beside = depths.start > depths.end
            || at[0] > 2.0 + 2.0 * margin + 1e-3
            || at[1] < -2.0 * margin - 1e-3;
        Ok((!is_beside).then_some(Chord { ray, depths: [depths.start, depths.end], at, margin }))
    }

    fn halves(&mut self, row: u32) -> [Option<u32>; 2] {
        let Section { ends, halvings, step, halves, .. } = self.sections[row as usize];
        if let Some(halves) = halves {
            return halves;
        }
        let [(from, _), (to, _)] = ends;
        let parameter = from + 0.5 * (to - from);
        let middle = (parameter, self.curve.at(parameter).0);
        let halves = if from < parameter && parameter < to && self.sections.len() < MOST_SECTIONS {
            [[ends[0], middle], [middle, ends[1]]]
                .map(|ends| self.section(ends, halvings + 1, step))
        } else {
            [None; 2]
        };
        self.sections[row as usize].halves = Some(halves);
        halves
    }

    /// Searches the sections of the curve one after the other: so long that their chords tell the
    /// parts of the mesh apart.
    #[inline(always)]
    fn run<S: Simd>(&mut self, simd: S) {
        let Range { start, end } = self.range;
        let whole = [start, end].map(|parameter| (parameter, self.curve.at(parameter).0));
        let deviation =
            self.curve.bend(whole) * (end - start) * (end - start) * 0.125 * self.bvh.frame.scale;
        // NaN becomes 0.
        let n = ((deviation / FIRST_DEVIATION).sqrt().ceil().min(MOST_FIRST) as u32).max(1);
        let mut from = whole[0];
        for at in 1..=n {
            let to = if at == n {
                whole[1]
            } else {
                let parameter = start + (end - start) * (f64::from(at) / f64::from(n));
                (parameter, self.curve.at(parameter).0)
            };
            if from.0 >= self.end {
                return;
            }
            if let Some(section) = self.section([from, to], 0, f64::NAN) {
                self.stack.push(Entry {
                    key: from.0,
                    child: 0,
                    parent: None,
                    section,
                    extent: 2.0,
                });
                self.walk(simd);
            }
            from = to;
        }
    }

    #[inline(always)]
    fn walk<S: Simd>(&mut self, simd: S) {
        while let Some(entry) = self.stack.pop() {
            if entry.key > self.end {
                continue;
            }
            let section = &self.sections[entry.section as usize];
            let is_block = entry.child & IS_BLOCK != 0;
            let slack = if is_block { BLOCK_SLACK } else { NODE_SLACK };
            let is_last = section.halvings == MOST_HALVINGS || self.sections.len() >= MOST_SECTIONS;
            let is_fine =
                section.deviation <= (slack * entry.extent).max(LEAST_DEVIATION) || is_last;
            match &section.chord {
                Some(chord) if is_fine && is_block => {
                    let (line, margin) = (chord.ray.line, chord.margin as f32);
                    self.enter_block(simd, entry, &line, margin);
                }
                Some(_) if is_fine => self.enter_node(simd, entry),
                _ => self.enter_halves(entry),
            }
        }
    }

    fn enter_halves(&mut self, entry: Entry) {
        let [first, second] = self.halves(entry.section);
        for row in [second, first].into_iter().flatten() {
            let section = &self.sections[row as usize];
            let [(from, _), (to, _)] = section.ends;
            let near = match (&section.chord, entry.parent) {
                (Some(chord), Some((node, child))) => {
                    let node = &self.bvh.nodes[node as usize];
                    let Some(near) =
                        node.intersect_child(&chord.ray.slabs, child as usize, chord.depths)
                    else {
                        continue;
                    };
                    section.parameter(near)
                }
                _ => from,
            };
            if entry.key <= to && near <= self.end {
                self.stack.push(Entry { key: entry.key.max(near), section: row, ..entry });
            }
        }
    }

    #[inline(always)]
    fn enter_node<S: Simd>(&mut self, simd: S, entry: Entry) {
        let node = &self.bvh.nodes[entry.child as usize];
        let section = &self.sections[entry.section as usize];
        let Some(chord) = &section.chord else { return };
        let (near, mut mask) = node.intersect(
            simd,
            &SimdRay::new(simd, &chord.ray.slabs),
            chord.depths[0],
            chord.depths[1],
        );
        let first = self.stack.len();
        while mask != 0 {
            let idx = lowest(mask);
            mask &= mask - 1;
            let key = section.parameter(near[idx]);
            if key > self.end {
                continue;
            }
            let parent = Some((entry.child, idx as u32));
            let child = Entry {
                key,
                child: node.children()[idx],
                parent,
                extent: node.extent(idx),
                ..entry
            };
            self.stack.push(child);
            // The nearest is popped first.
            let mut at = self.stack.len() - 1;
            while at > first && self.stack[at - 1].key < key {
                self.stack.swap(at - 1, at);
                at -= 1;
            }
        }
    }

    #[inline(always)]
    fn enter_block<S: Simd>(&mut self, simd: S, entry: Entry, line: &Line, margin: f32) {
        let block = &self.bvh.blocks[(entry.child & !IS_BLOCK) as usize];
        let mut mask = block.candidates_near(simd, line, margin);
        while mask != 0 {
            let triangle = self.bvh.triangles[block.first as usize + lowest(mask)];
            mask &= mask - 1;
            let Section { ends, bend, halvings, step, .. } = self.sections[entry.section as usize];
            self.cross(&Arc { ends, bend, halvings, step }, &triangle);
        }
    }

    /// Visits the crossings of a section and a triangle.
    #[inline(never)]
    fn cross(&mut self, section: &Arc, triangle: &Triangle) {
        let [a, b, c] = self.bvh.corners(triangle).map(|corner| DVec3::from_array(*corner));
        let normal = (b - a).cross(c - a);
        let length = normal.length();
        let rounding = TANGENT_ERROR * self.bvh.frame.unit * length;
        let plane = Plane { point: a, normal, bend: section.bend * length, rounding };
        let ends = section.ends.map(|(parameter, point)| (parameter, plane.height(point)));
        if plane.is_crossed_beside(section, [ends[0].1, ends[1].1], [a, b, c], self.bvh.frame.unit)
        {
            return;
        }
        self.halvings_left = MOST_HALVINGS_AT_A_TRIANGLE;
        self.cross_plane(section, &plane, triangle, ends, section.halvings);
    }

    fn cross_plane(
        &mut self,
        section: &Arc,
        plane: &Plane,
        triangle: &Triangle,
        ends: [(f64, f64); 2],
        halvings: u32,
    ) {
        let [(from, low), (to, high)] = ends;
        let reach = plane.bend * ((to - from) * (to - from));
        let is_crossed = (low < 0.0) != (high < 0.0);
        let is_monotonic = (high - low).abs() > 0.5 * reach;
        let is_clear = low.abs().min(high.abs()) > 0.125 * reach;
        if !is_crossed && (is_monotonic || is_clear) {
            return;
        }
        if is_monotonic || halvings >= MOST_HALVINGS {
            if is_crossed
                && let Some(crossing) = self.crossing(section, plane, triangle, ends)
                && self.range.start < crossing.t
                && crossing.t < self.end
            {
                self.end = (self.visit)(crossing, triangle.index);
            }
            return;
        }
        let parameter = from + 0.5 * (to - from);
        if low.abs().max(high.abs()) <= plane.rounding
            && reach > MANY_ROUNDINGS * plane.rounding
            && self.is_in_plane(plane, [from, parameter, to])
        {
            // The triangle is seen edge-on, so not at all.
            return;
        }
        if from < parameter && parameter < to && self.halvings_left > 0 {
            self.halvings_left -= 1;
            let middle = (parameter, plane.height(self.curve.at(parameter).0));
            self.cross_plane(section, plane, triangle, [ends[0], middle], halvings + 1);
            self.cross_plane(section, plane, triangle, [middle, ends[1]], halvings + 1);
        }
    }

    /// True if heights and slopes of the curve are 0 at three parameters, up to rounding.
    #[cold]
    fn is_in_plane(&self, plane: &Plane, parameters: [f64; 3]) -> bool {
        let [from, _, to] = parameters;
        parameters.into_iter().all(|parameter| {
            let (point, derivative) = self.curve.at(parameter);
            let rise = plane.normal.dot(derivative) * (to - from);
            plane.height(point).abs().max(rise.abs()) <= plane.rounding
        })
    }

    /// The crossing of a plane between two parameters, by Newton's method within a bracket, if it
    /// is in the triangle.
    fn crossing(
        &self,
        section: &Arc,
        plane: &Plane,
        triangle: &Triangle,
        [(mut from, low), (mut to, high)]: [(f64, f64); 2],
    ) -> Option<Crossing> {
        /// Halvings of a bracket down to rounding, and steps of Newton's method between them.
        const MOST_STEPS: usize = 200;
        let step = section.step;
        let mut guess = from + (to - from) * (low / (low - high));
        for at in 0..MOST_STEPS {
            let touch = (guess / step).round() * step;
            let (point, derivative) = self.curve.at(touch);
            let height = plane.height(point);
            let root = touch - height / plane.normal.dot(derivative);
            let is_close = (root - touch).abs() <= 0.50001 * step;
            if is_close || at == MOST_STEPS - 1 {
                let direction = derivative.to_array();
                let shear = Shear::new(&self.bvh.frame, point.to_array(), direction)?;
                let crossing = shear.intersect(self.bvh.corners(triangle))?;
                return Some(Crossing { t: touch + crossing.t, ..crossing });
            }
            if from < touch && touch < to {
                if (height < 0.0) == (low < 0.0) {
                    from = touch;
                } else {
                    to = touch;
                }
            }
            let is_inside = from - step <= root && root <= to + step;
            guess = if is_inside { root } else { from + 0.5 * (to - from) };
        }
        None
    }

    /// The step between parameters of tangents: a power of two, or NaN.
    fn step(&self, [(from, _), (to, _)]: [(f64, DVec3); 2], bend: f64) -> f64 {
        if bend == f64::INFINITY {
            return f64::NAN;
        }
        let longest = longest_step(self.bvh, bend);
        let least = from.abs().max(to.abs()) * power_of_two(-50);
        power_of_two(exponent(longest.min(0.25 * (to - from)).max(least)).clamp(-1000, 1000))
    }
}

/// What a crossing needs of a section.
struct Arc {
    ends: [(f64, DVec3); 2],
    bend: f64,
    halvings: u32,
    step: f64,
}

/// The chord of a section has no length.
struct NoDirection;

/// The plane of a triangle.
struct Plane {
    point: DVec3,
    /// Of any length.
    normal: DVec3,
    /// A bound of the second derivative of the height.
    bend: f64,
    /// Heights below it are 0.
    rounding: f64,
}

impl Plane {
    fn height(&self, point: DVec3) -> f64 {
        self.normal.dot(point - self.point)
    }

    /// True only if a section crosses the plane outside the triangle `corners`, if it does.
    ///
    /// Where the curve is in the plane, its chord is no farther than the deviation d from it, so
    /// along the chord at most d/sin(angle to the plane) from where the chord crosses the plane.
    /// `heights`: of the ends. `unit`: size of the mesh.
    fn is_crossed_beside(
        &self,
        section: &Arc,
        heights: [f64; 2],
        corners: [DVec3; 3],
        unit: f64,
    ) -> bool {
        /// More than the errors of tangents and of rounding, in sizes of the mesh.
        const ROUNDING: f64 = power_of_two(-40);
        let [(from, start), (to, end)] = section.ends;
        let [low, high] = heights;
        let chord = end - start;
        let crossing = start + low / (low - high) * chord;
        let deviation = section.bend * ((to - from) * (to - from)) * 0.125;
        let length = self.normal.length();
        let along = chord.length() * length / (high - low).abs();
        let margin = 1.001 * deviation * (1.0 + along) + ROUNDING * unit * along.max(1.0);
        let [a, b, c] = corners;
        let edges = [b - a, c - b, a - c];
        let longest = edges.map(DVec3::length_squared).into_iter().fold(0.0, f64::max).sqrt();
        // NaN is not beside it.
        let least = -margin * length * longest;
        edges
            .into_iter()
            .zip(corners)
            .any(|(edge, corner)| self.normal.cross(edge).dot(crossing - corner) < least)
    }
}
