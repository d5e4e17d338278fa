//! Geometry in the picture plane: convex polygons with depth, decomposition into them, and a
//! spatial index of their bounding boxes.

mod box_index;
mod clip;
mod convex;
mod cover;
mod decompose;

pub use box_index::BoxIndex;
pub use clip::clip_edges;
pub use convex::{Convex, DepthOrder, doubled_area, sides};
pub use cover::is_covered;
pub use decompose::{MOST_CROSSED_PARTS, clipped_to_picture, convex_parts};
pub use ugpicture::DepthPoint;
