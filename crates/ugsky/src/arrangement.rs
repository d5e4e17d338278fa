//! How directions are arranged in pictures.

/// How directions are arranged in a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Arrangement {
    /// Longitude across, latitude down.
    #[default]
    Equirectangular,
    /// Six squares from left to right: right, left, up, down, front, back.
    Strip,
    /// A cube unfolded around its front: four squares across and three down, or three across and
    /// four down.
    Cross,
    /// A file for each side: right, left, up, down, front, back.
    Sides,
}

impl Arrangement {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Equirectangular, Self::Strip, Self::Cross, Self::Sides];

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Equirectangular => "panorama",
            Self::Strip => "strip",
            Self::Cross => "cross",
            Self::Sides => "sides",
        }
    }

    /// Number of files.
    pub fn n_files(self) -> usize {
        if self == Self::Sides { 6 } else { 1 }
    }

    /// The arrangement in one file of a picture by the ratio of its sides: a strip is six times as
    /// wide as high, a cross 4 : 3 or 3 : 4, all others are panoramas.
    pub fn of_size([width, height]: [u32; 2]) -> Self {
        let [width, height] = [width, height].map(u64::from);
        if width == 6 * height {
            Self::Strip
        } else if 3 * width == 4 * height || 4 * width == 3 * height {
            Self::Cross
        } else {
            Self::Equirectangular
        }
    }
}
