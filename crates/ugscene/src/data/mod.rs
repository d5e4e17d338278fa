//! The data model: a scene, its bodies, and what filters have done to it.

mod body;
mod color_table;
mod contours;
mod history;
mod ids;
mod motion;
mod names;
mod scene;
mod shape;
mod stage;
mod surface;
mod texture;

pub use body::{Bodies, Body};
pub use color_table::{ColorTable, TablePlace};
pub use contours::Contours;
pub use history::{Head, Provenance, recorded};
pub use ids::{BodyId, ColorId, NameId, ShadingId, SurfaceId, VertexId};
pub use motion::{Carrier, CurveKind, MotionPath, StatedMotion};
pub use names::{Names, UniqueNames};
pub use scene::{
    Beam, Camera, Color, ColorValue, Face, FaceOrWire, Light, LightKind, LightMotion, Mix,
    NAMED_SKIES, Projection, Scene, Shading, StatedSky, Tint, Vertex, Wire,
};
pub use shape::{FaceShape, RoundShape};
pub use stage::{
    ColorScale, ColorStage, GeometryStage, HueScale, MixtureNames, SeenColors, SeenGeometry, Stage,
};
pub use surface::{SurfaceNumber, SurfaceProperties};
pub use texture::{AlphaMode, Texture, TextureImage, Wrap};
