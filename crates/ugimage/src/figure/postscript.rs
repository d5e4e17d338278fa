//! Figures as PostScript level 3.

use super::postscript_font::{definition, show};
use super::{
    Figure, GouraudTriangle, MESH_BITS, Mesh, PaintOp, Pane, Point, Rgb, SEAM_WIDTH, number,
    paint_ops, texts,
};
use crate::Metadata;
use crate::pdf::deflate;
use crate::postscript::{Ascii85, wrap};

/// The figure as an EPS file, one pixel per point.
pub fn eps(figure: &Figure<GouraudTriangle>, metadata: &Metadata) -> Vec<u8> {
    wrap(figure.size, 3, metadata, &drawing(figure), true)
}

/// The figure as a PostScript document of one page, one pixel per point.
pub fn ps(figure: &Figure<GouraudTriangle>, metadata: &Metadata) -> Vec<u8> {
    wrap(figure.size, 3, metadata, &drawing(figure), false)
}

/// Definitions at the start of the drawing. As for images, the filters are stored in variables so
/// that both can be flushed after the data.
fn prologue([width, height]: [u32; 2]) -> String {
    let decode = Mesh::decode().map(|number| number.to_string()).join(" ");
    format!(
        "gsave\n\
         0 0 {width} {height} rectclip\n\
         0 {height} translate 1 -1 scale\n\
         /m /moveto load def /l /lineto load def /h /closepath load def\n\
         /f /eofill load def /s /stroke load def /w /setlinewidth load def\n\
         /c {{ 3 {{ 255 div 3 1 roll }} repeat setrgbcolor }} bind def\n\
         /UgMesh {{\n\
         /UgText currentfile /ASCII85Decode filter def\n\
         /UgData UgText /FlateDecode filter def\n\
         << /ShadingType 4 /ColorSpace /DeviceRGB /BitsPerCoordinate {MESH_BITS} /BitsPerComponent 8\n\
         /BitsPerFlag 8 /Decode [{decode}]\n\
         /DataSource UgData >> shfill\n\
         UgData flushfile UgText flushfile\n\
         }} def\n"
    )
}

fn drawing(figure: &Figure<GouraudTriangle>) -> Vec<u8> {
    let mut page = Page { out: prologue(figure.size).into_bytes(), color: None, width: None };
    definition(texts(figure), &mut page.out);
    if let Some(background) = figure.background {
        let [width, height] = figure.size;
        page.set_color(background);
        page.add(&format!("0 0 {width} {height} rectfill\n"));
    }
    for op in paint_ops(figure) {
        match op {
            PaintOp::Area { contours, color, seams } => {
                page.set_color(color);
                page.add(&path(contours));
                page.add("f\n");
                if !seams.is_empty() {
                    page.set_width(SEAM_WIDTH);
                    page.add(&seams.iter().map(line).collect::<String>());
                    page.add("s\n");
                }
            }
            PaintOp::Line { ends, width, color } => {
                page.set_color(color);
                page.set_width(width);
                page.add(&line(&ends));
                page.add("s\n");
            }
            PaintOp::Mesh(mesh) => {
                page.add("UgMesh\n");
                Ascii85::encode(&deflate(&mesh.0), &mut page.out);
            }
            PaintOp::Text(text) => {
                page.set_color(text.color);
                page.add(&show(text));
            }
            PaintOp::Pane(window) => page.window(window),
        }
    }
    page.add("grestore\n");
    page.out
}

/// The path of outlines.
fn path(contours: &[Vec<Point>]) -> String {
    let step = |(idx, [x, y]): (usize, [String; 2])| {
        format!("{x} {y} {}\n", if idx == 0 { 'm' } else { 'l' })
    };
    let contour = |contour: &Vec<Point>| {
        let steps = contour.iter().map(|point| point.map(number)).enumerate().map(step);
        steps.chain(["h\n".to_owned()]).collect::<String>()
    };
    contours.iter().map(contour).collect()
}

fn line([a, b]: &[Point; 2]) -> String {
    let [x, y] = b.map(number);
    format!("{} {} m {x} {y} l\n", number(a[0]), number(a[1]))
}

/// The code so far, and the current colour and line width.
struct Page {
    out: Vec<u8>,
    color: Option<Rgb>,
    width: Option<f64>,
}

impl Page {
    fn add(&mut self, text: &str) {
        self.out.extend_from_slice(text.as_bytes());
    }

    /// Begins or ends a window. Saving and restoring the graphics state also affects colour and
    /// line width, so they are set again.
    fn window(&mut self, window: Option<Pane>) {
        (self.color, self.width) = (None, None);
        match window {
            Some(Pane { corner: [left, top], size: [width, height] }) => {
                let moved = match (left, top) {
                    (0, 0) => String::new(),
                    _ => format!("{left} {top} translate "),
                };
                self.add(&format!("gsave {moved}0 0 {width} {height} rectclip\n"));
            }
            None => self.add("grestore\n"),
        }
    }

    fn set_color(&mut self, color: Rgb) {
        if self.color != Some(color) {
            self.color = Some(color);
            let [red, green, blue] = color;
            self.add(&format!("{red} {green} {blue} c\n"));
        }
    }

    fn set_width(&mut self, width: f64) {
        if self.width != Some(width) {
            self.width = Some(width);
            self.add(&format!("{} w\n", number(width)));
        }
    }
}
