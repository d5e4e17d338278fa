//! The programs, for tests and shells.

use std::env;
use std::ffi::OsString;
use std::fs;
use std::io::ErrorKind;
use std::os::unix::fs::symlink;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::LazyLock;

use ugpipe::remedies::PROGRAMS;

/// The folder of the programs: that of the variable `UG_PROGRAMS`, or else one with a link of each
/// name to `ugtests-programs`, which cargo builds beside the tests.
pub fn folder() -> &'static Path {
    static FOLDER: LazyLock<PathBuf> =
        LazyLock::new(|| env::var_os("UG_PROGRAMS").map_or_else(linked, PathBuf::from));
    &FOLDER
}

fn linked() -> PathBuf {
    let test = env::current_exe().expect("a running program has a path");
    let profile = test.parent().and_then(Path::parent).expect("a test is target/PROFILE/deps/NAME");
    let folder = profile.join("programs");
    fs::create_dir_all(&folder).expect("the target folder can be written");
    for name in PROGRAMS {
        let made = symlink("../ugtests-programs", folder.join(name));
        // Tests in several processes make the same links.
        if let Err(error) = made {
            assert!(error.kind() == ErrorKind::AlreadyExists, "{}: {error}", folder.display());
        }
    }
    folder
}

/// The path variable with the folder of the programs in front.
pub fn path() -> OsString {
    let system = env::var_os("PATH").unwrap_or_default();
    let folders = std::iter::once(folder().to_owned()).chain(env::split_paths(&system));
    env::join_paths(folders).expect("a path without colons")
}

/// Runs a command such as `uglorentz -in` with `input` on its standard input.
#[track_caller]
pub fn fed(command: &str, input: impl AsRef<[u8]>) -> Output {
    let mut words = command.split_whitespace();
    let program = folder().join(words.next().expect("a program"));
    ugtesting::run::fed(Command::new(program).args(words), input)
}
