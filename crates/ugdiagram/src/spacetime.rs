//! The spacetime of a scene: world lines of bodies, lamps and cameras, and the events at which the
//! light of the picture left.
//!
//! Everything is in the frame of the camera, with the event of the eye as origin, as programs that
//! draw pictures compute it, so that diagram and picture cannot contradict each other.

use std::collections::{BTreeMap, BTreeSet};

use glam::DVec3;
use ugimage::label::number::significant;
use ugphysics::{
    Event, Hsv, InertialFrame, Lorentz, Velocity, WorldLine, luminance, srgb_decode, srgb_encode,
};
use ugscene::{
    BodyId, CameraOptions, ColorId, ColorTable, DefaultCamera, LightKind, MotionOptions,
    MotionPath, PlacedBodies, Scene,
};

use crate::error::Error;
use crate::frame::ReferenceFrame;
use crate::words::{FrameOwner, FrameWord};
use crate::world_line::at_time;

/// Display-encoded red, green and blue.
pub type Ink = [u8; 3];

/// The spacetime of a scene.
#[derive(Clone, Debug)]
pub struct Spacetime {
    /// World lines: bodies, lamps, then cameras, of which the last takes the picture.
    pub lines: Vec<SpacetimeLine>,
    /// The light of the picture, from the vertices of faces and wires.
    pub lights: Vec<EmittedLight>,
    /// What lights up.
    pub flashes: Vec<FlashSource>,
    /// The camera, if the scene has none.
    pub default_camera: Option<DefaultCamera>,
    /// The event of the eye in the frame of the scene.
    eye: Event,
    /// Of the camera, in the frame of the scene.
    camera: Velocity,
    /// On the clock of the camera.
    time: f64,
}

/// A body, lamp or camera.
#[derive(Clone, Debug)]
pub struct SpacetimeLine {
    /// Its name.
    pub name: String,
    /// How it moves, in the frame of the camera with the event of the eye as origin.
    pub motion: WorldLine,
    /// The point of it whose world line is drawn, in the coordinates of its motion: the middle of
    /// an inertial body, the reference point of others.
    pub point: DVec3,
    /// Its vertices, for a body that neither spins nor rides on what does.
    pub vertices: Vec<DVec3>,
    /// Its colour, dark enough for a white background.
    pub color: Ink,
    /// Own times at which its motion changes.
    pub changes: Vec<f64>,
}

impl SpacetimeLine {
    /// The event of a point of it at an own time.
    ///
    /// # Errors
    /// [`Error::WorldLine`].
    pub fn event(&self, point: DVec3, own_time: f64) -> Result<Event, Error> {
        self.motion.event(point, own_time).map_err(Error::of_line(&self.name))
    }

    /// The event of a point of it at a time of a frame, and the own time then.
    ///
    /// # Errors
    /// [`Error::WorldLine`].
    pub fn at_time(
        &self,
        point: DVec3,
        frame: &ReferenceFrame,
        time: f64,
    ) -> Result<(Event, f64), Error> {
        at_time(&self.motion, point, frame, time).map_err(Error::of_line(&self.name))
    }
}

/// The light of the picture that left a vertex.
#[derive(Clone, Debug, PartialEq)]
pub struct EmittedLight {
    /// The name of the vertex.
    pub vertex: String,
    /// The row of its body in [`Spacetime::lines`].
    pub line: usize,
    /// When and where it left.
    pub event: Event,
    /// The own time of the body then.
    pub own_time: f64,
}

/// A lamp or a face that changes from dark to light (`c_time`).
#[derive(Clone, Debug, PartialEq)]
pub struct FlashSource {
    /// The row of its lamp or body in [`Spacetime::lines`].
    pub line: usize,
    /// Its place, in the coordinates of the motion.
    pub point: DVec3,
    /// Own times at which it lights up.
    pub own_times: Vec<f64>,
    /// They repeat after this time.
    pub period: Option<f64>,
}

/// The sagitta of polygons in place of round faces, relative to their radius.
const SAGITTA: f64 = 1e-2;

impl Spacetime {
    /// The spacetime of a scene at rest, seen as the options say.
    ///
    /// # Errors
    /// See [`Error`].
    pub fn new(
        mut scene: Scene,
        motion: &MotionOptions,
        camera: &CameraOptions,
        size: [u32; 2],
    ) -> Result<Self, Error> {
        ugscene::cut_rounds(&mut scene, |_, _, _| Some(SAGITTA))?;
        let at_rest = Scene { vertices: Vec::new(), faces: Vec::new(), ..scene.clone() };
        let placed = PlacedBodies::move_to_camera_frame(&mut scene, motion, camera, size)?;
        let velocity = ugscene::camera_velocity(&scene);
        let mut out = Self {
            lines: Vec::new(),
            lights: Vec::new(),
            flashes: Vec::new(),
            default_camera: placed.default_camera,
            eye: placed.eye_event,
            camera: velocity,
            time: motion.time,
        };
        let rows = out.add_bodies(&scene, &placed)?;
        out.add_lamps(&at_rest, &scene, &placed, &rows);
        out.add_cameras(&at_rest, &placed, motion, camera)?;
        out.make_names_unique();
        Ok(out)
    }

    /// Adds bodies, their light and the flashes of their faces. Returns the row of each body.
    fn add_bodies(
        &mut self,
        scene: &Scene,
        placed: &PlacedBodies,
    ) -> Result<Vec<Option<usize>>, Error> {
        let mut is_used = vec![false; scene.vertices.len()];
        for drawn in scene.drawn() {
            let corners = scene.contours.corners(drawn.contours);
            corners.iter().for_each(|corner| is_used[corner.index()] = true);
        }
        let rest = placed.rest_positions(scene);
        let mut vertices: Vec<Vec<usize>> = vec![Vec::new(); scene.bodies.len()];
        for (row, body) in placed.bodies.iter().enumerate().filter(|(row, _)| is_used[*row]) {
            vertices[body.index()].push(row);
        }
        let colors = body_colors(scene);
        let mut rows = vec![None; scene.bodies.len()];
        for body in scene.bodies.ids() {
            let own = &vertices[body.index()];
            let is_stated = scene.bodies.statement(body).is_some();
            if own.is_empty() && !is_stated {
                continue;
            }
            let name = body_name(scene, placed, body, own);
            let motion = body_motion(placed, body);
            let points: Vec<DVec3> = own.iter().map(|&row| rest[row]).collect();
            let point = reference_point(scene, placed, body, &points);
            motion.check(point).map_err(Error::of_line(&name))?;
            let clock = placed.own_times[body.index()];
            for &row in own {
                let vertex = scene.names.get(scene.vertices[row].name).to_owned();
                let (seen, own_time) = placed.motions[body.index()]
                    .light(rest[row])
                    .map_err(Error::of_line(&vertex))?;
                let event = ugscene::seen_event(seen);
                let line = self.lines.len();
                self.lights.push(EmittedLight { vertex, line, event, own_time: own_time + clock });
            }
            rows[body.index()] = Some(self.lines.len());
            self.lines.push(SpacetimeLine {
                name,
                motion,
                point,
                vertices: if turns(scene, body) { Vec::new() } else { points },
                color: ink(colors[body.index()]),
                changes: changes(scene, body),
            });
        }
        let mut known = BTreeSet::new();
        for drawn in scene.drawn() {
            let (Some(color), Some(line)) = (drawn.color, rows[drawn.body.index()]) else {
                continue;
            };
            // Tables of inertial bodies count from the event of the eye.
            let clock = placed.own_times[drawn.body.index()];
            let table = scene.table_of(color).map(|table| table.counted_from(-clock));
            let corners = scene.contours.corners(drawn.contours);
            if let Some(table) = table
                && known.insert((line, color))
            {
                let sum: DVec3 = corners.iter().map(|corner| rest[corner.index()]).sum();
                self.add_flashes(scene, line, sum / corners.len() as f64, &table);
            }
        }
        Ok(rows)
    }

    /// Adds lamps with a place. `at_rest`: with their places and colours as the text has them.
    fn add_lamps(
        &mut self,
        at_rest: &Scene,
        scene: &Scene,
        placed: &PlacedBodies,
        rows: &[Option<usize>],
    ) {
        for (own, moved) in at_rest.lights.iter().zip(&scene.lights) {
            let (LightKind::Local { position, .. }, LightKind::Local { position: shifted, .. }) =
                (&own.kind, &moved.kind)
            else {
                continue;
            };
            let (body, point) = match own.motion.body() {
                Some(body) => {
                    let motion = &placed.motions[body.index()];
                    (body, motion.turned(*shifted - placed.eye))
                }
                // It rests in the scene.
                None => {
                    let body = scene.bodies.unstated();
                    let motion = &placed.motions[body.index()];
                    let shift = placed.shifts[body.index()];
                    (body, motion.turned(*position - placed.eye) + shift)
                }
            };
            let line = self.lines.len();
            let name = own.name.map_or("lamp", |name| at_rest.names.get(name)).to_owned();
            let color = own.color.map(|color| uglight::display_hue(at_rest, color));
            self.lines.push(SpacetimeLine {
                name,
                motion: body_motion(placed, body),
                point,
                vertices: Vec::new(),
                color: color.map_or(LAMP, ink),
                changes: rows[body.index()]
                    .map_or(Vec::new(), |row| self.lines[row].changes.clone()),
            });
            if let Some(table) = own.color.and_then(|color| at_rest.table_of(color)) {
                self.add_flashes(at_rest, line, point, table);
            }
        }
    }

    fn add_flashes(&mut self, scene: &Scene, line: usize, point: DVec3, table: &ColorTable) {
        let own_times = onsets(scene, table);
        if !own_times.is_empty() {
            self.flashes.push(FlashSource { line, point, own_times, period: table.period });
        }
    }

    /// Adds cameras with a name, then the one that takes the picture. `at_rest`: with their motions.
    fn add_cameras(
        &mut self,
        at_rest: &Scene,
        placed: &PlacedBodies,
        options: &MotionOptions,
        chosen: &CameraOptions,
    ) -> Result<(), Error> {
        let row = at_rest.camera_row();
        for (_, camera) in
            at_rest.cameras.iter().enumerate().filter(|(other, _)| Some(*other) != row)
        {
            let (Some(name), Some(eye)) = (camera.name, camera.eye) else { continue };
            let (motion, point) = match camera.carrier {
                Some(body) => {
                    let shift = placed.shifts[body.index()];
                    let motion = &placed.motions[body.index()];
                    (body_motion(placed, body), motion.turned(eye - placed.eye) + shift)
                }
                None => {
                    let frame = InertialFrame {
                        at: eye,
                        ..InertialFrame::new(camera.velocity.unwrap_or_default())
                    };
                    let from_scene = Lorentz::boost(self.camera).inverse();
                    (WorldLine::inertial(frame).in_frame(from_scene, self.eye), eye)
                }
            };
            let name = at_rest.names.get(name).to_owned();
            motion.check(point).map_err(Error::of_line(&name))?;
            self.lines.push(camera_line(name, motion, point));
        }
        let carrier = row.and_then(|row| at_rest.cameras[row].carrier);
        let carrier = carrier.filter(|_| options.camera_velocity.is_none());
        let (motion, point, changes) = match carrier {
            Some(body) => {
                let eye = ugscene::eye(at_rest, chosen.eye);
                let motion = at_rest.bodies.motion(body);
                // Relative to the event of the eye it does not matter where the body is placed.
                let event = motion.event(eye, self.time).map_err(Error::of_line("camera"))?;
                let from_scene = Lorentz::boost(self.camera).inverse();
                (motion.in_frame(from_scene, event), eye, changes(at_rest, body))
            }
            None => {
                let start = Event { t: -self.time, x: DVec3::ZERO };
                let frame = InertialFrame { shift: start, ..InertialFrame::REST };
                (WorldLine::inertial(frame), DVec3::ZERO, Vec::new())
            }
        };
        let line = camera_line("camera".to_owned(), motion, point);
        self.lines.push(SpacetimeLine { changes, ..line });
        Ok(())
    }

    /// Numbers the later ones of several lines with the same name.
    fn make_names_unique(&mut self) {
        let mut counts: BTreeMap<String, usize> = BTreeMap::new();
        for line in &mut self.lines {
            let count = counts.entry(line.name.clone()).or_default();
            *count += 1;
            if *count > 1 {
                line.name = format!("{}_{count}", line.name);
            }
        }
    }

    /// The row of a line.
    ///
    /// # Errors
    /// [`Error::UnknownLine`].
    pub fn line(&self, name: &str) -> Result<usize, Error> {
        self.lines.iter().position(|line| line.name == name).ok_or_else(|| Error::UnknownLine {
            name: name.to_owned(),
            known: self.lines.iter().map(|line| line.name.clone()).collect(),
        })
    }

    /// The line of the camera that takes the picture.
    pub fn camera_line(&self) -> usize {
        self.lines.len() - 1
    }

    /// The frame in which the scene is written.
    pub fn scene_frame(&self) -> ReferenceFrame {
        ReferenceFrame::new(
            "scene".to_owned(),
            Lorentz::boost(self.camera),
            Event::ORIGIN,
            self.eye,
        )
    }

    /// The frame of the camera when the picture is taken: its clock, and places relative to the eye.
    pub fn camera_frame(&self) -> ReferenceFrame {
        let now = Event { t: self.time, x: DVec3::ZERO };
        ReferenceFrame::new("camera".to_owned(), Lorentz::IDENTITY, Event::ORIGIN, now)
    }

    /// A frame by its name. That of a body has its own time, and places relative to its point; of a
    /// body that accelerates, the frame in which it rests at an own time, by default at the time of
    /// the scene at which the picture is taken. Axes are those of a boost from the scene.
    ///
    /// # Errors
    /// [`Error::UnknownLine`], [`Error::NoOwnTime`], [`Error::WorldLine`].
    pub fn frame(&self, word: &FrameWord) -> Result<ReferenceFrame, Error> {
        let name = match &word.owner {
            FrameOwner::Scene | FrameOwner::Camera if word.own_time.is_some() => {
                return Err(Error::NoOwnTime(word.to_string()));
            }
            FrameOwner::Scene => return Ok(self.scene_frame()),
            FrameOwner::Camera => return Ok(self.camera_frame()),
            FrameOwner::Line(name) => name,
        };
        self.frame_of(self.line(name)?, word.own_time)
    }

    /// The frame of a line, see [`Spacetime::frame`].
    ///
    /// # Errors
    /// [`Error::WorldLine`].
    pub fn frame_of(&self, row: usize, own_time: Option<f64>) -> Result<ReferenceFrame, Error> {
        let SpacetimeLine { name, motion, point, .. } = &self.lines[row];
        let scene_from_camera = Lorentz::boost(self.camera);
        let is_inertial = motion.inertial_frame().is_some();
        let now = || motion.own_time_when(Event::ORIGIN, scene_from_camera);
        let own_time = own_time.unwrap_or_else(|| if is_inertial { 0.0 } else { now() });
        let failed = Error::of_line(name);
        motion.check_turn(own_time).map_err(&failed)?;
        let event = motion.event(*point, own_time).map_err(&failed)?;
        let axes = scene_from_camera * motion.frame(*point, own_time);
        let velocity = axes.velocity_of_frame().map_err(|error| failed(error.into()))?;
        let from_camera = Lorentz::boost(velocity).inverse() * scene_from_camera;
        let start = Event { t: own_time, x: DVec3::ZERO };
        let time = significant(own_time, 6).replace('−', "-");
        let name = if is_inertial { name.clone() } else { format!("{name}@{time}") };
        Ok(ReferenceFrame::new(name, from_camera, event, start))
    }
}

/// The colour of lamps without one of their own.
const LAMP: Ink = [176, 112, 0];

fn camera_line(name: String, motion: WorldLine, point: DVec3) -> SpacetimeLine {
    let (vertices, changes) = (Vec::new(), Vec::new());
    SpacetimeLine { name, motion, point, vertices, color: [0; 3], changes }
}

/// The motion of a body in the frame of the camera; coordinates of the body are rest positions.
fn body_motion(placed: &PlacedBodies, body: BodyId) -> WorldLine {
    let motion = &placed.motions[body.index()];
    if let Some(line) = motion.world_line() {
        return (**line).clone();
    }
    let velocity = motion.velocity();
    let own_time = placed.own_times[body.index()];
    let shift = Lorentz::boost(velocity).apply(Event { t: -own_time, x: DVec3::ZERO });
    WorldLine::inertial(InertialFrame { shift, ..InertialFrame::new(velocity) })
}

/// The point of a body whose world line is drawn: the reference point of one that accelerates or
/// turns, whose own time that of its clock is, or that has no vertices; otherwise the middle.
fn reference_point(
    scene: &Scene,
    placed: &PlacedBodies,
    body: BodyId,
    vertices: &[DVec3],
) -> DVec3 {
    let is_moved = placed.motions[body.index()].world_line().is_some();
    let statement = scene.bodies.statement(body).filter(|_| is_moved || vertices.is_empty());
    if let Some(statement) = statement {
        let motion = &placed.motions[body.index()];
        return motion.turned(statement.at - placed.eye) + placed.shifts[body.index()];
    }
    let empty = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    let (low, high) =
        vertices.iter().fold(empty, |(low, high), &point| (low.min(point), high.max(point)));
    if low.x <= high.x { low.midpoint(high) } else { DVec3::ZERO }
}

/// True if a body, or one that it rides on, spins.
fn turns(scene: &Scene, body: BodyId) -> bool {
    let mut carriers = scene.bodies.carriers(body);
    carriers.any(|body| scene.bodies.statement(body).is_some_and(|motion| !motion.spins.is_empty()))
}

/// Own times at which the motion of a body changes, and 0 for motions with a name.
fn changes(scene: &Scene, body: BodyId) -> Vec<f64> {
    let Some(motion) = scene.bodies.statement(body) else { return Vec::new() };
    let mut changes = vec![0.0];
    match &motion.path {
        MotionPath::Free { accelerations, .. } => {
            let ends = accelerations.iter().flat_map(|piece| [piece.from, piece.to]);
            changes.extend(ends.filter(|end| end.is_finite()));
        }
        MotionPath::Along(path) => {
            let mut events = path.events();
            // Less own time passes than time.
            if let (Some(first), Some(last)) = (events.next(), events.last()) {
                changes.push(last.t - first.t);
            }
        }
        MotionPath::Curve { .. } => {}
    }
    // What it rides on changes with it.
    if let Some(carrier) = motion.body() {
        changes.extend(self::changes(scene, carrier));
    }
    changes
}

/// The name of a body: that of its motion, or what the paths of its vertices have in common.
fn body_name(scene: &Scene, placed: &PlacedBodies, body: BodyId, vertices: &[usize]) -> String {
    if let Some(name) = scene.bodies[body].name {
        return scene.names.get(name).to_owned();
    }
    let paths = vertices.iter().map(|&row| scene.names.get(scene.vertices[row].name));
    let mut common: Option<Vec<&str>> = None;
    for path in paths {
        let (path, _) = path.rsplit_once(':').unwrap_or_default();
        let path: Vec<&str> = path.split(':').filter(|part| !part.is_empty()).collect();
        let shared = |known: Vec<&str>| known.iter().zip(&path).take_while(|(a, b)| a == b).count();
        common = Some(match common {
            None => path,
            Some(known) => path[..shared(known)].to_vec(),
        });
    }
    match common {
        Some(path) if !path.is_empty() => path.join(":"),
        _ if placed.motions[body.index()].in_scene().is_zero() => "rest".to_owned(),
        _ => format!("body{}", body.index()),
    }
}

/// Of each body, the colour of which most is seen: that with the largest product of area and
/// saturation; white if it has none.
fn body_colors(scene: &Scene) -> Vec<Hsv> {
    /// Area of unsaturated colours that counts as much as saturated ones.
    const PALE: f64 = 0.02;
    let mut areas: Vec<BTreeMap<ColorId, f64>> = vec![BTreeMap::new(); scene.bodies.len()];
    let position = |corner: ugscene::VertexId| scene.vertices[corner.index()].position;
    for drawn in scene.drawn() {
        let Some(color) = drawn.color else { continue };
        let corners = scene.contours.corners(drawn.contours);
        let Some(&first) = corners.first() else { continue };
        let fan = corners.windows(2).map(|pair| {
            let [a, b] = [0, 1].map(|side| position(pair[side]) - position(first));
            a.cross(b)
        });
        // A wire has no area, but a colour.
        let area = fan.sum::<DVec3>().length().max(f64::MIN_POSITIVE);
        *areas[drawn.body.index()].entry(color).or_default() += area;
    }
    let most = |areas: BTreeMap<ColorId, f64>| {
        let mut best = (0.0, Hsv { hue: 0.0, saturation: 0.0, value: 1.0 });
        for (color, area) in areas {
            let color = uglight::display_hue(scene, color);
            let weight = area * (PALE + color.saturation * color.value.clamp(0.0, 1.0));
            if weight > best.0 {
                best = (weight, color);
            }
        }
        best.1
    };
    areas.into_iter().map(most).collect()
}

/// A colour as ink: dark enough to be read on white.
fn ink(color: Hsv) -> Ink {
    /// Luminance with a contrast of 4.5 to white.
    const MOST: f64 = 0.18;
    let light = color.to_rgb().map(|channel| srgb_decode(channel.clamp(0.0, 1.0)));
    let brightness = luminance(light);
    let factor = if brightness > MOST { MOST / brightness } else { 1.0 };
    light.map(|channel| (255.0 * srgb_encode(channel * factor)).round() as u8)
}

/// Own times within one period at which a colour changes from black to one that is not.
fn onsets(scene: &Scene, table: &ColorTable) -> Vec<f64> {
    let is_dark = |color: ColorId| {
        uglight::display_hue(scene, color).to_rgb().iter().all(|&part| part <= 0.0)
    };
    let n_rows = table.rows.len();
    let onset = |row: usize| {
        let before = match (row, table.period) {
            (0, None) => return None,
            (0, Some(_)) => n_rows - 1,
            (row, _) => row - 1,
        };
        let [(start, dark), (jump, lit)] = [table.rows[before], table.rows[row]];
        // Without steps it begins to rise at the row before.
        let time = if table.is_stepped { jump } else { start };
        (is_dark(dark) && !is_dark(lit)).then_some(time + table.shift)
    };
    (0..n_rows).filter_map(onset).collect()
}
