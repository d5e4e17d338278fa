//! Motion blur: the mean light of a frame while a shutter is open.

use std::sync::Arc;

use ugimage::{LinearFrame, Metadata};
use ugpicture::{
    Annotated, AnnotationOptions, Canvas, Drawn, DrawnContent, Output, PictureOptions, Rendering,
};
use ugpipe::{Failure, sha256};

use crate::error::Error;
use crate::note::Note;
use crate::pipe::{DrawnLight, Pipe};
use crate::series::{Opener, Subjects};

/// How long the shutter is open.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MotionBlur {
    /// Its time, in times between two frames, above 0.
    pub open: f64,
    /// How many moments of this time are drawn, 1 or more.
    pub n_moments: u32,
}

impl MotionBlur {
    /// The moments of a frame, in frames: the middles of equal parts of the time in which the
    /// shutter is open, half of it before the frame and half after, as far as this time lies
    /// between `first` and `last`.
    pub fn moments(self, frame: u32, [first, last]: [f64; 2]) -> Vec<f64> {
        let n = f64::from(self.n_moments);
        let middle = f64::from(frame);
        let opened = (middle - 0.5 * self.open).max(first);
        let time = (middle + 0.5 * self.open).min(last) - opened;
        (0..self.n_moments).map(|row| opened + time * (f64::from(row) + 0.5) / n).collect()
    }
}

/// A frame that can be drawn.
pub struct Shot {
    /// Its number, counted from 1.
    pub number: u32,
    /// The frame at its own moment.
    pub frame: Pipe,
    /// The moments while the shutter is open, in frames; none without a shutter.
    pub moments: Vec<(f64, Pipe)>,
}

impl Shot {
    /// The record in the file of the frame.
    ///
    /// # Errors
    /// A file of its subject cannot be read.
    pub fn metadata(&self, subjects: Subjects<'_>) -> Result<Metadata, Failure> {
        let frame = self.frame.recorded(subjects.head(self.number.into())?);
        if self.moments.is_empty() {
            return Ok(frame);
        }
        let record = |(moment, pipe): &(f64, Pipe)| {
            Ok::<_, Failure>(pipe.recorded(subjects.head(*moment)?).comment)
        };
        Ok(of_mean(frame, &self.moments.iter().map(record).collect::<Result<Vec<_>, _>>()?))
    }

    /// Checks that the frame can have what its options ask for.
    ///
    /// # Errors
    /// It is the mean of moments, which has no false colours, channels and vectors.
    pub fn check(&self) -> Result<(), Error> {
        let PictureOptions { annotations, channels, output, .. } = &self.frame.picture;
        let is_light = annotations.map.is_none()
            && channels.is_empty()
            && !matches!(output, Output::Vector(_));
        if self.moments.is_empty() || is_light { Ok(()) } else { Err(Error::Mean) }
    }

    /// Draws the frame. `light`: what [`Pipe::light`] returns for it, if that is known.
    ///
    /// # Errors
    /// The subject cannot be opened, the scene or panorama cannot be drawn with these options, or
    /// the mean of its moments cannot have what they ask for.
    pub fn draw(
        self,
        subjects: Subjects<'_>,
        light: Option<DrawnLight>,
    ) -> Result<(Rendering, Vec<Note>), Failure> {
        let mut opener = subjects.opener();
        let (picture, notes) = self.drawn(&mut opener, subjects, light)?;
        Ok((picture, opener.notes().chain(notes).collect()))
    }

    fn drawn(
        self,
        opener: &mut Opener<'_>,
        subjects: Subjects<'_>,
        light: Option<DrawnLight>,
    ) -> Result<(Rendering, Vec<Note>), Failure> {
        let moment = f64::from(self.number);
        let light = light.filter(|_| is_made_of_light(&self.frame.picture, subjects));
        if self.moments.is_empty() && light.is_none() {
            return self.frame.draw(opener.at(moment)?).map_err(Failure::of);
        }
        self.check().map_err(Failure::of)?;
        let metadata = self.metadata(subjects)?;
        let canvas = Canvas::new(&self.frame.picture).map_err(Failure::of)?;
        if !is_made_of_light(&self.frame.picture, subjects) {
            // The scene of the frame's own moment is drawn for its annotations.
            let mut frame = self.frame.clone();
            frame.picture.light = Some(Arc::new(self.mean(canvas.options(), opener)?));
            let (mut picture, notes) = frame.draw(opener.at(moment)?).map_err(Failure::of)?;
            let Metadata { camera, per_inch, .. } = std::mem::take(&mut picture.metadata);
            picture.metadata = Metadata { camera, per_inch, ..metadata };
            return Ok((picture, notes));
        }
        let (frame, mut notes) = match light {
            Some(light) => light,
            None => (self.mean(canvas.options(), opener)?, Vec::new()),
        };
        let drawn = Drawn::<Error> {
            content: DrawnContent::Light { frame, is_clipped: false },
            brightest: 0.0,
            notes: notes.iter().filter_map(Note::of_picture).cloned().collect(),
            annotated: Annotated { is_shifted: false, subject: ugpicture::Subject::Pixels },
        };
        let mut picture = canvas.finish(drawn, metadata, &()).map_err(Failure::of)?;
        if self.moments.is_empty() {
            notes.retain(|note| note.of_picture().is_none());
            notes.extend(self.frame.notes(&mut picture));
        }
        Ok((picture, notes))
    }

    /// The mean light of all moments.
    fn mean(
        &self,
        scene: &PictureOptions,
        opener: &mut Opener<'_>,
    ) -> Result<LinearFrame, Failure> {
        let mut sum = Sum::default();
        for (moment, pipe) in &self.moments {
            sum.add(&pipe.light(scene, opener.at(*moment)?).map_err(Failure::of)?.0);
        }
        Ok(sum.mean())
    }
}

/// True if a picture with these options can be made of its light, without the scene.
pub fn is_made_of_light(picture: &PictureOptions, subjects: Subjects<'_>) -> bool {
    let PictureOptions { annotations, channels, output, .. } = picture;
    let AnnotationOptions { legend, outline, grid, map, iso, .. } = annotations;
    let needs_scene = *legend || *outline || *grid || map.is_some() || iso.is_some();
    let has_scene = needs_scene || subjects.have_labels();
    !has_scene && channels.is_empty() && !matches!(output, Output::Vector(_))
}

/// The record in the file of a mean. No single pipe draws it, so it has none of the lines that
/// can be run; the hash is that of the records of all moments.
fn of_mean(metadata: Metadata, records: &[String]) -> Metadata {
    let commands = metadata.comment.lines().filter(|line| !line.contains(" # SHA-256 "));
    let mean = format!(
        "mean light of {} moments, whose records have the SHA-256 {}",
        records.len(),
        sha256(records.join("\n").as_bytes())
    );
    let lines: Vec<&str> = commands.chain([mean.as_str()]).collect();
    Metadata { comment: lines.join("\n"), ..metadata }
}

/// A sum of pictures of one size.
#[derive(Default)]
struct Sum {
    size: [u32; 2],
    is_opaque: bool,
    n_pictures: u32,
    /// Red, green and blue, multiplied by the covered part, and the covered part.
    pixels: Vec<[f64; 4]>,
}

impl Sum {
    fn add(&mut self, light: &LinearFrame) {
        if self.n_pictures == 0 {
            (self.size, self.is_opaque) = ([light.width(), light.height()], light.is_opaque());
            self.pixels = vec![[0.0; 4]; light.pixels().len()];
        }
        self.n_pictures += 1;
        for (sum, pixel) in self.pixels.iter_mut().zip(light.pixels()) {
            let [red, green, blue, part] = pixel.map(f64::from);
            let weight = if self.is_opaque { 1.0 } else { part };
            let terms = [red * weight, green * weight, blue * weight, weight];
            sum.iter_mut().zip(terms).for_each(|(sum, term)| *sum += term);
        }
    }

    fn mean(self) -> LinearFrame {
        let n = f64::from(self.n_pictures);
        let mean = |[red, green, blue, weight]: [f64; 4]| {
            let over = |sum: f64| if weight > 0.0 { (sum / weight) as f32 } else { 0.0 };
            [over(red), over(green), over(blue), (weight / n) as f32]
        };
        LinearFrame::new(self.size, self.is_opaque, self.pixels.into_iter().map(mean).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moments_lie_evenly_around_the_frame() {
        let moments = |open, n_moments| MotionBlur { open, n_moments }.moments(3, [1.0, 4.0]);
        assert_eq!(moments(0.5, 1), [3.0]);
        assert_eq!(moments(1.0, 2), [2.75, 3.25]);
        assert_eq!(moments(0.5, 4), [2.8125, 2.9375, 3.0625, 3.1875]);
        // The film has an end.
        assert_eq!(moments(4.0, 3), [1.5, 2.5, 3.5]);
        assert_eq!(MotionBlur { open: 1.0, n_moments: 2 }.moments(1, [1.0, 1.0]), [1.0, 1.0]);
    }

    #[test]
    fn what_is_not_covered_has_no_colour() {
        let mut sum = Sum::default();
        sum.add(&LinearFrame::new([1, 1], false, vec![[0.5, 0.25, 1.0, 1.0]]));
        sum.add(&LinearFrame::new([1, 1], false, vec![[0.0; 4]]));
        assert_eq!(sum.mean().pixels(), [[0.5, 0.25, 1.0, 0.5]]);
    }
}
