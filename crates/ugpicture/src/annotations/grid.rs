//! A coordinate grid on the ground: in the plane z = 0, or at the lowest point of the scene if that
//! is lower.
//!
//! It is at rest in the frame of the camera, in the coordinates of the scene, and spans the
//! bounding box of all apparent positions. Surfaces in front occlude it.

use glam::DVec3;
use ugimage::figure::Point;
use ugimage::label::number::significant;
use ugimage::label::{DESCENT, Drawing, Line, MissingCharacter};

use super::labels::{Rectangle, is_free};
use super::seen::SeenScene;
use super::style::Style;
use crate::error::Error;
use crate::line::in_picture;
use crate::note::Note;
use crate::units::{Unit, Units};

/// Squares side by side in the picture, counted a quarter above its lower edge; decides their size.
const SQUARES: f64 = 8.0;

/// Most squares along a side.
const MOST: f64 = 100.0;

/// Size of the numbers relative to that of a caption.
const TEXT: f64 = 0.8;

/// Draws the visible parts of the grid. Returns a note. `taken`: the boxes of text in the picture,
/// to which those of its numbers are added.
pub fn draw<E: From<Error>>(
    seen: &SeenScene<'_, E>,
    units: &Units,
    style: &Style,
    taken: &mut Vec<Rectangle>,
    drawing: &mut Drawing,
) -> Result<Option<Note>, E> {
    let Some(grid) = GroundGrid::new(seen, units.length()) else { return Ok(None) };
    let line = |(axis, number): (usize, i64)| {
        let [low, high] = grid.ends[1 - axis];
        [low, high].map(|across| grid.point(axis, number, across) - seen.view.eye)
    };
    let both =
        [0, 1].into_iter().flat_map(|axis| grid.numbers(axis).map(move |number| (axis, number)));
    let lines = seen.visible(seen.scene.clone(), &both.map(line).collect::<Vec<_>>())?;
    drawing.lines(lines.clone(), style.hairline, style.faint);
    let mut labels = Labels { grid: &grid, seen, visible: &lines, style, boxes: Vec::new() };
    for axis in 0..2 {
        labels.draw(axis, drawing).map_err(Error::from)?;
    }
    taken.append(&mut labels.boxes);
    let [step, level] = [grid.step, grid.level].map(|length| grid.written(length, 4));
    Ok(Some(Note::Grid { step: (!lines.is_empty()).then_some(step), level }))
}

/// Lines at multiples of a step.
struct GroundGrid {
    step: f64,
    /// Height of the ground, z.
    level: f64,
    /// Numbers of the first and the last line, along x and along y.
    ends: [[i64; 2]; 2],
    /// The unit of its numbers; that of the scene, if there is none.
    unit: Option<Unit>,
}

impl GroundGrid {
    /// `None` if the scene is too far away for numbers.
    fn new<E: From<Error>>(seen: &SeenScene<'_, E>, unit: Option<Unit>) -> Option<Self> {
        let (low, high) = seen.scene.bounds()?;
        let longest = (high.x - low.x).max(high.y - low.y);
        let level = if low.z < -1e-9 * longest { low.z } else { 0.0 };
        let depth = depth(seen, level);
        let [left, right] = [0.0, seen.size[0]].map(|column| seen.view.point([column, 0.0], depth));
        let factor = unit.as_ref().map_or(1.0, |unit| unit.factor);
        let step =
            round_step(factor * ((right - left).length() / SQUARES).max(longest / MOST)) / factor;
        let ends = [[low.x, high.x], [low.y, high.y]]
            .map(|[low, high]| [(low / step).floor(), (high / step).ceil()]);
        // Farther away, neighbouring lines cannot be distinguished.
        let is_near = ends.iter().flatten().all(|end| end.abs() < 1e9);
        is_near.then(|| Self {
            step,
            level,
            ends: ends.map(|ends| ends.map(|end| end as i64)),
            unit,
        })
    }

    /// A length with its unit.
    fn written(&self, length: f64, digits: usize) -> String {
        self.unit
            .as_ref()
            .map_or_else(|| significant(length, digits), |unit| unit.written(length, digits))
    }

    fn numbers(&self, axis: usize) -> impl Iterator<Item = i64> + use<> {
        let [low, high] = self.ends[axis];
        low..=high
    }

    /// The intersection of line `number` of an axis with line `across` of the other, in scene
    /// coordinates.
    fn point(&self, axis: usize, number: i64, across: i64) -> DVec3 {
        let (along, across) = (number as f64 * self.step, across as f64 * self.step);
        if axis == 0 {
            DVec3::new(along, across, self.level)
        } else {
            DVec3::new(across, along, self.level)
        }
    }
}

/// The depth of the ground in the lower part of the picture, or that of the view centre if it is
/// nearer.
fn depth<E>(seen: &SeenScene<'_, E>, level: f64) -> f64 {
    let view = &seen.view;
    let [width, height] = seen.size;
    let [near, far] =
        [1.0, 2.0].map(|depth| view.eye.z + view.point([0.5 * width, 0.75 * height], depth).z);
    let crossing = 1.0 + (level - near) / (far - near);
    if crossing > 0.0 && view.is_perspective { crossing.min(view.distance) } else { view.distance }
}

/// The least of …, 0.5, 1, 2, 5, 10, … that is not less than `least`.
fn round_step(least: f64) -> f64 {
    let power = libm::exp10(libm::log10(least).floor());
    // Rounding may put a power of ten slightly above or below itself.
    [1.0, 2.0, 5.0, 10.0]
        .map(|factor| factor * power)
        .into_iter()
        .find(|step| *step >= least * (1.0 - 1e-9))
        .unwrap_or(10.0 * power)
}

/// Numbers at the ends of lines nearer to the eye.
struct Labels<'a, E> {
    grid: &'a GroundGrid,
    seen: &'a SeenScene<'a, E>,
    /// Visible parts of the grid.
    visible: &'a [[Point; 2]],
    style: &'a Style,
    /// Upper-left and lower-right corners of the numbers already drawn.
    boxes: Vec<[Point; 2]>,
}

impl<E: From<Error>> Labels<'_, E> {
    /// Draws the numbers of an axis from the nearest on, until two would overlap. Those that would
    /// overlap numbers of the other axis are left out.
    fn draw(&mut self, axis: usize, drawing: &mut Drawing) -> Result<(), MissingCharacter> {
        let grid = self.grid;
        let near = self.near_side(axis);
        let [low, high] = grid.ends[1 - axis];
        let far = if near == low { high } else { low };
        let in_picture = |number: i64| {
            let ends =
                [near, far].map(|across| grid.point(axis, number, across) - self.seen.view.eye);
            in_picture(&self.seen.view, ends)
                .map(|[end, other]| (number, end, other, end == ends[0]))
        };
        let mut lines: Vec<_> = grid.numbers(axis).filter_map(in_picture).collect();
        lines.sort_by(|(_, one, ..), (_, other, ..)| one.length().total_cmp(&other.length()));
        let first = self.boxes.len();
        let name = ["x", "y"][axis];
        let mut is_named = false;
        for (number, end, other, is_whole) in lines {
            let spot = self.seen.place(end);
            if !self.visible.iter().any(|part| is_on(spot, *part)) {
                continue;
            }
            let at = number as f64 * grid.step;
            let factor = grid.unit.as_ref().map_or(1.0, |unit| unit.factor);
            // At the edges of the picture numbers of both axes are mixed, so they get the name of
            // the axis.
            let text = if is_named && is_whole {
                significant(factor * at, 6)
            } else {
                format!("{name} = {}", grid.written(at, 6))
            };
            let line = Line::new(&text, TEXT * self.style.size)?;
            let outward = direction(spot, self.seen.place(end + (end - other) * 1e-3));
            // Where a line leaves the picture, its number is placed on the line.
            let direction = if is_whole { outward } else { outward.map(|part| -part) };
            let place = self.place(&line, spot, direction);
            if !is_free(&place, &self.boxes[first..]) {
                break;
            }
            if !self.is_inside(place) || !is_free(&place, &self.boxes[..first]) {
                continue;
            }
            is_named = true;
            self.push(&line, place, !is_whole, drawing);
        }
        Ok(())
    }

    /// The edge of the ground at which the lines of an axis have their numbers.
    fn near_side(&self, axis: usize) -> i64 {
        let ends = self.grid.ends;
        let middle = (ends[axis][0] + ends[axis][1]) / 2;
        let [low, high] = ends[1 - axis];
        let distance =
            |across: i64| (self.grid.point(axis, middle, across) - self.seen.view.eye).length();
        // Ties go to the edge with the greater coordinate.
        if distance(low) < distance(high) * (1.0 - 1e-9) { low } else { high }
    }

    /// The box of a number, offset from a point in a direction.
    fn place(&self, line: &Line, [x, y]: Point, [right, down]: [f64; 2]) -> [Point; 2] {
        let size = TEXT * self.style.size;
        let half = [0.5 * line.width(), 0.4 * size];
        let (away, gap) = (0.5 * size, 0.25 * size);
        // As far from the place as the box needs in this direction.
        let middle = [x + right * (half[0] + away), y + down * (half[1] + away)];
        let low = [middle[0] - half[0] - gap, middle[1] - half[1] - gap];
        [low, [middle[0] + half[0] + gap, middle[1] + half[1] + DESCENT * size]]
    }

    fn is_inside(&self, [low, high]: [Point; 2]) -> bool {
        low.iter().all(|edge| *edge >= 0.0) && (0..2).all(|i| high[i] <= self.seen.size[i])
    }

    fn push(
        &mut self,
        line: &Line,
        [low, high]: [Point; 2],
        has_ground: bool,
        drawing: &mut Drawing,
    ) {
        self.boxes.push([low, high]);
        if has_ground {
            drawing.rectangle(low, high, self.style.background);
        }
        let base = high[1] - DESCENT * TEXT * self.style.size;
        drawing.text(line, [0.5 * (low[0] + high[0] - line.width()), base.round()], self.style.ink);
    }
}

/// The unit vector from one point of the picture to another.
fn direction([left, top]: Point, [right, below]: Point) -> [f64; 2] {
    let [x, y] = [right - left, below - top];
    let length = libm::hypot(x, y);
    if length > 0.0 && length.is_finite() { [x / length, y / length] } else { [0.0, 1.0] }
}

/// True if a point is within a pixel of a line.
fn is_on([x, y]: Point, [[left, top], [right, below]]: [Point; 2]) -> bool {
    let (along, off) = ([right - left, below - top], [x - left, y - top]);
    let square = along[0] * along[0] + along[1] * along[1];
    let part =
        ((off[0] * along[0] + off[1] * along[1]) / square.max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
    libm::hypot(off[0] - part * along[0], off[1] - part * along[1]) < 1.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_round_and_not_less() {
        let rows = [
            (1.0, 1.0),
            (1.01, 2.0),
            (2.5, 5.0),
            (7.0, 10.0),
            (0.03, 0.05),
            (1000.0, 1000.0),
            (1e-7, 1e-7),
        ];
        for (least, step) in rows {
            assert!(
                (round_step(least) / step - 1.0).abs() < 1e-12,
                "{least} {}",
                round_step(least)
            );
        }
    }
}
