//! Notes on a diagram.

use std::fmt;

use ugimage::label::number::significant;

use crate::diagram::{AxisSource, Diagram, MarkRole};
use crate::interval::IntervalKind;

/// A note on a diagram.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Note {
    /// The axis was chosen.
    Axis {
        /// Its direction.
        axis: [f64; 3],
        /// The line along whose motion it is; `None` if nothing moves.
        motion: Option<String>,
    },
    /// Lines are left out, because each coincides with another one.
    Coincident(Vec<[String; 2]>),
    /// Events are beside the plane of the diagram, so they are inside of the light cone.
    OutOfPlane(usize),
    /// Events are outside of the window.
    Outside(usize),
    /// Names for which there is no room.
    Omitted(Vec<String>),
    /// An interval.
    Interval {
        /// The names of its events.
        names: [String; 2],
        /// What it is.
        text: String,
    },
}

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Axis { axis, motion } => {
                let axis = axis.map(|part| significant(part, 4)).join(" ").replace('−', "-");
                match motion {
                    Some(name) => write!(f, "the axis is {axis}, along the motion of `{name}`"),
                    None => write!(f, "nothing moves, and the axis is {axis}"),
                }
            }
            Self::Coincident(lines) => {
                let lines = lines.iter().map(|[line, other]| format!("`{line}` (`{other}`)"));
                let lines = lines.collect::<Vec<_>>().join(", ");
                write!(f, "left out where another line is: {lines}")
            }
            Self::OutOfPlane(n) => write!(
                f,
                "{n} of the events at which light left are beside the plane of the diagram, and so inside the light cone"
            ),
            Self::Outside(n) => write!(f, "{n} events are outside of the diagram"),
            Self::Omitted(names) => {
                write!(f, "there is no room for the names {}", names.join(", "))
            }
            Self::Interval { names: [from, to], text } => write!(f, "from {from} to {to}: {text}"),
        }
    }
}

impl Note {
    /// The notes on a diagram. `omitted`: names for which there was no room.
    pub(crate) fn all(diagram: &Diagram, omitted: &[String]) -> Vec<Self> {
        let mut notes = Vec::new();
        let motion = match &diagram.axis_source {
            AxisSource::Given => None,
            AxisSource::Motion(name) => Some(Some(name.clone())),
            AxisSource::Rest => Some(None),
        };
        let axis = diagram.axis.to_array();
        notes.extend(motion.map(|motion| Self::Axis { axis, motion }));
        let coincident = &diagram.coincident;
        notes.extend((!coincident.is_empty()).then(|| Self::Coincident(coincident.clone())));
        let emissions = || diagram.marks.iter().filter(|mark| mark.role == MarkRole::Emission);
        let is_beside = |place: [f64; 2], eye: [f64; 2]| {
            /// Part of the time of flight.
            const CLOSE: f64 = 0.01;
            let (across, time) = ((place[0] - eye[0]).abs(), eye[1] - place[1]);
            across < (1.0 - CLOSE) * time
        };
        let eye = diagram.place(ugphysics::Event::ORIGIN);
        let n_beside = emissions().filter(|mark| is_beside(mark.place, eye)).count();
        notes.extend((n_beside > 0).then_some(Self::OutOfPlane(n_beside)));
        let is_event =
            |role| !matches!(role, MarkRole::Tick | MarkRole::AxisTick | MarkRole::Flash);
        let outside = diagram.marks.iter().filter(|mark| is_event(mark.role));
        let n_outside = outside.filter(|mark| !diagram.window.contains(mark.place)).count();
        notes.extend((n_outside > 0).then_some(Self::Outside(n_outside)));
        notes.extend((!omitted.is_empty()).then(|| Self::Omitted(omitted.to_vec())));
        notes.extend(diagram.intervals.iter().map(|measured| {
            let length = significant(measured.interval.length(), 6);
            let what = match measured.interval.kind {
                IntervalKind::Timelike => format!("timelike, {length} of own time"),
                IntervalKind::Lightlike => "lightlike".to_owned(),
                IntervalKind::Spacelike => format!("spacelike, a proper distance of {length}"),
            };
            let mut known = Vec::new();
            let frames = diagram.frames.iter().filter_map(|frame| {
                let components = frame.components(measured.difference);
                let [t, x] = [components.t, diagram.axis.dot(components.x)]
                    .map(|part| significant(if part.abs() < 1e-12 { 0.0 } else { part }, 6));
                let parts = format!("Δt = {t}, Δx = {x}");
                // The frame of a camera at rest is that of the scene.
                let is_new = !known.contains(&parts);
                known.push(parts.clone());
                is_new.then(|| format!("{parts} ({})", frame.name))
            });
            let text = format!("{what}; {}", frames.collect::<Vec<_>>().join("; "));
            Self::Interval { names: measured.names.clone(), text }
        }));
        notes
    }
}
