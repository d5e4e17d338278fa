//! The colours of the corners of a face, ready to interpolate.

use ugscene::{Face, Scene};

use crate::{Palette, SurfaceAttributes, Swatch};

/// What the corners of a face have in common.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Common {
    /// The tint of grey corners for interpolation: the mean of the coloured corners, so that the
    /// colours between grey and blue do not pass through the rainbow.
    grey_tint: f64,
    /// Translucency of the face's own colour, if it has one.
    translucency: Option<f64>,
    /// A corner's colour is given as light, so light is interpolated instead of hue.
    pub is_light: bool,
}

impl Common {
    /// The same face with hues in place of light.
    pub fn without_light(self) -> Self {
        Self { is_light: false, ..self }
    }
}

impl Palette {
    /// What the corners of a face have in common.
    #[inline]
    pub fn common(&self, scene: &Scene, surface: &SurfaceAttributes, face: &Face) -> Common {
        let corners = scene.contours.corners(face.contours.clone());
        let swatches = || corners.iter().map(|&vertex| surface.swatch(vertex));
        let mean_tint = || {
            let (sum, count) = swatches()
                .filter(|swatch| !swatch.is_grey())
                .fold((0.0, 0), |(sum, count), swatch| (sum + swatch.tint, count + 1));
            if count == 0 { 0.0 } else { sum / f64::from(count) }
        };
        let grey_tint = if swatches().any(Swatch::is_grey) { mean_tint() } else { 0.0 };
        let translucency = face.color.map(|color| self.get(color).translucency);
        let is_light = self.has_light() && swatches().any(|swatch| swatch.light.is_some());
        Common { grey_tint, translucency, is_light }
    }

    /// The colour of a corner of a face. `own`: of the vertex.
    #[inline]
    pub fn swatch_of(&self, own: Swatch, common: &Common) -> Swatch {
        let swatch = Swatch { translucency: common.translucency.unwrap_or(own.translucency), ..own };
        if common.is_light {
            self.as_light(swatch)
        } else if swatch.is_grey() {
            Swatch { tint: common.grey_tint, ..swatch }
        } else {
            swatch
        }
    }

    /// True if a face is translucent. Its own colour takes precedence over the colours of its
    /// corners, so a translucent face does not make neighbours translucent that share its corners.
    #[inline]
    pub fn is_translucent(&self, scene: &Scene, surface: &SurfaceAttributes, face: &Face) -> bool {
        if !self.has_translucency() {
            return false;
        }
        match face.color {
            Some(color) => self.get(color).translucency > 0.0,
            None => {
                let corners = scene.contours.corners(face.contours.clone());
                corners.iter().any(|&vertex| surface.swatch(vertex).translucency > 0.0)
            }
        }
    }
}
