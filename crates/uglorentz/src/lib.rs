//! Geometry of a UniGrafix scene as seen in relativistic motion: the first program of
//!
//! ```text
//! uglorentz -vel .9 0 0 < ship.ug | ugdoppler | ugrainbow > ship.png
//! ```
//!
//! # What a moving body looks like
//!
//! A picture shows each point of a body where its light left it, not where it is. Light from far parts left
//! earlier, so a passing body looks turned, sheared and bent, and a coming one stretched, although in its own
//! frame nothing happened to it. Nguyen's report of 1988 does this in two steps: contract the body along its
//! motion, (P1), then move every point back to where it was when the light left, (P2). The two are one boost of
//! the event "light leaves", (P3), which is what `ugphysics` computes, without loss near the speed of light.
//!
//! The filter maps every vertex so, keeps faces, and writes what the next programs need to know: on each face
//! its velocity, in the camera the eye. From these the rest shape can be had back exactly, (P4). Equation
//! numbers are those of `docs/physics.md`.
//!
//! # Why faces are cut
//!
//! Renderers draw straight edges between vertices, but a straight edge in motion is seen as an arc of a
//! hyperbola. So long edges are cut first. By default closed formulas for the angle between arc and chord, for depth
//! and for colour decide edge by edge where that shows ([`Pieces::UpTo`], derived in `docs/geometry.md`); two faces that share an edge cut it alike, so
//! the result has no cracks. A body at rest is not cut, but for the light of near lamps if that is asked for.
//!
//! Pieces keep direction, colour, light level, velocity and name of their face; those of one face stand
//! together, in its place. Vertices of the scene keep their names and rows; new ones are called `s#1`, `s#2`, …
//! and come last.
//!
//! # Parts
//!
//! ```text
//! Scene ─separate bodies─ placement ─ smooth normals ─┬─ adaptive (criterion) ─┬─ positions ─ attributes → Scene
//!                         (P5)                        └─ equal ────────────┘  (P3)
//! ```
//!
//! # Example
//!
//! ```
//! use glam::DVec3;
//!
//! let source = ugparse::Source::new("tile.ug", "v a -1 1 0; v b 1 1 0; v c 0 1 1; f (a b c);");
//! let config = uglorentz::Config {
//!     velocity: Some(DVec3::new(0.9, 0.0, 0.0)),
//!     pieces: uglorentz::Pieces::PerEdge(2),
//!     ..uglorentz::Config::default()
//! };
//! let report = uglorentz::run(&config, &source)?;
//!
//! // The middle of the edge from a to b is abreast of the eye, and is seen γβ behind: (P3).
//! let text = String::from_utf8(report.text())?;
//! assert!(text.contains("v s#1 -2.06474160483505"));
//! // Two pieces an edge make four of a triangle; each says how it moves.
//! assert_eq!(text.matches("<0.9 0 0>").count(), 4);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod achieved;
mod adaptive;
mod attributes;
mod cli;
mod color;
mod criterion;
mod cull;
mod early_accept;
mod edge;
mod edge_on;
mod equal;
mod error;
mod frame;
mod interior;
mod lit;
mod measurement;
mod motion;
mod notes;
mod pieces;
mod placement;
mod refined_mesh;
mod remote;
mod split;
mod viewpoint;

use glam::DVec3;
use rayon::prelude::*;
use ugparse::{BodyId, Diagnostics, GeometryStage, Item, Options, Scene, SeenGeometry, Source, Vertex};
use ugphysics::Velocity;
use ugpipe::Progress;
use ugscene::{CameraOptions, Geometry};

pub use cli::{Args, main};
pub use error::Error;
pub use measurement::{Measurement, Table, measure};
pub use notes::{Achieved, Notes, Worst};

use crate::criterion::Bounds;
use crate::cull::Sight;
use crate::edge::Tolerance;
use crate::lit::Lit;
use crate::motion::{Motion, Point};
use crate::pieces::Outcome;
use crate::refined_mesh::RefinedMesh;

/// Default of [`Pieces::UpTo`]: 0.1 milliradians, in radians. A pixel of a picture 40° wide and 1920 pixels
/// across is 0.36, so no edge is off by a third of one.
pub const DEFAULT_ERROR: f64 = 0.1e-3;

/// Default of [`Config::color_error`]: 0.15 percent, at 550 nm 0.8 nm. At best an eye tells wavelengths apart that
/// differ by 1 nm (W. D. Wright and F. H. G. Pitt, 1934).
pub const DEFAULT_COLOR_ERROR: f64 = 1.5e-3;

/// What to do.
#[derive(Clone, Debug)]
pub struct Config {
    /// Velocity of everything, fraction of c; beats velocities in the scene (`-vel`).
    pub velocity: Option<DVec3>,
    /// Velocity of the camera in the frame of the scene, fraction of c; beats that of the scene's camera (`-cv`).
    /// Velocities are then those in the frame of the scene, and come out as those in the frame of the camera.
    pub camera_velocity: Option<DVec3>,
    /// The eye in scene coordinates; beats the scene's camera (`-ep`).
    pub eye: Option<DVec3>,
    /// What else of the camera to write into the scene (`-vc`, `-ud`, `-va`, `-og`). Its eye is left alone:
    /// [`Config::eye`] counts.
    pub camera: CameraOptions,
    /// Leave out faces that a picture of so many pixels across and down does not show (`-cull`, `-sz`).
    pub cull: Option<[u32; 2]>,
    /// Time of the picture on the observer's clock, (P5) (`-ti`).
    pub time: f64,
    /// The point about which contraction leaves coordinates alone (`-an`); `None` is the eye, but the centre of
    /// each body if `in_place` is set.
    pub anchor: Option<Anchor>,
    /// Put each body so that its anchor is seen, at time 0, where the scene has it (`-in`).
    pub in_place: bool,
    /// How to cut edges (`-se`, `-sd`).
    pub pieces: Pieces,
    /// With [`Pieces::UpTo`], cut also where the Doppler factor, or its inverse, taken linearly along an edge would
    /// be off by more than this part; infinite for nowhere (`-sc`).
    pub color_error: f64,
    /// With [`Pieces::UpTo`], cut also where the light of near lamps, taken linearly along an edge, would be off by more than
    /// this part of it; infinite, the default, for nowhere (`-sl`).
    pub light_error: f64,
    /// Find out how right the result is, for [`Notes::achieved`] (`-vb`).
    pub measure: bool,
    /// Give vertices without a normal the mean of their faces' (`-sm`).
    pub smooth: bool,
    /// Which effects to show (`-nc`, `--no-flight-time`).
    pub geometry: Geometry,
    /// Measure the vertices as well (`-at`).
    pub table: Option<Table>,
    /// How the scene is read.
    pub reading: Options,
    /// What the head comment of the output says.
    pub command_line: String,
}

impl Default for Config {
    fn default() -> Config {
        Config {
            velocity: None,
            camera_velocity: None,
            eye: None,
            camera: CameraOptions::default(),
            cull: None,
            time: 0.0,
            anchor: None,
            in_place: false,
            pieces: Pieces::UpTo(DEFAULT_ERROR),
            color_error: DEFAULT_COLOR_ERROR,
            light_error: f64::INFINITY,
            measure: false,
            smooth: false,
            geometry: Geometry::default(),
            table: None,
            reading: Options::default(),
            command_line: "uglorentz".to_string(),
        }
    }
}

/// A point that contraction leaves where it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Anchor {
    /// The eye, as in the report of 1988.
    Eye,
    /// The origin of scene coordinates.
    Origin,
    /// The middle of the box round each body.
    Center,
    /// A point in scene coordinates.
    Point(DVec3),
}

/// How edges are cut.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pieces {
    /// Until the picture is right to this angle at the eye, radians.
    UpTo(f64),
    /// Into this many equal pieces each, 1 or more.
    PerEdge(u32),
}

/// What came of it.
#[derive(Clone, Debug)]
pub struct Report {
    /// The scene as seen.
    pub scene: Scene,
    /// Measurements, as the file that was asked for.
    pub table: Option<Vec<u8>>,
    /// What was done.
    pub notes: Notes,
    /// What the reader changed to make the scene usable.
    pub warnings: Diagnostics,
}

impl Report {
    /// The scene as text.
    pub fn text(&self) -> Vec<u8> {
        ugparse::write(&self.scene)
    }
}

/// Reads a scene and gives it as seen.
///
/// # Errors
/// See [`Error`]. Errors of the scene come with their place in the text.
pub fn run(config: &Config, source: &Source) -> Result<Report, Error> {
    run_with(config, source, &())
}

/// [`run`], which tells somebody how far it is.
///
/// # Errors
/// See [`Error`]. Errors of the scene come with their place in the text.
pub fn run_with(config: &Config, source: &Source, progress: &dyn Progress) -> Result<Report, Error> {
    progress.step("reading", 0);
    let parsed =
        ugscene::read(source, &config.reading, config.camera.name.as_deref()).map_err(Error::Scene)?;
    progress.step("moving and cutting", 0);
    let (scene, notes) = transform_owned(parsed.scene, config)
        .map_err(|error| error.located(source, &parsed.origins.vertices))?;
    if config.table.is_some() {
        progress.step("measuring", 0);
    }
    let table = config.table.map(|table| {
        let rows = measure(&scene, ugscene::eye(&scene, None), config.time);
        table.write(&scene, &rows)
    });
    Ok(Report { scene, table, notes, warnings: parsed.warnings })
}

/// Gives a scene as seen.
///
/// # Errors
/// See [`Error`]; never [`Error::Scene`].
pub fn transform(scene: &Scene, config: &Config) -> Result<(Scene, Notes), Error> {
    transform_owned(scene.clone(), config)
}

fn transform_owned(mut scene: Scene, config: &Config) -> Result<(Scene, Notes), Error> {
    let velocity = check(config)?;
    ugscene::require_geometry_at_rest(&scene).map_err(Error::Stage)?;
    ugscene::require_colors_at_rest(&scene).map_err(Error::Stage)?;
    let n_faces = scene.faces.len();

    if config.velocity.is_some() {
        frame::set_velocity(&mut scene, velocity);
    }
    let camera = frame::take_camera_velocity(&mut scene, config)?;
    if !camera.is_zero() {
        frame::state_motions(&mut scene, velocity);
    }
    ugscene::separate_bodies(&mut scene);
    let eye = ugscene::eye(&scene, config.eye);
    let bodies = ugscene::vertex_bodies(&scene);
    let motions = motions(&scene, velocity, camera, config.geometry)?;
    frame::carry_velocities(&mut scene, camera)?;
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

    viewpoint::set_camera(&mut scene, eye, &config.camera);
    let sight = match config.cull {
        Some(size) => Sight::new(&viewpoint::view(&scene, &config.camera, size)?),
        None => Sight::default(),
    };
    let parts = remote::parts(&points, &motions);
    let n_culled = cull::cull(&mut scene, &mut points, &motions, &sight);

    let error = if let Pieces::UpTo(error) = config.pieces { error } else { DEFAULT_ERROR };
    let lit = Lit::new(&scene, eye, &motions, config.light_error);
    let tolerance = Tolerance::new(error, config.color_error);
    let tolerances = parts.iter().map(|&part| tolerance.with_depth(part)).collect();
    let bounds = Bounds::new(tolerances, lit, sight, &motions);
    let mut mesh = RefinedMesh::new(&motions, points);
    let outcome = match config.pieces {
        Pieces::UpTo(_) => adaptive::cut(&scene, &mut mesh, &bounds, adaptive::MAX_PIECES),
        Pieces::PerEdge(n) => {
            equal::cut(&scene, &mut mesh, n).map_err(|n_pieces| Error::TooManyPieces { n_pieces })?
        }
    };
    put_pieces(&mut scene, &outcome);
    attributes::add_vertices(&mut scene, &mesh.recipes);
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
    ugscene::record(&mut scene, PROGRAM, env!("CARGO_PKG_VERSION"), &config.command_line);

    let is_short = outcome.is_full || outcome.n_too_deep + outcome.n_uncut > 0;
    let achieved = (config.measure || is_short).then(|| achieved::measure(&scene, &mesh, &bounds));
    let notes = Notes {
        n_new_vertices: mesh.recipes.len(),
        n_new_faces: scene.faces.len() + n_culled - n_faces,
        n_culled,
        n_uncut: outcome.n_uncut,
        n_too_deep: outcome.n_too_deep,
        is_full: outcome.is_full,
        achieved,
    };
    Ok((scene, notes))
}

const PROGRAM: &str = env!("CARGO_PKG_NAME");

/// The velocity of what states none.
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

/// Of each body, in the order of [`Scene::bodies`]. `default`: of what states none.
fn motions(
    scene: &Scene,
    default: Velocity,
    camera: Velocity,
    geometry: Geometry,
) -> Result<Vec<Motion>, Error> {
    let velocity = |body: BodyId| match scene.bodies[body].motion {
        _ if body == BodyId::UNSTATED => default,
        ugparse::Motion::Inertial(velocity) => velocity,
    };
    scene.bodies.ids().map(|body| Motion::seen_by(camera, velocity(body), geometry)).collect()
}

fn points(scene: &Scene, bodies: &[BodyId], motions: &[Motion], shifts: &[DVec3], eye: DVec3) -> Vec<Point> {
    let vertices = scene.vertices.par_iter().zip(bodies.par_iter());
    vertices
        .map(|(vertex, body)| {
            let body = body.index();
            let rest = motions[body].turned(vertex.position - eye) + shifts[body];
            motions[body].point(body as u32, rest)
        })
        .collect()
}

fn name(scene: &Scene, row: usize) -> String {
    scene.names.get(scene.vertices[row].name).to_string()
}

/// Comments go with the first piece of their face.
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

/// Where vertices are seen. A body at rest that was not moved keeps its numbers to the bit.
fn set_positions(scene: &mut Scene, mesh: &RefinedMesh, shifts: &[DVec3], eye: DVec3) -> Result<(), Error> {
    let n_old = mesh.points.len() - mesh.recipes.len();
    let stays = |body: usize| mesh.motions[body].is_at_rest() && shifts[body] == DVec3::ZERO;
    let is_finite = |(row, (vertex, point)): (usize, (&mut Vertex, &Point))| {
        if row >= n_old || !stays(point.body as usize) {
            vertex.position = point.seen + eye;
        }
        vertex.position.is_finite()
    };
    let places = scene.vertices.par_iter_mut().zip(&mesh.points).enumerate().map(is_finite);
    if places.reduce(|| true, |all, one| all & one) {
        return Ok(());
    }
    match scene.vertices.iter().position(|vertex| !vertex.position.is_finite()) {
        None => Ok(()),
        Some(row) => Err(Error::OutOfRange { name: name(scene, row), row }),
    }
}
