//! Linear functions of rays, evaluated along the rows of the picture.
//!
//! A boost is linear in events (P7). A linear function of the ray p' in a rest frame, such as p'·v,
//! is therefore linear in p and |p|. The length |p| is the same for all rest frames, so one square
//! root per sample serves all faces of a picture.

use std::ops::Range;

use glam::DVec3;

/// The rays through the samples of the picture, at depth 1.
#[derive(Clone, Copy, Debug)]
pub struct Film {
    rays: [DVec3; 3],
}

/// A row of the film. Its samples lie on a straight line; the foot of the eye is the point of that
/// line nearest to the eye.
#[derive(Clone, Copy, Debug)]
pub struct FilmRow {
    /// From the foot of the eye to column 0, along the row.
    start: f64,
    /// Distance between columns.
    step: f64,
    /// From the eye to its foot.
    aside: f64,
}

/// The length of the ray through each sample of a part of the picture.
#[derive(Default)]
pub struct Lengths {
    columns: Range<u32>,
    rows: Range<u32>,
    films: Vec<FilmRow>,
    lengths: Vec<f64>,
}

/// A linear function of rays in a rest frame.
#[derive(Clone, Copy, Debug)]
pub struct Form {
    pub origin: f64,
    pub per_column: f64,
    pub per_row: f64,
    pub per_length: f64,
}

/// A [`Form`] restricted to a row.
#[derive(Clone, Copy, Debug)]
pub struct RowForm {
    pub start: f64,
    pub per_column: f64,
    pub per_length: f64,
}

/// Coordinate of the middle of a column or row of samples.
#[inline]
pub fn center(column: u32) -> f64 {
    // Columns are below 2^28, and signed integers convert faster.
    f64::from(column as i32) + 0.5
}

impl Film {
    /// `rays`: as [`ugscene::View::rays`] returns them.
    pub fn new(rays: [DVec3; 3]) -> Self {
        Self { rays }
    }

    /// The row through the middles of the samples of `row`.
    pub fn row(&self, row: u32) -> FilmRow {
        let [corner, across, down] = self.rays;
        let origin = corner + center(row) * down;
        let step = across.length();
        let along = across / step;
        FilmRow { start: origin.dot(along), step, aside: origin.cross(along).length() }
    }
}

impl FilmRow {
    #[inline]
    fn length(&self, column: u32) -> f64 {
        let along = self.start + center(column) * self.step;
        (self.aside * self.aside + along * along).sqrt()
    }
}

impl Lengths {
    /// Recomputes the lengths for these columns and rows, reusing the buffers.
    pub fn reset(&mut self, film: &Film, columns: Range<u32>, rows: Range<u32>) {
        (self.columns, self.rows) = (columns, rows);
        self.films.clear();
        self.films.extend(self.rows.clone().map(|row| film.row(row)));
        self.lengths.clear();
        for row in &self.films {
            self.lengths.extend(self.columns.clone().map(|column| row.length(column)));
        }
    }

    /// The lengths along a row.
    pub fn row(&self, row: u32) -> LengthRow<'_> {
        let (at, width) = ((row - self.rows.start) as usize, self.columns.len());
        let lengths = &self.lengths[at * width..(at + 1) * width];
        LengthRow { film: &self.films[at], first: self.columns.start, lengths }
    }
}

/// A row of [`Lengths`].
#[derive(Clone, Copy, Debug)]
pub struct LengthRow<'a> {
    film: &'a FilmRow,
    first: u32,
    lengths: &'a [f64],
}

impl<'a> LengthRow<'a> {
    /// The length at a column.
    #[inline]
    pub fn at(&self, column: u32) -> f64 {
        self.lengths[(column - self.first) as usize]
    }

    /// The lengths at a range of columns.
    #[inline]
    pub fn part(&self, columns: &Range<u32>) -> &'a [f64] {
        &self.lengths[(columns.start - self.first) as usize..(columns.end - self.first) as usize]
    }

    /// The column left of the extremum of a form between two columns; `None` if it is monotonic
    /// there.
    pub fn turn(&self, form: &RowForm, [first, last]: [u32; 2]) -> Option<u32> {
        let FilmRow { start, step, aside } = *self.film;
        // α t + c √(w² + t²) has the slope 0 at t/√(w² + t²) = −α/c.
        let sine = -form.per_column / (step * form.per_length);
        if sine.abs() >= 1.0 {
            return None;
        }
        let along = sine * aside / (1.0 - sine * sine).sqrt();
        let column = (along - start) / step - 0.5;
        (column > f64::from(first) && column < f64::from(last)).then_some(column as u32)
    }
}

impl Form {
    /// The form restricted to a row.
    #[inline]
    pub fn on_row(&self, row: u32) -> RowForm {
        RowForm {
            start: self.origin + center(row) * self.per_row,
            per_column: self.per_column,
            per_length: self.per_length,
        }
    }
}

impl RowForm {
    /// The value at a column whose ray has length `length`.
    #[inline]
    pub fn at(&self, column: u32, length: f64) -> f64 {
        self.start + center(column) * self.per_column + self.per_length * length
    }
}
