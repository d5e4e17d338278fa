//! Wires as lines without their hidden parts.

use ugimage::figure::Element;

use super::color::{Levels, Palette, distance, mean, rounded};
use super::convex::{Convex, Place};
use super::index::Index;
use super::patch::Patch;

/// The width of a wire in pixels.
const WIDTH: f64 = 1.2;

/// How much colour changes along a piece of a line, in levels of 255.
const STEP: f64 = 4.0;

/// Shorter pieces of lines, in pixels, are not cut for their colour.
const LEAST: f64 = 0.5;

/// Adds the visible parts of wires, the farthest first, so that of two that cross the nearer is seen.
///
/// `scale`: how many rows of the draw list are a pixel, by which the strips are too thin.
pub fn push_lines<S>(
    palette: &Palette<'_>,
    wires: &[Patch],
    faces: &[Patch],
    index: &Index,
    size: [u32; 2],
    scale: f64,
    elements: &mut Vec<Element<S>>,
) {
    // Ends stand out by half the width.
    let shorten = 0.5 * WIDTH / scale - 0.5 * WIDTH;
    let picture = near_picture(size);
    let mut lines = Vec::new();
    for wire in wires {
        let Some([a, b]) = wire.line(shorten) else { continue };
        let Some([start, end]) = picture.as_ref().and_then(|picture| picture.over(a, b)) else { continue };
        let (a, b) = (along(a, b, start), along(a, b, end));
        for [start, end] in visible(a, b, faces, index) {
            lines.push((wire, [along(a, b, start), along(a, b, end)]));
        }
    }
    let key = |[a, b]: &[Place; 2]| a[2] + b[2];
    lines.sort_by(|(_, one), (_, other)| key(one).total_cmp(&key(other)));
    for (wire, ends) in lines {
        let color = |[x, y, _]: Place| palette.at(wire, [x, y]);
        push_line(&color, ends, elements);
    }
}

/// The picture and a little around it, beyond which lines are not drawn.
fn near_picture(size: [u32; 2]) -> Option<Convex> {
    let [low, right, bottom] = [-WIDTH, f64::from(size[0]) + WIDTH, f64::from(size[1]) + WIDTH];
    Convex::new(vec![[low, low, 0.0], [right, low, 0.0], [right, bottom, 0.0], [low, bottom, 0.0]])
}

fn along(a: Place, b: Place, part: f64) -> Place {
    [0, 1, 2].map(|i| a[i] + (b[i] - a[i]) * part)
}

/// Adds a line in pieces of one colour.
fn push_line<S>(color: &impl Fn(Place) -> Levels, ends: [Place; 2], elements: &mut Vec<Element<S>>) {
    let mut stack = vec![ends];
    while let Some([a, b]) = stack.pop() {
        let middle = along(a, b, 0.5);
        let (first, last, between) = (color(a), color(b), color(middle));
        let change = distance(first, between).max(distance(between, last)).max(distance(first, last));
        if change > STEP && libm::hypot(b[0] - a[0], b[1] - a[1]) > LEAST {
            stack.extend([[middle, b], [a, middle]]);
            continue;
        }
        let color = rounded(mean(mean(first, last), between));
        elements.push(Element::Line { ends: [[a[0], a[1]], [b[0], b[1]]], width: WIDTH, color });
    }
}

/// The parts of the way from `a` to `b` that no face hides.
fn visible(a: Place, b: Place, faces: &[Patch], index: &Index) -> Vec<[f64; 2]> {
    let low = [0, 1].map(|axis| a[axis].min(b[axis]));
    let high = [0, 1].map(|axis| a[axis].max(b[axis]));
    let parts = index.in_box([low, high]).flat_map(|idx| &faces[idx].parts);
    let mut hidden: Vec<[f64; 2]> = parts.filter_map(|part| hidden_by(part, a, b)).collect();
    hidden.sort_by(|one, other| one[0].total_cmp(&other[0]));
    let (mut shown, mut reached) = (Vec::new(), 0.0f64);
    for [start, end] in hidden {
        if start > reached {
            shown.push([reached, start]);
        }
        reached = reached.max(end);
    }
    if reached < 1.0 {
        shown.push([reached, 1.0]);
    }
    shown
}

/// The part of the way on which `part` is nearer.
fn hidden_by(part: &Convex, a: Place, b: Place) -> Option<[f64; 2]> {
    let [start, end] = part.over(a, b)?;
    let ahead = |at: f64| {
        let [x, y, key] = along(a, b, at);
        part.key(x, y) - key
    };
    let (first, last) = (ahead(start), ahead(end));
    let crossing = start + (end - start) * first / (first - last);
    match (first > 0.0, last > 0.0) {
        (true, true) => Some([start, end]),
        (true, false) => Some([start, crossing]),
        (false, true) => Some([crossing, end]),
        (false, false) => None,
    }
}
