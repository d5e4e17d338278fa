//! Lines along which a quantity of what is seen has the same value.

use std::ops::Range;

use ugimage::figure::Point;
use ugimage::label::{Drawing, Line, MissingCharacter};
use ugphysics::length;
use ugscene::{BodyId, Scene};

use super::map::Scale;
use super::style::Style;
use crate::emission::SeenItem;
use crate::quantity::{IsoOptions, MapOptions};
use crate::units::Units;

/// Between neighbouring pixels whose distances differ by more than this part there is an edge,
/// which is no place for a line.
const EDGE: f64 = 0.05;

/// Size of numbers relative to that of a caption.
const TEXT: f64 = 0.8;

/// What is seen at the middle of a pixel.
#[derive(Clone, Copy)]
struct Seen {
    body: Option<BodyId>,
    value: f64,
    distance: f64,
}

/// Draws the lines of a picture `size` pixels large, and a number on each. `item`: what is seen at
/// the middles of pixels, row after row.
///
/// # Errors
/// Never, because the font has all its characters.
pub fn draw(
    options: &IsoOptions,
    units: &Units,
    size: [u32; 2],
    scene: Option<&Scene>,
    item: &dyn Fn(usize) -> Option<SeenItem>,
    style: &Style,
    drawing: &mut Drawing,
) -> Result<(), MissingCharacter> {
    let [width, height] = size.map(|side| side as usize);
    let seen = |idx: usize| {
        let (item, emission) = item(idx)?;
        let face = scene.and_then(|scene| scene.faces.get(item as usize));
        let (value, distance) = (options.quantity.of(&emission), length(emission.place));
        Some(Seen { body: face.map(|face| face.body), value, distance })
    };
    let seen: Vec<Option<Seen>> = (0..width * height).map(seen).collect();
    let mut values = options.values.clone();
    let all: Vec<f32> = seen.iter().flatten().map(|seen| seen.value as f32).collect();
    let scale = Scale::new(&MapOptions { quantity: options.quantity, range: None }, &all, units);
    if values.is_empty() {
        values = scale.ticks().into_iter().map(|(value, _)| value).collect();
    }
    for value in values {
        let mut lines = Vec::new();
        for row in 1..height {
            for column in 1..width {
                let corner = |right: usize, below: usize| {
                    seen[(row + below - 1) * width + column + right - 1]
                };
                let corners = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
                let [Some(a), Some(b), Some(c), Some(d)] = corners else { continue };
                let corners = [a, b, c, d];
                let far = corners.iter().map(|seen| seen.distance).fold(0.0, f64::max);
                let near = corners.iter().map(|seen| seen.distance).fold(f64::INFINITY, f64::min);
                if corners.iter().any(|seen| seen.body != a.body) || far - near > EDGE * far {
                    continue;
                }
                let upper_left = [column, row].map(|at| at as f64 - 0.5);
                push_lines(corners.map(|seen| seen.value - value), upper_left, &mut lines);
            }
        }
        if lines.is_empty() {
            continue;
        }
        let line = Line::new(&scale.written(value), TEXT * style.size)?;
        let half = [0.5 * line.width() + 0.15 * style.size, 0.45 * style.size];
        let label =
            middle(&lines, [0, 1].map(|axis| half[axis]..f64::from(size[axis]) - half[axis]));
        drawing.lines(lines.clone(), 3.0 * style.hairline, style.background);
        drawing.lines(lines, 1.2 * style.hairline, style.ink);
        drawing.rectangle(
            [label[0] - half[0], label[1] - half[1]],
            [label[0] + half[0], label[1] + half[1]],
            style.background,
        );
        let base = label[1] + 0.29 * style.size;
        drawing.text(&line, [label[0] - 0.5 * line.width(), base], style.ink);
    }
    Ok(())
}

/// Adds the line along which a quantity is 0 in a square of side 1. `values`: at its corners,
/// clockwise from the upper left one.
fn push_lines(values: [f64; 4], [left, top]: Point, lines: &mut Vec<[Point; 2]>) {
    const CORNERS: [Point; 4] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let crossing = |side: usize| {
        let (from, to) = (side, (side + 1) % 4);
        let part = values[from] / (values[from] - values[to]);
        [0, 1].map(|axis| {
            [left, top][axis]
                + CORNERS[from][axis]
                + part * (CORNERS[to][axis] - CORNERS[from][axis])
        })
    };
    let is_crossed = |side: &usize| (values[*side] < 0.0) != (values[(side + 1) % 4] < 0.0);
    let crossed: Vec<usize> = (0..4).filter(is_crossed).collect();
    match crossed[..] {
        [a, b] => lines.push([crossing(a), crossing(b)]),
        // A saddle: its middle belongs to two of the corners.
        [_, _, _, _] => {
            let joins_first = (values.iter().sum::<f64>() < 0.0) == (values[0] < 0.0);
            let pairs = if joins_first { [[0, 1], [2, 3]] } else { [[3, 0], [1, 2]] };
            lines.extend(pairs.map(|pair| pair.map(crossing)));
        }
        _ => {}
    }
}

/// The middle of the line that is nearest to the mean of all, of those in an area if there are
/// some.
fn middle(lines: &[[Point; 2]], area: [Range<f64>; 2]) -> Point {
    let middle = |[a, b]: &[Point; 2]| [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
    let n = lines.len() as f64;
    let mean =
        lines.iter().map(middle).fold([0.0; 2], |sum, at| [sum[0] + at[0] / n, sum[1] + at[1] / n]);
    let apart =
        |at: &Point| (at[0] - mean[0]) * (at[0] - mean[0]) + (at[1] - mean[1]) * (at[1] - mean[1]);
    let is_outside = |at: &Point| !(area[0].contains(&at[0]) && area[1].contains(&at[1]));
    let order = |a: &Point, b: &Point| {
        is_outside(a).cmp(&is_outside(b)).then(apart(a).total_cmp(&apart(b)))
    };
    lines.iter().map(middle).min_by(order).unwrap_or(mean)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_saddle_has_two_lines() {
        for values in [[1.0, -2.0, 1.0, -2.0], [2.0, -1.0, 2.0, -1.0]] {
            let mut lines = Vec::new();
            push_lines(values, [0.0, 0.0], &mut lines);
            assert_eq!(lines.len(), 2, "{values:?}");
            // No line separates the corners that the mean joins.
            let crosses_middle = lines.iter().any(|[a, b]| {
                let mid = [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
                libm::hypot(mid[0] - 0.5, mid[1] - 0.5) < 0.1
            });
            assert!(!crosses_middle, "{lines:?}");
        }
    }
}
