//! The scenes of the repository, and the paths of its folders.

use std::fs;
use std::path::{Path, PathBuf};

use ugparse::Source;
use ugscene::Scene;

/// The root of the repository.
pub fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .parent()
        .expect("the package is a folder of the repository")
}

/// The target folder in which this program was built.
pub fn target_dir() -> PathBuf {
    let program = std::env::current_exe().expect("a running program has a path");
    let folder = program.parent().expect("a program is in a folder");
    // A test is target/PROFILE/deps/NAME, a program target/PROFILE/NAME.
    let profile = if folder.ends_with("deps") { folder.parent() } else { Some(folder) };
    profile.and_then(Path::parent).expect("the profile is a folder of the target folder").to_owned()
}

/// Names of all scenes, without `.ug`, in order: those in the table of `scenes/README.md`.
/// Files that a user puts beside them are none of ours.
pub fn names() -> Vec<String> {
    let list = root().join("scenes").join("README.md");
    let list =
        fs::read_to_string(&list).unwrap_or_else(|error| panic!("{}: {error}", list.display()));
    let rows = list.lines().filter_map(|line| line.strip_prefix("| `")?.split_once(".ug`"));
    let mut names: Vec<String> = rows.map(|(name, _)| name.to_string()).collect();
    names.sort();
    names
}

/// The text of a scene.
pub fn text(name: &str) -> Vec<u8> {
    let path = root().join("scenes").join(format!("{name}.ug"));
    fs::read(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// Parses a scene.
#[track_caller]
pub fn parse(text: &[u8]) -> Scene {
    let parsed = ugparse::parse(&Source::new("test.ug", text), &ugparse::Options::default());
    parsed.unwrap_or_else(|findings| panic!("{findings}")).scene
}
