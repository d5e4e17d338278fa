//! The filter: a scene at rest to the scene as seen.

use glam::DVec3;
use rayon::prelude::*;
use ugparse::{BodyId, GeometryStage, Item, Motion, Scene, SeenGeometry, Vertex};
use ugphysics::Velocity;
use ugpipe::Progress;
use ugscene::Geometry;

use crate::criterion::Bounds;
use crate::cull::ViewVolume;
use crate::edge::Tolerance;
use crate::near_lamps::NearLamps;
use crate::pieces::Outcome;
use crate::refined_mesh::RefinedMesh;
use crate::relative_motion::{Point, RelativeMotion};
use crate::{
    Config, DEFAULT_ERROR, Error, Pieces, Report, adaptive, attributes, camera_frame, cull, distant_bodies,
    placement, remaining_errors, uniform, viewpoint,
};

/// The scene as seen, and statistics.
///
/// # Errors
/// See [`Error`].
pub fn apply(scene: Scene, config: &Config) -> Result<(Scene, Report), Error> {
    apply_with_progress(scene, config, &())
}

/// Like [`apply`], and reports progress.
///
/// # Errors
/// See [`Error`].
pub fn apply_with_progress(
    mut scene: Scene,
    config: &Config,
    progress: &dyn Progress,
) -> Result<(Scene, Report), Error> {
    progress.step("moving and cutting", 0);
    let velocity = check(config)?;
    ugscene::require_geometry_at_rest(&scene).map_err(Error::Stage)?;
    ugscene::require_colors_at_rest(&scene).map_err(Error::Stage)?;
    let n_faces = scene.faces.len();

    if config.velocity.is_some() {
        camera_frame::set_velocity(&mut scene, velocity);
    }
    let camera = camera_frame::take_camera_velocity(&mut scene, config)?;
    if !camera.is_zero() {
        camera_frame::state_motions(&mut scene, velocity);
    }
    ugscene::separate_bodies(&mut scene);
    let bodies = ugscene::vertex_bodies(&scene);
    let motions = motions(&scene, velocity, camera, config.geometry)?;
    let default_camera = viewpoint::default_camera(&scene, config, &motions)?;
    let eye = default_camera.map_or_else(|| ugscene::eye(&scene, config.eye), |camera| camera.eye);
    camera_frame::transform_velocities(&mut scene, camera)?;
    let moves = !velocity.is_zero()
        || !camera.is_zero()
        || ugscene::has_moving_bodies(&scene)
        || ugscene::has_moving_lights(&scene);
    let shifts = placement::shifts(&scene, &bodies, &motions, eye, config);
    let mut points = points(&scene, &bodies, &motions, &shifts, eye);
    viewpoint::refuse_vertices_at_eye(&scene, &points, &motions)?;
    placement::shift_lights(&mut scene, &motions, &shifts);
    if config.smooth {
        attributes::smooth(&mut scene, &points, &motions);
    }

    config.camera.check_up().map_err(Error::Camera)?;
    let center = default_camera.map(|camera| camera.center);
    viewpoint::set_camera(&mut scene, eye, center, &config.camera);
    let view_volume = if config.cull {
        ViewVolume::new(&viewpoint::view(&scene, &config.camera, config.size)?)
    } else {
        ViewVolume::default()
    };
    let depth_factors = distant_bodies::depth_factors(&points, &motions);
    let n_culled = cull::cull(&mut scene, &mut points, &motions, &view_volume);

    let error = if let Pieces::UpTo(error) = config.pieces { error } else { DEFAULT_ERROR };
    let near_lamps = NearLamps::new(&scene, eye, &motions, config.light_error);
    let tolerance = Tolerance::new(error, config.color_error);
    let tolerances = depth_factors.iter().map(|&factor| tolerance.with_depth(factor)).collect();
    let bounds = Bounds::new(tolerances, near_lamps, view_volume, &motions);
    let mut mesh = RefinedMesh::new(&motions, points);
    let outcome = match config.pieces {
        Pieces::UpTo(_) => adaptive::cut(&scene, &mut mesh, &bounds, adaptive::MAX_PIECES),
        Pieces::PerEdge(n) => {
            uniform::cut(&scene, &mut mesh, n).map_err(|n_pieces| Error::TooManyPieces { n_pieces })?
        }
    };
    let has_new = !mesh.recipes.is_empty();
    let shades = if has_new { attributes::shades(&scene, &mesh.points) } else { None };
    put_pieces(&mut scene, &outcome);
    let inherits = attributes::add_vertices(&mut scene, &mesh.recipes, shades, config.repeat);
    set_positions(&mut scene, &mesh, &shifts, eye)?;
    if moves || config.geometry != Geometry::default() {
        scene.stage.geometry = GeometryStage::AsSeen(SeenGeometry {
            eye,
            time: config.time,
            camera_velocity: camera,
            contraction: config.geometry.contraction,
            flight_time: config.geometry.flight_time,
        });
    }

    let is_short = outcome.is_full || outcome.n_too_deep + outcome.n_uncut > 0;
    let remaining_errors =
        (config.measure || is_short).then(|| remaining_errors::measure(&scene, &mesh, &bounds));
    // After cutting, so that neighbours are cut alike.
    if config.repeat {
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
        is_full: outcome.is_full,
        remaining_errors,
        default_camera,
    };
    Ok((scene, report))
}

/// The velocity of bodies whose motion is not stated.
fn check(config: &Config) -> Result<Velocity, Error> {
    match config.pieces {
        Pieces::UpTo(error) if !(error > 0.0 && error.is_finite()) => return Err(Error::NoBound { error }),
        Pieces::UpTo(_) if config.color_error.is_nan() || config.color_error <= 0.0 => {
            return Err(Error::NoColorBound { error: config.color_error });
        }
        Pieces::UpTo(_) if config.light_error.is_nan() || config.light_error <= 0.0 => {
            return Err(Error::NoLightBound { error: config.light_error });
        }
        Pieces::PerEdge(0) => return Err(Error::NoPieces),
        _ => {}
    }
    Velocity::from_beta(config.velocity.unwrap_or(DVec3::ZERO)).map_err(Error::Velocity)
}

/// One for each body, in their order. `default`: the velocity of [`BodyId::UNSTATED`].
fn motions(
    scene: &Scene,
    default: Velocity,
    camera: Velocity,
    geometry: Geometry,
) -> Result<Vec<RelativeMotion>, Error> {
    let velocity = |body: BodyId| match scene.bodies[body].motion {
        _ if body == BodyId::UNSTATED => default,
        Motion::Inertial(velocity) => velocity,
    };
    scene.bodies.ids().map(|body| RelativeMotion::seen_by(camera, velocity(body), geometry)).collect()
}

fn points(
    scene: &Scene,
    bodies: &[BodyId],
    motions: &[RelativeMotion],
    shifts: &[DVec3],
    eye: DVec3,
) -> Vec<Point> {
    let vertices = scene.vertices.par_iter().zip(bodies.par_iter());
    vertices
        .map(|(vertex, &body)| {
            let motion = &motions[body.index()];
            motion.point(body, motion.turned(vertex.position - eye) + shifts[body.index()])
        })
        .collect()
}

/// Comments move to the first piece of their face.
fn put_pieces(scene: &mut Scene, outcome: &Outcome) {
    if outcome.is_empty() {
        return;
    }
    let first_pieces = outcome.put_into(scene);
    for comment in &mut scene.comments {
        if let Item::Face(row) = &mut comment.at {
            *row = first_pieces[*row as usize];
        }
    }
}

/// Writes the seen positions. Those of a body at rest that was not shifted stay the same to the
/// bit.
fn set_positions(scene: &mut Scene, mesh: &RefinedMesh, shifts: &[DVec3], eye: DVec3) -> Result<(), Error> {
    let n_old = mesh.points.len() - mesh.recipes.len();
    let stays = |body: BodyId| mesh.motion_of(body).is_at_rest() && shifts[body.index()] == DVec3::ZERO;
    let is_finite = |(row, (vertex, point)): (usize, (&mut Vertex, &Point))| {
        if row >= n_old || !stays(point.body) {
            vertex.position = point.seen + eye;
        }
        vertex.position.is_finite()
    };
    let positions = scene.vertices.par_iter_mut().zip(&mesh.points).enumerate().map(is_finite);
    if positions.reduce(|| true, |all, one| all & one) {
        return Ok(());
    }
    match scene.vertices.iter().position(|vertex| !vertex.position.is_finite()) {
        None => Ok(()),
        Some(row) => Err(Error::OutOfRange { name: vertex_name(scene, row), row }),
    }
}

/// For messages.
pub(crate) fn vertex_name(scene: &Scene, row: usize) -> String {
    scene.names.get(scene.vertices[row].name).to_string()
}
