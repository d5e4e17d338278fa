//! Skies: panoramas, stars, or both.

use std::ops::Range;

use ugphysics::Velocity;

use crate::panorama::Panorama;
use crate::shade::{Shade, SkyColors};
use crate::spectral::{Basis, BasisError};
use crate::stars::Star;

/// Wavelengths that are seen at rest, nm: those of the CIE 1931 observer.
pub const VISIBLE_NM: Range<f64> = 360.0..830.0;

/// A panorama of a part of the light: outside of the visible range, or at a few wavelengths.
pub struct Band {
    /// Wavelengths at rest, nm.
    pub range_nm: Range<f64>,
    /// The spectra of its channels.
    pub basis: Basis,
    /// The light.
    pub panorama: Panorama,
}

/// A sky. Without a panorama it is black between the stars.
#[derive(Clone, Copy, Default)]
pub struct Sky<'s> {
    /// Light by direction.
    pub panorama: Option<&'s Panorama>,
    /// Infrared and ultraviolet light, or all light, in bands.
    pub bands: &'s [Band],
    /// Points of light in front of it.
    pub stars: &'s [Star],
    /// How many times as bright as white the clipped highlights of the panorama are, if it is a
    /// photograph in which they are not.
    pub highlights: Option<f32>,
}

impl<'s> From<&'s Panorama> for Sky<'s> {
    fn from(panorama: &'s Panorama) -> Self {
        Self { panorama: Some(panorama), ..Self::default() }
    }
}

impl<'s> From<&'s [Star]> for Sky<'s> {
    fn from(stars: &'s [Star]) -> Self {
        Self { stars, ..Self::default() }
    }
}

/// A panorama of a sky, and how an observer sees its light.
pub struct Layer<'s> {
    /// The light at rest.
    pub panorama: &'s Panorama,
    /// How it changes with the Doppler factor.
    pub shade: Shade,
}

impl<'s> Sky<'s> {
    /// The panorama, then infrared and ultraviolet light, as an observer with a velocity in the
    /// frame of the sky sees them. Their light adds up. `range_nm`: wavelengths at rest at which
    /// the panorama has light, without those of bands; `keeps_light`: see [`Shade::new`].
    ///
    /// # Errors
    /// [`BasisError`].
    pub fn layers(
        self,
        colors: SkyColors,
        velocity: Velocity,
        range_nm: &Range<f64>,
        keeps_light: bool,
    ) -> Result<Vec<Layer<'s>>, BasisError> {
        let mut range_nm = range_nm.clone();
        for band in self.bands {
            if band.range_nm.start >= VISIBLE_NM.end {
                range_nm.end = VISIBLE_NM.end;
            } else {
                range_nm.start = VISIBLE_NM.start;
            }
        }
        let visible = self.panorama.map(|panorama| (panorama, colors, &range_nm));
        let bands =
            self.bands.iter().map(|band| (&band.panorama, colors.on(band.basis), &band.range_nm));
        let layer = |(panorama, colors, range_nm)| {
            Ok(Layer { panorama, shade: Shade::new(colors, velocity, range_nm, keeps_light)? })
        };
        let mut layers: Vec<Layer<'s>> =
            visible.into_iter().chain(bands).map(layer).collect::<Result<_, _>>()?;
        if let (Some(layer), Some(factor), Some(_)) =
            (layers.first_mut(), self.highlights, self.panorama)
        {
            layer.shade.set_highlights(factor);
        }
        Ok(layers)
    }
}
