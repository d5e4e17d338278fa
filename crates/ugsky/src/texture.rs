//! Textures: light in a plane, with the same texels and kernels as panoramas.

use fearless_simd::Level;

use crate::footprint::{PlaneEllipse, correction_of};
use crate::panorama::PanoramaError;
use crate::pyramid::Pyramid;
use crate::texels::Texels;

/// The texels beyond the edges of a texture, in one of its directions.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Wrap {
    /// The texture again, as around the longitudes of a panorama.
    #[default]
    Repeat,
    /// The texels at the edge.
    Clamp,
    /// Nothing, as beyond the edges of a part of a panorama.
    Blank,
}

impl Wrap {
    /// The texel that is seen at an index; `None` for nothing.
    #[inline]
    fn texel(self, idx: i64, n: usize) -> Option<usize> {
        let last = n as i64 - 1;
        match self {
            Self::Repeat => Some(idx.rem_euclid(n as i64) as usize),
            Self::Clamp => Some(idx.clamp(0, last) as usize),
            Self::Blank => (0..=last).contains(&idx).then_some(idx as usize),
        }
    }
}

/// Footprints that are larger than so many textures count as that large.
const MOST_TEXTURES: f64 = 16.0;

/// Light in a plane. Coordinates (u, v) are 0 to 1 from left to right and from the top down.
///
/// ```
/// use ugsky::{Texels, Texture, Wrap};
///
/// let board = vec![[0.0, 0.0, 0.0, 1.0], [1.0, 1.0, 1.0, 1.0], [1.0, 1.0, 1.0, 1.0], [0.0, 0.0, 0.0, 1.0]];
/// let texture = Texture::new([2, 2], Texels::Light(board), [Wrap::Repeat; 2])?;
/// // Seen from afar, where a pixel covers several squares, a chessboard is grey.
/// let [red, .., alpha] = texture.light([0.3, 0.8], [[3.0, 0.0], [0.0, 4.0]], 1.0);
/// assert!((red - 0.5).abs() < 1e-3 && (alpha - 1.0).abs() < 1e-6);
/// # Ok::<(), ugsky::PanoramaError>(())
/// ```
pub struct Texture {
    pyramid: Pyramid,
    /// Texels of each level across and down.
    sizes: Vec<[usize; 2]>,
    wrap: [Wrap; 2],
    simd: Level,
}

impl Texture {
    /// A texture of `size` texels across and down. `wrap`: beyond its edges across and down.
    ///
    /// # Errors
    /// [`PanoramaError::Size`].
    pub fn new(size: [u32; 2], texels: Texels, wrap: [Wrap; 2]) -> Result<Self, PanoramaError> {
        let mut sizes = vec![size.map(|side| side as usize)];
        if texels.len() == 0 || texels.len() != sizes[0][0] * sizes[0][1] {
            return Err(PanoramaError::Size);
        }
        while let Some(&finer) = sizes.last().filter(|size| **size != [1, 1]) {
            sizes.push(finer.map(|side| side.div_ceil(2)));
        }
        let shapes: Vec<_> = sizes.iter().map(|[width, height]| vec![(*width, 1.0); *height]).collect();
        let pyramid = Pyramid::new(texels, sizes[0][0], wrap[0] == Wrap::Repeat, &shapes);
        Ok(Self { pyramid, sizes, wrap, simd: Level::new() })
    }

    /// The mean light of a footprint around (u, v): light times alpha, and alpha. `axes`: the
    /// change of (u, v) per column and per row of the picture, two axes of an ellipse; `spread`:
    /// the variance of the pixel filter along each relative to that of a box.
    #[must_use]
    pub fn light(&self, place: [f64; 2], axes: [[f64; 2]; 2], spread: f64) -> [f32; 4] {
        let longest = axes.as_flattened().iter().fold(0.0, |most: f64, part| most.max(part.abs()));
        let is_finite = longest.is_finite() && place.iter().all(|part| part.abs() < 1e9);
        if !is_finite {
            return [0.0; 4];
        }
        let scale = (MOST_TEXTURES / longest).min(1.0);
        // In texels of a level, which are so wide as to make the footprint as large as one or two.
        let on = |[width, height]: [usize; 2]| {
            let part = |axis: usize, side: usize| axes.map(|slope| slope[axis] * scale * side as f64);
            PlaneEllipse::new(part(0, width), part(1, height), spread)
        };
        let coarser = self.sizes[1..].iter().take_while(|size| on(**size).squares[0] >= 1.0).count();
        let [width, height] = self.sizes[coarser];
        let center = [place[0] * width as f64 - 0.5, place[1] * height as f64 - 0.5];
        self.sum(coarser, center, on([width, height]).kernel(1.0, 1.0 / (1_u64 << coarser) as f64))
    }

    /// The weighted mean of the texels of a level, as [`crate::footprint::Kernel`].
    fn sum(&self, level: usize, center: [f64; 2], ([see, sen, snn], c): ([f64; 3], f64)) -> [f32; 4] {
        let ratio = sen / snn;
        let see = see - sen * ratio;
        let mut weights: Vec<([i64; 2], [f32; 3])> = Vec::new();
        let mut sums = [0.0_f32; 5];
        let reach = |at: f64, half: f64| (at - half).ceil() as i64..=(at + half).floor() as i64;
        for row in reach(center[1], snn.sqrt()) {
            let down = row as f64 - center[1];
            let half = (see * (1.0 - down * down / snn).max(0.0)).sqrt();
            for column in reach(center[0] + ratio * down, half) {
                let s = (column as f64 - center[0] - ratio * down) / see.sqrt();
                let t = down / snn.sqrt();
                let q = s * s + t * t;
                let positive = (1.0 - q).max(0.0) * (1.0 - q).max(0.0);
                let parts = [positive * (1.0 - c * q), positive * s, positive * t].map(|part| part as f32);
                let ([kernel, across, along], s, t) = (parts, s as f32, t as f32);
                let moments = [kernel * s, kernel * t, across * s, across * t, along * t];
                (0..5).for_each(|idx| sums[idx] += moments[idx]);
                weights.push(([column, row], parts));
            }
        }
        let [across, along] = correction_of(self.simd, sums);
        let (mut light, mut total) = ([0.0; 4], 0.0);
        for (place, [kernel, by_s, by_t]) in weights {
            let weight = kernel + across * by_s + along * by_t;
            total += weight;
            let texel = self.texel(level, place);
            (0..4).for_each(|channel| light[channel] += weight * texel[channel]);
        }
        light.map(|part| part / total)
    }

    /// A texel of a level, in the texture or beyond.
    fn texel(&self, level: usize, place: [i64; 2]) -> [f32; 4] {
        let [width, height] = self.sizes[level];
        match (self.wrap[0].texel(place[0], width), self.wrap[1].texel(place[1], height)) {
            (Some(column), Some(row)) => self.pyramid.texels(level, row, column, 1).get(0),
            _ => [0.0; 4],
        }
    }
}

#[cfg(test)]
mod tests {
    use core::f64::consts::TAU;

    use super::*;

    /// Waves that go on in a texture that is repeated.
    fn waves([u, v]: [f64; 2]) -> f64 {
        0.5 + 0.2 * libm::sin(TAU * (2.0 * u + v)) + 0.2 * libm::cos(TAU * 3.0 * v)
    }

    fn texture(size: [u32; 2], wrap: Wrap, light: impl Fn([f64; 2]) -> f64) -> Texture {
        let texel = |idx: u32| {
            let place = [idx % size[0], idx / size[0]].map(|at| f64::from(at) + 0.5);
            let light = light([place[0] / f64::from(size[0]), place[1] / f64::from(size[1])]) as f32;
            [light, 1.0 - light, 0.25, 1.0]
        };
        Texture::new(size, Texels::Light((0..size[0] * size[1]).map(texel).collect()), [wrap; 2]).unwrap()
    }

    fn places() -> impl Iterator<Item = ([f64; 2], f64)> {
        (0..300).map(|step| {
            let part = |by: f64| (f64::from(step) * by).fract();
            ([3.0 * part(0.618_034) - 1.0, 3.0 * part(0.754_878) - 1.0], TAU * part(0.569_84))
        })
    }

    /// Footprints of any size and shape are means of the light, at seams too.
    #[test]
    fn footprints_are_means() {
        for size in [[256, 256], [301, 127], [1, 90]] {
            let light = |[u, v]: [f64; 2]| waves([if size[0] == 1 { 0.0 } else { u }, v]);
            let texture = texture(size, Wrap::Repeat, light);
            for axes in [[1e-5, 1e-5], [0.02, 0.01], [0.06, 0.05], [0.08, 0.006]] {
                // A square of a seventh of a wave has another shape than the kernel.
                let limit = if axes[0] > 0.05 { 0.012 } else { 2e-3 };
                for (place, turn) in places() {
                    let (sin, cos) = libm::sincos(turn);
                    let axes = [[axes[0] * cos, axes[0] * sin], [-axes[1] * sin, axes[1] * cos]];
                    let mut sum = 0.0;
                    for (i, j) in (0..20).flat_map(|i| (0..20).map(move |j| (i, j))) {
                        let [x, y] = [i, j].map(|at| (f64::from(at) + 0.5) / 20.0 - 0.5);
                        sum += light([0, 1].map(|k| place[k] + x * axes[0][k] + y * axes[1][k])) / 400.0;
                    }
                    let [red, green, blue, alpha] = texture.light(place, axes, 1.0).map(f64::from);
                    assert!((red - sum).abs() < limit, "{size:?} {place:?} {axes:?}: {red} {sum}");
                    assert!((red + green - 1.0).abs() + (blue - 0.25).abs() + (alpha - 1.0).abs() < 1e-5);
                }
            }
        }
    }

    /// A linear function is exact between texels, and goes on with its last value or none.
    #[test]
    fn edges_are_clamped_or_blank() {
        let ramp = |[u, _]: [f64; 2]| u;
        let (clamped, blank) = (texture([64, 64], Wrap::Clamp, ramp), texture([64, 64], Wrap::Blank, ramp));
        let pixel = [[1e-3, 0.0], [0.0, 1e-3]];
        for ([u, v], _) in places() {
            let inside = u.min(1.0 - u).min(v).min(1.0 - v);
            let [red, .., alpha] = clamped.light([u, v], pixel, 1.0).map(f64::from);
            assert!((alpha - 1.0).abs() < 1e-5);
            if u.min(1.0 - u) > 0.05 {
                assert!((red - u).abs() < 1e-5, "{u} {red}");
            } else if u.min(1.0 - u) < -0.05 {
                assert!((red - u.round().clamp(0.5 / 64.0, 63.5 / 64.0)).abs() < 1e-5, "{u} {red}");
            }
            let alpha = blank.light([u, v], pixel, 1.0)[3];
            assert!(inside.abs() < 0.05 || (alpha - f32::from(inside > 0.0)).abs() < 1e-5, "{u} {v} {alpha}");
        }
        // All of it, and far more than that.
        for size in [1.0, 1e3, 1e300] {
            let mean =
                texture([64, 64], Wrap::Repeat, ramp).light([0.5; 2], [[size, 0.0], [0.0, size]], 1.0)[0];
            assert!((mean - 0.5).abs() < 0.02, "{size} {mean}");
        }
        assert_eq!(clamped.light([f64::NAN, 0.0], pixel, 1.0), [0.0; 4]);
        assert!(Texture::new([2, 3], Texels::Srgb(vec![[0; 4]; 5]), [Wrap::Clamp; 2]).is_err());
    }
}
