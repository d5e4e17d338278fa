//! What is drawn, and how.

use glam::DVec3;
use ugphysics::Hsv;
use ugpicture::{Background, PictureOptions};
use ugscene::MotionOptions;

use crate::words::{EventWord, FrameWord, NamedEvent};

/// The options of a diagram and of its picture.
#[derive(Clone, Debug)]
pub struct Config {
    /// How bodies and camera move, and when the picture is taken.
    pub motion: MotionOptions,
    /// The camera, and the size and texts of the picture.
    pub picture: PictureOptions,
    /// What is drawn.
    pub diagram: DiagramOptions,
    /// How the scene is read.
    pub reading: ugparse::Options,
}

impl Default for Config {
    fn default() -> Self {
        let white = Hsv { hue: 0.0, saturation: 0.0, value: 1.0 };
        Self {
            motion: MotionOptions::default(),
            picture: PictureOptions {
                background: Background::Color(white),
                ..PictureOptions::default()
            },
            diagram: DiagramOptions::default(),
            reading: ugparse::Options::default(),
        }
    }
}

/// What a diagram shows.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DiagramOptions {
    /// Names of the bodies, lamps and cameras whose world lines are drawn; `None` for all.
    pub lines: Option<Vec<String>>,
    /// The frame whose time and place the diagram has.
    pub frame: FrameWord,
    /// The direction of space across, in the axes of the scene; `None` for that of the motion.
    pub axis: Option<DVec3>,
    /// First and last time; `None` for those of all events.
    pub times: Option<[f64; 2]>,
    /// First and last place along the axis; `None` for those of all events.
    pub places: Option<[f64; 2]>,
    /// Events with names.
    pub events: Vec<NamedEvent>,
    /// Pairs of events whose intervals are drawn and measured.
    pub intervals: Vec<[EventWord; 2]>,
    /// Lines of simultaneity of frames, through events.
    pub simultaneous: Vec<(FrameWord, EventWord)>,
    /// Axes of frames, through events.
    pub axes: Vec<(FrameWord, EventWord)>,
    /// Events whose light cones are drawn.
    pub cones: Vec<EventWord>,
    /// Which emission events have dots.
    pub points: PointChoice,
    /// Own time between ticks of world lines.
    pub ticks: TickChoice,
    /// Leave out the past light cone of the eye.
    pub without_cone: bool,
}

/// Which events at which the light of the picture left are drawn.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum PointChoice {
    /// Those of all vertices.
    #[default]
    All,
    /// None.
    None,
    /// Those of these vertices, with their names.
    Named(Vec<String>),
}

/// Own time between ticks of world lines.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum TickChoice {
    /// A round number, the same for all lines.
    #[default]
    Auto,
    /// No ticks.
    Off,
    /// This time.
    Every(f64),
}
