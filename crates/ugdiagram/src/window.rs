//! The part of time and space that a diagram shows.

use crate::error::Error;
use crate::place::DiagramPlace;

/// The part of time and space that a diagram shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DiagramWindow {
    /// First and last place along the axis.
    pub places: [f64; 2],
    /// First and last time.
    pub times: [f64; 2],
}

/// The part of the range of all events that is added at each end.
const MARGIN: f64 = 0.08;

/// Coordinates beyond which differences may overflow.
const FARTHEST: f64 = 1e150;

impl DiagramWindow {
    /// Nothing.
    pub const EMPTY: Self = Self { places: [0.0; 2], times: [0.0; 2] };

    /// The window with given times and places, or those of all events `keys`. A unit of time is as
    /// long as one of space, so that light runs at 45°: what is too narrow for `ratio`, width over
    /// height, is extended to both sides.
    ///
    /// # Errors
    /// [`Error::Range`], [`Error::OutOfRange`].
    pub fn new(
        keys: &[DiagramPlace],
        times: Option<[f64; 2]>,
        places: Option<[f64; 2]>,
        ratio: f64,
    ) -> Result<Self, Error> {
        for [from, to] in [times, places].into_iter().flatten() {
            if from >= to {
                return Err(Error::Range { from, to });
            }
        }
        let is_near = |key: &DiagramPlace| key.iter().all(|part| part.abs() <= FARTHEST);
        if !keys.iter().all(is_near) {
            return Err(Error::OutOfRange);
        }
        let range = |side: usize, within: Option<[f64; 2]>| {
            let other = 1 - side;
            let is_inside = |key: &&DiagramPlace| {
                within.is_none_or(|[from, to]| from <= key[other] && key[other] <= to)
            };
            let inside = keys.iter().filter(is_inside);
            let empty = [f64::INFINITY, f64::NEG_INFINITY];
            let [low, high] =
                inside.fold(empty, |[low, high], key| [low.min(key[side]), high.max(key[side])]);
            if low <= high { [low, high] } else { [0.0, 0.0] }
        };
        let mut window = Self {
            places: places.unwrap_or_else(|| range(0, times)),
            times: times.unwrap_or_else(|| range(1, places)),
        };
        if places.is_none() && times.is_none() {
            let size = window.width().max(window.duration());
            let margin = if size > 0.0 { MARGIN * size } else { 1.0 };
            window.places = widened(window.places, window.width() + 2.0 * margin);
            window.times = widened(window.times, window.duration() + 2.0 * margin);
        }
        if window.width() < ratio * window.duration() {
            window.places = widened(window.places, ratio * window.duration());
        } else {
            window.times = widened(window.times, window.width() / ratio);
        }
        let is_wide = |[from, to]: [f64; 2]| to - from > 1e-9 * from.abs().max(to.abs());
        if is_wide(window.places) && is_wide(window.times) {
            Ok(window)
        } else {
            Err(Error::OutOfRange)
        }
    }

    /// Its extent in space.
    pub fn width(&self) -> f64 {
        self.places[1] - self.places[0]
    }

    /// Its extent in time.
    pub fn duration(&self) -> f64 {
        self.times[1] - self.times[0]
    }

    /// True if a place is in it.
    pub fn contains(&self, [x, t]: DiagramPlace) -> bool {
        let ([left, right], [first, last]) = (self.places, self.times);
        left <= x && x <= right && first <= t && t <= last
    }

    /// The part of a line that is in it, through a place in a direction.
    pub fn line(&self, place: DiagramPlace, direction: DiagramPlace) -> Option<[DiagramPlace; 2]> {
        self.part(place, direction, [f64::NEG_INFINITY, f64::INFINITY])
    }

    /// The part of a ray that is in it.
    pub fn ray(&self, place: DiagramPlace, direction: DiagramPlace) -> Option<[DiagramPlace; 2]> {
        self.part(place, direction, [0.0, f64::INFINITY])
    }

    /// The part of a segment that is in it.
    pub fn segment(&self, [from, to]: [DiagramPlace; 2]) -> Option<[DiagramPlace; 2]> {
        self.part(from, [to[0] - from[0], to[1] - from[1]], [0.0, 1.0])
    }

    /// Liang and Barsky's clipping.
    fn part(
        &self,
        place: DiagramPlace,
        direction: DiagramPlace,
        range: [f64; 2],
    ) -> Option<[DiagramPlace; 2]> {
        let [mut from, mut to] = range;
        for (side, [low, high]) in [self.places, self.times].into_iter().enumerate() {
            if direction[side] == 0.0 {
                if place[side] < low || place[side] > high {
                    return None;
                }
                continue;
            }
            let [a, b] = [low, high].map(|edge| (edge - place[side]) / direction[side]);
            (from, to) = (from.max(a.min(b)), to.min(a.max(b)));
        }
        let at = |part: f64| [0, 1].map(|side| place[side] + part * direction[side]);
        (from < to && from.is_finite() && to.is_finite()).then(|| [at(from), at(to)])
    }
}

/// A range of this length with the same middle.
fn widened([from, to]: [f64; 2], length: f64) -> [f64; 2] {
    let middle = from.midpoint(to);
    [middle - 0.5 * length, middle + 0.5 * length]
}

/// The least of 1, 2, 5, 10, … times a power of ten that is not below a length; 0 for none.
pub fn round_step(length: f64) -> f64 {
    let text = format!("{length:e}");
    let exponent = text.split_once('e').and_then(|(_, exponent)| exponent.parse::<i32>().ok());
    let Some(exponent) = exponent.filter(|_| length > 0.0 && length.is_finite()) else {
        return 0.0;
    };
    let power: f64 = format!("1e{exponent}").parse().unwrap_or(0.0);
    let factor = [1.0, 2.0, 5.0].into_iter().find(|factor| factor * power >= length);
    factor.unwrap_or(10.0) * power
}
