//! Scan conversion: polygons in the picture plane to pixels.
//!
//! The rasterizer knows nothing of scenes and colours. It is given layers ([`Layer`]), above all polygons whose
//! corners carry a depth key and N numbers ([`Corner`]), and a shader that turns N
//! interpolated numbers into light; what becomes of a pixel's light is decided by who calls. Its steps, one
//! file each:
//!
//! 1. [`polygons`]: polygons in buffers, sorted into bands of pixel rows;
//! 2. [`edges`]: where a polygon's outline crosses a row of samples;
//! 3. [`spans`]: the samples between two crossings, and the depth test;
//! 4. [`triangles`]: the same for triangles, the usual case, shorter: eight of them in a [`block`], their [`sides`],
//!    [`slopes`] of numbers over the picture, and samples row by row ([`rows`]), all many at once;
//! 5. [`transparency`]: translucent faces and lines in front of them, sample by sample;
//! 6. [`shading`]: the light of samples, many at once;
//! 7. [`resolve`]: samples to pixels, averaged in linear light, what is far faded ([`cue`]);
//! 8. [`band`]: bands in parallel, each with its own small sample buffer;
//! 9. [`filter`]: pixels that weigh samples of their neighbours, too;
//! 10. [`probe`]: one pixel alone, with all its samples.
//!
//! A sample can also remember whose it is ([`Tag`]); where nobody asks, that costs nothing.
//!
//! # Which sample belongs to whom
//!
//! A picture of W × H pixels with N × N samples each is a grid of W·N × H·N samples;
//! sample (i, j) sits at (i + ½, j + ½) in sample units. Coordinates of corners are in
//! these units too. A sample belongs to a polygon if a walk from the left
//! meets the outline an odd number of times at or before it (even-odd rule, so holes
//! need no special case). An edge counts for the rows in y₀ ≤ y < y₁. The crossing of
//! an edge with a row is computed from its upper end, whichever way the polygon runs
//! round: two faces that share an edge get the same bits, so no
//! sample is left out between them and none is drawn twice.
//!
//! # Depth
//!
//! The key is larger for what is nearer, and linear in the picture: 1/distance in
//! perspective, −distance in orthographic projection. It is compared per sample, so
//! faces that cut through each other come out right. Of equals the first drawn stays.

mod band;
mod bins;
mod block;
mod cue;
mod edges;
mod filter;
mod polygons;
mod probe;
mod resolve;
mod rows;
mod shading;
mod sides;
mod slopes;
mod spans;
#[cfg(test)]
mod tests;
mod transparency;
mod triangles;

pub use band::{Grid, Layer, Shapes, paint};
pub use bins::Bins;
pub use block::{BLOCK, Block};
pub use cue::Cue;
pub use edges::Scanner;
pub use filter::{Filter, paint_filtered, probe_filtered};
pub use polygons::{Bounds, Corner, Drawn, PolygonList, greater, lesser};
pub use probe::{Sample, probe};
pub use resolve::{Direct, Finish, Gathered};
pub use shading::{RUN, Scale, Shade, Shades, Shading, Tally};
pub use spans::{Seen, Sink, Tag};
pub use transparency::{Fragment, FragmentTarget, TRANSPARENT_VALUES, TransparentLayer};
pub use triangles::{NoTable, Point, Table};
