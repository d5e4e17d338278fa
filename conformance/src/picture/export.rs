//! The scenes for renderers that do not read UniGrafix: meshes as OBJ, and tables of the velocities
//! and colours of their objects and of the cameras.

use std::fmt::Write;

use ugmesh::{Axis, Config, MeshFile, Target};
use ugphoton::Lens;
use ugphysics::{Velocity, hue_to_wavelength};
use ugscene::{Camera, ColorValue, Scene, Tint};

use super::{CASES, PictureCase};

impl PictureCase {
    /// The scene as OBJ, with the coordinates of the scene: z is up. The name of a material is that
    /// of the object in [`objects`].
    ///
    /// # Errors
    /// The message of `ugmesh`. There is none for the scenes of the suite.
    pub fn mesh(&self) -> Result<Vec<u8>, String> {
        let config = Config { target: Target::Obj, up: Some(Axis::Z), ..Default::default() };
        let input = MeshFile::new(format!("{}.ug", self.name), self.scene);
        ugmesh::run(&config, &input).map(|mesh| mesh.bytes).map_err(|error| error.to_string())
    }
}

/// The objects of all scenes as a table: velocity, and colour in the frame of the object.
///
/// # Errors
/// A scene is invalid. There is none in the suite.
pub fn objects() -> Result<String, String> {
    let mut table = "case,object,vx,vy,vz,colour,hue_deg,wavelength_nm\n".to_string();
    for case in &CASES {
        let scene = case.parsed()?;
        for (name, velocity, value) in objects_of(&scene) {
            let beta = velocity.beta();
            let (color, hue_deg) = described(value);
            // Writing to a string cannot fail.
            let _ = write!(
                table,
                "{},{name},{:?},{:?},{:?},{color}",
                case.name, beta.x, beta.y, beta.z
            );
            let _ = match hue_deg {
                Some(hue) => writeln!(table, ",{hue:?},{:?}", hue_to_wavelength(hue)),
                None => writeln!(table, ",,"),
            };
        }
    }
    Ok(table)
}

/// Name, velocity and colour of each object, which is what has one colour and one velocity.
fn objects_of(scene: &Scene) -> Vec<(&str, Velocity, ColorValue)> {
    let mut objects: Vec<(&str, Velocity, ColorValue)> = Vec::new();
    for face in &scene.faces {
        let Some(color) = face.color.map(|color| &scene.colors[color.index()]) else { continue };
        let (name, velocity) = (scene.names.get(color.name), scene.bodies.velocity(face.body));
        if !objects.iter().any(|object| (object.0, object.1) == (name, velocity)) {
            objects.push((name, velocity, color.value));
        }
    }
    objects
}

/// A colour in words and numbers, and its hue in degrees if it is of one wavelength.
fn described(value: ColorValue) -> (String, Option<f64>) {
    let text = |kind: &str, numbers: &[f64]| {
        numbers.iter().fold(kind.to_string(), |text, number| format!("{text} {number:?}"))
    };
    match value {
        ColorValue::Rgb(rgb) => (text("srgb", &rgb), None),
        ColorValue::Xyz(xyz) => (text("xyz", &xyz), None),
        ColorValue::Blackbody { kelvin, scale } => (text("blackbody", &[kelvin, scale]), None),
        ColorValue::Hsv { value, tint: Tint::Hue(hue), saturation, .. } if saturation > 0.0 => {
            (text("hue", &[value, saturation]), Some(hue))
        }
        ColorValue::Hsv { value, .. } => (text("grey", &[value]), None),
        ColorValue::Spectrum { .. } => ("spectrum".to_string(), None),
    }
}

/// The cameras and sizes of all pictures as a table.
///
/// # Errors
/// A scene is invalid. There is none in the suite.
pub fn cameras() -> Result<String, String> {
    let mut table =
        "case,width,height,eye_x,eye_y,eye_z,centre_x,centre_y,centre_z,up_x,up_y,up_z,\
                     lens,horizontal_view_angle_deg\n"
            .to_string();
    for case in &CASES {
        let scene = case.parsed()?;
        let missing = || format!("the scene `{}` has no camera", case.name);
        let &Camera { eye, center, up, view_angle, .. } = scene.camera().ok_or_else(missing)?;
        let vectors = [eye, center, up].map(|vector| vector.ok_or_else(missing));
        let [width, height] = case.size;
        let _ = write!(table, "{},{width},{height}", case.name);
        for vector in vectors {
            let vector = vector?;
            let _ = write!(table, ",{:?},{:?},{:?}", vector.x, vector.y, vector.z);
        }
        let [across_deg, _] = view_angle.ok_or_else(missing)?;
        let _ = match case.lens {
            Lens::Panorama => writeln!(table, ",equirectangular,360.0"),
            _ => writeln!(table, ",pinhole,{across_deg:?}"),
        };
    }
    Ok(table)
}
