//! The pictures of the documentation, drawn by the commands in its pages.

use std::collections::BTreeMap;
use std::ffi::OsStr;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use image::imageops::{FilterType, resize};
use image::{RgbImage, open};
use rayon::prelude::*;
use ugtests::documents::{Page, prepare, resized, shrunk, with_options};
use ugtests::scenes;

use crate::programs;

/// The pages, each with the default size of its pictures in pixels.
const PAGES: [(&str, [u32; 2]); 8] = [
    (README, [640, 480]),
    ("docs/gallery.md", [640, 480]),
    ("docs/start.md", [1280, 960]),
    ("docs/motion.md", [640, 480]),
    ("docs/teaching.md", [640, 480]),
    ("docs/concepts.md", [640, 300]),
    ("docs/figures.md", [640, 480]),
    ("docs/diagram.md", [640, 640]),
];

/// The page of which only the film is drawn: its pictures are those of the gallery.
const README: &str = "README.md";

/// Folder of the small pictures, beside the large ones.
const SMALL: &str = "small";

/// The subject to draw.
#[derive(clap::Args)]
pub struct Args {
    /// Only pages whose path contains TEXT
    #[arg(long, value_name = "TEXT")]
    only: Option<String>,
    /// Draw coarsely, store nothing, and fail where a stored picture has other inputs, or looks
    /// different
    #[arg(long)]
    check: bool,
    /// Folder of the programs [default: those of the release profile, built if need be]
    #[arg(long, value_name = "FOLDER")]
    programs: Option<PathBuf>,
}

/// Runs the commands of the pages twice, for large and small pictures, and stores the pictures that
/// the pages show; or compares them.
pub fn write(out: &mut impl Write, args: &Args) -> io::Result<()> {
    let programs = args.programs.clone().unwrap_or_else(programs::released);
    let is_wanted = |path: &str| args.only.as_ref().is_none_or(|only| path.contains(only));
    let wanted = PAGES.into_iter().filter(|(path, _)| is_wanted(path));
    if args.check {
        let pages: Vec<Page> = wanted.map(|(path, _)| Page::read(path)).collect();
        return report(out, pages.par_iter().map(|page| check(page, &programs)).collect());
    }
    for (path, size) in wanted {
        let page = Page::read(path);
        let has_small = path != README && page.text.contains(&format!("/{SMALL}/"));
        for (scale, part) in [(1.0, ""), (0.5, SMALL)].into_iter().take(1 + usize::from(has_small))
        {
            let folder = tempfile::tempdir()?;
            prepare(folder.path(), &programs);
            for command in commands(&page) {
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

/// The commands to run for the pictures of a page.
fn commands(page: &Page) -> impl Iterator<Item = &String> {
    let draws = move |command: &&String| page.path != README || command.contains(".gif");
    page.commands.iter().filter(draws)
}

/// The pictures that a page shows or refers to, relative to its folder.
fn links(page: &Page) -> Vec<&Path> {
    let links = page.text.split("](").skip(1).filter_map(|rest| rest.split(')').next());
    let is_picture = |link: &&Path| {
        ["png", "gif"].iter().any(|kind| link.extension().is_some_and(|ending| ending == *kind))
    };
    links.map(Path::new).filter(is_picture).collect()
}

fn is_small(link: &Path) -> bool {
    link.parent().and_then(Path::file_name).is_some_and(|last| last == SMALL)
}

/// Where the picture of a link is in the repository.
fn place(page: &Page, link: &Path) -> PathBuf {
    scenes::root().join(&page.path).with_file_name("").join(link)
}

/// Copies the pictures that a page refers to, from `folder` to the places that it names, in their
/// subfolder `part`.
fn store(page: &Page, folder: &Path, part: &str) -> io::Result<()> {
    for link in links(page).into_iter().filter(|link| is_small(link) == (part == SMALL)) {
        let (place, Some(name)) = (place(page, link), link.file_name()) else { continue };
        if !folder.join(name).exists() && page.path == README {
            continue;
        }
        if let Some(parent) = place.parent() {
            fs::create_dir_all(parent)?;
        }
        fs::copy(folder.join(name), place)?;
    }
    Ok(())
}

/// Writes the findings of all pages, and fails if a picture is stale.
fn report(out: &mut impl Write, checked: io::Result<Vec<Checked>>) -> io::Result<()> {
    let checked = checked?;
    checked.iter().try_for_each(|page| writeln!(out, "{}", page.summary))?;
    let stale: Vec<&str> =
        checked.iter().flat_map(|page| &page.stale).map(String::as_str).collect();
    if stale.is_empty() {
        return Ok(());
    }
    let stale = stale.join("\n");
    Err(io::Error::other(format!("stale; `cargo xtask gallery` draws them anew:\n{stale}")))
}

/// The findings of a page.
struct Checked {
    summary: String,
    /// The stale pictures, and why they are.
    stale: Vec<String>,
}

/// Draws the pictures of a page coarsely, and compares those that are stored.
fn check(page: &Page, programs: &Path) -> io::Result<Checked> {
    let folder = tempfile::tempdir()?;
    prepare(folder.path(), programs);
    let is_still = |command: &&String| !command.contains(".gif") && !command.contains(".mp4");
    for command in commands(page).filter(is_still) {
        page.run(&shrunk(command), folder.path(), programs).map_err(io::Error::other)?;
    }
    let links: BTreeMap<&Path, bool> =
        links(page).into_iter().map(|link| (link, is_small(link))).collect();
    let (mut stale, mut n_inputs, mut greatest) = (Vec::new(), 0, 0.0_f64);
    for (link, is_small) in links {
        let Some(drawn) = link.file_name().map(|name| folder.path().join(name)) else { continue };
        if link.extension().is_none_or(|kind| kind != "png") || !drawn.exists() {
            continue;
        }
        let stored = place(page, link);
        let now = inputs(page, &drawn)?;
        if now != inputs(page, &stored)? {
            stale.push(format!("{}: drawn from other inputs", stored.display()));
        }
        n_inputs += now.len();
        // Both sizes come from one command.
        if !is_small && !link.file_name().is_some_and(|name| is_sheet(page, name)) {
            let difference = difference(&drawn, &stored)?;
            greatest = greatest.max(difference);
            if difference > MOST_DIFFERENT {
                stale.push(format!("{}: looks different by {difference:.3}", stored.display()));
            }
        }
    }
    let summary = format!("{}: {n_inputs} inputs, difference up to {greatest:.3}", page.path);
    Ok(Checked { summary, stale })
}

/// What a picture records of its inputs, in order: the SHA-256 of each file. Files that the page
/// itself draws are left out, since coarse ones differ.
fn inputs(page: &Page, picture: &Path) -> io::Result<Vec<String>> {
    // The text of PNG files is not compressed.
    let bytes = fs::read(picture)?;
    let text = String::from_utf8_lossy(&bytes);
    let is_drawn = |name: &str| {
        let output = format!("> {name}");
        !name.is_empty() && page.commands.iter().any(|command| command.contains(&output))
    };
    let recorded = text.split("SHA-256 ").skip(1).filter_map(|rest| {
        let (hash, rest) = rest.split_at_checked(64)?;
        let name = rest.split([';', ',', '\n', '\0']).next().unwrap_or_default().trim();
        (!is_drawn(name)).then(|| hash.to_owned())
    });
    Ok(recorded.collect())
}

/// True if a picture is a sheet of others. Labels keep their size, so a coarse sheet has another
/// layout.
fn is_sheet(page: &Page, name: &OsStr) -> bool {
    let output = format!("> {}", name.display());
    page.commands.iter().any(|command| command.contains("ugsheet") && command.contains(&output))
}

/// Pictures differ if the mean difference of their 8-bit values, over 255, is greater. Coarse
/// pictures of the same programs differ by up to 0.09, where there are thin lines.
const MOST_DIFFERENT: f64 = 0.12;

/// The mean difference of two pictures, both reduced to a few thousand pixels.
fn difference(a: &Path, b: &Path) -> io::Result<f64> {
    const WIDTH: u32 = 64;
    const HEIGHT: u32 = 48;
    let reduced = |path: &Path| -> io::Result<RgbImage> {
        let picture = open(path).map_err(io::Error::other)?.to_rgb8();
        Ok(resize(&picture, WIDTH, HEIGHT, FilterType::Triangle))
    };
    let (a, b) = (reduced(a)?, reduced(b)?);
    let sum: f64 = a.iter().zip(b.iter()).map(|(&a, &b)| f64::from(a.abs_diff(b))).sum();
    Ok(sum / 255.0 / f64::from(3 * WIDTH * HEIGHT))
}
