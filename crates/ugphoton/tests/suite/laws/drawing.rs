//! Scenes for measurements, and their light.

use std::path::Path;

use glam::DVec3;
use ugimage::{Format, Frame, LinearFrame, Metadata};
use ugphoton::{CameraOptions, ColorShift, Config, HueShift, PictureOptions, light};
use ugphysics::{Brightness, srgb_encode};

/// Colours, surfaces, and no light but that of faces with a level.
pub const HEAD: &str = "c white 1; l 0; surf mirror 0 1 0; surf glass 0 0 1 1.5;\n";

/// The light of a scene with the eye at the origin.
pub fn drawn(text: &str, config: &Config) -> LinearFrame {
    let source = ugparse::Source::new("test.ug", text);
    let options = ugparse::Options::default();
    let source = ugparse::include(source, &options, |request| Ok(picture(request.path))).unwrap();
    let mut scene = ugparse::parse(&source, &ugparse::Options::default()).unwrap().scene;
    if scene.cameras.is_empty() {
        scene
            .cameras
            .push(ugscene::Camera { eye: Some(DVec3::ZERO), ..ugscene::Camera::default() });
    }
    light(scene, config).unwrap()
}

/// The picture that a name describes: `rgb_R_G_B` is one pixel, `checks_N_M` are N x N checks of M
/// x M pixels, black at the upper left.
fn picture(path: &Path) -> Vec<u8> {
    let name = path.to_str().unwrap();
    let numbers: Vec<u32> = name.split('_').skip(1).map(|number| number.parse().unwrap()).collect();
    let (side, pixels) = match numbers[..] {
        [red, green, blue] => (1, vec![[red as u8, green as u8, blue as u8, 255]]),
        [n, m] => {
            let places =
                (0..n * m).flat_map(|row| (0..n * m).map(move |column| (row / m + column / m) % 2));
            (n * m, places.map(|odd| if odd == 1 { [255; 4] } else { [0, 0, 0, 255] }).collect())
        }
        _ => panic!("{name}"),
    };
    Format::Png.encode(&Frame::new([side; 2], true, pixels), &Metadata::default())
}

/// A view of one sample per pixel.
pub fn config(size: [u32; 2], toward: DVec3, view_angle: f64) -> Config {
    let camera = CameraOptions {
        center: Some(toward),
        up: Some(if toward.y.abs() < 0.9 * toward.length() { DVec3::Y } else { DVec3::X }),
        view_angle: Some((view_angle, None)),
        ..CameraOptions::default()
    };
    let picture = PictureOptions { size, samples: 1, camera, ..PictureOptions::default() };
    Config { picture, ..Config::default() }
}

/// The light in the middle of a narrow view.
pub fn seen(text: &str, toward: DVec3) -> DVec3 {
    seen_with(text, toward, Config::default())
}

/// The same with other options, except for the picture.
pub fn seen_with(text: &str, toward: DVec3, base: Config) -> DVec3 {
    let config = Config { picture: config([1, 1], toward, 1e-3).picture, ..base };
    let [red, green, blue, _] = drawn(text, &config).pixels()[0];
    DVec3::new(red.into(), green.into(), blue.into())
}

/// Options with a brightness law, and wavelengths as they are.
pub fn by_law(law: Brightness) -> Config {
    Config { shift: ColorShift::Hues(HueShift { doppler: false, law }), ..Config::default() }
}

/// Options for spectra.
pub fn by_spectra() -> Config {
    Config { shift: ColorShift::spectra(true, true), ..Config::default() }
}

/// The value of a grey seen in a direction: a number, of which a picture shows the light.
pub fn value(text: &str, toward: DVec3, base: Config) -> f64 {
    srgb_encode(seen_with(text, toward, base).y)
}

/// Vertices and a face. `rest` follows the corners in its statement.
pub fn polygon(name: &str, corners: &[DVec3], rest: &str) -> String {
    let vertex = |(at, corner): (usize, &DVec3)| {
        format!("v {name}{at} {} {} {};\n", corner.x, corner.y, corner.z)
    };
    let vertices: String = corners.iter().enumerate().map(vertex).collect();
    let names: Vec<String> = (0..corners.len()).map(|at| format!("{name}{at}")).collect();
    format!("{vertices}f ({}) {rest};\n", names.join(" "))
}

/// A square of half side `half` around `center`, perpendicular to `normal`, seen from there.
pub fn square(name: &str, center: DVec3, normal: DVec3, half: f64, rest: &str) -> String {
    let (e1, e2) = normal.normalize().any_orthonormal_pair();
    polygon(name, &[e1 + e2, e2 - e1, -e1 - e2, e1 - e2].map(|corner| center + half * corner), rest)
}

/// A cube of half side `half` around the origin.
pub fn surroundings(name: &str, half: f64, rest: &str) -> String {
    let sides = [DVec3::X, DVec3::Y, DVec3::Z, DVec3::NEG_X, DVec3::NEG_Y, DVec3::NEG_Z];
    let side = |(at, side): (usize, &DVec3)| {
        square(&format!("{name}{at}s"), half * *side, -*side, half, rest)
    };
    sides.iter().enumerate().map(side).collect()
}

/// A velocity as a scene states it.
pub fn velocity(v: DVec3) -> String {
    format!("<{} {} {}>", v.x, v.y, v.z)
}
