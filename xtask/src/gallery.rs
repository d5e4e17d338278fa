//! The pictures of the documentation, drawn by the commands in its pages.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use ugtests::documents::{Page, prepare, resized, with_options};
use ugtests::scenes;

use crate::programs;

/// The pages, each with the default size of its pictures in pixels.
const PAGES: [(&str, [u32; 2]); 5] = [
    ("docs/gallery.md", [640, 480]),
    ("docs/start.md", [1280, 960]),
    ("docs/motion.md", [640, 480]),
    ("docs/teaching.md", [640, 480]),
    ("docs/figures.md", [640, 480]),
];

/// Folder of the small pictures, beside the large ones.
const SMALL: &str = "small";

/// The subject to draw.
#[derive(clap::Args)]
pub struct Args {
    /// Only pages whose path contains TEXT
    #[arg(long, value_name = "TEXT")]
    only: Option<String>,
    /// Folder of the programs [default: those of the release profile, built if need be]
    #[arg(long, value_name = "FOLDER")]
    programs: Option<PathBuf>,
}

/// Runs the commands of the pages twice, for large and small pictures, and stores the pictures that
/// the pages show.
pub fn write(out: &mut impl Write, args: &Args) -> io::Result<()> {
    let programs = args.programs.clone().unwrap_or_else(programs::released);
    let is_wanted = |path: &str| args.only.as_ref().is_none_or(|only| path.contains(only));
    for (path, size) in PAGES.into_iter().filter(|(path, _)| is_wanted(path)) {
        let page = Page::read(path);
        let has_small = page.text.contains(&format!("/{SMALL}/"));
        for (scale, part) in [(1.0, ""), (0.5, SMALL)].into_iter().take(1 + usize::from(has_small))
        {
            let folder = tempfile::tempdir()?;
            prepare(folder.path(), &programs);
            for command in &page.commands {
                writeln!(out, "{path}: {}", command.lines().next().unwrap_or_default())?;
                out.flush()?;
                let command = resized(command, size, scale);
                // Films are packed as they are.
                let command =
                    if command.contains(".gif") { command } else { with_options(&command, "-pz") };
                page.run(&command, folder.path(), &programs).map_err(io::Error::other)?;
            }
            store(&page, folder.path(), part)?;
        }
    }
    Ok(())
}

/// Copies the pictures that a page refers to, from `folder` to the places that it names, in their
/// subfolder `part`.
fn store(page: &Page, folder: &Path, part: &str) -> io::Result<()> {
    let links = page.text.split("](").skip(1).filter_map(|rest| rest.split(')').next());
    let is_picture = |link: &&Path| {
        ["png", "gif"].iter().any(|kind| link.extension().is_some_and(|ending| ending == *kind))
    };
    let pictures = links.map(Path::new).filter(is_picture);
    for link in pictures {
        let (Some(place), Some(name)) = (link.parent(), link.file_name()) else { continue };
        if (place.file_name().is_some_and(|last| last == SMALL)) != (part == SMALL) {
            continue;
        }
        let place = scenes::root().join("docs").join(place);
        fs::create_dir_all(&place)?;
        fs::copy(folder.join(name), place.join(name))?;
    }
    Ok(())
}
