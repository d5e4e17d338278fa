//! Errors and reports, with the options that correct what is wrong.

use ugparse::{Diagnostic, Diagnostics, Origins, Source};
use ugpipe::Words;
use ugscene::{CameraError, Note};

use crate::adaptive::MAX_PIECES;
use crate::criterion::MAX_GENERATION;
use crate::{Error, Report};

const AT_EYE: &str = "move the eye (-ep) or the vertex";
const OUT_OF_RANGE: &str = "use smaller coordinates, a smaller time (-ti) or a lower speed";

impl Words for Error {
    fn words(&self) -> String {
        match self {
            Self::Motion(error) => error.words(),
            Self::Camera(error) => error.words(),
            Self::NoViewCenter => {
                "-cull needs the view centre of the camera: give it with -vc, or in the `cam` \
                                   statement of the scene"
                    .to_owned()
            }
            Self::NoBound { error } => {
                format!("the bound of -se is {} milliradians: give a number above 0", error * 1e3)
            }
            Self::NoPixelBound { pixels } => {
                format!("the bound of -se is {pixels} pixels: give a number above 0")
            }
            Self::NoColorBound { error } => {
                format!(
                    "the bound of -sc is {} percent: give a number above 0, or off",
                    error * 1e2
                )
            }
            Self::NoLightBound { error } => {
                format!(
                    "the bound of -sl is {} percent: give a number above 0, or off",
                    error * 1e2
                )
            }
            Self::NoPieces => "-sd 0 would make no pieces: give 1 or more".to_owned(),
            Self::TooManyParts => format!("{self}: give faces vertices of their own, or use -sd 1"),
            Self::TooManyPieces { n_pieces } => format!(
                "-sd would make {n_pieces} pieces, more than the limit of {MAX_PIECES}: give fewer, or use -se, \
                 which subdivides only where it is visible"
            ),
            Self::NoFrame { .. } => {
                format!("{self}: --measured takes camera, scene, or the name of a motion")
            }
            Self::NoFrameEye { .. } => format!("{self}: give the place of the eye on it, -ep"),
            Self::VertexAtEye { .. } => format!("{self}: {AT_EYE}"),
            Self::OutOfRange { .. } => format!("{self}: {OUT_OF_RANGE}"),
            Self::TooManyPolygons(_) => {
                format!("{self}: give -sd 1, and draw with -xc")
            }
            Self::Stopped(_) => self.to_string(),
        }
    }

    fn is_usage(&self) -> bool {
        let Error::Motion(error) = self else {
            return matches!(
                self,
                Error::Camera(CameraError::NoUp)
                    | Error::NoViewCenter
                    | Error::NoBound { .. }
                    | Error::NoPixelBound { .. }
                    | Error::NoColorBound { .. }
                    | Error::NoLightBound { .. }
                    | Error::NoPieces
                    | Error::NoFrame { .. }
                    | Error::NoFrameEye { .. }
                    | Error::TooManyPieces { .. }
            );
        };
        error.is_usage()
    }
}

impl Error {
    /// The error with its place in the text of the scene; `None` if it is not about a vertex.
    pub fn diagnostics(&self, source: &Source, origins: &Origins) -> Option<Diagnostics> {
        let (row, remedy) = match self {
            Self::VertexAtEye { row, .. } => (row, AT_EYE),
            Self::OutOfRange { row, .. } => (row, OUT_OF_RANGE),
            _ => return None,
        };
        let finding =
            Diagnostic::error(*origins.vertices.get(*row)?, self.to_string()).label("this vertex");
        Some(Diagnostics::one(source, finding.help(remedy)))
    }
}

impl Report {
    /// Messages about results that are not as requested.
    pub fn warnings(&self) -> Vec<String> {
        let mut warnings = Vec::new();
        let left = match &self.remaining_errors {
            Some(errors) => format!("; errors left: {errors}"),
            None => String::new(),
        };
        if self.is_full {
            warnings.push(format!(
                "subdivision stopped at {} pieces: the error of some edges is above the bound; \
                 a larger bound (-se) needs fewer pieces{left}",
                self.max_pieces
            ));
        }
        if self.n_uncut > 0 {
            warnings.push(format!(
                "{} faces are right at their edges only: their contours intersect or enclose no area, so they \
                 cannot be subdivided; correct them{left}",
                self.n_uncut
            ));
        }
        if self.n_too_deep > 0 {
            warnings.push(format!(
                "the error of {} edges is above the bound after {MAX_GENERATION} halvings: they pass close to \
                 the eye, or colours change by orders of magnitude along them; if it is visible, move the eye \
                 (-ep), reduce the speed, or bound only shapes (-sc off){left}",
                self.n_too_deep
            ));
        }
        warnings
    }

    /// The choices made for the user, and what they leave open.
    pub fn notes(&self) -> Vec<String> {
        let camera = self.default_camera.map(|camera| Note::DefaultCamera(camera).words());
        let junctions = (self.n_open_junctions > 0).then(|| {
            format!(
                "-sd leaves cracks where vertices of other faces are on an edge (edges: {}): give -se instead, \
                 which cuts them there",
                self.n_open_junctions
            )
        });
        let rounds = self.are_rounds_cut.then(|| {
            "round faces of bodies that accelerate or turn are drawn as polygons, within the bound of -se or \
             1/4000 of their radius"
                .to_owned()
        });
        let moment = self.momentary_frame.as_ref().map(|(name, time)| {
            format!(
                "`{name}` accelerates or turns: measured in the frame in which it is at rest at its time {time}"
            )
        });
        camera.into_iter().chain(junctions).chain(rounds).chain(moment).collect()
    }

    /// Statistics, for `-vb`.
    pub fn details(&self) -> Vec<String> {
        let added = format!(
            "subdivision added {} faces and {} vertices",
            self.n_new_faces, self.n_new_vertices
        );
        let errors = self.remaining_errors.as_ref().map(|errors| format!("errors left: {errors}"));
        let culled = (self.n_culled > 0)
            .then(|| format!("removed {} faces outside the view", self.n_culled));
        let whole = self.is_whole.then(|| {
            "faces with curved edges are whole: a ray is drawn for each sample".to_string()
        });
        [added].into_iter().chain(whole).chain(culled).chain(errors).collect()
    }
}
