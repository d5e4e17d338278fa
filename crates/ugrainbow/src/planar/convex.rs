//! Convex polygons in the picture plane that are planar in depth.

use ugpicture::{DepthPoint, clip_line};

use super::clip::clip_edges;

/// Areas below this many square pixels count as empty: rounding makes such slivers along shared
/// edges.
const LEAST_AREA: f64 = 1e-6;

/// Relative difference up to which two keys count as equal: the rasterizer compares them in single
/// precision.
const SAME_KEY: f64 = 1e-6;

/// A convex polygon on one plane.
#[derive(Clone, Debug)]
pub struct Convex {
    /// Counterclockwise with y up, so the signed area is positive.
    pub corners: Vec<DepthPoint>,
    /// Least and greatest x and y.
    pub low: [f64; 2],
    pub high: [f64; 2],
    /// Change of the key per unit of x and of y.
    slope: [f64; 2],
    /// A point of the plane.
    anchor: DepthPoint,
}

/// Order in depth of two polygons where they overlap in the picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct DepthOrder {
    /// The first is nearer somewhere.
    pub is_before: bool,
    /// The first is farther somewhere.
    pub is_behind: bool,
    /// They overlap, with equal depth somewhere.
    pub is_level: bool,
}

impl Convex {
    /// `None` if the area is empty. The plane is that of the widest triangle at the first corner.
    pub fn new(mut corners: Vec<DepthPoint>) -> Option<Self> {
        let area = doubled_area(&corners);
        if !area.is_finite() || area.abs() < LEAST_AREA {
            return None;
        }
        if area < 0.0 {
            corners.reverse();
        }
        let anchor = corners[0];
        let triangle = |pair: &[DepthPoint]| {
            let [u, v] = [pair[0], pair[1]].map(|corner| [0, 1, 2].map(|i| corner[i] - anchor[i]));
            (u[0] * v[1] - u[1] * v[0], u, v)
        };
        let triangles = corners[1..].windows(2).map(triangle);
        let (cross, u, v) = triangles.max_by(|a, b| a.0.total_cmp(&b.0))?;
        let slope = [(u[2] * v[1] - v[2] * u[1]) / cross, (u[0] * v[2] - v[0] * u[2]) / cross];
        let bound = |axis: usize, start: f64, pick: fn(f64, f64) -> f64| {
            corners.iter().map(|corner| corner[axis]).fold(start, pick)
        };
        let low = [0, 1].map(|axis| bound(axis, f64::INFINITY, f64::min));
        let high = [0, 1].map(|axis| bound(axis, f64::NEG_INFINITY, f64::max));
        Some(Self { corners, low, high, slope, anchor })
    }

    /// The depth key of its plane at a point.
    pub fn key(&self, x: f64, y: f64) -> f64 {
        self.anchor[2] + self.slope[0] * (x - self.anchor[0]) + self.slope[1] * (y - self.anchor[1])
    }

    /// True if all corners lie in its plane.
    pub fn is_flat(&self) -> bool {
        self.corners.iter().all(|&[x, y, key]| side(key, self.key(x, y)) == 0)
    }

    /// True if their bounding boxes do not overlap.
    pub fn is_apart(&self, other: &Self) -> bool {
        (0..2).any(|axis| self.high[axis] <= other.low[axis] || other.high[axis] <= self.low[axis])
    }

    /// The depth order of two polygons where they overlap.
    pub fn relation(&self, other: &Self) -> DepthOrder {
        let mut relation = DepthOrder::default();
        if self.is_apart(other) {
            return relation;
        }
        let common = self.clipped(other);
        if doubled_area(&common) < LEAST_AREA {
            return relation;
        }
        for [x, y, _] in common {
            match side(self.key(x, y), other.key(x, y)) {
                1 => relation.is_before = true,
                -1 => relation.is_behind = true,
                _ => relation.is_level = true,
            }
        }
        relation
    }

    /// The corners of its intersection with another in the picture.
    fn clipped(&self, other: &Self) -> Vec<DepthPoint> {
        let mut rest = self.corners.clone();
        for side in sides(&other.corners) {
            rest = clip(&rest, |place| inside(side, place));
            if rest.is_empty() {
                break;
            }
        }
        rest
    }

    /// Its intersection with another in the picture, in its own plane.
    pub fn common(&self, other: &Self) -> Option<Self> {
        if self.is_apart(other) { None } else { Self::new(self.clipped(other)) }
    }

    /// Its difference with another in the picture, in convex parts.
    pub fn difference(&self, other: &Self) -> Vec<Self> {
        if self.is_apart(other) {
            return vec![self.clone()];
        }
        let mut beside = Vec::new();
        let mut rest = self.corners.clone();
        for side in sides(&other.corners) {
            beside.extend(Self::new(clip(&rest, |place| -inside(side, place))));
            rest = clip(&rest, |place| inside(side, place));
        }
        beside
    }

    /// On which side of the plane of `self` another polygon lies: 1 nearer, −1 farther, 0 in it;
    /// `None` if it crosses the plane.
    pub fn side_of(&self, other: &Self) -> Option<i8> {
        let mut sides = [false; 2];
        for &[x, y, key] in &other.corners {
            match side(key, self.key(x, y)) {
                1 => sides[1] = true,
                -1 => sides[0] = true,
                _ => {}
            }
        }
        match sides {
            [true, true] => None,
            [false, true] => Some(1),
            [true, false] => Some(-1),
            [false, false] => Some(0),
        }
    }

    /// The parts of another behind and in front of the plane of `self`.
    pub fn split(&self, other: &Self) -> [Option<Self>; 2] {
        let ahead = |[x, y, key]: DepthPoint| key - self.key(x, y);
        [
            Self::new(clip(&other.corners, |place| -ahead(place))),
            Self::new(clip(&other.corners, ahead)),
        ]
    }

    /// The part of the segment from `a` to `b` that lies over this polygon, as parameters in 0…1.
    pub fn over(&self, a: DepthPoint, b: DepthPoint) -> Option<[f64; 2]> {
        let sides = sides(&self.corners).map(|side| [inside(side, a), inside(side, b)]);
        let [start, end] = clip_line(sides)?;
        (start < end).then_some([start, end])
    }

    /// Its two halves, cut perpendicular to the longer side of its bounding box.
    pub fn halves(&self) -> [Option<Self>; 2] {
        let extent = [0, 1].map(|axis| self.high[axis] - self.low[axis]);
        let axis = usize::from(extent[1] > extent[0]);
        let middle = 0.5 * (self.low[axis] + self.high[axis]);
        [
            Self::new(clip(&self.corners, |place| middle - place[axis])),
            Self::new(clip(&self.corners, |place| place[axis] - middle)),
        ]
    }

    /// The mean of its corners.
    pub fn middle(&self) -> [f64; 2] {
        let n_corners = self.corners.len() as f64;
        [0, 1].map(|axis| self.corners.iter().map(|corner| corner[axis]).sum::<f64>() / n_corners)
    }

    /// Its corners without their depth.
    pub fn outline(&self) -> Vec<[f64; 2]> {
        self.corners.iter().map(|&[x, y, _]| [x, y]).collect()
    }

    /// The bounding box of several polygons: least and greatest x and y.
    pub fn bounds(parts: &[Self]) -> [[f64; 2]; 2] {
        let fold = |start: f64, pick: fn(f64, f64) -> f64, corner: fn(&Self) -> [f64; 2]| {
            [0, 1].map(|axis| parts.iter().map(|part| corner(part)[axis]).fold(start, pick))
        };
        [
            fold(f64::INFINITY, f64::min, |part| part.low),
            fold(f64::NEG_INFINITY, f64::max, |part| part.high),
        ]
    }

    /// The longer side of its bounding box.
    pub fn extent(&self) -> f64 {
        (self.high[0] - self.low[0]).max(self.high[1] - self.low[1])
    }
}

/// 1 if `key` is nearer than `other`, −1 if farther, 0 if they count as equal.
fn side(key: f64, other: f64) -> i8 {
    let difference = key - other;
    if difference.abs() <= SAME_KEY * key.abs().max(other.abs()) {
        0
    } else if difference > 0.0 {
        1
    } else {
        -1
    }
}

/// Not negative on the inner side of a side of a polygon.
fn inside((a, b): (DepthPoint, DepthPoint), [x, y, _]: DepthPoint) -> f64 {
    (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0])
}

/// The sides of a polygon.
pub fn sides(corners: &[DepthPoint]) -> impl Iterator<Item = (DepthPoint, DepthPoint)> {
    let ahead = corners.iter().cycle().skip(1);
    corners.iter().copied().zip(ahead.copied())
}

/// Twice the signed area.
pub fn doubled_area(corners: &[DepthPoint]) -> f64 {
    let Some(&[x0, y0, _]) = corners.first() else { return 0.0 };
    sides(corners).map(|(a, b)| (a[0] - x0) * (b[1] - y0) - (a[1] - y0) * (b[0] - x0)).sum()
}

/// Clips a polygon to where the linear function `inside` is not negative.
pub fn clip(corners: &[DepthPoint], inside: impl Fn(DepthPoint) -> f64) -> Vec<DepthPoint> {
    let crossing = |a: DepthPoint, b: DepthPoint| {
        let part = inside(a) / (inside(a) - inside(b));
        [0, 1, 2].map(|i| a[i] + (b[i] - a[i]) * part)
    };
    let mut kept = Vec::with_capacity(corners.len() + 1);
    clip_edges(sides(corners), |place| inside(*place) >= 0.0, |a, b| crossing(*a, *b), &mut kept);
    kept
}
