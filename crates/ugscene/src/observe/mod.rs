//! Where bodies are for one observer: their motions relative to the camera, their rest frames, and
//! for the vertices of a scene as seen the columns of rest positions and own times.

mod camera_frame;
mod clocks;
mod eye;
mod observer;
mod placement;
mod relative_motion;
mod rest_frames;
mod seen_vertices;
mod shown_effects;
mod view_ahead;
mod world_lines;

use glam::DVec3;
use rayon::prelude::*;
use ugphysics::{Event, Lorentz, Velocity, VelocityError, WorldLineError};

pub use camera_frame::{axes_from_scene, camera_velocity};
pub use eye::{eye, seen_event, vertex_at_eye};
pub use relative_motion::RelativeMotion;
pub use rest_frames::{RestFrames, is_one_body, separate_bodies, vertex_bodies};
pub use seen_vertices::{SeenVertices, rest_positions};
pub use shown_effects::{RestPosition, SeenPosition, ShownEffects};

use observer::Observer;
use placement::Placement;

use crate::camera_options::half_side;
use crate::words::messages;
use crate::{
    BodyId, Camera, CameraError, CameraOptions, DefaultCamera, GeometryStage, Projection, Scene,
    SeenGeometry, StageError,
};

/// The largest part of its size by which rounding may move a body on a world line.
pub const MOST_ROUNDED: f64 = 1e-3;

/// How bodies, camera and lights move, and when the picture is taken.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MotionOptions {
    /// Velocity of everything, fraction of c; overrides velocities in the scene (`-vel`).
    pub velocity: Option<DVec3>,
    /// Velocity of the camera in the frame of the scene, fraction of c; overrides that of the
    /// scene's camera (`-cv`).
    pub camera_velocity: Option<DVec3>,
    /// Time of the picture on the observer's clock, (P5) (`-ti`).
    pub time: f64,
    /// The fixed point of the contraction (`-an`). Default: the reference point of each body; the
    /// eye for what `velocity` moves; the centre of each body if `in_place` is set.
    pub anchor: Option<Anchor>,
    /// Place each body so that its anchor is seen, at time 0, where the scene has it (`-in`).
    pub in_place: bool,
    /// Which effects to show (`-nc`, `--no-flight-time`).
    pub geometry: ShownEffects,
    /// The event, in the frame of the scene, at which the clocks of the camera's frame show 0. By
    /// default the eye at time 0 of the scene, so that `time` is that of a clock at the eye.
    pub zero: Option<Event>,
}

/// The fixed point of the contraction of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Anchor {
    /// The eye, as in the report of 1988.
    Eye,
    /// The origin of scene coordinates.
    Origin,
    /// The centre of the bounding box of each body.
    Center,
    /// A point in scene coordinates.
    Point(DVec3),
}

/// Why the motions of a scene are invalid.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub enum MotionError {
    /// Positions or colours of the scene are as seen already.
    Stage(StageError),
    /// [`MotionOptions::velocity`] is invalid.
    Velocity(VelocityError),
    /// [`MotionOptions::camera_velocity`] is invalid.
    CameraVelocity(VelocityError),
    /// The velocity of a body relative to the camera rounds to the speed of light.
    TooFast {
        /// The body's velocity in the frame of the scene.
        beta: DVec3,
    },
    /// The camera is invalid.
    Camera(CameraError),
    /// The eye cannot move with the camera's body.
    Eye {
        /// Why.
        error: WorldLineError,
    },
    /// A body cannot move so.
    WorldLine {
        /// The name of the motion.
        name: String,
        /// Why.
        error: WorldLineError,
    },
    /// Rounding moves a body on a world line by more than [`MOST_ROUNDED`] of its size.
    Rounded {
        /// The name of the motion.
        name: String,
        /// By how much, in the frame of the camera.
        error: f64,
    },
    /// A single effect is asked for, and a body accelerates or turns.
    PartialGeometry,
    /// A single effect is asked for, and a colour changes with own time.
    PartialTimes,
}

/// A point of a body as it is seen. Both positions are relative to the eye.
#[derive(Clone, Copy, Debug)]
pub struct ShownPoint {
    /// The body.
    pub body: BodyId,
    /// Rest coordinates, in the axes of [`RelativeMotion::turned`].
    pub rest: DVec3,
    /// Where it is seen.
    pub seen: DVec3,
    /// The own time of the body at emission, of one on a world line.
    pub own_time: f64,
}

messages! { MotionError {
    Self::Stage(error) => "{error}";
    Self::Velocity(error) => "velocity of the bodies: {error}";
    Self::CameraVelocity(error) => "velocity of the camera: {error}";
    Self::TooFast { beta: DVec3 { x, y, z } } =>
        "the body with velocity {x} {y} {z} in the scene moves too close to the speed of light relative to \
         the camera";
    Self::Camera(error) => "{error}";
    Self::Eye { error } => "the eye cannot move with the motion of the camera: {error}";
    Self::WorldLine { name, error } => "motion `{name}`: {error}";
    Self::Rounded { name, error } =>
        "motion `{name}`: rounding moves it by {error:.0e} in the picture, more than a thousandth of its size";
    Self::PartialGeometry =>
        "bodies that accelerate or turn are seen with contraction and flight time together";
    Self::PartialTimes =>
        "colours that change with time are seen with contraction and flight time together";
} }

/// Where the bodies of a scene are relative to the camera.
#[derive(Clone, Debug)]
pub struct PlacedBodies {
    /// The eye, in scene coordinates.
    pub eye: DVec3,
    /// The camera, if the scene has none.
    pub default_camera: Option<DefaultCamera>,
    /// One for each body, in their order.
    pub motions: Vec<RelativeMotion>,
    /// The body of each vertex.
    pub bodies: Vec<BodyId>,
    /// For each body, what has to be added to its rest coordinates, in the axes of
    /// [`RelativeMotion::turned`].
    pub shifts: Vec<DVec3>,
    /// The event of the eye when the picture is taken, in the frame of the scene.
    pub eye_event: Event,
    /// For each inertial body, its own time at the event of the eye; 0 for others.
    pub own_times: Vec<f64>,
}

impl MotionOptions {
    /// The same with the time of a clock at the eye, which shows 0 at time 0 of the scene.
    fn by_clock_at(&self, eye: DVec3, camera: Velocity) -> Self {
        let mut options = self.clone();
        if let Some(zero) = options.zero.take() {
            let start = Event { t: 0.0, x: eye };
            options.time -= Lorentz::boost(camera).inverse().apply(start - zero).t;
        }
        options
    }
}

impl PlacedBodies {
    /// Places the bodies of a scene at rest. In the scene, velocities become those in the frame of
    /// the camera, each body gets its own vertices, lights that move with a body are shifted with
    /// it, and the camera receives the eye and `camera`; vertices keep their positions, until
    /// [`PlacedBodies::show`] moves them. If anything moves or has moved, or a colour changes with
    /// own time, the stage becomes that of a scene as seen.
    ///
    /// `camera`: options of the camera. `size`: pixels of the picture across and down, of which the
    /// aspect ratio decides how far a camera must stand back.
    ///
    /// # Errors
    /// See [`MotionError`].
    pub fn move_to_camera_frame(
        scene: &mut Scene,
        options: &MotionOptions,
        camera: &CameraOptions,
        size: [u32; 2],
    ) -> Result<Self, MotionError> {
        let velocity = Velocity::from_beta(options.velocity.unwrap_or(DVec3::ZERO));
        let velocity = velocity.map_err(MotionError::Velocity)?;
        crate::require_geometry_at_rest(scene).map_err(MotionError::Stage)?;
        crate::require_colors_at_rest(scene).map_err(MotionError::Stage)?;
        let overridden = options.velocity.map(|_| camera_frame::set_velocity(scene, velocity));
        let observer = Observer::take(scene, options, camera.eye)?;
        let of_camera = observer.velocity;
        if !of_camera.is_zero() {
            camera_frame::state_motions(scene, velocity);
        }
        separate_bodies(scene);
        let bodies = vertex_bodies(scene);
        placement::turn_bodies(scene, &bodies);
        let mut motions = motions(scene, velocity, of_camera, options.geometry)?;
        // Bodies on world lines are fitted at rest.
        let fitted = |body: BodyId| {
            let motion =
                (!scene.bodies.is_on_world_line(body)).then(|| motions[body.index()].clone());
            motion.into_iter().collect()
        };
        let default_camera =
            DefaultCamera::new(scene, camera, size, fitted).map_err(MotionError::Camera)?;
        let eye = default_camera.map_or_else(|| eye(scene, camera.eye), |camera| camera.eye);
        let options = &options.by_clock_at(eye, of_camera);
        let placement = Placement::new(scene, &bodies, options, (eye, observer), overridden);
        world_lines::release_parts_of_inertial_bodies(scene)?;
        let frames = placement.frames(scene);
        camera_frame::state_relative_motions(scene, &motions, of_camera)?;
        world_lines::place(scene, &mut motions, &placement)?;
        world_lines::check_rounding(scene, &bodies, &placement)?;
        let has_motion = !velocity.is_zero()
            || !of_camera.is_zero()
            || observer.has_left()
            || crate::has_moving_bodies(scene)
            || crate::has_moving_lights(scene)
            || !scene.color_tables.is_empty();
        let shifts = placement.shifts(&motions, &frames);
        placement::shift_lights(scene, &motions, &shifts);
        let own_times = clocks::times_at_eye((&motions, &frames), &placement);
        clocks::count_from_eye(scene, &own_times, &placement)?;
        camera.check_up().map_err(MotionError::Camera)?;
        let center = default_camera.map(|camera| camera.center);
        set_camera(scene, eye, center, camera, of_camera).map_err(MotionError::Camera)?;
        turn_camera(scene, eye, &observer);
        let MotionOptions { time, geometry: ShownEffects { contraction, flight_time }, .. } =
            *options;
        if has_motion || options.geometry != ShownEffects::default() {
            let camera_velocity = of_camera;
            let is_whole = false;
            let seen =
                SeenGeometry { eye, time, camera_velocity, contraction, flight_time, is_whole };
            scene.stage.geometry = GeometryStage::AsSeen(seen);
        }
        let eye_event = placement.eye_event();
        Ok(Self { eye, default_camera, motions, bodies, shifts, eye_event, own_times })
    }

    /// The rest position p' of each vertex, relative to the eye, in the axes of
    /// [`RelativeMotion::turned`].
    pub fn rest_positions(&self, scene: &Scene) -> Vec<DVec3> {
        let vertices = scene.vertices.par_iter().zip(&self.bodies);
        vertices
            .map(|(vertex, &body)| {
                self.motions[body.index()].turned(vertex.position - self.eye)
                    + self.shifts[body.index()]
            })
            .collect()
    }

    /// Puts vertices where they are seen, and fills the columns of rest positions and own times if
    /// the stage of the scene says that it is as seen. Vertices before `n_placed` have their place:
    /// on a body at rest that was not shifted it stays the same to the bit.
    ///
    /// `points`: of each vertex. Returns the first row whose position is not finite.
    pub fn show(&self, scene: &mut Scene, points: &[ShownPoint], n_placed: usize) -> Option<usize> {
        let motion = |point: &ShownPoint| &self.motions[point.body.index()];
        if scene.stage.seen_geometry().is_some() {
            scene.rest = points.iter().map(|point| motion(point).turned_back(point.rest)).collect();
        }
        if scene.bodies.has_world_lines() {
            let own_time = |point: &ShownPoint| motion(point).world_line().map(|_| point.own_time);
            scene.own_times =
                points.iter().map(|point| own_time(point).unwrap_or(f64::NAN)).collect();
        }
        let mut first = None;
        for (row, (vertex, point)) in scene.vertices.iter_mut().zip(points).enumerate() {
            let stays =
                motion(point).is_at_rest() && self.shifts[point.body.index()] == DVec3::ZERO;
            if row >= n_placed || !stays {
                vertex.position = point.seen + self.eye;
            }
            if !vertex.position.is_finite() {
                first = first.or(Some(row));
            }
        }
        first
    }
}

/// One for each body, in their order. `default`: the velocity of bodies whose motion is not stated.
fn motions(
    scene: &Scene,
    default: Velocity,
    camera: Velocity,
    geometry: ShownEffects,
) -> Result<Vec<RelativeMotion>, MotionError> {
    let motion = |body: BodyId| {
        if scene.bodies.is_on_world_line(body) {
            // Replaced when the place of the eye is known.
            return Ok(RelativeMotion::new(Velocity::ZERO, geometry));
        }
        seen_by(camera, scene.bodies.stated_velocity(body).unwrap_or(default), geometry)
    };
    scene.bodies.ids().map(motion).collect()
}

/// The motion of a body and a camera with velocities `in_scene` and `camera` in the frame of the
/// scene.
///
/// # Errors
/// Their relative velocity rounds to that of light.
fn seen_by(
    camera: Velocity,
    in_scene: Velocity,
    geometry: ShownEffects,
) -> Result<RelativeMotion, MotionError> {
    let velocity = camera_frame::in_camera_frame(in_scene, camera)?;
    Ok(RelativeMotion::composed(velocity, in_scene, camera, geometry))
}

/// One default camera for several pictures of a scene at rest, with these motions.
///
/// # Errors
/// See [`DefaultCamera::new`].
pub fn common_camera(
    scene: &Scene,
    options: &CameraOptions,
    size: [u32; 2],
    pictures: &[MotionOptions],
) -> Result<Option<DefaultCamera>, CameraError> {
    let frames = RestFrames::new(scene);
    let motion = |picture: &MotionOptions, body: BodyId| {
        let stated = |beta: Option<DVec3>| Velocity::from_beta(beta?).ok();
        let own = stated(picture.velocity).unwrap_or_else(|| frames.velocity(body));
        let camera = stated(picture.camera_velocity).unwrap_or_default();
        seen_by(camera, own, picture.geometry).ok()
    };
    let motions = |body| pictures.iter().filter_map(|picture| motion(picture, body)).collect();
    DefaultCamera::new(scene, options, size, motions)
}

/// The camera of a scene when the picture is taken, in its own frame, and its velocity in the frame
/// of the scene; for pictures of a sky, of which nothing else is needed. `None` if the scene has no
/// camera.
///
/// # Errors
/// See [`MotionError`]: that of the camera alone.
pub fn moving_camera(
    scene: &Scene,
    options: &MotionOptions,
    camera: &CameraOptions,
) -> Result<Option<(Camera, Velocity)>, MotionError> {
    crate::require_geometry_at_rest(scene).map_err(MotionError::Stage)?;
    let Some(row) = scene.camera_row() else { return Ok(None) };
    let middle = crate::camera::middle(scene);
    let (cameras, bodies) = (scene.cameras.clone(), scene.bodies.clone());
    let mut scene = Scene { cameras, bodies, ..Scene::default() };
    let observer = Observer::take(&mut scene, options, camera.eye)?;
    let eye = eye(&scene, camera.eye);
    camera.check_up().map_err(MotionError::Camera)?;
    set_camera(&mut scene, eye, Some(middle), camera, observer.velocity)
        .map_err(MotionError::Camera)?;
    turn_camera(&mut scene, eye, &observer);
    Ok(Some((scene.cameras.swap_remove(row), observer.velocity)))
}

/// Turns the view with a camera that spins, or whose axes a path has turned.
fn turn_camera(scene: &mut Scene, eye: DVec3, observer: &Observer) {
    if observer.turn == glam::DQuat::IDENTITY {
        return;
    }
    let middle = crate::camera::middle(scene);
    let row = scene.camera_row().unwrap_or(0);
    let camera = &mut scene.cameras[row];
    let center = camera.center.unwrap_or(middle);
    camera.center = Some(eye + observer.turned(center - eye));
    camera.up = Some(observer.turned(camera.up.unwrap_or(DVec3::Z)));
}

/// Writes the eye and the options into the scene's camera, so that programs downstream use them.
/// `center`: the view centre of the default camera. `velocity`: of the camera in the scene.
///
/// # Errors
/// [`CameraError::NoDirection`], which programs downstream would report otherwise.
fn set_camera(
    scene: &mut Scene,
    eye: DVec3,
    center: Option<DVec3>,
    options: &CameraOptions,
    velocity: Velocity,
) -> Result<(), CameraError> {
    let middle = crate::camera::middle(scene);
    if scene.cameras.is_empty() {
        scene.cameras.push(Camera::default());
    }
    let row = scene.camera_row().unwrap_or(0);
    let camera = &mut scene.cameras[row];
    camera.eye = Some(eye);
    camera.center = options.center.or(camera.center).or(center);
    camera.up = options.up.or(camera.up);
    if options.is_orthographic {
        camera.projection = Some(Projection::Orthographic);
    }
    if let Some((across, down)) = options.view_angle {
        let angles = [across, down.unwrap_or(across)];
        // So small an angle that the film has no width is refused by every renderer.
        angles.into_iter().try_for_each(|angle| half_side(angle).map(drop))?;
        camera.view_angle = Some(angles);
        // They would contradict the view angle.
        (camera.film_size, camera.focal_length) = (None, None);
    }
    if options.is_ahead {
        view_ahead::look_ahead(camera, eye, middle, velocity)?;
    }
    camera.center.map_or(Ok(()), |center| crate::view_distance(eye, center).map(drop))
}
