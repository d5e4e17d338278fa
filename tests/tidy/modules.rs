//! Every source file is a module of its crate: others are neither compiled nor tested.

use std::collections::{BTreeMap, BTreeSet};

/// Files that no `mod` leads to. `files`: paths below the `src` of a crate, and their texts.
pub fn undeclared(files: &BTreeMap<String, String>) -> Vec<&String> {
    let is_root =
        |path: &&String| matches!(path.as_str(), "lib.rs" | "main.rs") || path.starts_with("bin/");
    let mut queue: Vec<String> = files.keys().filter(is_root).cloned().collect();
    let mut declared: BTreeSet<String> = queue.iter().cloned().collect();
    while let Some(path) = queue.pop() {
        let (folder, file) = path
            .rsplit_once('/')
            .map_or(("", path.as_str()), |(_, file)| (&path[..path.len() - file.len()], file));
        let below = match file {
            "lib.rs" | "main.rs" | "mod.rs" => folder.to_string(),
            _ => format!("{}/", path.trim_end_matches(".rs")),
        };
        for name in modules(&files[&path]) {
            for other in [format!("{below}{name}.rs"), format!("{below}{name}/mod.rs")] {
                if files.contains_key(&other) && declared.insert(other.clone()) {
                    queue.push(other);
                }
            }
        }
    }
    files.keys().filter(|path| !declared.contains(*path)).collect()
}

/// The names of the modules that a file declares without their text.
fn modules(text: &str) -> impl Iterator<Item = &str> {
    let words =
        text.lines().map(|line| line.trim_start_matches("pub(crate) ").trim_start_matches("pub "));
    words.filter_map(|line| line.strip_prefix("mod ")?.strip_suffix(';'))
}
