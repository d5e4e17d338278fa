//! One pixel alone, to be looked at closely.

use super::band::{Band, Grid, Layer};
use super::edges::Scanner;
use super::resolve::{Gathered, Resolver, Shade};
use super::spans::{Seen, Tile};

/// A covered sample of a pixel.
#[derive(Clone, Debug, PartialEq)]
pub struct Sample {
    /// Its column and row among the samples of the whole picture.
    pub place: [u32; 2],
    /// How near it is and whose.
    pub seen: Seen<u32>,
    /// The interpolated numbers.
    pub values: Vec<f32>,
    /// What the shader made of them.
    pub shade: Shade,
}

/// The covered samples of a pixel, row after row, and the pixel gathered from them: the very numbers that
/// [`super::paint`] computes, for no sample depends on where a tile begins.
pub fn probe<const N: usize, L: Layer<N> + ?Sized>(
    grid: &Grid,
    layer: &L,
    shader: &impl Fn(&[f32; N]) -> Shade,
    [column, row]: [u32; 2],
) -> (Vec<Sample>, Gathered<u32>) {
    let (mut scanner, mut tile) = (Scanner::default(), Tile::default());
    let n = grid.samples;
    let band = grid.bands_of(&(row * n..(row + 1) * n)).start;
    Band { grid, layer, band, scanner: &mut scanner, tile: &mut tile }
        .draw([column, column + 1], [row, row + 1]);
    let mut samples = Vec::new();
    for sample_row in row * n..(row + 1) * n {
        for sample_column in column * n..(column + 1) * n {
            let values = tile.row_part(sample_row, sample_column, sample_column + 1).flatten().next();
            if let (Some(seen), Some(values)) = (tile.seen(sample_row, sample_column), values) {
                let place = [sample_column, sample_row];
                samples.push(Sample { place, seen, values: values.to_vec(), shade: shader(values) });
            }
        }
    }
    let gathered = Resolver::new(shader, &(), n).gather(&tile, column, row);
    (samples, gathered)
}
