//! Reconstruction filters, from samples to pixels.

/// A separable reconstruction filter: a sample at distances x and y, in pixels, from the middle of
/// a pixel has the weight w(x) w(y).
///
/// These are B-splines. The weights of a sample in all pixels add up to 1, so a small object has
/// the same light in the picture wherever it is. No weight is negative, so no pixel is darker or
/// brighter than all of its samples.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Filter {
    /// The mean of the pixel's own samples, as a detector measures it: w = 1 for |x| < ½.
    #[default]
    Box,
    /// w = 1 − |x|, up to 1.
    Triangle,
    /// The quadratic B-spline, nearly a Gaussian with σ = ½: w = ¾ − x² for |x| < ½, and ½ (3/2 −
    /// |x|)² from there to |x| = 3/2.
    Spline,
}

impl Filter {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Box, Self::Triangle, Self::Spline];

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Box => "box",
            Self::Triangle => "triangle",
            Self::Spline => "spline",
        }
    }

    /// The number of neighbouring pixels on each side whose samples have nonzero weight.
    pub fn margin(self) -> u32 {
        match self {
            Self::Box => 0,
            Self::Triangle | Self::Spline => 1,
        }
    }

    /// The number of samples with nonzero weight along each axis, for a pixel with `n` × `n`
    /// samples.
    pub fn n_samples(self, n: u32) -> usize {
        self.weights(n).iter().filter(|weight| **weight != 0.0).count()
    }

    /// The weight at a distance in pixels.
    fn at(self, distance: f64) -> f64 {
        let x = distance.abs();
        match self {
            Self::Box => f64::from(u8::from(x < 0.5)),
            Self::Triangle => (1.0 - x).max(0.0),
            Self::Spline if x < 0.5 => 0.75 - x * x,
            Self::Spline => 0.5 * (1.5 - x).max(0.0) * (1.5 - x).max(0.0),
        }
    }

    /// The weights along one axis of a pixel with `n` × `n` samples: those of the samples of
    /// [`Filter::margin`] pixels before it, of its own samples, and of as many pixels after it.
    pub fn weights(self, n: u32) -> Vec<f32> {
        let place = |sample: u32| (f64::from(sample) + 0.5) / f64::from(n) - 0.5;
        let first = f64::from(self.margin());
        (0..n * (1 + 2 * self.margin()))
            .map(|sample| self.at(place(sample) - first) as f32)
            .collect()
    }
}
