//! Visible parts of lines as lines of figures.

use ugimage::figure::Element;

use super::color::{Levels, Palette, distance, mean, rounded};
use super::patch::Patch;
use crate::lines::{Stroke, between, hidden_by};
use crate::planar::BoxIndex;

/// How much colour changes along a piece of a line, in levels of 255.
const STEP: f64 = 4.0;

/// Shorter pieces of lines, in pixels, are not cut for their colour.
const LEAST: f64 = 0.5;

/// Shorter parts of lines before or behind panes, in pixels, are not drawn for themselves.
const SHORTEST: f64 = 0.01;

/// Translucent faces that may stand before lines.
pub struct Panes<'a> {
    pub patches: &'a [Patch],
    pub index: &'a BoxIndex,
}

impl Panes<'_> {
    /// Of a line, the parts of the way on which panes are nearer, and which.
    fn before(&self, stroke: &Stroke) -> Vec<([f64; 2], usize)> {
        let [a, b] = stroke.ends.map(|end| [end.x, end.y, end.key]);
        let near = self.index.in_box(stroke.bounds()).into_iter().filter(|&idx| self.patches[idx].is_clear);
        let parts = near.flat_map(|idx| self.patches[idx].parts.iter().map(move |part| (idx, part)));
        parts.filter_map(|(idx, part)| hidden_by(part, a, b).map(|way| (way, idx))).collect()
    }
}

/// Adds lines of this width, the farthest first, so that of two that cross the nearer is seen.
pub fn push_lines<S>(
    palette: &Palette<'_>,
    panes: &Panes<'_>,
    mut strokes: Vec<Stroke>,
    width: f64,
    elements: &mut Vec<Element<S>>,
) {
    // Single precision, as in the raster: what differs by rounding is equally near.
    let key = |Stroke { ends: [a, b], .. }: &Stroke| (a.key + b.key) as f32;
    // Of what is equally near the first is seen, as in the raster.
    strokes.reverse();
    strokes.sort_by(|one, other| key(one).total_cmp(&key(other)));
    for stroke in &strokes {
        let before = panes.before(stroke);
        for way in cuts(stroke, &before).windows(2) {
            let middle = 0.5 * (way[0] + way[1]);
            let is_before = |([start, end], _): &&([f64; 2], usize)| (*start..=*end).contains(&middle);
            let panes: Vec<&Patch> =
                before.iter().filter(is_before).map(|(_, idx)| &panes.patches[*idx]).collect();
            push_line(palette, stroke, [way[0], way[1]], &panes, width, elements);
        }
    }
}

/// The ends of a line, and where panes begin or end to be before it.
fn cuts(stroke: &Stroke, before: &[([f64; 2], usize)]) -> Vec<f64> {
    let [a, b] = &stroke.ends;
    let length = libm::hypot(b.x - a.x, b.y - a.y);
    let mut cuts: Vec<f64> = before.iter().flat_map(|(way, _)| *way).collect();
    // What is shorter comes from rounding.
    cuts.retain(|cut| cut.min(1.0 - cut) * length > SHORTEST);
    cuts.sort_by(f64::total_cmp);
    cuts.dedup_by(|next, last| (*next - *last) * length < SHORTEST);
    [vec![0.0], cuts, vec![1.0]].concat()
}

/// Adds a part of a line in pieces of one colour.
fn push_line<S>(
    palette: &Palette<'_>,
    stroke: &Stroke,
    way: [f64; 2],
    panes: &[&Patch],
    width: f64,
    elements: &mut Vec<Element<S>>,
) {
    let Stroke { ends: [a, b], is_end, .. } = stroke;
    let length = libm::hypot(b.x - a.x, b.y - a.y);
    // An end stands out by half the width.
    let out = if length > 0.0 { 0.5 * width / length } else { 0.0 };
    let place = |part: f64| {
        let part = match part {
            0.0 if is_end[0] => -out,
            1.0 if is_end[1] => 1.0 + out,
            part => part,
        };
        [a.x + (b.x - a.x) * part, a.y + (b.y - a.y) * part]
    };
    let color = |part: f64| -> Levels { palette.on_line(&between(a, b, part), panes.iter().copied()) };
    let mut stack = vec![way];
    while let Some([start, end]) = stack.pop() {
        let middle = 0.5 * (start + end);
        let (first, last, between) = (color(start), color(end), color(middle));
        let change = distance(first, between).max(distance(between, last)).max(distance(first, last));
        if change > STEP && (end - start) * length > LEAST {
            stack.extend([[middle, end], [start, middle]]);
            continue;
        }
        let color = rounded(mean(mean(first, last), between));
        elements.push(Element::Line { ends: [place(start), place(end)], width, color });
    }
}
