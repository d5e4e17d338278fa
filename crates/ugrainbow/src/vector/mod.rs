//! Vector figures: the faces of the picture as areas in paint order, and wires as lines.
//!
//! 1. [`patch`]: the polygons of the draw list, at a scale at which hardly any falls between
//!    samples.
//! 2. [`seen`]: faces are left out if neither they nor a neighbour is visible at a sample;
//!    [`hidden`]: of the others without a visible sample those that are completely occluded.
//! 3. [`order`]: the rest is sorted from back to front, and cut only where faces intersect or
//!    occlude each other cyclically. Hidden parts are painted over, not cut out.
//! 4. [`transparency`]: what is seen through a translucent face is painted again over it.
//! 5. [`merge`]: neighbours of one colour become one area.
//! 6. [`smooth`]: areas of several colours become smooth areas, subdivided until their colours are
//!    within the bound.
//! 7. [`lines`]: visible parts of lines come last, in other colours behind translucent faces.

mod color;
mod hidden;
mod lines;
mod merge;
mod order;
mod patch;
mod seen;
mod smooth;
mod transparency;
mod work;

use color::{FigureColors, rounded};
use merge::Paint;
use patch::Patch;
use smooth::{Smooth, plain_color, push_smooth};
use transparency::PaintedArea;
use ugimage::figure::{Element, Figure};
use ugimage::{Development, Format};
use ugpicture::{DrawnContent, Exposure, MAX_PIXELS, VectorFigure};
use ugpipe::Progress;
use ugscene::Scene;
use work::Work;

use crate::config::Config;
use crate::depth_cue::prepare;
use crate::drawn_scene::DrawnScene;
use crate::error::Error;
use crate::lines::Stroke;
use crate::pixels::{self, backdrop};
use crate::planar::{BoxIndex, MOST_CROSSED_PARTS};
use crate::render_layers::RenderLayers;
use crate::setup::Setup;

/// Rows of samples a pixel, if the picture is not too large.
const FINEST: u32 = 8;

/// Most samples by which visibility is decided.
const MOST_SAMPLES: u64 = MAX_PIXELS / 4;

/// Most samples of translucent faces by which visibility is decided, which took about two seconds.
const MOST_FRAGMENTS: f64 = (1 << 25) as f64;

/// Draws a figure.
///
/// # Errors
/// As for pictures.
pub fn draw<'a>(
    scene: &'a Scene,
    config: &Config,
    format: Format,
    progress: &dyn Progress,
) -> Result<DrawnScene<'a>, Error> {
    let size = config.picture.size;
    let mut scale = scale(size);
    let mut fine = at_scale(config, scale);
    let mut setup = prepare(scene, &fine)?;
    let mut layers = RenderLayers::new(&setup, &fine)?;
    let coarser = coarser(scale, seen::n_fragments(&layers, size.map(|side| side * scale)));
    if coarser < scale {
        scale = coarser;
        drop(layers);
        fine = at_scale(config, scale);
        setup = prepare(scene, &fine)?;
        layers = RenderLayers::new(&setup, &fine)?;
    }
    let layers = layers.with_progress(progress);
    if backdrop(&config.picture).light().is_none() && layers.has_transparent_faces() {
        return Err(Error::FigureBackground);
    }
    let seen = seen::faces(&setup, &layers);
    let development = if setup.keeps_highlights { Some(development(scene, config)?) } else { None };
    let stats = seen.stats;
    let job = FigureJob { layers: &layers, setup: &setup, config, scale, seen: &seen };
    let figure = match format {
        Format::Svg => VectorFigure::Gradients(job.figure(development)?),
        _ => VectorFigure::Triangles(job.figure(development)?, format),
    };
    drop(layers);
    let content = DrawnContent::Figure(figure, development);
    Ok(DrawnScene { setup, stats, content })
}

/// The options for one sample a pixel, in a picture that is so many times larger.
fn at_scale(config: &Config, scale: u32) -> Config {
    let mut fine = config.clone();
    (fine.picture.size, fine.picture.samples) = (config.picture.size.map(|side| side * scale), 1);
    fine.line_width *= f64::from(scale);
    fine
}

/// The largest scale up to `scale` with at most [`MOST_FRAGMENTS`]; at `scale` there are
/// `n_fragments`.
fn coarser(scale: u32, n_fragments: f64) -> u32 {
    let n_at = |smaller: u32| {
        let part = f64::from(smaller) / f64::from(scale);
        n_fragments * part * part
    };
    (1..=scale).rev().find(|&smaller| n_at(smaller) <= MOST_FRAGMENTS).unwrap_or(1)
}

/// How light is developed. An automatic exposure is a quantile of the light of pixels, so it alone
/// needs the whole picture.
fn development(scene: &Scene, config: &Config) -> Result<Development, Error> {
    let stops = match config.picture.exposure {
        Some(Exposure::Auto) => {
            let setup = prepare(scene, config)?;
            let layers = RenderLayers::new(&setup, config)?;
            return Ok(config.picture.development(|| pixels::light(&setup, &layers, config).0));
        }
        Some(Exposure::Stops(stops)) => stops,
        None => 0.0,
    };
    Ok(Development { stops, tone: config.picture.tone })
}

/// A figure being made.
struct FigureJob<'a> {
    layers: &'a RenderLayers<'a>,
    setup: &'a Setup<'a>,
    config: &'a Config,
    scale: u32,
    seen: &'a seen::Faces,
}

impl FigureJob<'_> {
    fn figure<S: Smooth>(&self, development: Option<Development>) -> Result<Figure<S>, Error> {
        let Self { layers, setup, config, scale, seen } = *self;
        let size = config.picture.size;
        let backdrop = backdrop(&config.picture);
        let ground = backdrop.light();
        let faces = patches(layers, setup, size, f64::from(scale), &seen.is_near)?;
        let index = BoxIndex::new(faces.iter().map(Patch::bounds), size);
        let faces = hidden::without_hidden(faces, &index, &seen.is_seen);
        let colors = FigureColors {
            layers,
            development,
            grid: &setup.grid,
            backdrop: &backdrop,
            ground: ground.unwrap_or([1.0; 3]),
        };
        let index = BoxIndex::new(faces.iter().map(Patch::bounds), size);
        let mut elements = painted(&colors, &faces, &index, size)?;
        let strokes = layers.strokes().iter().map(|stroke| scaled(*stroke, scale)).collect();
        let in_front = lines::TransparentPatches { patches: &faces, index: &index };
        lines::push_lines(&colors, &in_front, strokes, config.line_width, &mut elements);
        let background = ground.map(|light| rounded(colors.levels(light, 1.0)));
        Ok(Figure { size, background, elements })
    }
}

/// Faces as elements, from back to front.
fn painted<S: Smooth>(
    colors: &FigureColors<'_>,
    faces: &[Patch],
    index: &BoxIndex,
    size: [u32; 2],
) -> Result<Vec<Element<S>>, Error> {
    let pieces = order::painting_order(faces, index, &Work::new(order::MOST_WORK))?;
    let areas = transparency::areas(faces, &pieces, size)?;
    let with_color = |area: PaintedArea| {
        let color = plain_color(colors, faces, &area);
        (area, color)
    };
    let mut elements = Vec::new();
    for paint in merge::merged(areas.into_iter().map(with_color).collect(), size) {
        match paint {
            Paint::Plain(contours, color) => {
                elements.push(Element::Area { contours, color, is_inside: false });
            }
            Paint::Smooth(area) => push_smooth(colors, faces, area, &mut elements),
        }
    }
    Ok(elements)
}

/// Converts a stroke from samples to pixels.
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

/// The patches of visible faces.
///
/// # Errors
/// [`Error::CrossedFaces`]: faces cross themselves too often.
fn patches(
    layers: &RenderLayers<'_>,
    setup: &Setup<'_>,
    size: [u32; 2],
    scale: f64,
    is_shown: &[bool],
) -> Result<Vec<Patch>, Error> {
    let (mut faces, mut room, mut outcome) = (Vec::new(), MOST_CROSSED_PARTS, Ok(()));
    layers.for_each_polygon(|item, is_transparent, mut contours| {
        if !is_shown[item as usize] || outcome.is_err() {
            return;
        }
        for corner in contours.iter_mut().flatten() {
            (corner.x, corner.y) = (corner.x / scale, corner.y / scale);
        }
        let is_perspective = setup.view.is_perspective;
        match Patch::new(item, is_transparent, contours, size, is_perspective, &mut room) {
            Ok(None) => {}
            Ok(Some(mut patch)) => {
                patch.plane = layers.planes().get(item as usize).copied().unwrap_or(patch.plane);
                faces.push(patch);
            }
            Err(error) => outcome = Err(error),
        }
    });
    outcome.map(|()| faces)
}

#[cfg(test)]
mod tests {
    use ugtesting::Random;

    use super::*;

    /// Panes in front of each other take a coarser grid, so that there are few fragments.
    #[test]
    fn visibility_of_translucent_faces_has_a_limit_of_fragments() {
        for (n_panes, expected) in [(2, FINEST), (300, 5), (3000, 1)] {
            let n_fragments = f64::from(n_panes * 64 * 64 * FINEST * FINEST);
            assert_eq!(coarser(scale([64; 2]), n_fragments), expected);
        }
    }

    /// Thin faces in all directions, of which each overlaps most others: the order ends at its
    /// limit.
    #[test]
    fn order_has_a_limit_of_work() {
        let mut random = Random(1);
        let mut patches = Vec::new();
        for item in 0..3000 {
            let along = random.direction() * 40.0;
            let [x, y] = [50.0 + 10.0 * random.unit(), 50.0 + 10.0 * random.unit()];
            let corner = |side: f64, z: f64| ugraster::Corner {
                x: x + side * along.x,
                y: y + side * along.y + z,
                key: along.z,
                values: [0.0; 8],
            };
            let contour =
                vec![corner(-1.0, 0.0), corner(1.0, 0.0), corner(1.0, 0.1), corner(-1.0, 0.1)];
            patches
                .extend(Patch::new(item, false, vec![contour], [100, 100], false, &mut 0).unwrap());
        }
        let index = BoxIndex::new(patches.iter().map(Patch::bounds), [100, 100]);
        let work = Work::new(1 << 20);
        assert!(matches!(order::painting_order(&patches, &index, &work), Err(Error::FigureFaces)));
        // A face is compared with the others before the limit is seen.
        assert!(work.done() < (1 << 20) + 16 * 3000, "{work:?}");
        let work = Work::new(order::MOST_WORK);
        assert!(
            order::painting_order(&patches, &index, &work).is_ok_and(|pieces| pieces.len() >= 3000)
        );
        assert!(work.done() > 1 << 21);
    }
}
