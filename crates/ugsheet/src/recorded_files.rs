//! The files that a picture records beside the input of its pipe: textures, skies, included files.

use std::path::Path;

use ugpipe::{Context, MAX_INPUT, sha256};

use crate::shell_words::{self, HASH};

/// Says which of the files in a history have changed since the picture was drawn.
pub fn inspect(history: &str, context: &Context) {
    let mut known: Vec<&str> = Vec::new();
    for line in history.lines().filter(|line| !shell_words::is_recipe(line)) {
        let record = line.strip_prefix(HASH).and_then(|record| record.split_once(' '));
        let Some((hash, name)) = record.filter(|_| !known.contains(&line)) else { continue };
        known.push(line);
        // Standard input has no file.
        let Some(name) = shell_words::split(name).pop().filter(|name| name != "-") else {
            continue;
        };
        match context.read_here(Path::new(&name), MAX_INPUT) {
            Ok(text) if sha256(&text) == hash => {}
            Ok(_) => context.warn(&format!("`{name}` has changed since the picture was drawn")),
            Err(_) if hash == "none" => {}
            Err(_) => {
                context.note(&format!("`{name}` is not in this folder: run the pipe in its folder"))
            }
        }
    }
}
