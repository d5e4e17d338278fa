//! Visible parts of lines as lines of figures.

use ugimage::figure::Element;

use super::color::{FigureColors, Levels, distance, mean, rounded};
use super::patch::Patch;
use crate::lines::{Stroke, between, occluded_part};
use crate::planar::BoxIndex;

/// Greatest change of colour along a piece of a line, in levels of 255.
const STEP: f64 = 4.0;

/// Length in pixels of pieces that are not subdivided for their colour.
const LEAST: f64 = 0.5;

/// Least length in pixels of the parts that translucent faces divide a line into.
const SHORTEST: f64 = 0.01;

/// Translucent faces that may cover lines.
pub struct TransparentPatches<'a> {
    pub patches: &'a [Patch],
    pub index: &'a BoxIndex,
}

impl TransparentPatches<'_> {
    /// The parts of a line, as parameters in 0…1, in front of which there are translucent patches,
    /// and their numbers.
    fn before(&self, stroke: &Stroke) -> Vec<([f64; 2], usize)> {
        let [a, b] = stroke.ends.map(|end| [end.x, end.y, end.key]);
        let near = self
            .index
            .in_box(stroke.bounds())
            .into_iter()
            .filter(|&idx| self.patches[idx].is_transparent);
        let parts =
            near.flat_map(|idx| self.patches[idx].parts.iter().map(move |part| (idx, part)));
        parts.filter_map(|(idx, part)| occluded_part(part, a, b).map(|way| (way, idx))).collect()
    }
}

/// Adds lines of this width from back to front, so that the nearer of two that cross is visible.
pub fn push_lines<S>(
    colors: &FigureColors<'_>,
    in_front: &TransparentPatches<'_>,
    mut strokes: Vec<Stroke>,
    width: f64,
    elements: &mut Vec<Element<S>>,
) {
    // Single precision, as in the rasterizer, so that differences by rounding are ties.
    let key = |Stroke { ends: [a, b], .. }: &Stroke| (a.key + b.key) as f32;
    // The first of equally near lines wins, as in the rasterizer.
    strokes.reverse();
    strokes.sort_by(|one, other| key(one).total_cmp(&key(other)));
    for stroke in &strokes {
        let before = in_front.before(stroke);
        for way in cuts(stroke, &before).windows(2) {
            let middle = 0.5 * (way[0] + way[1]);
            let is_before =
                |([start, end], _): &&([f64; 2], usize)| (*start..=*end).contains(&middle);
            let in_front: Vec<&Patch> =
                before.iter().filter(is_before).map(|(_, idx)| &in_front.patches[*idx]).collect();
            push_line(colors, stroke, [way[0], way[1]], &in_front, width, elements);
        }
    }
}

/// The ends of a line, and where translucent patches begin or end to cover it.
fn cuts(stroke: &Stroke, before: &[([f64; 2], usize)]) -> Vec<f64> {
    let [a, b] = &stroke.ends;
    let length = libm::hypot(b.x - a.x, b.y - a.y);
    let mut cuts: Vec<f64> = before.iter().flat_map(|(way, _)| *way).collect();
    // Shorter parts are due to rounding.
    cuts.retain(|cut| cut.min(1.0 - cut) * length > SHORTEST);
    cuts.sort_by(f64::total_cmp);
    cuts.dedup_by(|next, last| (*next - *last) * length < SHORTEST);
    [vec![0.0], cuts, vec![1.0]].concat()
}

/// Adds a part of a line in pieces of one colour.
fn push_line<S>(
    colors: &FigureColors<'_>,
    stroke: &Stroke,
    way: [f64; 2],
    in_front: &[&Patch],
    width: f64,
    elements: &mut Vec<Element<S>>,
) {
    let Stroke { ends: [a, b], is_end, .. } = stroke;
    let (length, width) = (libm::hypot(b.x - a.x, b.y - a.y), width * stroke.width);
    // A line extends beyond its end by half its width.
    let out = if length > 0.0 { 0.5 * width / length } else { 0.0 };
    let place = |part: f64| {
        let part = match part {
            0.0 if is_end[0] => -out,
            1.0 if is_end[1] => 1.0 + out,
            part => part,
        };
        [a.x + (b.x - a.x) * part, a.y + (b.y - a.y) * part]
    };
    let color =
        |part: f64| -> Levels { colors.on_line(&between(a, b, part), in_front.iter().copied()) };
    let mut stack = vec![way];
    while let Some([start, end]) = stack.pop() {
        let middle = 0.5 * (start + end);
        let (first, last, between) = (color(start), color(end), color(middle));
        let change =
            distance(first, between).max(distance(between, last)).max(distance(first, last));
        if change > STEP && (end - start) * length > LEAST {
            stack.extend([[middle, end], [start, middle]]);
            continue;
        }
        let color = rounded(mean(mean(first, last), between));
        elements.push(Element::Line { ends: [place(start), place(end)], width, color });
    }
}
