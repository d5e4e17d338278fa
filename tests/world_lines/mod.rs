//! Bodies, lamps and cameras on world lines, compared with an oracle that integrates their
//! equations of motion ([`ugtests::world_lines`]), and laws that hold for them.

mod bound;
mod lamps;
mod laws;
mod paths;
mod rays;
mod text;
mod vertices;

use glam::DVec3;
use ugscene::{Anchor, Scene};
use ugtests::world_lines::statement::words;
use ugtests::world_lines::{Body, Observer, Statement, Triangle};

/// Own times that are integrated.
const RANGE: [f64; 2] = [-40.0, 25.0];

/// A scene of triangles.
#[derive(Clone, Debug, Default)]
struct World {
    motions: Vec<Statement>,
    triangles: Vec<Triangle>,
}

impl World {
    /// Two bodies of `n` triangles each within `reach` of the origin, each with a part that spins.
    /// `size`: that motions are made for.
    fn random(random: &mut ugtesting::Random, reach: f64, size: f64, n: usize) -> Self {
        let mut world = Self::default();
        for _ in 0..2 {
            let middle = random.in_ball(reach);
            let motion = Statement::random(random, middle, size);
            world.add(random, motion, middle, n);
            let carrier = world.motions.len() - 1;
            let part = Statement::random_part(random, carrier, middle);
            world.add(random, part, middle, 1);
        }
        world
    }

    /// Motions and faces.
    fn text(&self) -> String {
        let mut text: String = self
            .motions
            .iter()
            .enumerate()
            .map(|(row, motion)| motion.text(&format!("m{row}")))
            .collect();
        for (row, Triangle { body, corners }) in self.triangles.iter().enumerate() {
            for (k, corner) in corners.iter().enumerate() {
                text += &format!("v p{row}_{k} {};\n", words(*corner));
            }
            text += &format!("f t{row} (p{row}_0 p{row}_1 p{row}_2) <m{body}>;\n");
        }
        text
    }

    fn bodies(&self) -> Vec<Body> {
        (0..self.motions.len()).map(|row| Body::new(&self.motions, row, RANGE)).collect()
    }

    /// Adds random triangles within 1 of `middle`, and makes them a body with this motion.
    fn add(&mut self, random: &mut ugtesting::Random, motion: Statement, middle: DVec3, n: usize) {
        let body = self.motions.len();
        self.motions.push(motion);
        for _ in 0..n {
            let corners = [(); 3].map(|()| middle + random.in_ball(1.0));
            self.triangles.push(Triangle { body, corners });
        }
    }
}

/// `uglorentz` without subdivision, with scene coordinates that are those of the frame of the
/// scene.
fn options(eye: DVec3, time: f64) -> uglorentz::Config {
    uglorentz::Config {
        eye: Some(eye),
        time,
        anchor: Some(Anchor::Origin),
        pieces: uglorentz::Pieces::PerEdge(1),
        ..uglorentz::Config::default()
    }
}

/// A camera with a velocity, that is at `eye` at time 0.
fn observer(eye: DVec3, velocity: DVec3, time: f64) -> Observer {
    let [t, x, y, z] = ugtests::world_lines::boosted(velocity, [time, 0.0, 0.0, 0.0]);
    Observer::new([t, x + eye.x, y + eye.y, z + eye.z], velocity)
}

/// The scene as seen.
#[track_caller]
fn seen(text: &str, config: &uglorentz::Config) -> Scene {
    let seen = ugtests::pipe::lorentz_scene(text.as_bytes(), config);
    seen.unwrap_or_else(|error| panic!("{error}\n{text}")).0
}
