//! Numbers that are linear in rays, along the rows of the picture.
//!
//! A boost is linear in events (P7). So what is linear in a rest frame's ray p', such as p'·v, is
//! linear in p and in |p|, which is the same for all rest frames: of all faces of a picture
//! together one root a sample has to be taken.

use std::ops::Range;

use glam::DVec3;

/// The rays of the picture, through samples; depth 1.
#[derive(Clone, Copy, Debug)]
pub struct Film {
    rays: [DVec3; 3],
}

/// A row of it. The samples lie on a straight line, and the eye beside it.
#[derive(Clone, Copy, Debug)]
pub struct FilmRow {
    /// From the foot of the eye on the line to column 0.
    start: f64,
    /// From column to column.
    step: f64,
    /// From the eye to its foot.
    aside: f64,
}

/// For every sample of a part of the picture the length of its ray.
#[derive(Default)]
pub struct Lengths {
    columns: Range<u32>,
    rows: Range<u32>,
    films: Vec<FilmRow>,
    lengths: Vec<f64>,
}

/// What is linear in rays at rest.
#[derive(Clone, Copy, Debug)]
pub struct Form {
    pub origin: f64,
    pub per_column: f64,
    pub per_row: f64,
    pub per_length: f64,
}

/// The same on a row.
#[derive(Clone, Copy, Debug)]
pub struct RowForm {
    pub start: f64,
    pub per_column: f64,
    pub per_length: f64,
}

/// Where the middle of a column's samples is.
#[inline]
pub fn center(column: u32) -> f64 {
    // Columns are below 2^28, and these numbers are faster to convert.
    f64::from(column as i32) + 0.5
}

impl Film {
    /// `rays`: as of [`ugscene::View::rays`].
    pub fn new(rays: [DVec3; 3]) -> Self {
        Self { rays }
    }

    /// The row through the middle of these samples.
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
    /// Makes it those of these samples, reusing its buffers.
    pub fn reset(&mut self, film: &Film, columns: Range<u32>, rows: Range<u32>) {
        (self.columns, self.rows) = (columns, rows);
        self.films.clear();
        self.films.extend(self.rows.clone().map(|row| film.row(row)));
        self.lengths.clear();
        for row in &self.films {
            self.lengths.extend(self.columns.clone().map(|column| row.length(column)));
        }
    }

    /// A row of them.
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
    /// At a column.
    #[inline]
    pub fn at(&self, column: u32) -> f64 {
        self.lengths[(column - self.first) as usize]
    }

    /// At some columns.
    #[inline]
    pub fn part(&self, columns: &Range<u32>) -> &'a [f64] {
        &self.lengths[(columns.start - self.first) as usize..(columns.end - self.first) as usize]
    }

    /// Where between two columns a form of this row does not grow nor fall, if anywhere: the
    /// nearest column to the left.
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
    /// On a row.
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
    /// At a column whose ray has a length.
    #[inline]
    pub fn at(&self, column: u32, length: f64) -> f64 {
        self.start + center(column) * self.per_column + self.per_length * length
    }
}
