//! Decodes and compares pictures, golden ones included.

use std::path::{Path, PathBuf};

use image::{Rgba, RgbaImage};

use crate::scenes::target_dir;

/// A decoded picture.
pub type Picture = RgbaImage;

/// Decodes a PNG.
#[track_caller]
pub fn decode(png: &[u8]) -> Picture {
    let picture = image::load_from_memory_with_format(png, image::ImageFormat::Png);
    picture.unwrap_or_else(|error| panic!("the picture is not a PNG: {error}")).into_rgba8()
}

/// Reads a PNG file.
#[track_caller]
pub fn read(path: &Path) -> Picture {
    decode(&std::fs::read(path).unwrap_or_else(|error| panic!("{}: {error}", path.display())))
}

/// The difference between two pictures of one size.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Difference {
    /// The largest difference of a channel, in levels.
    pub levels: u8,
    /// Pixels that differ at all.
    pub n_pixels: usize,
}

/// Compares two pictures; `None` if their sizes differ.
pub fn difference(a: &Picture, b: &Picture) -> Option<Difference> {
    if a.dimensions() != b.dimensions() {
        return None;
    }
    let levels = a.pixels().zip(b.pixels()).map(|(a, b)| distance(a, b));
    Some(levels.fold(Difference::default(), |sum, levels| Difference {
        levels: sum.levels.max(levels),
        n_pixels: sum.n_pixels + usize::from(levels > 0),
    }))
}

fn distance(a: &Rgba<u8>, b: &Rgba<u8>) -> u8 {
    a.0.iter().zip(b.0).map(|(&a, b)| a.abs_diff(b)).max().expect("a pixel has channels")
}

/// Fails unless no channel of any pixel differs by more than `levels`. A failure writes a picture
/// with expected, difference and actual side by side.
#[track_caller]
pub fn assert_same(name: &str, expected: &Picture, actual: &Picture, levels: u8) {
    let found = difference(expected, actual);
    if found.is_some_and(|found| found.levels <= levels) {
        return;
    }
    let path = save(&format!("{name}-failed"), &panels(expected, actual));
    match found {
        None => panic!(
            "{name}: {:?} pixels, expected {:?}; see {}",
            actual.dimensions(),
            expected.dimensions(),
            path.display()
        ),
        Some(Difference { levels, n_pixels }) => panic!(
            "{name}: {n_pixels} pixels differ, by up to {levels} levels; expected | difference | actual: {}",
            path.display()
        ),
    }
}

/// Fails unless the picture is, to the bit, the one recorded as `tests/golden/NAME.png`.
///
/// With `UG_BLESS=1` in the environment it is recorded instead.
#[track_caller]
pub fn assert_golden(name: &str, actual: &Picture) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("golden").join(format!("{name}.png"));
    if std::env::var_os("UG_BLESS").is_some_and(|value| value == "1") {
        actual.save(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    } else if path.exists() {
        assert_same(name, &read(&path), actual, 0);
    } else {
        let path = save(name, actual);
        panic!(
            "{name} is not recorded: look at {}, then record it with UG_BLESS=1",
            path.display()
        );
    }
}

/// Saves a picture in the target folder, for inspection.
pub fn save(name: &str, picture: &Picture) -> PathBuf {
    let folder = target_dir().join("pictures");
    std::fs::create_dir_all(&folder).expect("the target folder can be written");
    let path = folder.join(format!("{name}.png"));
    picture.save(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    path
}

/// Expected picture, difference and actual picture, side by side. Differences start at mid grey, so
/// that a single level is visible.
fn panels(expected: &Picture, actual: &Picture) -> Picture {
    const GAP: u32 = 4;
    let width = expected.width().max(actual.width());
    let height = expected.height().max(actual.height());
    let mut all = Picture::from_pixel(3 * width + 2 * GAP, height, Rgba([128, 128, 128, 255]));
    let middle = Picture::from_fn(width, height, |x, y| {
        let pixels = (expected.get_pixel_checked(x, y), actual.get_pixel_checked(x, y));
        let levels = match pixels {
            (Some(a), Some(b)) => distance(a, b),
            _ => u8::MAX,
        };
        let shade = if levels == 0 { 0 } else { 127 + levels.div_ceil(2) };
        Rgba([shade, shade, shade, 255])
    });
    for (picture, column) in [expected, &middle, actual].into_iter().zip(0i64..) {
        image::imageops::replace(&mut all, picture, column * i64::from(width + GAP), 0);
    }
    all
}

/// The text of an SVG file, in its order. Slanted symbols are elements of their own.
#[must_use]
pub fn svg_text(svg: &str) -> String {
    let runs =
        svg.split("<text ").skip(1).filter_map(|run| run.split_once('>')?.1.split_once("</text>"));
    runs.map(|(run, _)| run).collect()
}
