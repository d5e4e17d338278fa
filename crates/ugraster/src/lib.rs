//! A rasterizer: polygons in the picture plane in, pixels out.
//!
//! It draws on a grid of samples, several to a pixel, with a depth test at each sample. It knows
//! no scenes, cameras or colours: corners carry a depth key and N numbers ([`Corner`]), and a
//! [`Shading`] turns the N interpolated numbers of a sample into linear light. [`Finish`] makes a
//! pixel of the light of its samples, so the caller decides about backgrounds and pixel formats.
//! Output is the same bits on any number of threads and on every processor.
//!
//! # Example
//!
//! Two triangles that intersect, one bright at the left and one dark at the right, with one sample
//! to a pixel. The nearer one is seen at each pixel:
//!
//! ```
//! use ugraster::{Corner, Gathered, Grid, NoTable, PolygonList, Scale, Shade, Shades, Shading};
//! use ugraster::{Shapes, paint};
//!
//! /// The only interpolated number is grey light.
//! struct Grey;
//!
//! impl Shading<1> for Grey {
//!     fn shade(&self, [greys]: [&[f32]; 1], _scale: Scale, shades: &mut Shades) {
//!         for (sample, &grey) in greys.iter().enumerate() {
//!             shades.set(sample, Shade { light: [grey; 3], intensity: grey, is_out_of_range: false });
//!         }
//!     }
//! }
//!
//! // Depth keys of an orthographic view: larger is nearer.
//! let grid = Grid { width: 9, height: 5, samples: 1, is_perspective: false, cue: None };
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
//! let layer = Shapes { lists: &[polygons], table: &NoTable };
//! let finish = |all: &Gathered<'_, ()>| all.sum[0];
//! let (pixels, tally) = paint(&grid, &layer, None, &Grey, &finish, &());
//! let row = &pixels[2 * 9..3 * 9];
//! assert_eq!(row[..4], [0.75; 4]);
//! assert_eq!(row[5..], [0.25; 4]);
//! assert_eq!(tally.visible, tally.covered);
//! ```
//!
//! # Steps
//!
//! 1. `polygons`: polygons in buffers, sorted into bands of pixel rows (`bins`);
//! 2. `edges`: crossings of a polygon's outline with a row of samples;
//! 3. `spans`: the samples between two crossings, and the depth test;
//! 4. `triangles`: a shorter way for triangles, the usual case, in blocks of eight: `block`
//!    classifies them, `sides` intersects their outlines with rows, `slopes` finds how numbers
//!    change over the picture, `rows` draws samples;
//! 5. `transparency`: transparent faces and lines, kept per sample (an A-buffer);
//! 6. `shading`: the light of samples, many at once;
//! 7. `resolve`: the samples of a pixel averaged in linear light, with depth cueing (`cue`);
//! 8. `band`: bands in parallel, each with a small sample buffer that stays in the cache;
//! 9. `filter`: reconstruction filters wider than a pixel;
//! 10. `probe`: one pixel alone, with all its samples.
//!
//! A sample can also store which item it shows ([`Tag`]); unless it does, that costs nothing.
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
//! intersecting faces come out right. Of equal keys the first drawn wins.

mod band;
mod bins;
mod block;
mod cue;
mod edges;
mod filter;
#[cfg(test)]
mod noise;
mod polygons;
mod probe;
mod progress;
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
pub use progress::Progress;
pub use resolve::{Direct, Finish, Gathered};
pub use shading::{RUN, Scale, Shade, Shades, Shading, Tally};
pub use spans::{Seen, Sink, Tag};
pub use transparency::{Fragment, FragmentTarget, TRANSPARENT_VALUES, TransparentLayer};
pub use triangles::{NoTable, Point, Table};
