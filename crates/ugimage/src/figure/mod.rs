//! Vector figures: areas and lines in painting order, and the files they are written to.
//!
//! Coordinates of a [`Figure`] are in pixels from the upper left corner; one pixel is one point
//! (1/72 inch). Later elements cover earlier ones. How smooth colour is represented depends on the
//! format: PostScript level 3 and PDF interpolate between the corners of [`GouraudTriangle`]s
//! (shading type 4), and SVG has [`Gradient`]s along a line.
//!
//! Colours are display-encoded, because these formats interpolate encoded colours.
//!
//! # Seams
//!
//! Where two areas share an edge, viewers that antialias each area separately let the background
//! show through: each area covers half of a pixel on the edge, so a quarter of the background
//! remains. To hide this seam, the area painted first is extended under the other one by three
//! quarters of a pixel, with a line of its own colour along the shared edge. Other edges are not
//! extended.
//!
//! An edge is shared only between areas on opposite sides of it. This is decided by the direction
//! of the edge, so all outlines must have the same orientation (clockwise, say).

mod pdf;
mod pdf_font;
mod postscript;
mod postscript_font;
mod svg;

use std::collections::HashMap;

pub use pdf::pdf;
pub use postscript::{eps, ps};
pub use svg::svg;

/// Display-encoded (sRGB) red, green, blue.
pub type Rgb = [u8; 3];

/// A point, in pixels to the right of and below the upper left corner.
pub type Point = [f64; 2];

/// A figure of areas and lines. `S` is the type of its areas of smooth colour:
/// [`GouraudTriangle`] or [`Gradient`].
#[derive(Clone, Debug, PartialEq)]
pub struct Figure<S> {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// The background colour; `None` for a transparent background.
    pub background: Option<Rgb>,
    /// The elements, in painting order.
    pub elements: Vec<Element<S>>,
}

/// An element of a figure.
#[derive(Clone, Debug, PartialEq)]
pub enum Element<S> {
    /// An area of one colour, filled by the even-odd rule.
    Area {
        /// The outline, and the outlines of holes, which have the opposite orientation.
        contours: Vec<Vec<Point>>,
        /// Its colour.
        color: Rgb,
        /// True if it lies inside an area painted before and differs from it only in colour, so
        /// that its edges need no extension (see [Seams](self#seams)).
        is_inside: bool,
    },
    /// An area of smooth colour.
    Smooth(S),
    /// A line of one colour with butt ends.
    Line {
        /// Its two ends.
        ends: [Point; 2],
        /// Its width in pixels.
        width: f64,
        /// Its colour.
        color: Rgb,
    },
    /// A line of text.
    Text(Text),
    /// The following elements are clipped to this rectangle, and their origin is its upper left
    /// corner. `None`: no longer.
    Pane(Option<Pane>),
}

/// A rectangle of pixels in a larger picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pane {
    /// Column and row of the upper left corner.
    pub corner: [u32; 2],
    /// Width and height.
    pub size: [u32; 2],
}

/// A line of text in the embedded font, DejaVu Sans, which has all of its characters.
#[derive(Clone, Debug, PartialEq)]
pub struct Text {
    /// Its characters.
    pub text: String,
    /// The distance of the origin of each character from that of the first, in pixels.
    pub places: Vec<f64>,
    /// The beginning of the baseline.
    pub origin: Point,
    /// The em size in pixels.
    pub size: f64,
    /// Its colour.
    pub color: Rgb,
    /// True for letters slanted by [`SLANT`].
    pub is_slanted: bool,
}

/// Tangent of the angle by which the stems of slanted letters lean to the right.
pub const SLANT: f64 = 0.2;

/// A triangle with a colour at each corner, interpolated linearly between them in display encoding.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GouraudTriangle {
    /// The corners.
    pub corners: [Point; 3],
    /// The colours at the corners.
    pub colors: [Rgb; 3],
}

/// An area with a linear gradient: its display-encoded colour changes along a line and is constant
/// across it.
#[derive(Clone, Debug, PartialEq)]
pub struct Gradient {
    /// The outline and the outlines of holes, filled by the even-odd rule.
    pub contours: Vec<Vec<Point>>,
    /// The points at which the gradient has its end colours.
    pub ends: [Point; 2],
    /// The colours at the ends.
    pub colors: [Rgb; 2],
    /// As in [`Element::Area`].
    pub is_inside: bool,
}

/// Width in pixels of the lines along shared edges. With 1, about 5 percent of the background would
/// still show through where an edge is not at the middle of its pixels.
const SEAM_WIDTH: f64 = 1.5;

/// For each element, the edges that it shares with an element painted later on the other side, and
/// with none painted later on its own side.
fn seams<'a>(outlines: impl Iterator<Item = Option<&'a [Vec<Point>]>>) -> Vec<Vec<[Point; 2]>> {
    let outlines: Vec<_> = outlines.collect();
    // Used for look-up only, so the hash order never affects the output.
    let mut last = HashMap::new();
    for (element, contours) in outlines.iter().enumerate() {
        contours.iter().copied().flat_map(edges).for_each(|edge| {
            last.insert(snapped(edge), element);
        });
    }
    let covered = |(element, contours): (usize, &Option<&'a [Vec<Point>]>)| {
        let is_covered = |&[a, b]: &[Point; 2]| {
            let is_last = last[&snapped([a, b])] == element;
            is_last && last.get(&snapped([b, a])).is_some_and(|&cover| cover > element)
        };
        contours.iter().copied().flat_map(edges).filter(is_covered).collect()
    };
    outlines.iter().enumerate().map(covered).collect()
}

/// The directed edges of outlines.
pub fn edges(contours: &[Vec<Point>]) -> impl Iterator<Item = [Point; 2]> {
    contours.iter().flat_map(|contour| {
        let ahead = contour.iter().cycle().skip(1);
        contour.iter().zip(ahead).map(|(&a, &b)| [a, b])
    })
}

/// The ends of an edge in hundredths of a pixel, the resolution of the files.
pub type SnappedEdge = [[i64; 2]; 2];

/// An edge rounded to the resolution of the files.
pub fn snapped(edge: [Point; 2]) -> SnappedEdge {
    edge.map(|point| point.map(hundredths))
}

/// A coordinate in hundredths of a pixel.
fn hundredths(coordinate: f64) -> i64 {
    (coordinate * 100.0).round() as i64
}

/// A coordinate as text, rounded to hundredths, without redundant zeros.
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

/// A painting operation of PostScript and PDF.
enum PaintOp<'a> {
    /// An area of one colour, and the edges along which it is extended.
    Area { contours: &'a [Vec<Point>], color: Rgb, seams: Vec<[Point; 2]> },
    /// A line.
    Line { ends: [Point; 2], width: f64, color: Rgb },
    /// See [`Element::Text`].
    Text(&'a Text),
    /// All consecutive triangles.
    Mesh(Mesh),
    /// See [`Element::Pane`].
    Pane(Option<Pane>),
}

/// The lines of text of a figure.
fn texts<S>(figure: &Figure<S>) -> impl Iterator<Item = &Text> {
    figure.elements.iter().filter_map(|element| match element {
        Element::Text(text) => Some(text),
        _ => None,
    })
}

/// The painting operations of a figure.
fn paint_ops(figure: &Figure<GouraudTriangle>) -> impl Iterator<Item = PaintOp<'_>> {
    let seams = seams(figure.elements.iter().map(|element| match element {
        Element::Area { contours, .. } => Some(&contours[..]),
        _ => None,
    }));
    let mut elements = figure.elements.iter().zip(seams).peekable();
    std::iter::from_fn(move || {
        let (element, seams) = elements.next()?;
        Some(match element {
            Element::Area { contours, color, .. } => {
                PaintOp::Area { contours, color: *color, seams }
            }
            Element::Line { ends, width, color } => {
                PaintOp::Line { ends: *ends, width: *width, color: *color }
            }
            Element::Text(text) => PaintOp::Text(text),
            Element::Pane(window) => PaintOp::Pane(*window),
            Element::Smooth(triangle) => {
                let mut mesh = Mesh::new();
                mesh.push(triangle);
                while let Some((Element::Smooth(triangle), _)) = elements.peek() {
                    mesh.push(triangle);
                    elements.next();
                }
                PaintOp::Mesh(mesh)
            }
        })
    })
}

/// The data of shading type 4 (free-form triangle mesh). Each corner has a flag, two coordinates of
/// 24 bits in steps of 1/256 pixel, and three colour channels; the corners of a triangle follow
/// each other.
struct Mesh(Vec<u8>);

/// The coordinate range of a mesh begins this many pixels left of and above the figure.
const MESH_MARGIN: f64 = 1024.0;

const MESH_STEPS: f64 = 256.0;

const MESH_BITS: u32 = 24;

impl Mesh {
    fn new() -> Self {
        Self(Vec::new())
    }

    fn push(&mut self, GouraudTriangle { corners, colors }: &GouraudTriangle) {
        for (place, color) in corners.iter().zip(colors) {
            self.0.push(0);
            for coordinate in place {
                let steps = ((coordinate + MESH_MARGIN) * MESH_STEPS).round() as u32;
                self.0.extend_from_slice(&steps.min((1 << MESH_BITS) - 1).to_be_bytes()[1..]);
            }
            self.0.extend_from_slice(color);
        }
    }

    /// The `Decode` array: the smallest and largest value of each coordinate and colour channel.
    fn decode() -> [f64; 10] {
        let end = f64::from((1u32 << MESH_BITS) - 1) / MESH_STEPS - MESH_MARGIN;
        [-MESH_MARGIN, end, -MESH_MARGIN, end, 0.0, 1.0, 0.0, 1.0, 0.0, 1.0]
    }
}
