//! Where the frames of a film go: numbered files, one file, or a sheet.

use std::path::Path;

use ugimage::Format;
use ugpicture::cli::format_for;
use ugpipe::Failure;
use ugsheet::film::{FilmKind, FrameNames};

/// Where frames go.
pub enum Output {
    /// Numbered files.
    Files(FrameNames, Format),
    /// One file.
    Film(FilmKind),
    /// Several frames on one picture.
    Sheet,
}

impl Output {
    /// The output for a format (`-dt`) and the name of a file.
    ///
    /// # Errors
    /// The format is not known, or does not suit the name.
    pub fn new(format: Option<&str>, is_sheet: bool, file: Option<&Path>) -> Result<Self, Failure> {
        if is_sheet {
            let is_png = format.is_none_or(|name| name == "png")
                && file.is_none_or(|path| path.extension().is_some_and(|ending| ending == "png"));
            return if is_png {
                Ok(Self::Sheet)
            } else {
                Err(Failure::usage("-sheet writes a PNG: give -fo FILE.png"))
            };
        }
        let name = file.map(|path| path.to_string_lossy().into_owned());
        let names = name.as_deref().and_then(FrameNames::new);
        let ending =
            file.and_then(Path::extension).map(|ending| ending.to_string_lossy().into_owned());
        let word = format.map(str::to_owned).or(ending);
        let kind = word.as_deref().and_then(FilmKind::from_name);
        match (names, kind) {
            (None, Some(kind)) => Ok(Self::Film(kind)),
            // Pictures of this format are single frames, too.
            (Some(names), None | Some(FilmKind::Ppm)) => {
                let given = format.map(ugpicture::cli::format_named).transpose();
                Ok(Self::Files(names, format_for(given.map_err(Failure::usage)?, file)?))
            }
            (Some(_), Some(kind)) => Err(Failure::Usage(format!(
                "{} is a whole film, not a frame: give a name without %d, or frames in png",
                kind.name()
            ))),
            (None, None) => {
                let kinds = FilmKind::ALL.map(FilmKind::name).join(", ");
                let other = word
                    .map(|word| format!("`{word}` is not a kind of film; "))
                    .unwrap_or_default();
                Err(Failure::Usage(format!(
                    "{other}give numbered files, -fo frame_%04d.png, or a film: -fo FILE or -dt with {kinds}"
                )))
            }
        }
    }

    /// The format of a frame.
    pub fn frame_format(&self) -> Format {
        match self {
            Self::Files(_, format) => *format,
            Self::Film(_) | Self::Sheet => Format::Png,
        }
    }

    /// The files of frames, if there are any.
    pub fn names(&self) -> Option<&FrameNames> {
        match self {
            Self::Files(names, _) => Some(names),
            Self::Film(_) | Self::Sheet => None,
        }
    }

    /// The files of single frames, those of a film as they could be named.
    pub fn frame_names(&self) -> FrameNames {
        self.names().cloned().unwrap_or_default()
    }
}

/// The pattern of numbered PNG files of an option.
///
/// # Errors
/// It has no number, or names files of another kind.
pub fn names_of(pattern: &str, option: &str) -> Result<FrameNames, Failure> {
    let is_png = pattern.to_ascii_lowercase().ends_with(".png");
    FrameNames::new(pattern).filter(|_| is_png).ok_or_else(|| {
        Failure::Usage(format!(
            "{option} names numbered PNG files, such as frame_%04d.png, not `{pattern}`"
        ))
    })
}
