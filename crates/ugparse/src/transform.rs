//! Transformations of instances: an affine map, and whether it reverses the orientation of faces.

use glam::{DAffine3, DMat3, DVec3};

/// The composition of `-sx … -M4`.
///
/// In the text, matrices are for row vectors, and options apply from left to right; here the map is
/// stored for column vectors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Transform {
    map: DAffine3,
    /// The number of mirrorings is odd: vertex order of faces is reversed.
    pub mirrored: bool,
}

impl Transform {
    pub const IDENTITY: Self = Self { map: DAffine3::IDENTITY, mirrored: false };

    fn linear(matrix: DMat3) -> Self {
        Self { map: DAffine3::from_mat3(matrix), mirrored: false }
    }

    /// `-sx -sy -sz -sa` as factors along the axes.
    pub fn scale(factors: DVec3) -> Self {
        Self::linear(DMat3::from_diagonal(factors))
    }

    /// `-sv`: by `factor` along a vector. `None` for the zero vector.
    pub fn scale_along(vector: DVec3, factor: f64) -> Option<Self> {
        let unit = unit(vector)?;
        Some(Self::linear(DMat3::IDENTITY + outer(unit) * (factor - 1.0)))
    }

    /// `-tx -ty -tz -ta`.
    pub fn translate(offset: DVec3) -> Self {
        Self { map: DAffine3::from_translation(offset), mirrored: false }
    }

    /// `-tv`: by `amount` along a vector. `None` for the zero vector.
    pub fn translate_along(vector: DVec3, amount: f64) -> Option<Self> {
        Some(Self::translate(unit(vector)? * amount))
    }

    /// `-rx -ry -rz -rv`: counterclockwise seen from the tip of the axis.
    /// `None` for the zero vector.
    pub fn rotate(axis: DVec3, degrees: f64) -> Option<Self> {
        let k = unit(axis)?;
        let (sin, cos) = sin_cos_degrees(degrees);
        let cross = DMat3::from_cols(
            DVec3::new(0.0, k.z, -k.y),
            DVec3::new(-k.z, 0.0, k.x),
            DVec3::new(k.y, -k.x, 0.0),
        );
        // Rodrigues' formula.
        Some(Self::linear(DMat3::IDENTITY * cos + cross * sin + outer(k) * (1.0 - cos)))
    }

    /// `-mx -my -mz -ma` as signs along the axes.
    pub fn mirror(signs: DVec3) -> Self {
        Self { mirrored: signs.x * signs.y * signs.z < 0.0, ..Self::scale(signs) }
    }

    /// `-mv`: in the plane through the origin perpendicular to a vector.
    /// `None` for the zero vector.
    pub fn mirror_across(vector: DVec3) -> Option<Self> {
        Some(Self { mirrored: true, ..Self::scale_along(vector, -1.0)? })
    }

    /// `-M3`: nine numbers, row by row, for row vectors.
    pub fn rows3(m: &[f64; 9]) -> Self {
        // Rows for row vectors are columns for column vectors.
        Self::linear(DMat3::from_cols_array(m))
    }

    /// `-M4`: sixteen numbers, row by row, for row vectors: the translation is
    /// in the last row. `None` unless the last column is 0 0 0 1.
    pub fn rows4(m: &[f64; 16]) -> Option<Self> {
        if [m[3], m[7], m[11], m[15]] != [0.0, 0.0, 0.0, 1.0] {
            return None;
        }
        let linear = [m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]];
        let map = DAffine3 {
            matrix3: DMat3::from_cols_array(&linear),
            translation: DVec3::new(m[12], m[13], m[14]),
        };
        Some(Self { map, mirrored: false })
    }

    /// First `self`, then `next`.
    pub fn then(&self, next: &Self) -> Self {
        Self { map: next.map * self.map, mirrored: self.mirrored != next.mirrored }
    }

    pub fn point(&self, p: DVec3) -> DVec3 {
        // The identity keeps all bits; adding 0 would lose the sign of -0.
        if self.map == DAffine3::IDENTITY { p } else { self.map.transform_point3(p) }
    }

    pub fn direction(&self, d: DVec3) -> DVec3 {
        if self.map.matrix3 == DMat3::IDENTITY { d } else { self.map.transform_vector3(d) }
    }

    /// A vector turned as the map turns it, with its own length: velocities are not scaled. `None` if
    /// the map collapses it.
    pub fn turned(&self, d: DVec3) -> Option<DVec3> {
        if self.map.matrix3 == DMat3::IDENTITY || d == DVec3::ZERO {
            return Some(d);
        }
        let is_turn =
            (self.map.matrix3.transpose() * self.map.matrix3).abs_diff_eq(DMat3::IDENTITY, 1e-12);
        let image = self.map.transform_vector3(d);
        if is_turn { Some(image) } else { Some(unit(image)? * d.length()) }
    }

    /// A length that has no direction, above 0: it is scaled as the cube root of volumes, and stays
    /// above 0 in a map that collapses volumes.
    pub fn mean_length(&self, length: f64) -> f64 {
        let m = self.map.matrix3;
        let largest = m.to_cols_array().into_iter().map(f64::abs).fold(0.0, f64::max);
        if m == DMat3::IDENTITY {
            return length;
        }
        // Divided first: the determinant of a large map may be too large.
        let volume = (m * (1.0 / largest.max(f64::MIN_POSITIVE))).determinant().abs();
        (length * (largest * libm::cbrt(volume))).max(f64::MIN_POSITIVE)
    }

    /// Transforms a normal by the inverse transpose. For a singular map the result is along the
    /// collapsed direction.
    pub fn normal(&self, n: DVec3) -> DVec3 {
        let m = self.map.matrix3;
        let largest = [m.x_axis, m.y_axis, m.z_axis].map(|axis| axis.abs().max_element());
        let largest = largest.into_iter().fold(0.0, f64::max);
        // A translation keeps normals to the bit.
        if m == DMat3::IDENTITY || largest == 0.0 {
            return n;
        }
        // Scaled to entries up to 1, so that products neither overflow nor underflow.
        let [a, b, c] = [m.x_axis, m.y_axis, m.z_axis].map(|axis| axis / largest);
        // The cofactor matrix is the determinant times the inverse transpose, and always exists.
        let image = DMat3::from_cols(b.cross(c), c.cross(a), a.cross(b)) * n;
        let sign = if a.dot(b.cross(c)) < 0.0 { -1.0 } else { 1.0 };
        // A normal whose length overflows, or nearly underflows, gets unit length.
        let length =
            Some(n.length()).filter(|length| NORMAL_LENGTHS.contains(length)).unwrap_or(1.0);
        unit(image).map_or(n, |image| image * (sign * length))
    }

    /// True if every entry is finite.
    pub fn is_finite(&self) -> bool {
        self.map.is_finite()
    }
}

/// Lengths of normals whose components, after a turn, are certainly numbers other than 0.
const NORMAL_LENGTHS: std::ops::Range<f64> = 1e-150..1e150;

/// The unit vector, also if the squared length would overflow or underflow. `None` for the zero
/// vector.
fn unit(vector: DVec3) -> Option<DVec3> {
    let largest = vector.abs().max_element();
    (largest > 0.0).then(|| (vector / largest).normalize())
}

fn outer(k: DVec3) -> DMat3 {
    DMat3::from_cols(k * k.x, k * k.y, k * k.z)
}

/// Sine and cosine of an angle in degrees, exact at multiples of 90.
fn sin_cos_degrees(degrees: f64) -> (f64, f64) {
    let quarters = degrees / 90.0;
    if quarters == quarters.floor() {
        return match quarters.rem_euclid(4.0) as u8 {
            0 => (0.0, 1.0),
            1 => (1.0, 0.0),
            2 => (0.0, -1.0),
            _ => (-1.0, 0.0),
        };
    }
    libm::sincos((degrees % 360.0).to_radians())
}
