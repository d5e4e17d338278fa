//! Lines of the picture: wires, and edges of faces.
//!
//! 1. [`edges`]: which edges of faces are drawn;
//! 2. here: lines with their colours, projected; curved under `-xc` ([`mod@curved`]);
//! 3. [`hidden`]: their visible parts, computed and not sampled;
//! 4. these parts as strips for the rasterizer, or unchanged for figures.
//!
//! Visibility is decided along the centre line alone. So a line has its full width everywhere, also
//! along the edge of a face at a grazing angle, and on a silhouette.

mod curved;
mod edges;
mod hidden;

use curved::{curved, keeps_light};
use edges::{Edge, chained, edges};
use glam::DVec3;
use rayon::prelude::*;
use ugphysics::{Hsv, srgb_decode};
use ugraster::{Corner, PolygonList, TRANSPARENT_VALUES};
use ugscene::{BodyId, CameraPoint, VertexId, Wire};

use crate::clip::{Vertex, clip_segment};
use crate::config::{HiddenLines, Wireframe};
use crate::packing::pack_transparent;
use crate::painter::Painter;
pub use hidden::{Occluders, Visibility, occluded_part};
use uglight::{ColorForm, Swatch};

/// Lines are moved towards the eye by this part of their distance, so that they pass the depth test
/// against the faces whose edges they are.
pub const LIFT: f64 = 5e-4;

/// Visible parts shorter than this, in samples, are due to rounding and left out.
const LEAST: f64 = 1e-3;

/// Width of hidden lines, in units of that of lines.
const HIDDEN_WIDTH: f64 = 0.6;

/// Dashes of hidden lines and the gaps between them, in units of the width of lines.
const DASH: [f64; 2] = [5.0, 3.0];

/// A straight line at rest.
#[derive(Clone, Copy, Debug)]
pub struct Line {
    /// Row of its wire, or of the face whose edge it is.
    pub item: u32,
    /// The body it is part of.
    pub body: BodyId,
    /// The vertices at its ends.
    pub ends: [VertexId; 2],
    /// Colours of the ends.
    pub colors: [Swatch; 2],
    /// Indices of the spectra of the ends, if colours are spectra.
    pub rows: Option<[u32; 2]>,
    /// It continues the line before it.
    pub continues: bool,
    /// The side of a silhouette on which the body is not, see [`Edge::outward`].
    outward: f64,
}

/// A corner of a polyline.
#[derive(Clone, Copy, Debug)]
pub struct Joint {
    /// Its apparent position, relative to the eye.
    pub seen: DVec3,
    /// Its apparent colour.
    pub color: Swatch,
}

/// A visible straight part of a line in the picture, in samples.
#[derive(Clone, Copy, Debug)]
pub struct Stroke {
    /// See [`Line`].
    pub item: u32,
    /// Ends of its centre line.
    pub ends: [Corner<TRANSPARENT_VALUES>; 2],
    /// True where the line itself ends, false where it becomes hidden. At its own ends it is
    /// extended by half its width, so that the pieces of a polyline join.
    pub is_end: [bool; 2],
    /// Its width, in units of that of visible lines.
    pub width: f64,
    /// See [`Line`].
    outward: f64,
    /// It continues the one before it.
    continues: bool,
    /// How far it is from the beginning of those it continues to its own, in samples.
    from: f64,
}

/// Wires, and the edges that `wireframe` requests. `is_exact`: colours are shifted along them.
pub fn lines(painter: &Painter<'_>, wireframe: Option<Wireframe>, is_exact: bool) -> Vec<Line> {
    let n_faces = painter.scene.faces.len();
    // Colours given as light on a body whose hues are shifted are drawn as hues.
    let keeps_light = |body: BodyId| !is_exact || keeps_light(painter, body);
    let mut lines = Vec::new();
    for (row, wire) in painter.scene.wires.iter().enumerate() {
        // The text of a scene is below 4 GiB, so row numbers fit.
        push_wire(painter, (n_faces + row) as u32, wire, keeps_light(wire.body), &mut lines);
    }
    if let Some(wireframe) = wireframe {
        let edges = edges(painter, wireframe.edges);
        let edges = match wireframe.hidden {
            HiddenLines::Dashed => chained(edges),
            _ => edges.into_iter().map(|edge| (edge, false)).collect(),
        };
        lines.extend(edges.iter().map(|(edge, continues)| Line {
            continues: *continues,
            ..edge_line(painter, edge, wireframe, &keeps_light)
        }));
    }
    lines
}

fn push_wire(
    painter: &Painter<'_>,
    item: u32,
    wire: &Wire,
    keeps_light: bool,
    lines: &mut Vec<Line>,
) {
    let end = painter.wire_swatch(wire, keeps_light);
    for contour in painter.scene.wire_contours(wire) {
        for (row, ends) in contour.windows(2).enumerate() {
            let ends = [ends[0], ends[1]];
            let rows = Some(ends.map(|vertex| painter.wire_end_row(vertex, wire)));
            lines.push(Line {
                item,
                body: wire.body,
                ends,
                colors: ends.map(&end),
                rows,
                continues: row > 0,
                outward: 0.0,
            });
        }
    }
}

/// An edge as a line: unlit, in the colour of its face or of `wireframe`.
fn edge_line(
    painter: &Painter<'_>,
    edge: &Edge,
    wireframe: Wireframe,
    keeps_light: &impl Fn(BodyId) -> bool,
) -> Line {
    let face = &painter.scene.faces[edge.face as usize];
    let colors = match wireframe.color {
        Some(color) => [plain(color); 2],
        None => {
            let is_moving = !keeps_light(face.body);
            let colors = painter.appearance.face_colors_in_motion(painter.scene, face, is_moving);
            edge.ends
                .map(|end| Swatch { translucency: 0.0, ..painter.appearance.swatch(end, &colors) })
        }
    };
    let rows =
        wireframe.color.is_none().then(|| edge.ends.map(|end| painter.appearance.surface.row(end)));
    Line {
        item: edge.face,
        body: face.body,
        ends: edge.ends,
        colors,
        rows,
        continues: false,
        outward: edge.outward,
    }
}

/// A colour that is neither shifted nor attenuated.
fn plain(color: Hsv) -> Swatch {
    Swatch {
        form: ColorForm::Light(DVec3::from_array(color.to_rgb().map(srgb_decode))),
        ..Swatch::WHITE
    }
}

/// Straight pieces of lines in the picture, hidden or not.
/// `is_exact`: lines of moving bodies are seen as curves.
pub fn pieces(painter: &Painter<'_>, lines: &[Line], is_exact: bool) -> Vec<Stroke> {
    let straight = |line: &Line| {
        let seen = |end: VertexId| painter.scene.vertices[end.index()].position - painter.view.eye;
        [0, 1].map(|end| Joint { seen: seen(line.ends[end]), color: line.colors[end] }).to_vec()
    };
    let of = |line: &Line| {
        let joint = |joint: &Joint| vertex(painter.view.place(joint.seen), &joint.color);
        let joints = if is_exact { curved(painter, line) } else { straight(line) };
        let joints: Vec<_> = joints.iter().map(joint).collect();
        let piece = |(row, ends): (usize, &[Vertex<TRANSPARENT_VALUES>])| {
            piece(painter, line, [ends[0], ends[1]], line.continues || row > 0)
        };
        joints.windows(2).enumerate().filter_map(piece).collect::<Vec<_>>()
    };
    let mut pieces: Vec<Stroke> = lines.par_iter().flat_map_iter(of).collect();
    let mut from = 0.0;
    for piece in &mut pieces {
        piece.from = if piece.continues { from } else { 0.0 };
        from = piece.from + piece.length();
    }
    pieces
}

/// The piece between two joints, clipped to the slab.
fn piece(
    painter: &Painter<'_>,
    line: &Line,
    ends: [Vertex<TRANSPARENT_VALUES>; 2],
    continues: bool,
) -> Option<Stroke> {
    let view = painter.view;
    let ends =
        clip_segment(view.slab, ends)?.map(|end| lifted(painter, end).project(view.is_perspective));
    let mut numbers =
        ends.iter().flat_map(|end| [end.x, end.y, end.key].into_iter().chain(end.values));
    let &Line { item, outward, .. } = line;
    let stroke =
        Stroke { item, ends, is_end: [true; 2], width: 1.0, outward, continues, from: 0.0 };
    numbers.all(f64::is_finite).then_some(stroke)
}

impl Stroke {
    /// Least and greatest x and y.
    pub fn bounds(&self) -> [[f64; 2]; 2] {
        let [a, b] = &self.ends;
        [[a.x.min(b.x), a.y.min(b.y)], [a.x.max(b.x), a.y.max(b.y)]]
    }

    fn length(&self) -> f64 {
        let [a, b] = &self.ends;
        libm::hypot(b.x - a.x, b.y - a.y)
    }

    /// Its parts that are in the picture: what is drawn of those that are hidden, and those that
    /// are not. `width`: of lines.
    fn parts(&self, visibility: &Visibility<'_>, hidden: HiddenLines, width: f64) -> Vec<Self> {
        let length = self.length();
        // Visibility of a silhouette is that of its outer side: faces of a moving body are seen
        // bent, and the polygons drawn for them may bulge over the silhouette.
        let out = if length > 0.0 { 0.5 * width * self.outward / length } else { 0.0 };
        let [from, to] = &self.ends;
        let [along_x, along_y] = [to.x - from.x, to.y - from.y];
        let [a, b] = [from, to].map(|end| [end.x - out * along_y, end.y + out * along_x, end.key]);
        // A line seen end-on is a dot.
        let is_drawn = |[start, end]: &[f64; 2]| (end - start) * length > LEAST || length <= LEAST;
        let stroke = |[start, end]: [f64; 2], width: f64| Self {
            ends: [start, end].map(|part| between(&self.ends[0], &self.ends[1], part)),
            is_end: [start == 0.0, end == 1.0],
            width,
            ..*self
        };
        let mut visible = visibility.parts(a, b);
        visible.retain(is_drawn);
        let behind = match hidden {
            HiddenLines::Omitted => Vec::new(),
            HiddenLines::Thin => visibility.hidden_parts(a, b, &visible),
            HiddenLines::Dashed => {
                let hidden = visibility.hidden_parts(a, b, &visible);
                // At least samples long, so that the picture bounds how many there are.
                let dash = DASH.map(|part| width.max(1.0) * part);
                hidden.into_iter().flat_map(|part| self.dashes(part, dash)).collect()
            }
        };
        let behind = behind.into_iter().filter(is_drawn).map(|part| stroke(part, HIDDEN_WIDTH));
        behind.chain(visible.into_iter().map(|part| stroke(part, 1.0))).collect()
    }

    /// The dashes of a part. `dash`, `gap`: their lengths.
    fn dashes(&self, [start, end]: [f64; 2], [dash, gap]: [f64; 2]) -> Vec<[f64; 2]> {
        let (length, period) = (self.length(), dash + gap);
        let first = ((self.from + start * length) / period).floor();
        let last = ((self.from + end * length) / period).floor();
        let dash = |number: f64| {
            let begin = number * period - self.from;
            [begin, begin + dash]
                .map(|at| if length > 0.0 { (at / length).clamp(start, end) } else { start })
        };
        let dashes = (0..=(last - first) as usize).map(|number| dash(first + number as f64));
        dashes.filter(|[start, end]| start < end).collect()
    }
}

/// What is drawn of pieces. `width`: of lines, in samples.
pub fn strokes(
    pieces: &[Stroke],
    visibility: &Visibility<'_>,
    hidden: HiddenLines,
    width: f64,
) -> Vec<Stroke> {
    pieces.par_iter().flat_map_iter(|piece| piece.parts(visibility, hidden, width)).collect()
}

fn vertex(place: CameraPoint, color: &Swatch) -> Vertex<TRANSPARENT_VALUES> {
    Vertex { place, values: pack_transparent(color, DVec3::ONE) }
}

/// Moves an end of a line towards the eye along its own ray.
fn lifted(painter: &Painter<'_>, end: Vertex<TRANSPARENT_VALUES>) -> Vertex<TRANSPARENT_VALUES> {
    let CameraPoint { x, y, z } = end.place;
    let place = if painter.view.is_perspective {
        let ratio = 1.0 - LIFT;
        CameraPoint { x: x * ratio, y: y * ratio, z: z * ratio }
    } else {
        CameraPoint { x, y, z: z - LIFT * painter.view.distance }
    };
    Vertex { place, ..end }
}

/// Linear interpolation in the picture.
pub fn between(
    a: &Corner<TRANSPARENT_VALUES>,
    b: &Corner<TRANSPARENT_VALUES>,
    part: f64,
) -> Corner<TRANSPARENT_VALUES> {
    let mix = |a: f64, b: f64| if part == 1.0 { b } else { a + (b - a) * part };
    Corner {
        x: mix(a.x, b.x),
        y: mix(a.y, b.y),
        key: mix(a.key, b.key),
        values: std::array::from_fn(|i| mix(a.values[i], b.values[i])),
    }
}

/// Strokes as strips of this width, in samples.
pub fn strips(
    painter: &Painter<'_>,
    strokes: &[Stroke],
    width: f64,
) -> PolygonList<TRANSPARENT_VALUES> {
    let mut list = PolygonList::default();
    for stroke in strokes {
        let Stroke { item, ends: [a, b], is_end, .. } = stroke;
        let (length, width) = (stroke.length(), width * stroke.width);
        let along =
            if length > 0.0 { [(b.x - a.x) / length, (b.y - a.y) / length] } else { [1.0, 0.0] };
        let [along_x, along_y] = along.map(|part| 0.5 * width * part);
        let [before, behind] = is_end.map(|is_end| f64::from(u8::from(is_end)));
        let corner = |end: &Corner<TRANSPARENT_VALUES>, forth: f64, aside: f64| Corner {
            x: end.x + forth * along_x - aside * along_y,
            y: end.y + forth * along_y + aside * along_x,
            ..*end
        };
        for corner in [
            corner(a, -before, -1.0),
            corner(b, behind, -1.0),
            corner(b, behind, 1.0),
            corner(a, -before, 1.0),
        ] {
            list.push_corner(corner);
        }
        list.end_contour();
        list.end_polygon(painter.grid, *item);
    }
    list.sort_into_bands(painter.grid);
    list
}
