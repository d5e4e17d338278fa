//! Runs every command in the pages of the documentation, in a copy of `scenes/`.

use ugtests::documents::{Page, copy_scenes, resized, written_files};
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

/// Makes the files that the pages take for granted: a mesh of the reader's own, in several formats,
/// and a scene that has been through `uglorentz`.
const PREPARATION: &str = "\
    ugmesh -dt obj scenes/teapot.ug -fo teapot.obj; \
    ugmesh -dt obj scenes/sphere.ug -fo bunny.obj; \
    ugmesh -dt ply scenes/sphere.ug -fo bunny.ply; \
    printf 'cam -ep 0 -6 1 -vc 0 0 0 -ud 0 0 1 -va 40 30 ; l .3 ; l .7 0 -1 1 ;' > stage.ug; \
    uglorentz -vel .3 0 0 -in scenes/ship.ug | ugdoppler > seen.ug";

#[test]
fn commands_in_documents_work() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    copy_scenes(folder.path());
    let programs = programs::of_this_profile();
    let all = Page::read("README.md");
    all.run(PREPARATION, folder.path(), &programs).unwrap_or_else(|message| panic!("{message}"));
    for (path, least) in PAGES {
        let page = Page::read(path);
        assert!(page.commands.len() >= least, "{path}: {} commands", page.commands.len());
        for command in &page.commands {
            // Smaller pictures are sufficient.
            let small = resized(command, [640, 480], 0.25).replace("ugrainbow ", "ugrainbow -aa 1 ");
            let messages =
                page.run(&small, folder.path(), &programs).unwrap_or_else(|message| panic!("{message}"));
            let is_drawn = !messages.contains("nothing is drawn") && !messages.contains("is black");
            assert!(is_drawn, "{path}: {command}: {messages}");
            for file in written_files(command) {
                let size = std::fs::metadata(folder.path().join(&file)).map_or(0, |made| made.len());
                assert!(size > 300, "{path}: {command}: {} has {size} bytes", file.display());
            }
        }
    }
}
