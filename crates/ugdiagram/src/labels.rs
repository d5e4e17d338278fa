//! Where labels stand: beside what they name, and on nothing else.

use ugimage::figure::Point;

/// A rectangle: left, top, right, bottom, in pixels.
pub type Rectangle = [f64; 4];

/// A label that wants a place.
#[derive(Clone, Debug, PartialEq)]
pub struct Wanted {
    /// Its width and height.
    pub size: [f64; 2],
    /// Where what it names is: the first that has room is used.
    pub anchors: Vec<Point>,
    /// The distance to it.
    pub gap: f64,
    /// It is left out rather than put where a line runs, or at the end of a leader.
    pub is_optional: bool,
}

/// The place of a label.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placed {
    /// Where it stands.
    pub rectangle: Rectangle,
    /// A line to what it names, if that is farther away.
    pub leader: Option<[Point; 2]>,
}

/// What labels must not cover.
#[derive(Clone, Debug, Default)]
pub struct Obstacles {
    /// Marks.
    pub marks: Vec<Rectangle>,
    /// Lines.
    pub lines: Vec<[Point; 2]>,
}

/// Distances of labels with a leader, in heights of the label.
const FAR: [f64; 6] = [1.5, 2.5, 4.0, 6.0, 9.0, 13.0];

/// Directions of places beside a point.
const AROUND: [Point; 8] = [
    [1.0, 0.0],
    [-1.0, 0.0],
    [1.0, -1.0],
    [-1.0, -1.0],
    [1.0, 1.0],
    [-1.0, 1.0],
    [0.0, -1.0],
    [0.0, 1.0],
];

/// Places labels in `area`, in their order. No label covers another one, a mark or the end of a
/// leader; none covers a line if there is a place without. `None`: it has no place.
pub fn place(wanted: &[Wanted], obstacles: &Obstacles, area: Rectangle) -> Vec<Option<Placed>> {
    let mut blocked = obstacles.marks.clone();
    let mut out = Vec::with_capacity(wanted.len());
    for label in wanted {
        let is_free = |rectangle: &Rectangle| {
            is_inside(rectangle, area) && !blocked.iter().any(|other| overlap(rectangle, other))
        };
        let is_clear =
            |rectangle: &Rectangle| !obstacles.lines.iter().any(|line| crosses(*line, rectangle));
        let near = || {
            let gaps = [1.0, 2.2].map(|factor| factor * label.gap);
            let sides = gaps.into_iter().flat_map(|gap| {
                label.anchors.iter().flat_map(move |&anchor| {
                    AROUND.iter().map(move |&side| (beside(anchor, side, gap, label.size), None))
                })
            });
            sides.filter(|(rectangle, _)| is_free(rectangle))
        };
        let far = || {
            let leaders = FAR.into_iter().flat_map(|distance| {
                let gap = distance * label.size[1];
                label.anchors.iter().flat_map(move |&anchor| {
                    AROUND.iter().map(move |&side| {
                        let rectangle = beside(anchor, side, gap, label.size);
                        (rectangle, Some([anchor, nearest(anchor, &rectangle)]))
                    })
                })
            });
            // A leader must not run through other labels; its own mark is at its end.
            let is_open = |leader: [Point; 2]| {
                !blocked[obstacles.marks.len()..].iter().any(|other| crosses(leader, other))
            };
            leaders
                .filter(move |(rectangle, leader)| is_free(rectangle) && leader.is_none_or(is_open))
        };
        let best = near().find(|(rectangle, _)| is_clear(rectangle));
        let best = match best {
            None if !label.is_optional => far()
                .find(|(rectangle, _)| is_clear(rectangle))
                .or_else(|| near().next())
                .or_else(|| far().next()),
            found => found,
        };
        let placed = best.map(|(rectangle, leader)| Placed { rectangle, leader });
        blocked.extend(placed.map(|placed| placed.rectangle));
        out.push(placed);
    }
    out
}

/// A rectangle on a side of a point, with a gap between them.
fn beside([x, y]: Point, [right, down]: Point, gap: f64, [width, height]: [f64; 2]) -> Rectangle {
    // Diagonally, both distances together are the gap.
    let gap = if right != 0.0 && down != 0.0 { 0.7 * gap } else { gap };
    let left = x + right * (gap + 0.5 * width) - 0.5 * width;
    let top = y + down * (gap + 0.5 * height) - 0.5 * height;
    [left, top, left + width, top + height]
}

/// The point of a rectangle that is nearest to a point outside.
fn nearest([x, y]: Point, [left, top, right, bottom]: &Rectangle) -> Point {
    [x.clamp(*left, *right), y.clamp(*top, *bottom)]
}

fn is_inside(rectangle: &Rectangle, area: Rectangle) -> bool {
    let [left, top, right, bottom] = *rectangle;
    area[0] <= left && area[1] <= top && right <= area[2] && bottom <= area[3]
}

/// True if two rectangles have an area in common.
pub fn overlap(a: &Rectangle, b: &Rectangle) -> bool {
    a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3]
}

/// True if a line runs through the inside of a rectangle: Liang and Barsky.
pub fn crosses([a, b]: [Point; 2], rectangle: &Rectangle) -> bool {
    let (mut from, mut to) = (0.0_f64, 1.0_f64);
    for side in 0..2 {
        let (low, high, step) = (rectangle[side], rectangle[side + 2], b[side] - a[side]);
        if step == 0.0 {
            if a[side] <= low || a[side] >= high {
                return false;
            }
            continue;
        }
        let [one, other] = [low, high].map(|edge| (edge - a[side]) / step);
        (from, to) = (from.max(one.min(other)), to.min(one.max(other)));
    }
    from < to
}
