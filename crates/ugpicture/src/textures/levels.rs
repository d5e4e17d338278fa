//! Texels with mip levels, sampled along the long axis of a footprint.

use glam::DVec2;
use ugimage::Pixels;
use ugphysics::srgb_decode;
use ugscene::Wrap;

/// The most probes along the long axis of a footprint. A longer one is blurred across.
const MOST_PROBES: f64 = 16.0;

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
    pub fn new(size: [u32; 2], pixels: Pixels, is_opaque: bool) -> Self {
        let decoded = Box::new(std::array::from_fn(|byte| srgb_decode(byte as f64 / 255.0) as f32));
        let base = Base { size: size.map(|side| side as usize), pixels, is_opaque };
        let mut levels = Self { base, decoded, others: Vec::new() };
        let mut size = levels.base.size;
        while size != [1, 1] {
            let half = size.map(|side| side.div_ceil(2));
            let texels = match levels.others.last() {
                Some(level) => halved(size, half, |at| level.texels[at]),
                None => halved(size, half, |at| levels.base_texel(at)),
            };
            levels.others.push(Level { size: half, texels });
            size = half;
        }
        levels
    }

    /// A texel of the picture: light times alpha, and alpha. Light that is not finite, or below 0,
    /// is none.
    #[inline]
    fn base_texel(&self, at: usize) -> [f32; 4] {
        let Base { pixels, is_opaque, .. } = &self.base;
        let [red, green, blue, alpha] = match pixels {
            Pixels::Srgb(pixels) => {
                let [red, green, blue, alpha] = pixels[at];
                let [red, green, blue] = [red, green, blue].map(|byte| self.decoded[usize::from(byte)]);
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
    /// read the level whose texels are as wide as its short one.
    pub fn sample(&self, uv: DVec2, steps: [DVec2; 2], wrap: [Wrap; 2]) -> [f64; 4] {
        let sides = DVec2::from_array(self.base.size.map(|side| side as f64));
        let (long, width) = axes(steps.map(|step| step * sides));
        let length = long.length();
        let texel = if !length.is_finite() || length > 2.0 * sides.max_element() {
            // A sample of many repetitions, as at a horizon, or without a finite footprint.
            self.trilinear(uv, f64::MAX, wrap)
        } else if length <= 1.0 {
            self.bilinear(0, uv, wrap)
        } else {
            let n_probes = (length / width.max(1.0)).ceil().clamp(1.0, MOST_PROBES);
            let level = libm::log2((length / n_probes).max(width).max(1.0));
            let along = long / sides;
            let mut sum = [0.0; 4];
            for probe in 0..n_probes as u32 {
                let part = (f64::from(probe) + 0.5) / n_probes - 0.5;
                let texel = self.trilinear(uv + part * along, level, wrap);
                sum.iter_mut().zip(texel).for_each(|(sum, part)| *sum += part / n_probes);
            }
            sum
        };
        let [red, green, blue, alpha] = texel;
        match alpha {
            0.0 => [0.0; 4],
            1.0 => texel,
            _ => [red / alpha, green / alpha, blue / alpha, alpha],
        }
    }

    fn trilinear(&self, uv: DVec2, level: f64, wrap: [Wrap; 2]) -> [f64; 4] {
        let level = level.min(self.others.len() as f64);
        let (whole, part) = (level.floor() as usize, level.fract());
        let near = self.bilinear(whole, uv, wrap);
        if part == 0.0 {
            return near;
        }
        let far = self.bilinear(whole + 1, uv, wrap);
        std::array::from_fn(|at| near[at] + part * (far[at] - near[at]))
    }

    fn bilinear(&self, level: usize, uv: DVec2, wrap: [Wrap; 2]) -> [f64; 4] {
        let other = level.checked_sub(1).map(|row| &self.others[row]);
        let [width, height] = other.map_or(self.base.size, |level| level.size);
        let [(left, right, x), (top, bottom, y)] =
            [(uv.x, width, wrap[0]), (uv.y, height, wrap[1])].map(neighbours);
        let texel = |column: usize, row: usize| {
            let at = row * width + column;
            other.map_or_else(|| self.base_texel(at), |level| level.texels[at])
        };
        let [a, b, c, d] = [texel(left, top), texel(right, top), texel(left, bottom), texel(right, bottom)];
        std::array::from_fn(|at| {
            let [a, b, c, d] = [a[at], b[at], c[at], d[at]].map(f64::from);
            let (upper, lower) = (a + x * (b - a), c + x * (d - c));
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
    let direction = if half >= 0.0 { DVec2::new(square - yy, xy) } else { DVec2::new(xy, square - xx) };
    let direction = direction.try_normalize().unwrap_or(DVec2::X);
    let width = if length > 0.0 { a.perp_dot(b).abs() / length } else { 0.0 };
    (length * direction, width)
}

/// The two texels beside a coordinate along one axis, and the share of the second.
fn neighbours((place, side, wrap): (f64, usize, Wrap)) -> (usize, usize, f64) {
    // Before the multiplication, so that far repetitions lose no more than they must.
    let place = match wrap {
        Wrap::Repeat => place - place.floor(),
        Wrap::Mirror => place - 2.0 * (0.5 * place).floor(),
        Wrap::Clamp => place.clamp(-1.0, 2.0),
    };
    let at = place * side as f64 - 0.5;
    // NaN becomes 0.
    let (first, part) = (at.floor() as i64, if at.is_finite() { at - at.floor() } else { 0.0 });
    let side = side as i64;
    let inside = |at: i64| {
        let row = match wrap {
            Wrap::Repeat => at.rem_euclid(side),
            Wrap::Clamp => at.clamp(0, side - 1),
            Wrap::Mirror => {
                let row = at.rem_euclid(2 * side);
                row.min(2 * side - 1 - row)
            }
        };
        row as usize
    };
    (inside(first), inside(first + 1), part)
}

/// A level of half the size: each texel is the mean of the area that it covers.
fn halved(size: [usize; 2], half: [usize; 2], texel: impl Fn(usize) -> [f32; 4]) -> Box<[[f32; 4]]> {
    let [columns, rows] =
        [0, 1].map(|axis| (0..half[axis]).map(|at| covered(at, half[axis], size[axis])).collect::<Vec<_>>());
    let mut texels = Vec::with_capacity(half[0] * half[1]);
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
    texels.into()
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
