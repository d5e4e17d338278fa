//! Figures as PDF.

use pdf_writer::writers::StreamShadingType;
use pdf_writer::{Content, Filter, Name, Pdf, Ref, Str};

use super::pdf_font::{FONT_NAME, PdfFont};
use super::{
    Figure, GouraudTriangle, MESH_BITS, Mesh, PaintOp, Pane, Point, Rgb, SEAM_WIDTH, SLANT, Text,
    paint_ops, texts,
};
use crate::Metadata;
use crate::pdf::{FIRST, deflate, document};

/// The figure as a PDF file, one pixel per point.
pub fn pdf(figure: &Figure<GouraudTriangle>, metadata: &Metadata) -> Vec<u8> {
    let [width, height] = figure.size.map(|side| side as f32);
    let font = PdfFont::of(texts(figure));
    let mut page =
        Page { content: Content::new(), meshes: Vec::new(), font: &font, color: None, width: None };
    page.content.transform([1.0, 0.0, 0.0, -1.0, 0.0, height]);
    if let Some(background) = figure.background {
        page.set_color(background);
        page.content.rect(0.0, 0.0, width, height).fill_nonzero();
    }
    page.draw(figure);
    let Page { content, meshes, .. } = page;
    let mut pdf = Pdf::new();
    let ids = (FIRST..).map(Ref::new);
    for (mesh, id) in meshes.iter().zip(ids) {
        let data = deflate(&mesh.0);
        let mut shading = pdf.stream_shading(id, &data);
        shading.filter(Filter::FlateDecode);
        shading.shading_type(StreamShadingType::FreeformGouraud).color_space().device_rgb();
        shading.bits_per_coordinate(MESH_BITS as i32).bits_per_component(8).bits_per_flag(8);
        shading.decode(Mesh::decode().map(|number| number as f32));
    }
    let font_id = Ref::new(FIRST + meshes.len() as i32);
    if !font.is_empty() {
        font.write(&mut pdf, font_id);
    }
    document(pdf, figure.size, metadata, content.finish().as_slice(), |resources| {
        if !font.is_empty() {
            resources.fonts().pair(Name(FONT_NAME), font_id);
        }
        if !meshes.is_empty() {
            let mut shadings = resources.shadings();
            for number in 0..meshes.len() {
                shadings.pair(Name(mesh_name(number).as_bytes()), Ref::new(FIRST + number as i32));
            }
        }
    })
}

fn mesh_name(number: usize) -> String {
    format!("M{number}")
}

/// The page content so far, and the current colour and line width.
struct Page<'a> {
    content: Content,
    meshes: Vec<Mesh>,
    font: &'a PdfFont,
    color: Option<Rgb>,
    width: Option<f64>,
}

impl Page<'_> {
    fn draw(&mut self, figure: &Figure<GouraudTriangle>) {
        for op in paint_ops(figure) {
            match op {
                PaintOp::Area { contours, color, seams } => {
                    self.set_color(color);
                    contours.iter().for_each(|contour| self.add_contour(contour));
                    self.content.fill_even_odd();
                    self.stroke(&seams, SEAM_WIDTH);
                }
                PaintOp::Line { ends, width, color } => {
                    self.set_color(color);
                    self.stroke(&[ends], width);
                }
                PaintOp::Mesh(mesh) => {
                    self.content.shading(Name(mesh_name(self.meshes.len()).as_bytes()));
                    self.meshes.push(mesh);
                }
                PaintOp::Text(text) => self.show(text),
                PaintOp::Pane(window) => self.window(window),
            }
        }
    }

    /// Begins or ends a window. Saving and restoring the graphics state also affects colour and
    /// line width, so they are set again.
    fn window(&mut self, window: Option<Pane>) {
        (self.color, self.width) = (None, None);
        match window {
            Some(Pane { corner, size }) => {
                self.content.save_state();
                if corner != [0, 0] {
                    let [left, top] = corner.map(|side| side as f32);
                    self.content.transform([1.0, 0.0, 0.0, 1.0, left, top]);
                }
                let [width, height] = size.map(|side| side as f32);
                self.content.rect(0.0, 0.0, width, height);
                self.content.clip_nonzero().end_path();
            }
            None => {
                self.content.restore_state();
            }
        }
    }

    fn add_contour(&mut self, contour: &[Point]) {
        let mut points = contour.iter().map(rounded);
        let Some([x, y]) = points.next() else { return };
        self.content.move_to(x, y);
        for [x, y] in points {
            self.content.line_to(x, y);
        }
        self.content.close_path();
    }

    fn stroke(&mut self, lines: &[[Point; 2]], width: f64) {
        if lines.is_empty() {
            return;
        }
        if self.width != Some(width) {
            self.width = Some(width);
            self.content.set_line_width(width as f32);
        }
        for [a, b] in lines {
            let ([ax, ay], [bx, by]) = (rounded(a), rounded(b));
            self.content.move_to(ax, ay).line_to(bx, by);
        }
        self.content.stroke();
    }

    fn show(&mut self, text: &Text) {
        self.set_color(text.color);
        let [x, y] = rounded(&text.origin);
        // Rows of the page count downwards, letters stand upright.
        self.content.begin_text().set_font(Name(FONT_NAME), text.size as f32);
        let slant = if text.is_slanted { SLANT as f32 } else { 0.0 };
        self.content.set_text_matrix([1.0, 0.0, slant, -1.0, x, y]);
        let mut line = self.content.show_positioned();
        let mut items = line.items();
        for (bytes, adjustment) in self.font.runs(text) {
            items.show(Str(&bytes));
            if adjustment != 0.0 {
                items.adjust(adjustment);
            }
        }
        drop(items);
        drop(line);
        self.content.end_text();
    }

    fn set_color(&mut self, color: Rgb) {
        if self.color != Some(color) {
            self.color = Some(color);
            // Three decimals distinguish all 256 levels.
            let [r, g, b] = color.map(|level| (f32::from(level) / 0.255).round() / 1000.0);
            self.content.set_fill_rgb(r, g, b).set_stroke_rgb(r, g, b);
        }
    }
}

/// Rounded to hundredths, to keep files small.
fn rounded(point: &Point) -> [f32; 2] {
    point.map(|coordinate| ((coordinate * 100.0).round() / 100.0) as f32)
}
