//! The world line of a body, integrated in small steps.

use glam::DVec3;

use super::curve::Curve;
use super::statement::{Path, Statement, Stretch};
use super::{Four, boosted, four_velocity, plus, product};

/// Own time of a step.
const STEP: f64 = 4e-3;

/// The most spins of a body, one in the other.
const MOST_TURNS: usize = 2;

/// z, u, e₁ e₂ e₃ and the columns of the turns.
const N_NUMBERS: usize = 20 + 9 * MOST_TURNS;

/// The numbers that the equations of motion change.
type State = [f64; N_NUMBERS];

/// What acts from one step to the next.
#[derive(Clone, Copy, Debug)]
struct Rates {
    acceleration: DVec3,
    /// Between the first and the last event of a path.
    is_on_curve: bool,
    spins: [DVec3; MOST_TURNS],
}

/// A body on a world line.
#[derive(Clone, Debug)]
pub struct Body {
    at: DVec3,
    orbit: Option<(DVec3, DVec3, f64)>,
    curve: Option<Curve>,
    pivots: [DVec3; MOST_TURNS],
    /// Own times, in order, the state there, and what acts up to the next.
    nodes: Vec<(f64, State, Rates)>,
}

/// A point of a body at an own time.
#[derive(Clone, Copy, Debug)]
pub struct Moment {
    /// Its event.
    pub event: Four,
    /// Its 4-velocity.
    pub velocity: Four,
}

impl Body {
    /// The body with the motion number `row`, for own times between `begin` < 0 and `end` > 0.
    pub fn new(motions: &[Statement], row: usize, [begin, end]: [f64; 2]) -> Self {
        let mut root = &motions[row];
        let mut turns: Vec<(DVec3, &[Stretch])> = vec![(root.at, &root.spins)];
        while let Path::On(carrier) = root.path {
            root = &motions[carrier];
            turns.push((root.at, &root.spins));
        }
        turns.retain(|(_, spins)| !spins.is_empty());
        assert!(turns.len() <= MOST_TURNS);
        let (velocity, accelerations, orbit) = match &root.path {
            Path::Free { velocity, accelerations } => (*velocity, accelerations.as_slice(), None),
            &Path::Orbit { center, axis, rate } => {
                (rate * axis.cross(root.at - center), [].as_slice(), Some((center, axis, rate)))
            }
            Path::Events(rows) => (Curve::new(rows).at(rows[0][0]).0, [].as_slice(), None),
            Path::On(_) => unreachable!("the last carrier is on no other"),
        };
        let mut pivots = [DVec3::ZERO; MOST_TURNS];
        pivots.iter_mut().zip(&turns).for_each(|(pivot, (at, _))| *pivot = *at);
        let at_start = [0.0, root.at.x, root.at.y, root.at.z];
        let curve = match &root.path {
            Path::Events(rows) => Some(Curve::new(rows)),
            _ => None,
        };
        let place = match &curve {
            Some(curve) => curve.start(),
            None if orbit.is_some() => at_start,
            None => boosted(velocity, at_start),
        };
        let knots = curve.as_ref().map_or(Vec::new(), Curve::own_times);
        let mut body = Self { at: root.at, orbit, curve, pivots, nodes: Vec::new() };
        let rates = |inside: f64| {
            let of = |pieces: &[Stretch]| {
                let piece = pieces.iter().find(|piece| (piece.from..piece.to).contains(&inside));
                piece.map_or(DVec3::ZERO, |piece| piece.of)
            };
            let mut spins = [DVec3::ZERO; MOST_TURNS];
            spins.iter_mut().zip(&turns).for_each(|(spin, (_, pieces))| *spin = of(pieces));
            let is_on_curve = knots
                .first()
                .zip(knots.last())
                .is_some_and(|(from, to)| (*from..*to).contains(&inside));
            Rates { acceleration: of(accelerations), is_on_curve, spins }
        };
        let pieces = accelerations.iter().chain(turns.iter().flat_map(|(_, spins)| *spins));
        let mut changes: Vec<f64> = pieces.flat_map(|piece| [piece.from, piece.to]).collect();
        changes.extend([begin, 0.0, end]);
        changes.extend(&knots);
        changes.retain(|change| (begin..=end).contains(change));
        changes.sort_by(f64::total_cmp);
        changes.dedup();
        body.integrate(start(velocity, place), &changes, rates);
        body
    }

    fn integrate(&mut self, start: State, changes: &[f64], rates: impl Fn(f64) -> Rates) {
        let mut times: Vec<f64> = Vec::new();
        for ends in changes.windows(2) {
            let n = ((ends[1] - ends[0]) / STEP).ceil();
            times.extend((0..n as usize).map(|k| ends[0] + (ends[1] - ends[0]) * k as f64 / n));
        }
        times.push(*changes.last().expect("there is a begin and an end"));
        let zero = times.iter().position(|&time| time == 0.0).expect("0 is a change");
        let between = |row: usize| rates(times[row].midpoint(times[row + 1]));
        let mut state = start;
        for row in (0..zero).rev() {
            state = self.step(times[row + 1], state, &between(row), times[row] - times[row + 1]);
            self.nodes.push((times[row], state, between(row)));
        }
        self.nodes.reverse();
        state = start;
        for row in zero..times.len() - 1 {
            self.nodes.push((times[row], state, between(row)));
            state = self.step(times[row], state, &between(row), times[row + 1] - times[row]);
        }
    }

    /// dz/dτ = u, du/dτ = aⁱe_i, de_i/dτ = (a·e_i) u, dR/dτ = ω × R.
    fn derivative(&self, own_time: f64, s: &State, rates: &Rates) -> State {
        let four = |row: usize| [s[row], s[row + 1], s[row + 2], s[row + 3]];
        let (u, axes) = (four(4), [four(8), four(12), four(16)]);
        let a = match self.orbit {
            None if let Some(curve) = &self.curve => {
                if rates.is_on_curve {
                    curve.acceleration(s[0])
                } else {
                    [0.0; 4]
                }
            }
            None => {
                let of = rates.acceleration.to_array();
                (0..3).fold([0.0; 4], |sum, k| plus(sum, of[k], axes[k]))
            }
            Some((center, axis, rate)) => {
                // The circle in the time of the scene, from (cos, sin) of its angle.
                let arm = self.at - center;
                let arm = arm - arm.dot(axis) * axis;
                let speed = rate.abs() * arm.length();
                let own_rate = rate / (1.0 - speed * speed).sqrt();
                let (sin, cos) = libm::sincos(own_rate * own_time);
                let inward = -own_rate * own_rate * (cos * arm + sin * axis.cross(arm));
                [0.0, inward.x, inward.y, inward.z]
            }
        };
        let mut d = [0.0; N_NUMBERS];
        d[..4].copy_from_slice(&u);
        d[4..8].copy_from_slice(&a);
        for k in 0..3 {
            let along = product(a, axes[k]);
            d[8 + 4 * k..12 + 4 * k].copy_from_slice(&u.map(|x| along * x));
        }
        for (spin, column) in rates.spins.iter().flat_map(|spin| [spin; 3]).zip(0..) {
            if *spin != DVec3::ZERO {
                let row = 20 + 3 * column;
                let turned = spin.cross(DVec3::new(s[row], s[row + 1], s[row + 2]));
                d[row..row + 3].copy_from_slice(&turned.to_array());
            }
        }
        d
    }

    fn step(&self, own_time: f64, s: State, rates: &Rates, h: f64) -> State {
        let moved = |d: &State, part: f64| {
            let mut moved = s;
            moved.iter_mut().zip(d).for_each(|(s, d)| *s += part * h * d);
            moved
        };
        let k1 = self.derivative(own_time, &s, rates);
        let k2 = self.derivative(own_time + 0.5 * h, &moved(&k1, 0.5), rates);
        let k3 = self.derivative(own_time + 0.5 * h, &moved(&k2, 0.5), rates);
        let k4 = self.derivative(own_time + h, &moved(&k3, 1.0), rates);
        let mut next = s;
        for (row, x) in next.iter_mut().enumerate() {
            *x += h / 6.0 * (k1[row] + 2.0 * k2[row] + 2.0 * k3[row] + k4[row]);
        }
        next
    }

    fn state(&self, own_time: f64) -> (State, &Rates) {
        let row = self.nodes.partition_point(|node| node.0 <= own_time).max(1) - 1;
        let (known_at, state, rates) = &self.nodes[row];
        assert!(
            (own_time - known_at).abs() < 2.0 * STEP,
            "{own_time} is outside of the integrated time"
        );
        (self.step(*known_at, *state, rates, own_time - known_at), rates)
    }

    /// The own times that are integrated.
    pub fn range(&self) -> [f64; 2] {
        [self.nodes[0].0, self.nodes[self.nodes.len() - 1].0]
    }

    /// A point of the body.
    pub fn moment(&self, point: DVec3, own_time: f64) -> Moment {
        let (s, rates) = self.state(own_time);
        let (mut x, mut swing) = (point, DVec3::ZERO);
        for k in 0..MOST_TURNS {
            let arm = turn(&s, k, x - self.pivots[k]);
            swing = rates.spins[k].cross(arm) + turn(&s, k, swing);
            x = self.pivots[k] + arm;
        }
        let offset = x - self.at;
        let rate = self.derivative(own_time, &s, rates);
        // X = z + ξⁱe_i, so dX/dτ = u + ξⁱ de_i/dτ + (dξ/dτ)ⁱ e_i.
        let (mut event, mut velocity) = (first(&s, 0), first(&s, 4));
        for (k, (xi, swing)) in offset.to_array().into_iter().zip(swing.to_array()).enumerate() {
            event = plus(event, xi, first(&s, 8 + 4 * k));
            velocity =
                plus(plus(velocity, xi, first(&rate, 8 + 4 * k)), swing, first(&s, 8 + 4 * k));
        }
        let norm = -product(velocity, velocity);
        assert!(norm > 0.0, "the point is slower than light");
        Moment { event, velocity: velocity.map(|x| x / norm.sqrt()) }
    }

    /// A vector of the body, (0; R v) in its axes.
    pub fn vector(&self, v: DVec3, own_time: f64) -> Four {
        let (s, _) = self.state(own_time);
        let v = (0..MOST_TURNS).fold(v, |v, k| turn(&s, k, v)).to_array();
        (0..3).fold([0.0; 4], |sum, k| plus(sum, v[k], first(&s, 8 + 4 * k)))
    }

    /// The own time and the point of the body at an event, by Newton's method from `guess`; `None`
    /// near its horizon, or outside of the integrated time.
    pub fn at_event(&self, event: Four, guess: f64) -> Option<(f64, DVec3)> {
        let [begin, end] = self.range();
        let mut own_time = guess;
        for _ in 0..50 {
            if !(begin..=end).contains(&own_time) {
                return None;
            }
            let (s, rates) = self.state(own_time);
            let way = plus(event, -1.0, first(&s, 0));
            let late = -product(way, first(&s, 4));
            let rate = self.derivative(own_time, &s, rates);
            // d/dτ of (X − z)·u is 1 + (X − z)·du/dτ.
            let pace = 1.0 + product(way, first(&rate, 4));
            if pace < 0.05 {
                return None;
            }
            if late.abs() < 1e-13 * own_time.abs().max(1.0) {
                let mut x = self.at
                    + DVec3::new(
                        product(way, first(&s, 8)),
                        product(way, first(&s, 12)),
                        product(way, first(&s, 16)),
                    );
                for k in (0..MOST_TURNS).rev() {
                    x = self.pivots[k] + turned_back(&s, k, x - self.pivots[k]);
                }
                return Some((own_time, x));
            }
            own_time += late / pace;
        }
        None
    }
}

fn start(velocity: DVec3, place: Four) -> State {
    let mut s = [0.0; N_NUMBERS];
    s[..4].copy_from_slice(&place);
    s[4..8].copy_from_slice(&four_velocity(velocity));
    for (k, axis) in
        [[0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]].into_iter().enumerate()
    {
        s[8 + 4 * k..12 + 4 * k].copy_from_slice(&boosted(velocity, axis));
    }
    for k in 0..MOST_TURNS {
        [0, 4, 8].into_iter().for_each(|diagonal| s[20 + 9 * k + diagonal] = 1.0);
    }
    s
}

fn first(s: &State, row: usize) -> Four {
    [s[row], s[row + 1], s[row + 2], s[row + 3]]
}

fn column(s: &State, k: usize, column: usize) -> DVec3 {
    let row = 20 + 9 * k + 3 * column;
    DVec3::new(s[row], s[row + 1], s[row + 2])
}

fn turn(s: &State, k: usize, v: DVec3) -> DVec3 {
    v.x * column(s, k, 0) + v.y * column(s, k, 1) + v.z * column(s, k, 2)
}

fn turned_back(s: &State, k: usize, v: DVec3) -> DVec3 {
    DVec3::new(v.dot(column(s, k, 0)), v.dot(column(s, k, 1)), v.dot(column(s, k, 2)))
}
