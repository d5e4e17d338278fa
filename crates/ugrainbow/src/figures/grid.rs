//! A grid of coordinates on the ground: in the plane z = 0, or under what reaches lower.
//!
//! It is at rest where the picture is taken, in the coordinates of the scene, and spans the box round everything as it
//! is seen. What is seen in front of it hides it.

use glam::DVec3;
use uglabel::{DESCENT, Drawing, Line, MissingCharacter, Point};
use ugscene::View;

use super::depths::Depths;
use super::style::Style;
use crate::setup::Setup;
use uglabel::number::significant;

/// Squares there should be on a ground that is a square, along a side.
const SQUARES: f64 = 8.0;

/// Most squares along a side.
const MOST: f64 = 40.0;

/// Size of numbers, in parts of that of a caption.
const TEXT: f64 = 0.8;

/// Draws the grid. `setup`: with one sample for each pixel, of which `depths` are.
///
/// # Errors
/// None, for the font has all that is written.
pub fn draw(
    setup: &Setup<'_>,
    depths: &Depths,
    style: &Style,
    drawing: &mut Drawing,
) -> Result<Option<String>, MissingCharacter> {
    let Some(grid) = Grid::of(setup) else { return Ok(None) };
    let view = &setup.view;
    let mut lines = Vec::new();
    for axis in 0..2 {
        for number in grid.numbers(axis) {
            let [low, high] = grid.ends[1 - axis];
            let ends = [low, high].map(|across| grid.point(axis, number, across) - view.eye);
            lines.extend(depths.visible(view, ends));
        }
    }
    let is_empty = lines.is_empty();
    drawing.lines(lines, style.hairline(), style.faint);
    let mut labels = Labels { grid: &grid, view, depths, style, boxes: Vec::new(), size: setup.size() };
    for axis in 0..2 {
        labels.draw(axis, drawing)?;
    }
    let (step, level) = (significant(grid.step, 4), significant(grid.level, 4));
    Ok(Some(if is_empty {
        format!("no line of the grid (-gr) is in the picture; it lies in the plane z = {level}")
    } else {
        format!("the lines of the grid (-gr) are {step} apart, in the plane z = {level}")
    }))
}

/// Lines at multiples of a step.
struct Grid {
    step: f64,
    /// z
    level: f64,
    /// Numbers of the first and the last line, of x and of y.
    ends: [[i64; 2]; 2],
}

impl Grid {
    /// None if the scene is too far away for numbers.
    fn of(setup: &Setup<'_>) -> Option<Self> {
        let (low, high) = setup.scene().bounds()?;
        let sides = [high.x - low.x, high.y - low.y];
        let longest = sides[0].max(sides[1]);
        let longest = if longest > 0.0 { longest } else { setup.view.distance };
        let mean = libm::sqrt(sides[0] * sides[1]);
        let step = round_step((mean / SQUARES).max(longest / MOST));
        let ends = [[low.x, high.x], [low.y, high.y]]
            .map(|[low, high]| [(low / step).floor(), (high / step).ceil()]);
        // Beyond, a line is not told from the next.
        let is_near = ends.iter().flatten().all(|end| end.abs() < 1e9);
        let level = if low.z < -1e-9 * longest { low.z } else { 0.0 };
        is_near.then(|| Self { step, level, ends: ends.map(|ends| ends.map(|end| end as i64)) })
    }

    fn numbers(&self, axis: usize) -> impl Iterator<Item = i64> + use<> {
        let [low, high] = self.ends[axis];
        low..=high
    }

    /// Where the line of a number of an axis meets that of a number of the other, scene coordinates.
    fn point(&self, axis: usize, number: i64, across: i64) -> DVec3 {
        let (along, across) = (number as f64 * self.step, across as f64 * self.step);
        if axis == 0 { DVec3::new(along, across, self.level) } else { DVec3::new(across, along, self.level) }
    }
}

/// The least of 1, 2, 5, 10, 20, … and .5, .2, … that is not less.
fn round_step(least: f64) -> f64 {
    let power = libm::exp10(libm::log10(least).floor());
    // Rounding may put a power of ten on either side of itself.
    [1.0, 2.0, 5.0, 10.0]
        .map(|factor| factor * power)
        .into_iter()
        .find(|step| *step >= least * (1.0 - 1e-9))
        .unwrap_or(10.0 * power)
}

/// Numbers at the ends of lines, on the side that is nearer to the eye.
struct Labels<'a> {
    grid: &'a Grid,
    view: &'a View,
    depths: &'a Depths,
    style: &'a Style,
    /// Of those drawn: left upper and right lower corner.
    boxes: Vec<[Point; 2]>,
    /// Of the picture.
    size: [f64; 2],
}

impl Labels<'_> {
    fn draw(&mut self, axis: usize, drawing: &mut Drawing) -> Result<(), MissingCharacter> {
        let grid = self.grid;
        let near = self.near_side(axis);
        let [low, high] = grid.ends[1 - axis];
        let far = if near == low { high } else { low };
        let mut name = Some(["x", "y"][axis]);
        for number in grid.numbers(axis) {
            let [end, other] = [near, far].map(|across| grid.point(axis, number, across) - self.view.eye);
            let Some(spot) = self.depths.shows(self.view, end) else { continue };
            let text = significant(number as f64 * grid.step, 6);
            let text = name.map_or_else(|| text.clone(), |name| format!("{name} = {text}"));
            let line = Line::new(&text, TEXT * self.style.size)?;
            let beyond = end + (end - other) * 1e-3;
            if self.push(&line, spot, self.direction(end, beyond), drawing) {
                name = None;
            }
        }
        Ok(())
    }

    /// The side of the ground at which lines of an axis have their numbers.
    fn near_side(&self, axis: usize) -> i64 {
        let ends = self.grid.ends;
        let middle = (ends[axis][0] + ends[axis][1]) / 2;
        let [low, high] = ends[1 - axis];
        let distance = |across: i64| (self.grid.point(axis, middle, across) - self.view.eye).length();
        // Of equals the one whose coordinate is greater.
        if distance(low) < distance(high) * (1.0 - 1e-9) { low } else { high }
    }

    /// The direction in the picture in which a line leaves the ground.
    fn direction(&self, end: DVec3, beyond: DVec3) -> [f64; 2] {
        let [a, b] = [end, beyond].map(|point| {
            let place = self.view.place(point);
            let w = if self.view.is_perspective { place.z } else { 1.0 };
            [place.x / w, place.y / w]
        });
        let [x, y] = [b[0] - a[0], b[1] - a[1]];
        let length = libm::hypot(x, y);
        if length > 0.0 && length.is_finite() { [x / length, y / length] } else { [0.0, 1.0] }
    }

    /// Draws a number beyond the end of its line, unless it has no room.
    fn push(&mut self, line: &Line, [x, y]: Point, [right, down]: [f64; 2], drawing: &mut Drawing) -> bool {
        let size = TEXT * self.style.size;
        let half = [0.5 * line.width(), 0.4 * size];
        let away = 0.5 * size;
        // As far from the end as the box needs in this direction.
        let middle = [x + right * (half[0] + away), y + down * (half[1] + away)];
        let gap = 0.3 * size;
        let low = [middle[0] - half[0] - gap, middle[1] - half[1] - gap];
        let high = [middle[0] + half[0] + gap, middle[1] + half[1] + DESCENT * size];
        let is_inside = low.iter().all(|edge| *edge >= 0.0) && (0..2).all(|i| high[i] <= self.size[i]);
        let is_free = self
            .boxes
            .iter()
            .all(|[other_low, other_high]| (0..2).any(|i| high[i] < other_low[i] || low[i] > other_high[i]));
        if !(is_inside && is_free) {
            return false;
        }
        self.boxes.push([low, high]);
        drawing.text(line, [middle[0] - half[0], (middle[1] + half[1]).round()], self.style.ink);
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_round_and_not_less() {
        let rows =
            [(1.0, 1.0), (1.01, 2.0), (2.5, 5.0), (7.0, 10.0), (0.03, 0.05), (1000.0, 1000.0), (1e-7, 1e-7)];
        for (least, step) in rows {
            assert!((round_step(least) / step - 1.0).abs() < 1e-12, "{least} {}", round_step(least));
        }
    }
}
