//! Every scene in `scenes/bad/` fails with the message recorded next to it.
//!
//! `UG_BLESS=1` re-records the messages; review the difference.

use std::path::{Path, PathBuf};

use ugparse::{Diagnostics, Options, Parsed, Request, Source};

const MIN_SCENES: usize = 40;

#[test]
fn bad_scenes_fail_with_their_recorded_message() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/bad");
    let mut scenes = files(&folder, "ug");
    if std::env::var_os("UG_BLESS").is_none() {
        // Others are a user's own; `tests/tidy.rs` finds those of the repository without a message.
        scenes.retain(|path| path.with_extension("expected").exists());
    }
    assert!(scenes.len() >= MIN_SCENES, "only {} scenes in {}", scenes.len(), folder.display());
    let mut wrong = Vec::new();
    for path in &scenes {
        let name = format!("scenes/bad/{}", path.file_name().unwrap().to_str().unwrap());
        let found = match parse(Source::new(&name, std::fs::read(path).unwrap())) {
            Ok(_) => panic!("{name} can be read"),
            Err(found) => found.worded().render(false) + "\n",
        };
        let expected_path = path.with_extension("expected");
        if std::env::var_os("UG_BLESS").is_some() {
            std::fs::write(&expected_path, &found).unwrap();
        }
        let expected = std::fs::read_to_string(&expected_path).unwrap_or_default();
        if found != expected {
            wrong.push(format!("{name}\n--- expected\n{expected}--- found\n{found}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// Reads a scene, and tables, but no included files.
fn parse(source: Source) -> Result<Parsed, Diagnostics> {
    let options = Options::default();
    if !String::from_utf8_lossy(&source.text).contains(".csv") {
        return ugparse::parse(&source, &options);
    }
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let load = |request: &Request<'_>| Ok(std::fs::read(root.join(request.path))?);
    ugparse::parse(&ugparse::include(source, &options, load)?, &options)
}

/// The files of a folder with an extension, sorted.
fn files(folder: &Path, extension: &str) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let mut files: Vec<PathBuf> =
        entries.filter(|path| path.extension().is_some_and(|e| e == extension)).collect();
    files.sort();
    files
}
