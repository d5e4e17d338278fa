//! The nearest face at each sample of a part of the picture.

use std::ops::Range;

use super::film::LengthRow;

/// Depth keys, and the faces they belong to.
#[derive(Default)]
pub struct Nearest {
    columns: Range<u32>,
    rows: Range<u32>,
    keys: Vec<f64>,
    /// Index of the face; undefined where nothing has been drawn.
    faces: Vec<u32>,
}

/// Farther than everything.
pub const EMPTY: f64 = f64::NEG_INFINITY;

/// A run of samples in a row that show the same face.
#[derive(Clone, Debug)]
pub struct Run {
    /// Its row.
    pub row: u32,
    /// Its columns.
    pub columns: Range<u32>,
    /// The row of the shape.
    pub face: u32,
}

impl Nearest {
    /// Clears these samples, reusing the buffers.
    pub fn reset(&mut self, columns: Range<u32>, rows: Range<u32>) {
        let len = columns.len() * rows.len();
        (self.columns, self.rows) = (columns, rows);
        self.keys.clear();
        self.keys.resize(len, EMPTY);
        // These are read only where a key has been written.
        self.faces.resize(len, 0);
    }

    /// Draws a face on samples of a row where it is nearer than before. `key`: depth key of the
    /// face, from a column and the length of its ray.
    #[inline]
    pub fn draw(
        &mut self,
        row: u32,
        columns: Range<u32>,
        lengths: LengthRow<'_>,
        face: u32,
        key: impl Fn(u32, f64) -> f64,
    ) {
        let samples = self.samples(row, &columns);
        let stored = self.keys[samples.clone()].iter_mut().zip(&mut self.faces[samples]);
        for ((column, length), (nearest, owner)) in
            columns.clone().zip(lengths.part(&columns)).zip(stored)
        {
            let key = key(column, *length);
            // Without branches, so that several samples are processed at once.
            let is_nearer = key > *nearest;
            *nearest = if is_nearer { key } else { *nearest };
            *owner = if is_nearer { face } else { *owner };
        }
    }

    /// The runs that have been drawn, row after row.
    pub fn runs(&self) -> impl Iterator<Item = Run> {
        self.rows.clone().flat_map(move |row| {
            let samples = self.samples(row, &self.columns);
            let (keys, faces) = (&self.keys[samples.clone()], &self.faces[samples]);
            let mut column = 0;
            std::iter::from_fn(move || {
                column += keys[column..].iter().position(|&key| key != EMPTY)?;
                let (start, face) = (column, faces[column]);
                let rest = keys[start..].iter().zip(&faces[start..]);
                column += rest.take_while(|&(&key, &other)| key != EMPTY && other == face).count();
                let columns = [start, column].map(|column| self.columns.start + column as u32);
                Some(Run { row, columns: columns[0]..columns[1], face })
            })
        })
    }

    /// The face at a sample; `None` where nothing has been drawn.
    #[inline]
    pub fn at(&self, [column, row]: [u32; 2]) -> Option<u32> {
        if !(self.columns.contains(&column) && self.rows.contains(&row)) {
            return None;
        }
        let sample = self.samples(row, &(column..column + 1)).start;
        (self.keys[sample] != EMPTY).then(|| self.faces[sample])
    }

    /// The depth keys of a run.
    pub fn keys(&self, run: &Run) -> &[f64] {
        &self.keys[self.samples(run.row, &run.columns)]
    }

    #[inline]
    fn samples(&self, row: u32, columns: &Range<u32>) -> Range<usize> {
        let start = (row - self.rows.start) as usize * self.columns.len();
        let [first, end] =
            [columns.start, columns.end].map(|column| (column - self.columns.start) as usize);
        start + first..start + end
    }
}
