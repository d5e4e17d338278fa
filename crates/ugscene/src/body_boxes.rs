//! Where the bodies of a scene are seen, and when, without drawing them.

use std::ops::Range;

use glam::DVec3;

use crate::default_camera::{rounded, unit_of_rounding};
use crate::{
    BodyId, Camera, CameraOptions, FaceOrWire, HalfSpace, MotionError, MotionOptions, PlacedBodies,
    RelativeMotion, Scene, Vertex, VertexId, View, Wire,
};

/// About how many boxes a scene is divided into, besides one for each body.
const N_BOXES: usize = 256;

/// Boxes around the parts of the bodies of a scene at rest.
///
/// They move as the bodies do, and there are few of them, so a film can find the frames in which
/// nothing is seen before it draws any.
#[derive(Clone, Debug)]
pub struct BodyBoxes {
    /// A scene with the bodies and the camera of the original. Each of its wires has the corners of
    /// a box, which are its own vertices; two vertices of the body follow them. Two more span the
    /// unused ones of the original, so that bodies have the same centres.
    scene: Scene,
}

/// Corners of a box.
const N_CORNERS: usize = 8;

/// Rows of vertices of a box: its corners and two vertices of the body in it.
const N_ROWS: usize = N_CORNERS + 2;

/// The rows of the corners of a box.
fn corners(row: usize) -> Range<usize> {
    N_ROWS * row..N_ROWS * row + N_CORNERS
}

/// The length of the mean of directions below which they point to all sides.
const AROUND: f64 = 0.05;

/// Part of a body: its bounding box.
#[derive(Clone, Copy, Debug)]
struct Part {
    body: BodyId,
    low: DVec3,
    high: DVec3,
    /// Two of its vertices.
    points: [DVec3; 2],
}

impl Part {
    fn empty(body: BodyId) -> Self {
        Self { body, low: DVec3::INFINITY, high: DVec3::NEG_INFINITY, points: [DVec3::ZERO; 2] }
    }

    fn with(self, low: DVec3, high: DVec3) -> Self {
        Self { low: self.low.min(low), high: self.high.max(high), ..self }
    }

    fn corners(&self) -> [DVec3; N_CORNERS] {
        std::array::from_fn(|idx| {
            let side = |bit: usize, low: f64, high: f64| if idx & bit == 0 { low } else { high };
            let (low, high) = (self.low, self.high);
            DVec3::new(side(1, low.x, high.x), side(2, low.y, high.y), side(4, low.z, high.z))
        })
    }
}

impl BodyBoxes {
    /// The boxes of a scene.
    pub fn new(scene: &Scene) -> Self {
        let mut bodies = scene.bodies.ids().map(|_| Vec::new()).collect::<Vec<_>>();
        let mut n_parts: usize = 0;
        let mut is_used = vec![false; scene.vertices.len()];
        for FaceOrWire { contours, body, .. } in scene.drawn() {
            let corners = scene.contours.corners(contours);
            let position = |corner: &VertexId| scene.vertices[corner.index()].position;
            let mut part = corners.iter().fold(Part::empty(body), |part, corner| {
                is_used[corner.index()] = true;
                part.with(position(corner), position(corner))
            });
            if let [first, ..] = corners {
                part.points = [position(first), position(&corners[corners.len() / 2])];
            }
            bodies[body.index()].push(part);
            n_parts += 1;
        }
        for (body, round) in scene.rounds() {
            let [low, high] = round.bounds();
            bodies[body.index()]
                .push(Part { points: [low, high], ..Part::empty(body).with(low, high) });
            n_parts += 1;
        }
        let most = n_parts.div_ceil(N_BOXES).max(1);
        let mut boxes = Vec::new();
        bodies.iter_mut().for_each(|parts| divide(parts, most, &mut boxes));
        let camera = scene.camera().map(|camera| Camera { name: None, ..camera.clone() });
        let mut out = Scene {
            stage: scene.stage,
            cameras: Vec::from_iter(camera),
            bodies: scene.bodies.clone(),
            ..Scene::default()
        };
        out.bodies.rename(|name| out.names.add(scene.names.get(name)));
        boxes.iter().for_each(|part| add_box(&mut out, part));
        let unused = scene.vertices.iter().zip(&is_used).filter(|(_, is_used)| !**is_used);
        let unused = unused.fold(Part::empty(scene.bodies.unstated()), |part, (vertex, _)| {
            part.with(vertex.position, vertex.position)
        });
        if unused.low.x <= unused.high.x {
            [unused.low, unused.high].into_iter().for_each(|corner| {
                add_vertex(&mut out, corner);
            });
        }
        Self { scene: out }
    }

    /// True if the scene has a camera.
    pub(crate) fn has_camera(&self) -> bool {
        self.scene.camera().is_some()
    }

    /// Where they are seen.
    ///
    /// # Errors
    /// See [`PlacedBodies::move_to_camera_frame`] and [`View::new`].
    pub fn seen(
        &self,
        motion: &MotionOptions,
        camera: &CameraOptions,
        size: [u32; 2],
    ) -> Result<SeenBoxes, MotionError> {
        let mut scene = self.scene.clone();
        let placed = PlacedBodies::move_to_camera_frame(&mut scene, motion, camera, size)?;
        let rest = placed.rest_positions(&scene);
        let middle = |row: usize| {
            let first = row - row % N_ROWS;
            let corners = &rest[first..rest.len().min(first + N_CORNERS)];
            corners.iter().sum::<DVec3>() / corners.len() as f64
        };
        // A corner of the box of a spinning body may be too far out to move so; it is then where
        // the middle of its box is.
        let seen = |(row, (&rest, body)): (usize, (&DVec3, &BodyId))| {
            let motion = &placed.motions[body.index()];
            motion.light(rest).or_else(|_| motion.light(middle(row))).map_or(rest, |(seen, _)| seen)
        };
        let seen: Vec<DVec3> = rest.iter().zip(&placed.bodies).enumerate().map(seen).collect();
        // A view without a centre is toward the middle of what is seen.
        for (vertex, seen) in scene.vertices.iter_mut().zip(&seen) {
            vertex.position = placed.eye + *seen;
        }
        let camera = CameraOptions { eye: None, ..camera.clone() };
        let view = View::new(&scene, &camera, size).map_err(MotionError::Camera)?;
        let n_boxes = scene.wires.len();
        let stage = scene.stage.seen_geometry();
        let camera_speed = stage.map_or(0.0, |stage| stage.camera_velocity.beta().length());
        Ok(SeenBoxes { placed, rest, seen, n_boxes, camera_speed, view })
    }
}

/// Appends the boxes of the halves of a body, of their halves, and so on, until a box contains at
/// most `most` parts.
fn divide(parts: &mut [Part], most: usize, boxes: &mut Vec<Part>) {
    let Some(first) = parts.first() else { return };
    let mut whole =
        parts.iter().fold(Part::empty(first.body), |whole, part| whole.with(part.low, part.high));
    whole.points = [first.points[0], parts[parts.len() - 1].points[1]];
    if parts.len() <= most {
        boxes.push(whole);
        return;
    }
    let axis = (whole.high - whole.low).max_position();
    let middle = parts.len() / 2;
    let center = |part: &Part| part.low[axis] + part.high[axis];
    parts.select_nth_unstable_by(middle, |a, b| center(a).total_cmp(&center(b)));
    let (lower, upper) = parts.split_at_mut(middle);
    divide(lower, most, boxes);
    divide(upper, most, boxes);
}

fn add_box(scene: &mut Scene, part: &Part) {
    let corners = part.corners().map(|corner| add_vertex(scene, corner));
    part.points.into_iter().for_each(|point| {
        add_vertex(scene, point);
    });
    let contours = scene.contours.push_all([corners]);
    scene.wires.push(Wire { name: None, contours, color: None, body: part.body, text: None });
}

fn add_vertex(scene: &mut Scene, position: DVec3) -> VertexId {
    let name = scene.names.add("");
    scene.add_vertex(Vertex { name, position, color: None, normal: None, uv: None })
}

/// Boxes where they are seen in a picture.
#[derive(Clone, Debug)]
pub struct SeenBoxes {
    placed: PlacedBodies,
    /// Rest positions of the vertices, 10 of each box, as of [`PlacedBodies::rest_positions`].
    rest: Vec<DVec3>,
    /// Where they are seen, relative to the eye.
    seen: Vec<DVec3>,
    n_boxes: usize,
    camera_speed: f64,
    view: View,
}

impl SeenBoxes {
    /// Speed of the camera, or if it is at rest, the least and the greatest speed of moving bodies,
    /// relative to the camera.
    pub fn speeds(&self) -> [f64; 2] {
        if self.camera_speed > 0.0 {
            return [self.camera_speed; 2];
        }
        let speeds =
            self.followed().into_iter().map(|row| self.motion(row).velocity().beta().length());
        let [least, greatest] = speeds.fold([f64::INFINITY, 0.0], |[least, greatest], speed| {
            [least.min(speed), f64::max(greatest, speed)]
        });
        [least.min(greatest), greatest]
    }

    /// True only if nothing is in the picture.  (P27)
    pub fn are_out_of_view(&self) -> bool {
        self.are_out(0..self.n_boxes)
    }

    /// True only if bodies move, and none of those that do is in the picture. They move in the
    /// frame of the scene, or if none does, relative to the camera.
    pub fn are_moving_out_of_view(&self) -> bool {
        let followed = self.followed();
        let is_moving = followed.iter().any(|&row| !self.motion(row).is_at_rest());
        is_moving && self.are_out(followed.into_iter())
    }

    fn are_out(&self, mut rows: impl Iterator<Item = usize>) -> bool {
        let spaces: Vec<_> = self.view.half_spaces().into_iter().flatten().collect();
        rows.all(|row| {
            let corners = &self.rest[corners(row)];
            spaces.iter().any(|space| self.motion(row).is_outside(space, corners))
        })
    }

    /// The point in the middle of what is seen of moving bodies, or of all if none moves; `None` if
    /// they are all around the eye.
    ///
    /// Its direction is the mean of the directions to the corners of their boxes, so it changes as
    /// smoothly as these do. It is rounded to a hundredth of a pixel or less, so that it is short.
    pub fn center(&self) -> Option<DVec3> {
        let followed = self.followed();
        let corners = followed.iter().flat_map(|&row| &self.seen[corners(row)]);
        let (mut direction, mut distance, mut count) = (DVec3::ZERO, 0.0, 0.0);
        for corner in corners {
            direction += ugphysics::unit_or_zero(*corner);
            distance += ugphysics::length(*corner);
            count += 1.0;
        }
        let distance = distance / count;
        if direction.length() <= AROUND * count || !distance.is_finite() {
            return None;
        }
        let center = self.placed.eye + direction.normalize() * distance;
        Some(rounded(center, unit_of_rounding(distance) - 3))
            .filter(|center| *center != self.placed.eye)
    }

    fn motion(&self, row: usize) -> &RelativeMotion {
        &self.placed.motions[self.placed.bodies[N_ROWS * row].index()]
    }

    /// The boxes of bodies that move in the frame of the scene; if none does, of those that move
    /// relative to the camera; otherwise all.
    fn followed(&self) -> Vec<usize> {
        let rows = |is_it: &dyn Fn(&RelativeMotion) -> bool| {
            (0..self.n_boxes).filter(|&row| is_it(self.motion(row))).collect::<Vec<usize>>()
        };
        let moving = rows(&|motion| !motion.in_scene().is_zero());
        let relative =
            if moving.is_empty() { rows(&|motion| !motion.is_at_rest()) } else { moving };
        if relative.is_empty() { (0..self.n_boxes).collect() } else { relative }
    }

    /// Unit vectors to the middles of the followed boxes; zero for one at the eye.
    pub(crate) fn directions(&self) -> Vec<DVec3> {
        let middle = |row: usize| self.seen[corners(row)].iter().sum::<DVec3>();
        self.followed().into_iter().map(|row| ugphysics::unit_or_zero(middle(row))).collect()
    }

    /// Unit vector into the picture.
    pub(crate) fn forward(&self) -> DVec3 {
        self.view.forward
    }

    /// The time that the fastest body needs for the distance of the farthest corner or of the view
    /// centre; `None` if no body moves relative to the camera.
    pub(crate) fn time_scale(&self) -> Option<f64> {
        let speeds = (0..self.n_boxes).map(|row| self.motion(row).velocity().beta().length());
        let speed = speeds.fold(0.0, f64::max);
        let distance =
            self.seen.iter().map(|&corner| ugphysics::length(corner)).fold(0.0, f64::max);
        (speed > 0.0).then(|| distance.max(self.view.distance) / speed)
    }

    /// True only if a vertex of a followed body is in the picture, and not so near its edge that
    /// nothing else of the body is.
    pub(crate) fn is_vertex_in_view(&self) -> bool {
        /// Part of the view angle at its edges.
        const MARGIN: f64 = 0.05;
        let spaces: Vec<_> = self.view.half_spaces().into_iter().flatten().collect();
        let is_inside = |at: usize| {
            let place = self.seen[at];
            let margin =
                |space: &HalfSpace| MARGIN * space.normal.dot(self.view.forward) * place.length();
            spaces.iter().all(|space| place.dot(space.normal) + space.offset > margin(space))
        };
        let sends_light = |row: usize, at: usize| self.motion(row).light(self.rest[at]).is_ok();
        // Faster, 1 is the nearest number to a speed, and scenes as seen cannot state it.
        let is_below_1 = |row: &usize| self.motion(*row).velocity().beta().length() < 1.0;
        self.followed().into_iter().filter(is_below_1).any(|row| {
            (corners(row).end..N_ROWS * (row + 1)).any(|at| is_inside(at) && sends_light(row, at))
        })
    }
}
