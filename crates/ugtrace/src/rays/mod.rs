//! What a ray into the past meets: faces of bodies with one velocity by a hierarchy of their
//! triangles at rest, and bodies on world lines, in whose coordinates rays are curves.
//!
//! `path`: rays; `rounds`: round faces; `world`: all bodies; `part`: one of them, or all with one
//! velocity; `sphere`, `moving_boxes` and `corridor`: bodies that rays cannot meet;
//! `world_line_part`: bodies that accelerate, spin or orbit. Rays from a pinhole find inertial
//! faces faster by [`crate::outlines`], if these are large.

mod corridor;
mod moving_boxes;
mod part;
mod path;
mod rounds;
mod sphere;
mod world;
mod world_line_part;

pub use corridor::Corridor;
pub use moving_boxes::{MovingBox, MovingBoxes, Rays};
pub use part::{FaceTriangle, Faces, Intersection, Part};
pub use path::{PastRay, Start, along};
pub use world::{PacketMemory, World};
pub use world_line_part::{SeenMesh, WorldLineMotion};
