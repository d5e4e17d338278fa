//! One pixel alone, with all its samples.

use crate::rasterizer::Rasterizer;
use crate::resolve::{Center, PixelSamples, Resolve, Resolver};
use crate::shading::{Encoding, SampleShading, ShadedRun, ShadedSample};
use crate::tile::VisibleItem;
use crate::transparency::{Fragment, Keep, TileBuffers};

/// A sample of a pixel that shows something.
#[derive(Clone, Debug, PartialEq)]
pub struct ProbedSample {
    /// Its column and row among the samples of the whole picture.
    pub place: [u32; 2],
    /// The nearest opaque surface.
    pub opaque: Option<ProbedSurface>,
    /// Transparent fragments in front of it, from back to front.
    pub fragments: Vec<Fragment>,
}

/// An opaque surface at a sample.
#[derive(Clone, Debug, PartialEq)]
pub struct ProbedSurface {
    /// Its depth key and item.
    pub hit: VisibleItem,
    /// The interpolated values.
    pub values: Vec<f32>,
    /// Their light.
    pub shaded: ShadedSample,
}

impl<const N: usize> Rasterizer<'_, N> {
    /// The samples of a pixel that show something, row after row; all of them together; and the
    /// pixel. They are the same bits as in [`Rasterizer::paint`], because no sample depends on
    /// where a tile starts.
    pub fn probe<P: Copy>(
        &self,
        shading: &dyn SampleShading<N>,
        resolve: &impl Resolve<P>,
        pixel: [u32; 2],
    ) -> (Vec<ProbedSample>, PixelSamples<'static>, P) {
        let (samples, all, mut resolver, buffers) = self.probe_samples(shading, pixel);
        let mut pixels = [resolve.pixel(&PixelSamples::EMPTY)];
        resolver.paint(resolve, &buffers, pixel, &mut pixels);
        (samples, all, pixels[0])
    }

    fn probe_samples<'s>(
        &'s self,
        shading: &'s dyn SampleShading<N>,
        [column, row]: [u32; 2],
    ) -> (Vec<ProbedSample>, PixelSamples<'static>, Resolver<'s, N>, TileBuffers<N>) {
        let grid = self.grid;
        let n = grid.samples;
        let band = grid.bands().of(&(row * n..(row + 1) * n)).start as usize;
        let mut buffers = TileBuffers::default();
        self.draw_tile(&mut buffers, band, [column, column + 1], [row, row + 1], Keep::All);
        let TileBuffers { tile, transparency, .. } = &buffers;
        let mut run = ShadedRun::default();
        let mut samples = Vec::new();
        for sample_row in row * n..(row + 1) * n {
            for sample_column in column * n..(column + 1) * n {
                let (_, values) = tile.row_part(sample_row, sample_column, sample_column + 1);
                let opaque = tile.hit(sample_row, sample_column).map(|hit| {
                    shading.shade(values, Encoding::Linear, &mut run);
                    ProbedSurface { hit, values: values.concat(), shaded: run.get(0) }
                });
                let fragments = transparency.fragments(sample_row, sample_column).to_vec();
                if opaque.is_some() || !fragments.is_empty() {
                    samples.push(ProbedSample {
                        place: [sample_column, sample_row],
                        opaque,
                        fragments,
                    });
                }
            }
        }
        let mut resolver = Resolver::new(grid, shading);
        let PixelSamples { sum, covered, center } = resolver.pixel_samples(&buffers, [column, row]);
        let all = PixelSamples { sum, covered, center: Center { fragments: &[], ..center } };
        (samples, all, resolver, buffers)
    }
}
