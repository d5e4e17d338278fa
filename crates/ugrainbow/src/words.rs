//! Words of the command line as values.

use ugimage::{Format, Tone};
use ugphysics::{Brightness, Hsv};
use ugpipe::{Failure, finite};
use ugraster::Filter;

use crate::config::{Exposure, MAX_LINE_WIDTH};
use crate::planes::Channel;

/// What `-ch` names.
#[derive(Clone, Debug, Default)]
pub struct Channels(pub Vec<Channel>);

/// A column and a row.
pub type Pixel = [u32; 2];

/// What is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    Picture(Format),
    Report(Report),
}

/// How a pixel is explained.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Report {
    Text,
    Json,
}

/// A format of pictures.
pub fn format_named(name: &str) -> Result<Format, String> {
    Format::from_name(name).ok_or_else(|| format!("none of the formats {}", Format::list()))
}

/// A format of pictures or of explanations.
pub fn kind_named(name: &str) -> Result<Kind, String> {
    match name {
        "text" => Ok(Kind::Report(Report::Text)),
        "json" => Ok(Kind::Report(Report::Json)),
        name => format_named(name).map(Kind::Picture),
    }
}

/// `320,240`
pub fn pixel(word: &str) -> Result<Pixel, String> {
    let numbers =
        word.split_once(',').and_then(|(x, y)| Some([x.trim().parse().ok()?, y.trim().parse().ok()?]));
    numbers.ok_or_else(|| "a pixel is its column and row, such as 320,240".to_owned())
}

/// A colour as in a `c` statement: lightness alone is grey, with a hue it is pure.
pub fn color(name: &str, numbers: &[f64]) -> Result<Hsv, Failure> {
    let (value, hue, saturation) = match numbers {
        [value] => (*value, 0.0, 0.0),
        [value, hue] => (*value, *hue, 1.0),
        [value, hue, saturation, ..] => (*value, *hue, *saturation),
        [] => (0.0, 0.0, 0.0),
    };
    let is_part = |number: f64| (0.0..=1.0).contains(&number);
    if !is_part(value) || !is_part(saturation) {
        return Err(Failure::Usage(format!("lightness and saturation of the {name} are from 0 to 1")));
    }
    Ok(Hsv { hue, saturation, value })
}

/// Width of lines in pixels.
pub fn line_width(word: &str) -> Result<f64, String> {
    let width = finite(word)?;
    if 0.0 < width && width <= MAX_LINE_WIDTH {
        Ok(width)
    } else {
        Err(format!("a line is more than 0 and at most {MAX_LINE_WIDTH} pixels wide"))
    }
}

/// Stops, or `auto`.
pub fn exposure(word: &str) -> Result<Exposure, String> {
    /// More than the range of the numbers light is kept in.
    const MOST: f64 = 300.0;
    if word == "auto" {
        return Ok(Exposure::Auto);
    }
    let stops = finite(word).map_err(|error| format!("{error}, nor is it `auto`"))?;
    if stops.abs() <= MOST {
        Ok(Exposure::Stops(stops))
    } else {
        Err(format!("an exposure is between -{MOST} and {MOST} stops"))
    }
}

/// The name of a brightness law.
pub fn law(word: &str) -> Result<Brightness, String> {
    Brightness::from_name(word)
        .ok_or_else(|| format!("none of the laws {}", Brightness::ALL.map(Brightness::name).join(", ")))
}

/// The name of a tone curve.
pub fn tone(word: &str) -> Result<Tone, String> {
    Tone::from_name(word)
        .ok_or_else(|| format!("none of the curves {}", Tone::ALL.map(Tone::name).join(", ")))
}

/// The name of a filter.
pub fn filter(word: &str) -> Result<Filter, String> {
    Filter::from_name(word)
        .ok_or_else(|| format!("none of the filters {}", Filter::ALL.map(Filter::name).join(", ")))
}

/// Each once, in the order given.
pub fn channels(list: &str) -> Result<Channels, String> {
    let mut channels = Vec::new();
    for name in list.split(',') {
        let channel = Channel::from_name(name)
            .ok_or_else(|| format!("`{name}` is none of the channels {}", Channel::list()))?;
        if !channels.contains(&channel) {
            channels.push(channel);
        }
    }
    Ok(Channels(channels))
}
