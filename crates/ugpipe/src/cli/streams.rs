//! No output destroys an input or another output.

use std::io;
use std::path::Path;

use clap::ArgMatches;

use crate::cli::args::CommonArgs;
use crate::cli::failure::Failure;
use crate::cli::folder::folder_of;
use crate::cli::identity::Identity;

/// A file that the command line names or the shell has opened.
struct Stream {
    /// For messages: `-fm log.txt`.
    name: String,
    identity: Option<Identity>,
}

impl Stream {
    fn file(option: &str, path: &Path) -> Self {
        Self { name: format!("{option} `{}`", path.display()), identity: Identity::of_path(path) }
    }
}

/// Compares all inputs and outputs, by file and not by name, before any is opened, and looks for
/// the folders of outputs before anything is computed.
///
/// # Errors
/// [`Failure::Usage`] if two outputs are one file, or messages or a table go to a file that is
/// read. The main output may replace its input: it is written when all has been read.
/// [`Failure::Write`] if the folder of an output does not exist.
pub(crate) fn check(common: &CommonArgs, matches: &ArgMatches) -> Result<(), Failure> {
    let written = ["at", "keep"].into_iter().flat_map(|id| named(matches, id));
    common.output().into_iter().chain(written).try_for_each(require_folder)?;
    let inputs = inputs(common, matches);
    let secondary = secondary_outputs(common, matches);
    let output = match common.output() {
        Some(path) => Stream::file("-fo", path),
        None => Stream {
            name: "standard output".to_owned(),
            identity: Identity::of_stream(&io::stdout()),
        },
    };
    for (idx, one) in secondary.iter().enumerate() {
        for other in secondary[..idx].iter().chain([&output]) {
            if one.identity.is_some() && one.identity == other.identity {
                let message =
                    format!("two outputs cannot go to one file: {} and {}", other.name, one.name);
                return Err(Failure::Usage(message));
            }
        }
        if let Some(input) = inputs.iter().find(|input| input.identity == one.identity)
            && one.identity.is_some()
        {
            return Err(Failure::Usage(format!(
                "{} would overwrite the input, {}",
                one.name, input.name
            )));
        }
    }
    Ok(())
}

/// Refuses a file in a folder that does not exist. The folder of `frame_%04d/x.png` depends on the
/// frame.
fn require_folder(path: &Path) -> Result<(), Failure> {
    let folder = folder_of(path);
    let is_pattern = folder.as_os_str().as_encoded_bytes().contains(&b'%');
    if is_pattern || folder.exists() {
        return Ok(());
    }
    Err(Failure::Write { name: path.display().to_string(), error: io::ErrorKind::NotFound.into() })
}

fn inputs(common: &CommonArgs, matches: &ArgMatches) -> Vec<Stream> {
    let main = match common.input() {
        Some(path) => Stream::file("file", path),
        None => Stream {
            name: "standard input".to_owned(),
            identity: Identity::of_stream(&io::stdin()),
        },
    };
    let others = named(matches, "files").map(|path| Stream::file("file", path));
    std::iter::once(main).chain(others).collect()
}

fn secondary_outputs(common: &CommonArgs, matches: &ArgMatches) -> Vec<Stream> {
    let tables = named(matches, "at").map(|path| Stream::file("-at", path));
    common.messages().map(|path| Stream::file("-fm", path)).into_iter().chain(tables).collect()
}

/// Files of an option that not every program has.
fn named<'m>(matches: &'m ArgMatches, id: &str) -> impl Iterator<Item = &'m Path> {
    let values = matches.try_get_raw(id).ok().flatten();
    values.into_iter().flatten().map(Path::new).filter(|path| path.as_os_str() != "-")
}
