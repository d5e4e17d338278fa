//! Faces as polygons in the picture plane.

use ugraster::{Corner, TRANSPARENT_VALUES};

use crate::error::Error;
use crate::lines::between;
use crate::planar::{Convex, DepthPoint, clipped_to_picture, convex_parts, doubled_area, sides};

/// Margin around the picture, in pixels, to which polygons are clipped.
const MARGIN: f64 = 4.0;

/// A polygon of the draw list, in pixels.
#[derive(Clone, Debug)]
pub struct Patch {
    /// The face.
    pub item: u32,
    /// True if the face is translucent.
    pub is_transparent: bool,
    /// The plane of the face, or 0, see [`ugscene::shared_planes`].
    pub plane: u32,
    /// The corners as in the rasterizer, between which colours are interpolated.
    contours: Vec<Vec<Corner<TRANSPARENT_VALUES>>>,
    /// Clipped to the picture and its margin; outlines counterclockwise as in [`Convex`], holes
    /// clockwise.
    pub outline: Vec<Vec<DepthPoint>>,
    /// The same, decomposed into convex parts.
    pub parts: Vec<Convex>,
    is_perspective: bool,
}

/// Interpolated values at a point.
pub struct Interpolants {
    pub values: [f32; TRANSPARENT_VALUES],
    pub key: f64,
}

impl Patch {
    /// `corners` are in pixels. `None` if no part of the polygon is in the picture. `room`: see
    /// [`convex_parts`].
    ///
    /// # Errors
    /// [`Error::CrossedFaces`]: there is not enough room.
    pub fn new(
        item: u32,
        is_transparent: bool,
        contours: Vec<Vec<Corner<TRANSPARENT_VALUES>>>,
        size: [u32; 2],
        is_perspective: bool,
        room: &mut usize,
    ) -> Result<Option<Self>, Error> {
        let place = |corner: &Corner<TRANSPARENT_VALUES>| [corner.x, corner.y, corner.key];
        let outline = contours
            .iter()
            .map(|contour| clipped_to_picture(contour.iter().map(place).collect(), size, MARGIN));
        let outline = oriented(outline.filter(|contour| contour.len() > 2).collect());
        let parts = convex_parts(&outline, room).ok_or(Error::CrossedFaces)?;
        Ok((!parts.is_empty()).then_some(Self {
            item,
            is_transparent,
            plane: 0,
            contours,
            outline,
            parts,
            is_perspective,
        }))
    }

    /// The interpolated values at a point; outside the polygon, those of the nearest point in the
    /// same row.
    pub fn interpolants_at(&self, [x, y]: [f64; 2]) -> Interpolants {
        let corners = || self.contours.iter().flatten();
        let top = corners().map(|corner| corner.y).fold(f64::INFINITY, f64::min);
        let bottom = corners().map(|corner| corner.y).fold(f64::NEG_INFINITY, f64::max);
        // The outline ends on its lowest row, so the row just above is used.
        let inset = 1e-9 * (bottom - top);
        let y = y.max(top + inset).min(bottom - inset);
        let mut crossings: Vec<Corner<TRANSPARENT_VALUES>> = self
            .contours
            .iter()
            .flat_map(|contour| contour.iter().zip(contour.iter().cycle().skip(1)))
            .filter(|(a, b)| (a.y <= y) != (b.y <= y))
            .map(|(a, b)| between(a, b, (y - a.y) / (b.y - a.y)))
            .collect();
        crossings.sort_by(|a, b| a.x.total_cmp(&b.x));
        let distance =
            |pair: &[Corner<TRANSPARENT_VALUES>]| (pair[0].x - x).max(x - pair[1].x).max(0.0);
        let nearest = crossings.chunks_exact(2).min_by(|a, b| distance(a).total_cmp(&distance(b)));
        let here = match nearest {
            Some([left, right]) if right.x > left.x => {
                between(left, right, ((x - left.x) / (right.x - left.x)).clamp(0.0, 1.0))
            }
            Some([left, ..]) => *left,
            _ => self.contours[0][0],
        };
        let scale = if self.is_perspective { 1.0 / here.key } else { 1.0 };
        Interpolants { values: here.values.map(|value| (value * scale) as f32), key: here.key }
    }

    /// True if their faces share a plane, so that their order in the scene decides which is visible.
    pub fn is_in_plane_of(&self, other: &Self) -> bool {
        self.plane != 0 && self.plane == other.plane
    }

    /// The least and greatest x and y.
    pub fn bounds(&self) -> [[f64; 2]; 2] {
        Convex::bounds(&self.parts)
    }

    /// The values if they are the same at all corners.
    pub fn single_values(&self) -> Option<[f32; TRANSPARENT_VALUES]> {
        let values = |corner: &Corner<TRANSPARENT_VALUES>| {
            let scale = if self.is_perspective { 1.0 / corner.key } else { 1.0 };
            corner.values.map(|value| (value * scale) as f32)
        };
        let first = values(self.contours.first()?.first()?);
        self.contours.iter().flatten().all(|corner| values(corner) == first).then_some(first)
    }
}

/// Orients contours: outlines counterclockwise, holes clockwise.
fn oriented(mut outline: Vec<Vec<DepthPoint>>) -> Vec<Vec<DepthPoint>> {
    let is_hole = |idx: usize| {
        let within = |other: &Vec<DepthPoint>| is_inside(other, outline[idx][0]);
        let others = outline.iter().enumerate().filter(|(other, _)| *other != idx);
        others.filter(|(_, other)| within(other)).count() % 2 == 1
    };
    let is_reversed = |idx: usize| (doubled_area(&outline[idx]) < 0.0) != is_hole(idx);
    let is_reversed: Vec<bool> = (0..outline.len()).map(is_reversed).collect();
    outline
        .iter_mut()
        .zip(is_reversed)
        .filter(|(_, is)| *is)
        .for_each(|(contour, _)| contour.reverse());
    outline
}

/// True if a point is inside a contour, by the even-odd rule.
fn is_inside(contour: &[DepthPoint], [x, y, _]: DepthPoint) -> bool {
    let crosses = |(a, b): &(DepthPoint, DepthPoint)| {
        (a[1] <= y) != (b[1] <= y) && a[0] + (b[0] - a[0]) * (y - a[1]) / (b[1] - a[1]) > x
    };
    sides(contour).filter(crosses).count() % 2 == 1
}
