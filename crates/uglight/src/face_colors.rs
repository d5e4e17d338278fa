//! The colours of the corners of a face, ready to interpolate.

use std::borrow::Borrow;

use rayon::prelude::*;
use ugscene::{Face, Scene, VertexId};

use crate::{Appearance, ColorForm, Mixing, SurfaceColor, Swatch};

/// What the corners of a face have in common.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FaceColors {
    /// The tint of grey corners for interpolation: the mean of the coloured corners, so that the
    /// colours between grey and blue do not pass through the rainbow.
    grey_tint: f64,
    /// Translucency of the face's own colour, if it has one.
    translucency: Option<f64>,
    /// What its colours are drawn as.
    pub mixing: Mixing,
}

impl Appearance {
    /// What the corners of a face have in common.
    #[inline]
    pub fn face_colors(&self, scene: &Scene, face: &Face) -> FaceColors {
        let corners = scene.face_corners(face);
        let swatches = || corners.iter().map(|&vertex| self.surface.swatch(vertex));
        let mean_tint = || {
            let (sum, count) = swatches()
                .filter(|swatch| !swatch.is_grey())
                .fold((0.0, 0), |(sum, count), swatch| (sum + swatch.tint, count + 1));
            if count == 0 { 0.0 } else { sum / f64::from(count) }
        };
        let grey_tint = if swatches().any(Swatch::is_grey) { mean_tint() } else { 0.0 };
        let translucency = face.color.map(|color| self.palette.get(color).translucency);
        FaceColors { grey_tint, translucency, mixing: self.mixing(swatches()) }
    }

    /// What colours are drawn as that meet in a face or wire. Light of a display is drawn as such
    /// only between different colours, or where its hue would fade.
    #[inline]
    pub fn mixing<S: Borrow<Swatch>>(&self, swatches: impl Iterator<Item = S> + Clone) -> Mixing {
        if !self.palette.has_light && !self.palette.has_display {
            return Mixing::Hue;
        }
        let most = swatches.clone().max_by_key(|swatch| swatch.borrow().form.mixing());
        let Some(most) = most.as_ref().map(Borrow::borrow) else { return Mixing::Hue };
        match most.form {
            ColorForm::Display(_) => {
                let mut all = swatches.clone();
                let is_mixed =
                    all.any(|swatch| swatch.borrow() != most) || self.palette.is_faded(most);
                if is_mixed { Mixing::Display } else { Mixing::Hue }
            }
            form => form.mixing(),
        }
    }

    /// As [`Appearance::face_colors`], of a face that moves or not. Colours given as light have no
    /// hue to shift: on moving bodies they are replaced by the nearest hue, except in spectral
    /// mode. So are colours of a display, and their hues are mixed.
    pub fn face_colors_in_motion(&self, scene: &Scene, face: &Face, is_moving: bool) -> FaceColors {
        let colors = self.face_colors(scene, face);
        let keeps_light = self.keeps_light() || !is_moving;
        FaceColors { mixing: if keeps_light { colors.mixing } else { Mixing::Hue }, ..colors }
    }

    /// What the corners of each face have in common, see [`Appearance::face_colors_in_motion`].
    pub fn all_face_colors(&self, scene: &Scene) -> Vec<FaceColors> {
        let is_moving = |face: &Face| self.surface.frames().is_moving(face.body);
        let colors = |face: &Face| self.face_colors_in_motion(scene, face, is_moving(face));
        scene.faces.par_iter().map(colors).collect()
    }

    /// Whether faces are drawn as hues, and whether faces are drawn as light.
    pub fn draws_light(&self, scene: &Scene) -> [bool; 2] {
        if !(self.palette.has_light || self.palette.has_display && self.surface.has_display()) {
            return [!scene.faces.is_empty(), false];
        }
        let keeps_light =
            |face: &Face| self.keeps_light() || self.surface.velocity(face.body).is_zero();
        let is_light = |face: &&Face| {
            let swatches = scene.face_corners(face).iter().map(|&at| self.surface.swatch(at));
            self.mixing(swatches) != Mixing::Hue && keeps_light(face)
        };
        let n_light = scene.faces.par_iter().filter(is_light).count();
        [n_light < scene.faces.len(), n_light > 0]
    }

    /// The colour of a corner of a face.
    #[inline]
    pub fn swatch(&self, vertex: VertexId, colors: &FaceColors) -> Swatch {
        let own = self.palette.drawn_as(colors.mixing, *self.surface.swatch(vertex));
        let tint = if own.is_grey() { colors.grey_tint } else { own.tint };
        Swatch { tint, translucency: colors.translucency.unwrap_or(own.translucency), ..own }
    }

    /// The colour at rest at a point of a triangle of a face. `weights`: of the corners.
    pub fn color_at(
        &self,
        colors: &FaceColors,
        corners: [VertexId; 3],
        weights: [f64; 3],
    ) -> SurfaceColor {
        let rows = corners.map(|corner| self.surface.row(corner));
        let swatch = |corner| self.swatch(corner, colors);
        let first = swatch(corners[0]);
        let even = SurfaceColor::even(first, rows[0]);
        if rows == [rows[0]; 3] {
            return even;
        }
        let swatches = [first, swatch(corners[1]), swatch(corners[2])];
        if swatches == [first; 3] {
            return even;
        }
        let [a, b, c] = std::array::from_fn(|at| (rows[at], weights[at]));
        let rows = [a, b, c, (0, 0.0)];
        SurfaceColor { swatch: Swatch::mean(&swatches, weights), rows }
    }

    /// True if a face is translucent. Its own colour takes precedence over the colours of its
    /// corners, so a translucent face does not make neighbours translucent that share its corners.
    #[inline]
    pub fn is_translucent(&self, scene: &Scene, face: &Face) -> bool {
        if !self.palette.has_translucency {
            return false;
        }
        match face.color {
            Some(color) => self.palette.get(color).translucency > 0.0,
            None => scene
                .face_corners(face)
                .iter()
                .any(|&at| self.surface.swatch(at).translucency > 0.0),
        }
    }
}
