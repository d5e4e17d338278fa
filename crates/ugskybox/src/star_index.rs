//! Stars by direction.

use core::f64::consts::{PI, TAU};

use glam::DVec3;
use ugsky::Star;

/// Rows of cells from pole to pole.
const ROWS: usize = 64;

/// Stars in cells of about equal size on the sphere.
pub struct StarIndex {
    /// Row of the first cell of each row, and of the end.
    starts: Vec<usize>,
    /// The end of the stars of each cell in `stars`.
    ends: Vec<usize>,
    /// Indices of stars, cell by cell.
    stars: Vec<usize>,
}

impl StarIndex {
    /// The index of a list.
    pub fn new(stars: &[Star]) -> Self {
        let n_columns = |row: usize| {
            let latitude = PI * ((row as f64 + 0.5) / ROWS as f64 - 0.5);
            ((2 * ROWS) as f64 * libm::cos(latitude)).ceil().max(1.0) as usize
        };
        let mut starts = vec![0];
        for row in 0..ROWS {
            starts.push(starts[row] + n_columns(row));
        }
        let mut index = Self { ends: vec![0; starts[ROWS]], starts, stars: Vec::new() };
        let mut placed: Vec<(usize, usize)> =
            stars.iter().enumerate().map(|(idx, star)| (index.cell(star.direction), idx)).collect();
        placed.sort_unstable();
        for (cell, _) in &placed {
            index.ends[*cell] += 1;
        }
        let mut end = 0;
        for count in &mut index.ends {
            end += *count;
            *count = end;
        }
        index.stars = placed.into_iter().map(|(_, idx)| idx).collect();
        index
    }

    fn row(latitude: f64) -> usize {
        ((latitude / PI + 0.5) * ROWS as f64).clamp(0.0, ROWS as f64 - 1.0) as usize
    }

    fn cell(&self, direction: DVec3) -> usize {
        let row = Self::row(libm::asin(direction.z.clamp(-1.0, 1.0)));
        let n = self.starts[row + 1] - self.starts[row];
        let part = libm::atan2(direction.x, direction.y) / TAU + 0.5;
        self.starts[row] + ((part * n as f64) as usize).min(n - 1)
    }

    /// Visits all stars within an angle of a direction, radians, and some others.
    pub fn visit(&self, direction: DVec3, radius: f64, mut visit: impl FnMut(usize)) {
        if self.stars.is_empty() {
            return;
        }
        let latitude = libm::asin(direction.z.clamp(-1.0, 1.0));
        let longitude = libm::atan2(direction.x, direction.y);
        let ratio = libm::sin(radius.min(0.5 * PI)) / libm::cos(latitude);
        let is_around_pole = latitude.abs() + radius >= 0.5 * PI || ratio >= 1.0;
        for row in Self::row(latitude - radius)..=Self::row(latitude + radius) {
            let (start, n) = (self.starts[row], self.starts[row + 1] - self.starts[row]);
            let (first, count) = if is_around_pole {
                (0, n)
            } else {
                let half = libm::asin(ratio);
                let column = |longitude: f64| ((longitude / TAU + 0.5) * n as f64).floor();
                let (first, last) = (column(longitude - half), column(longitude + half));
                ((first as i64).rem_euclid(n as i64) as usize, ((last - first) as usize + 1).min(n))
            };
            for step in 0..count {
                let cell = start + (first + step) % n;
                let from = if cell == 0 { 0 } else { self.ends[cell - 1] };
                self.stars[from..self.ends[cell]].iter().for_each(|idx| visit(*idx));
            }
        }
    }
}
