//! Figures: areas and lines in paint order instead of pixels, and their files.
//!
//! A [`Figure`] is measured in pixels from the upper left corner; a pixel is a point of paper. What is painted
//! later covers what was painted before. Smooth colour is what a format has for it: [`Triangle`]s between whose
//! corners PostScript level 3 and PDF interpolate (shading type 4), and [`Gradient`]s along a line for SVG.
//!
//! Colours are display-encoded, as these formats interpolate them.
//!
//! # Seams
//!
//! Where two areas share an edge, a renderer that smooths edges lets some of what lies behind shine through: each
//! covers half of a pixel, and half of a half stays free. So of two areas the one painted first reaches under the
//! other by three quarters of a pixel, with a line of its own colour along the edge. Outlines against something else stay as they are,
//! also if something on the same side has the same edge: so all outlines must run the same way round what they enclose.

mod pdf;
mod postscript;
mod svg;

use std::collections::HashMap;

pub use pdf::pdf;
pub use postscript::{eps, ps};
pub use svg::svg;

/// Display-encoded red, green, blue.
pub type Rgb = [u8; 3];

/// A place, in pixels right of and below the upper left corner.
pub type Point = [f64; 2];

/// A picture of areas and lines. `S` is its smooth colour.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure<S> {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// What stands behind everything; `None` for a clear ground.
    pub background: Option<Rgb>,
    /// In the order of painting.
    pub elements: Vec<Element<S>>,
}

/// What is painted in one go.
#[derive(Clone, Debug, PartialEq)]
pub enum Element<S> {
    /// An area of one colour; inside by the even-odd rule.
    Area {
        /// Its outline, and those of its holes, which run the other way round.
        contours: Vec<Vec<Point>>,
        /// Its colour.
        color: Rgb,
        /// True if it lies on an area painted before that is as good as it but in colour; so it needs no seams.
        is_inside: bool,
    },
    /// An area of smooth colour.
    Smooth(S),
    /// A line of one colour with ends cut straight.
    Line {
        /// From where to where.
        ends: [Point; 2],
        /// Its width in pixels.
        width: f64,
        /// Its colour.
        color: Rgb,
    },
    /// What follows is cut off below so many pixel rows; if none, no more.
    CutBelow(Option<u32>),
}

/// A triangle with a colour at each corner; between them it is linear in the encoded colours.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Triangle {
    /// Its corners.
    pub corners: [Point; 3],
    /// Their colours.
    pub colors: [Rgb; 3],
}

/// An area whose encoded colour changes linearly along a line, and not across it.
#[derive(Clone, Debug, PartialEq)]
pub struct Gradient {
    /// Its outline, and those of its holes; even-odd rule.
    pub contours: Vec<Vec<Point>>,
    /// Where the colours are.
    pub ends: [Point; 2],
    /// The colours there.
    pub colors: [Rgb; 2],
    /// As that of an [`Element::Area`].
    pub is_inside: bool,
}

/// Width of the lines along shared edges. With 1 some 5 percent of what lies behind would still shine through, where
/// the edge is not in the middle of its pixels.
const SEAM_WIDTH: f64 = 1.5;

/// For each outline, the edges on whose other side an outline painted later lies. That on this side has none later.
fn seams<'a>(outlines: impl Iterator<Item = Option<&'a [Vec<Point>]>>) -> Vec<Vec<[Point; 2]>> {
    let outlines: Vec<_> = outlines.collect();
    // Only looked up, so its order is never seen.
    let mut last = HashMap::new();
    for (element, contours) in outlines.iter().enumerate() {
        contours.iter().copied().flat_map(edges).for_each(|edge| {
            last.insert(written(edge), element);
        });
    }
    let covered = |(element, contours): (usize, &Option<&'a [Vec<Point>]>)| {
        let is_covered = |&[a, b]: &[Point; 2]| {
            let is_last = last[&written([a, b])] == element;
            is_last && last.get(&written([b, a])).is_some_and(|&cover| cover > element)
        };
        contours.iter().copied().flat_map(edges).filter(is_covered).collect()
    };
    outlines.iter().enumerate().map(covered).collect()
}

/// The edges of outlines.
pub fn edges(contours: &[Vec<Point>]) -> impl Iterator<Item = [Point; 2]> {
    contours.iter().flat_map(|contour| {
        let ahead = contour.iter().cycle().skip(1);
        contour.iter().zip(ahead).map(|(&a, &b)| [a, b])
    })
}

/// The ends of an edge in hundredths of a pixel, the finest that is written.
pub type Written = [[i64; 2]; 2];

/// An edge as it is written.
pub fn written(edge: [Point; 2]) -> Written {
    edge.map(|point| point.map(hundredths))
}

/// The finest place that is written.
fn hundredths(coordinate: f64) -> i64 {
    (coordinate * 100.0).round() as i64
}

/// A coordinate as text, to a hundredth.
fn number(coordinate: f64) -> String {
    let hundredths = hundredths(coordinate);
    let (sign, size) = (if hundredths < 0 { "-" } else { "" }, hundredths.unsigned_abs());
    let (whole, part) = (size / 100, size % 100);
    match (whole, part) {
        (whole, 0) => format!("{sign}{whole}"),
        (0, part) if part % 10 == 0 => format!("{sign}.{}", part / 10),
        (0, part) => format!("{sign}.{part:02}"),
        (whole, part) if part % 10 == 0 => format!("{sign}{whole}.{}", part / 10),
        (whole, part) => format!("{sign}{whole}.{part:02}"),
    }
}

/// What PostScript and PDF paint in one go.
enum Painted<'a> {
    /// An area of one colour, and those of its edges that an area painted later has too.
    Area { contours: &'a [Vec<Point>], color: Rgb, seams: Vec<[Point; 2]> },
    /// A line.
    Line { ends: [Point; 2], width: f64, color: Rgb },
    /// All triangles up to the next area or line.
    Mesh(Mesh),
    /// As [`Element::CutBelow`].
    CutBelow(Option<u32>),
}

/// The elements of a figure in the order of painting.
fn painted(figure: &Figure<Triangle>) -> impl Iterator<Item = Painted<'_>> {
    let seams = seams(figure.elements.iter().map(|element| match element {
        Element::Area { contours, .. } => Some(&contours[..]),
        _ => None,
    }));
    let mut elements = figure.elements.iter().zip(seams).peekable();
    std::iter::from_fn(move || {
        let (element, seams) = elements.next()?;
        Some(match element {
            Element::Area { contours, color, .. } => Painted::Area { contours, color: *color, seams },
            Element::Line { ends, width, color } => {
                Painted::Line { ends: *ends, width: *width, color: *color }
            }
            Element::CutBelow(rows) => Painted::CutBelow(*rows),
            Element::Smooth(triangle) => {
                let mut mesh = Mesh::new();
                mesh.push(triangle);
                while let Some((Element::Smooth(triangle), _)) = elements.peek() {
                    mesh.push(triangle);
                    elements.next();
                }
                Painted::Mesh(mesh)
            }
        })
    })
}

/// Triangles for shading type 4: a flag, two coordinates and three colours a corner, the corners of a triangle in
/// succession. Coordinates are of 24 bits in steps of 1/256 pixel.
struct Mesh(Vec<u8>);

/// Places of a mesh begin so far left of and above the picture.
const MESH_MARGIN: f64 = 1024.0;

const MESH_STEPS: f64 = 256.0;

const MESH_BITS: u32 = 24;

impl Mesh {
    fn new() -> Self {
        Self(Vec::new())
    }

    fn push(&mut self, Triangle { corners, colors }: &Triangle) {
        for (place, color) in corners.iter().zip(colors) {
            self.0.push(0);
            for coordinate in place {
                let steps = ((coordinate + MESH_MARGIN) * MESH_STEPS).round() as u32;
                self.0.extend_from_slice(&steps.min((1 << MESH_BITS) - 1).to_be_bytes()[1..]);
            }
            self.0.extend_from_slice(color);
        }
    }

    /// The least and the greatest number of each coordinate and colour.
    fn decode() -> [f64; 10] {
        let end = f64::from((1u32 << MESH_BITS) - 1) / MESH_STEPS - MESH_MARGIN;
        [-MESH_MARGIN, end, -MESH_MARGIN, end, 0.0, 1.0, 0.0, 1.0, 0.0, 1.0]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        let rows = [
            (0.0, "0"),
            (-0.001, "0"),
            (0.5, ".5"),
            (-0.05, "-.05"),
            (12.0, "12"),
            (12.345, "12.35"),
            (-7.1, "-7.1"),
            (1e6, "1000000"),
        ];
        for (value, text) in rows {
            assert_eq!(number(value), text);
        }
    }

    #[test]
    fn the_area_painted_first_reaches_under_the_other() {
        let left = [vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]];
        let right = [vec![[1.0, 1.0], [1.0, 0.0], [2.0, 0.0], [2.0, 1.0]]];
        let seams = seams([Some(&left[..]), None, Some(&right[..])].into_iter());
        assert_eq!(seams, [vec![[[1.0, 0.0], [1.0, 1.0]]], vec![], vec![]]);
    }
}
