//! The colours of the corners of a face, ready to interpolate.

use std::borrow::Borrow;

use glam::DVec3;
use ugscene::{Face, Scene, VertexId};

use crate::{Appearance, SurfaceColor, Swatch};

/// The common attributes of the corners of a face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Common {
    /// The tint of grey corners for interpolation: the mean of the coloured corners, so that the
    /// colours between grey and blue do not pass through the rainbow.
    grey_tint: f64,
    /// Translucency of the face's own colour, if it has one.
    translucency: Option<f64>,
    /// A corner's colour is given as light, so light is interpolated instead of hue.
    pub is_light: bool,
    /// A corner's colour is one of a display, and the colours of the corners differ, so light is
    /// interpolated; but it is lit like a hue. A single colour is drawn so where its hue fades.
    pub is_display: bool,
}

impl Swatch {
    /// The weighted mean of the corners of a triangle, number by number. A number that is the same
    /// at all corners keeps its bits.
    pub fn mixed([a, b, c]: [Self; 3], weights: [f64; 3]) -> Self {
        let [first, second, third] = weights;
        let number = |of: fn(&Self) -> f64| of(&a) + second * (of(&b) - of(&a)) + third * (of(&c) - of(&a));
        let mean = |a: DVec3, b: DVec3, c: DVec3| first * a + second * b + third * c;
        Self {
            tint: number(|swatch| swatch.tint),
            saturation: number(|swatch| swatch.saturation),
            value: number(|swatch| swatch.value),
            factor: number(|swatch| swatch.factor),
            light: a.light.zip(b.light).zip(c.light).map(|((a, b), c)| mean(a, b, c)),
            is_display: a.is_display,
            translucency: number(|swatch| swatch.translucency),
        }
    }
}

impl Appearance {
    /// The common attributes of the corners of a face.
    #[inline]
    pub fn common(&self, scene: &Scene, face: &Face) -> Common {
        let corners = scene.contours.corners(face.contours.clone());
        let swatches = || corners.iter().map(|&vertex| self.surface.swatch(vertex));
        let mean_tint = || {
            let (sum, count) = swatches()
                .filter(|swatch| !swatch.is_grey())
                .fold((0.0, 0), |(sum, count), swatch| (sum + swatch.tint, count + 1));
            if count == 0 { 0.0 } else { sum / f64::from(count) }
        };
        let grey_tint = if swatches().any(Swatch::is_grey) { mean_tint() } else { 0.0 };
        let translucency = face.color.map(|color| self.palette.get(color).translucency);
        let is_light =
            self.palette.has_light() && swatches().any(|swatch| swatch.light.is_some() && !swatch.is_display);
        let is_display = !is_light && self.palette.has_display() && self.mixes_light(swatches());
        Common { grey_tint, translucency, is_light, is_display }
    }

    /// True if corners with these colours are interpolated in linear light, because one of them was
    /// written as red, green and blue (`c_rgb`) and they differ.
    #[inline]
    pub fn mixes_light<S: Borrow<Swatch>>(&self, swatches: impl Iterator<Item = S> + Clone) -> bool {
        let mut displays = swatches.clone().filter(|swatch| swatch.borrow().is_display);
        let Some(display) = displays.clone().next() else { return false };
        swatches.clone().any(|swatch| swatch.borrow() != display.borrow())
            || displays.any(|swatch| self.palette.is_faded(swatch.borrow()))
    }

    /// As [`Appearance::common`], of a face that moves or not. Colours given as light have no hue
    /// to shift: on moving bodies they are replaced by the nearest hue, except in spectral mode. So
    /// are colours of a display, and their hues are mixed.
    pub fn common_in_motion(&self, scene: &Scene, face: &Face, is_moving: bool) -> Common {
        let common = self.common(scene, face);
        let keeps_light = self.keeps_light() || !is_moving;
        let (is_light, is_display) = (common.is_light && keeps_light, common.is_display && keeps_light);
        Common { is_light, is_display, ..common }
    }

    /// The colour of a corner of a face.
    #[inline]
    pub fn swatch(&self, vertex: VertexId, common: &Common) -> Swatch {
        let own = *self.surface.swatch(vertex);
        let swatch = Swatch { translucency: common.translucency.unwrap_or(own.translucency), ..own };
        if common.is_light {
            Swatch { is_display: false, ..self.palette.as_light(swatch) }
        } else if common.is_display {
            // The hue is that of light from where something shifts it.
            let tint = if swatch.is_grey() { common.grey_tint } else { swatch.tint };
            Swatch { tint, is_display: true, ..self.palette.as_light(swatch) }
        } else if swatch.is_grey() {
            Swatch { tint: common.grey_tint, light: None, ..swatch }
        } else {
            Swatch { light: None, ..swatch }
        }
    }

    /// The colour at rest at a point of a triangle of a face. `weights`: of the corners.
    pub fn color_at(&self, common: &Common, corners: [VertexId; 3], weights: [f64; 3]) -> SurfaceColor {
        let rows = corners.map(|corner| self.surface.row(corner));
        let swatch = |corner| self.swatch(corner, common);
        let first = swatch(corners[0]);
        let even = SurfaceColor::even(first, rows[0]);
        if rows == [rows[0]; 3] {
            return even;
        }
        let swatches = [first, swatch(corners[1]), swatch(corners[2])];
        if swatches == [first; 3] {
            return even;
        }
        let rows = std::array::from_fn(|at| (rows[at], weights[at]));
        SurfaceColor { swatch: Swatch::mixed(swatches, weights), rows }
    }

    /// True if a face is translucent. Its own colour takes precedence over the colours of its
    /// corners, so a translucent face does not make neighbours translucent that share its corners.
    #[inline]
    pub fn is_translucent(&self, scene: &Scene, face: &Face) -> bool {
        if !self.palette.has_translucency() {
            return false;
        }
        match face.color {
            Some(color) => self.palette.get(color).translucency > 0.0,
            None => {
                let corners = scene.contours.corners(face.contours.clone());
                corners.iter().any(|&vertex| self.surface.swatch(vertex).translucency > 0.0)
            }
        }
    }
}
