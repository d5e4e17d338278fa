//! The weights of an elliptical footprint on the sphere.

use core::f64::consts::PI;

use fearless_simd::prelude::*;
use fearless_simd::{Level, Simd, dispatch, f32x16};
use glam::DVec3;

use crate::observer::SkyRay;

/// Footprints with a larger semi-axis, in radians, are divided: beyond it the map from the picture
/// to the sky is not linear enough.
pub(crate) const LARGEST: f64 = 0.1;

/// Longest ellipse, as ratio of its axes; longer ones are widened.
pub(crate) const MOST_ECCENTRIC: f64 = 16.0;

/// Radius of the kernel on a texel grid without footprint, in texels.
pub(crate) const RADIUS: f64 = 2.0;

/// Above this product of radius and tangent of the latitude, circles of latitude are too curved for
/// the simple range of columns.
pub(crate) const CURVED: f64 = 0.1;

/// Part of a radius by which ranges are widened for what they neglect.
pub(crate) const SLACK: f64 = 0.05;

/// An elliptical kernel w(q) = (1 − q)² (1 − c q) for q < 1, q = (a·d)² + (b·d)², over directions d
/// near a centre.
///
/// Its second moments are those of the pixel on the sphere. For a pixel much smaller than a texel,
/// c = 5/2 and the second moments vanish, so that it interpolates; for large ones it is positive
/// nearly everywhere.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Kernel {
    pub a: DVec3,
    pub b: DVec3,
    pub c: f32,
    /// Entries of the matrix whose inverse is q: east, mixed, north.
    pub matrix: [f64; 3],
    /// The larger semi-axis, radians.
    pub radius: f64,
}

impl Kernel {
    /// The integral of its weights over the sphere, in steradians.
    pub fn integral(&self) -> f64 {
        let [see, sen, snn] = self.matrix;
        // Over q from 0 to 1, (1 − q)² has the integral 1/3, and times q that of 1/12.
        PI * (see * snn - sen * sen).max(0.0).sqrt() * (1.0 / 3.0 - f64::from(self.c) / 12.0)
    }
}

/// The ellipse of a pixel in a plane.
#[derive(Clone, Copy)]
pub(crate) struct PlaneEllipse {
    /// Its matrix: sums of squares and products of the slopes.
    pub matrix: [f64; 3],
    /// Squares of its semi-axes, the smaller first.
    pub squares: [f64; 2],
}

impl PlaneEllipse {
    /// `east`, `north`: coordinates of the changes per column and per row of the picture. `spread`:
    /// variance of the pixel filter along each axis, relative to that of a box.
    #[inline(always)]
    pub fn new(east: [f64; 2], north: [f64; 2], spread: f64) -> Self {
        let mut matrix = [
            spread * (east[0] * east[0] + east[1] * east[1]),
            spread * (east[0] * north[0] + east[1] * north[1]),
            spread * (north[0] * north[0] + north[1] * north[1]),
        ];
        let middle = 0.5 * (matrix[0] + matrix[2]);
        let half = 0.5 * (matrix[0] - matrix[2]);
        let apart = (half * half + matrix[1] * matrix[1]).sqrt();
        let large = middle + apart;
        let mut small = (middle - apart).max(0.0);
        let least = large / (MOST_ECCENTRIC * MOST_ECCENTRIC);
        if small < least {
            // Widened alike in all directions.
            matrix[0] += least - small;
            matrix[2] += least - small;
            small = least;
        }
        Self { matrix, squares: [small, large] }
    }

    /// The ellipse of a box around a ray, in the plane perpendicular to it, whichever its axes.
    pub fn of_ray(ray: &SkyRay) -> Self {
        let axis = ray.direction.any_orthonormal_vector();
        let other = ray.direction.cross(axis);
        let along = |axis: DVec3| ray.slopes.map(|slope| slope.dot(axis));
        Self::new(along(axis), along(other), 1.0)
    }

    /// The matrix of the kernel on a level with texels of this size, and its c; `finest`: the
    /// texels of level 0.
    #[inline(always)]
    pub fn kernel(&self, texel: f64, finest: f64) -> ([f64; 3], f64) {
        let margin = RADIUS * RADIUS * texel * texel;
        let [see, sen, snn] = [self.matrix[0] + margin, self.matrix[1], self.matrix[2] + margin];
        let variance = (self.matrix[0] + self.matrix[2]) / 12.0;
        // Texels of a level are means already.
        let averaged = (texel * texel - finest * finest) / 6.0;
        let moment = (variance - averaged).max(0.0) / (see + snn);
        ([see, sen, snn], (2.5 - 20.0 * moment) / (1.0 - 5.0 * moment))
    }
}

/// The ellipse of a pixel on the sphere.
pub(crate) struct Ellipse {
    /// Unit vectors to the east and to the north.
    axes: [DVec3; 2],
    /// The ellipse in the plane of these.
    plane: PlaneEllipse,
}

impl Ellipse {
    /// `spread`: variance of the pixel filter along each axis, relative to that of a box.
    #[inline(always)]
    pub fn new(ray: &SkyRay, spread: f64) -> Self {
        let DVec3 { x, y, z } = ray.direction;
        let level = (x * x + y * y).sqrt();
        let [sin, cos] = if level > 0.0 { [x / level, y / level] } else { [0.0, 1.0] };
        let axes = [DVec3::new(cos, -sin, 0.0), DVec3::new(-z * sin, -z * cos, level)];
        let east = ray.slopes.map(|slope| slope.x * cos - slope.y * sin);
        let north = ray.slopes.map(|slope| slope.dot(axes[1]));
        Self { axes, plane: PlaneEllipse::new(east, north, spread) }
    }

    /// True if it is small enough to be sampled at once.
    #[inline]
    pub fn is_small(&self) -> bool {
        self.plane.squares[1] <= LARGEST * LARGEST
    }

    /// The square of its smaller semi-axis.
    #[inline]
    pub fn small_square(&self) -> f64 {
        self.plane.squares[0]
    }

    /// The kernel on a level with texels of this size; `finest`: of level 0.
    #[inline(always)]
    pub fn kernel(&self, texel: f64, finest: f64) -> Kernel {
        let (matrix @ [see, sen, snn], c) = self.plane.kernel(texel, finest);
        let [east, north] = self.axes;
        let ratio = sen / snn;
        let a = (east - ratio * north) / (see - sen * ratio).sqrt();
        let b = north / snn.sqrt();
        let radius = (self.plane.squares[1] + RADIUS * RADIUS * texel * texel).sqrt();
        Kernel { a, b, c: c as f32, matrix, radius }
    }
}

/// The factors of s and t in the positive part of weights with which their first moments vanish,
/// so that the light of a linear function is exact. Passed are sums of weight times s and t, and of
/// the positive part times s², s t and t².
#[inline(always)]
pub(crate) fn correction<S: Simd>(simd: S, [s, t, ss, st, tt]: [f32x16<S>; 5]) -> [f32x16<S>; 2] {
    let determinant = ss * tt - st * st;
    // With texels along a line only, one of the two has no effect.
    let is_regular = determinant.simd_gt(f32x16::splat(simd, 1e-3) * ss * tt);
    let zero = f32x16::splat(simd, 0.0);
    [
        is_regular.select((st * t - tt * s) / determinant, zero),
        is_regular.select((st * s - ss * t) / determinant, zero),
    ]
}

/// The same for one footprint.
#[inline]
pub(crate) fn correction_of(simd: Level, sums: [f32; 5]) -> [f32; 2] {
    dispatch!(simd, simd => correction(simd, sums.map(|sum| f32x16::splat(simd, sum))).map(|factors| factors[0]))
}

/// atan2 within 2·10⁻⁶, which is enough to find the texels around a direction.
#[inline(always)]
pub(crate) fn near_atan2(y: f64, x: f64) -> f64 {
    use core::f64::consts::{FRAC_PI_2, PI};
    let (above, across) = (y.abs(), x.abs());
    let (small, large) = if above < across { (above, across) } else { (across, above) };
    let t = if large > 0.0 { small / large } else { 0.0 };
    let s = t * t;
    let angle = t
        * (0.999_977_26
            + s * (-0.332_623_47
                + s * (0.193_543_46 + s * (-0.116_432_87 + s * (0.052_653_32 - s * 0.011_721_2)))));
    let angle = if above < across { angle } else { FRAC_PI_2 - angle };
    let angle = if x < 0.0 { PI - angle } else { angle };
    if y < 0.0 { -angle } else { angle }
}
