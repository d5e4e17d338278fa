//! Errors, with the options that correct them.

use ugpipe::{Words, remedies};

use crate::Error;

impl Words for Error {
    fn words(&self) -> String {
        let words = match self {
            Self::Scene(_) | Self::TooManyPolygons(_) => "{}",
            Self::Picture(error) => return error.words(),
            Self::Stage(error) => return error.words(),
            Self::Sky(error) => return error.words(),
            Self::ExplainExact => remedies::EXPLAIN_EXACT,
            Self::ExactSeenColors => remedies::EXACT_SEEN_COLORS,
            Self::ExactPartialGeometry => remedies::EXACT_PARTIAL_GEOMETRY,
            Self::ExactOrthographic => "{}: leave out -xc, or -og (in the scene, too)",
            Self::ExactMovingSpectrum => {
                "{}: give -sp to shift all colours as spectra, or --no-doppler --no-flux to see the shape"
            }
            Self::FigureBackground => "{}: give -bg 1, for paper, in place of -tb",
            Self::CrossedFaces => {
                "{}: leave out -vec and lines, or cut these faces into ones that do not cross themselves"
            }
            Self::FigureFaces | Self::FigureOverlaps => {
                "{}: leave out -vec, and give a larger -sz for print"
            }
        };
        words.replacen("{}", &self.to_string(), 1)
    }

    fn is_usage(&self) -> bool {
        match self {
            Self::Picture(error) => error.is_usage(),
            Self::Sky(error) => error.is_usage(),
            Self::ExplainExact => true,
            _ => false,
        }
    }

    fn report(&self) -> Option<String> {
        match self {
            Self::Scene(diagnostics) => Some(diagnostics.report()),
            _ => None,
        }
    }
}
