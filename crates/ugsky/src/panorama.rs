//! Panoramas: light by direction, on an equirectangular grid with mip levels.

use std::fmt;

use crate::arrangement::Arrangement;
use crate::grid::{Columns, Extent, Grid, Row, grids, ladder};
use crate::pyramid::Pyramid;
use crate::texels::Texels;

/// Why pictures are no panorama.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum PanoramaError {
    /// The number of texels is not width × height, or 0.
    Size,
    /// The angles are not increasing, or not on the sphere.
    Extent,
    /// A texel is larger than 0.2 radians.
    Coarse,
    /// The sides of the picture have not the ratio of its arrangement.
    Shape {
        /// Its pixels across and down.
        size: [u32; 2],
        /// The expected value.
        arrangement: Arrangement,
    },
    /// There are not as many files as a cube has sides, or more than one for other arrangements.
    Sides {
        /// Their number.
        n_files: usize,
    },
    /// A side of a cube is no square, or has another size than the first.
    Side {
        /// Which of the six.
        idx: usize,
        /// Its pixels across and down.
        size: [u32; 2],
        /// Columns of the first side.
        expected: u32,
    },
}

impl fmt::Display for PanoramaError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Size => f.write_str("the number of texels is not that of the size"),
            Self::Extent => f.write_str(
                "the angles of the panorama must increase from west to east, by at most 360 degrees, and from south \
                 to north, within 90 degrees of the horizon",
            ),
            Self::Coarse => f.write_str(
                "the panorama has too few pixels: none may be larger than 11 degrees, so a whole one has at least \
                 32 x 16",
            ),
            Self::Shape { size: [width, height], arrangement } => {
                let shape = match arrangement {
                    Arrangement::Equirectangular => "panorama, which is twice as wide as high",
                    other => other.name(),
                };
                write!(f, "{width} x {height} pixels are not the shape of a {shape}")
            }
            Self::Sides { n_files } => {
                write!(f, "{n_files} files were given: a cube of sides needs six, and other panoramas one")
            }
            Self::Side { idx, size: [width, height], expected } => write!(
                f,
                "the {} side of the cube has {width} x {height} pixels: all must be squares of the same size, here \
                 {expected} x {expected}",
                ORDINALS[idx % 6]
            ),
        }
    }
}

impl std::error::Error for PanoramaError {}

const ORDINALS: [&str; 6] = ["first", "second", "third", "fourth", "fifth", "sixth"];

/// Largest texel, radians.
const COARSEST: f64 = 0.2;

/// The light that arrives from all directions, or from a part of them.
///
/// Directions have y ahead, in the middle of the panorama, x to the right and z up. Texels are
/// square on the map and have the light of their middle; their number across and down may be any.
pub struct Panorama {
    extent: Extent,
    size: [u32; 2],
    pub(crate) pyramid: Pyramid,
    pub(crate) ladder: Vec<Columns>,
    pub(crate) grids: Vec<Grid>,
}

impl Panorama {
    /// A panorama of `size` texels across and down.
    ///
    /// # Errors
    /// [`PanoramaError`].
    pub fn new(size: [u32; 2], texels: Texels, extent: Extent) -> Result<Self, PanoramaError> {
        let n_texels = size[0] as usize * size[1] as usize;
        if n_texels == 0 || texels.len() != n_texels {
            return Err(PanoramaError::Size);
        }
        if !extent.is_valid() {
            return Err(PanoramaError::Extent);
        }
        let coarsest =
            (extent.width() / f64::from(size[0])).max(extent.height() / f64::from(size[1]));
        if coarsest > COARSEST {
            return Err(PanoramaError::Coarse);
        }
        let ladder = ladder(size[0], &extent);
        let grids = grids(size, &extent, &ladder);
        let shape = |row: &Row| (ladder[row.ladder].n, row.area);
        let shapes: Vec<Vec<_>> =
            grids.iter().map(|grid| grid.rows.iter().map(shape).collect()).collect();
        let pyramid = Pyramid::new(texels, size[0] as usize, extent.is_closed(), &shapes);
        Ok(Self { extent, size, pyramid, ladder, grids })
    }

    /// The part of the sphere that is shown.
    pub fn extent(&self) -> Extent {
        self.extent
    }

    /// Texels across and down.
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// The level on which an ellipse is sampled, by the square of its smaller semi-axis: its texels
    /// are at most as large, and more than half as large.
    #[inline]
    pub(crate) fn level_of(&self, small_square: f64) -> usize {
        let mut level = 0;
        while let Some(grid) = self.grids.get(level + 1)
            && grid.texel * grid.texel <= small_square
        {
            level += 1;
        }
        level
    }
}
