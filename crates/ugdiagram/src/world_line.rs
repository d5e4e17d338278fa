//! World lines, sampled as polylines of a diagram.

use glam::DVec3;
use ugphysics::{Event, WorldLine, WorldLineError};

use crate::frame::ReferenceFrame;
use crate::place::DiagramPlace;
use crate::window::DiagramWindow;

/// Part of the size of a window by which a curve may deviate from its chords.
const TOLERANCE: f64 = 2e-4;

/// Pieces of a curve before they are halved.
const PIECES: usize = 48;

/// Halvings of a piece.
const HALVINGS: usize = 8;

/// The event of a point of a body at a time of a frame, and the own time then.
///
/// # Errors
/// [`WorldLineError::Horizon`] if the point cannot move so, [`WorldLineError::NotFinite`].
pub fn at_time(
    motion: &WorldLine,
    point: DVec3,
    frame: &ReferenceFrame,
    time: f64,
) -> Result<(Event, f64), WorldLineError> {
    let late = |own_time: f64| -> Result<f64, WorldLineError> {
        Ok(frame.coordinates(motion.event(point, own_time)?).t - time)
    };
    if motion.inertial_frame().is_some() {
        let start = late(0.0)?;
        let clock = frame.from_camera() * motion.frame(point, 0.0);
        let own_time = -start / clock.apply(Event { t: 1.0, x: DVec3::ZERO }).t;
        return Ok((motion.event(point, own_time)?, own_time));
    }
    // Own time passes everywhere, so there is one root: bracketed, then halved.
    let mut reach = 1.0;
    while late(-reach)? > 0.0 || late(reach)? < 0.0 {
        reach *= 2.0;
        if reach > 1e12 {
            return Err(WorldLineError::NotFinite);
        }
    }
    let (mut low, mut high) = (-reach, reach);
    loop {
        let middle = low.midpoint(high);
        if middle <= low || middle >= high || high - low <= 1e-15 * reach {
            return Ok((motion.event(point, middle)?, middle));
        }
        if late(middle)? < 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
}

/// The world line of a point of a body, between the first and the last time of a window.
///
/// # Errors
/// See [`at_time`].
pub fn curve(
    motion: &WorldLine,
    point: DVec3,
    frame: &ReferenceFrame,
    axis: DVec3,
    window: &DiagramWindow,
) -> Result<Vec<DiagramPlace>, WorldLineError> {
    let [from, to] = window.times;
    let (first, last) = (at_time(motion, point, frame, from)?, at_time(motion, point, frame, to)?);
    let place = |own_time: f64| -> Result<DiagramPlace, WorldLineError> {
        let Event { t, x } = frame.coordinates(motion.event(point, own_time)?);
        Ok([axis.dot(x), t])
    };
    let mut points = vec![place(first.1)?];
    if motion.inertial_frame().is_some() {
        points.push(place(last.1)?);
        return Ok(points);
    }
    let own_time = |piece: usize| first.1 + (last.1 - first.1) * piece as f64 / PIECES as f64;
    let tolerance = TOLERANCE * window.duration();
    for piece in 0..PIECES {
        let ends = [own_time(piece), own_time(piece + 1)];
        add_piece(&place, ends, tolerance, HALVINGS, &mut points)?;
    }
    Ok(points)
}

/// Adds the points of a piece but the first.
fn add_piece(
    place: &impl Fn(f64) -> Result<DiagramPlace, WorldLineError>,
    [from, to]: [f64; 2],
    tolerance: f64,
    halvings: usize,
    points: &mut Vec<DiagramPlace>,
) -> Result<(), WorldLineError> {
    let end = place(to)?;
    let start = points.last().copied().unwrap_or(end);
    let middle = from.midpoint(to);
    let [x, t] = place(middle)?;
    let [dx, dt] = [end[0] - start[0], end[1] - start[1]];
    let chord = libm::hypot(dx, dt);
    let sagitta = ((x - start[0]) * dt - (t - start[1]) * dx).abs();
    if halvings == 0 || sagitta <= tolerance * chord {
        points.push(end);
        return Ok(());
    }
    add_piece(place, [from, middle], tolerance, halvings - 1, points)?;
    add_piece(place, [middle, to], tolerance, halvings - 1, points)
}
