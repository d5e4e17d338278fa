//! One pixel alone, to be looked at closely.

use super::band::{Band, Grid, Layer};
use super::edges::Scanner;
use super::glass::{Clear, Fragment, Glass, Keep};
use super::resolve::{Gathered, Resolver, Shade};
use super::spans::{Seen, Tile};

/// A sample of a pixel that shows something.
#[derive(Clone, Debug, PartialEq)]
pub struct Sample {
    /// Its column and row among the samples of the whole picture.
    pub place: [u32; 2],
    /// The nearest that hides, if there is any.
    pub surface: Option<Surface>,
    /// What is clear in front of that, from behind.
    pub layers: Vec<Fragment>,
}

/// What a sample shows of what hides.
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    /// How near it is and whose.
    pub seen: Seen<u32>,
    /// The interpolated numbers.
    pub values: Vec<f32>,
    /// What the shader made of them.
    pub shade: Shade,
}

/// The samples of a pixel that show something, row after row, and the pixel gathered from all: the very numbers that
/// [`super::paint`] computes, for no sample depends on where a tile begins.
pub fn probe<const N: usize, L: Layer<N> + ?Sized>(
    grid: &Grid,
    layer: &L,
    clear: Option<&dyn Clear>,
    shader: &impl Fn(&[f32; N]) -> Shade,
    [column, row]: [u32; 2],
) -> (Vec<Sample>, Gathered<'static, u32>) {
    let (mut scanner, mut tile, mut glass) = (Scanner::default(), Tile::default(), Glass::default());
    let n = grid.samples;
    let band = grid.bands_of(&(row * n..(row + 1) * n)).start;
    let mut one =
        Band { grid, layer, clear, band, scanner: &mut scanner, tile: &mut tile, glass: &mut glass };
    one.draw([column, column + 1], [row, row + 1]);
    one.draw_clear(Keep::All);
    let mut samples = Vec::new();
    for sample_row in row * n..(row + 1) * n {
        for sample_column in column * n..(column + 1) * n {
            let values = tile.row_part(sample_row, sample_column, sample_column + 1).flatten().next();
            let surface = tile.seen(sample_row, sample_column).zip(values);
            let surface = surface.map(|(seen, values)| Surface {
                seen,
                values: values.to_vec(),
                shade: shader(values),
            });
            let layers = glass.fragments(sample_row, sample_column).to_vec();
            if surface.is_some() || !layers.is_empty() {
                samples.push(Sample { place: [sample_column, sample_row], surface, layers });
            }
        }
    }
    let Gathered { sum, covered, center, .. } =
        Resolver::new(shader, &(), grid).gather(&tile, &glass, column, row);
    (samples, Gathered { sum, covered, center, layers: &[] })
}
