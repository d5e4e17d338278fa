//! Numbers at three corners as planes over the picture.

use std::ops::{Mul, Sub};

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f64x8};

use crate::block::{Corners, Each};
use crate::rows::TriangleRow;

/// What turns numbers at three corners into planes over the picture, measured from the highest corner: of one triangle,
/// or of several at once.
#[derive(Clone, Copy)]
pub struct Slopes<T> {
    /// The two other corners from the highest.
    sides: [[T; 2]; 2],
    per_area: T,
}

impl<S: Simd> Slopes<f64x8<S>> {
    /// Of the corners of triangles, the highest first.
    #[inline(always)]
    pub fn new(simd: S, [top, middle, bottom]: [&Corners<S>; 3]) -> Self {
        let [p, q] = [[middle.x - top.x, middle.y - top.y], [bottom.x - top.x, bottom.y - top.y]];
        let one = f64x8::splat(simd, 1.0);
        Self { sides: [p, q], per_area: one / (p[0] * q[1] - q[0] * p[1]) }
    }
}

impl<T: Copy + Mul<Output = T> + Sub<Output = T>> Slopes<T> {
    /// Change a column and a row of what is `top`, `middle` and `bottom` at the corners.
    #[inline(always)]
    pub fn of(&self, [top, middle, bottom]: [T; 3]) -> [T; 2] {
        let ([p, q], [u, v]) = (self.sides, [middle - top, bottom - top]);
        [(u * q[1] - v * p[1]) * self.per_area, (v * p[0] - u * q[0]) * self.per_area]
    }
}

/// The slopes of the triangles of a block, to be looked up.
#[derive(Clone, Copy)]
pub struct KeptSlopes {
    sides: [[Each; 2]; 2],
    per_area: Each,
}

impl KeptSlopes {
    #[inline(always)]
    pub fn new<S: Simd>(Slopes { sides: [[a, b], [c, d]], per_area }: &Slopes<f64x8<S>>) -> Self {
        let sides = [[(*a).into(), (*b).into()], [(*c).into(), (*d).into()]];
        Self { sides, per_area: (*per_area).into() }
    }

    /// Those of one triangle.
    #[inline(always)]
    pub fn only(&self, triangle: usize) -> Slopes<f64> {
        let [[a, b], [c, d]] = &self.sides;
        let sides = [[a[triangle], b[triangle]], [c[triangle], d[triangle]]];
        Slopes { sides, per_area: self.per_area[triangle] }
    }
}

/// What knows how numbers change over the picture.
pub trait FindPlanes<const N: usize> {
    /// The planes of all numbers.
    fn find(&self) -> [Plane; N];
}

/// The planes of all numbers, found when they are asked for.
pub struct Planes<const N: usize, F> {
    find: F,
    is_found: bool,
    all: [Plane; N],
}

/// A number over the picture, multiplied by the key in perspective.
#[derive(Clone, Copy, Default)]
pub struct Plane {
    /// At the highest corner.
    pub at_top: f64,
    /// Its change a row.
    pub a_row: f64,
    /// Its change a column.
    pub a_column: f64,
}

impl Plane {
    /// The number at the column that the row is measured from.
    #[inline(always)]
    pub fn start(&self, line: &TriangleRow) -> f64 {
        self.at_top + line.down * self.a_row
    }
}

impl<const N: usize, F: FindPlanes<N>> Planes<N, F> {
    /// Those that `find` knows.
    #[inline(always)]
    pub fn new(find: F) -> Self {
        Self { find, is_found: false, all: [Plane::default(); N] }
    }

    /// The planes, which are found now if they have not been before.
    #[inline(always)]
    pub fn get(&mut self) -> &[Plane; N] {
        if !self.is_found {
            self.all = self.find.find();
            self.is_found = true;
        }
        &self.all
    }
}
