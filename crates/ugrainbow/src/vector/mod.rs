//! Vector figures: the faces of the picture as areas in paint order, and wires as lines.
//!
//! 1. The polygons of the draw list, at a scale at which hardly any is too thin for it ([`patch`]).
//! 2. Faces of which no sample is seen, nor of any neighbour, are left out ([`seen`]).
//! 3. The rest is put in order, from behind ([`order`]), and cut only where faces cut each other or hide each
//!    other in a ring. Parts that are hidden are painted over, not cut out.
//! 4. Each becomes a plain area, or smooth ones, cut until their colours are right ([`smooth`]).
//! 5. Wires come last, without their hidden parts ([`lines`]).

mod color;
mod convex;
mod index;
mod lines;
mod order;
mod patch;
mod seen;
mod smooth;

use ugimage::figure::{self, Figure};
use ugimage::{Development, Format, Label};

use crate::canvas;
use crate::config::Config;
use crate::error::{Error, MAX_PIXELS};
use crate::figures::Annotations;
use crate::setup::Setup;
use crate::sheet::Sheet;
use color::{Palette, rounded};
use index::Index;
use patch::Patch;
use smooth::{Smooth, push_piece};
use ugparse::Scene;
use ugphysics::srgb_encode;

/// Rows of samples a pixel, if the picture is not too large.
const FINEST: u32 = 8;

/// Most samples by which it is found out what is seen.
const MOST_SAMPLES: u64 = MAX_PIXELS / 4;

/// The file of a figure. `development`: how the light of the picture is developed, if it is; `annotations`: what is
/// drawn over the scene.
///
/// # Errors
/// As for pictures.
pub fn file(
    scene: &Scene,
    config: &Config,
    format: Format,
    development: Option<Development>,
    annotations: &Annotations,
    label: &Label,
) -> Result<Vec<u8>, Error> {
    Ok(match format {
        Format::Svg => figure::svg(&figure(scene, config, development, annotations)?, label),
        Format::Pdf => figure::pdf(&figure(scene, config, development, annotations)?, label),
        Format::Ps => figure::ps(&figure(scene, config, development, annotations)?, label),
        _ => figure::eps(&figure(scene, config, development, annotations)?, label),
    })
}

/// The figure of a scene.
fn figure<S: Smooth>(
    scene: &Scene,
    config: &Config,
    development: Option<Development>,
    annotations: &Annotations,
) -> Result<Figure<S>, Error> {
    let scale = scale(config.size);
    let fine = Config { size: config.size.map(|side| side * scale), samples: 1, ..config.clone() };
    let setup = Setup::new(scene, &fine)?;
    let sheet = Sheet::new(setup.painter(), None);
    let is_shown = seen::faces(&setup, &sheet);
    let (faces, wires) = patches(&sheet, &setup, config.size, f64::from(scale), &is_shown);
    let palette = Palette { sheet: &sheet, shader: &setup.shader, development };
    let index = Index::new(&faces, config.size);
    let mut elements = Vec::new();
    for piece in order::painting_order(&faces, &index) {
        push_piece(&palette, &faces, &piece, &mut elements);
    }
    lines::push_lines(&palette, &wires, &faces, &index, config.size, f64::from(scale), &mut elements);
    let background = canvas::ground(config, development)
        .map(|light| rounded(light.map(|part| 255.0 * srgb_encode(f64::from(part).clamp(0.0, 1.0)))));
    let mut figure = Figure { size: config.size, background, elements };
    annotations.complete(&mut figure);
    Ok(figure)
}

fn scale([width, height]: [u32; 2]) -> u32 {
    let n_pixels = u64::from(width) * u64::from(height);
    let fits = |scale: &u32| n_pixels * u64::from(*scale) * u64::from(*scale) <= MOST_SAMPLES;
    (1..=FINEST).rev().find(fits).unwrap_or(1)
}

/// Faces that are shown, and wires.
fn patches(
    sheet: &Sheet<'_>,
    setup: &Setup<'_>,
    size: [u32; 2],
    scale: f64,
    is_shown: &[bool],
) -> (Vec<Patch>, Vec<Patch>) {
    let (mut faces, mut wires) = (Vec::new(), Vec::new());
    sheet.for_each_polygon(|item, mut contours| {
        let is_face = is_shown.get(item as usize);
        if is_face == Some(&false) {
            return;
        }
        for corner in contours.iter_mut().flatten() {
            (corner.x, corner.y) = (corner.x / scale, corner.y / scale);
        }
        let patch = Patch::new(item, contours, size, setup.view.is_perspective);
        if is_face.is_some() { &mut faces } else { &mut wires }.extend(patch);
    });
    (faces, wires)
}
