//! Colours and rest positions of vertices.

use std::ops::Range;

use glam::DVec3;
use rayon::prelude::*;
use ugphysics::{Velocity, aberrate};
use ugscene::{
    BodyId, ColorId, ColorMix, ColorValue, RestFrames, Scene, SeenVertices, VertexId, Wire,
    vertex_mixes,
};

use crate::{ColorShift, HueShift, Mixing, Palette, RestColor, Swatch, VertexColor, vertex_colors};

/// Colours and rest positions of the vertices of a scene.
#[derive(Clone, Debug)]
pub struct SurfaceAttributes {
    /// Different colours: those of the scene, white, and mixed ones.
    swatches: Vec<Swatch>,
    /// For each vertex a row of the swatches; most vertices share theirs with others.
    rows: Vec<u32>,
    /// Row of white, the default colour; it follows the scene's colours.
    white: u32,
    seen: SeenVertices,
    frames: RestFrames,
}

impl SurfaceAttributes {
    /// `scene`: its vertices are part of one body each.
    pub fn new(scene: &Scene, eye: DVec3, palette: &Palette) -> Self {
        let frames = RestFrames::new(scene);
        let seen = SeenVertices::new(scene, eye, &frames, true);
        let mut swatches = palette.swatches.to_vec();
        // Scenes have fewer than 2^32 colours.
        let white = swatches.len() as u32;
        swatches.push(palette.white());
        let own = scene.vertices.par_iter().map(|vertex| vertex.color.map(row));
        let rows = match own.collect() {
            Some(rows) => rows,
            None => mixed_rows(scene, &seen.rest, palette, &mut swatches),
        };
        Self { swatches, rows, white, seen, frames }
    }

    /// The colours that meet in each row.
    pub fn mixtures(&self, scene: &Scene) -> Vec<ColorMix> {
        let mut mixtures = vec![ColorMix::One(None); self.swatches.len()];
        for (row, shares) in mixtures[..scene.colors.len()].iter_mut().enumerate() {
            *shares = ColorMix::One(Some(ColorId::from_index(row)));
        }
        for (&row, shares) in self.rows.iter().zip(vertex_mixes(scene, &self.seen.rest)) {
            mixtures[row as usize] = shares;
        }
        mixtures.into_iter().map(|shares| shares.of_spectra(scene)).collect()
    }

    /// True if hues are shifted, and a face or one of `wires` that moves has a black body or a
    /// sampled spectrum, which has no hue.
    pub fn has_moving_spectra(&self, scene: &Scene, wires: &[Wire], shift: ColorShift) -> bool {
        let is_hue = matches!(shift, ColorShift::Hues(shift) if shift != HueShift::NONE);
        let is_spectrum = |color: ColorId| {
            let value = scene.colors[color.index()].value;
            matches!(value, ColorValue::Blackbody { .. } | ColorValue::Spectrum { .. })
        };
        let moves = |body: BodyId, contours: &Range<u32>, color: Option<ColorId>| {
            let corners = scene.contours.corners(contours.clone());
            let color_of = |corner: &VertexId| scene.vertices[corner.index()].color.or(color);
            self.frames.is_moving(body) && corners.iter().filter_map(color_of).any(is_spectrum)
        };
        let mut faces = scene.faces.iter().map(|face| moves(face.body, &face.contours, face.color));
        let mut wires = wires.iter().map(|wire| moves(wire.body, &wire.contours, wire.color));
        let has_spectra = scene.colors.iter().any(|color| Mixing::of(color) == Mixing::Light);
        has_spectra && is_hue && (faces.any(|moves| moves) || wires.any(|moves| moves))
    }

    /// The row of the colour of a vertex.
    #[inline]
    pub fn row(&self, vertex: VertexId) -> u32 {
        self.rows[vertex.index()]
    }

    /// True if a vertex has a colour of a display.
    pub fn has_display(&self) -> bool {
        self.rows.iter().any(|&row| self.swatches[row as usize].form.mixing() == Mixing::Display)
    }

    /// The row of a colour of the scene, or of white.
    pub fn row_of(&self, color: Option<ColorId>) -> u32 {
        color.map_or(self.white, row)
    }

    /// Its own colour, else the mix of its faces' colours, else white.
    #[inline]
    pub fn swatch(&self, vertex: VertexId) -> &Swatch {
        &self.swatches[self.rows[vertex.index()] as usize]
    }

    /// Where the vertex is in the rest frame of its body, relative to the eye, in the axes of the
    /// scene.  Eq. (P4)
    pub fn rest(&self, vertex: VertexId) -> DVec3 {
        self.seen.rest[vertex.index()]
    }

    /// The vertices as they are seen.
    #[inline]
    pub fn seen(&self) -> &SeenVertices {
        &self.seen
    }

    /// The rest positions of all vertices, see [`SurfaceAttributes::rest`].
    pub fn all_rest(&self) -> &[DVec3] {
        &self.seen.rest
    }

    /// The greatest rapidity with which a body, or a vertex of a body on a world line, is seen.
    pub fn greatest_rapidity(&self) -> f64 {
        let rows = 0..if self.frames.have_world_lines() { self.seen.bodies.len() } else { 0 };
        let rapidities = rows.map(|row| self.seen.velocity(row, &self.frames).rapidity());
        rapidities.fold(self.frames.greatest_rapidity(), f64::max)
    }

    /// The rest frames of the bodies.
    pub fn frames(&self) -> &RestFrames {
        &self.frames
    }

    /// The velocity of a body in the frame of the camera.
    pub fn velocity(&self, body: BodyId) -> Velocity {
        self.frames.velocity(body)
    }

    /// A viewing direction in the rest frame of a body, in the axes of the scene.  Eq. (P6), (P25)
    pub fn rest_direction(&self, direction: DVec3, body: BodyId) -> DVec3 {
        self.frames.of(body).scene_from_boosted() * aberrate(direction, self.frames.velocity(body))
    }
}

fn row(color: ColorId) -> u32 {
    // Scenes have fewer than 2^32 colours.
    color.index() as u32
}

/// The rows of vertices that have not all colours of their own; mixed colours are added behind
/// white.
fn mixed_rows(
    scene: &Scene,
    rest: &[DVec3],
    palette: &Palette,
    swatches: &mut Vec<Swatch>,
) -> Vec<u32> {
    let white = swatches.len() as u32 - 1;
    let colors = vertex_colors(scene, &vertex_mixes(scene, rest)).into_iter();
    let rows = colors.map(|color| match color {
        VertexColor::Named(color) => row(color),
        VertexColor::White => white,
        VertexColor::Mixed(color) => {
            let RestColor { hsv, form, translucency } = color;
            swatches.push(Swatch {
                form: palette.marked(form),
                translucency,
                ..palette.swatch(hsv)
            });
            // There are no more mixed colours than vertices.
            swatches.len() as u32 - 1
        }
    });
    rows.collect()
}
