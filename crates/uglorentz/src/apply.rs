//! The filter: a scene at rest to the scene as seen.

use rayon::prelude::*;
use ugpipe::Progress;
use ugscene::{CameraOptions, GeometryStage, PlacedBodies, Projection, Scene, ShownEffects};

use crate::clocks::Clocks;
use crate::criterion::{Bounds, Criterion};
use crate::cull::ViewVolume;
use crate::edge::Tolerance;
use crate::evenness::Evenness;
use crate::near_lamps::NearLamps;
use crate::refined_mesh::RefinedMesh;
use crate::relative_motion::Point;
use crate::{
    Config, Error, Pieces, Report, adaptive, attributes, clocks, cull, distant_bodies, junctions,
    measured, remaining_errors, rounds, tables, uniform, viewpoint,
};

/// The scene as seen, and statistics.
///
/// # Errors
/// See [`Error`].
pub fn apply(scene: Scene, config: &Config) -> Result<(Scene, Report), Error> {
    apply_with(scene, config, &())
}

/// Like [`apply`], and reports progress.
///
/// # Errors
/// See [`Error`].
pub fn apply_with(
    mut scene: Scene,
    config: &Config,
    progress: &dyn Progress,
) -> Result<(Scene, Report), Error> {
    progress.step("moving and cutting", 0);
    check(config)?;
    measured::refuse_partial(&scene, config)?;
    let (config, carrier) = &measured::in_frame(&mut scene, config)?;
    let is_for_rays = config.is_for_rays && is_drawn_by_rays(&scene, config);
    let pieces = if is_for_rays { Pieces::PerEdge(1) } else { config.pieces };
    let config = &Config { pieces, ..config.clone() };
    let are_rounds_cut = scene.has_rounds_on_world_lines();
    rounds::cut(&mut scene, config)?;
    let n_faces = scene.faces.len();
    let camera = CameraOptions { eye: config.eye, ..config.camera.clone() };
    let placed =
        PlacedBodies::move_to_camera_frame(&mut scene, &config.motion(), &camera, config.size)?;
    let PlacedBodies { eye, default_camera, motions, .. } = &placed;
    let mut points = points(&scene, &placed);
    viewpoint::refuse_vertices_at_eye(&scene, &points, motions)?;
    if config.smooth {
        attributes::smooth(&mut scene, &points, motions);
    }

    let view_volume = if config.cull {
        ViewVolume::new(&viewpoint::view(&scene, &config.camera, config.size)?)
    } else {
        ViewVolume::default()
    };
    let depth_factors = distant_bodies::depth_factors(&points, motions);
    let n_culled = cull::cull(&mut scene, &mut points, motions, &view_volume);

    let error = viewpoint::error(&scene, config)?;
    let near_lamps = NearLamps::new(&scene, *eye, motions, config.light_error);
    // Measured pictures have no Doppler effect.
    let of_doppler = if config.measured.is_some() { f64::INFINITY } else { config.color_error };
    let tolerance = Tolerance::new(error, of_doppler);
    let tolerance = match config.pieces {
        Pieces::UpToPixels(_) => tolerance.with_shortest(viewpoint::pixel(&scene, config)?),
        _ => tolerance,
    };
    let tolerances = depth_factors.iter().map(|&factor| tolerance.with_depth(factor)).collect();
    let clocks = Clocks::new(&scene, config.color_error);
    let bounds = Bounds::new(tolerances, (near_lamps, clocks), view_volume, motions);
    let mut mesh = RefinedMesh::new(motions, points);
    let mut n_open_junctions = 0;
    match config.pieces {
        Pieces::UpTo(_) | Pieces::UpToPixels(_) => {
            mesh.junctions = junctions::find(&scene, &mesh.points, motions)
        }
        // Rays (`ugrainbow -xc`) meet the faces at rest.
        Pieces::PerEdge(1) => {}
        Pieces::PerEdge(_) => {
            n_open_junctions = junctions::find(&scene, &mesh.points, motions).len()
        }
    }
    mesh.tables = tables::tables_of_vertices(&scene, &mesh.points, &mesh.junctions);
    // Colours that change are not mixed with others.
    let is_apart = config.repeat || scene.has_changing_surfaces();
    let evenness = Evenness::new(is_apart);
    let is_whole =
        is_for_rays && Criterion { mesh: &mesh, bounds: &bounds }.has_cuts(&scene, &evenness);
    if let GeometryStage::AsSeen(seen) = &mut scene.stage.geometry {
        seen.is_whole = is_whole;
    }
    let max_pieces = adaptive::max_pieces(n_faces, config.size, motions);
    let outcome = match config.pieces {
        Pieces::UpTo(_) | Pieces::UpToPixels(_) => {
            adaptive::cut(&scene, &evenness, &mut mesh, &bounds, max_pieces, progress)?
        }
        Pieces::PerEdge(n) => uniform::cut(&scene, &evenness, &mut mesh, n)
            .map_err(|n_pieces| Error::TooManyPieces { n_pieces })?,
    };
    let has_new = !mesh.recipes.is_empty();
    let shades = if has_new { attributes::shades(&scene, &mesh.points) } else { None };
    outcome.put_into(&mut scene);
    let inherits = attributes::add_vertices(&mut scene, &mesh.recipes, shades, is_apart)
        .ok_or(Error::TooManyParts)?;
    let n_placed = mesh.points.len() - mesh.recipes.len();
    let shown: Vec<_> = mesh.points.par_iter().map(Point::shown).collect();
    if let Some(row) = placed.show(&mut scene, &shown, n_placed) {
        return Err(Error::OutOfRange { name: viewpoint::vertex_name(&scene, row), row });
    }
    if config.measured.is_some() {
        measured::stand_still(&mut scene, &mesh.points, motions);
    }

    progress.check()?;
    let is_short = outcome.is_full || outcome.n_too_deep + outcome.n_uncut > 0;
    let remaining_errors =
        (config.measure || is_short).then(|| remaining_errors::measure(&scene, &mesh, &bounds));
    // After cutting, so that neighbours are cut alike.
    if scene.has_changing_surfaces() {
        clocks::show(&mut scene, mesh.points.iter().map(|point| point.own_time).collect());
    }
    if config.measured.is_some() {
        measured::forget_bodies(&mut scene);
    }
    if is_apart {
        ugscene::repeat_vertices(&mut scene, true);
    } else {
        ugscene::separate_wires(&mut scene, &inherits);
    }
    let report = Report {
        n_new_vertices: mesh.recipes.len(),
        n_new_faces: scene.faces.len() + n_culled - n_faces,
        n_culled,
        n_uncut: outcome.n_uncut,
        n_too_deep: outcome.n_too_deep,
        n_open_junctions,
        is_whole,
        are_rounds_cut,
        momentary_frame: carrier.clone().map(|name| (name, config.time)),
        is_full: outcome.is_full,
        max_pieces,
        remaining_errors,
        default_camera: *default_camera,
    };
    Ok((scene, report))
}

/// Refuses bounds that no subdivision can meet.
fn check(config: &Config) -> Result<(), Error> {
    match config.pieces {
        Pieces::UpTo(error) if !(error > 0.0 && error.is_finite()) => Err(Error::NoBound { error }),
        Pieces::UpToPixels(pixels) if !(pixels > 0.0 && pixels.is_finite()) => {
            Err(Error::NoPixelBound { pixels })
        }
        Pieces::UpTo(_) | Pieces::UpToPixels(_)
            if config.color_error.is_nan() || config.color_error <= 0.0 =>
        {
            Err(Error::NoColorBound { error: config.color_error })
        }
        Pieces::UpTo(_) | Pieces::UpToPixels(_)
            if config.light_error.is_nan() || config.light_error <= 0.0 =>
        {
            Err(Error::NoLightBound { error: config.light_error })
        }
        Pieces::PerEdge(0) => Err(Error::NoPieces),
        _ => Ok(()),
    }
}

/// True if renderers draw a scene by a ray for each sample.
fn is_drawn_by_rays(scene: &Scene, config: &Config) -> bool {
    let of_scene = scene.camera().and_then(|camera| camera.projection);
    scene.drawn_texture_name().is_some()
        && !(config.camera.is_orthographic || of_scene == Some(Projection::Orthographic))
        && config.geometry == ShownEffects::default()
        && config.measured.is_none()
        && !scene.has_changing_surfaces()
}

fn points(scene: &Scene, placed: &PlacedBodies) -> Vec<Point> {
    let rest = placed.rest_positions(scene).into_par_iter().zip(&placed.bodies);
    rest.map(|(rest, &body)| Point::new(&placed.motions[body.index()], body, rest)).collect()
}
