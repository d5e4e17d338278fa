//! A rasterizer: polygons in the picture plane to pixels.
//!
//! It draws on a grid of samples, several to a pixel, with a depth test at each sample. It knows
//! no scenes, cameras or colours: corners carry a depth key and N values ([`Corner`]), and a
//! [`SampleShading`] turns the N interpolated values of a sample into linear light. [`Resolve`]
//! makes a pixel of the light of its samples, so the caller decides about backgrounds and pixel
//! formats. Output is the same bits on any number of threads and on every processor.
//!
//! # Example
//!
//! Two triangles that intersect, one bright at the left and one dark at the right, with one sample
//! to a pixel. The nearer one is visible at each pixel:
//!
//! ```
//! use ugraster::{Corner, Encoding, Keep, NoTriangles, PixelSamples, PolygonLayer, PolygonList};
//! use ugraster::Rasterizer;
//! use ugraster::{SampleGrid, ShadedRun, ShadedSample, SampleShading, TileShape};
//!
//! /// The only interpolated value is grey light.
//! struct Grey;
//!
//! impl SampleShading<1> for Grey {
//!     fn shade(&self, [greys]: [&[f32]; 1], _: Encoding, run: &mut ShadedRun) {
//!         for (sample, &grey) in greys.iter().enumerate() {
//!             let light = [grey; 3];
//!             run.set(sample, ShadedSample { light, intensity: grey, is_out_of_range: false });
//!         }
//!     }
//! }
//!
//! // Depth keys of an orthographic view: larger is nearer.
//! let (fade, tiles) = (None, TileShape::Tall);
//! let grid = SampleGrid { width: 9, height: 5, samples: 1, is_perspective: false, fade, tiles };
//! let mut polygons = PolygonList::default();
//! for (item, grey, left_key, right_key) in [(0, 0.75, 2.0, 0.0), (1, 0.25, 0.0, 2.0)] {
//!     for (x, y, key) in [(0.0, -9.0, left_key), (9.0, 2.5, right_key), (0.0, 14.0, left_key)] {
//!         polygons.push_corner(Corner { x, y, key, values: [grey] });
//!     }
//!     polygons.end_contour();
//!     polygons.end_polygon(&grid, item);
//! }
//! polygons.sort_into_bands(&grid);
//!
//! let opaque = &PolygonLayer { lists: &[polygons], corners: &NoTriangles };
//! let rasterizer = Rasterizer { grid: &grid, opaque, transparent: None };
//! let red = |samples: &PixelSamples<'_>| samples.sum[0];
//! let (pixels, stats) = rasterizer.paint(&Grey, Keep::Light, &red, &());
//! let middle_row = &pixels[2 * 9..3 * 9];
//! assert_eq!(middle_row[..4], [0.75; 4]);
//! assert_eq!(middle_row[5..], [0.25; 4]);
//! assert_eq!(stats.visible, stats.covered);
//!
//! let items = rasterizer.paint_centers(|center| center.opaque.map(|hit| hit.item), &());
//! assert_eq!([items[2 * 9], items[3 * 9 - 1]], [Some(0), Some(1)]);
//! ```
//!
//! # Steps
//!
//! 1. `polygons`: polygons and triangles in buffers, sorted into bands of pixel rows (`bins`);
//! 2. `edges`: crossings of a polygon's outline with a row of samples;
//! 3. `tile`: the samples between two crossings, and the depth test;
//! 4. `triangles`: a faster way for triangles, the usual case, in blocks of eight: `block`
//!    classifies them, `outlines` intersects them with rows, `gradients` finds how values change
//!    over the picture, `rows` draws samples;
//! 5. `transparency`: transparent faces and lines, stored per sample (an A-buffer);
//! 6. `shading`: the light of samples, many at once;
//! 7. `resolve`: the samples of a pixel added in linear light, with depth cueing (`depth_fade`);
//! 8. `rasterizer`: bands in parallel, each with a small sample buffer that stays in the cache;
//! 9. `filter`: reconstruction filters wider than a pixel;
//! 10. `probe`: one pixel alone, with all its samples.
//!
//! # Number of values, and build time
//!
//! Lists, tables and shaders are generic over the number N of interpolated values, so layouts
//! cannot be mixed up. The loops over triangles, rows and samples are not: they read slices, and
//! are compiled once for each instruction set instead of once for each N, layer and pixel type.
//!
//! # Coverage
//!
//! A picture of W × H pixels with N × N samples each is a grid of W·N × H·N samples. Coordinates
//! are in sample units from the upper left corner of the picture, x to the right and y downwards;
//! sample (i, j) is at (i + ½, j + ½). A sample is in a polygon if a ray from the sample to the
//! left crosses the outline an odd number of times (the even-odd rule, so holes need no special
//! case). An edge covers the rows with y₀ ≤ y < y₁. Its crossing with a row is computed from its
//! upper end, whichever way the polygon winds: two faces that share an edge get the same bits, so
//! no sample between them is left out or drawn twice.
//!
//! # Depth
//!
//! The depth key is larger for what is nearer, and linear in the picture: 1/distance in
//! perspective, −distance in orthographic projection. It is compared per sample, so
//! intersecting faces come out right. Of equal keys the first drawn wins. Items that the caller
//! states to be in one plane ([`OpaqueLayer::planes`]) have no depth order: the first wins.

mod bins;
mod block;
mod depth_fade;
mod edges;
mod filter;
mod gradients;
mod grid;
mod layer;
mod outlines;
mod polygons;
mod probe;
mod progress;
mod rasterizer;
mod resolve;
mod rows;
mod shading;
mod tile;
mod transparency;
mod triangles;

pub use block::{BLOCK, BlockClasses, TriangleBlock};
pub use depth_fade::DepthFade;
pub use edges::Scanner;
pub use grid::{Bands, SampleGrid, TileShape};
pub use layer::{CornerTable, NoTriangles, OpaqueLayer, PolygonLayer, ShapeTarget};
pub use polygons::{
    Bounds, Corner, PolygonList, ScreenPoint, ShapeRef, TilePlace, greater, lesser,
};
pub use probe::{ProbedSample, ProbedSurface};
pub use progress::BandProgress;
pub use rasterizer::Rasterizer;
pub use resolve::{Center, PixelSamples, Resolve, ResolveSingle};
pub use shading::{Encoding, RUN, SampleShading, SampleStats, ShadedRun, ShadedSample};
pub use tile::{Area, Tile, VisibleItem};
pub use transparency::{
    Fragment, FragmentTarget, FragmentWriter, Keep, TRANSPARENT_VALUES, TransparentLayer,
};
