//! Two eyes, one world: where bodies and lamps are follows from the text, by 4×4 matrices, whoever
//! looks.

use std::collections::HashMap;
use std::fmt::Write as _;

use glam::{DMat3, DVec3};
use ugparse::{Options, Source};
use ugphysics::Event as Seen;
use ugscene::{CameraOptions, LightKind, MotionOptions, PlacedBodies, RestPosition};
use ugtesting::Random;

use super::Outcome;
use super::spacetime::{Event, boost};

/// Relative to the size of the world, with γ up to 10 in each of three frames.
const TOLERANCE: f64 = 1e-9;

/// A frame in the one before it, whose point `at` is where the text has it at time 0.
#[derive(Clone, Copy, Debug)]
struct Frame {
    beta: DVec3,
    at: DVec3,
}

/// A vertex or lamp, and its world line.
struct Point {
    name: String,
    /// From the outermost.
    frames: Vec<Frame>,
    path: Path,
}

/// A world line in the innermost frame.
enum Path {
    Rests(DVec3),
    Orbits { at: DVec3, center: DVec3, rate: f64 },
    Accelerates { at: DVec3, by: DVec3 },
}

impl Path {
    fn place(&self, time: f64) -> DVec3 {
        match *self {
            Self::Rests(place) => place,
            Self::Orbits { at, center, rate } => {
                center + DMat3::from_rotation_z(rate * time) * (at - center)
            }
            Self::Accelerates { at, by } if time > 0.0 => {
                let passed = by.length() * time;
                at + by.normalize() * (((1.0 + passed * passed).sqrt() - 1.0) / by.length())
            }
            Self::Accelerates { at, .. } => at,
        }
    }
}

impl Point {
    /// How far an event in the frame of the scene is from the world line, in the innermost frame.
    fn error(&self, event: Event) -> f64 {
        let inside = |event: Event, frame: &Frame| {
            boost(-frame.beta) * (event - frame.at.extend(0.0)) + frame.at.extend(0.0)
        };
        let event = self.frames.iter().fold(event, inside);
        (event.truncate() - self.path.place(event.w)).length()
    }
}

/// Rotation and translation of an instance.
struct Placing {
    turn: DMat3,
    shift: DVec3,
    words: String,
}

impl Placing {
    fn random(random: &mut Random) -> Self {
        let (degrees, shift) = (random.between(-180.0, 180.0), random.in_cube(5.0));
        let words = format!("-rz {degrees} -ta {}", numbers(shift));
        Self { turn: DMat3::from_rotation_z(degrees.to_radians()), shift, words }
    }

    fn place(&self, place: DVec3) -> DVec3 {
        self.turn * place + self.shift
    }
}

fn numbers(vector: DVec3) -> String {
    format!("{} {} {}", vector.x, vector.y, vector.z)
}

/// Adds a body or lamp to the scene.
fn add(random: &mut Random, row: usize, text: &mut String, points: &mut Vec<Point>) {
    let mut beta = || random.in_ball(0.9);
    let [u, v, w] = [beta(), beta(), beta()];
    let [a, b, c] = [random.in_cube(5.0), random.in_cube(5.0), random.in_cube(5.0)];
    let triangle = format!("v a {}; v b {}; v c {};", numbers(a), numbers(b), numbers(c));
    let (inner, outer) = (Placing::random(random), Placing::random(random));
    let rest = |name: String, place: DVec3, frames: &[Frame]| Point {
        name,
        frames: frames.to_vec(),
        path: Path::Rests(place),
    };
    let mut corners = |prefix: &str, place: &dyn Fn(DVec3) -> DVec3, frames: &[Frame]| {
        for (name, corner) in [("a", a), ("b", b), ("c", c)] {
            points.push(rest(format!("{prefix}{name}"), place(corner), frames));
        }
    };
    match random.below(6) {
        0 => {
            let named = triangle.replace("v ", &format!("v t{row}"));
            let _ = writeln!(text, "{named} f (t{row}a t{row}b t{row}c) <{}>;", numbers(u));
            corners(&format!("t{row}"), &|place| place, &[Frame { beta: u, at: DVec3::ZERO }]);
        }
        1 => {
            let (u, own) = (numbers(u), numbers(v));
            let _ = writeln!(text, "def d{row}; {triangle} f (a b c) <{own}>; end;");
            let _ = writeln!(text, "i n{row} (d{row} {}) <{u}>;", outer.words);
            let at = outer.shift;
            let frames = [Frame { beta: parse(&u), at }, Frame { beta: outer.turn * v, at }];
            corners(&format!("n{row}:"), &|place| outer.place(place), &frames);
        }
        2 => {
            let of = |beta| numbers(beta);
            let lamp = format!("l lamp 1 {} 0 <{}>;", numbers(b), of(w));
            let _ = writeln!(text, "def d{row}; {triangle} f (a b c) <{}>; {lamp} end;", of(w));
            let _ = writeln!(text, "def e{row}; i n (d{row} {}) <{}>; end;", inner.words, of(v));
            let _ = writeln!(text, "i o{row} (e{row} {}) <{}>;", outer.words, of(u));
            let at = outer.place(inner.shift);
            let mut frames = [
                Frame { beta: u, at: outer.shift },
                Frame { beta: outer.turn * v, at },
                Frame { beta: outer.turn * inner.turn * w, at },
            ];
            let place = |place| outer.place(inner.place(place));
            corners(&format!("o{row}:n:"), &place, &frames);
            frames[2].at = place(b);
            points.push(rest(format!("o{row}:n:lamp"), place(b), &frames));
        }
        3 => {
            let _ = writeln!(text, "l s{row} 1 {} 0 <{}>;", numbers(a), numbers(u));
            points.push(rest(format!("s{row}"), a, &[Frame { beta: u, at: a }]));
        }
        kind => {
            let _ = writeln!(text, "motion m{row} -at {} -vel {};", numbers(a), numbers(u));
            let frames = [Frame { beta: u, at: a }];
            let (by, center) = (v, b + random.in_cube(1.0));
            let rate = 0.5 / (b - center).length();
            let (option, path) = if kind == 4 {
                let option = format!("-orbit {} 0 0 1 {rate}", numbers(center));
                (option, Path::Orbits { at: b, center, rate })
            } else {
                (format!("-acc {}", numbers(by)), Path::Accelerates { at: b, by })
            };
            let _ = writeln!(text, "motion p{row} -on m{row} -at {} {option};", numbers(b));
            // Small, so that it can move so.
            let [x, y] = [b + 1e-3 * DVec3::X, b + 1e-3 * DVec3::Y].map(numbers);
            let _ = writeln!(text, "v p{row} {}; v x{row} {x}; v y{row} {y};", numbers(b));
            let _ = writeln!(text, "f (p{row} x{row} y{row}) <p{row}>;");
            points.push(Point { name: format!("p{row}"), frames: frames.to_vec(), path });
        }
    }
}

fn parse(text: &str) -> DVec3 {
    let numbers: Vec<f64> =
        text.split(' ').map(|number| number.parse().expect("written above")).collect();
    DVec3::from_slice(&numbers)
}

/// Vertices and lamps are on the world lines that the text states, for two eyes.
pub fn two_eyes(random: &mut Random) -> Outcome {
    let (mut text, mut points) = (String::new(), Vec::new());
    for row in 0..2 + random.below(4) {
        add(random, row, &mut text, &mut points);
    }
    let mut worst: f64 = 0.0;
    for _ in 0..2 {
        let (eye, time, velocity) =
            (random.in_cube(9.0), random.between(-9.0, 9.0), random.in_ball(0.9));
        let events = events(&text, (eye, time, velocity))?;
        for point in &points {
            let event =
                *events.get(&point.name).ok_or_else(|| format!("no {} in\n{text}", point.name))?;
            let error = point.error(event) / (1.0 + event.length());
            if error.is_nan() || error > TOLERANCE {
                let of = format!("seen from {eye} at {time} with {velocity}");
                return Err(format!(
                    "{} is {error:e} off its world line, {of}\n{text}",
                    point.name
                ));
            }
            worst = worst.max(error);
        }
    }
    Ok(points.len())
}

/// The events, in the frame of the scene, at which light left the vertices, and events of lamps.
fn events(
    text: &str,
    (eye, time, velocity): (DVec3, f64, DVec3),
) -> Result<HashMap<String, Event>, String> {
    let source = Source::new("world.ug", text);
    let mut scene = ugparse::read(&source, &Options::default(), None)
        .map_err(|found| found.worded().render(false))?
        .scene;
    let options =
        MotionOptions { time, camera_velocity: Some(velocity), ..MotionOptions::default() };
    let camera = CameraOptions { eye: Some(eye), ..CameraOptions::default() };
    let placed = PlacedBodies::move_to_camera_frame(&mut scene, &options, &camera, [4, 3])
        .map_err(|error| error.to_string())?;
    let in_scene =
        |event: Event| boost(velocity) * (event + DVec3::ZERO.extend(time)) + eye.extend(0.0);
    let mut events = HashMap::new();
    for ((vertex, rest), body) in
        scene.vertices.iter().zip(placed.rest_positions(&scene)).zip(&placed.bodies)
    {
        let motion = &placed.motions[body.index()];
        let here = Seen { t: 0.0, x: DVec3::ZERO };
        let seen = match motion.world_line() {
            Some(line) => {
                line.emission(rest, here).map_err(|error| format!("{error}\n{text}"))?.event.x
            }
            None => motion.seen(RestPosition(rest)).0,
        };
        events
            .insert(scene.names.get(vertex.name).to_owned(), in_scene(seen.extend(-seen.length())));
    }
    for light in &scene.lights {
        let (LightKind::Local { position, .. }, Some(body)) = (light.kind, light.motion.body())
        else {
            continue;
        };
        let motion = &placed.motions[body.index()];
        let event = boost(motion.velocity().beta()) * motion.turned(position - eye).extend(0.7);
        let name = light.name.map_or("", |name| scene.names.get(name));
        events.insert(name.to_owned(), in_scene(event));
    }
    Ok(events)
}
