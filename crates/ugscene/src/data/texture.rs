//! Pictures on surfaces.

use std::sync::Arc;

use super::ids::ColorId;

/// A colour that is a picture, spread over faces by the texture coordinates of their corners:
/// `c_tex`. The statement of the colour itself in [`crate::Scene::colors`] is what it is where no
/// texels are drawn.
///
/// The linear light of a point is texel × factor × colour of the vertices, where these have colours
/// of their own.
#[derive(Clone, Debug, PartialEq)]
pub struct Texture {
    /// The colour.
    pub color: ColorId,
    /// The picture.
    pub image: TextureImage,
    /// What is beyond its edges, along u and v.
    pub wrap: [Wrap; 2],
    /// Factor of linear red, green and blue, and of alpha; 0 or more.
    pub factor: [f32; 4],
    /// The meaning of alpha.
    pub alpha: AlphaMode,
    /// Where texels are larger than samples, they are flat squares, not interpolated.
    pub is_nearest: bool,
}

impl Texture {
    /// A picture as it is, repeated, without alpha.
    pub fn new(color: ColorId, image: TextureImage) -> Self {
        Self {
            color,
            image,
            wrap: [Wrap::Repeat; 2],
            factor: [1.0; 4],
            alpha: AlphaMode::Opaque,
            is_nearest: false,
        }
    }
}

/// The file of a picture.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct TextureImage {
    /// Its path from the current folder; `None` of a picture within a mesh whose name is not known.
    pub file: Option<String>,
    /// The row of a picture within a mesh, which is then the file.
    pub row: Option<u32>,
    /// Its bytes; empty if the files of the scene were not read.
    pub bytes: Arc<[u8]>,
}

/// What is beyond the edges of a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Wrap {
    /// The picture again.
    #[default]
    Repeat,
    /// The colour of the edge.
    Clamp,
    /// The picture mirrored.
    Mirror,
}

impl Wrap {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Repeat, Self::Clamp, Self::Mirror];

    /// Its name in the text.
    pub fn name(self) -> &'static str {
        match self {
            Self::Repeat => "repeat",
            Self::Clamp => "clamp",
            Self::Mirror => "mirror",
        }
    }
}

/// The meaning of alpha in a picture, as in glTF.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum AlphaMode {
    /// None: the surface is opaque.
    #[default]
    Opaque,
    /// The surface is where alpha is this or more, and opaque there.
    Mask(f32),
    /// The part of the light from behind that is hidden.
    Blend,
}
