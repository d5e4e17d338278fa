//! Visible parts of lines as lines of figures.

use ugimage::figure::Element;

use super::color::{Levels, Palette, distance, mean, rounded};
use super::convex::Place;
use super::index::Index;
use super::patch::Patch;
use crate::lines::{Stroke, between, hidden_by};

/// How much colour changes along a piece of a line, in levels of 255.
const STEP: f64 = 4.0;

/// Shorter pieces of lines, in pixels, are not cut for their colour.
const LEAST: f64 = 0.5;

/// What lines are drawn over, and how.
pub struct Lines<'a> {
    pub palette: &'a Palette<'a>,
    pub faces: &'a [Patch],
    pub index: &'a Index,
    /// Of lines, in pixels.
    pub width: f64,
}

impl Lines<'_> {
    /// Adds lines, the farthest first, so that of two that cross the nearer is seen.
    pub fn push<S>(&self, mut strokes: Vec<Stroke>, elements: &mut Vec<Element<S>>) {
        let key = |Stroke { ends: [a, b], .. }: &Stroke| a.key + b.key;
        strokes.sort_by(|one, other| key(one).total_cmp(&key(other)));
        for stroke in &strokes {
            for (part, panes) in self.behind_panes(stroke) {
                self.push_stroke(stroke, part, &panes, elements);
            }
        }
    }

    /// The parts of a line, each with the panes before it, from behind.
    fn behind_panes(&self, stroke: &Stroke) -> Vec<([f64; 2], Vec<usize>)> {
        let [a, b] = places(stroke);
        let mut panes = Vec::new();
        for idx in self.index.in_box(stroke.bounds()) {
            let parts = self.faces[idx].parts.iter().filter(|_| self.faces[idx].is_clear);
            panes.extend(parts.filter_map(|part| Some((hidden_by(part, a, b)?, idx, part))));
        }
        let mut cuts: Vec<f64> = panes.iter().flat_map(|(part, ..)| *part).chain([0.0, 1.0]).collect();
        cuts.sort_by(f64::total_cmp);
        cuts.dedup();
        let before = |part: [f64; 2]| {
            let middle = 0.5 * (part[0] + part[1]);
            let [x, y] = [0, 1].map(|axis| a[axis] + (b[axis] - a[axis]) * middle);
            let mut here: Vec<(f64, usize)> = panes
                .iter()
                .filter(|([start, end], ..)| (*start..*end).contains(&middle))
                .map(|(_, idx, part)| (part.key(x, y), *idx))
                .collect();
            here.sort_by(|one, other| one.0.total_cmp(&other.0));
            (part, here.into_iter().map(|(_, idx)| idx).collect())
        };
        cuts.windows(2).map(|pair| before([pair[0], pair[1]])).collect()
    }

    /// Adds a part of a line in pieces of one colour.
    fn push_stroke<S>(
        &self,
        stroke: &Stroke,
        part: [f64; 2],
        panes: &[usize],
        elements: &mut Vec<Element<S>>,
    ) {
        let panes: Vec<&Patch> = panes.iter().map(|&idx| &self.faces[idx]).collect();
        let color = |at: f64| -> Levels {
            self.palette.on_line(&between(&stroke.ends[0], &stroke.ends[1], at), &panes)
        };
        let [a, b] = places(stroke);
        let length = libm::hypot(b[0] - a[0], b[1] - a[1]);
        // An end stands out by half the width.
        let out = if length > 0.0 { 0.5 * self.width / length } else { 0.0 };
        let place = |at: f64| {
            let beyond = match at {
                0.0 if stroke.is_end[0] => -out,
                1.0 if stroke.is_end[1] => 1.0 + out,
                at => at,
            };
            [0, 1].map(|axis| a[axis] + (b[axis] - a[axis]) * beyond)
        };
        let mut stack = vec![part];
        while let Some([start, end]) = stack.pop() {
            let middle = 0.5 * (start + end);
            let (first, last, between) = (color(start), color(end), color(middle));
            let change = distance(first, between).max(distance(between, last)).max(distance(first, last));
            if change > STEP && (end - start) * length > LEAST {
                stack.extend([[middle, end], [start, middle]]);
                continue;
            }
            let color = rounded(mean(mean(first, last), between));
            elements.push(Element::Line { ends: [place(start), place(end)], width: self.width, color });
        }
    }
}

fn places(stroke: &Stroke) -> [Place; 2] {
    stroke.ends.map(|end| [end.x, end.y, end.key])
}
