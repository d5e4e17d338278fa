//! Labels of a scene: text with an arrow to its vertex, where that is seen.

use glam::DVec3;
use ugimage::figure::Point;
use ugimage::label::{Drawing, Line, wrapped};

use super::seen::SeenScene;
use super::style::Style;
use super::{CAPITAL, SPACING};
use crate::error::Error;
use crate::line::is_in_picture;
use crate::note::Note;

/// Lengths of arrows in text sizes, in the order in which they are tried.
const LENGTHS: [f64; 4] = [1.8, 3.6, 6.0, 9.0];

/// Directions of text from its vertex relative to that away from the middle of what is seen, in the
/// order in which they are tried: cosine and sine of multiples of 30 degrees.
const TURNS: [[f64; 2]; 8] = {
    const ROOT: f64 = 0.866_025_403_784_438_6;
    [
        [1.0, 0.0],
        [ROOT, 0.5],
        [ROOT, -0.5],
        [0.5, ROOT],
        [0.5, -ROOT],
        [0.0, 1.0],
        [0.0, -1.0],
        [-1.0, 0.0],
    ]
};

/// Greatest width of text relative to the picture.
const WIDTH: f64 = 0.4;

/// Space between text and the edges of its box, in text sizes.
const GAP: f64 = 0.25;

/// Half the length in pixels of the lines around a vertex that tell whether faces hide it.
const ARM: f64 = 0.75;

/// A box by its upper left and lower right corner.
pub type Rectangle = [Point; 2];

/// Draws the labels of vertices that are seen in the picture. Returns notes if some are outside, or
/// hidden. `covered`: the part of the picture that other annotations cover; `shows_hidden`: labels
/// of hidden vertices are drawn, too.
///
/// # Errors
/// The font lacks a character; errors of [`SeenScene::visible`].
pub fn draw<E: From<Error>>(
    seen: &SeenScene<'_, E>,
    style: &Style,
    covered: Option<Rectangle>,
    shows_hidden: bool,
    drawing: &mut Drawing,
) -> Result<Vec<Note>, E> {
    let place = |position| {
        let point = position - seen.view.eye;
        is_in_picture(&seen.view, point).then(|| seen.place(point))
    };
    let scene = seen.scene;
    let all = scene.labels().map(|(at, text)| (scene.vertices[at.index()].position, text));
    let mut labels: Vec<_> = all.filter_map(|(at, text)| Some((at, place(at)?, text))).collect();
    let n_outside = scene.labels().count() - labels.len();
    let n_inside = labels.len();
    if !shows_hidden {
        let arms: Vec<_> =
            labels.iter().flat_map(|label| arms(seen, label.0 - seen.view.eye)).collect();
        let visible = seen.visible(scene.clone(), &arms)?;
        labels.retain(|(_, tip, _)| {
            visible.iter().any(|ends| ends.iter().all(|&end| is_near(end, *tip)))
        });
    }
    let n_hidden = n_inside - labels.len();
    // Text covers neither the tip of an arrow nor other text.
    let mut taken: Vec<Rectangle> = labels.iter().map(|label| [label.1; 2]).collect();
    taken.extend(covered);
    let bounds = scene
        .vertices
        .iter()
        .filter_map(|vertex| place(vertex.position))
        .map(|at| [at; 2])
        .reduce(union);
    let [low, high] = bounds.unwrap_or_default();
    let middle = [0, 1].map(|axis| 0.5 * (low[axis] + high[axis]));
    for (_, tip, text) in labels {
        let lines = wrapped(text, style.size, WIDTH * seen.size[0]).map_err(Error::from)?;
        let width = lines.iter().map(Line::width).fold(0.0, f64::max);
        let height = style.size * (CAPITAL + SPACING * (lines.len() - 1) as f64);
        let half = [width, height].map(|side| 0.5 * side + GAP * style.size);
        let at = free_place(tip, half, middle, &taken, (seen.size, style.size));
        push(tip, at, &lines, style, drawing);
        taken.push(at);
    }
    let notes =
        [(n_outside, Note::LabelsOutside(n_outside)), (n_hidden, Note::LabelsHidden(n_hidden))];
    Ok(notes.into_iter().filter_map(|(n, note)| (n > 0).then_some(note)).collect())
}

/// Two short lines that cross just before a point, relative to the eye: so much nearer to the eye
/// than the point that the faces that meet in it do not hide all of them.
fn arms<E: From<Error>>(seen: &SeenScene<'_, E>, point: DVec3) -> [[DVec3; 2]; 2] {
    let view = &seen.view;
    let place = seen.place(point);
    let at = |[x, y]: [f64; 2]| view.point([place[0] + x, place[1] + y], view.place(point).z);
    let toward = if view.is_perspective { -point.normalize() } else { -view.forward };
    let lift = (at([ARM, 0.0]) - point).length() * toward;
    [[[-ARM, 0.0], [ARM, 0.0]], [[0.0, -ARM], [0.0, ARM]]]
        .map(|ends| ends.map(|end| at(end) + lift))
}

/// True if a point of the picture is in reach of the lines around another.
fn is_near(point: Point, tip: Point) -> bool {
    (0..2).all(|axis| (point[axis] - tip[axis]).abs() < 2.0 * ARM)
}

/// A box for text with these half sides: in the picture, and apart from those `taken` if there is
/// such a place.
fn free_place(
    tip: Point,
    half: [f64; 2],
    middle: Point,
    taken: &[Rectangle],
    (picture, size): ([f64; 2], f64),
) -> Rectangle {
    let [x, y] = [tip[0] - middle[0], tip[1] - middle[1]];
    let length = libm::hypot(x, y);
    let [x, y] = if length > 1.0 { [x / length, y / length] } else { [0.0, -1.0] };
    let at = |length: f64, [cos, sin]: [f64; 2]| {
        let toward = [x * cos - y * sin, x * sin + y * cos];
        let middle = [0, 1].map(|axis| tip[axis] + toward[axis] * (half[axis] + length * size));
        [[0, 1].map(|axis| middle[axis] - half[axis]), [0, 1].map(|axis| middle[axis] + half[axis])]
    };
    let is_free = |place: &Rectangle| {
        let is_inside = (0..2).all(|axis| place[0][axis] >= 0.0 && place[1][axis] <= picture[axis]);
        is_inside && taken.iter().all(|other| is_apart(place, other))
    };
    let tried = LENGTHS.into_iter().flat_map(|length| TURNS.map(|turn| at(length, turn)));
    tried.into_iter().find(is_free).unwrap_or_else(|| {
        let [low, _] = at(LENGTHS[0], TURNS[0]);
        let low = [0, 1].map(|axis| low[axis].min(picture[axis] - 2.0 * half[axis]).max(0.0));
        [low, [0, 1].map(|axis| low[axis] + 2.0 * half[axis])]
    })
}

/// Draws an arrow from a box to a point, and text in the box.
fn push(tip: Point, [low, high]: Rectangle, lines: &[Line], style: &Style, drawing: &mut Drawing) {
    let Style { size, ink, background, hairline, .. } = *style;
    let start = [0, 1].map(|axis| tip[axis].clamp(low[axis], high[axis]));
    drawing.lines(vec![[start, tip]], 3.0 * hairline, background);
    drawing.arrow([start, tip], 1.3 * hairline, ink);
    drawing.rectangle(low, high, background);
    for (line, row) in lines.iter().zip(0..) {
        let base = low[1] + size * (GAP + CAPITAL + SPACING * f64::from(row));
        drawing.text(line, [0.5 * (low[0] + high[0] - line.width()), base.round()], ink);
    }
}

/// The least box around two.
fn union([low, high]: Rectangle, [other_low, other_high]: Rectangle) -> Rectangle {
    [
        [0, 1].map(|axis| low[axis].min(other_low[axis])),
        [0, 1].map(|axis| high[axis].max(other_high[axis])),
    ]
}

/// True if two boxes do not overlap.
pub fn is_apart([low, high]: &Rectangle, [other_low, other_high]: &Rectangle) -> bool {
    (0..2).any(|axis| high[axis] < other_low[axis] || low[axis] > other_high[axis])
}
