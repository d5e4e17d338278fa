//! Files of key frames.
//!
//! ```text
//! # frame  options
//! 1        -ti -10   -cv 0 0 0
//! 120      -ti 0
//! 240      -ti 10    -cv 0 .9 0
//! ```

use std::collections::BTreeMap;

use ugpipe::finite;
use ugscene::shorten;

use crate::script::{Script, quantity};
use crate::timeline::Timeline;

/// Numbers of an option by key frame.
type Keys = BTreeMap<u32, Vec<f64>>;

/// Adds the options of a file of key frames to a script.
///
/// Every line has the number of a frame, counted from 1, and options with numbers as on the command
/// line. An option may be left out in a line: its numbers then follow from the frames before and
/// after that have it. Before its first and after its last frame it is constant. `#` begins a
/// comment.
///
/// # Errors
/// The problem, with its line.
pub fn add(script: &mut Script, name: &str, text: &str) -> Result<(), String> {
    let mut options: Vec<(String, Keys)> = Vec::new();
    let mut last = 0;
    for (row, line) in text.lines().enumerate() {
        let at = |problem: String| format!("{name}:{}: {problem}", row + 1);
        let words = line.split('#').next().unwrap_or_default();
        let mut words = words.split_whitespace();
        let Some(first) = words.next() else { continue };
        let frame = first.parse::<u32>().ok().filter(|frame| (1..=script.n_frames).contains(frame));
        let frame = frame.ok_or_else(|| {
            at(format!(
                "a line begins with a frame from 1 to {}, not `{}`",
                script.n_frames,
                shorten(first)
            ))
        })?;
        if frame <= last {
            return Err(at(format!(
                "frame {frame} comes after frame {last}: put them in order, each once"
            )));
        }
        last = frame;
        for (option, numbers) in numbers_of(words).map_err(at)? {
            match options.iter_mut().find(|(other, _)| *other == option) {
                Some((_, keys)) => {
                    keys.insert(frame, numbers);
                }
                None => options.push((option, Keys::from([(frame, numbers)]))),
            }
        }
    }
    if options.is_empty() {
        return Err(format!("{name}: no frame has an option: write lines such as `1 -ti -10`"));
    }
    for (option, keys) in options {
        let keys =
            keys.into_iter().map(|(frame, numbers)| (script.time(f64::from(frame)), numbers));
        let timeline = Timeline::through(keys.collect(), quantity(&option))
            .map_err(|problem| format!("{name}: `-{option}`: {problem}"))?;
        script.add_timeline(&option, timeline).map_err(|failure| format!("{name}: {failure}"))?;
    }
    Ok(())
}

/// The options of a line with their numbers.
fn numbers_of<'w>(words: impl Iterator<Item = &'w str>) -> Result<Vec<(String, Vec<f64>)>, String> {
    let mut options: Vec<(String, Vec<f64>)> = Vec::new();
    for word in words {
        match (finite(word), options.last_mut()) {
            (Ok(number), Some((_, numbers))) => numbers.push(number),
            (Ok(_), None) => return Err(format!("`{word}` stands before any option")),
            (Err(_), _) if word.starts_with('-') => {
                options.push((word.trim_start_matches('-').to_owned(), Vec::new()));
            }
            (Err(_), _) => {
                return Err(format!("`{}` is neither an option nor a number", shorten(word)));
            }
        }
    }
    match options.iter().find(|(_, numbers)| numbers.is_empty()) {
        Some((option, _)) => Err(format!("`-{}` has no number", shorten(option))),
        None => Ok(options),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::options::PIPE;

    fn read(text: &str) -> Result<Script, String> {
        let mut script = Script::new(PIPE, 11);
        add(&mut script, "keys", text).map(|()| script)
    }

    #[test]
    fn options_go_through_their_frames() {
        let script =
            read("# a flight\n1 -ti -10 -ep 0 0 5\n\n6 -ti 0\n11 -ti 30 -ep 0 0 10 # end\n")
                .unwrap();
        let line = |frame| script.commands(frame, &[]).unwrap().line(Some("a.ug".as_ref()), None);
        let begins = |frame, options: &str| {
            let line = line(frame);
            assert!(line.starts_with(&format!("uglorentz a.ug {options} |")), "{line}");
        };
        begins(1.0, "-ti -10 -ep 0 0 5");
        begins(6.0, "-ti 0 -ep 0 0 7.5");
        begins(8.5, "-ti 15 -ep 0 0 8.75");
        begins(11.0, "-ti 30 -ep 0 0 10");
    }

    #[test]
    fn what_is_wrong_is_told_with_its_line() {
        let check =
            |text: &str, expected: &str| assert_eq!(read(text).err().as_deref(), Some(expected));
        check(
            "1 -ti 0\n1 -ti 1",
            "keys:2: frame 1 comes after frame 1: put them in order, each once",
        );
        check("12 -ti 0", "keys:1: a line begins with a frame from 1 to 11, not `12`");
        check("-ti 0", "keys:1: a line begins with a frame from 1 to 11, not `-ti`");
        check("1 0 -ti", "keys:1: `0` stands before any option");
        check("1 -ti", "keys:1: `-ti` has no number");
        check("1 -ti zero", "keys:1: `zero` is neither an option nor a number");
        check("# nothing", "keys: no frame has an option: write lines such as `1 -ti -10`");
        check("1 -vel 0 0 0\n2 -vel 0 0 1", "keys: `-vel`: speed is 1 c: it must be below 1");
        check("1 -ti 0\n2 -ti 0 1", "keys: `-ti`: its values have different counts of numbers");
        assert!(read("1 -rd 5").err().unwrap().contains("it is an option of ugphoton"));
        assert!(read("1 -nonsense 5").err().unwrap().contains("no program has it"));
    }
}
