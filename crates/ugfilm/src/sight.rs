//! What is in view in the frames of a film, found from boxes around the bodies before any frame is
//! drawn, and a camera that follows.

use ugimage::Format;
use ugpicture::{Canvas, PictureOptions};
use ugpipe::Failure;
use ugscene::{
    BodyBoxes, CameraOptions, MotionError, MotionOptions, Scene, SeenBoxes, TimesInView,
};
use ugtrace::lens::Lens;

use crate::pipe::Pipe;
use crate::program::Program;
use crate::script::Script;
use crate::timeline::{Quantity, Timeline};

/// Most frames that are looked at.
const MOST_FRAMES: usize = 4096;

/// The bodies of a scene in the frames of a film.
pub struct Sight<'s> {
    script: &'s Script,
    boxes: BodyBoxes,
    /// The scene has neither faces nor wires.
    is_empty: bool,
}

/// The frames in which nothing is in the picture.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Unseen {
    /// How many frames were looked at.
    pub n_frames: usize,
    /// Those in which nothing is.
    pub frames: Vec<u32>,
    /// When moving bodies are in view of the first of them, on the clock of the observer.
    pub when: Option<TimesInView>,
}

/// How a frame is seen.
struct Shown {
    motion: MotionOptions,
    camera: CameraOptions,
    size: [u32; 2],
    is_flat: bool,
}

impl Shown {
    /// `None` of a panorama.
    fn new(pipe: &Pipe) -> Option<Self> {
        let canvas = Canvas::new(&pipe.picture).ok()?;
        let PictureOptions { size, camera: ref shown, .. } = *canvas.options();
        pipe.programs().iter().find_map(|program| {
            let motion = program.motion()?;
            let (camera, is_flat) = match program {
                Program::Lorentz(config) => {
                    let (eye, part) = (config.eye, shown.part);
                    (CameraOptions { eye, part, ..config.camera.clone() }, true)
                }
                Program::Photon(config) => (
                    shown.clone(),
                    config.lens == Lens::Pinhole
                        && config.stereo.is_none()
                        && config.crop.is_none(),
                ),
                _ => return None,
            };
            Some(Self { motion, camera, size, is_flat })
        })
    }

    fn seen(&self, boxes: &BodyBoxes) -> Result<SeenBoxes, MotionError> {
        boxes.seen(&self.motion, &self.camera, self.size)
    }
}

impl<'s> Sight<'s> {
    /// The bodies of a scene in a film.
    pub fn new(scene: &Scene, script: &'s Script) -> Self {
        let is_empty = scene.faces.is_empty() && scene.wires.is_empty();
        Self { script, boxes: BodyBoxes::new(scene), is_empty }
    }

    /// A frame that is wrong is reported when it is drawn.
    fn shown(&self, frame: f64) -> Option<Shown> {
        Shown::new(&self.script.pipe(frame, &[], Format::Png).ok()?)
    }

    /// The frames of these in which surely nothing is in the picture.
    pub fn unseen(&self, frames: &[u32]) -> Unseen {
        // The first frame says what the scene lacks.
        let frames = if self.is_empty { &[] } else { frames };
        let step = frames.len().div_ceil(MOST_FRAMES).max(1);
        let looked_at: Vec<u32> = frames.iter().copied().step_by(step).collect();
        let is_unseen = |frame: &u32| {
            let shown = self.shown(f64::from(*frame)).filter(|shown| shown.is_flat);
            shown.is_some_and(|shown| {
                shown.seen(&self.boxes).is_ok_and(|seen| seen.are_out_of_view())
            })
        };
        let n_frames = looked_at.len();
        let unseen: Vec<u32> = looked_at.into_iter().filter(is_unseen).collect();
        let first = unseen.first().and_then(|&frame| self.shown(f64::from(frame)));
        let when = first.and_then(|Shown { motion, camera, size, .. }| {
            self.boxes.times_in_view(&motion, &camera, size).ok().flatten()
        });
        Unseen { n_frames, frames: unseen, when }
    }

    /// The view centres of a camera that follows what moves, over the film.
    ///
    /// # Errors
    /// No frame has bodies in a direction.
    pub fn centers(&self) -> Result<Timeline, Failure> {
        let centers = self.over_film(|seen| Some(seen.center()?.to_array().to_vec()));
        centers
            .ok_or_else(|| Failure::failed("-follow: in no frame is there a body in any direction"))
    }

    /// [`SeenBoxes::speeds`] over the film; `None` if all frames are wrong.
    pub fn speeds(&self) -> Option<Timeline> {
        self.over_film(|seen| Some(seen.speeds().to_vec()))
    }

    /// Numbers of the frames over the film; `None` if no frame has any.
    fn over_film(&self, numbers: impl Fn(&SeenBoxes) -> Option<Vec<f64>>) -> Option<Timeline> {
        let n_frames = self.script.n_frames;
        let step = (n_frames as usize).div_ceil(MOST_FRAMES).max(1);
        let key = |frame: u32| {
            let seen = self.shown(f64::from(frame))?.seen(&self.boxes).ok()?;
            Some((self.script.time(f64::from(frame)), numbers(&seen)?))
        };
        let frames = (1..n_frames).step_by(step).chain([n_frames]);
        let keys: Vec<_> = frames.filter_map(key).collect();
        if keys.is_empty() { None } else { Timeline::through(keys, Quantity::Plain).ok() }
    }
}
