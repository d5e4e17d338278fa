//! Kinds of films.

/// The kind of a film.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FilmKind {
    /// Animated PNG, all colours.
    Apng,
    /// GIF, 256 colours.
    Gif,
    /// Uncompressed frames with a header (YUV4MPEG2), 4:4:4, BT.709.
    Y4m,
    /// PPM pictures, one behind the other.
    Ppm,
    /// A page with a slider over the pictures.
    Html,
    /// A format that ffmpeg writes.
    Mp4,
    /// A format that ffmpeg writes.
    Webm,
}

impl FilmKind {
    /// All of them.
    pub const ALL: [Self; 7] =
        [Self::Apng, Self::Gif, Self::Y4m, Self::Ppm, Self::Html, Self::Mp4, Self::Webm];

    /// Its name, which is the ending of its files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Apng => "apng",
            Self::Gif => "gif",
            Self::Y4m => "y4m",
            Self::Ppm => "ppm",
            Self::Html => "html",
            Self::Mp4 => "mp4",
            Self::Webm => "webm",
        }
    }

    /// The kind of this name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.name().eq_ignore_ascii_case(name))
    }

    /// True if a pixel can be transparent.
    pub fn has_alpha(self) -> bool {
        matches!(self, Self::Apng | Self::Gif | Self::Html | Self::Webm)
    }

    /// True if ffmpeg writes it.
    pub fn is_encoded(self) -> bool {
        matches!(self, Self::Mp4 | Self::Webm)
    }
}
