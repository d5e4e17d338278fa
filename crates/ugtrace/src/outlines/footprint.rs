//! The bounding rectangle of a face in the picture.

use glam::DVec3;

use super::frame::PictureRays;
use super::outline::Outline;

/// A rectangle of the picture, in samples.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rect {
    /// Least column and row.
    pub low: [f64; 2],
    /// Greatest column and row.
    pub high: [f64; 2],
}

/// How often an arc is halved at most. Pieces that are still undecided count with the box of their
/// control points.
const MOST_HALVINGS: u32 = 24;

/// By how many samples a footprint may exceed the exact box.
const SLACK: f64 = 1.0;

impl Rect {
    /// The rectangle of these columns and rows.
    pub fn new(columns: [u32; 2], rows: [u32; 2]) -> Self {
        let [low, high] = [0, 1].map(|end| [f64::from(columns[end]), f64::from(rows[end])]);
        Self { low, high }
    }

    const EMPTY: Self = Self { low: [f64::INFINITY; 2], high: [f64::NEG_INFINITY; 2] };

    fn is_empty(&self) -> bool {
        !(self.low[0] <= self.high[0] && self.low[1] <= self.high[1])
    }

    fn with(self, other: Self) -> Self {
        Self {
            low: std::array::from_fn(|i| self.low[i].min(other.low[i])),
            high: std::array::from_fn(|i| self.high[i].max(other.high[i])),
        }
    }

    fn within(self, other: Self) -> Self {
        Self {
            low: std::array::from_fn(|i| self.low[i].max(other.low[i])),
            high: std::array::from_fn(|i| self.high[i].min(other.high[i])),
        }
    }

    fn around(points: &[DVec3]) -> Self {
        points.iter().fold(Self::EMPTY, |rect, point| {
            let place = [point.x / point.z, point.y / point.z];
            rect.with(Self { low: place, high: place })
        })
    }

    fn contains(&self, other: &Self) -> bool {
        self.with(*other) == *self
    }

    fn grown(self) -> Self {
        Self { low: self.low.map(|low| low - SLACK), high: self.high.map(|high| high + SLACK) }
    }

    fn is_wider_than(&self, other: &Self) -> bool {
        (0..2).any(|i| self.low[i] < other.low[i] - SLACK || self.high[i] > other.high[i] + SLACK)
    }

    /// True if the convex hull of these points lies beyond one side of the rectangle, or behind the
    /// eye. The points are homogeneous, as [`PictureRays::place`] returns them.
    fn misses(&self, hull: &[DVec3; 3]) -> bool {
        let behind = |side: &dyn Fn(&DVec3) -> f64| hull.iter().all(|point| side(point) < 0.0);
        behind(&|p| p.z)
            || behind(&|p| p.x - self.low[0] * p.z)
            || behind(&|p| p.y - self.low[1] * p.z)
            || behind(&|p| self.high[0] * p.z - p.x)
            || behind(&|p| self.high[1] * p.z - p.y)
    }
}

/// A box, nearly as small as possible, around the part of `rect` in which a face can be seen;
/// `None` if it cannot be seen there.
///
/// The visible part is bounded by arcs of the edges of the face and by sides of `rect`. The box
/// therefore encloses the arcs within `rect` and those corners of `rect` at which the face is seen.
pub fn footprint(frame: &PictureRays, outline: &Outline, rect: Rect) -> Option<Rect> {
    let mut search = Search { rect: rect.grown(), found: Rect::EMPTY };
    for edge in &outline.edges {
        let [a, b] = edge.ends.map(DVec3::normalize_or_zero);
        match frame.arc(a, b) {
            Some(arc) => search.add(arc, MOST_HALVINGS),
            None => search.found = search.rect,
        }
    }
    for x in [search.rect.low[0], search.rect.high[0]] {
        for y in [search.rect.low[1], search.rect.high[1]] {
            let ray = frame.ray(frame.row(y), x);
            if outline.key(ray) > 0.0 && outline.contains(ray) {
                search.found = search.found.with(Rect { low: [x, y], high: [x, y] });
            }
        }
    }
    let found = search.found.grown().within(rect);
    (!search.found.is_empty() && !found.is_empty()).then_some(found)
}

struct Search {
    rect: Rect,
    found: Rect,
}

impl Search {
    /// Extends the box by the part of an arc in the rectangle. An arc lies in the hull of its
    /// control points.
    fn add(&mut self, [a, control, b]: [DVec3; 3], n_halvings: u32) {
        if self.rect.misses(&[a, control, b]) || self.found.contains(&self.rect) {
            return;
        }
        if a.z > 0.0 && control.z > 0.0 && b.z > 0.0 {
            let hull = Rect::around(&[a, control, b]).within(self.rect);
            if self.found.contains(&hull) {
                return;
            }
            let ends = Rect::around(&[a, b]).within(self.rect);
            if n_halvings == 0 || !(ends.is_empty() || hull.is_wider_than(&ends)) {
                self.found = self.found.with(hull);
                return;
            }
        } else if n_halvings == 0 {
            self.found = self.rect;
            return;
        }
        let (first, second) = (0.5 * (a + control), 0.5 * (control + b));
        let middle = 0.5 * (first + second);
        self.add([a, first, middle], n_halvings - 1);
        self.add([middle, second, b], n_halvings - 1);
    }
}
