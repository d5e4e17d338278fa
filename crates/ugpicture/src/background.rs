//! The background of a picture.

use ugimage::Development;
use ugphysics::{Hsv, srgb_decode};

/// The background of a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Background {
    /// A colour. It is never attenuated as a wavelength.
    Color(Hsv),
    /// The picture is transparent where the scene is not.
    Transparent,
}

/// Composites the samples of pixels over the background.
pub struct Backdrop {
    /// Linear light; `None` if the background is transparent.
    light: Option<[f32; 3]>,
    n_samples: f32,
}

impl Backdrop {
    /// The backdrop for pixels of `samples` × `samples` samples.
    pub fn new(background: Background, samples: u32) -> Self {
        let light = match background {
            Background::Transparent => None,
            Background::Color(color) => Some(color.to_rgb().map(|channel| srgb_decode(channel) as f32)),
        };
        Self { light, n_samples: (samples * samples) as f32 }
    }

    /// Linear light of the background; `None` if it is transparent.
    pub fn light(&self) -> Option<[f32; 3]> {
        self.light
    }

    /// The background as developed in a picture.
    pub fn developed(&self, development: Option<Development>) -> Option<[f32; 3]> {
        let light = self.light?;
        Some(development.map_or(light, |development| development.apply(light)))
    }

    /// True if the background is a colour.
    #[inline]
    pub fn is_opaque(&self) -> bool {
        self.light.is_some()
    }

    /// The mean light of a pixel whose covered samples add up to `sum`, and the covered part of it.
    /// On a transparent background it is the mean of the covered part alone.
    #[inline]
    pub fn pixel(&self, sum: [f32; 3], n_covered: f32) -> [f32; 4] {
        let [red, green, blue] = match self.light {
            Some(behind) => {
                let n_free = self.n_samples - n_covered;
                std::array::from_fn(|i| (sum[i] + behind[i] * n_free) / self.n_samples)
            }
            None if n_covered == 0.0 => [0.0; 3],
            None => sum.map(|light| light / n_covered),
        };
        [red, green, blue, n_covered / self.n_samples]
    }
}
