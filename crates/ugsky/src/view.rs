//! From places in a picture to the light seen.

use glam::DVec3;

use crate::flat::{FlatFilm, Seen};
use crate::observer::{Observer, SkyRay};
use crate::sample::Sampler;
use crate::shade::Shade;

/// Half the distance of the places whose directions are compared, in samples: less than a half, so
/// that both are in the same view of a picture of several.
const HALF_STEP: f64 = 0.49;

/// How often the footprint of a sample is divided at most, if it is large on the sky.
const MOST_DIVISIONS: u32 = 24;

/// How the samples of a picture see a sky, apart from the lens.
pub struct SkyView {
    /// The observer, who moves relative to the sky.
    pub observer: Observer,
    /// Variance of the reconstruction filter along each axis, relative to that of a box of one
    /// sample.
    pub spread: f64,
    /// The lens, if directions are linear in the place.
    pub flat: Option<FlatFilm>,
}

/// The light of a sky in the samples of a picture, on one thread.
pub struct SkyLight<'a, 's, F> {
    /// The observer and the picture.
    pub view: &'a SkyView,
    /// The direction seen at a place, in samples from the upper left corner: of length 1, or any
    /// length if the lens is flat. `None` where it shows nothing.
    pub film: F,
    /// How colours change.
    pub shade: &'a Shade,
    /// The light of the sky at rest.
    pub sampler: &'a mut Sampler<'s>,
}

impl<F: Fn([f64; 2]) -> Option<DVec3>> SkyLight<'_, '_, F> {
    /// The light seen in `n` samples of a row: red, green and blue times the covered part, and that
    /// part. It is exact at poles, at edges and for samples that see most of the sky.
    pub fn row(&mut self, found: &mut [Seen], [left, y]: [f64; 2], n: usize) {
        let SkyView { observer, spread, flat } = self.view;
        match flat {
            Some(flat) => self.sampler.flat_row(observer, flat, [left, y], *spread, found),
            None => found.fill(Seen::default()),
        }
        for (first, seen) in found.iter_mut().enumerate() {
            let place = |idx: usize| [left + (first * Seen::N + idx) as f64, y];
            let n = Seen::N.min(n - first * Seen::N);
            if seen.is_found != [true; Seen::N] {
                for idx in 0..n {
                    if !seen.is_found[idx]
                        && let Some((light, doppler)) = self.sample(place(idx))
                    {
                        seen.set(idx, light, doppler);
                    }
                }
            }
            self.shade.see(&mut seen.light, &seen.doppler);
            if seen.is_found != [true; Seen::N] {
                for idx in 0..n {
                    if !seen.is_found[idx] {
                        seen.set(idx, self.divided(place(idx), 1.0, 0), 1.0);
                    }
                }
            }
        }
    }

    /// The light of a sample, and its Doppler factor; `None` where its footprint is too large.
    #[inline]
    fn sample(&mut self, place: [f64; 2]) -> Option<([f32; 4], f64)> {
        let Some(ray) = self.ray(place, 1.0) else { return Some(([0.0; 4], 1.0)) };
        self.sampler.light(&ray, self.view.spread).map(|light| (light, ray.doppler))
    }

    /// The light of a square of the film, `side` samples wide, as seen.
    fn part(&mut self, place: [f64; 2], side: f64, depth: u32) -> [f32; 4] {
        let Some(ray) = self.ray(place, side) else { return [0.0; 4] };
        match self.sampler.light(&ray, self.view.spread) {
            Some(light) => {
                let mut seen = light.map(|part| [part; Seen::N]);
                self.shade.see(&mut seen, &[ray.doppler as f32; Seen::N]);
                seen.map(|part| part[0])
            }
            None if depth < MOST_DIVISIONS => self.divided(place, side, depth),
            // The footprint still covers nearly the whole sky. At this depth it weighs at most 4⁻²⁴
            // of a sample, so it is left out.
            None => [0.0; 4],
        }
    }

    /// The mean of the four quarters of a square, whose footprint is too large.
    fn divided(&mut self, place: [f64; 2], side: f64, depth: u32) -> [f32; 4] {
        let mut sum = [0.0_f32; 4];
        for [right, below] in [[-0.25, -0.25], [0.25, -0.25], [-0.25, 0.25], [0.25, 0.25]] {
            let quarter = [place[0] + right * side, place[1] + below * side];
            let light = self.part(quarter, 0.5 * side, depth + 1);
            (0..4).for_each(|channel| sum[channel] += 0.25 * light[channel]);
        }
        sum
    }

    /// The ray of a square of the film, `side` samples wide; `None` where the lens shows nothing.
    #[inline]
    fn ray(&self, [x, y]: [f64; 2], side: f64) -> Option<SkyRay> {
        let (seen, observer) = (&self.film, &self.view.observer);
        let direction = seen([x, y])?;
        let step = HALF_STEP * side;
        if self.view.flat.is_some() {
            // Directions of depth 1 are linear in the place on the film.
            let inverse = 1.0 / direction.length();
            let unit = direction * inverse;
            let slope = |place: [f64; 2]| {
                let difference = (seen(place).unwrap_or(direction) - direction) * (inverse / HALF_STEP);
                difference - unit.dot(difference) * unit
            };
            return Some(observer.ray(unit, [slope([x + step, y]), slope([x, y + step])]));
        }
        let slope = |[right, below]: [f64; 2]| {
            let ends = [-1.0, 1.0].map(|sign| seen([x + sign * right * step, y + sign * below * step]));
            let difference = match ends {
                [Some(before), Some(after)] => (after - before) / (2.0 * HALF_STEP),
                [Some(before), None] => (direction - before) / HALF_STEP,
                [None, Some(after)] => (after - direction) / HALF_STEP,
                [None, None] => DVec3::ZERO,
            };
            difference - direction.dot(difference) * direction
        };
        Some(observer.ray(direction, [slope([1.0, 0.0]), slope([0.0, 1.0])]))
    }
}
