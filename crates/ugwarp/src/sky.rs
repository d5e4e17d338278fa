//! What is seen: a panorama, stars, or both.

use ugsky::{Panorama, Star};

use crate::open::{Band, Opened};

/// What is seen. Without a panorama the sky between the stars is black.
#[derive(Clone, Copy)]
pub struct Sky<'s> {
    /// Light by direction.
    pub panorama: Option<&'s Panorama>,
    /// Infrared and ultraviolet light.
    pub bands: &'s [Band],
    /// Points of light in front of it.
    pub stars: &'s [Star],
}

impl<'s> From<&'s Panorama> for Sky<'s> {
    fn from(panorama: &'s Panorama) -> Self {
        Self { panorama: Some(panorama), bands: &[], stars: &[] }
    }
}

impl<'s> From<&'s [Star]> for Sky<'s> {
    fn from(stars: &'s [Star]) -> Self {
        Self { panorama: None, bands: &[], stars }
    }
}

impl<'s> From<&'s Opened> for Sky<'s> {
    fn from(opened: &'s Opened) -> Self {
        Self { panorama: opened.panorama.as_ref(), bands: &opened.bands, stars: &opened.stars }
    }
}
