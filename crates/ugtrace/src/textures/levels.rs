//! Texels with mip levels, sampled along the long axis of a footprint.

use glam::DVec2;
use ugimage::Pixels;
use ugphysics::srgb_decode;
use ugscene::Wrap;

/// The most probes along the long axis of a footprint. A longer one is blurred across.
const MOST_PROBES: f64 = 16.0;

/// Length of the long axis of a footprint, in texels, up to which one probe is enough.
const POINT: f64 = 0.25;

/// How texels are read.
#[derive(Clone, Copy, Debug)]
pub struct Filter {
    /// What is beyond the edges of the picture.
    pub wrap: [Wrap; 2],
    /// Texels of the picture are flat squares, not interpolated.
    pub is_nearest: bool,
}

/// A picture, and the same with half as many texels on each side, and so on down to one.
#[derive(Debug)]
pub struct Levels {
    base: Base,
    decoded: Box<[f32; 256]>,
    /// From the second level on.
    others: Vec<Level>,
}

/// The texels of the picture itself.
#[derive(Debug)]
struct Base {
    size: [usize; 2],
    pixels: Pixels,
    /// Alpha is ignored.
    is_opaque: bool,
}

/// Linear light times alpha, and alpha.
#[derive(Debug)]
struct Level {
    size: [usize; 2],
    texels: Box<[[f32; 4]]>,
}

impl Levels {
    /// `None` if there is not enough memory.
    pub fn new(size: [u32; 2], pixels: Pixels, is_opaque: bool) -> Option<Self> {
        let decoded = Box::new(std::array::from_fn(|byte| srgb_decode(byte as f64 / 255.0) as f32));
        let base = Base { size: size.map(|side| side as usize), pixels, is_opaque };
        let mut levels = Self { base, decoded, others: Vec::new() };
        let mut size = levels.base.size;
        while size != [1, 1] {
            let half = size.map(|side| side.div_ceil(2));
            let texels = match levels.others.last() {
                Some(level) => halved(size, half, |at| level.texels[at])?,
                None => halved(size, half, |at| levels.base_texel(at))?,
            };
            levels.others.push(Level { size: half, texels });
            size = half;
        }
        Some(levels)
    }

    /// A texel of the picture: light times alpha, and alpha. Light that is not finite, or below 0,
    /// is none.
    #[inline]
    fn base_texel(&self, at: usize) -> [f32; 4] {
        let Base { pixels, is_opaque, .. } = &self.base;
        let [red, green, blue, alpha] = match pixels {
            Pixels::Srgb(pixels) => {
                let [red, green, blue, alpha] = pixels[at];
                let [red, green, blue] =
                    [red, green, blue].map(|byte| self.decoded[usize::from(byte)]);
                [red, green, blue, if alpha == 255 { 1.0 } else { f32::from(alpha) / 255.0 }]
            }
            Pixels::Light(pixels) => {
                pixels[at].map(|part| if part.is_finite() { part.max(0.0) } else { 0.0 })
            }
        };
        if *is_opaque {
            return [red, green, blue, 1.0];
        }
        let alpha = alpha.min(1.0);
        [red * alpha, green * alpha, blue * alpha, alpha]
    }

    /// Linear red, green and blue, and alpha, in the footprint of a sample.
    ///
    /// `uv`: its middle. `steps`: the changes of uv to the next sample across and down. The
    /// footprint is the ellipse with these as conjugate half-diameters; probes along its long axis
    /// read the level whose texels are as wide as its short one. `filter`: of texels that are
    /// larger.
    pub fn sample(&self, uv: DVec2, steps: [DVec2; 2], filter: Filter) -> [f64; 4] {
        let sides = DVec2::from_array(self.base.size.map(|side| side as f64));
        let (long, width) = axes(steps.map(|step| step * sides));
        let length = long.length();
        let texel = if !length.is_finite() || length > 2.0 * sides.max_element() {
            // A sample of many repetitions, as at a horizon, or without a finite footprint.
            self.trilinear(uv, f64::MAX, filter)
        } else if length <= POINT {
            self.texel(0, uv, filter)
        } else {
            // Two show where within the footprint an edge between texels is.
            let fewest = if width <= 1.0 { 2.0 } else { 1.0 };
            // Rounded by the cast.
            let n_probes = (length / width.max(1.0)).clamp(fewest, MOST_PROBES);
            let n_probes = f64::from((n_probes + 0.5) as u32);
            let level = libm::log2((length / n_probes).max(width).max(1.0));
            let along = long / sides;
            let mut sum = [0.0; 4];
            for probe in 0..n_probes as u32 {
                let part = (f64::from(probe) + 0.5) / n_probes - 0.5;
                let texel = self.trilinear(uv + part * along, level, filter);
                sum.iter_mut().zip(texel).for_each(|(sum, part)| *sum += part);
            }
            sum.map(|part| part / n_probes as f32)
        };
        let [red, green, blue, alpha] = texel.map(f64::from);
        if alpha == 0.0 {
            return [0.0; 4];
        }
        [red / alpha, green / alpha, blue / alpha, alpha]
    }

    fn trilinear(&self, uv: DVec2, level: f64, filter: Filter) -> [f32; 4] {
        let level = level.min(self.others.len() as f64);
        // Levels are not below 0.
        let whole = level as usize;
        let part = (level - whole as f64) as f32;
        let near = self.texel(whole, uv, filter);
        if part == 0.0 {
            return near;
        }
        let far = self.texel(whole + 1, uv, filter);
        std::array::from_fn(|at| near[at] + part * (far[at] - near[at]))
    }

    #[inline]
    fn texel(&self, level: usize, uv: DVec2, filter: Filter) -> [f32; 4] {
        let Filter { wrap, is_nearest } = filter;
        let other = level.checked_sub(1).map(|row| &self.others[row]);
        let [width, height] = other.map_or(self.base.size, |level| level.size);
        let [(left, right, x), (top, bottom, y)] =
            [(uv.x, width, wrap[0]), (uv.y, height, wrap[1])].map(neighbours);
        // Smaller texels than those of the picture are not larger than a sample.
        let step = |part: f32| if is_nearest && level == 0 { part.round() } else { part };
        let (x, y) = (step(x), step(y));
        let texel = |column: usize, row: usize| {
            let at = row * width + column;
            other.map_or_else(|| self.base_texel(at), |level| level.texels[at])
        };
        let [a, b, c, d] =
            [texel(left, top), texel(right, top), texel(left, bottom), texel(right, bottom)];
        std::array::from_fn(|at| {
            let (upper, lower) = (a[at] + x * (b[at] - a[at]), c[at] + x * (d[at] - c[at]));
            upper + y * (lower - upper)
        })
    }
}

/// The long axis of the ellipse with two conjugate half-diameters, and the length of the short one:
/// the singular values of the matrix of both.
fn axes([a, b]: [DVec2; 2]) -> (DVec2, f64) {
    let (xx, xy, yy) = (a.x * a.x + b.x * b.x, a.x * a.y + b.x * b.y, a.y * a.y + b.y * b.y);
    let (mean, half) = (0.5 * (xx + yy), 0.5 * (xx - yy));
    let square = mean + (half * half + xy * xy).sqrt();
    let length = square.sqrt();
    // Of the two forms of the direction, the one without cancellation.
    let direction =
        if half >= 0.0 { DVec2::new(square - yy, xy) } else { DVec2::new(xy, square - xx) };
    let direction = direction.try_normalize().unwrap_or(DVec2::X);
    let width = if length > 0.0 { a.perp_dot(b).abs() / length } else { 0.0 };
    (length * direction, width)
}

/// The largest integer that is not greater. `f64::floor` is a call on processors for which
/// programs are compiled by default.
#[inline]
fn floor(number: f64) -> f64 {
    /// Larger numbers of type f64 are integers.
    const INTEGERS: f64 = (1_u64 << 52) as f64;
    if number.abs() < INTEGERS {
        let toward_zero = number as i64 as f64;
        toward_zero - f64::from(u8::from(toward_zero > number))
    } else {
        number.floor()
    }
}

/// The two texels beside a coordinate along one axis, and the share of the second.
#[inline]
fn neighbours((place, side, wrap): (f64, usize, Wrap)) -> (usize, usize, f32) {
    let place = match wrap {
        Wrap::Repeat => place - floor(place),
        Wrap::Mirror => place - 2.0 * floor(0.5 * place),
        Wrap::Clamp => place.clamp(0.0, 1.0),
    };
    // From -1/2 to side - 1/2, or to twice that; NaN becomes the first texel.
    let at = place * side as f64 - 0.5;
    let first = floor(at);
    let part = if at.is_finite() { (at - first) as f32 } else { 0.0 };
    let (first, side) = (first as i64, side as i64);
    if 0 <= first && first + 1 < side {
        return (first as usize, first as usize + 1, part);
    }
    let inside = |at: i64| match wrap {
        Wrap::Repeat if at < 0 => side - 1,
        Wrap::Repeat if at >= side => 0,
        Wrap::Mirror if at >= side => (2 * side - 1 - at).max(0),
        _ => at.clamp(0, side - 1),
    };
    (inside(first) as usize, inside(first + 1) as usize, part)
}

/// A level of half the size: each texel is the mean of the area that it covers. `None` if there is
/// not enough memory.
fn halved(
    size: [usize; 2],
    half: [usize; 2],
    texel: impl Fn(usize) -> [f32; 4],
) -> Option<Box<[[f32; 4]]>> {
    let [columns, rows] = [0, 1].map(|axis| {
        (0..half[axis]).map(|at| covered(at, half[axis], size[axis])).collect::<Vec<_>>()
    });
    let mut texels = Vec::new();
    texels.try_reserve_exact(half[0] * half[1]).ok()?;
    for row in &rows {
        for column in &columns {
            let mut sum = [0.0; 4];
            for &(y, height) in row {
                for &(x, width) in column {
                    let part = texel(y * size[0] + x);
                    (0..4).for_each(|at| sum[at] += height * width * part[at]);
                }
            }
            texels.push(sum);
        }
    }
    Some(texels.into())
}

/// The texels that texel `at` of `half` covers of `side`, and their shares of its length. There are
/// three at most.
fn covered(at: usize, half: usize, side: usize) -> Vec<(usize, f32)> {
    let scale = side as f64 / half as f64;
    let (start, end) = (at as f64 * scale, (at + 1) as f64 * scale);
    let share = |texel: usize| {
        let common = (end.min((texel + 1) as f64) - start.max(texel as f64)).max(0.0);
        (texel, (common / scale) as f32)
    };
    let texels = (start.floor() as usize)..(end.ceil() as usize).min(side);
    texels.map(share).filter(|&(_, share)| share > 0.0).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A grey of each pixel, as light.
    fn grey(size: [u32; 2], light: impl Fn(u32, u32) -> f32) -> Levels {
        let pixel = |at: u32| {
            let light = light(at % size[0], at / size[0]);
            [light, light, light, 1.0]
        };
        Levels::new(size, Pixels::Light((0..size[0] * size[1]).map(pixel).collect()), true).unwrap()
    }

    fn red(levels: &Levels, [u, v]: [f64; 2], step: f64, wrap: Wrap) -> f64 {
        let steps = [DVec2::new(step, 0.0), DVec2::new(0.0, step)];
        levels.sample(DVec2::new(u, v), steps, smooth(wrap))[0]
    }

    fn smooth(wrap: Wrap) -> Filter {
        Filter { wrap: [wrap; 2], is_nearest: false }
    }

    /// Means of each level are that of the picture, whatever its sides.
    #[test]
    fn levels_keep_the_mean() {
        for size in [[1, 1], [2, 3], [7, 5], [16, 16], [33, 1], [1, 12]] {
            let levels = grey(size, |x, y| (1 + x * x + 3 * y) as f32);
            let mean = |texels: &[[f32; 4]]| {
                texels.iter().map(|it| f64::from(it[0])).sum::<f64>() / texels.len() as f64
            };
            let base: Vec<_> =
                (0..(size[0] * size[1]) as usize).map(|at| levels.base_texel(at)).collect();
            for level in &levels.others {
                assert!(
                    (mean(&level.texels) / mean(&base) - 1.0).abs() < 1e-6,
                    "{size:?} {:?}",
                    level.size
                );
            }
            // Footprints of many pictures have the mean, and so have those without an end.
            for step in [10.0, 1e30, f64::NAN, f64::INFINITY] {
                assert!(
                    (red(&levels, [0.3, 0.8], step, Wrap::Repeat) / mean(&base) - 1.0).abs() < 1e-6
                );
            }
        }
    }

    #[test]
    fn texels_continue_beyond_the_edges() {
        let levels = grey([4, 1], |x, _| x as f32);
        // Middles of texels are at (k + 1/2)/4.
        for (wrap, place, expected) in [
            (Wrap::Repeat, 0.125, 0.0),
            (Wrap::Repeat, 0.25, 0.5),
            (Wrap::Repeat, 0.0, 1.5),
            (Wrap::Repeat, -0.125, 3.0),
            (Wrap::Repeat, 1e6 + 0.375, 1.0),
            (Wrap::Clamp, -3.0, 0.0),
            (Wrap::Clamp, 0.9, 3.0),
            (Wrap::Clamp, 1e38, 3.0),
            (Wrap::Mirror, -0.125, 0.0),
            (Wrap::Mirror, 1.0, 3.0),
            (Wrap::Mirror, 1.375, 2.0),
            (Wrap::Mirror, 2.125, 0.0),
            (Wrap::Mirror, -1.125, 3.0),
        ] {
            let found = red(&levels, [place, 0.5], 0.0, wrap);
            assert!((found - expected).abs() < 1e-6, "{wrap:?} {place}: {found}, {expected}");
        }
        assert!(red(&levels, [f64::NAN, f64::INFINITY], 0.0, Wrap::Mirror).is_finite());
    }

    /// A long footprint along stripes is as sharp across them as a short one.
    #[test]
    fn probes_follow_the_long_axis() {
        let levels = grey([64, 64], |x, _| (x % 2) as f32);
        let sample = |steps: [DVec2; 2]| {
            levels.sample(DVec2::new(0.5 / 64.0, 0.5), steps, smooth(Wrap::Repeat))[0]
        };
        let short = DVec2::new(0.5 / 64.0, 0.0);
        assert!(sample([short, DVec2::new(0.0, 12.0 / 64.0)]) < 1e-6);
        assert!(
            (sample([DVec2::new(12.0 / 64.0, 0.0), DVec2::new(0.0, 0.5 / 64.0)]) - 0.5).abs() < 0.1
        );
        // Two nearly parallel steps are a long thin ellipse, too.
        let slanted = [DVec2::new(0.4 / 64.0, 12.0 / 64.0), DVec2::new(-0.4 / 64.0, 12.0 / 64.0)];
        assert!(sample(slanted) < 0.3, "{}", sample(slanted));
    }

    /// Colours of transparent pixels do not bleed into others.
    #[test]
    fn light_is_weighted_by_alpha() {
        let pixels = vec![[255, 0, 0, 255], [0, 255, 0, 0]];
        let levels = Levels::new([2, 1], Pixels::Srgb(pixels), false).unwrap();
        let found = levels.sample(DVec2::new(0.5, 0.5), [DVec2::ZERO; 2], smooth(Wrap::Clamp));
        assert_eq!(found, [1.0, 0.0, 0.0, 0.5]);
    }

    /// Large texels are flat squares with sharp edges at k/4; small ones have their mean.
    #[test]
    fn nearest_texels_are_squares() {
        let levels = grey([4, 1], |x, _| x as f32);
        let sample = |place: f64, step: f64, wrap: Wrap| {
            let filter = Filter { wrap: [wrap; 2], is_nearest: true };
            let steps = [DVec2::new(step, 0.0), DVec2::new(0.0, step)];
            levels.sample(DVec2::new(place, 0.5), steps, filter)[0]
        };
        for (place, wrap, expected) in [
            (0.01, Wrap::Repeat, 0.0),
            (0.249, Wrap::Repeat, 0.0),
            (0.251, Wrap::Repeat, 1.0),
            (0.74, Wrap::Clamp, 2.0),
            (0.76, Wrap::Clamp, 3.0),
            (1.01, Wrap::Repeat, 0.0),
            (-0.01, Wrap::Repeat, 3.0),
            (1.01, Wrap::Mirror, 3.0),
            (9.0, Wrap::Clamp, 3.0),
        ] {
            assert_eq!(sample(place, 0.001, wrap), expected, "{place} {wrap:?}");
        }
        // A footprint across an edge is the mean of both sides, weighted by their parts of it.
        assert_eq!(sample(0.5, 0.2, Wrap::Clamp), 1.5);
        assert!((sample(0.3, 40.0, Wrap::Repeat) - 1.5).abs() < 1e-6);
        assert!(sample(f64::NAN, 0.0, Wrap::Repeat).is_finite());
    }
}
