//! A flight that is steered in steps, and the motion that states it in a scene.

use std::fmt::Write;

use glam::{DQuat, DVec3};
use serde_json::{Value, json};
use ugphysics::{
    Event, HyperbolicMotion, InertialFrame, Lorentz, Piece, Pose, Velocity, WorldLine,
};
use wasm_bindgen::prelude::wasm_bindgen;

/// Greatest rapidity in the frame of the scene: γ is about 4000 there.
const MOST_RAPIDITY: f64 = 9.0;

/// Decimals of own times, accelerations and spins: few, so that a flight is a short text. What is
/// stated is what is flown, so nothing is lost by it.
const DECIMALS: f64 = 1e6;

/// Difference of two vectors, as a part of their length, that counts as rounding.
const ROUNDING: f64 = 2e-6;

/// A camera on a world line of pieces with constant proper acceleration and constant spin, as
/// `-acc` and `-spin` of a `motion` state them: (P40), in axes that are carried without turning.
#[wasm_bindgen]
pub struct Flight {
    begin: Event,
    velocity: Velocity,
    /// Forward, right and up at own time 0, in the carried axes.
    axes: [DVec3; 3],
    accelerations: Vec<Piece>,
    spins: Vec<Piece>,
    /// Own time so far, and the pose at it.
    end: f64,
    pose: Pose,
    /// The whole flight, for poses at earlier own times.
    line: Option<WorldLine>,
}

fn vector(value: &Value) -> Option<DVec3> {
    let number = |row: usize| value.get(row)?.as_f64();
    Some(DVec3::new(number(0)?, number(1)?, number(2)?))
}

fn rounded(number: f64) -> f64 {
    (number * DECIMALS).round() / DECIMALS
}

/// Rotation by a vector: its direction is the axis, its length the angle.
fn rotation(turn: DVec3) -> DQuat {
    InertialFrame { turn, ..InertialFrame::REST }.rotation()
}

/// Adds a stretch with this value to pieces, as part of the last one if that has the same value.
/// Returns the value that it has there.
fn push(pieces: &mut Vec<Piece>, of: DVec3, [from, to]: [f64; 2]) -> DVec3 {
    let of = of.to_array().map(rounded).into();
    if of == DVec3::ZERO {
        return of;
    }
    match pieces.last_mut() {
        Some(last) if last.to == from && (last.of - of).length() <= ROUNDING * of.length() => {
            last.to = to;
            last.of
        }
        _ => {
            pieces.push(Piece { of, from, to });
            of
        }
    }
}

/// The pose after some own time with constant acceleration, in the carried axes.
fn accelerated(pose: Pose, acceleration: DVec3, passed: f64) -> Option<Pose> {
    let motion = HyperbolicMotion { acceleration };
    let boost = Lorentz::boost(motion.velocity(passed).ok()?);
    Some(Pose {
        event: pose.event + pose.scene_from_axes.apply(motion.event(passed)),
        scene_from_axes: pose.scene_from_axes * boost,
        turn: pose.turn,
    })
}

fn words(vector: DVec3) -> String {
    // Without the sign of a zero.
    let vector = vector + DVec3::ZERO;
    format!("{} {} {}", vector.x, vector.y, vector.z)
}

#[wasm_bindgen]
impl Flight {
    /// A flight that begins where and as a camera is. `start`: JSON with its `event` (t, x, y, z)
    /// and `velocity` in the frame of the scene, and the directions `view` and `up` in its own.
    ///
    /// # Errors
    /// Numbers are missing, or the velocity is not below that of light.
    #[wasm_bindgen(constructor)]
    pub fn new(start: &str) -> Result<Self, String> {
        let start: Value = serde_json::from_str(start).map_err(|error| error.to_string())?;
        let get = |name: &str| vector(&start[name]).ok_or_else(|| format!("`{name}` is missing"));
        let x = start["event"].as_array().and_then(|event| vector(&json!(event.get(1..)?)));
        let t = start["event"][0].as_f64();
        let begin = Event { t: t.unwrap_or_default(), x: x.ok_or("`event` is missing")? };
        let velocity = Velocity::from_beta(get("velocity")?).map_err(|error| error.to_string())?;
        let forward = ugphysics::unit_or_zero(get("view")?);
        let across = |up: DVec3| ugphysics::unit_or_zero(forward.cross(up));
        let right = [get("up")?, DVec3::Z, DVec3::Y].map(across);
        let right = right.into_iter().find(|right| right.length() > 0.5).unwrap_or(DVec3::X);
        let pose =
            Pose { event: begin, scene_from_axes: Lorentz::boost(velocity), turn: DQuat::IDENTITY };
        Ok(Self {
            begin,
            velocity,
            axes: [forward, right, right.cross(forward)],
            accelerations: Vec::new(),
            spins: Vec::new(),
            end: 0.0,
            pose,
            line: None,
        })
    }

    /// Flies on for some own time. `thrust`: proper acceleration forward, to the right and up.
    /// `turn`: angular velocity about the same axes of the camera, radians per unit of own time.
    /// Thrust that would exceed a Lorentz factor of 4000 has no effect.
    pub fn step(&mut self, own_time: f64, thrust: &[f64], turn: &[f64]) {
        let [begin, end] = [self.end, rounded(self.end + own_time)];
        let (&[forward, right, up], &[roll, pitch, yaw]) = (thrust, turn) else { return };
        let is_finite = thrust.iter().chain(turn).all(|number| number.is_finite());
        let is_later = end > begin;
        if !is_finite || !is_later {
            return;
        }
        let passed = end - begin;
        let along = |turn: DQuat, parts: [f64; 3]| -> DVec3 {
            self.axes.iter().zip(parts).map(|(&axis, part)| turn * axis * part).sum()
        };
        let before = self.pose.turn;
        let spin = along(before, [roll, pitch, yaw]);
        // The thrust of the middle of the step.
        let middle = rotation(spin * (0.5 * passed)) * before;
        let thrust = along(middle, [forward, right, up]);
        let spin = push(&mut self.spins, spin, [begin, end]);
        let rapidity = |pose: &Pose| {
            pose.scene_from_axes.velocity_of_frame().map_or(f64::INFINITY, Velocity::rapidity)
        };
        let faster = accelerated(self.pose, thrust, passed);
        let most = MOST_RAPIDITY.max(rapidity(&self.pose));
        let is_allowed = faster.is_some_and(|pose| rapidity(&pose) <= most);
        let thrust = if is_allowed { thrust } else { DVec3::ZERO };
        let thrust = push(&mut self.accelerations, thrust, [begin, end]);
        if let Some(pose) = accelerated(self.pose, thrust, passed) {
            self.pose = pose;
        }
        self.pose.turn = rotation(spin * passed) * before;
        (self.end, self.line) = (end, None);
    }

    /// Own time so far.
    #[wasm_bindgen(getter)]
    pub fn end(&self) -> f64 {
        self.end
    }

    /// The camera at an own time, as JSON: its `event` and `velocity` in the frame of the scene,
    /// `gamma`, and the directions `view` and `up` in the axes of a single boost, as `-cv`, `-vc`
    /// and `-ud` have them; and `thrust`, how fast it is along its own axes as seen from it.
    ///
    /// # Errors
    /// The flight has no such time.
    pub fn at(&mut self, own_time: f64) -> Result<String, String> {
        let pose = if own_time == self.end { self.pose } else { self.whole()?.pose(own_time) };
        let velocity = pose.scene_from_axes.velocity_of_frame().map_err(|e| e.to_string())?;
        let in_boost = Lorentz::boost(velocity).inverse() * pose.scene_from_axes;
        let [view, _, up] = self.axes.map(|axis| (in_boost.turn() * pose.turn * axis).to_array());
        // The scene runs backwards along the velocity that the camera has in its own axes.
        let scene = pose.scene_from_axes.inverse().apply(Event { t: 1.0, x: DVec3::ZERO });
        let course = self.axes.map(|axis| -scene.x.dot(pose.turn * axis));
        let Event { t, x } = pose.event;
        Ok(json!({
            "event": [t, x.x, x.y, x.z],
            "velocity": velocity.beta().to_array(),
            "gamma": velocity.gamma(),
            "view": view,
            "up": up,
            "course": course,
        })
        .to_string())
    }

    /// The statements of a motion with this name, and of a camera that rides on it with a view
    /// angle in degrees, for a scene.
    pub fn statements(&self, name: &str, angle: Option<f64>) -> String {
        let Event { t, x } = self.begin;
        let mut text =
            format!("motion {name} -at {} -vel {}", words(x), words(self.velocity.beta()));
        for (option, pieces) in [("acc", &self.accelerations), ("spin", &self.spins)] {
            for Piece { of, from, to } in pieces {
                // Writing to a text never fails.
                let _ = write!(text, "\n  -{option} {} {from} {to}", words(*of));
            }
        }
        let [view, _, up] = self.axes;
        let angle = angle.map_or_else(String::new, |angle| format!(" -va {angle}"));
        let center = words(x + view);
        let up = words(up);
        text + &format!(
            "\n  -shift {t} 0 0 0 ;\ncam -ep {} -vc {center} -ud {up}{angle} <{name}> ;\n",
            words(x)
        )
    }
}

impl Flight {
    fn whole(&mut self) -> Result<&WorldLine, String> {
        if self.line.is_none() {
            let Event { t, x } = self.begin;
            let line = WorldLine::accelerated(x, self.velocity, &self.accelerations, &self.spins);
            let line = line.map_err(|error| error.to_string())?;
            self.line = Some(line.displaced(Event { t, x: DVec3::ZERO }));
        }
        self.line.as_ref().ok_or_else(|| "there is no flight".to_owned())
    }
}
