//! Files of the repository, without those a user put beside them.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::scenes::root;

/// All files below the root that git tracks or that were just added, in order. In a copy
/// without git, all files except those that tools make.
pub fn files() -> Vec<PathBuf> {
    let mut git = Command::new("git");
    git.args(["ls-files", "-z"]).current_dir(root());
    let listed =
        git.output().ok().filter(|output| output.status.success() && !output.stdout.is_empty());
    let mut files: Vec<PathBuf> = match listed {
        Some(output) => {
            let names = output.stdout.split(|&byte| byte == 0).filter(|name| !name.is_empty());
            names.map(|name| root().join(String::from_utf8_lossy(name).as_ref())).collect()
        }
        None => below(root()),
    };
    // A file that is deleted but not yet in a commit is still listed.
    files.retain(|path| path.is_file());
    files.sort();
    files
}

fn below(folder: &Path) -> Vec<PathBuf> {
    let entries =
        fs::read_dir(folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let paths = entries.map(|entry| entry.expect("a folder can be listed").path());
    let is_made = |path: &PathBuf| {
        path.ends_with(".git") || path.ends_with("target") || path.ends_with("figures")
    };
    paths
        .filter(|path| !is_made(path))
        .flat_map(|path| if path.is_dir() { below(&path) } else { vec![path] })
        .collect()
}
