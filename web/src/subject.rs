//! The input of a pipe.

use std::ffi::OsString;

use glam::DVec3;
use serde_json::{Value, json};
use ugfilm::{FilmSubject, Pipe, Program, SceneSky, SkySource};
use ugparse::pipe;
use ugphysics::{Event, Lorentz, Velocity};
use ugpipe::{Context, Failure, Input, Words, parse_words};
use ugscene::{
    BodyBoxes, Camera, CameraOptions, MotionOptions, Scene, common_camera, moving_camera,
};

use crate::commands::Commands;

/// A scene or a sky, as it was read.
pub struct Subject {
    /// What it depends on, see [`Commands::key`].
    pub key: String,
    kind: Kind,
    /// The sky behind a scene.
    sky: SkySource,
    /// Notes and warnings of reading.
    notes: Vec<String>,
}

enum Kind {
    Scene(Box<Scene>, Box<BodyBoxes>),
    Sky(Box<ugwarp::Opened>, Vec<String>),
}

/// How a scene is seen.
struct Seen {
    motion: MotionOptions,
    camera: CameraOptions,
    size: [u32; 2],
}

impl Seen {
    /// With the eye and view centre that are chosen for a scene without a camera.
    fn new(pipe: &Pipe, scene: &Scene) -> Self {
        let motion = pipe.programs().iter().find_map(Program::motion).unwrap_or_default();
        let mut camera = match pipe.programs().first() {
            Some(Program::Lorentz(config)) => {
                CameraOptions { eye: config.eye, ..config.camera.clone() }
            }
            _ => pipe.picture.camera.clone(),
        };
        let size = pipe.picture.size;
        // An invalid camera is refused when it draws.
        if let Ok(Some(fitted)) = common_camera(scene, &camera, size, std::slice::from_ref(&motion))
        {
            camera.eye = Some(fitted.eye);
            camera.center = Some(fitted.center);
        }
        Self { motion, camera, size }
    }
}

impl Subject {
    /// Reads the input of a pipe. Returns the files as well.
    pub fn open(commands: &Commands, files: Vec<Input>) -> (Result<Self, Failure>, Vec<Input>) {
        let mut context = Context::in_memory(&commands.common, files);
        let opened = Self::read(commands, &mut context);
        (opened, context.into_files())
    }

    fn read(commands: &Commands, context: &mut Context) -> Result<Self, Failure> {
        let key = commands.key();
        if commands.is_of_sky() {
            let args: ugwarp::Args = parse_words(commands.first().iter().map(OsString::from))?;
            let input = context.input()?;
            let opened = args.open(&input, context)?;
            let notes =
                opened.notes.iter().map(|note| format!("{}: {note}", commands.program())).collect();
            return Ok(Self {
                key,
                kind: Kind::Sky(Box::new(opened), context.take_record(&input)),
                sky: SkySource::None,
                notes,
            });
        }
        let reading = pipe::options(&commands.common)?;
        let source = pipe::read(context, &reading)?;
        let parsed = ugparse::read(&source, &reading, commands.camera());
        let mut parsed = parsed.map_err(pipe::refused)?;
        let is_warned = !parsed.warnings.is_empty();
        let notes =
            is_warned.then(|| format!("{}: {}", commands.program(), parsed.warnings.report()));
        let boxes = BodyBoxes::new(&parsed.scene);
        let mut pipe = commands.pipe();
        if let Some(sky) = pipe.sky() {
            sky.or_stated(parsed.scene.sky.as_ref());
            sky.open(&commands.common, context)?;
        }
        let sky = pipe.sky().map_or(SkySource::None, |sky| sky.source.clone());
        parsed.scene.head.files.extend(context.take_files_read());
        let kind = Kind::Scene(Box::new(parsed.scene), Box::new(boxes));
        Ok(Self { key, kind, sky, notes: notes.into_iter().collect() })
    }

    /// Gives a sky behind the scene its light.
    pub fn give_light(&self, sky: &mut SceneSky) {
        if let Kind::Scene(scene, _) = &self.kind {
            sky.or_stated(scene.sky.as_ref());
        }
        sky.source = self.sky.clone();
    }

    /// As ugfilm draws it.
    pub fn film_subject(&self) -> FilmSubject<'_> {
        match &self.kind {
            Kind::Scene(scene, _) => FilmSubject::Scene(scene),
            Kind::Sky(opened, files) => FilmSubject::Panorama(opened, files),
        }
    }

    /// The notes of reading, and one if nothing that moves is in the picture, as uglorentz has it.
    pub fn notes(&self, pipe: &Pipe) -> Vec<String> {
        let mut notes = self.notes.clone();
        if let Kind::Scene(scene, boxes) = &self.kind
            && let Some(first @ Program::Lorentz(_)) = pipe.programs().first()
        {
            let Seen { motion, camera, size } = Seen::new(pipe, scene);
            let note = boxes.note(scene, &motion, &camera, size);
            notes.extend(
                note.map(|note| format!("{}: {}", first.provenance().program, note.words())),
            );
        }
        notes
    }

    /// See [`crate::Studio::describe`].
    pub fn describe(&self, pipe: &Pipe) -> Value {
        let Kind::Scene(scene, boxes) = &self.kind else { return json!({ "kind": "sky" }) };
        let Seen { motion, camera, size } = Seen::new(pipe, scene);
        let own = scene.camera().cloned().unwrap_or_default();
        let eye = camera.eye.or(own.eye).unwrap_or_default();
        let center = camera.center.or(own.center).unwrap_or_default();
        let up = camera.up.or(own.up).map_or([0.0, 0.0, 1.0], |up| up.to_array());
        let angle =
            camera.view_angle.map(|(across, _)| across).or(own.view_angle.map(|angles| angles[0]));
        let times = boxes.times_in_view(&motion, &camera, size).ok().flatten();
        let start = start(scene, &motion, &camera);
        json!({
            "kind": "scene",
            "eye": eye.to_array(),
            "center": center.to_array(),
            "up": up,
            "angle": angle,
            "times": times.map(|times| [times.first, times.last, Some(times.best)]),
            "start": start,
        })
    }
}

/// Where a flight from the camera of a picture begins, as [`crate::Flight::new`] reads it; `null`
/// for an invalid camera.
fn start(scene: &Scene, motion: &MotionOptions, options: &CameraOptions) -> Option<Value> {
    let row = scene.camera_row();
    let (camera, velocity) = match moving_camera(scene, motion, options).ok()? {
        Some(moving) => moving,
        None => {
            let stated = motion.camera_velocity.map(Velocity::from_beta).transpose().ok()?;
            let camera = Camera { center: options.center, ..Camera::default() };
            (camera, stated.unwrap_or_default())
        }
    };
    let eye = ugscene::eye(scene, options.eye);
    let carrier = row.and_then(|row| scene.cameras[row].carrier);
    let event = match carrier.filter(|_| motion.camera_velocity.is_none()) {
        Some(body) => scene.bodies.motion(body).event(eye, motion.time).ok()?,
        None => {
            let passed = Event { t: motion.time, x: DVec3::ZERO };
            Lorentz::boost(velocity).apply(passed) + Event { t: 0.0, x: eye }
        }
    };
    let Event { t, x } = event;
    let up = camera.up.or(options.up).unwrap_or(DVec3::Z);
    Some(json!({
        "event": [t, x.x, x.y, x.z],
        "velocity": velocity.beta().to_array(),
        "view": (camera.center? - eye).to_array(),
        "up": up.to_array(),
    }))
}
