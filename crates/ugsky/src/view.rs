//! From places in a picture to the light seen.

use fearless_simd::{Simd, dispatch};
use glam::DVec3;

use crate::observer::{Observer, SkyRay};
use crate::sample::{Sampler, Seen};
use crate::shade::Shade;

/// Half the distance of the places whose directions are compared, in samples: less than a half, so
/// that both are in the same view of a picture of several.
const HALF_STEP: f64 = 0.49;

/// How often the footprint of a sample is divided at most, if it is large on the sky.
pub(crate) const MOST_DIVISIONS: u32 = 24;

/// The middles of the quarters of a square, in its sides from its middle.
pub(crate) const QUARTERS: [[f64; 2]; 4] =
    [[-0.25, -0.25], [0.25, -0.25], [-0.25, 0.25], [0.25, 0.25]];

/// Directions seen by the places of a flat film: corner + x across + y down, of any length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlatFilm {
    /// Direction of the origin.
    pub corner: DVec3,
    /// Its change per column.
    pub across: DVec3,
    /// Its change per row.
    pub down: DVec3,
}

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

impl SkyView {
    /// The ray of a square of the film, `side` samples wide; `None` where the lens shows nothing.
    #[inline(always)]
    pub(crate) fn ray(
        &self,
        seen: impl Fn([f64; 2]) -> Option<DVec3>,
        [x, y]: [f64; 2],
        side: f64,
    ) -> Option<SkyRay> {
        if let Some(FlatFilm { corner, across, down }) = self.flat {
            let direction = corner + x * across + y * down;
            let inverse = 1.0 / direction.length();
            let unit = direction * inverse;
            let slope = |step: DVec3| (step - unit.dot(step) * unit) * (inverse * side);
            return Some(self.observer.ray(unit, [across, down].map(slope)));
        }
        let direction = seen([x, y])?;
        let step = HALF_STEP * side;
        let slope = |[right, below]: [f64; 2]| {
            let ends =
                [-1.0, 1.0].map(|sign| seen([x + sign * right * step, y + sign * below * step]));
            let difference = match ends {
                [Some(before), Some(after)] => (after - before) / (2.0 * HALF_STEP),
                [Some(before), None] => (direction - before) / HALF_STEP,
                [None, Some(after)] => (after - direction) / HALF_STEP,
                [None, None] => DVec3::ZERO,
            };
            difference - direction.dot(difference) * direction
        };
        Some(self.observer.ray(direction, [slope([1.0, 0.0]), slope([0.0, 1.0])]))
    }
}

/// The light of a sky in the samples of a picture, on one thread.
pub struct SkyLight<'a, 's, F> {
    /// The observer and the picture.
    pub view: &'a SkyView,
    /// The direction seen at a place, in samples from the upper left corner, of length 1, unless
    /// the lens is flat. `None` where it shows nothing.
    pub film: F,
    /// How colours change.
    pub shade: &'a Shade,
    /// The light of the sky at rest.
    pub sampler: &'a mut Sampler<'s>,
}

impl<F: Fn([f64; 2]) -> Option<DVec3>> SkyLight<'_, '_, F> {
    /// The light seen in `n` samples of a row: red, green and blue times the covered part, and that
    /// part. It is exact at poles, at edges and for samples that see most of the sky.
    pub fn row(&mut self, found: &mut [Seen], start: [f64; 2], n: usize) {
        dispatch!(self.sampler.simd, simd => self.row_on(simd, found, start, n));
    }

    #[inline(always)]
    fn row_on<S: Simd>(&mut self, simd: S, found: &mut [Seen], [left, y]: [f64; 2], n: usize) {
        for (first, seen) in found.iter_mut().enumerate() {
            let place = |idx: usize| [left + (first * Seen::N + idx) as f64, y];
            let n = Seen::N.min(n - first * Seen::N);
            let (view, film) = (self.view, &self.film);
            let ray = |idx| if idx < n { view.ray(film, place(idx), 1.0) } else { None };
            *seen = self.sampler.see_on(simd, ray, view.spread);
            self.shade.see_on(simd, &mut seen.light, &seen.doppler);
            for idx in (0..n).filter(|idx| !seen.is_found[*idx]) {
                let light = self.divided(place(idx), 1.0, 0);
                (0..4).for_each(|channel| seen.light[channel][idx] = light[channel]);
            }
        }
    }

    /// The light of a square of the film, `side` samples wide, as seen.
    fn part(&mut self, place: [f64; 2], side: f64, depth: u32) -> [f32; 4] {
        let Some(ray) = self.view.ray(&self.film, place, side) else { return [0.0; 4] };
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
        for [right, below] in QUARTERS {
            let quarter = [place[0] + right * side, place[1] + below * side];
            let light = self.part(quarter, 0.5 * side, depth + 1);
            (0..4).for_each(|channel| sum[channel] += 0.25 * light[channel]);
        }
        sum
    }
}
