//! Numbers at three corners as planes over the picture.

use super::rows::TriangleRow;
use super::triangles::Point;

/// What turns numbers at three corners into planes over the picture, measured from the highest corner.
#[derive(Clone, Copy)]
pub struct Slopes {
    /// The two other corners from the highest.
    sides: [[f64; 2]; 2],
    per_area: f64,
}

impl Slopes {
    /// Of a triangle's corners, the highest first.
    #[inline(always)]
    pub fn new([top, middle, bottom]: [&Point; 3]) -> Self {
        let [p, q] = [[middle.x - top.x, middle.y - top.y], [bottom.x - top.x, bottom.y - top.y]];
        Self { sides: [p, q], per_area: 1.0 / (p[0] * q[1] - q[0] * p[1]) }
    }

    /// Change a column and a row of what is `top`, `middle` and `bottom` at the corners.
    #[inline(always)]
    pub fn of(&self, [top, middle, bottom]: [f64; 3]) -> [f64; 2] {
        let ([p, q], [u, v]) = (self.sides, [middle - top, bottom - top]);
        [(u * q[1] - v * p[1]) * self.per_area, (v * p[0] - u * q[0]) * self.per_area]
    }
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

impl<const N: usize, F: Fn(&mut [Plane; N])> Planes<N, F> {
    /// `find` sets them all.
    #[inline(always)]
    pub fn new(find: F) -> Self {
        Self { find, is_found: false, all: [Plane::default(); N] }
    }

    /// The planes, which are found now if they have not been before.
    #[inline(always)]
    pub fn get(&mut self) -> &[Plane; N] {
        if !self.is_found {
            (self.find)(&mut self.all);
            self.is_found = true;
        }
        &self.all
    }
}
