//! From a scene and a script to a film.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::{Mutex, PoisonError};

use ugimage::{
    Format, Frame, LinearFrame, PictureLimits, auto_exposure, read_png, read_png_header,
};
use ugpicture::{Background, Exposure, Rendering, levels_note};
use ugpipe::{Context, Failure, Progress, Steps, Words, sha256};
use ugsheet::film::{Caption, FilmFile, FilmKind, FilmShape, FrameNames};
use ugsheet::{Config, Motion, Picture, Sheet};

use crate::blur::{MotionBlur, Shot, is_made_of_light};
use crate::error::Error;
use crate::exposure::smoothed;
use crate::frame_files::{claim, is_done, read_done, remove_stale_claims};
use crate::levels::WrongBrightness;
use crate::note::Note;
use crate::pipe::{DrawnLight, Pipe};
use crate::script::{DONE_TO_LIGHT, Script};
use crate::series::Subjects;
use crate::surround::surround;
use crate::work::in_order;

/// Largest number of frames whose commands are checked before the first frame is drawn.
const MOST_CHECKED: usize = 64;

/// Frames from which the exposure of a film is chosen.
const MOST_MEASURED: u32 = 48;

/// Frames whose exposure is metered, of a film whose exposure follows.
const MOST_METERED: u32 = 250;

/// Longest side of these frames, in pixels.
const MEASURED_SIDE: u32 = 128;

/// Stops by which an exposure that follows is below the metered one, if this changes so much. Small
/// pictures lack the smallest highlights, and light just below white is shown as white in 8 bits:
/// in films of street.ug and tunnel.ug at 0.9c and 0.95c up to 1.4 % of a frame were white without
/// it, with it 0.7 %.
const BELOW_METERED: f64 = 0.2;

/// Memory for the light of the frames of a film whose exposure is chosen, in bytes.
const MOST_LIGHT: u64 = 1 << 29;

/// A film that can be drawn.
pub struct Film<'s> {
    /// The subjects of its frames.
    pub subjects: Subjects<'s>,
    /// The commands of its frames.
    pub script: &'s Script,
    /// The format of single frames.
    pub format: Format,
    /// How long its shutter is open; otherwise a frame is the picture of one moment.
    pub blur: Option<MotionBlur>,
    /// See [`MeasuredExposure::light`].
    pub light: HeldLight,
}

/// The light of frames by number, which are removed as they are developed.
pub type HeldLight = Mutex<BTreeMap<u32, DrawnLight>>;

/// The outcome of all frames.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Summary {
    /// Frames that were drawn.
    pub n_drawn: u32,
    /// Frames whose files were there.
    pub n_done: u32,
    /// Frames that another process draws.
    pub n_elsewhere: u32,
    /// Notes of the first frame that was drawn.
    pub notes: Vec<Note>,
    /// Frames that were drawn in which nothing is.
    pub empty: Vec<u32>,
    /// Frames that were drawn in which all is black.
    pub black: Vec<u32>,
    /// Other frames that were drawn, whose brightness is wrong.
    pub wrong: WrongBrightness,
}

/// The exposure of a film.
#[derive(Debug, Default)]
pub struct MeasuredExposure {
    /// In stops, at frames in ascending order; a single one holds for the whole film.
    pub stops: Vec<(u32, f64)>,
    /// How many frames were measured.
    pub n_frames: usize,
    /// Those whose brightness is wrong at this exposure.
    pub wrong: WrongBrightness,
    /// The light of frames that were measured in full size.
    pub light: HeldLight,
}

/// The outcome of a frame.
enum Outcome {
    Drawn(Vec<Note>),
    Done,
    Elsewhere,
}

impl Summary {
    fn add(&mut self, frame: u32, outcome: Outcome) {
        match outcome {
            Outcome::Drawn(notes) => {
                for note in notes.iter().filter_map(Note::of_picture) {
                    if note.is_of_empty() {
                        self.empty.push(frame);
                    } else if note.is_of_black() {
                        self.black.push(frame);
                    }
                    self.wrong.add(frame, note);
                }
                if self.n_drawn == 0 {
                    self.notes = notes;
                }
                self.n_drawn += 1;
            }
            Outcome::Done => self.n_done += 1,
            Outcome::Elsewhere => self.n_elsewhere += 1,
        }
    }
}

impl Film<'_> {
    fn pipe(&self, frame: u32) -> Result<Pipe, Failure> {
        self.script.pipe(f64::from(frame), &[], self.format)
    }

    /// The moments whose mean a frame is, in frames; `None` without motion blur.
    pub fn moments(&self, frame: u32) -> Option<Vec<f64>> {
        let ends = [1.0, f64::from(self.script.n_frames)];
        let ends = if self.script.is_loop { [f64::NEG_INFINITY, f64::INFINITY] } else { ends };
        self.blur.map(|blur| blur.moments(frame, ends))
    }

    fn shot(&self, frame: u32) -> Result<Shot, Failure> {
        let pipe = |moment: f64| {
            Ok::<_, Failure>((moment, self.script.pipe(moment, DONE_TO_LIGHT, self.format)?))
        };
        let moments = self.moments(frame).unwrap_or_default().into_iter().map(pipe);
        let moments = moments.collect::<Result<_, _>>()?;
        Ok(Shot { number: frame, moments, frame: self.pipe(frame)? })
    }

    fn file(&self, frame: u32) -> Result<Vec<u8>, Failure> {
        Ok(self.draw(frame, self.shot(frame)?)?.0.into_file())
    }

    fn draw(&self, frame: u32, shot: Shot) -> Result<(Rendering, Vec<Note>), Failure> {
        let light = self.light.lock().unwrap_or_else(PoisonError::into_inner).remove(&frame);
        shot.draw(self.subjects, light)
    }

    /// Width and height of all frames.
    ///
    /// # Errors
    /// The commands of the first frame are wrong, or the size changes.
    pub fn size(&self) -> Result<[u32; 2], Failure> {
        let size = |frame| Ok::<_, Failure>(about(frame, self.pipe(frame))?.picture.size);
        let first = size(1)?;
        if size(self.script.n_frames)? != first {
            return Err(Failure::usage("all frames of a film have one size: give one -sz"));
        }
        Ok(first)
    }

    /// Checks the commands of some of the frames, so that a wrong one is found before anything
    /// is written.
    ///
    /// # Errors
    /// The commands of a frame are wrong.
    fn check(&self, frames: &[u32]) -> Result<(), Failure> {
        let step = frames.len().div_ceil(MOST_CHECKED).max(1);
        let checked = frames.iter().step_by(step).chain(frames.last());
        checked
            .into_iter()
            .try_for_each(|&frame| about(frame, self.shot(frame)?.check().map_err(Failure::of)))
    }

    /// At most `most` frames spread evenly over the film, among them the first and the last.
    pub fn spread(&self, most: u32) -> Vec<u32> {
        let last = self.script.n_frames - 1;
        let count = self.script.n_frames.min(most);
        let steps = u64::from(count.max(2) - 1);
        (0..count).map(|row| 1 + (u64::from(row) * u64::from(last) / steps) as u32).collect()
    }

    /// Computes something for each of some frames, several at the same time, and consumes it in
    /// their order.
    fn each<T: Send>(
        &self,
        (step, steps): (&'static str, &Steps<'_>),
        frames: &[u32],
        compute: impl Fn(u32) -> Result<T, Failure> + Sync,
        mut consume: impl FnMut(u32, T) -> Result<(), Failure>,
    ) -> Result<(), Failure> {
        steps.count(step, frames.len() as u64);
        in_order(
            (frames.len(), self.subjects.most_at_once()),
            |row| about(frames[row], compute(frames[row])),
            |row, computed| {
                consume(frames[row], computed)?;
                steps.done(1);
                Ok(steps.check()?)
            },
        )
    }

    /// True if the light of all frames fits in memory and is all that pictures are made of, so that
    /// they need not be drawn again when the exposure is known.
    fn holds_light(&self) -> Result<bool, Failure> {
        let first = about(1, self.pipe(1))?;
        let [width, height] = first.picture.size.map(u64::from);
        let n_frames = u64::from(self.script.n_frames);
        let bytes = (width * height).saturating_mul(n_frames * size_of::<[f32; 4]>() as u64);
        let is_short = n_frames <= MOST_MEASURED.into() && bytes <= MOST_LIGHT;
        Ok(is_short
            && self.blur.is_none()
            && first.draws_polygons()
            && is_made_of_light(&first.picture, self.subjects))
    }

    /// The automatic exposure of all lit pixels of the film, or one that follows the light of
    /// single frames.
    ///
    /// # Errors
    /// A frame cannot be drawn.
    pub fn exposure(&self, follows: bool, steps: &Steps<'_>) -> Result<MeasuredExposure, Failure> {
        let mut picture = about(1, self.pipe(1))?.picture;
        let is_held = self.holds_light()?;
        let measure = |frame| {
            let pipe = self.pipe(frame)?;
            let pipe = if is_held { pipe } else { pipe.small(MEASURED_SIDE) };
            let mut opener = self.subjects.opener();
            let subject = opener.at(frame.into())?;
            let light = pipe.scene_options().and_then(|scene| pipe.light(&scene, subject));
            let (light, notes) = light.map_err(Failure::of)?;
            Ok((coarse(&light), is_held.then_some((light, notes))))
        };
        let mut frames = Vec::new();
        self.each(("measuring", steps), &self.metered(follows), measure, |frame, measured| {
            frames.push((frame, measured));
            Ok(())
        })?;
        let stops = if follows {
            let meter = |(frame, (light, _)): &(u32, (LinearFrame, _))| {
                let is_lit = |&[r, g, b, part]: &[f32; 4]| part > 0.0 && r.max(g).max(b) > 0.0;
                let stops = auto_exposure(light, picture.tone);
                (*frame, light.pixels().iter().any(is_lit).then_some(stops))
            };
            let mut metered: Vec<_> = frames.iter().map(meter).collect();
            let all = || metered.iter().filter_map(|(_, stops)| *stops);
            let range =
                all().fold(f64::NEG_INFINITY, f64::max) - all().fold(f64::INFINITY, f64::min);
            let below = BELOW_METERED.min(range);
            metered.iter_mut().flat_map(|(_, stops)| stops).for_each(|stops| *stops -= below);
            smoothed(&metered, self.script.n_frames, self.script.is_loop)
        } else {
            let pixels: Vec<[f32; 4]> =
                frames.iter().flat_map(|(_, (measured, _))| measured.pixels()).copied().collect();
            let all = LinearFrame::new([pixels.len() as u32, 1], true, pixels);
            vec![(1, auto_exposure(&all, picture.tone))]
        };
        let mut exposure =
            MeasuredExposure { n_frames: frames.len(), ..MeasuredExposure::default() };
        let mut held = BTreeMap::new();
        for (number, (measured, light)) in frames {
            let row = stops.partition_point(|(frame, _)| *frame <= number).saturating_sub(1);
            picture.exposure = stops.get(row).map(|(_, stops)| Exposure::Stops(*stops));
            levels_note(&measured, &picture)
                .iter()
                .for_each(|note| exposure.wrong.add(number, note));
            held.extend(light.map(|light| (number, light)));
        }
        Ok(MeasuredExposure { stops, light: Mutex::new(held), ..exposure })
    }

    /// The frames in which the exposure is measured.
    fn metered(&self, follows: bool) -> Vec<u32> {
        self.spread(if follows { MOST_METERED } else { MOST_MEASURED })
    }

    /// A hash of all that the exposure depends on: what the files of the measured frames record.
    ///
    /// # Errors
    /// The commands of a frame are wrong.
    pub fn exposure_key(&self, follows: bool) -> Result<String, Failure> {
        let mut text = format!("{} {follows}", env!("CARGO_PKG_VERSION"));
        for frame in self.metered(follows) {
            text.push('\n');
            let head = about(frame, self.subjects.head(frame.into()))?;
            text += &about(frame, self.pipe(frame))?.recorded(head).comment;
        }
        Ok(sha256(text.as_bytes()))
    }

    /// Writes frames as numbered files. Frames whose files were made by the same commands of the
    /// same scene are not drawn again.
    ///
    /// # Errors
    /// A frame cannot be drawn or written; those before it are kept.
    pub fn write_files(
        &self,
        frames: &[u32],
        names: &FrameNames,
        steps: &Steps<'_>,
    ) -> Result<Summary, Failure> {
        remove_stale_claims(names);
        let mut summary = Summary::default();
        let write = |frame| self.write_file(frame, &names.path(frame));
        self.each(("drawing", steps), frames, write, |frame, outcome| {
            summary.add(frame, outcome);
            Ok(())
        })?;
        Ok(summary)
    }

    fn write_file(&self, frame: u32, path: &Path) -> Result<Outcome, Failure> {
        let shot = self.shot(frame)?;
        let metadata = shot.metadata(self.subjects)?;
        if is_done(path, &metadata) {
            return Ok(Outcome::Done);
        }
        let Some(_claim) = claim(path) else { return Ok(Outcome::Elsewhere) };
        // Another process may have finished it before it was claimed.
        if is_done(path, &metadata) {
            return Ok(Outcome::Done);
        }
        let (picture, notes) = self.draw(frame, shot)?;
        Context::write_now(path, &picture.into_file())?;
        Ok(Outcome::Drawn(notes))
    }

    /// The pixels of a frame, and what became of it.
    fn frame(&self, frame: u32, keep: Option<&FrameNames>) -> Result<(Frame, Outcome), Failure> {
        let shot = self.shot(frame)?;
        let record = |names: &FrameNames| {
            Ok::<_, Failure>((names.path(frame), shot.metadata(self.subjects)?))
        };
        let kept = keep.map(record).transpose()?;
        if let Some((path, metadata)) = &kept
            && is_done(path, metadata)
        {
            let frame = read_png(&read_done(path)?, &PictureLimits::default());
            return Ok((frame.map_err(Failure::failed)?.0, Outcome::Done));
        }
        let (picture, notes) = self.draw(frame, shot)?;
        if let Some((path, _)) = &kept {
            Context::write_now(path, &picture.clone().into_file())?;
        }
        Ok((
            picture.into_frame().ok_or(Error::NoPixels).map_err(Failure::of)?,
            Outcome::Drawn(notes),
        ))
    }

    /// Draws frames on one sheet, labelled with their velocities or times, otherwise their numbers.
    /// Returns the sheet and its pictures.
    ///
    /// # Errors
    /// A frame cannot be drawn, or the sheet is too large.
    pub fn sheet(
        &self,
        frames: &[u32],
        steps: &Steps<'_>,
    ) -> Result<(Frame, Vec<Picture>), Failure> {
        let (mut files, mut pictures) = (Vec::new(), Vec::new());
        self.each(
            ("drawing", steps),
            frames,
            |frame| self.file(frame),
            |frame, file| {
                let (size, history) = read_png_header(&file).map_err(Failure::failed)?;
                let motion = Motion::recorded(&history);
                pictures.push(Picture { name: frame.to_string(), size, motion, history });
                files.push(file);
                Ok(())
            },
        )?;
        let frame_of = |idx: usize| {
            let read = read_png(&files[idx], &PictureLimits::default()).map(|(frame, _)| frame);
            read.map_err(|error| ugsheet::Error::Picture(error.to_string()))
        };
        let sheet =
            Sheet::new(&Config::default(), &pictures).and_then(|sheet| sheet.draw(frame_of));
        Ok((sheet.map_err(|error| Failure::failed(error.words()))?, pictures))
    }

    /// Writes a film to the output of the program. `rate`: frames a second. `captions`: those of
    /// its frames on a page. `keep`: files in which single frames are kept: read if they are done,
    /// and written if they are not.
    ///
    /// # Errors
    /// A frame cannot be drawn, or the film cannot be written.
    pub fn write_film(
        &self,
        frames: &[u32],
        (kind, rate): (FilmKind, f64),
        captions: Vec<Caption>,
        keep: Option<&FrameNames>,
        context: &mut Context,
    ) -> Result<Summary, Failure> {
        let n_rows = self.script.n_rows();
        let shape = FilmShape { size: self.size()?, n_frames: frames.len() as u32, n_rows, rate };
        self.check(frames)?;
        let mut summary = Summary::default();
        let pipe = self.pipe(1)?;
        let is_opaque = pipe.picture.background != Background::Transparent;
        let film = FilmFile { kind, shape, is_opaque, surround: surround(&pipe)? };
        ugsheet::film::write(context, &film, captions, |steps, push| {
            self.each(
                ("drawing", steps),
                frames,
                |frame| self.frame(frame, keep),
                |number, (frame, outcome)| {
                    summary.add(number, outcome);
                    push(&frame)
                },
            )
        })?;
        Ok(summary)
    }
}

/// The means of square blocks of pixels, so that the longest side is about [`MEASURED_SIDE`].
fn coarse(light: &LinearFrame) -> LinearFrame {
    let sides = [light.width(), light.height()];
    let n = (sides[0].max(sides[1]) / MEASURED_SIDE).max(1);
    let size = sides.map(|side| side.div_ceil(n));
    // Light times its weight, the weight, the covered part, and the number of pixels.
    let mut sums = vec![[0.0_f32; 6]; size[0] as usize * size[1] as usize];
    for (row, line) in light.pixels().chunks_exact(sides[0] as usize).enumerate() {
        let blocks = &mut sums[row / n as usize * size[0] as usize..];
        for (sum, block) in blocks.iter_mut().zip(line.chunks(n as usize)) {
            for &[red, green, blue, part] in block {
                let weight = if light.is_opaque() { 1.0 } else { part };
                let terms = [red * weight, green * weight, blue * weight, weight, part, 1.0];
                sum.iter_mut().zip(terms).for_each(|(sum, term)| *sum += term);
            }
        }
    }
    let mean = |[red, green, blue, weight, part, count]: [f32; 6]| {
        let over = |sum: f32| if weight > 0.0 { sum / weight } else { 0.0 };
        [over(red), over(green), over(blue), part / count]
    };
    LinearFrame::new(size, light.is_opaque(), sums.into_iter().map(mean).collect())
}

/// An error with the frame in which it occurred.
fn about<T>(frame: u32, outcome: Result<T, Failure>) -> Result<T, Failure> {
    outcome.map_err(|failure| match failure {
        Failure::Usage(text) => Failure::Usage(format!("frame {frame}: {text}")),
        Failure::Failed(text) => Failure::Failed(format!("frame {frame}: {text}")),
        other => other,
    })
}
