//! Contact sheets: pictures of equal size, side by side.

use image::{DynamicImage, ImageError, RgbImage};
use std::io;
use std::num::NonZeroU32;
use std::path::{Path, PathBuf};

/// Pixels between neighbours.
const GAP: u32 = 4;
/// Dark grey: neither black space nor white paper.
const GAP_COLOR: image::Rgb<u8> = image::Rgb([64, 64, 64]);

/// Writes `pictures`, row by row with `columns` to a row, as one picture.
///
/// # Errors
///
/// When a picture cannot be read or written, or differs in size from the first.
pub fn tile(out: &Path, columns: NonZeroU32, pictures: &[PathBuf]) -> io::Result<()> {
    let tiles = pictures.iter().map(|path| read(path)).collect::<io::Result<Vec<_>>>()?;
    let (width, height) = tiles.first().map_or((0, 0), RgbImage::dimensions);
    for (tile, path) in tiles.iter().zip(pictures) {
        if tile.dimensions() != (width, height) {
            let (w, h) = tile.dimensions();
            return Err(io::Error::other(format!(
                "`{}` is {w}x{h}, but the first picture is {width}x{height}: draw all with one -sz",
                path.display()
            )));
        }
    }

    let n_tiles = u32::try_from(tiles.len()).map_err(io::Error::other)?;
    let columns = columns.get().min(n_tiles);
    let rows = n_tiles.div_ceil(columns);
    let extent = |count: u32, size: u32| count * (size + GAP) - GAP;
    let mut sheet = RgbImage::from_pixel(extent(columns, width), extent(rows, height), GAP_COLOR);
    for (i, tile) in (0..).zip(&tiles) {
        let x = i64::from((i % columns) * (width + GAP));
        let y = i64::from((i / columns) * (height + GAP));
        image::imageops::replace(&mut sheet, tile, x, y);
    }
    sheet.save(out).map_err(|error| named(out, &error))
}

fn read(path: &Path) -> io::Result<RgbImage> {
    image::open(path).map(DynamicImage::into_rgb8).map_err(|error| named(path, &error))
}

fn named(path: &Path, error: &ImageError) -> io::Error {
    io::Error::other(format!("`{}`: {error}", path.display()))
}
