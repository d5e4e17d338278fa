//! Vector figures: the faces of the picture as areas in paint order, and wires as lines.
//!
//! 1. The polygons of the draw list, at a scale at which hardly any is too thin for it ([`patch`]).
//! 2. Faces of which no sample is seen, nor of any neighbour, are left out ([`seen`]), and of the others without a
//!    sample those that are wholly hidden ([`hidden`]).
//! 3. The rest is put in order, from behind ([`order`]), and cut only where faces cut each other or hide each
//!    other in a ring. Parts that are hidden are painted over, not cut out.
//! 4. Where a translucent face comes, what is seen through it is painted once more ([`transparency`]).
//! 5. Neighbours of one colour become one area ([`merge`]).
//! 6. What has several colours becomes smooth areas, cut until their colours are right ([`smooth`]).
//! 7. Lines come last, without their hidden parts, and in other colours behind translucent faces ([`lines`]).

mod color;
mod hidden;
mod lines;
mod merge;
mod order;
mod patch;
mod seen;
mod smooth;
mod transparency;

use ugimage::figure::{self, Element, Figure};
use ugimage::{Development, Format, Label};

use crate::canvas;
use crate::config::Config;
use crate::depth_cue::prepare;
use crate::error::{Error, MAX_PIXELS};
use crate::figures::Annotations;
use crate::lines::Stroke;
use crate::planar::BoxIndex;
use crate::render_layers::RenderLayers;
use crate::setup::Setup;
use color::{Palette, rounded};
use merge::Paint;
use patch::Patch;
use smooth::{Smooth, plain_color, push_smooth};
use transparency::Coat;
use ugparse::Scene;

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
    let setup = prepare(scene, &fine)?;
    let layers = RenderLayers::new(setup.painter(), &fine.draw_mode());
    let ground = canvas::ground(config, None);
    if ground.is_none() && layers.has_clear_faces() {
        return Err(Error::Figure(
            "what is seen through translucent faces of a figure of areas must be known: give a background (-bg 1 for paper) in place of -tb",
        ));
    }
    let seen = seen::faces(&setup, &layers);
    let faces = patches(&layers, &setup, config.size, f64::from(scale), &seen.is_near);
    let index = BoxIndex::new(faces.iter().map(Patch::bounds), config.size);
    let faces = hidden::without_hidden(faces, &index, &seen.is_seen);
    let palette = Palette {
        layers: &layers,
        shader: &setup.shader,
        development,
        grid: &setup.grid,
        ground: ground.unwrap_or([1.0; 3]),
    };
    let index = BoxIndex::new(faces.iter().map(Patch::bounds), config.size);
    let mut elements = painted(&palette, &faces, &index, config.size)?;
    let strokes = layers.strokes().iter().map(|stroke| scaled(*stroke, scale)).collect();
    let panes = lines::Panes { patches: &faces, index: &index };
    lines::push_lines(&palette, &panes, strokes, config.line_width, &mut elements);
    let background = ground.map(|light| rounded(palette.levels(light)));
    let mut figure = Figure { size: config.size, background, elements };
    annotations.complete(&mut figure);
    Ok(figure)
}

/// Faces as elements, from behind.
fn painted<S: Smooth>(
    palette: &Palette<'_>,
    faces: &[Patch],
    index: &BoxIndex,
    size: [u32; 2],
) -> Result<Vec<Element<S>>, Error> {
    let coats = transparency::coats(faces, &order::painting_order(faces, index), size)?;
    let with_color = |coat: Coat| {
        let color = plain_color(palette, faces, &coat);
        (coat, color)
    };
    let mut elements = Vec::new();
    for paint in merge::merged(coats.into_iter().map(with_color).collect(), size) {
        match paint {
            Paint::Plain(contours, color) => {
                elements.push(Element::Area { contours, color, is_inside: false });
            }
            Paint::Smooth(coat) => push_smooth(palette, faces, coat, &mut elements),
        }
    }
    Ok(elements)
}

/// A stroke in pixels, from one in rows of the draw list.
fn scaled(mut stroke: Stroke, scale: u32) -> Stroke {
    for end in &mut stroke.ends {
        (end.x, end.y) = (end.x / f64::from(scale), end.y / f64::from(scale));
    }
    stroke
}

fn scale([width, height]: [u32; 2]) -> u32 {
    let n_pixels = u64::from(width) * u64::from(height);
    let fits = |scale: &u32| n_pixels * u64::from(*scale) * u64::from(*scale) <= MOST_SAMPLES;
    (1..=FINEST).rev().find(fits).unwrap_or(1)
}

/// Faces that are shown.
fn patches(
    layers: &RenderLayers<'_>,
    setup: &Setup<'_>,
    size: [u32; 2],
    scale: f64,
    is_shown: &[bool],
) -> Vec<Patch> {
    let mut faces = Vec::new();
    layers.for_each_polygon(|item, is_clear, mut contours| {
        if !is_shown[item as usize] {
            return;
        }
        for corner in contours.iter_mut().flatten() {
            (corner.x, corner.y) = (corner.x / scale, corner.y / scale);
        }
        faces.extend(Patch::new(item, is_clear, contours, size, setup.view.is_perspective));
    });
    faces
}
