//! Colour and light of the corners of faces and wires.

use glam::DVec3;
use uglight::{Appearance, ColorForm, FaceColors, Lighting, Mixing, Swatch};
use ugraster::{Corner, SampleGrid, ScreenPoint};
use ugscene::{CameraPoint, ColorId, Face, Scene, Slab, VertexId, View, Wire, unit_normal};
use ugtrace::textures::Textures;

use crate::clip::Vertex;
use crate::packing::Layout;

/// Everything from which faces and wires are drawn.
#[derive(Clone, Copy)]
pub struct Painter<'a> {
    /// The scene, whose vertices are part of one body each.
    pub scene: &'a Scene,
    /// The camera.
    pub view: &'a View,
    /// The sample grid.
    pub grid: &'a SampleGrid,
    /// Its colours.
    pub appearance: &'a Appearance,
    /// Its lights.
    pub lighting: &'a Lighting,
    /// The pictures that colours are, in exact pictures.
    pub textures: &'a Textures,
    /// What faces are drawn as.
    pub layout: Layout,
    /// Cull back-facing faces.
    pub is_culled: bool,
}

impl Painter<'_> {
    /// A position of the scene in camera coordinates, before projection.
    #[inline]
    pub fn place(&self, position: DVec3) -> CameraPoint {
        self.view.place(position - self.view.eye)
    }

    /// Its projection; NaN outside the clipping planes.
    #[inline]
    pub fn point(&self, place: CameraPoint) -> ScreenPoint {
        let Slab { near, far } = self.view.slab;
        if near <= place.z && place.z <= far {
            let Corner { x, y, key, .. } =
                Vertex { place, values: [] }.project(self.view.is_perspective);
            ScreenPoint { x, y, key }
        } else {
            ScreenPoint { x: f64::NAN, y: f64::NAN, key: f64::NAN }
        }
    }

    /// True if a face is back-facing: its outline is seen clockwise.
    pub fn is_seen_from_behind(&self, face: &Face) -> bool {
        let Some(outline) = self.scene.face_contours(face).next() else { return false };
        let seen = outline
            .iter()
            .map(|vertex| self.scene.vertices[vertex.index()].position - self.view.eye);
        let forward =
            if self.view.is_perspective { seen.clone().next() } else { Some(self.view.forward) };
        unit_normal(seen).dot(forward.unwrap_or_default()) > 0.0
    }

    /// The colour of a corner of a face.
    #[inline]
    pub fn swatch(&self, vertex: VertexId, colors: &FaceColors) -> Swatch {
        self.lit_as_written(self.appearance.swatch(vertex, colors))
    }

    /// A colour of a display that is drawn as light, lit like hues: in linear light if the law of
    /// the picture names a quantity.
    #[inline]
    pub fn lit_as_written(&self, swatch: Swatch) -> Swatch {
        match swatch.form {
            ColorForm::Display(light) if self.lighting.acts_on_light => {
                Swatch { form: ColorForm::Light(light), ..swatch }
            }
            _ => swatch,
        }
    }

    /// True if a face is translucent. Its own colour takes precedence over the colours of its
    /// corners, so a translucent face does not make neighbours translucent that share its corners.
    #[inline]
    pub fn is_transparent(&self, face: &Face) -> bool {
        self.appearance.is_translucent(self.scene, face) || self.textures.is_translucent(face.color)
    }

    /// The colours of the ends of a wire. `keeps_light`: colours given as light need no hue, since
    /// they are not shifted as hues.
    pub fn wire_swatch(&self, wire: &Wire, keeps_light: bool) -> impl Fn(VertexId) -> Swatch {
        let palette = &self.appearance.palette;
        let own =
            |color: Option<ColorId>| color.map_or(palette.white(), |color| palette.get(color));
        let end =
            move |vertex: VertexId| own(self.scene.vertices[vertex.index()].color.or(wire.color));
        let corners = self.scene.contours.corners(wire.contours.clone());
        let mixing = self.appearance.mixing(corners.iter().map(|&vertex| end(vertex)));
        let mixing = if keeps_light { mixing } else { Mixing::Hue };
        move |vertex| Swatch { translucency: 0.0, ..palette.drawn_as(mixing, end(vertex)) }
    }

    /// The row of the spectrum of an end of a wire.
    pub fn wire_end_row(&self, vertex: VertexId, wire: &Wire) -> u32 {
        self.appearance.surface.row_of(self.scene.vertices[vertex.index()].color.or(wire.color))
    }

    /// The triangles of a face, as numbers of its corners; `None` if it intersects itself.
    pub fn triangles(&self, face: &Face) -> Option<Vec<ugpolygon::Triangle>> {
        ugpolygon::face_triangles(self.scene, face, |vertex| self.appearance.surface.rest(vertex))
    }

    /// The rest normal of a face on its visible side; zero if lighting needs none or the face is
    /// degenerate.
    pub fn seen_normal(&self, face: &Face) -> DVec3 {
        if self.scene.light_level(face).is_some() || !self.lighting.needs_geometry() {
            return DVec3::ZERO;
        }
        let seen = self.appearance.surface.seen();
        let outline = self.scene.contours.get(face.contours.start);
        if self.view.is_perspective || seen.own_time(outline[0].index()).is_some() {
            return seen.seen_normal(
                self.scene,
                face,
                (self.view.eye, self.appearance.surface.frames()),
            );
        }
        let rest = outline.iter().map(|&vertex| self.appearance.surface.rest(vertex));
        ugscene::seen_normal(
            rest,
            -self.appearance.surface.rest_direction(self.view.forward, face.body),
        )
    }

    /// The light level at a corner, for red, green and blue: linear for a colour given as light,
    /// else for display-encoded values.
    #[inline]
    pub fn level(
        &self,
        face: &Face,
        vertex: VertexId,
        seen_normal: DVec3,
        is_light: bool,
    ) -> DVec3 {
        if let Some(level) = self.scene.light_level(face) {
            return DVec3::splat(level);
        }
        if !self.lighting.needs_geometry() {
            return self.lighting.level(DVec3::ZERO, DVec3::ZERO, DVec3::ZERO, is_light);
        }
        let [point, normal, shift] = self.lit_point(face, vertex, seen_normal);
        self.lighting.level(point, normal, shift, is_light)
    }

    /// Position, normal and shift of lamps with which a corner is lit, see [`Lighting::level`].
    #[inline]
    pub fn lit_point(&self, face: &Face, vertex: VertexId, seen_normal: DVec3) -> [DVec3; 3] {
        let normal = self.normal_at(vertex, seen_normal);
        let (surface, rest) = (&self.appearance.surface, self.appearance.surface.rest(vertex));
        let standing =
            |own_time| Some(surface.frames().world_line(face.body)?.standing(rest, own_time));
        match surface.seen().own_time(vertex.index()).and_then(standing) {
            // It is lit as it stands in the scene if it only turned.
            Some((place, turn)) => [place, turn * normal, DVec3::ZERO],
            None => [rest, normal, surface.frames().lamp_shift(face.body)],
        }
    }

    /// True if the light level of a face is the same at all these corners of it.
    #[inline]
    pub fn is_flat(&self, corners: &[VertexId]) -> bool {
        let has_normal = |corner: &VertexId| self.scene.vertices[corner.index()].normal.is_some();
        let turns =
            |&corner: &VertexId| self.appearance.surface.seen().own_time(corner.index()).is_some();
        !self.lighting.needs_places()
            && !corners.iter().any(|corner| has_normal(corner) || turns(corner))
    }

    /// True if colour and light level are the same at all corners of a face.
    pub fn is_even(&self, face: &Face, corners: &[VertexId]) -> bool {
        let Some((&first, others)) = corners.split_first() else { return true };
        let is_lit_evenly = || {
            !self.lighting.needs_geometry()
                || self.scene.light_level(face).is_some()
                || self.is_flat(corners)
        };
        let looks_like_first = |&corner: &VertexId| {
            self.appearance.surface.row(corner) == self.appearance.surface.row(first)
                || self.appearance.surface.swatch(corner) == self.appearance.surface.swatch(first)
        };
        others.iter().all(looks_like_first) && is_lit_evenly()
    }

    /// The light level of all faces without one of their own, if it is the same for all of them and
    /// all colours are opaque hues.
    pub fn even_level(&self) -> Option<DVec3> {
        let is_even = !self.lighting.needs_geometry() && self.layout == Layout::Hues;
        let is_opaque = !self.appearance.palette.has_translucency;
        (is_even && is_opaque)
            .then(|| self.lighting.level(DVec3::ZERO, DVec3::ZERO, DVec3::ZERO, false))
    }

    /// The normal at a corner of a face, on its visible side.
    pub fn normal_at(&self, vertex: VertexId, seen_normal: DVec3) -> DVec3 {
        ugscene::shading_normal(self.scene.vertices[vertex.index()].normal, seen_normal)
    }
}
