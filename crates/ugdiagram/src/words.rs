//! Frames and events as words name them.

use std::fmt;
use std::str::FromStr;

/// Whose frame is meant.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum FrameOwner {
    /// The frame in which the scene is written.
    #[default]
    Scene,
    /// That of the camera when the picture is taken.
    Camera,
    /// That of a body, lamp or camera with this name.
    Line(String),
}

/// A frame of reference, as a word names it: `scene`, `camera`, `ship`, or `ship@3`, the one in
/// which an accelerated ship rests at its own time 3.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FrameWord {
    /// Whose frame it is.
    pub owner: FrameOwner,
    /// An own time of the owner, for what accelerates.
    pub own_time: Option<f64>,
}

impl FromStr for FrameWord {
    type Err = String;

    fn from_str(word: &str) -> Result<Self, String> {
        let (name, own_time) = match word.split_once('@') {
            Some((name, time)) => (name, Some(number(time)?)),
            None => (word, None),
        };
        let owner = match name {
            "scene" => FrameOwner::Scene,
            "camera" => FrameOwner::Camera,
            "" => return Err("a frame is scene, camera, or the name of a body".to_owned()),
            name => FrameOwner::Line(name.to_owned()),
        };
        Ok(Self { owner, own_time })
    }
}

impl fmt::Display for FrameWord {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.owner {
            FrameOwner::Scene => f.write_str("scene"),
            FrameOwner::Camera => f.write_str("camera"),
            FrameOwner::Line(name) => f.write_str(name),
        }?;
        self.own_time.map_or(Ok(()), |own_time| write!(f, "@{own_time}"))
    }
}

/// An event, as a word names it.
#[derive(Clone, Debug, PartialEq)]
pub enum EventWord {
    /// `eye`: the event at which the camera takes the picture.
    Eye,
    /// `5,4` or `5,4,0,0`: time, and place along the axis of the diagram or in space, in the frame
    /// of the scene, or `5,4@ship` in another one.
    Numbers {
        /// Two numbers, or four.
        numbers: Vec<f64>,
        /// The frame.
        frame: FrameWord,
    },
    /// `ship@3`: a body, lamp or camera at an own time.
    OwnTime {
        /// Its name.
        name: String,
        /// The own time.
        own_time: f64,
    },
    /// A named event, or the one at which the light of the picture left a vertex.
    Name(String),
}

impl FromStr for EventWord {
    type Err = String;

    fn from_str(word: &str) -> Result<Self, String> {
        let (first, frame) = match word.split_once('@') {
            Some((first, frame)) => (first, Some(frame)),
            None => (word, None),
        };
        if first.contains(',') {
            let numbers = first.split(',').map(number).collect::<Result<Vec<_>, _>>()?;
            if ![2, 4].contains(&numbers.len()) {
                return Err(format!(
                    "`{first}` has {} numbers: an event has a time and a place of 1 or 3",
                    numbers.len()
                ));
            }
            let frame = frame.map(str::parse).transpose()?.unwrap_or_default();
            return Ok(Self::Numbers { numbers, frame });
        }
        match (first, frame) {
            ("", _) => Err("an event is eye, T,X, T,X,Y,Z, NAME@TIME or a name".to_owned()),
            ("eye", None) => Ok(Self::Eye),
            (name, Some(time)) => {
                Ok(Self::OwnTime { name: name.to_owned(), own_time: number(time)? })
            }
            (name, None) => Ok(Self::Name(name.to_owned())),
        }
    }
}

/// An event with a name for the diagram, `NAME=EVENT`.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedEvent {
    /// Its name.
    pub name: String,
    /// The event.
    pub event: EventWord,
}

impl FromStr for NamedEvent {
    type Err = String;

    fn from_str(word: &str) -> Result<Self, String> {
        let (name, event) = word
            .split_once('=')
            .ok_or_else(|| format!("`{word}` is not NAME=EVENT, such as A=5,4"))?;
        let is_name =
            !name.is_empty() && name.chars().all(|c| c.is_alphanumeric() || "_′″:#".contains(c));
        if !is_name || name == "eye" {
            return Err(format!("`{name}` is no name of an event: use letters and digits"));
        }
        Ok(Self { name: name.to_owned(), event: event.parse()? })
    }
}

fn number(word: &str) -> Result<f64, String> {
    let number = word.trim().parse::<f64>().ok().filter(|number| number.is_finite());
    number.ok_or_else(|| format!("`{word}` is not a number"))
}
