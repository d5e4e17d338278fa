//! Formats that are written.

use std::mem::discriminant;
use std::path::Path;

use ugmeshfile::Axis;

/// An output format.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Target {
    /// UniGrafix.
    #[default]
    Ug,
    /// Wavefront OBJ with vertex colours.
    Obj,
    /// Stanford PLY.
    Ply {
        /// Whether it is ASCII text rather than binary.
        is_ascii: bool,
    },
    /// glTF 2.0 as JSON with an embedded buffer.
    Gltf,
    /// glTF 2.0 as binary GLB.
    Glb,
    /// VTK XML polygon data.
    Vtp,
}

impl Target {
    /// The names of the formats in arguments, which are also their file extensions.
    pub const NAMES: [(&'static str, Self); 6] = [
        ("ug", Self::Ug),
        ("obj", Self::Obj),
        ("ply", Self::Ply { is_ascii: false }),
        ("gltf", Self::Gltf),
        ("glb", Self::Glb),
        ("vtp", Self::Vtp),
    ];

    /// The output format for a file extension.
    pub fn by_ending(path: &Path) -> Option<Self> {
        let ending = path.extension()?;
        Self::NAMES.into_iter().find(|(name, _)| ending.eq_ignore_ascii_case(name)).map(|row| row.1)
    }

    /// The name of the format in arguments.
    pub fn name(self) -> &'static str {
        let is_it = |row: &&(&str, Self)| discriminant(&row.1) == discriminant(&self);
        Self::NAMES.iter().find(is_it).map_or("", |row| row.0)
    }

    /// True if the format is binary.
    pub fn is_binary(self) -> bool {
        matches!(self, Self::Glb | Self::Ply { is_ascii: false })
    }

    /// The default up axis of the output.
    pub fn up(self) -> Axis {
        match self {
            Self::Obj | Self::Gltf | Self::Glb => Axis::Y,
            Self::Ug | Self::Ply { .. } | Self::Vtp => Axis::Z,
        }
    }

    /// True if the format has pictures on surfaces.
    pub(crate) fn has_textures(self) -> bool {
        matches!(self, Self::Gltf | Self::Glb)
    }

    /// True if the format has cameras.
    pub(crate) fn has_camera(self) -> bool {
        matches!(self, Self::Gltf | Self::Glb)
    }
}
