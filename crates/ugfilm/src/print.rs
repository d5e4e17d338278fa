//! The commands of frames as a script for a shell.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use ugimage::Format;
use ugpipe::Failure;
use ugsheet::film::FrameNames;

use crate::film::Film;
use crate::script::DONE_TO_LIGHT;

/// A path as a word of a command line, which is not an option.
pub fn argument(path: PathBuf) -> PathBuf {
    let is_option = path.as_os_str().as_encoded_bytes().starts_with(b"-");
    if is_option { Path::new(".").join(path) } else { path }
}

/// The commands of these frames, one in a line. Of a frame with motion blur, those of its moments
/// after a comment. `input`: the scene or panorama of all frames, `None` for standard input;
/// `names`: the files of frames.
///
/// # Errors
/// A caption asks for what the frame does not have.
pub fn script(
    film: &Film<'_>,
    frames: impl Iterator<Item = u32>,
    names: &FrameNames,
    input: Option<&Path>,
) -> Result<String, Failure> {
    let own = |moment: f64| film.subjects.file(moment).map(argument);
    let mut text = String::new();
    for frame in frames {
        let file = names.path(frame);
        let Some(moments) = film.moments(frame) else {
            let mut commands = film.script.commands(f64::from(frame), &[])?;
            commands.set_format(film.format);
            text += &commands.line(own(frame.into()).as_deref().or(input), Some(&file));
            text.push('\n');
            continue;
        };
        let develop = match film.format.is_linear() {
            true => String::new(),
            false => film.script.development(f64::from(frame)),
        };
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "# frame {frame} is the mean light of the next {} pictures{develop}",
            moments.len()
        );
        for (row, moment) in (1..).zip(moments) {
            let mut commands = film.script.commands(moment, DONE_TO_LIGHT)?;
            commands.set_format(Format::Exr);
            let file = file.with_extension(format!("{row:02}.exr"));
            text += &commands.line(own(moment).as_deref().or(input), Some(&file));
            text.push('\n');
        }
    }
    Ok(text)
}
