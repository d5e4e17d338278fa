//! Transparent layers with more fragments than are stored at once.

use std::sync::atomic::{AtomicU64, Ordering};

use ugraster::{
    Area, Encoding, FragmentTarget, Keep, NoTriangles, PixelSamples, PolygonLayer, Rasterizer,
    SampleGrid, SampleShading, Scanner, ShadedRun, ShapeTarget, TRANSPARENT_VALUES, TileShape,
    TransparentLayer,
};

use crate::Grey;

/// Fragments stored at once.
const MAX_FRAGMENTS: u64 = 1 << 21;

/// Panes in front of a picture of one tile, at depths in a mixed order.
#[derive(Default)]
struct Panes {
    n: u32,
    n_shaded: AtomicU64,
    /// The most samples that are shaded for a part of the tile.
    most: AtomicU64,
}

impl SampleShading<TRANSPARENT_VALUES> for Panes {
    fn shade(&self, values: [&[f32]; TRANSPARENT_VALUES], _: Encoding, run: &mut ShadedRun) {
        self.n_shaded.fetch_add(values[0].len() as u64, Ordering::Relaxed);
        run.light[0][..values[0].len()].copy_from_slice(values[0]);
    }
}

impl TransparentLayer for Panes {
    fn draw(
        &self,
        _: &SampleGrid,
        _: usize,
        _: &mut Scanner<TRANSPARENT_VALUES>,
        target: &mut FragmentTarget<'_>,
    ) {
        let before = self.n_shaded.load(Ordering::Relaxed);
        let mut writer = target.writer(self, false);
        let Area { columns, rows } = writer.area();
        for item in 0..self.n {
            // A permutation, since the factor is prime.
            let key = (u64::from(item) * 7919 % u64::from(self.n)) as f32;
            let values = [key, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.5];
            for row in rows[0]..rows[1] {
                writer.draw_each(row, columns[0]..columns[1], item, |_, _| Some((key, values)));
            }
        }
        self.most.fetch_max(self.n_shaded.load(Ordering::Relaxed) - before, Ordering::Relaxed);
    }
}

/// However many panes there are, few of their samples are shaded twice, no more are stored than the
/// limit, and all are blended by depth. A picture of one row is drawn in parts, too.
#[test]
fn panes_are_drawn_about_once() {
    for ([width, height], n, keep) in [
        ([64, 33], 1, Keep::Centers),
        ([64, 33], 100, Keep::All),
        ([64, 33], 2100, Keep::Light),
        ([3001, 1], 1100, Keep::Centers),
    ] {
        let tiles = TileShape::Wide;
        let grid =
            SampleGrid { width, height, samples: 1, is_perspective: false, fade: None, tiles };
        let panes = Panes { n, ..Panes::default() };
        let opaque = &PolygonLayer::<1, NoTriangles> { lists: &[], corners: &NoTriangles };
        let rasterizer = Rasterizer { grid: &grid, opaque, transparent: Some(&panes) };
        let pixel = |all: &PixelSamples<'_>| {
            let keys = || all.center.fragments.iter().map(|fragment| fragment.key);
            (
                all.sum[0],
                keys().len() as u32,
                keys().zip(0..n).all(|(key, place)| key == place as f32),
            )
        };
        let (pixels, _) = rasterizer.paint(&Grey, keep, &pixel, &());
        let n_fragments = pixels.len() as u64 * u64::from(n);
        let [n_shaded, most] = [panes.n_shaded, panes.most].map(AtomicU64::into_inner);
        assert!(n_shaded <= n_fragments + MAX_FRAGMENTS + 3001, "{n}: {n_shaded} of {n_fragments}");
        assert!(most <= MAX_FRAGMENTS + 3001, "{n}: {most}");
        // From back to front.
        let light = (0..n).fold(0.0, |behind, key| 0.5 * key as f32 + 0.5 * behind);
        for (found, n_kept, is_sorted) in pixels {
            assert!((found - light).abs() <= 1e-5 * light, "{n}: {found} {light}");
            assert!(
                n_kept == if keep == Keep::Light { 0 } else { n } && is_sorted,
                "{n}: {n_kept}"
            );
        }
    }
}
