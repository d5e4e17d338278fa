//! Which part of a panorama a picture reads, and how finely.

use glam::DVec3;

use crate::footprint::{Ellipse, PlaneEllipse};
use crate::observer::SkyRay;
use crate::panorama::Panorama;
use crate::sample::Sampler;
use crate::view::{MOST_DIVISIONS, QUARTERS, SkyView};

/// The texels of a panorama that samples of a picture read, and how large a sample is among them.
#[derive(Clone, Debug)]
pub struct Reach {
    /// The first and the last row.
    rows: [usize; 2],
    /// Changes of the number of samples from one column to the next.
    changes: Vec<i64>,
    /// The least and the greatest of the longer sides of samples, in texels.
    sides: [f64; 2],
}

/// A part of a panorama, in texels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PanoramaPart {
    /// The first column, and how many follow to the right, beyond the right edge from the left one
    /// on.
    pub column: u32,
    /// How many columns it has.
    pub n_columns: u32,
    /// The uppermost row.
    pub row: u32,
    /// How many rows it has.
    pub n_rows: u32,
    /// The least and the greatest of the longer sides of samples, in texels.
    pub sides: [f64; 2],
}

impl Reach {
    /// Nothing of a panorama.
    pub fn new(panorama: &Panorama) -> Self {
        let changes = vec![0; panorama.size()[0] as usize + 1];
        Self { rows: [usize::MAX, 0], changes, sides: [f64::INFINITY, 0.0] }
    }

    /// The texels of both.
    #[must_use]
    pub fn and(mut self, other: &Self) -> Self {
        self.rows = [self.rows[0].min(other.rows[0]), self.rows[1].max(other.rows[1])];
        self.changes.iter_mut().zip(&other.changes).for_each(|(sum, change)| *sum += change);
        let [[least, most], [low, high]] = [self.sides, other.sides];
        self.sides = [least.min(low), most.max(high)];
        self
    }

    /// The smallest part of the panorama with all of the texels; `None` if there are none.
    pub fn part(&self, panorama: &Panorama) -> Option<PanoramaPart> {
        let [first, last] = self.rows;
        if first > last {
            return None;
        }
        let mut count = 0;
        let counts = self.changes[..self.changes.len() - 1].iter().map(|change| {
            count += change;
            count
        });
        let is_read: Vec<bool> = counts.map(|count| count > 0).collect();
        let (column, n_columns) = shortest_arc(&is_read, panorama.extent().is_closed())?;
        Some(PanoramaPart {
            column: column as u32,
            n_columns: n_columns as u32,
            row: first as u32,
            n_rows: (last - first + 1) as u32,
            sides: self.sides,
        })
    }

    /// Adds the texels below some of a row of a level.
    fn add(
        &mut self,
        panorama: &Panorama,
        (level, row): (usize, usize),
        [first, last]: [usize; 2],
    ) {
        // The texels of a level are means of those that they overlap on the level before.
        let below = |[first, last]: [usize; 2], n_fine: usize, n: usize| {
            [first * n_fine / n, ((last + 1) * n_fine).div_ceil(n) - 1]
        };
        let heights = panorama.grids[..=level].iter().map(|grid| grid.rows.len());
        let heights: Vec<usize> = heights.collect();
        let [top, bottom] =
            heights.windows(2).rev().fold([row; 2], |rows, pair| below(rows, pair[0], pair[1]));
        self.rows = [self.rows[0].min(top), self.rows[1].max(bottom)];
        let ladder = &panorama.ladder[..=panorama.grids[level].rows[row].ladder];
        let [left, right] = ladder
            .windows(2)
            .rev()
            .fold([first, last], |columns, pair| below(columns, pair[0].n, pair[1].n));
        self.changes[left] += 1;
        self.changes[right + 1] -= 1;
    }
}

/// The shortest run of columns with all that are read: the first, and how many. If columns begin
/// again after the last one, so may the run.
fn shortest_arc(is_read: &[bool], is_closed: bool) -> Option<(usize, usize)> {
    let n = is_read.len();
    let first = is_read.iter().position(|read| *read)?;
    let last = is_read.iter().rposition(|read| *read)?;
    let around = (first + n - 1 - last, [last, first]);
    let mut widest = (0, [last, first]);
    if is_closed && around.0 > 0 {
        widest = around;
    }
    let mut before = first;
    for column in (first..=last).filter(|column| is_read[*column]) {
        let gap = (column - before).saturating_sub(1);
        if is_closed && gap > widest.0 {
            widest = (gap, [before, column]);
        }
        before = column;
    }
    let [end, start] = widest.1;
    Some((start, (end + n - start) % n + 1))
}

/// Finds which texels samples of a picture read, on one thread.
pub struct ReachFinder<'a, 's, F> {
    /// The observer and the picture.
    pub view: &'a SkyView,
    /// The direction seen at a place, as in [`SkyLight`](crate::SkyLight).
    pub film: F,
    /// Of the panorama.
    pub sampler: &'a mut Sampler<'s>,
    /// The texels that were found.
    pub reach: Reach,
}

impl<F: Fn([f64; 2]) -> Option<DVec3>> ReachFinder<'_, '_, F> {
    /// Adds the texels that a sample with its middle at this place reads.
    pub fn add(&mut self, place: [f64; 2]) {
        self.add_part(place, 1.0, 0);
    }

    /// The same for a square of the film, `side` samples wide.
    fn add_part(&mut self, place: [f64; 2], side: f64, depth: u32) {
        let Some(ray) = self.view.ray(&self.film, place, side) else { return };
        if self.sampler.add_reach(&ray, self.view.spread, side, &mut self.reach) {
            return;
        }
        if depth < MOST_DIVISIONS {
            for [right, below] in QUARTERS {
                let quarter = [place[0] + right * side, place[1] + below * side];
                self.add_part(quarter, 0.5 * side, depth + 1);
            }
        }
    }
}

impl Sampler<'_> {
    /// Adds the texels that [`Sampler::light`] reads for a ray. False if its footprint has to be
    /// divided. `side`: that of its square, in samples.
    fn add_reach(&mut self, ray: &SkyRay, spread: f64, side: f64, reach: &mut Reach) -> bool {
        let ellipse = Ellipse::new(ray, spread);
        if !ellipse.is_small() {
            return false;
        }
        let sky = self.panorama();
        let level = sky.level_of(ellipse.small_square());
        let kernel = ellipse.kernel(sky.grids[level].texel, sky.grids[0].texel);
        let mut is_any = false;
        for (row, columns) in self.texels_read(level, &kernel, ray.direction) {
            reach.add(sky, (level, row), columns);
            is_any = true;
        }
        if is_any {
            let [_, longer] = PlaneEllipse::of_ray(ray).squares;
            let longer = longer.sqrt() / (side * sky.grids[0].texel);
            reach.sides = [reach.sides[0].min(longer), reach.sides[1].max(longer)];
        }
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arcs_are_the_shortest() {
        let check = |columns: &str, closed: (usize, usize), open: (usize, usize)| {
            let is_read: Vec<bool> = columns.bytes().map(|byte| byte == b'x').collect();
            assert_eq!(shortest_arc(&is_read, true), Some(closed), "{columns}");
            assert_eq!(shortest_arc(&is_read, false), Some(open), "{columns}");
        };
        check("..xx....", (2, 2), (2, 2));
        check("xx...xxx", (5, 5), (0, 8));
        check("x......x", (7, 2), (0, 8));
        check("xxxxxxxx", (0, 8), (0, 8));
        check("xxx.xxxx", (4, 7), (0, 8));
        check("..x..x..", (2, 4), (2, 4));
        check(".x.....x", (7, 3), (1, 7));
        check("...x....", (3, 1), (3, 1));
        assert_eq!(shortest_arc(&[false; 8], true), None);
    }
}
