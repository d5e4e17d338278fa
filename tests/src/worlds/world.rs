//! A world: bodies, lamps and a camera in spacetime, and its scene text.

use std::fmt::Write as _;

use glam::{DMat3, DVec2, DVec3, EulerRot};
use ugscene::{Anchor, MotionOptions};

use super::spacetime::{Change, Event, boost, rest_place};
use crate::world_lines::{Path, Statement};

/// Bodies, lamps and a camera. All rest frames have the same origin: the event at place and time 0.
#[derive(Clone, Debug)]
pub struct World {
    /// The bodies.
    pub bodies: Vec<Body>,
    /// The lamps.
    pub lamps: Vec<Lamp>,
    /// The camera.
    pub camera: Camera,
    /// Where the text has the common origin, in scene coordinates (`-an`).
    pub anchor: DVec3,
    /// The turn of the day's sky, if there is one.
    pub sky: Option<DMat3>,
}

/// A body of one colour and one surface.
#[derive(Clone, Debug)]
pub struct Body {
    /// At rest.
    pub vertices: Vec<DVec3>,
    /// Rows of `vertices`, counterclockwise seen from outside.
    pub faces: Vec<Vec<usize>>,
    /// One round face of this statement, whose groups of vertices are `faces`.
    pub round: Option<&'static str>,
    /// Display-encoded red, green and blue, and translucency.
    pub paint: [f64; 4],
    /// Texture coordinates; none or one for each vertex.
    pub coordinates: Vec<DVec2>,
    /// A measured surface of this name instead of `paint`.
    pub measured: Option<&'static str>,
    /// Colours of vertices, in the same form; none or one for each.
    pub vertex_paints: Vec<[f64; 4]>,
    /// Its surface, or its own light.
    pub surface: Surface,
    /// `None`: it rests in the scene.
    pub velocity: Option<DVec3>,
    /// Instead of a velocity. Vertices are where they are at own time 0.
    pub motion: Option<Statement>,
}

/// The reflection of light by faces.
#[derive(Clone, Copy, Debug)]
pub enum Surface {
    /// They scatter all of it.
    Matt,
    /// They emit light of this level.
    Level(f64),
    /// kd, ks, kt, n, exponent and absorption of `surf`.
    Reflecting([f64; 6]),
}

/// A light.
#[derive(Clone, Debug)]
pub struct Lamp {
    /// 1 lights a white surface fully.
    pub intensity: f64,
    /// Where it is, in its rest frame.
    pub place: LampPlace,
    /// Where a lamp at a point shines; everywhere if `None`.
    pub beam: Option<Beam>,
    /// Display-encoded red, green and blue; white if `None`.
    pub paint: Option<[f64; 3]>,
    /// `None`: it rests with whatever it lights.
    pub velocity: Option<DVec3>,
    /// Instead of a velocity. Its place is where it is at own time 0.
    pub motion: Option<Statement>,
}

/// Where a light is, in its rest frame.
#[derive(Clone, Copy, Debug)]
pub enum LampPlace {
    /// Everywhere.
    Ambient,
    /// Infinitely far away in a direction.
    Afar(DVec3),
    /// At a point.
    At(DVec3),
}

/// The beam of a lamp, in its rest frame.
#[derive(Clone, Copy, Debug)]
pub enum Beam {
    /// A cone about an axis.
    Spot {
        /// Of any length.
        axis: DVec3,
        /// Half the angle of the cone, degrees.
        angle: f64,
        /// The soft part of it, degrees.
        edge: f64,
    },
    /// A parallelogram.
    Area {
        /// Its sides.
        edges: [DVec3; 2],
        /// The distance at which its light is the intensity.
        reference: f64,
    },
}

impl Beam {
    fn placed(self, turn: DMat3, unit: f64) -> Self {
        match self {
            Self::Spot { axis, angle, edge } => Self::Spot { axis: turn * axis, angle, edge },
            Self::Area { edges, reference } => {
                let [u, v] = edges.map(|edge| unit * (turn * edge));
                let edges = if turn.determinant() < 0.0 { [v, u] } else { [u, v] };
                Self::Area { edges, reference: unit * reference }
            }
        }
    }

    /// How far it reaches around the place of the lamp.
    pub fn reach(self) -> f64 {
        match self {
            Self::Spot { .. } => 0.0,
            Self::Area { edges: [u, v], .. } => u.length() + v.length(),
        }
    }
}

/// A camera that takes a picture at an event.
#[derive(Clone, Copy, Debug)]
pub struct Camera {
    /// Place and time of the picture in the frame of the scene.
    pub event: Event,
    /// In the frame of the scene.
    pub velocity: DVec3,
    /// View direction in the frame of the camera, a unit vector.
    pub forward: DVec3,
    /// Up, in the frame of the camera, a unit vector perpendicular to `forward`.
    pub up: DVec3,
    /// The view angle across, degrees.
    pub angle: f64,
}

impl Camera {
    /// To the right in the picture.
    pub fn right(&self) -> DVec3 {
        self.forward.cross(self.up)
    }

    /// Displaced in its own frame in space and time.
    #[must_use]
    pub fn displaced(&self, place: DVec3, time: f64) -> Self {
        Self { event: self.event + boost(self.velocity) * place.extend(time), ..*self }
    }

    /// Turned so that it looks in a direction.
    #[must_use]
    pub fn looking(&self, direction: DVec3) -> Self {
        let forward = direction.normalize();
        let aside = if forward.dot(self.up).abs() < 0.9 { self.up } else { self.right() };
        Self { forward, up: (aside - forward * aside.dot(forward)).normalize(), ..*self }
    }

    /// The direction seen in the middle of a pixel of a pinhole picture, of depth 1.
    pub fn direction(&self, [column, row]: [u32; 2], [width, height]: [u32; 2]) -> DVec3 {
        let half = libm::tan(0.5 * self.angle.to_radians());
        let across = half * (2.0 * (f64::from(column) + 0.5) / f64::from(width) - 1.0);
        let down = half * (2.0 * (f64::from(row) + 0.5) - f64::from(height)) / f64::from(width);
        self.forward + across * self.right() - down * self.up
    }
}

impl World {
    /// The same world in another frame. Lights that rest with what they light are left out of it,
    /// except ambient light; of motions only those with a velocity, and their own
    /// time has to stay.
    #[must_use]
    pub fn changed(&self, change: &Change) -> Self {
        assert_eq!(self.sky, None, "a sky rests in the scene");
        let mut world = self.clone();
        for body in &mut world.bodies {
            if let Some(motion) = &mut body.motion {
                let turn = boosted(motion, change);
                body.vertices.iter_mut().for_each(|place| *place = turn * *place);
                continue;
            }
            let (velocity, rest) = change.of_frame(body.velocity.unwrap_or_default());
            body.velocity =
                (body.velocity.is_some() || velocity != DVec3::ZERO).then_some(velocity);
            body.vertices.iter_mut().for_each(|place| *place = rest.place(*place));
        }
        for lamp in &mut world.lamps {
            if let (Some(motion), LampPlace::At(place)) = (&mut lamp.motion, &mut lamp.place) {
                let turn = boosted(motion, change);
                *place = turn * *place;
                lamp.beam = lamp.beam.map(|beam| beam.placed(turn, 1.0));
                continue;
            }
            let Some(velocity) = &mut lamp.velocity else { continue };
            let (moved, rest) = change.of_frame(*velocity);
            *velocity = moved;
            lamp.beam = lamp.beam.map(|beam| beam.placed(rest.turn, 1.0));
            lamp.place = match lamp.place {
                LampPlace::Ambient => LampPlace::Ambient,
                LampPlace::Afar(toward) => LampPlace::Afar(rest.turn * toward),
                LampPlace::At(place) => LampPlace::At(rest.place(place)),
            };
        }
        let camera = &mut world.camera;
        let (velocity, rest) = change.of_frame(camera.velocity);
        camera.event = change.linear * camera.event + change.shift;
        (camera.velocity, camera.forward, camera.up) =
            (velocity, rest.turn * camera.forward, rest.turn * camera.up);
        world
    }

    /// The same world turned or mirrored, in another unit of length, and written elsewhere.
    #[must_use]
    pub fn placed(&self, turn: DMat3, unit: f64, anchor: DVec3) -> Self {
        let mut world = self.clone();
        let place = |place: &mut DVec3| *place = unit * (turn * *place);
        for body in &mut world.bodies {
            body.vertices.iter_mut().for_each(place);
            body.velocity = body.velocity.map(|velocity| turn * velocity);
            body.motion = body.motion.as_ref().map(|motion| motion.placed(turn, unit));
            if let Surface::Reflecting([.., absorption]) = &mut body.surface {
                *absorption /= unit;
            }
            if turn.determinant() < 0.0 {
                body.faces.iter_mut().for_each(|face| face.reverse());
            }
        }
        for lamp in &mut world.lamps {
            lamp.velocity = lamp.velocity.map(|velocity| turn * velocity);
            lamp.motion = lamp.motion.as_ref().map(|motion| motion.placed(turn, unit));
            lamp.beam = lamp.beam.map(|beam| beam.placed(turn, unit));
            match &mut lamp.place {
                LampPlace::Ambient => {}
                LampPlace::Afar(toward) => *toward = turn * *toward,
                LampPlace::At(at) => place(at),
            }
        }
        let Camera { event, velocity, forward, up, .. } = &mut world.camera;
        *event = (unit * (turn * event.truncate())).extend(unit * event.w);
        for vector in [velocity, forward, up] {
            *vector = turn * *vector;
        }
        world.anchor = anchor;
        world.sky = world.sky.map(|sky| turn * sky);
        world
    }

    /// The motion options that draw it: the time of the picture on the camera's clock, and the
    /// common origin.
    pub fn motion(&self) -> MotionOptions {
        let Camera { event, velocity, .. } = self.camera;
        let time = event.w * (1.0 - velocity.length_squared()).sqrt();
        MotionOptions { time, anchor: Some(Anchor::Point(self.anchor)), ..MotionOptions::default() }
    }

    /// Its scene.
    pub fn text(&self) -> String {
        self.statements().concat()
    }

    /// Its scene, statement by statement. Their order does not matter.
    pub fn statements(&self) -> Vec<String> {
        let mut all = Vec::new();
        for (row, body) in self.bodies.iter().enumerate() {
            all.extend(body.motion.iter().map(|motion| motion.text(&format!("b{row}"))));
            body.write(row, self.anchor, &mut all);
        }
        for (row, lamp) in self.lamps.iter().enumerate() {
            all.extend(lamp.motion.iter().map(|motion| motion.text(&format!("l{row}"))));
        }
        all.extend(
            self.lamps.iter().enumerate().map(|(row, lamp)| lamp.statements(row, self.anchor)),
        );
        all.push(self.camera.statement(self.anchor));
        all.extend(self.sky.map(|turn| {
            let (z, y, x) = turn.to_euler(EulerRot::ZYX);
            format!("sky day -ra {} {} {};\n", x.to_degrees(), y.to_degrees(), z.to_degrees())
        }));
        all
    }
}

impl Body {
    /// How many faces its scene has.
    pub fn n_faces(&self) -> u32 {
        if self.round.is_some() { 1 } else { self.faces.len() as u32 }
    }

    /// True if something that goes straight from one event to another meets a face.
    pub fn is_crossed(&self, way: [Event; 2]) -> bool {
        let [from, to] = way.map(|event| rest_place(event, self.velocity.unwrap_or_default()));
        let volume = |a: DVec3, b: DVec3, c: DVec3| (a - from).dot((b - from).cross(c - from));
        self.faces
            .iter()
            .flat_map(|face| face.windows(2).map(|pair| [face[0], pair[0], pair[1]]))
            .any(|rows| {
                let [a, b, c] = rows.map(|row| self.vertices[row]);
                let normal = (b - a).cross(c - a);
                let sides = [volume(a, b, to), volume(b, c, to), volume(c, a, to)];
                let is_through =
                    sides.iter().all(|side| *side > 0.0) || sides.iter().all(|side| *side < 0.0);
                is_through && normal.dot(from - a) * normal.dot(to - a) < 0.0
            })
    }

    fn write(&self, row: usize, anchor: DVec3, all: &mut Vec<String>) {
        all.push(match self.measured {
            Some(name) => format!("c_refl c{row} {name};\n"),
            None => paint(&format!("c{row}"), &self.paint),
        });
        if !self.coordinates.is_empty() {
            all.push(format!("c_tex c{row} texture.png -wrap mirror;\n"));
        }
        for (corner, place) in self.vertices.iter().enumerate() {
            let own = self.vertex_paints.get(corner).map(|own| {
                all.push(paint(&format!("c{row}_{corner}"), own));
                format!(" c{row}_{corner}")
            });
            let [x, y, z] = (*place + anchor).to_array();
            let at = self.coordinates.get(corner).map(|at| format!(" ({} {})", at.x, at.y));
            let [own, at] = [own, at].map(Option::unwrap_or_default);
            all.push(format!("v b{row}_{corner} {x} {y} {z}{own}{at};\n"));
        }
        let surface = match self.surface {
            Surface::Matt => String::new(),
            Surface::Level(level) => format!(" {level}"),
            Surface::Reflecting(numbers) => {
                let numbers = numbers.map(|number| number.to_string()).join(" ");
                all.push(format!("surf s{row} {numbers};\n"));
                format!(" s{row}")
            }
        };
        let moving = match &self.motion {
            Some(_) => format!(" <b{row}>"),
            None => velocity(self.velocity),
        };
        let corners = |face: &Vec<usize>| {
            let corners: Vec<String> =
                face.iter().map(|corner| format!("b{row}_{corner}")).collect();
            format!("({})", corners.join(" "))
        };
        let contours: Vec<String> = self.faces.iter().map(corners).collect();
        let whole = contours.join(" ");
        let (word, faces) = match self.round {
            Some(word) => (word, std::slice::from_ref(&whole)),
            None => ("f", &contours[..]),
        };
        all.extend(faces.iter().map(|face| format!("{word} {face} c{row}{surface}{moving};\n")));
    }

    /// Its scene as an instance, with the transformation `words`, of a definition with other
    /// places.
    pub fn as_instance(&self, row: usize, words: &str, of: &Self) -> String {
        let mut inner = Vec::new();
        Self { velocity: None, ..of.clone() }.write(row, DVec3::ZERO, &mut inner);
        // What `<x y z>` on its faces is about.
        let velocity = velocity(self.velocity).replace('>', " -at 0 0 0>");
        format!("def d{row};\n{}end;\ni (d{row} {words}){velocity};\n", inner.concat())
    }
}

impl Lamp {
    fn statements(&self, row: usize, anchor: DVec3) -> String {
        let mut text = String::new();
        if let Some([red, green, blue]) = self.paint {
            text += &format!("c_rgb l{row} {red} {green} {blue};\n");
        }
        let _ = write!(text, "l lamp{row} {}", self.intensity);
        match self.place {
            LampPlace::Ambient => {}
            LampPlace::Afar(toward) => text += &format!(" {} {} {}", toward.x, toward.y, toward.z),
            LampPlace::At(place) => {
                let [x, y, z] = (place + anchor).to_array();
                text += &format!(" {x} {y} {z} 0");
            }
        }
        if let Some(Beam::Area { reference, .. }) = self.beam {
            let _ = write!(text, " {reference}");
        }
        if self.paint.is_some() {
            let _ = write!(text, " l{row}");
        }
        match self.beam {
            Some(Beam::Spot { axis: DVec3 { x, y, z }, angle, edge }) => {
                let _ = write!(text, " -spot {x} {y} {z} {angle} {edge}");
            }
            Some(Beam::Area { edges: [u, v], .. }) => {
                let _ = write!(text, " -area {} {} {} {} {} {}", u.x, u.y, u.z, v.x, v.y, v.z);
            }
            None => {}
        }
        text + &self
            .motion
            .as_ref()
            .map_or_else(|| velocity(self.velocity), |_| format!(" <l{row}>"))
            + ";\n"
    }
}

impl Camera {
    fn statement(&self, anchor: DVec3) -> String {
        let eye = self.event.truncate() - self.velocity * self.event.w + anchor;
        let numbers = |vector: DVec3| format!("{} {} {}", vector.x, vector.y, vector.z);
        // The view centre is far enough away that its digits tell the direction.
        // Not farther than the world is large: what is within 10⁻⁶ of that distance is not drawn.
        let distance = if eye.length() > 0.0 { eye.length() } else { 1.0 };
        let center = eye + distance * self.forward;
        let moving = velocity((self.velocity != DVec3::ZERO).then_some(self.velocity));
        let [eye, center, up] = [eye, center, self.up].map(numbers);
        format!("cam -ep {eye} -vc {center} -ud {up} -va {}{moving};\n", self.angle)
    }
}

/// Changes the frame of a motion; returns the turn of the coordinates of its body.
fn boosted(motion: &mut Statement, change: &Change) -> DMat3 {
    assert_eq!(change.shift, Event::ZERO, "own times stay");
    let Path::Free { velocity, .. } = motion.path else {
        panic!("a motion of the frame of the scene")
    };
    let (velocity, rest) = change.of_frame(velocity);
    *motion = motion.boosted(velocity, rest.turn);
    rest.turn
}

fn paint(name: &str, [red, green, blue, translucency]: &[f64; 4]) -> String {
    format!("c_rgb {name} {red} {green} {blue} {translucency};\n")
}

fn velocity(velocity: Option<DVec3>) -> String {
    velocity.map_or(String::new(), |beta| format!(" <{} {} {}>", beta.x, beta.y, beta.z))
}
