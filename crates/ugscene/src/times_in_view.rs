//! The times at which moving bodies are in the picture.

use std::fmt;

use glam::DVec3;

use crate::{BodyBoxes, CameraOptions, MotionError, MotionOptions};

/// Times are searched as far from the first one as bodies need for this many times the distance to
/// them. Before and after that they are near their vanishing points.
const FARTHEST: f64 = 64.0;

/// Equal parts of the times before and after, in which bodies are looked for at first.
const N_PARTS: u32 = 32;

/// Cosine of 2°: a part is halved if the direction to a body changes by more.
const STEP: f64 = 0.999_4;

/// Limits of the number of moments before and after, and of moments times boxes. The search ends
/// there, so it takes a fraction of a second.
const MOST_MOMENTS: usize = 1 << 12;
const MOST_SEEN: usize = 1 << 19;

/// Most halvings of a part, and of the ends of an interval.
const N_HALVINGS: u32 = 24;

/// When moving bodies are in the picture, on the clock of the observer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimesInView {
    /// Since when; `None` if they have always been.
    pub first: Option<f64>,
    /// Until when; `None` if they will always be.
    pub last: Option<f64>,
    /// When they are nearest to the middle of the picture.
    pub best: f64,
}

impl fmt::Display for TimesInView {
    /// As `from 4.2 to 11.7, best at 8`, rounded to a hundredth of the interval, inward.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ends = [self.first, self.last].map(|end| end.unwrap_or(self.best));
        let size = (ends[1] - ends[0]).max(f64::MIN_POSITIVE);
        let size = if self.first.is_some() && self.last.is_some() {
            size
        } else {
            self.best.abs().max(1e-3)
        };
        let decimals = (2.0 - libm::floor(libm::log10(size))).clamp(0.0, 12.0);
        let unit = libm::exp10(decimals);
        // Not −0.
        let text = |scaled: f64| format!("{}", scaled / unit + 0.0);
        let first = self.first.map(|first| text((first * unit).ceil()));
        let last = self.last.map(|last| text((last * unit).floor()));
        match (first, last) {
            (Some(first), Some(last)) => write!(f, "from {first} to {last}, ")?,
            (Some(first), None) => write!(f, "from {first} on, ")?,
            (None, Some(last)) => write!(f, "until {last}, ")?,
            (None, None) => {}
        }
        write!(f, "best at {}", text((self.best * unit).round()))
    }
}

/// Bodies at a time.
#[derive(Clone, Debug)]
struct Moment {
    time: f64,
    is_in_view: bool,
    /// Cosine of the angle between the view axis and the middle of what is seen; −1 if it is all
    /// around the eye.
    nearness: f64,
    /// Unit vectors to the followed boxes.
    directions: Vec<DVec3>,
}

/// Bodies over time.
struct Search<'s> {
    boxes: &'s BodyBoxes,
    motion: &'s MotionOptions,
    camera: &'s CameraOptions,
    size: [u32; 2],
}

impl BodyBoxes {
    /// The interval of times, nearest to that of `motion`, in which bodies that move relative to
    /// the camera are in the picture; `None` if no such time is found, or none moves. Only some of
    /// their vertices are looked for, so it may be too short.
    ///
    /// # Errors
    /// See [`BodyBoxes::seen`].
    pub fn times_in_view(
        &self,
        motion: &MotionOptions,
        camera: &CameraOptions,
        size: [u32; 2],
    ) -> Result<Option<TimesInView>, MotionError> {
        let now = self.seen(motion, camera, size)?;
        let Some(range) =
            now.time_scale().map(|scale| FARTHEST * scale).filter(|range| range.is_finite())
        else {
            return Ok(None);
        };
        let search = Search { boxes: self, motion, camera, size };
        let now = search.moment(motion.time)?;
        let (mut moments, is_whole_before) = search.moments(now.clone(), -range)?;
        moments.reverse();
        moments.pop();
        let (after, is_whole_after) = search.moments(now, range)?;
        moments.extend(after);
        let distance = |moment: &Moment| (moment.time - motion.time).abs();
        let in_view = (0..moments.len()).filter(|&row| moments[row].is_in_view);
        let nearest =
            in_view.min_by(|&a, &b| distance(&moments[a]).total_cmp(&distance(&moments[b])));
        let Some(row) = nearest else { return Ok(None) };
        let found = search.interval(&moments, row)?;
        let end = |is_whole: bool, moment: Option<&Moment>| {
            moment.filter(|_| !is_whole).map(|end| end.time)
        };
        Ok(Some(TimesInView {
            first: found.first.or_else(|| end(is_whole_before, moments.first())),
            last: found.last.or_else(|| end(is_whole_after, moments.last())),
            ..found
        }))
    }
}

impl Search<'_> {
    fn moment(&self, time: f64) -> Result<Moment, MotionError> {
        let motion = MotionOptions { time, ..self.motion.clone() };
        let seen = self.boxes.seen(&motion, self.camera, self.size)?;
        let directions = seen.directions();
        let middle = directions.iter().sum::<DVec3>();
        let nearness = seen.forward().dot(ugphysics::unit_or_zero(middle));
        Ok(Moment { time, is_in_view: seen.is_vertex_in_view(), nearness, directions })
    }

    /// Moments from one to `range` after it, or before it if that is negative, so close that no body
    /// is missed on its way across the picture; false if there are fewer, for they would be too
    /// many.
    fn moments(&self, first: Moment, range: f64) -> Result<(Vec<Moment>, bool), MotionError> {
        let mut moments = vec![first];
        for part in 1..=N_PARTS {
            let time = self.motion.time + range * f64::from(part) / f64::from(N_PARTS);
            if !self.add_between(&mut moments, self.moment(time)?, N_HALVINGS)? {
                return Ok((moments, false));
            }
        }
        Ok((moments, true))
    }

    /// Appends `next`, and before it as many moments as the way of the bodies since the last one
    /// requires; false if these are too many.
    fn add_between(
        &self,
        moments: &mut Vec<Moment>,
        next: Moment,
        n_halvings: u32,
    ) -> Result<bool, MotionError> {
        let last = moments.last().unwrap_or(&next);
        let mut ways = last.directions.iter().zip(&next.directions);
        let is_close = ways.all(|(a, b)| a.dot(*b) >= STEP);
        if is_close || n_halvings == 0 {
            moments.push(next);
            return Ok(true);
        }
        if moments.len() >= MOST_MOMENTS || moments.len() * next.directions.len() >= MOST_SEEN {
            return Ok(false);
        }
        let middle = self.moment(0.5 * (last.time + next.time))?;
        Ok(self.add_between(moments, middle, n_halvings - 1)?
            && self.add_between(moments, next, n_halvings - 1)?)
    }

    /// The interval in which bodies are in view around a moment at which they are.
    fn interval(&self, moments: &[Moment], row: usize) -> Result<TimesInView, MotionError> {
        let before = moments[..row].iter().rposition(|moment| !moment.is_in_view);
        let after =
            moments[row..].iter().position(|moment| !moment.is_in_view).map(|count| row + count);
        let end =
            |outside: usize, inside: usize| self.end(moments[outside].time, moments[inside].time);
        let first = before.map(|before| end(before, before + 1)).transpose()?;
        let last = after.map(|after| end(after, after - 1)).transpose()?;
        let inside = &moments[before.map_or(0, |row| row + 1)..after.unwrap_or(moments.len())];
        let best = inside.iter().max_by(|a, b| a.nearness.total_cmp(&b.nearness));
        Ok(TimesInView { first, last, best: best.map_or(moments[row].time, |moment| moment.time) })
    }

    /// The last time towards `outside` at which bodies are in view.
    fn end(&self, mut outside: f64, mut inside: f64) -> Result<f64, MotionError> {
        for _ in 0..N_HALVINGS {
            let middle = 0.5 * (outside + inside);
            let end = if self.moment(middle)?.is_in_view { &mut inside } else { &mut outside };
            *end = middle;
        }
        Ok(inside)
    }
}
