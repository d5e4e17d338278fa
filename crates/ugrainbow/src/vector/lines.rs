//! Visible parts of lines as lines of figures.

use ugimage::figure::Element;

use super::color::{Levels, Palette, distance, mean, rounded};
use crate::lines::{Stroke, between};

/// How much colour changes along a piece of a line, in levels of 255.
const STEP: f64 = 4.0;

/// Shorter pieces of lines, in pixels, are not cut for their colour.
const LEAST: f64 = 0.5;

/// Adds lines of this width, the farthest first, so that of two that cross the nearer is seen.
pub fn push_lines<S>(
    palette: &Palette<'_>,
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
        push_line(palette, stroke, width, elements);
    }
}

/// Adds a line in pieces of one colour.
fn push_line<S>(palette: &Palette<'_>, stroke: &Stroke, width: f64, elements: &mut Vec<Element<S>>) {
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
    let color = |part: f64| -> Levels { palette.on_line(&between(a, b, part)) };
    let mut stack = vec![[0.0, 1.0]];
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
