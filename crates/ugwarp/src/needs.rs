//! Which part of a panorama a picture needs.

use core::f64::consts::PI;

use ugpipe::Progress;
use ugsky::{Extent, PanoramaPart};
use ugskybox::Opened;

use crate::config::Config;
use crate::error::Error;
use crate::render::{Prepared, seen_from};

/// The part of a panorama that a picture reads, and how large its pixels are there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Needs {
    /// Pixels of the panorama across and down; of a cube map, of the panorama that it is converted
    /// to.
    pub size: [u32; 2],
    /// The angles that the panorama shows.
    pub extent: Extent,
    /// The part of it. Its sides are those of a pixel of the picture.
    pub part: PanoramaPart,
}

/// Which part of the panorama a picture needs: all pixels whose light is in one of the picture.
/// `None` if it shows nothing of it, or there are only stars.
///
/// # Errors
/// See [`Error`].
pub fn needs(
    opened: &Opened,
    config: &Config,
    progress: &dyn Progress,
) -> Result<Option<Needs>, Error> {
    let config = &*seen_from(opened, config)?;
    let found = Prepared::new(opened.into(), config, progress)?.warp.part(progress);
    Ok(found.map(|(panorama, part)| Needs {
        size: panorama.size(),
        extent: panorama.extent(),
        part,
    }))
}

impl Needs {
    /// Longitudes of the left and the right edge of the part, degrees. The right one is beyond 180
    /// if the part goes on at the left edge of the panorama.
    #[must_use]
    pub fn longitudes_deg(&self) -> [f64; 2] {
        let step = self.extent.width() / f64::from(self.size[0]);
        let at = |column: u32| (self.extent.longitudes[0] + step * f64::from(column)).to_degrees();
        [at(self.part.column), at(self.part.column + self.part.n_columns)]
    }

    /// Latitudes of its lower and its upper edge, degrees.
    #[must_use]
    pub fn latitudes_deg(&self) -> [f64; 2] {
        let step = self.extent.height() / f64::from(self.size[1]);
        let at = |row: u32| (self.extent.latitudes[1] - step * f64::from(row)).to_degrees();
        [at(self.part.row + self.part.n_rows), at(self.part.row)]
    }

    /// The size of a panorama of the whole sphere whose pixels are as large as the smallest ones of
    /// the picture are on it.
    #[must_use]
    pub fn whole_size(&self) -> [f64; 2] {
        let [width, height] = self.size.map(f64::from);
        let (across, down) = (self.extent.width() / width, self.extent.height() / height);
        let rows = (PI / (self.part.sides[0] * across.max(down))).round();
        [2.0 * rows, rows]
    }

    /// The report for people. `has_pixels`: the file has the pixels of the panorama, and not those
    /// of a cube.
    #[must_use]
    pub fn text(&self, has_pixels: bool) -> String {
        let ([west, east], [south, north]) = (self.longitudes_deg(), self.latitudes_deg());
        let PanoramaPart { column, n_columns, row, n_rows, sides: [least, most] } = self.part;
        let ([width, height], [columns, rows]) = (self.size, self.whole_size());
        let pixels = if has_pixels {
            format!(
                "{n_columns} x {n_rows} of its {width} x {height} pixels, from column {column} and row {row} on, \
                 counted from 0\n"
            )
        } else {
            String::new()
        };
        format!(
            "longitudes {west:.2} to {east:.2} and latitudes {south:.2} to {north:.2} degrees of the panorama\n\
             {pixels}\
             a pixel of the picture is {least:.2} to {most:.2} pixels of the panorama wide; \
             a whole panorama of {columns} x {rows} pixels has one for each\n"
        )
    }
}
