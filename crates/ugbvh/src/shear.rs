//! The definition of a hit: a triangle in a projection along the ray, in double precision.

use crate::frame::{Frame, exponent, power_of_two};

/// Greatest distance of an origin from the centre, in sizes of the mesh.
const MAX_DISTANCE: f64 = power_of_two(300);

/// A ray, ready for tests of triangles.
///
/// Coordinates are relative to the origin and scaled to the size of the mesh. Subtracting multiples
/// of z, the axis in which the direction is greatest, makes the ray the z axis.
#[derive(Clone, Copy, Debug)]
pub struct Shear {
    /// The axes of the mesh that become x, y and z.
    pub axes: [usize; 3],
    /// The origin as a position of the mesh.
    pub origin: [f64; 3],
    /// The origin in box coordinates, but in the order of `axes`.
    pub start: [f64; 3],
    /// The greatest |coordinate| of `start`.
    pub distance: f64,
    pub scale: f64,
    pub unit: f64,
    /// The direction is (slopes, 1) × `speed`; both slopes are in −1…1.
    pub slopes: [f64; 2],
    /// z component of the direction.
    pub speed: f64,
}

/// A triangle's hit: parameter of the ray and barycentric weights.
#[derive(Clone, Copy, Debug)]
pub struct Crossing {
    pub t: f64,
    /// Distance in z, scaled.
    pub z: f64,
    pub u: f64,
    pub v: f64,
}

/// The result of [`Shear::intersect_simply`].
pub enum Simple {
    Miss,
    Crossing(Crossing),
    /// Rounding errors may be too great.
    Unsafe,
}

/// A projected corner.
type Corner = [f64; 3];

impl Shear {
    /// Returns `None` for rays that hit nothing: see the range of numbers of this crate.
    #[inline(always)]
    pub fn new(frame: &Frame, origin: [f64; 3], direction: [f64; 3]) -> Option<Self> {
        let [x, y, z] = direction.map(f64::abs);
        let axes = match (x > y, x > z, y > z) {
            (true, true, _) => [1, 2, 0],
            (false, _, true) => [2, 0, 1],
            _ => [0, 1, 2],
        };
        let [x, y, z] = permuted(direction, axes);
        let start = permuted(frame.to_box(origin), axes);
        let distance = greater(greater(start[0].abs(), start[1].abs()), start[2].abs());
        // NaN fails every comparison.
        let is_valid = (start[0].abs() <= MAX_DISTANCE)
            & (start[1].abs() <= MAX_DISTANCE)
            & (start[2].abs() <= MAX_DISTANCE)
            & (x.abs() <= z.abs())
            & (y.abs() <= z.abs())
            & (z.abs() > 0.0)
            & (z.abs() <= f64::MAX);
        let Frame { scale, unit, .. } = *frame;
        let slopes = [x / z, y / z];
        is_valid.then_some(Self { axes, origin, start, distance, scale, unit, slopes, speed: z })
    }

    /// A ray in another direction with the same origin, main axis and sign along it.
    #[inline(always)]
    pub fn with_direction(&self, direction: [f64; 3]) -> Option<Self> {
        let [x, y, z] = permuted(direction, self.axes);
        // Strictly less in x and y, as the choice among equal axes depends on their order.
        let is_same = (x.abs() < z.abs())
            & (y.abs() < z.abs())
            & (z.abs() < f64::INFINITY)
            & ((z > 0.0) == (self.speed > 0.0));
        is_same.then_some(Self { slopes: [x / z, y / z], speed: z, ..*self })
    }

    /// z at a parameter of the ray. It overflows to an infinity or NaN before numbers of any mesh
    /// do.
    #[inline(always)]
    pub fn z(&self, t: f64) -> f64 {
        t * self.speed * self.scale
    }

    /// Projects a corner. The result does not depend on the triangle.
    #[inline(always)]
    fn project(&self, corner: &[f64; 3]) -> Corner {
        let corner = permuted(*corner, self.axes);
        let origin = permuted(self.origin, self.axes);
        let x = (corner[0] - origin[0]) * self.scale;
        let y = (corner[1] - origin[1]) * self.scale;
        let z = (corner[2] - origin[2]) * self.scale;
        [x - self.slopes[0] * z, y - self.slopes[1] * z, z]
    }

    /// The intersection of the ray, as a line without ends, with a triangle.
    ///
    /// The computed position is within 2⁻³⁰ + 2⁻⁵⁰ (d + 2) of one that is on the ray and in the
    /// triangle, in sizes of the mesh, where d is the origin's distance from the centre in any
    /// axis: a projected corner is within 5 × 2⁻⁵³ (d + 2) of its exact place, and the weights are
    /// those of the projected corners with an error of less than 2⁻³⁴.
    #[inline(always)]
    pub fn intersect(&self, corners: [&[f64; 3]; 3]) -> Option<Crossing> {
        match self.intersect_simply(corners) {
            Simple::Miss => None,
            Simple::Crossing(crossing) => Some(crossing),
            Simple::Unsafe => self.intersect_exactly(corners),
        }
    }

    /// Like [`Shear::intersect`], if rounding errors allow it.
    #[inline(always)]
    pub fn intersect_simply(&self, corners: [&[f64; 3]; 3]) -> Simple {
        let [a, b, c] = corners.map(|corner| self.project(corner));
        let weights = [cross(b, c), cross(c, a), cross(a, b)];
        let [p, q, r] = weights;
        let [is_low, is_high] =
            [(p < 0.0) | (q < 0.0) | (r < 0.0), (p > 0.0) | (q > 0.0) | (r > 0.0)];
        // Rounding is monotonic: a computed product is less than another only if it is in truth.
        // So a sign is right unless it is 0.
        if is_low & is_high {
            return Simple::Miss;
        }
        let sum = p + q + r;
        let size = extent([a, b, c]);
        // A product has an error of 2⁻⁵³ size² or less, so a weight one of 2⁻⁵¹ size². With a NaN
        // coordinate the sum is NaN and the comparison false.
        let has_zero = (p == 0.0) | (q == 0.0) | (r == 0.0);
        let is_safe = !has_zero && sum.abs() >= MIN_AREA * (size * size);
        if is_safe { Simple::Crossing(self.crossing(weights, [a, b, c])) } else { Simple::Unsafe }
    }

    #[inline(always)]
    fn crossing(&self, weights: [f64; 3], corners: [Corner; 3]) -> Crossing {
        let sum = weights[0] + weights[1] + weights[2];
        let [a, b, c] = corners;
        let z = (weights[0] * a[2] + weights[1] * b[2] + weights[2] * c[2]) / sum;
        // The scale is applied before the division, where it cannot overflow.
        Crossing { t: z * self.unit / self.speed, z, u: weights[1] / sum, v: weights[2] / sum }
    }

    /// Slivers, triangles seen edge-on, and rays through edges and corners: the signs of weights
    /// are exact, and their errors relative to them are less than 2⁻⁵⁰.
    #[cold]
    #[inline(never)]
    pub fn intersect_exactly(&self, corners: [&[f64; 3]; 3]) -> Option<Crossing> {
        let mut corners = corners.map(|corner| self.project(corner));
        let size = extent(corners);
        let is_finite = corners.iter().all(|[x, y, _]| x.is_finite() && y.is_finite());
        if !is_finite || size == 0.0 {
            return None;
        }
        if !(1e-60..1e60).contains(&size) {
            // Multiplication by a power of two changes no ratio. z remains as it is.
            let scale = power_of_two(-exponent(size).clamp(-1000, 1000));
            for corner in &mut corners {
                corner[0] *= scale;
                corner[1] *= scale;
            }
        }
        let [a, b, c] = corners;
        let sides = [side(b, c)?, side(c, a)?, side(a, b)?];
        let is_inside = sides.iter().all(|side| side.is_left == sides[0].is_left);
        let weights = sides.map(|side| side.weight);
        let sum = weights[0] + weights[1] + weights[2];
        (is_inside && sum != 0.0).then(|| self.crossing(weights, corners))
    }
}

/// Least |sum of weights| / size² for which their rounding errors are small enough.
const MIN_AREA: f64 = power_of_two(-16);

/// Coordinates in the order of the projection, which is an even permutation.
#[inline(always)]
pub fn permuted([x, y, z]: [f64; 3], axes: [usize; 3]) -> [f64; 3] {
    match axes[2] {
        0 => [y, z, x],
        1 => [z, x, y],
        _ => [x, y, z],
    }
}

/// The greatest |x| or |y| of projected corners, unless one is NaN.
#[inline(always)]
fn extent(corners: [Corner; 3]) -> f64 {
    let [a, b, c] = corners;
    let x = greater(greater(a[0].abs(), b[0].abs()), c[0].abs());
    let y = greater(greater(a[1].abs(), b[1].abs()), c[1].abs());
    greater(x, y)
}

/// The greater of two numbers, unless one is NaN.
#[inline(always)]
fn greater(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// Twice the area of the triangle between the ray and an edge. The opposite edge has exactly the
/// opposite number.
#[inline(always)]
fn cross(from: Corner, to: Corner) -> f64 {
    from[0] * to[1] - from[1] * to[0]
}

/// On which side of an edge the ray runs.
struct Side {
    /// Twice the area between the ray and the edge.
    weight: f64,
    is_left: bool,
}

/// Like [`cross`], exact but for the last rounding. Returns `None` for an edge without length.
///
/// If the exact weight is 0, the ray is moved by (ε, ε²), where ε is positive and less than any
/// number. The weight becomes ε (from.y − to.y) + ε² (to.x − from.x), of which the first term that
/// is not 0 decides.
fn side(from: Corner, to: Corner) -> Option<Side> {
    let (p, p_error) = product(from[0], to[1]);
    let (q, q_error) = product(from[1], to[0]);
    // Exact if the products are close to each other. If they are not, it is far greater than their
    // errors.
    let difference = p - q;
    let (error, rest) = sum(p_error, -q_error);
    // `rest` is less than the last digit of `error`, so it matters only if the others cancel.
    let weight = match difference + error {
        0.0 => rest,
        weight => weight,
    };
    let decides =
        [weight, from[1] - to[1], to[0] - from[0]].into_iter().find(|&number| number != 0.0)?;
    Some(Side { weight, is_left: decides > 0.0 })
}

/// a + b, rounded, and its rounding error (Knuth).
fn sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let from_b = sum - a;
    let from_a = sum - from_b;
    (sum, (a - from_a) + (b - from_b))
}

/// a × b, rounded, and its rounding error (Dekker). The error is exact if it is not less than the
/// least normal number.
fn product(a: f64, b: f64) -> (f64, f64) {
    let product = a * b;
    let ([a_high, a_low], [b_high, b_low]) = (halves(a), halves(b));
    let error = ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low;
    (product, error)
}

/// Two numbers of 26 bits or less with this sum (Veltkamp).
fn halves(number: f64) -> [f64; 2] {
    let scaled = number * 134_217_729.0;
    let high = scaled - (scaled - number);
    [high, number - high]
}
