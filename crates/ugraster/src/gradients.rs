//! Gradients over the picture of values given at three corners.

use std::ops::{Mul, Sub};

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f64x8};

use crate::block::{Corners, PerTriangle};

/// The map from values at three corners to their gradient over the picture, for one triangle (`T`
/// is f64) or for a block.
#[derive(Clone, Copy)]
pub struct Gradients<T> {
    /// From the highest to the middle and to the lowest corner.
    sides: [[T; 2]; 2],
    per_area: T,
}

impl<S: Simd> Gradients<f64x8<S>> {
    /// `corners`: sorted, the highest first.
    #[inline(always)]
    pub fn new(simd: S, [top, middle, bottom]: [&Corners<S>; 3]) -> Self {
        let [p, q] = [[middle.x - top.x, middle.y - top.y], [bottom.x - top.x, bottom.y - top.y]];
        let one = f64x8::splat(simd, 1.0);
        Self { sides: [p, q], per_area: one / (p[0] * q[1] - q[0] * p[1]) }
    }
}

impl<T: Copy + Mul<Output = T> + Sub<Output = T>> Gradients<T> {
    /// Change per column and per row of a value, given at the highest, middle and lowest corner.
    #[inline(always)]
    pub fn of(&self, [top, middle, bottom]: [T; 3]) -> [T; 2] {
        let ([p, q], [u, v]) = (self.sides, [middle - top, bottom - top]);
        [(u * q[1] - v * p[1]) * self.per_area, (v * p[0] - u * q[0]) * self.per_area]
    }
}

/// [`Gradients`] of a block in memory, from which those of one triangle can be read.
#[derive(Clone, Copy)]
pub struct StoredGradients {
    sides: [[PerTriangle; 2]; 2],
    per_area: PerTriangle,
}

impl StoredGradients {
    /// Stores gradients.
    #[inline(always)]
    pub fn new<S: Simd>(
        Gradients { sides: [[a, b], [c, d]], per_area }: &Gradients<f64x8<S>>,
    ) -> Self {
        let sides = [[(*a).into(), (*b).into()], [(*c).into(), (*d).into()]];
        Self { sides, per_area: (*per_area).into() }
    }

    /// Gradients of one triangle.
    #[inline(always)]
    pub fn only(&self, triangle: usize) -> Gradients<f64> {
        let [[a, b], [c, d]] = &self.sides;
        let sides = [[a[triangle], b[triangle]], [c[triangle], d[triangle]]];
        Gradients { sides, per_area: self.per_area[triangle] }
    }
}
