//! Labels of a scene: text with an arrow to its vertex, where that is seen.

use glam::DVec3;
use ugimage::figure::Point;
use ugimage::label::{Drawing, Line, wrapped};
use ugscene::vertex_bodies;

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
/// hidden. `taken`: the parts of the picture that other text covers, to which theirs are added;
/// `shows_hidden`: labels of hidden vertices are drawn, too.
///
/// # Errors
/// The font lacks a character; errors of [`SeenScene::visible`].
pub fn draw<E: From<Error>>(
    seen: &SeenScene<'_, E>,
    style: &Style,
    taken: &mut Vec<Rectangle>,
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
    if labels.is_empty() {
        return Ok(notes(n_outside, n_hidden));
    }
    // Text covers neither the tip of an arrow nor other text.
    taken.extend(labels.iter().map(|label| [label.1; 2]));
    let mut bodies = vec![Vec::new(); scene.bodies.len()];
    for (vertex, body) in scene.vertices.iter().zip(vertex_bodies(scene)) {
        bodies[body.index()].extend(place(vertex.position));
    }
    let outlines: Vec<_> = bodies.into_iter().map(convex_outline).collect();
    let bounds = outlines.iter().flatten().map(|&at| [at; 2]).reduce(union);
    let [low, high] = bounds.unwrap_or_default();
    let middle = [0, 1].map(|axis| 0.5 * (low[axis] + high[axis]));
    for (_, tip, text) in labels {
        let lines = wrapped(text, style.size, WIDTH * seen.size[0]).map_err(Error::from)?;
        let width = lines.iter().map(Line::width).fold(0.0, f64::max);
        let height = style.size * (CAPITAL + SPACING * (lines.len() - 1) as f64);
        let half = [width, height].map(|side| 0.5 * side + GAP * style.size);
        let spaces = Spaces { picture: seen.size, taken, outlines: &outlines };
        let at = spaces.place(tip, half, middle, style.size);
        push(tip, at, &lines, style, drawing);
        taken.push(at);
    }
    Ok(notes(n_outside, n_hidden))
}

/// Notes on labels that are not drawn.
fn notes(n_outside: usize, n_hidden: usize) -> Vec<Note> {
    let notes =
        [(n_outside, Note::LabelsOutside(n_outside)), (n_hidden, Note::LabelsHidden(n_hidden))];
    notes.into_iter().filter_map(|(n, note)| (n > 0).then_some(note)).collect()
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

/// Where text may be.
struct Spaces<'a> {
    /// Columns and rows.
    picture: [f64; 2],
    /// Covered by other text, or by tips of arrows.
    taken: &'a [Rectangle],
    /// The convex outlines of all bodies in the picture.
    outlines: &'a [Vec<Point>],
}

impl Spaces<'_> {
    /// A box for text with these half sides, in the picture, and if there is such a place apart
    /// from what is taken, and outside of all bodies. `size`: of text.
    fn place(&self, tip: Point, half: [f64; 2], middle: Point, size: f64) -> Rectangle {
        let [x, y] = [tip[0] - middle[0], tip[1] - middle[1]];
        let length = libm::hypot(x, y);
        let [x, y] = if length > 1.0 { [x / length, y / length] } else { [0.0, -1.0] };
        let at = |length: f64, [cos, sin]: [f64; 2]| {
            let toward = [x * cos - y * sin, x * sin + y * cos];
            let middle = [0, 1].map(|axis| tip[axis] + toward[axis] * (half[axis] + length * size));
            let corner = |sign: f64| [0, 1].map(|axis| middle[axis] + sign * half[axis]);
            [corner(-1.0), corner(1.0)]
        };
        let is_inside = |place: &Rectangle| {
            (0..2).all(|axis| place[0][axis] >= 0.0 && place[1][axis] <= self.picture[axis])
        };
        let tried = LENGTHS.into_iter().flat_map(|length| TURNS.map(|turn| at(length, turn)));
        let free: Vec<_> =
            tried.filter(|place| is_inside(place) && is_free(place, self.taken)).collect();
        let hides_nothing =
            |place: &&Rectangle| self.outlines.iter().all(|outline| is_outside(place, outline));
        free.iter().find(hides_nothing).or(free.first()).copied().unwrap_or_else(|| {
            let [low, _] = at(LENGTHS[0], TURNS[0]);
            let low =
                [0, 1].map(|axis| low[axis].min(self.picture[axis] - 2.0 * half[axis]).max(0.0));
            [low, [0, 1].map(|axis| low[axis] + 2.0 * half[axis])]
        })
    }
}

/// Twice the area of the triangle between a line and a point, positive on one side.
fn side([from, to]: [Point; 2], point: Point) -> f64 {
    (to[0] - from[0]) * (point[1] - from[1]) - (to[1] - from[1]) * (point[0] - from[0])
}

/// The corners of the convex hull of points in the picture, by Andrew's monotone chain.
fn convex_outline(mut points: Vec<Point>) -> Vec<Point> {
    points.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    points.dedup();
    let chain = |points: &mut dyn Iterator<Item = Point>| {
        let mut chain: Vec<Point> = Vec::new();
        for point in points {
            while let [.., a, b] = chain[..]
                && side([a, b], point) <= 0.0
            {
                chain.pop();
            }
            chain.push(point);
        }
        chain.pop();
        chain
    };
    let mut outline = chain(&mut points.iter().copied());
    outline.extend(chain(&mut points.iter().rev().copied()));
    outline
}

/// True if a box is surely outside of a convex outline: a side of one separates them.
fn is_outside(place: &Rectangle, outline: &[Point]) -> bool {
    let [low, high] = *place;
    let corners = [low, [high[0], low[1]], high, [low[0], high[1]]];
    let next = |idx: usize| outline[(idx + 1) % outline.len()];
    let separates =
        |idx: usize| corners.iter().all(|&corner| side([outline[idx], next(idx)], corner) < 0.0);
    let bounds = outline.iter().map(|&at| [at; 2]).reduce(union);
    bounds.is_none_or(|bounds| is_apart(place, &bounds)) || (0..outline.len()).any(separates)
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

/// True if a box overlaps none of the others.
pub fn is_free(place: &Rectangle, others: &[Rectangle]) -> bool {
    others.iter().all(|other| is_apart(place, other))
}

/// True if two boxes do not overlap.
fn is_apart([low, high]: &Rectangle, [other_low, other_high]: &Rectangle) -> bool {
    (0..2).any(|axis| high[axis] < other_low[axis] || low[axis] > other_high[axis])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The corner of a square is outside of its inscribed circle, as its middle is not.
    #[test]
    fn boxes_beside_an_outline_are_outside() {
        let round = |idx: u32| {
            let angle = std::f64::consts::TAU * f64::from(idx) / 40.0;
            [10.0 + 9.0 * libm::cos(angle), 10.0 + 9.0 * libm::sin(angle)]
        };
        let points = (0..40).map(round).chain([[10.0, 10.0], [12.0, 7.0]]).collect();
        let outline = convex_outline(points);
        assert_eq!(outline.len(), 40);
        let at = |x: f64, y: f64| [[x - 1.0, y - 1.0], [x + 1.0, y + 1.0]];
        assert!(
            [at(2.0, 2.0), at(18.0, 2.0), at(18.0, 18.0), at(2.0, 18.0), at(30.0, 10.0)]
                .iter()
                .all(|place| is_outside(place, &outline))
        );
        assert!(
            [at(10.0, 10.0), at(4.0, 4.0), at(1.0, 10.0), [[-9.0; 2], [99.0; 2]]]
                .iter()
                .all(|place| !is_outside(place, &outline))
        );
        assert!(is_outside(&at(0.0, 0.0), &[]));
    }

    /// Text is beside a body where there is room, else over it, and never over other text.
    #[test]
    fn text_is_beside_bodies_where_there_is_room() {
        let square = vec![[40.0, 40.0], [160.0, 40.0], [160.0, 160.0], [40.0, 160.0]];
        let place = |picture: f64, taken: &[Rectangle]| {
            let spaces =
                Spaces { picture: [picture; 2], taken, outlines: std::slice::from_ref(&square) };
            spaces.place([70.0, 100.0], [8.0, 6.0], [100.0, 100.0], 8.0)
        };
        let beside = place(200.0, &[]);
        assert!(is_outside(&beside, &square) && beside[1][0] < 40.0, "{beside:?}");
        let other = place(200.0, &[beside]);
        assert!(is_apart(&beside, &other) && is_outside(&other, &square), "{other:?}");
        let everywhere = vec![[-1.0, -1.0], [300.0, -1.0], [300.0, 300.0], [-1.0, 300.0]];
        let inside = Spaces { picture: [200.0; 2], taken: &[], outlines: &[everywhere] };
        let [low, high] = inside.place([70.0, 100.0], [8.0, 6.0], [100.0, 100.0], 8.0);
        assert!(low[0] > 0.0 && high[0] < 70.0, "{low:?} {high:?}");
    }
}
