//! Motions as text.

use std::fmt::Write;

use glam::{DMat3, DVec3};
use ugtesting::Random;

use super::Four;

/// A vector that acts for a stretch of own time.
#[derive(Clone, Copy, Debug)]
pub struct Stretch {
    /// Acceleration or angular velocity.
    pub of: DVec3,
    /// Own time at which it begins.
    pub from: f64,
    /// Own time at which it ends.
    pub to: f64,
}

/// The path of the reference point.
#[derive(Clone, Debug)]
pub enum Path {
    /// `-vel`, `-acc`
    Free {
        /// At own time 0.
        velocity: DVec3,
        /// In pieces.
        accelerations: Vec<Stretch>,
    },
    /// `-orbit`
    Orbit {
        /// The centre.
        center: DVec3,
        /// A unit vector.
        axis: DVec3,
        /// Radians per unit of the time of the scene.
        rate: f64,
    },
    /// `-path`: t, x, y, z of events.
    Events(Vec<Four>),
    /// `-on`: the row of another motion.
    On(usize),
}

/// A `motion` statement.
#[derive(Clone, Debug)]
pub struct Statement {
    /// `-at`
    pub at: DVec3,
    /// How the reference point moves.
    pub path: Path,
    /// `-spin`
    pub spins: Vec<Stretch>,
}

impl Statement {
    /// Constant velocity.
    pub fn inertial(velocity: DVec3) -> Self {
        Self {
            at: DVec3::ZERO,
            path: Path::Free { velocity, accelerations: Vec::new() },
            spins: Vec::new(),
        }
    }

    /// Its text. The carrier of `-on` has the name `m` and its row.
    pub fn text(&self, name: &str) -> String {
        let mut text = format!("motion {name} -at {}", words(self.at));
        match &self.path {
            Path::Free { velocity, accelerations } => {
                write!(text, " -vel {}", words(*velocity)).expect("memory");
                accelerations.iter().for_each(|piece| text += &piece.option("acc"));
            }
            Path::Orbit { center, axis, rate } => {
                write!(text, " -orbit {} {} {rate:?}", words(*center), words(*axis))
                    .expect("memory");
            }
            Path::Events(rows) => {
                let rows: Vec<String> =
                    rows.iter().map(|[t, x, y, z]| format!("{t:?} {x:?} {y:?} {z:?}")).collect();
                write!(text, " -path ({})", rows.join("  ")).expect("memory");
            }
            Path::On(carrier) => write!(text, " -on m{carrier}").expect("memory"),
        }
        self.spins.iter().for_each(|piece| text += &piece.option("spin"));
        text + " ;\n"
    }

    /// The same motion turned or mirrored, in another unit of length and time.
    #[must_use]
    pub fn placed(&self, turn: DMat3, unit: f64) -> Self {
        let parity = turn.determinant().signum();
        let place = |place: DVec3| unit * (turn * place);
        let path = match &self.path {
            Path::Free { velocity, accelerations } => Path::Free {
                velocity: turn * *velocity,
                accelerations: turned(accelerations, turn, unit),
            },
            Path::Orbit { center, axis, rate } => Path::Orbit {
                center: place(*center),
                axis: parity * (turn * *axis),
                rate: rate / unit,
            },
            Path::Events(rows) => {
                let placed = |&[t, x, y, z]: &Four| {
                    let [x, y, z] = place(DVec3::new(x, y, z)).to_array();
                    [unit * t, x, y, z]
                };
                Path::Events(rows.iter().map(placed).collect())
            }
            Path::On(carrier) => Path::On(*carrier),
        };
        Self { at: place(self.at), path, spins: turned(&self.spins, parity * turn, unit) }
    }

    /// The same motion with another velocity at own time 0, and with turned axes.
    ///
    /// # Panics
    /// It is an orbit or a path, which are given in the frame of the scene, or rides on another one.
    #[must_use]
    pub fn boosted(&self, velocity: DVec3, turn: DMat3) -> Self {
        let Path::Free { accelerations, .. } = &self.path else {
            panic!("it has no velocity of its own")
        };
        let path = Path::Free { velocity, accelerations: turned(accelerations, turn, 1.0) };
        Self { at: turn * self.at, path, spins: turned(&self.spins, turn, 1.0) }
    }

    /// A random motion for a body of radius 1 about `middle`. `speed`: the largest at own time 0.
    pub fn random(random: &mut Random, middle: DVec3, speed: f64) -> Self {
        let at = middle + random.in_ball(0.5);
        let path = if random.one_in(3) {
            let axis = random.direction();
            let arm = random.direction().cross(axis).normalize() * random.between(2.0, 5.0);
            let center = at + arm + random.between(-1.0, 1.0) * axis;
            // The horizon stays outside of the body: the acceleration of the centre, γ²β²/ρ, is 1/4 at most.
            let part = 0.25 * arm.length();
            let rate = random.between(0.2, 1.0) * (part / (1.0 + part)).sqrt() / arm.length();
            Path::Orbit { center, axis, rate: if random.one_in(2) { rate } else { -rate } }
        } else if random.one_in(3) {
            Path::Events(events(random, at, 0.5 * speed))
        } else {
            let velocity = random.direction() * random.between(0.0, speed);
            let mut from = random.between(-9.0, 0.0);
            let mut accelerations = Vec::new();
            for _ in 0..random.below(4) {
                let to = from + random.between(0.3, 4.0);
                accelerations.push(Stretch { of: random.in_ball(0.25), from, to });
                from = if random.one_in(2) { to } else { to + random.between(0.0, 2.0) };
            }
            Path::Free { velocity, accelerations }
        };
        let spins = spins(random, 0.25);
        Self { at, path, spins }
    }

    /// A random part of the body with the motion `carrier`, near `middle`.
    pub fn random_part(random: &mut Random, carrier: usize, middle: DVec3) -> Self {
        let at = middle + random.in_ball(0.3);
        Self { at, path: Path::On(carrier), spins: spins(random, 0.15) }
    }
}

/// Accelerations or angular velocities after a turn, in another unit of length and time.
fn turned(pieces: &[Stretch], turn: DMat3, unit: f64) -> Vec<Stretch> {
    let turned = |piece: &Stretch| Stretch {
        of: turn * piece.of / unit,
        from: unit * piece.from,
        to: unit * piece.to,
    };
    pieces.iter().map(turned).collect()
}

/// Events from `at` on, with a mean speed of `speed` at most, and an acceleration below 0.4.
fn events(random: &mut Random, at: DVec3, speed: f64) -> Vec<Four> {
    let velocity = random.in_ball(speed);
    let [first, second] = [random.in_ball(0.4), random.in_ball(0.4)];
    let [slow, fast] = [random.between(0.1, 0.4), random.between(0.4, 0.6)];
    let start = random.between(-12.0, 2.0);
    let mut passed = 0.0;
    (0..2 + random.below(9))
        .map(|_| {
            let (rise, turn) = (1.0 - libm::cos(slow * passed), libm::sin(fast * passed));
            let x = at + passed * velocity + rise * first + 0.5 * turn * second;
            let row = [start + passed, x.x, x.y, x.z];
            passed += random.between(0.5, 2.0);
            row
        })
        .collect()
}

/// Up to 3 pieces of spin, or one for ever.
fn spins(random: &mut Random, rate: f64) -> Vec<Stretch> {
    if random.one_in(2) {
        let of = rate * random.in_ball(1.0);
        return vec![Stretch { of, from: f64::NEG_INFINITY, to: f64::INFINITY }];
    }
    let mut from = random.between(-9.0, 0.0);
    let mut spins = Vec::new();
    for _ in 0..random.below(4) {
        let to = from + random.between(0.3, 6.0);
        spins.push(Stretch { of: rate * random.in_ball(1.0), from, to });
        from = to;
    }
    spins
}

impl Stretch {
    fn option(&self, name: &str) -> String {
        let text = format!(" -{name} {}", words(self.of));
        if self.to.is_finite() { text + &format!(" {:?} {:?}", self.from, self.to) } else { text }
    }
}

/// Numbers as text, exactly.
pub fn words(p: DVec3) -> String {
    format!("{:?} {:?} {:?}", p.x, p.y, p.z)
}
