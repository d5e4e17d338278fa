//! One pixel alone, to be looked at closely.

use crate::band::{Band, Grid, Layer};
use crate::edges::Scanner;
use crate::resolve::{Finish, Gathered, Resolver};
use crate::shading::{Scale, Shade, Shades, Shading};
use crate::spans::{Seen, Tile};
use crate::transparency::{Fragment, KeepFragments, TransparencyBuffer, TransparentLayer};

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

/// The samples of a pixel that show something, row after row, what they add up to, and the pixel: the very numbers that
/// [`crate::paint`] computes, for no sample depends on where a tile begins.
pub fn probe<const N: usize, L: Layer<N> + ?Sized, P: Copy>(
    grid: &Grid,
    layer: &L,
    clear: Option<&dyn TransparentLayer>,
    shader: &impl Shading<N>,
    finish: &impl Finish<u32, P>,
    [column, row]: [u32; 2],
) -> (Vec<Sample>, Gathered<'static, u32>, P) {
    let (mut scanner, mut tile, mut transparency) =
        (Scanner::default(), Tile::default(), TransparencyBuffer::default());
    let n = grid.samples;
    let band = grid.bands().of(&(row * n..(row + 1) * n)).start as usize;
    let mut one = Band {
        grid,
        layer,
        clear,
        band,
        scanner: &mut scanner,
        tile: &mut tile,
        transparency: &mut transparency,
    };
    one.draw([column, column + 1], [row, row + 1]);
    one.draw_clear(KeepFragments::All);
    let mut shades = Shades::default();
    let mut samples = Vec::new();
    for sample_row in row * n..(row + 1) * n {
        for sample_column in column * n..(column + 1) * n {
            let (_, values) = tile.row_part(sample_row, sample_column, sample_column + 1);
            let surface = tile.seen(sample_row, sample_column).map(|seen| {
                shader.shade(values, Scale::Linear, &mut shades);
                Surface { seen, values: values.concat(), shade: shades.get(0) }
            });
            let layers = transparency.fragments(sample_row, sample_column).to_vec();
            if surface.is_some() || !layers.is_empty() {
                samples.push(Sample { place: [sample_column, sample_row], surface, layers });
            }
        }
    }
    let mut resolver = Resolver::new(shader, finish, grid);
    let Gathered { sum, covered, center, .. } = resolver.gather(&tile, &transparency, [column, row]);
    let mut pixel = [finish.pixel(&Gathered::EMPTY)];
    resolver.paint(&tile, &transparency, column, row, &mut pixel);
    (samples, Gathered { sum, covered, center, layers: &[] }, pixel[0])
}
