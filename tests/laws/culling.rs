//! `-cull` omits invisible faces, and no others.

use glam::DVec3;
use uglight::ColorShift;
use ugphysics::Brightness;
use ugpipe::Words;
use ugscene::{CameraOptions, ShownEffects};
use ugtests::picture::assert_same;
use ugtests::pipe::{Pipe, lorentz_scene};
use ugtests::scenes;

const SIZE: [u32; 2] = [160, 120];

/// Checks that culling does not change the picture, and returns the number of culled faces.
fn culled(name: &str, scene: &str, pipe: &Pipe) -> usize {
    let text = scenes::text(scene);
    let whole = pipe.draw(&text);
    let mut culling = pipe.clone();
    (culling.lorentz.size, culling.lorentz.cull) = (SIZE, true);
    assert_same(&format!("cull-{name}"), &whole, &culling.draw(&text), 0);
    let (_, report) = lorentz_scene(&text, &culling.lorentz).unwrap();
    let detail = format!("removed {} faces outside the view", report.n_culled);
    assert_eq!(report.details().contains(&detail), report.n_culled > 0);
    report.n_culled
}

fn pipe(lorentz: uglorentz::Config) -> Pipe {
    let mut pipe = Pipe { lorentz, ..Pipe::default() };
    pipe.rainbow.picture.size = SIZE;
    pipe.rainbow.picture.samples = 1;
    pipe
}

/// Cameras: (view centre, up, angles, orthographic), each from the eye of the scene.
fn cameras() -> Vec<CameraOptions> {
    let camera = |center: [f64; 3], view_angle, is_orthographic| CameraOptions {
        center: Some(DVec3::from(center)),
        view_angle: Some(view_angle),
        is_orthographic,
        ..CameraOptions::default()
    };
    vec![
        CameraOptions::default(),
        camera([3.0, 0.0, 1.0], (30.0, None), false),
        camera([-9.0, -40.0, 5.0], (110.0, None), false),
        camera([0.0, 3.0, 30.0], (20.0, Some(80.0)), false),
        camera([1.0, 5.0, 2.0], (40.0, None), true),
    ]
}

#[test]
fn pictures_stay_the_same_to_the_pixel() {
    let mut n_culled = 0;
    let velocities = [DVec3::new(0.2, -0.5, 0.1), DVec3::NEG_Y * 0.95, DVec3::Y * 0.99];
    for (row, scene) in ["street", "lattice", "cubes"].into_iter().enumerate() {
        for (idx, camera) in cameras().into_iter().enumerate() {
            // Every scene and every camera with every velocity, though not both.
            let beta = velocities[(row + idx) % velocities.len()];
            let lorentz = uglorentz::Config {
                velocity: Some(beta),
                camera: camera.clone(),
                pieces: uglorentz::Pieces::UpTo(5e-3),
                color_error: f64::INFINITY,
                ..Default::default()
            };
            let mut pipe = pipe(lorentz);
            pipe.rainbow.picture.camera.view_angle = camera.view_angle;
            // Flat shading, too, and colours that do not mix.
            pipe.lorentz.smooth = idx % 2 == 1;
            pipe.doppler.repeat = idx == 2;
            pipe.doppler.shift = ColorShift::hues(idx != 1, Brightness::Report);
            n_culled += culled(&format!("{scene}-{idx}-{:.2}", beta.length()), scene, &pipe);
        }
    }
    // There are 5434 faces in total, drawn 5 times.
    assert!(n_culled > 5434 * 5 / 3, "{n_culled}");
}

#[test]
fn bodies_of_all_velocities_are_culled() {
    for (scene, in_place) in [("dice", true), ("dice", false), ("traffic", false)] {
        for (idx, camera) in cameras().into_iter().enumerate() {
            let lorentz = uglorentz::Config { in_place, camera, ..Default::default() };
            culled(&format!("{scene}-{in_place}-{idx}"), scene, &pipe(lorentz));
        }
    }
}

#[test]
fn bodies_on_world_lines_are_culled() {
    let views = [
        ("orbit", 52.0, [5.0, 0.0, 0.0], 12.0),
        ("wheels", 1.0, [1.2, 0.0, 0.5], 12.0),
        ("departure", 30.0, [0.0, 3.0, 1.2], 20.0),
        ("disc", 3.0, [1.0, 0.0, 0.5], 9.0),
        ("disc", 3.0, [-1.0, 0.0, 0.5], 9.0),
    ];
    for (scene, time, center, angle) in views {
        let camera = CameraOptions {
            center: Some(DVec3::from(center)),
            view_angle: Some((angle, None)),
            ..CameraOptions::default()
        };
        let mut pipe = pipe(uglorentz::Config { time, camera, ..Default::default() });
        pipe.rainbow.picture.camera.view_angle = Some((angle, None));
        let n_culled = culled(&format!("{scene}-{}", center[0]), scene, &pipe);
        assert!(n_culled > 200, "{scene}: {n_culled}");
    }
}

#[test]
fn teaching_switches_are_culled_right() {
    let mut n_culled = 0;
    for (contraction, flight_time) in [(true, false), (false, true), (false, false)] {
        let lorentz = uglorentz::Config {
            velocity: Some(DVec3::new(0.3, -0.9, 0.0)),
            geometry: ShownEffects { contraction, flight_time },
            pieces: uglorentz::Pieces::PerEdge(2),
            ..Default::default()
        };
        n_culled +=
            culled(&format!("teaching-{contraction}-{flight_time}"), "street", &pipe(lorentz));
    }
    assert!(n_culled > 500, "{n_culled}");
}

/// The camera looks at the middle of a large face, whose corners and edges are outside the picture.
#[test]
fn large_faces_are_not_lost() {
    let tile =
        b"v a -9 2 -9; v b 9 2 -9; v c 9 2 9; v d -9 2 9; f (a b c d); l 1; cam -vc 0 1 0 -va 2 2;";
    for speed in [-0.9, 0.0, 0.9] {
        let mut pipe =
            pipe(uglorentz::Config { velocity: Some(DVec3::Y * speed), ..Default::default() });
        (pipe.lorentz.size, pipe.lorentz.cull) = (SIZE, true);
        let picture = pipe.shape().draw(tile);
        assert!(picture.pixels().all(|pixel| pixel.0[0] > 0), "{speed}");
    }
}

#[test]
fn where_the_camera_looks_must_be_known() {
    let text = b"v a 1 2 3; v b 2 0 3; v c 1 1 1; f (a b c);";
    let config = uglorentz::Config { size: SIZE, cull: true, ..Default::default() };
    let error = lorentz_scene(text, &config).unwrap_err();
    assert!(error.is_usage());
    assert_eq!(
        error.words(),
        "-cull needs the view centre of the camera: give it with -vc, or in the `cam` statement of the scene"
    );
    // Everything is behind the camera; one face is kept, because a scene without faces is invalid.
    let camera = CameraOptions { center: Some(DVec3::NEG_ONE), ..Default::default() };
    let (scene, report) = lorentz_scene(text, &uglorentz::Config { camera, ..config }).unwrap();
    assert_eq!((scene.faces.len(), report.n_culled), (1, 0));
}
