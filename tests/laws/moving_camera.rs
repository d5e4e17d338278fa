//! A camera that moves in the scene: the lighting of bodies. (P7), (P25)

use glam::DVec3;
use ugphysics::Velocity;
use ugtesting::Random;
use ugtests::pipe::{self, Pipe};
use ugtests::scenes::parse;

/// A triangle and a camera, both with random velocities. The expected light level is computed from
/// the rest coordinates in the scene, and compared with the pixel at the triangle's centre.
#[test]
fn bodies_are_lit_in_the_axes_of_the_scene() {
    const SUN: DVec3 = DVec3::new(0.3, -0.5, 0.8);
    const LAMP: DVec3 = DVec3::new(4.0, -3.0, 6.0);
    let mut random = Random(77);
    let (mut n_lit, mut n_turned) = (0, 0);
    for case in 0..60 {
        let corners: [DVec3; 3] = [(); 3].map(|()| random.in_cube(10.0));
        let (eye, body) = (random.in_cube(10.0), 0.9 * random.direction());
        let camera = 0.9 * random.direction();
        let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize();
        let normal = if normal.dot(eye - corners[0]) < 0.0 { -normal } else { normal };
        let lamp = |corner: DVec3| normal.dot((LAMP - corner).normalize()).max(0.0);
        let lamps = corners.map(lamp).iter().sum::<f64>() / 3.0;
        let level = 0.1 + 0.4 * normal.dot(SUN.normalize()).max(0.0) + 0.5 * lamps;

        let vertices: Vec<String> = corners
            .iter()
            .zip(["a", "b", "c"])
            .map(|(p, name)| format!("v {name} {} {} {};", p.x, p.y, p.z))
            .collect();
        let text = format!(
            "{} f (a b c) <{} {} {}>; l 0.1; l 0.4 {} {} {}; l 0.5 {} {} {} 0; cam -ep {} {} {} <{} {} {}>;",
            vertices.join(" "),
            body.x,
            body.y,
            body.z,
            SUN.x,
            SUN.y,
            SUN.z,
            LAMP.x,
            LAMP.y,
            LAMP.z,
            eye.x,
            eye.y,
            eye.z,
            camera.x,
            camera.y,
            camera.z
        );
        let mut lorentz =
            uglorentz::Config { pieces: uglorentz::Pieces::PerEdge(1), ..Default::default() };
        // The side that is seen is the one at rest.
        lorentz.anchor = Some(uglorentz::Anchor::Eye);
        let seen = pipe::lorentz(text.as_bytes(), &lorentz);
        let middle =
            parse(&seen).vertices.iter().map(|vertex| vertex.position).sum::<DVec3>() / 3.0;
        let mut pipe = Pipe::default().shape().view_angle(1e-3);
        pipe.lorentz = lorentz;
        pipe.rainbow.picture.camera.center = Some(middle);
        pipe.rainbow.picture.size = [1, 1];
        let pixel = pipe.draw(text.as_bytes()).get_pixel(0, 0).0;
        let expected = 255.0 * level.min(1.0);
        assert!(
            (f64::from(pixel[0]) - expected).abs() <= 1.0,
            "case {case}: {pixel:?} for {expected}"
        );
        n_lit += usize::from(level > 0.15);
        let scene = parse(&seen);
        let w = scene.bodies.stated_velocity(scene.faces[0].body).unwrap();
        let turn = ugscene::axes_from_scene(w, Velocity::from_beta(camera).unwrap());
        n_turned += usize::from((turn * normal).dot(normal) < 0.9);
    }
    assert!(n_lit > 30 && n_turned > 30, "{n_lit} lit, {n_turned} turned");
}
