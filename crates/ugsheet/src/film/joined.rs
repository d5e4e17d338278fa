//! Films side by side.

use ugimage::label::number::significant;
use ugimage::{Frame, Metadata};
use ugpipe::{Context, Failure, Progress, Steps, Words};

use super::DEFAULT_RATE;
use super::animation::FilmShape;
use super::footage::Footage;
use crate::{Sheet, history};

/// Films on one sheet, frame by frame. A film that has ended holds its last frame.
pub struct Joined<'f> {
    films: &'f [Footage],
    sheet: Sheet,
    /// Size, number of frames and rate.
    pub shape: FilmShape,
}

impl<'f> Joined<'f> {
    /// Joins films on a sheet. `rate`: frames a second; by default those of the films, which must
    /// agree.
    ///
    /// # Errors
    /// The rates of the films differ.
    pub fn new(films: &'f [Footage], sheet: Sheet, rate: Option<f64>) -> Result<Self, Failure> {
        let rate = match rate {
            Some(rate) => rate,
            None => common_rate(films)?.clamp(0.01, 1000.0),
        };
        let n_frames = films.iter().map(|film| film.n_frames).max().unwrap_or(1);
        let shape = FilmShape { size: sheet.size(), n_frames, n_rows: 1, rate };
        Ok(Self { films, sheet, shape })
    }

    /// Says which films hold their last frame.
    pub fn tell_held(&self, context: &Context) {
        for film in self.films.iter().filter(|film| film.n_frames < self.shape.n_frames) {
            let (name, count, all) = (&film.name, film.n_frames, self.shape.n_frames);
            let held = if count == 1 { "its only frame" } else { "its last frame" };
            context
                .note(&format!("`{name}` has {count} of {all} frames: {held} is held to the end"));
        }
    }

    /// Draws all frames in order and passes them on with their number and record.
    ///
    /// # Errors
    /// A film is broken, or `consume` fails.
    pub fn draw(
        &self,
        command: &str,
        steps: &Steps<'_>,
        mut consume: impl FnMut(u32, &Frame, &Metadata) -> Result<(), Failure>,
    ) -> Result<(), Failure> {
        let mut readers =
            self.films.iter().map(|film| film.frames()).collect::<Result<Vec<_>, _>>()?;
        let mut pictures = self.sheet.pictures().to_vec();
        let mut shown: Vec<Frame> = vec![Frame::opaque(1, 1); readers.len()];
        steps.count("joining", self.shape.n_frames.into());
        for number in 1..=self.shape.n_frames {
            for (row, reader) in readers.iter_mut().enumerate() {
                if let Some(next) = reader.next() {
                    (shown[row], pictures[row].history) = next?;
                }
            }
            let frame = self.sheet.draw(|row| Ok(shown[row].clone()));
            let frame = frame.map_err(|error| Failure::failed(error.words()))?;
            consume(number, &frame, &history(&pictures, Some(command)))?;
            steps.done(1);
            steps.check()?;
        }
        Ok(())
    }
}

/// The frames a second of films whose files state them.
fn common_rate(films: &[Footage]) -> Result<f64, Failure> {
    let mut rated =
        films.iter().filter(|film| film.n_frames > 1).filter_map(|film| Some((film, film.rate?)));
    let Some((first, rate)) = rated.next() else { return Ok(DEFAULT_RATE) };
    for (film, other) in rated {
        // Times of GIF are rounded to hundredths of a second.
        let n_frames = f64::from(film.n_frames.min(first.n_frames));
        if (n_frames / rate - n_frames / other).abs() > 0.011 {
            return Err(Failure::Usage(format!(
                "`{}` has {} frames a second and `{}` {}; frames are joined one by one: say how many a \
                 second with -fps",
                first.name,
                significant(rate, 4),
                film.name,
                significant(other, 4)
            )));
        }
    }
    Ok(rate)
}
