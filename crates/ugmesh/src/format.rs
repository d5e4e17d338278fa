//! Formats that are written.

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
    /// The output format for a file extension.
    pub fn by_ending(path: &Path) -> Option<Self> {
        match path.extension()?.to_str()?.to_ascii_lowercase().as_str() {
            "ug" => Some(Self::Ug),
            "obj" => Some(Self::Obj),
            "ply" => Some(Self::Ply { is_ascii: false }),
            "gltf" => Some(Self::Gltf),
            "glb" => Some(Self::Glb),
            "vtp" => Some(Self::Vtp),
            _ => None,
        }
    }

    /// The name of the format in arguments.
    pub fn name(self) -> &'static str {
        match self {
            Self::Ug => "ug",
            Self::Obj => "obj",
            Self::Ply { .. } => "ply",
            Self::Gltf => "gltf",
            Self::Glb => "glb",
            Self::Vtp => "vtp",
        }
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
