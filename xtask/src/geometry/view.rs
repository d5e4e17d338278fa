//! The measured scenes, their cameras, and the motions of these.

use std::path::{Path, PathBuf};

use glam::DVec3;
use ugparse::Source;
use ugscene::{Camera, Remarks, Scene};
use ugtests::oracle::{Oracle, Pinhole};
use ugtests::outline::{self, Errors};
use ugtests::scenes;

use super::Outcome;

/// Names of scenes, and whether they are placed with `-in`, so that they stay in the picture.
const SCENES: [(&str, bool); 6] = [
    ("ship", true),
    ("street", false),
    ("lattice", false),
    ("cubes", true),
    ("sphere", true),
    ("teapot", true),
];

/// The direction in which the camera flies.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Flight {
    /// In the view direction.
    Forward,
    /// Against the view direction.
    Backward,
    /// To the left.
    Sideways,
}

impl Flight {
    pub const ALL: [Flight; 3] = [Flight::Forward, Flight::Backward, Flight::Sideways];

    pub fn name(self) -> &'static str {
        match self {
            Flight::Forward => "forward",
            Flight::Backward => "backward",
            Flight::Sideways => "sideways",
        }
    }
}

/// A scene seen by a camera.
pub struct View {
    pub name: String,
    pub scene: Scene,
    pub camera: Camera,
    in_place: bool,
    pub size: [u32; 2],
}

/// The scenes of the repository and those of files.
pub fn views(size: [u32; 2], files: &[PathBuf]) -> Outcome<Vec<View>> {
    let mut views = Vec::new();
    for (name, in_place) in SCENES {
        let scene = without_wires(scenes::parse(&scenes::text(name)));
        let camera = scene.camera().ok_or("the scene has a camera")?.clone();
        views.push(View { name: name.to_string(), scene, camera, in_place, size });
    }
    for file in files {
        let source = Source::new(file.display().to_string(), std::fs::read(file)?);
        let scene =
            ugparse::parse(&source, &ugparse::Options { lax: true, ..ugparse::Options::default() })?.scene;
        let scene = without_wires(scene);
        let name = file.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        for (label, camera, in_place) in cameras(&scene) {
            views.push(View {
                name: format!("{name}, {label}"),
                scene: scene.clone(),
                camera,
                in_place,
                size,
            });
        }
    }
    Ok(views)
}

/// The scene without wires, which the oracle does not support.
fn without_wires(scene: Scene) -> Scene {
    Scene { wires: Vec::new(), remarks: Remarks::default(), ..scene }
}

/// The camera of the scene if eye, view centre and angle are given; else two: one near the middle
/// of the bounding box, looking along its longer side, and one outside.
fn cameras(scene: &Scene) -> Vec<(&'static str, Camera, bool)> {
    if let Some(camera) = scene.camera()
        && camera.eye.is_some()
        && camera.center.is_some()
        && camera.view_angle.is_some()
    {
        return vec![("its camera", camera.clone(), false)];
    }
    let positions = scene.vertices.iter().map(|vertex| vertex.position);
    let (low, high) =
        positions.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| (low.min(p), high.max(p)));
    let (middle, reach) = (low.midpoint(high), high - low);
    let along = if reach.x > reach.y { DVec3::X } else { DVec3::Y };
    // Offset, so that the eye has no coordinate in common with the scene.
    let inside = middle + reach * DVec3::new(0.017, 0.013, 0.041);
    let camera = |eye, center, across: f64| Camera {
        eye: Some(eye),
        center: Some(center),
        up: Some(DVec3::Z),
        view_angle: Some([across, across * 0.75]),
        ..Camera::default()
    };
    let outside = middle + reach.length() * DVec3::new(0.5, -0.9, 0.6);
    vec![
        ("inside", camera(inside, inside + along, 90.0), false),
        ("outside", camera(outside, middle, 50.0), true),
    ]
}

impl View {
    fn eye(&self) -> DVec3 {
        self.camera.eye.unwrap_or(DVec3::ZERO)
    }

    /// The velocity of the scene in the frame of the flying camera.
    pub fn beta(&self, speed: f64, flight: Flight) -> DVec3 {
        let ahead = (self.camera.center.unwrap_or(DVec3::Y) - self.eye()).normalize();
        let right = ahead.cross(self.camera.up.unwrap_or(DVec3::Z)).normalize();
        let direction = match flight {
            Flight::Forward => -ahead,
            Flight::Backward => ahead,
            Flight::Sideways => right,
        };
        direction * speed
    }

    pub fn pinhole(&self) -> Pinhole {
        Pinhole::new(&self.camera, self.eye(), self.size)
    }

    pub fn config(&self, beta: DVec3, pieces: uglorentz::Pieces) -> uglorentz::Config {
        uglorentz::Config {
            velocity: Some(beta),
            eye: Some(self.eye()),
            in_place: self.in_place,
            pieces,
            ..uglorentz::Config::default()
        }
    }

    pub fn oracle(&self, beta: DVec3) -> Oracle {
        Oracle::new(&self.scene, self.eye(), Some(beta), self.in_place)
    }

    /// The configuration for visible faces only, cut only as outlines and depth require.
    pub fn config_of_shape(&self, beta: DVec3) -> uglorentz::Config {
        let mut config = self.config(beta, uglorentz::Pieces::UpTo(uglorentz::DEFAULT_ERROR));
        config.color_error = f64::INFINITY;
        (config.size, config.cull) = (self.size, true);
        config.camera.view_angle = self.camera.view_angle.map(|[across, _]| (across, None));
        config
    }

    /// Outline errors of the output with a configuration, and the original face of each piece.
    pub fn measure(&self, config: &uglorentz::Config, oracle: &Oracle) -> Outcome<(Errors, Vec<usize>)> {
        let mut scene = Scene { cameras: vec![self.camera.clone()], ..self.scene.clone() };
        for row in 0..scene.faces.len() {
            scene.faces[row].name = Some(scene.names.add(&format!("f{row}")));
        }
        let (seen, report) = uglorentz::apply(scene, config)?;
        if report.is_full {
            return Err(format!("{} at {:?}: too many pieces", self.name, config.velocity).into());
        }
        // Pieces have the name of their face.
        let origin = |face: &ugscene::Face| seen.names.get(face.name?).strip_prefix('f')?.parse().ok();
        let origins: Option<Vec<usize>> = seen.faces.iter().map(origin).collect();
        let origins = origins.ok_or("a piece has lost its name")?;
        Ok((outline::errors(&seen, &origins, self.eye(), oracle, &self.pinhole()), origins))
    }
}

/// Is this a scene file? For the command line.
pub fn is_file(path: &str) -> Result<PathBuf, String> {
    if Path::new(path).is_file() { Ok(path.into()) } else { Err("there is no such file".to_string()) }
}
