//! The pictures of the documentation, drawn by the commands in its pages.

use std::fs;
use std::io::{self, Write};
use std::path::Path;

use ugtests::documents::{Page, copy_scenes, resized};
use ugtests::{programs, scenes};

/// The pages, each with the default size of its pictures in pixels.
const PAGES: [(&str, [u32; 2]); 2] = [("docs/gallery.md", [640, 480]), ("docs/start.md", [1280, 960])];

/// Folder of the small pictures, beside the large ones.
const SMALL: &str = "small";

/// Runs the commands of all pages twice, for large and small pictures, and stores the pictures that
/// the pages show. Only pages whose path contains `only`.
pub fn write(out: &mut impl Write, only: Option<&str>) -> io::Result<()> {
    let programs = programs::released();
    for (path, size) in PAGES.into_iter().filter(|(path, _)| only.is_none_or(|only| path.contains(only))) {
        let page = Page::read(path);
        for (scale, part) in [(1.0, ""), (0.5, SMALL)] {
            let folder = tempfile::tempdir()?;
            copy_scenes(folder.path());
            for command in &page.commands {
                writeln!(out, "{path}: {}", command.lines().next().unwrap_or_default())?;
                out.flush()?;
                let command = resized(command, size, scale).replace("ugrainbow ", "ugrainbow -pz ");
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
    let pictures = links.map(Path::new).filter(|link| link.extension().is_some_and(|ending| ending == "png"));
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
