//! Pictures: which triangle each pixel shows, and its colour.

use glam::DVec3;
use ugscene::Anchor;
use ugtesting::Random;
use ugtests::agreement::{face_of, recolored};
use ugtests::pipe::Pipe;
use ugtests::scenes::parse;
use ugtests::world_lines::statement::words;
use ugtests::world_lines::{Observer, Statement, View};

use super::{World, observer};

const SIZE: [u32; 2] = [24, 18];

/// How far from its edge, in pixels, a triangle may be missed.
const REACH: f64 = 0.03;

/// A picture to take.
struct Shot {
    world: World,
    /// The camera, as text, without its view centre.
    camera: String,
    eye: DVec3,
    center: DVec3,
    /// The full angle across the picture, degrees.
    angle_deg: f64,
    time: f64,
    observer: Observer,
    /// The direction in the axes of the observer that the camera calls x, y, z.
    axes: [DVec3; 3],
}

impl Shot {
    /// Bodies of all kinds around the origin, seen from outside.
    fn random(random: &mut Random) -> Self {
        let world = World::random(random, 1.5, 0.7, 3);
        let velocity = random.in_ball(0.7);
        let eye = 5.0 * random.direction();
        let time = random.between(4.0, 6.0);
        let observer = observer(eye, velocity, time);
        let mut shot = Self {
            world,
            camera: format!("<{}>", words(velocity)),
            eye,
            center: DVec3::ZERO,
            angle_deg: 0.0,
            time,
            observer,
            axes: DVec3::AXES,
        };
        shot.center = eye + shot.middle();
        shot.angle_deg = shot.angle_deg();
        shot
    }

    /// The same, from a body that moves as well.
    fn riding(random: &mut Random) -> Self {
        let mut shot = Self::random(random);
        let mut carrier = Statement::random(random, shot.eye, 0.7);
        // At the reference point the axes of the body are those of the eye.
        carrier.at = shot.eye;
        if let ugtests::world_lines::Path::Orbit { center, .. } = &mut carrier.path {
            *center = shot.eye + DVec3::new(1.0, 2.0, -1.0);
        }
        let row = shot.world.motions.len();
        shot.world.motions.push(carrier);
        let body = &shot.world.bodies()[row];
        shot.observer = Observer::on(body, shot.eye, shot.time);
        shot.axes = DVec3::AXES.map(|axis| shot.observer.components(body.vector(axis, shot.time)));
        shot.camera = format!("<m{row}>");
        let middle = shot.middle();
        shot.angle_deg = shot.angle_deg();
        shot.center = shot.eye + DVec3::from_array(shot.axes.map(|axis| axis.dot(middle)));
        shot
    }

    /// The mean direction to what is seen, in the axes of the observer.
    fn middle(&self) -> DVec3 {
        let bodies = self.world.bodies();
        let corners =
            self.world.triangles.iter().flat_map(|triangle| triangle.corners.map(|p| (triangle.body, p)));
        corners.map(|(body, p)| self.observer.sight(&bodies[body], p).seen.normalize()).sum::<DVec3>()
    }

    /// So that all but the outer corners are in the picture.
    fn angle_deg(&self) -> f64 {
        let (bodies, middle) = (self.world.bodies(), self.middle());
        let corners =
            self.world.triangles.iter().flat_map(|triangle| triangle.corners.map(|p| (triangle.body, p)));
        let angle =
            |(body, p): (usize, DVec3)| self.observer.sight(&bodies[body], p).seen.angle_between(middle);
        (1.5 * corners.map(angle).fold(0.0, f64::max)).to_degrees().min(100.0)
    }

    fn text(&self) -> String {
        let angle = self.angle_deg;
        format!(
            "{}cam -ep {} -vc {} -ud 0 0 1 -va {angle} {angle} {};",
            self.world.text(),
            words(self.eye),
            words(self.center),
            self.camera
        )
    }

    /// The direction through a point of the picture, in the axes of the observer.
    fn direction(&self, x: f64, y: f64) -> DVec3 {
        let [width, height] = SIZE.map(f64::from);
        let forward = (self.center - self.eye).normalize();
        let right = forward.cross(DVec3::Z).normalize();
        let down = forward.cross(right);
        let pixel = 2.0 * libm::tan(0.5 * self.angle_deg.to_radians()) / width;
        let d = forward + pixel * ((x - 0.5 * width) * right + (y - 0.5 * height) * down);
        let [a, b, c] = self.axes;
        (d.x * a + d.y * b + d.z * c).normalize()
    }

    fn pipe(&self) -> Pipe {
        let mut pipe = Pipe::default();
        pipe.lorentz.time = self.time;
        pipe.lorentz.anchor = Some(Anchor::Origin);
        pipe.lorentz.pieces = uglorentz::Pieces::UpTo(2e-4);
        pipe.lorentz.color_error = f64::INFINITY;
        pipe.doppler.repeat = true;
        pipe.doppler.tolerance = 0.0;
        pipe.rainbow.picture.size = SIZE;
        pipe.rainbow.picture.samples = 1;
        pipe
    }
}

/// Which triangle every pixel shows.
fn check_shape(shot: &Shot) {
    let text = ugparse::write(&recolored(parse(shot.text().as_bytes())));
    let picture = shot.pipe().shape().draw(&text);
    let bodies = shot.world.bodies();
    let view = View::new(shot.observer, &bodies, &shot.world.triangles);
    let look = |x: f64, y: f64| view.look(shot.direction(x, y)).map(|hit| hit.triangle);
    let (mut n_filled, mut n_edges) = (0, 0);
    for (column, row, pixel) in picture.enumerate_pixels() {
        let (x, y) = (f64::from(column) + 0.5, f64::from(row) + 0.5);
        let expected = look(x, y);
        n_filled += usize::from(expected.is_some());
        let shown = face_of(pixel.0);
        if shown == Ok(expected) {
            continue;
        }
        let ring = (0..16).map(|k| 0.125 * std::f64::consts::PI * f64::from(k)).map(libm::sincos);
        let near: Vec<_> = ring.map(|(sin, cos)| look(x + REACH * cos, y + REACH * sin)).collect();
        let is_explained = shown.is_ok_and(|shown| near.contains(&shown));
        assert!(is_explained, "{column} {row} shows {shown:?}, not {expected:?}: {near:?}\n{}", shot.text());
        n_edges += 1;
    }
    println!("{n_filled} pixels of triangles, {n_edges} at edges");
    assert!(n_filled > 10 && n_edges < 10, "{}", shot.text());
}

#[test]
fn every_pixel_shows_the_triangle_whose_light_arrives() {
    let mut random = Random(3);
    (0..3).for_each(|_| check_shape(&Shot::random(&mut random)));
}

#[test]
fn every_pixel_of_a_camera_on_a_body_shows_the_triangle_whose_light_arrives() {
    let mut random = Random(4);
    (0..3).for_each(|_| check_shape(&Shot::riding(&mut random)));
}
