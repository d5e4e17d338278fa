//! The visible parts of lines.

use crate::error::Error;
use crate::planar::{
    BoxIndex, Convex, DepthPoint, MOST_CROSSED_PARTS, clipped_to_picture, convex_parts,
};

/// Decides which parts of a line are visible.
pub struct Visibility<'a> {
    /// The parts of a segment, within a range of parameters, that nothing hides.
    visible: &'a VisibleParts<'a>,
    /// The picture with a margin, beyond which lines are not drawn.
    picture: Option<Convex>,
}

/// See [`Visibility`].
pub type VisibleParts<'a> = dyn Fn([DepthPoint; 2], [f64; 2]) -> Vec<[f64; 2]> + Sync + 'a;

impl<'a> Visibility<'a> {
    /// `size`: of the picture, in samples; `margin`: half the width of lines.
    pub fn new(visible: &'a VisibleParts<'a>, size: [u32; 2], margin: f64) -> Self {
        let [low, right, bottom] =
            [-margin, f64::from(size[0]) + margin, f64::from(size[1]) + margin];
        let corners =
            vec![[low, low, 0.0], [right, low, 0.0], [right, bottom, 0.0], [low, bottom, 0.0]];
        Self { visible, picture: Convex::new(corners) }
    }

    /// The parts of the segment from `a` to `b` that are in the picture and not hidden.
    pub fn parts(&self, a: DepthPoint, b: DepthPoint) -> Vec<[f64; 2]> {
        self.within(a, b).map_or_else(Vec::new, |within| (self.visible)([a, b], within))
    }

    /// The parts of the segment from `a` to `b` that are in the picture and hidden: between those
    /// that are `visible`.
    pub fn hidden_parts(
        &self,
        a: DepthPoint,
        b: DepthPoint,
        visible: &[[f64; 2]],
    ) -> Vec<[f64; 2]> {
        let Some([start, end]) = self.within(a, b) else { return Vec::new() };
        let starts = [start].into_iter().chain(visible.iter().map(|part| part[1]));
        let ends = visible.iter().map(|part| part[0]).chain([end]);
        starts
            .zip(ends)
            .filter(|(start, end)| start < end)
            .map(|(start, end)| [start, end])
            .collect()
    }

    fn within(&self, a: DepthPoint, b: DepthPoint) -> Option<[f64; 2]> {
        self.picture.as_ref()?.over(a, b)
    }
}

fn along(a: DepthPoint, b: DepthPoint, part: f64) -> DepthPoint {
    [0, 1, 2].map(|i| a[i] + (b[i] - a[i]) * part)
}

/// Faces that may occlude lines, in convex parts.
pub struct Occluders {
    parts: Vec<Convex>,
    index: BoxIndex,
}

impl Occluders {
    /// The edges of some polygons, given as their contours, that lie near one of the lines whose
    /// boxes are given. `size`: of the picture, in samples.
    ///
    /// # Errors
    /// [`Error::CrossedFaces`].
    pub fn new(
        outlines: impl Iterator<Item = Vec<Vec<DepthPoint>>>,
        lines: impl Iterator<Item = [[f64; 2]; 2]>,
        size: [u32; 2],
        margin: f64,
    ) -> Result<Self, Error> {
        let lines = BoxIndex::new(lines, size);
        let (mut all, mut room) = (Vec::new(), MOST_CROSSED_PARTS);
        for contours in outlines {
            let places = || contours.iter().flatten();
            let low = [0, 1].map(|axis| places().map(|at| at[axis]).fold(f64::INFINITY, f64::min));
            let high =
                [0, 1].map(|axis| places().map(|at| at[axis]).fold(f64::NEG_INFINITY, f64::max));
            if !lines.has_any_in([low, high]) {
                continue;
            }
            let outline =
                contours.into_iter().map(|contour| clipped_to_picture(contour, size, margin));
            let outline: Vec<Vec<DepthPoint>> =
                outline.filter(|contour| contour.len() > 2).collect();
            all.extend(convex_parts(&outline, &mut room).ok_or(Error::CrossedFaces)?);
        }
        let index = BoxIndex::new(all.iter().map(|part| [part.low, part.high]), size);
        Ok(Self { parts: all, index })
    }

    /// The parts of the segment from `a` to `b`, within `[start, end]`, that no face hides.
    pub fn visible(&self, [a, b]: [DepthPoint; 2], [start, end]: [f64; 2]) -> Vec<[f64; 2]> {
        let (from, to) = (along(a, b, start), along(a, b, end));
        let low = [0, 1].map(|axis| from[axis].min(to[axis]));
        let high = [0, 1].map(|axis| from[axis].max(to[axis]));
        let parts = self.index.in_box([low, high]).into_iter().map(|idx| &self.parts[idx]);
        let mut hidden: Vec<[f64; 2]> =
            parts.filter_map(|part| occluded_part(part, a, b)).collect();
        hidden.sort_by(|one, other| one[0].total_cmp(&other[0]));
        let (mut shown, mut reached) = (Vec::new(), start);
        for [first, last] in hidden {
            if first.min(end) > reached {
                shown.push([reached, first.min(end)]);
            }
            reached = reached.max(last);
        }
        if reached < end {
            shown.push([reached, end]);
        }
        shown
    }
}

/// The part of a line, as parameters in 0…1, that a polygon occludes.
pub fn occluded_part(part: &Convex, a: DepthPoint, b: DepthPoint) -> Option<[f64; 2]> {
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
