//! Lines along which a quantity of what is seen has the same value.

use ugimage::figure::Point;
use ugimage::label::{Drawing, Line, MissingCharacter};
use ugphysics::length;
use ugscene::{BodyId, Scene};

use super::labels::{Rectangle, is_free};
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

/// What is seen in a picture.
pub struct Field<'a> {
    /// Its pixels across and down.
    pub size: [u32; 2],
    /// The scene, if there is one.
    pub scene: Option<&'a Scene>,
    /// What is seen at the middles of pixels, row after row.
    pub item: &'a dyn Fn(usize) -> Option<SeenItem>,
}

/// Draws the lines, and a number on each where there is room. `taken`: the parts of the picture
/// that other text covers, to which those of the numbers are added.
///
/// # Errors
/// Never, because the font has all its characters.
pub fn draw(
    options: &IsoOptions,
    units: &Units,
    &Field { size, scene, item }: &Field<'_>,
    style: &Style,
    taken: &mut Vec<Rectangle>,
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
    let mut all_lines = Vec::new();
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
        if !lines.is_empty() {
            drawing.lines(lines.clone(), 3.0 * style.hairline, style.background);
            drawing.lines(lines.clone(), 1.2 * style.hairline, style.ink);
            all_lines.push((value, lines));
        }
    }
    // No line is drawn over a number.
    for (value, lines) in all_lines {
        let line = Line::new(&scale.written(value), TEXT * style.size)?;
        let half = [0.5 * line.width() + 0.15 * style.size, 0.45 * style.size];
        let Some(label @ [low, high]) = free_place(&lines, half, size.map(f64::from), taken) else {
            continue;
        };
        taken.push(label);
        drawing.rectangle(low, high, style.background);
        let base = 0.5 * (low[1] + high[1]) + 0.29 * style.size;
        drawing.text(&line, [0.5 * (low[0] + high[0] - line.width()), base], style.ink);
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

/// The box of a number with these half sides: around the middle of the piece that is nearest to the
/// mean of all, of those that leave it in the picture if there are some. `None` where other text
/// is everywhere.
fn free_place(
    lines: &[[Point; 2]],
    half: [f64; 2],
    picture: [f64; 2],
    taken: &[Rectangle],
) -> Option<Rectangle> {
    let middle = |[a, b]: &[Point; 2]| [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
    let n = lines.len() as f64;
    let mean =
        lines.iter().map(middle).fold([0.0; 2], |sum, at| [sum[0] + at[0] / n, sum[1] + at[1] / n]);
    let apart =
        |at: &Point| (at[0] - mean[0]) * (at[0] - mean[0]) + (at[1] - mean[1]) * (at[1] - mean[1]);
    let around = |at: &Point| {
        let corner = |sign: f64| [0, 1].map(|axis| at[axis] + sign * half[axis]);
        [corner(-1.0), corner(1.0)]
    };
    let is_outside = |at: &Point| {
        let [low, high] = around(at);
        !(0..2).all(|axis| low[axis] >= 0.0 && high[axis] < picture[axis])
    };
    let order = |a: &Point, b: &Point| {
        is_outside(a).cmp(&is_outside(b)).then(apart(a).total_cmp(&apart(b)))
    };
    let free = lines.iter().map(middle).filter(|at| is_free(&around(at), taken));
    free.min_by(order).map(|at| around(&at))
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

    /// The number of a second line through the same places is beside that of the first, or there is
    /// none.
    #[test]
    fn numbers_are_apart() {
        let lines: Vec<_> =
            (0..40).map(|x| [[f64::from(x), 9.0], [f64::from(x + 1), 9.0]]).collect();
        let place = |taken: &[Rectangle]| free_place(&lines, [5.0, 3.0], [40.0, 20.0], taken);
        let first = place(&[]).unwrap();
        assert!((first[0][0] + first[1][0] - 40.0).abs() < 2.0, "{first:?}");
        let second = place(&[first]).unwrap();
        assert!(is_free(&second, &[first]) && second[0][0] >= 0.0 && second[1][0] < 40.0);
        assert_eq!(place(&[[[0.0, 0.0], [40.0, 20.0]]]), None);
    }
}
