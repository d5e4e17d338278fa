//! Runs every command in the pages of the documentation, in a copy of `scenes/`.

use ugtests::documents::{Page, prepare, resized, written_files};
use ugtests::programs;

/// Pages with commands for a folder with scenes, and the least number of commands.
const PAGES: [(&str, usize); 6] = [
    ("README.md", 18),
    ("docs/start.md", 9),
    ("docs/gallery.md", 60),
    ("docs/pipeline.md", 18),
    ("docs/meshes.md", 4),
    ("docs/geometry.md", 1),
];

#[test]
fn commands_in_documents_work() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let programs = programs::of_this_profile();
    prepare(folder.path(), &programs);
    for (path, least) in PAGES {
        let page = Page::read(path);
        assert!(page.commands.len() >= least, "{path}: {} commands", page.commands.len());
        for command in &page.commands {
            // Smaller pictures are sufficient, unless they need room for text.
            let has_text = command.contains("-lg") || command.contains("-cap");
            let small = if has_text { command.clone() } else { resized(command, [640, 480], 0.25) };
            let small = small.replace("ugrainbow ", "ugrainbow -aa 1 ");
            let messages =
                page.run(&small, folder.path(), &programs).unwrap_or_else(|message| panic!("{message}"));
            // Frames of a film may be empty, before a body comes; lines may be black.
            let is_drawn = command.starts_with("for ")
                || command.contains("-lc 0")
                || !messages.contains("nothing is drawn") && !messages.contains("is black");
            assert!(is_drawn, "{path}: {command}: {messages}");
            for file in written_files(command) {
                let size = std::fs::metadata(folder.path().join(&file)).map_or(0, |made| made.len());
                assert!(size > 300, "{path}: {command}: {} has {size} bytes", file.display());
            }
        }
    }
}
