//! The labels under the pictures.

use glam::DVec3;
use ugimage::Metadata;
use ugimage::label::number::{significant, speed};
use ugphysics::Velocity;

use crate::error::Error;
use crate::{Picture, shell_words};

/// How pictures are labelled.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Labels {
    /// Speed and time of the pictures, as far as the pictures differ in them;
    /// otherwise their names.
    Auto,
    /// The file names.
    Names,
    /// No labels.
    None,
    /// The given labels, one for each picture.
    Given(Vec<String>),
}

impl Labels {
    /// The label of each picture.
    pub fn texts(&self, pictures: &[Picture]) -> Vec<String> {
        let names = || pictures.iter().map(|picture| picture.name.clone()).collect();
        match self {
            Self::Auto => by_motion(pictures).unwrap_or_else(names),
            Self::Names => names(),
            Self::None => vec![String::new(); pictures.len()],
            Self::Given(texts) => texts.clone(),
        }
    }

    /// Like [`Labels::texts`], and checks that there is one label for each picture.
    ///
    /// # Errors
    /// [`Error::Empty`] if there are no pictures, [`Error::Count`] if the numbers differ.
    pub fn checked(&self, pictures: &[Picture]) -> Result<Vec<String>, Error> {
        let texts = self.texts(pictures);
        match (texts.len(), pictures.len()) {
            (_, 0) => Err(Error::Empty),
            (labels, pictures) if labels != pictures => Err(Error::Count { labels, pictures }),
            _ => Ok(texts),
        }
    }
}

/// Labels by the motion of the pictures. `None` if it does not distinguish them.
fn by_motion(pictures: &[Picture]) -> Option<Vec<String>> {
    let speed_of = |picture: &Picture| {
        let velocity = picture.motion.velocity.filter(|velocity| !velocity.is_zero());
        velocity.map(|velocity| format!("β = {}", speed(velocity)))
    };
    let speeds: Vec<Option<String>> = pictures.iter().map(speed_of).collect();
    let times = times(pictures);
    let has_speeds = speeds.iter().any(Option::is_some) && differ(&speeds);
    let has_times = times.iter().any(Option::is_some) && differ(&times);
    let label = |(speed, time): (&Option<String>, &Option<String>)| {
        let speed = speed.clone().unwrap_or_else(|| "at rest".to_owned());
        let time = format!("t = {}", time.as_deref().unwrap_or("0"));
        match (has_speeds, has_times) {
            (true, true) => format!("{speed}, {time}"),
            (true, false) => speed,
            _ => time,
        }
    };
    let labels: Vec<String> = speeds.iter().zip(&times).map(label).collect();
    // If neighbours had the same label, the labels would not show how they differ.
    let are_distinct = labels.windows(2).all(|pair| pair[0] != pair[1]);
    ((has_speeds || has_times) && are_distinct).then_some(labels)
}

/// The times of pictures, with three digits, or as many more as distinguish them.
fn times(pictures: &[Picture]) -> Vec<Option<String>> {
    let with = |digits: usize| -> Vec<Option<String>> {
        pictures
            .iter()
            .map(|picture| picture.motion.time.map(|time| significant(time, digits)))
            .collect()
    };
    let are_distinct = |texts: &Vec<Option<String>>| {
        let differ = |[a, b]: [usize; 2]| {
            pictures[a].motion.time == pictures[b].motion.time || texts[a] != texts[b]
        };
        (1..texts.len()).all(|idx| (0..idx).all(|other| differ([other, idx])))
    };
    (3..6).map(with).find(are_distinct).unwrap_or_else(|| with(6))
}

fn differ(texts: &[Option<String>]) -> bool {
    texts.windows(2).any(|pair| pair[0] != pair[1])
}

/// The motion in a picture, as far as it is known.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Motion {
    /// The velocity of what is seen, or of the camera.
    pub velocity: Option<Velocity>,
    /// The time of the observer.
    pub time: Option<f64>,
}

impl Motion {
    /// The options in the history of a picture that set them.
    pub fn recorded(history: &Metadata) -> Self {
        const OPTIONS: [&str; 6] =
            ["-vel", "--velocity", "-cv", "--camera-velocity", "-ti", "--time"];
        let lines = history.comment.lines().filter(|line| !shell_words::is_recipe(line));
        let lines = lines.rev().map(shell_words::split);
        let mut with_options =
            lines.filter(|words| words.iter().any(|word| OPTIONS.contains(&word.as_str())));
        let words = with_options.next().unwrap_or_default();
        let numbers = |options: [&str; 2], n: usize| {
            let at = words.iter().position(|word| options.contains(&word.as_str()))?;
            let numbers: Option<Vec<f64>> =
                words.get(at + 1..at + 1 + n)?.iter().map(|word| word.parse().ok()).collect();
            numbers
        };
        let beta =
            numbers(["-vel", "--velocity"], 3).or_else(|| numbers(["-cv", "--camera-velocity"], 3));
        Self {
            velocity: beta.and_then(|beta| Velocity::from_beta(DVec3::from_slice(&beta)).ok()),
            time: numbers(["-ti", "--time"], 1).map(|time| time[0]),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(labels: &Labels, comments: &[&str]) -> Vec<String> {
        let picture = |(idx, comment): (usize, &&str)| {
            let history = Metadata {
                software: String::new(),
                comment: (*comment).to_owned(),
                ..Metadata::default()
            };
            Picture {
                name: format!("n{idx}"),
                size: [1; 2],
                motion: Motion::recorded(&history),
                history,
            }
        };
        labels.texts(&comments.iter().enumerate().map(picture).collect::<Vec<_>>())
    }

    #[test]
    fn labels_show_what_differs() {
        let rows: [(&[&str], &[&str]); 10] = [
            (&["uglorentz", "uglorentz -vel .9 0 0 -in"], &["at rest", "β = 0.9"]),
            (
                &["uglorentz -vel 0 -.3 .4", "uglorentz -cv .999 0 0\nugdoppler"],
                &["β = 0.5", "β = 0.999"],
            ),
            (
                &["uglorentz -vel .9 0 0 -ti -7", "uglorentz -vel .9 0 0 -ti 12"],
                &["t = −7", "t = 12"],
            ),
            (&["uglorentz -ti -5.55102", "uglorentz -ti 1.23456"], &["t = −5.55", "t = 1.23"]),
            (&["uglorentz -ti 5.55102", "uglorentz -ti 5.55201"], &["t = 5.551", "t = 5.552"]),
            (
                &["ugphoton -cv 0 .5 0", "ugphoton -cv 0 .9 0", "ugphoton -cv 0 .5 0"],
                &["β = 0.5", "β = 0.9", "β = 0.5"],
            ),
            (
                &["uglorentz -vel .9 0 0", "uglorentz -ti 2.5 -vel .5 0 0"],
                &["β = 0.9, t = 0", "β = 0.5, t = 2.5"],
            ),
            (&["uglorentz -vel .9 0 0\nugdoppler", "uglorentz -vel .9 0 0"], &["n0", "n1"]),
            (
                &["uglorentz -vel .9 0 0", "uglorentz -vel .5 0 0", "uglorentz -vel -.5 0 0"],
                &["n0", "n1", "n2"],
            ),
            (&["", "not ours"], &["n0", "n1"]),
        ];
        for (comments, expected) in rows {
            assert_eq!(texts(&Labels::Auto, comments), expected);
        }
        assert_eq!(texts(&Labels::Names, &["uglorentz", "uglorentz -vel .9 0 0"]), ["n0", "n1"]);
    }

    #[test]
    fn malformed_histories_give_no_labels() {
        for line in [
            "uglorentz -vel",
            "uglorentz -vel .9 0",
            "uglorentz -vel 2 0 0",
            "uglorentz -vel a b c",
            "uglorentz '",
        ] {
            let history = Metadata {
                software: String::new(),
                comment: line.to_owned(),
                ..Metadata::default()
            };
            assert_eq!(Motion::recorded(&history), Motion::default(), "{line}");
        }
    }
}
