//! Shapes of faces: polygons, and round ones.

use glam::{DMat3, DVec3};

/// The shape of a face. Contours of a round face hold points that determine it, and that move with
/// its body as all vertices do.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum FaceShape {
    /// `f`: a flat polygon.
    #[default]
    Polygon,
    /// `sphere`: the contours are three ends of perpendicular radii, and the three opposite ends.
    Sphere,
    /// `cylinder`, with both ends: the contours are four points of each rim, a quarter apart.
    Cylinder,
    /// `tube`: the same without its ends.
    Tube,
    /// `disc`: the contour is four points of its rim, a quarter apart, counterclockwise seen from
    /// outside.
    Disc,
    /// `disc` with a hole: the contours are four points of each rim, a quarter apart, the outer rim
    /// first.
    Ring,
}

impl FaceShape {
    /// The keyword of its statement.
    pub fn keyword(self) -> &'static str {
        match self {
            Self::Polygon => "f",
            Self::Sphere => "sphere",
            Self::Cylinder => "cylinder",
            Self::Tube => "tube",
            Self::Disc | Self::Ring => "disc",
        }
    }

    /// False for polygons.
    #[inline]
    pub fn is_round(self) -> bool {
        self != Self::Polygon
    }

    /// The number of corners of each contour of a round face.
    pub fn corners_of_contours(self) -> &'static [usize] {
        match self {
            Self::Polygon => &[],
            Self::Sphere => &[3, 3],
            Self::Cylinder | Self::Tube | Self::Ring => &[4, 4],
            Self::Disc => &[4],
        }
    }
}

/// A round shape in place: the image of a unit shape under an affine map, such as an ellipsoid.
///
/// Unit shapes are the sphere |p| = 1, the cylinder x² + y² = 1 from z = 0 to z = 1, and the disc
/// x² + y² ≤ 1 at z = 0, whose outside has the greater z. Those of rings have a hole in the middle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoundShape {
    /// The kind of shape.
    pub shape: FaceShape,
    /// Where the origin is.
    pub origin: DVec3,
    /// Where the axes are, relative to the origin; they are independent of each other.
    pub axes: DMat3,
    /// Of a ring, its inner radius as a part of the outer one; of other shapes 0.
    pub inner: f64,
}

impl RoundShape {
    /// `None` if it has no volume, a disc or ring no area, or a number is not finite.
    pub fn new(shape: FaceShape, origin: DVec3, axes: DMat3, inner: f64) -> Option<Self> {
        /// Axes closer than this to one plane are dependent up to rounding.
        const LEAST: f64 = 1e-12;
        let units = [axes.x_axis, axes.y_axis, axes.z_axis].map(ugphysics::unit_or_zero);
        let volume = units[0].dot(units[1].cross(units[2])).abs();
        let has_hole = if shape == FaceShape::Ring { inner > 0.0 } else { inner == 0.0 };
        // NaN fails the comparisons.
        (origin.is_finite() && volume > LEAST && has_hole && inner < 1.0).then_some(Self {
            shape,
            origin,
            axes,
            inner,
        })
    }

    /// From the corners of a round face, contour after contour; `None` as in [`RoundShape::new`].
    pub fn from_corners(shape: FaceShape, corners: &[DVec3]) -> Option<Self> {
        let half = |a: usize, b: usize| Some(0.5 * *corners.get(a)? - 0.5 * *corners.get(b)?);
        let middle = |first: usize| Some(corners.get(first)?.midpoint(*corners.get(first + 2)?));
        let (origin, axes) = match shape {
            FaceShape::Polygon => return None,
            FaceShape::Sphere => (
                corners.first()?.midpoint(*corners.get(3)?),
                [half(0, 3)?, half(1, 4)?, half(2, 5)?],
            ),
            FaceShape::Cylinder | FaceShape::Tube => {
                (middle(0)?, [half(0, 2)?, half(1, 3)?, middle(4)? - middle(0)?])
            }
            FaceShape::Disc | FaceShape::Ring => {
                let (a, b) = (half(0, 2)?, half(1, 3)?);
                let normal = ugphysics::unit_or_zero(
                    ugphysics::unit_or_zero(a).cross(ugphysics::unit_or_zero(b)),
                );
                (middle(0)?, [a, b, ugphysics::length(a) * normal])
            }
        };
        let inner = match shape {
            FaceShape::Ring => ugphysics::length(half(4, 6)?) / ugphysics::length(axes[0]),
            _ => 0.0,
        };
        Self::new(shape, origin, DMat3::from_cols(axes[0], axes[1], axes[2]), inner)
    }

    /// The corners of its face, contour after contour.
    pub fn corners(&self) -> Vec<DVec3> {
        self.units().into_iter().map(|unit| self.place(unit)).collect()
    }

    /// Where the unit shape has these corners.
    pub(crate) fn units(&self) -> Vec<DVec3> {
        let (a, b) = ([1.0, 0.0, -1.0, 0.0], [0.0, 1.0, 0.0, -1.0]);
        let rim = |z: f64| (0..4).map(move |at| DVec3::new(a[at], b[at], z));
        let inner = self.inner;
        match self.shape {
            FaceShape::Polygon => Vec::new(),
            FaceShape::Sphere => {
                DVec3::AXES.into_iter().chain(DVec3::AXES.map(|axis| -axis)).collect()
            }
            FaceShape::Cylinder | FaceShape::Tube => rim(0.0).chain(rim(1.0)).collect(),
            FaceShape::Disc => rim(0.0).collect(),
            FaceShape::Ring => rim(0.0).chain(rim(0.0).map(|unit| inner * unit)).collect(),
        }
    }

    /// Where a point of the unit shape is.
    #[inline]
    pub fn place(&self, unit: DVec3) -> DVec3 {
        self.origin + self.axes * unit
    }

    /// The unit normal where the unit shape has this normal; it may have any length but 0.
    #[inline]
    pub fn normal(&self, unit: DVec3) -> DVec3 {
        let scale = self.stretch();
        let [a, b, c] =
            [self.axes.x_axis, self.axes.y_axis, self.axes.z_axis].map(|axis| axis / scale);
        let volume = a.dot(b.cross(c));
        let normal = b.cross(c) * unit.x + c.cross(a) * unit.y + a.cross(b) * unit.z;
        ugphysics::unit_or_zero(if volume < 0.0 { -normal } else { normal })
    }

    /// The least and greatest coordinates.
    pub fn bounds(&self) -> [DVec3; 2] {
        let [a, b, c] = [self.axes.x_axis, self.axes.y_axis, self.axes.z_axis];
        let across = DVec3::from_array([0, 1, 2].map(|at| libm::hypot(a[at], b[at])));
        let half = match self.shape {
            FaceShape::Sphere => {
                DVec3::from_array([0, 1, 2].map(|at| libm::hypot(across[at], c[at])))
            }
            _ => across,
        };
        match self.shape {
            FaceShape::Cylinder | FaceShape::Tube => {
                let head = self.origin + c;
                [self.origin.min(head) - half, self.origin.max(head) + half]
            }
            _ => [self.origin - half, self.origin + half],
        }
    }

    /// A bound of the factor by which the map lengthens: the greatest one for perpendicular axes.
    pub fn stretch(&self) -> f64 {
        let axes = [self.axes.x_axis, self.axes.y_axis, self.axes.z_axis];
        // Along the axis of a cylinder it is exact.
        let axes = if self.shape == FaceShape::Sphere { &axes[..] } else { &axes[..2] };
        let longest = axes.iter().map(|axis| ugphysics::length(*axis)).fold(0.0, f64::max);
        // Gershgorin's bound of the greatest eigenvalue of the products of the axes.
        let row =
            |a: &DVec3| axes.iter().map(|b| (*a / longest).dot(*b / longest).abs()).sum::<f64>();
        longest * axes.iter().map(row).fold(0.0, f64::max).sqrt()
    }
}
