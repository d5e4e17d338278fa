//! How large a sample is on the surfaces that its ray meets.

use ugtrace::rays::PastRay;

use crate::scenery::Scenery;

/// The rays next to a ray, in the row and in the column of samples. Where they meet a surface shows
/// how large a sample is there.
#[derive(Clone, Debug)]
pub enum Neighbours {
    /// Next to a ray from the eye.
    OfSample(PictureSample),
    /// Next to a ray that was mirrored or refracted, as they were with it.
    Bent(Box<[PastRay; 2]>),
}

impl Neighbours {
    /// The two rays. Where a lens shows nothing beyond its edge, one is on the other side.
    pub fn rays(&self, scenery: &Scenery<'_>) -> Option<[PastRay; 2]> {
        match self {
            Self::OfSample(sample) => sample.neighbours(scenery),
            Self::Bent(rays) => Some(**rays),
        }
    }
}

/// A sample of the picture.
#[derive(Clone, Copy, Debug)]
pub struct PictureSample {
    /// Its column and row.
    pub place: [u32; 2],
    /// How far it is from its neighbours, in samples.
    pub distance: u32,
}

impl PictureSample {
    fn neighbours(self, scenery: &Scenery<'_>) -> Option<[PastRay; 2]> {
        let [column, row] = self.place.map(|at| f64::from(at) + 0.5);
        let steps = scenery.film.steps_in_frame(self.place, self.distance);
        let ray = |across: f64, down: f64| {
            let through =
                |sign: f64| scenery.ray_through([column + sign * across, row + sign * down]);
            through(1.0).or_else(|| through(-1.0))
        };
        Some([ray(steps[0], 0.0)?, ray(0.0, steps[1])?])
    }
}
