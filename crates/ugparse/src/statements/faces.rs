//! `v`, `f`, `w` and `label`. The simplest `v` and `f` are read by the
//! [fast path](crate::fast_path).

use std::ops::Range;

use glam::DVec3;
use ugscene::{BodyId, Face, FaceShape, Shading, ShadingId, SurfaceId, Vertex, VertexId, Wire};

use super::grammar::{Grammar, NAME, Outcome, refuse};
use super::motions::write_motion_of;
use super::options::zero_vector;
use crate::numbered::Name;
use crate::row_writer::{RowWriter, WriteRow};
use crate::source::Span;
use crate::statement::NameKind;
use crate::token::{label_text, mark, number, number32, point};

impl<'t> Grammar<'t, '_> {
    pub fn vertex(&mut self) -> Outcome<'t> {
        let name = self.name(NAME)?;
        let position = self.take(point)?;
        let color = self.optional_color()?;
        let at = self.rest;
        let normal = self.optional(point)?;
        if normal == Some(DVec3::ZERO) {
            return refuse(at, zero_vector(3));
        }
        let mut uv = None;
        if self.optional(mark(b'(', "`(` and texture coordinates"))?.is_some() {
            uv = Some([self.take(number32)?, self.take(number32)?]);
            self.take(mark(b')', "`)`"))?;
        }
        self.end()?;
        let vertex = Vertex { normal, uv, ..Vertex::at(position, color) };
        self.scope.push_vertex(Name::new(name.of(self.text)), name, vertex);
        Ok(())
    }

    pub fn face(&mut self) -> Outcome<'t> {
        let name = self.optional_name()?;
        let contours = self.contours()?;
        self.behind_shape(name, FaceShape::Polygon, contours)
    }

    /// `[color] [level or surface] [< motion >] ;`
    pub fn behind_shape(
        &mut self,
        name: Option<Span>,
        shape: FaceShape,
        contours: Range<u32>,
    ) -> Outcome<'t> {
        let color = self.optional_color()?;
        let shading = self.shading()?;
        let body = self.body()?;
        let name = self.own_name(name);
        let face = Face { name, color, shading, shape, ..Face::polygon(contours, body) };
        self.end_row(|scope| &mut scope.faces, face)
    }

    fn shading(&mut self) -> Outcome<'t, Option<ShadingId>> {
        let shading = match self.optional_name()? {
            Some(name) => {
                self.names.push((NameKind::Surface, name));
                let number = self.scope.surfaces.names.enter(name.of(self.text));
                Some(Shading::Surface(SurfaceId::from_index(number)))
            }
            None => self.optional(number)?.map(Shading::Level),
        };
        Ok(shading.map(|shading| self.scope.add_shading(shading)))
    }

    /// The velocity of a wire is our extension, for flat scenes.
    pub fn wire(&mut self) -> Outcome<'t> {
        let name = self.optional_name()?;
        let contours = self.contours()?;
        let color = self.optional_color()?;
        let body = self.body()?;
        let wire = Wire { name: self.own_name(name), contours, color, body, text: None };
        self.end_row(|scope| &mut scope.wires, wire)
    }

    pub fn label(&mut self) -> Outcome<'t> {
        let name = self.optional_name()?;
        self.at()?;
        let text = self.take(label_text)?;
        let first = self.scope.contours.row_count();
        self.corner()?;
        self.scope.contours.end_contour();
        let body = self.body()?;
        let (name, text) = (self.own_name(name), Some(self.scope.add_name(text)));
        let wire = Wire { name, contours: first..first + 1, color: None, body, text };
        self.end_row(|scope| &mut scope.wires, wire)
    }
}

/// Writes `v`.
impl WriteRow for Vertex {
    fn write(&self, out: &mut RowWriter<'_>) {
        out.begin("v", self.name);
        out.point(self.position);
        out.optional_color(self.color);
        self.normal.into_iter().for_each(|normal| out.point(normal));
        if let Some([u, v]) = self.uv {
            out.text(" (");
            out.digits32(u);
            out.number32(v);
            out.text(")");
        }
    }
}

/// Writes `f` or a round face.
impl WriteRow for Face {
    fn write(&self, out: &mut RowWriter<'_>) {
        out.begin(self.shape.keyword(), self.name);
        write_contours(self.contours.clone(), out);
        out.optional_color(self.color);
        let scene = out.scene;
        match self.shading.map(|shading| scene.shadings[shading.index()]) {
            None => {}
            Some(Shading::Level(level)) => out.number(level),
            Some(Shading::Surface(surface)) => out.name(scene.surfaces[surface.index()].name),
        }
        write_body(self.body, out);
    }
}

/// Writes `w` or `label`.
impl WriteRow for Wire {
    fn write(&self, out: &mut RowWriter<'_>) {
        if let Some(text) = self.text {
            out.begin("label", self.name);
            out.quoted(out.scene.names.get(text));
            out.text(" ");
            write_corner(out.scene.contours.get(self.contours.start)[0], out);
        } else {
            out.begin("w", self.name);
            write_contours(self.contours.clone(), out);
            out.optional_color(self.color);
        }
        write_body(self.body, out);
    }
}

fn write_contours(rows: Range<u32>, out: &mut RowWriter<'_>) {
    for contour in out.scene.contours.iter(rows) {
        out.text(" (");
        for (idx, &corner) in contour.iter().enumerate() {
            if idx > 0 {
                out.out.push(b' ');
            }
            write_corner(corner, out);
        }
        out.text(")");
    }
}

fn write_corner(corner: VertexId, out: &mut RowWriter<'_>) {
    let name = out.scene.vertices[corner.index()].name;
    out.out.extend_from_slice(out.scene.names.bytes(name));
}

/// Writes the motion of a face or wire.
fn write_body(body: BodyId, out: &mut RowWriter<'_>) {
    if out.body != Some(body) {
        out.body = Some(body);
        let before = out.out.len();
        write_motion_of(body, DVec3::ZERO, out);
        out.motion_text = out.out.split_off(before);
    }
    out.out.extend_from_slice(&out.motion_text);
}
