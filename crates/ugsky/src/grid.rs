//! The cells of a panorama and of its mip levels.
//!
//! A level halves the rows of the one before, and the columns. Near the poles rows are short, so
//! they have fewer columns: the *ladder* of column counts is halved as often as keeps cells no
//! wider than at the equator (a reduced grid, as in weather models). Cells are then nearly square
//! everywhere on the sphere, and a disc on the sphere covers about as many at the pole as
//! elsewhere.

use core::f64::consts::{FRAC_PI_2, PI, TAU};

/// The part of the sphere that a panorama shows, radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extent {
    /// Longitudes of the left and the right edge. 0 is ahead (+y), positive to the right (+x).
    pub longitudes: [f64; 2],
    /// Latitudes of the lower and the upper edge.
    pub latitudes: [f64; 2],
}

impl Extent {
    /// The whole sphere.
    pub const FULL: Self = Self { longitudes: [-PI, PI], latitudes: [-FRAC_PI_2, FRAC_PI_2] };

    /// True if the left and the right edge are one meridian.
    pub fn is_closed(&self) -> bool {
        self.width() >= TAU * (1.0 - 1e-12)
    }

    /// The angle across, radians.
    pub fn width(&self) -> f64 {
        self.longitudes[1] - self.longitudes[0]
    }

    /// The angle down, radians.
    pub fn height(&self) -> f64 {
        self.latitudes[1] - self.latitudes[0]
    }

    /// True if both ranges are increasing, and on the sphere.
    pub fn is_valid(&self) -> bool {
        const ROUNDING: f64 = 1e-9;
        let [low, high] = self.latitudes;
        let [west, east] = self.longitudes;
        let is_finite = [low, high, west, east].iter().all(|edge| edge.is_finite());
        is_finite
            && low < high
            && low >= -FRAC_PI_2 - ROUNDING
            && high <= FRAC_PI_2 + ROUNDING
            && west < east
            && self.width() <= TAU + ROUNDING
            && west.abs() <= TAU
    }
}

/// Columns beyond each edge of a panorama that is not closed, in which there is nothing.
pub(crate) const PAD: usize = 64;

/// Columns that are computed at once.
pub(crate) const CHUNK: usize = 8;

/// Rows whose [`Lines`] are read at once.
pub(crate) const LINES_AT_ONCE: usize = 16;

/// Cosine and sine of the longitudes at the middles of columns.
pub(crate) struct Columns {
    /// Columns with texels.
    pub n: usize,
    /// Entry `PAD` is column 0 if the panorama is not closed, else entry 0. There are
    /// [`CHUNK`] more entries than columns, so that chunks may end beyond the last.
    pub cos: Vec<f32>,
    pub sin: Vec<f32>,
    /// Columns per radian.
    pub per_radian: f64,
}

/// A row of cells.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Row {
    /// Index in the ladder: of the number of columns that this row has.
    pub ladder: usize,
    /// Sine and cosine of the latitude of its middle.
    pub sin: f64,
    pub cos: f64,
    /// Latitude of its middle.
    pub latitude: f64,
    /// Solid angle of a cell, times the rows of the level and of column counts (so about 1 to 2).
    pub area: f32,
}

/// The arguments of the weights of the texels of rows. Lists of numbers have [`LINES_AT_ONCE`] more
/// entries than there are rows.
pub(crate) struct Lines {
    /// Tangent of the latitude in the middle of the row.
    pub tan: Vec<f32>,
    /// Square of the cosine of that latitude.
    pub cos_square: Vec<f32>,
    /// Square root of [`Row::area`].
    pub root: Vec<f32>,
    /// `root` times `cos_square`.
    pub root_cos_square: Vec<f32>,
}

impl Lines {
    fn new(rows: &[Row]) -> Self {
        let list = |value: fn(&Row) -> f64| {
            let values = rows.iter().map(|row| value(row) as f32);
            values.chain([0.0; LINES_AT_ONCE]).collect()
        };
        Self {
            tan: list(|row| row.sin / row.cos),
            cos_square: list(|row| row.cos * row.cos),
            root: list(|row| f64::from(row.area).sqrt()),
            root_cos_square: list(|row| f64::from(row.area).sqrt() * row.cos * row.cos),
        }
    }
}

/// The cells of a level.
pub(crate) struct Grid {
    pub rows: Vec<Row>,
    pub lines: Lines,
    /// Height of a row and width of a column at the equator, whichever is larger; radians.
    pub texel: f64,
    /// Rows per radian.
    pub rows_per_radian: f64,
}

/// Halved, rounded up, until it is 1.
fn halvings(mut n: usize) -> Vec<usize> {
    let mut all = vec![n];
    while n > 1 {
        n = n.div_ceil(2);
        all.push(n);
    }
    all
}

/// Column counts of a panorama, from all to 1.
pub(crate) fn ladder(width: u32, extent: &Extent) -> Vec<Columns> {
    halvings(width as usize).into_iter().map(|n| columns(n, extent)).collect()
}

fn columns(n: usize, extent: &Extent) -> Columns {
    let step = extent.width() / n as f64;
    let pad = if extent.is_closed() { 0 } else { PAD };
    let at = |idx: usize| {
        let (sin, cos) =
            libm::sincos(extent.longitudes[0] + step * (idx as f64 - pad as f64 + 0.5));
        (cos as f32, sin as f32)
    };
    let (cos, sin) = (0..n + 2 * pad + CHUNK).map(at).unzip();
    Columns { n, cos, sin, per_radian: 1.0 / step }
}

/// The grids of all levels.
pub(crate) fn grids(size: [u32; 2], extent: &Extent, ladder: &[Columns]) -> Vec<Grid> {
    let heights = halvings(size[1] as usize);
    // Coarser levels have no use, see the largest footprint.
    let n_levels = heights.iter().zip(ladder).take_while(|(rows, columns)| {
        let texel = (extent.height() / **rows as f64).max(1.0 / columns.per_radian);
        texel < crate::footprint::LARGEST
    });
    let n_levels = n_levels.count().max(1);
    (0..n_levels).map(|level| grid(level, heights[level], extent, ladder)).collect()
}

fn grid(level: usize, n_rows: usize, extent: &Extent, ladder: &[Columns]) -> Grid {
    let step = extent.height() / n_rows as f64;
    let equator = 1.0 / ladder[level].per_radian;
    let rows = (0..n_rows).map(|idx| {
        let edges = [idx as f64, (idx + 1) as f64]
            .map(|edge| (extent.latitudes[1] - step * edge).clamp(-FRAC_PI_2, FRAC_PI_2));
        let widest = if edges[0] * edges[1] <= 0.0 {
            1.0
        } else {
            libm::cos(edges[0].abs().min(edges[1].abs()))
        };
        let fits = |columns: &Columns| widest / columns.per_radian <= equator * (1.0 + 1e-12);
        let reduced = ladder[level..].iter().take_while(|columns| fits(columns)).count();
        let row_ladder = level + reduced.max(1) - 1;
        let latitude = 0.5 * (edges[0] + edges[1]);
        let (sin, cos) = libm::sincos(latitude);
        // sin a − sin b = 2 sin((a − b)/2) cos((a + b)/2), without cancellation.
        let height = 2.0 * libm::sin(0.5 * (edges[0] - edges[1])) * cos;
        let area = (height / step / (ladder[row_ladder].per_radian * equator)) as f32;
        Row { ladder: row_ladder, sin, cos, latitude, area }
    });
    let rows: Vec<Row> = rows.collect();
    let lines = Lines::new(&rows);
    Grid { rows, lines, texel: step.max(equator), rows_per_radian: 1.0 / step }
}
