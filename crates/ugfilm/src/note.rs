//! Notes of the programs of a frame.

/// A note of a program on a frame.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Note {
    /// From `uglorentz`.
    Lorentz(Box<uglorentz::Report>),
    /// From `ugdoppler`.
    Doppler(ugdoppler::Note),
    /// From the program of this name, which drew the picture.
    Picture(&'static str, ugpicture::Note),
}

impl Note {
    /// The note of the program that drew the picture.
    pub fn of_picture(&self) -> Option<&ugpicture::Note> {
        match self {
            Self::Picture(_, note) => Some(note),
            Self::Lorentz(_) | Self::Doppler(_) => None,
        }
    }
}

#[cfg(feature = "cli")]
impl Note {
    /// Sentences that begin with the name of the program.
    pub fn words(&self) -> Vec<String> {
        use ugpipe::Words;

        let (program, words) = match self {
            Self::Lorentz(report) => {
                (uglorentz::PROVENANCE.program, [report.warnings(), report.notes()].concat())
            }
            Self::Doppler(note) => (ugdoppler::PROVENANCE.program, vec![note.words()]),
            Self::Picture(program, note) => (*program, vec![note.words()]),
        };
        words.into_iter().map(|words| format!("{program}: {words}")).collect()
    }
}
