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
            Background::Color(color) => {
                Some(color.to_rgb().map(|channel| srgb_decode(channel) as f32))
            }
        };
        Self { light, n_samples: (samples * samples) as f32 }
    }

    /// Linear light of the background; `None` if it is transparent.
    pub fn light(&self) -> Option<[f32; 3]> {
        self.light
    }

    /// Converts the mean light of pixels, and the covered part of it, for a display. The exposure
    /// and the tone curve are those of the scene: before and beside it the background keeps its
    /// colour.
    pub fn converter(
        &self,
        development: Development,
    ) -> impl Fn([f32; 4]) -> [f32; 3] + Sync + use<> {
        let convert = development.converter();
        let is_plain = development == Development::default();
        let behind = self.light.filter(|light| !is_plain && *light != [0.0; 3]);
        move |[red, green, blue, covered]| {
            let light = [red, green, blue];
            let Some(behind) = behind.filter(|_| covered < 1.0) else { return convert(light) };
            if covered <= 0.0 {
                return behind;
            }
            let behind = behind.map(|part| (1.0 - covered) * part);
            let own = convert(std::array::from_fn(|i| (light[i] - behind[i]).max(0.0) / covered));
            std::array::from_fn(|i| covered * own[i] + behind[i])
        }
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

#[cfg(test)]
mod tests {
    use ugimage::Tone;

    use super::*;

    /// The exposure and the tone curve change the scene and not the background, and a pixel with
    /// both has the mean of both.
    #[test]
    fn the_background_is_not_developed() {
        let development = Development { stops: -2.0, tone: Tone::Filmic };
        for value in [1.0, 0.5] {
            let backdrop =
                Backdrop::new(Background::Color(Hsv { hue: 0.0, saturation: 0.0, value }), 2);
            let convert = backdrop.converter(development);
            let behind = backdrop.light().unwrap();
            let scene = [3.0, 1.0, 0.25];
            let alone = development.apply(scene);
            for n_covered in [0.0, 1.0, 3.0, 4.0] {
                let part = n_covered / 4.0;
                let found =
                    convert(backdrop.pixel(scene.map(|light| light * n_covered), n_covered));
                for channel in 0..3 {
                    let expected = part * alone[channel] + (1.0 - part) * behind[channel];
                    assert!(
                        (found[channel] - expected).abs() < 1e-6,
                        "{value} {n_covered}: {found:?}"
                    );
                }
            }
        }
        let black =
            Backdrop::new(Background::Color(Hsv { hue: 0.0, saturation: 0.0, value: 0.0 }), 1);
        assert_eq!(black.converter(development)([0.5, 0.5, 0.5, 0.5]), development.apply([0.5; 3]));
    }
}
