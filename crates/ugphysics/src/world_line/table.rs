//! Motion through the events of a table.
//!
//! Between two rows the place is a cubic polynomial of the time of the scene. Second derivatives
//! agree at the rows; beyond both ends the motion is inertial.
//! Eq. (P48)

use std::sync::Arc;

use glam::{DQuat, DVec3};

use super::pieces::rotation;
use super::range_maximum::RangeMaximum;
use super::spline::{Instant, Row, spline};
use super::{Pose, WorldLineError};
use crate::{Event, Lorentz, Velocity};

/// The world line of a reference point through given events, at whose first its own time is 0.
///
/// The place is a cubic spline of the time of the scene, twice continuously differentiable; before
/// the first event and after the last one the motion is inertial. A copy shares its numbers.
///
/// ```
/// use glam::DVec3;
/// use ugphysics::{Event, SampledPath, WorldLine};
///
/// let row = |t: f64, x: f64| Event { t, x: DVec3::X * x };
/// let path = SampledPath::new(&[row(0.0, 0.0), row(1.0, 0.6), row(2.0, 1.2)])?;
/// let ship = WorldLine::along(DVec3::ZERO, path, &[])?;
/// // A straight line: a clock on it runs 0.8 times as fast as those of the scene.
/// assert!((ship.event(DVec3::ZERO, 4.0)?.t - 5.0).abs() < 1e-14);
/// # Ok::<(), ugphysics::WorldLineError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct SampledPath(Arc<Table>);

#[derive(Debug, PartialEq)]
struct Table {
    rows: Vec<Row>,
    nodes: Vec<Node>,
    /// Of each node, upper bounds of |a| and of |da/dτ| in the carried axes, up to the next one.
    bounds: RangeMaximum,
    velocity: Velocity,
}

/// The begin of a piece that one step of integration crosses.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Node {
    row: u32,
    /// The time since the row.
    passed: f64,
    own_time: f64,
    /// The turn of the carried axes against those of a single boost.
    turn: DQuat,
}

/// From the infinite past to the infinite future.
pub(super) const ALL_TIMES: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];

/// What one step of integration adds.
#[derive(Clone, Copy, Debug)]
struct Step {
    own_time: f64,
    /// The rotation of the carried axes: along its axis, with the angle in radians as length.
    turn: DVec3,
}

/// A step of the sixth order, by the rule of Gauss and Legendre with three nodes. For the turn it
/// is that of Magnus: dR/dt = [ω]× R with ω = γ²/(γ + 1) dv/dt × v (Thomas). Commutators of [a]×
/// and [b]× are [a × b]×, so they are cross products.  Eq. (P48)
fn step(row: &Row, from: f64, to: f64) -> Step {
    let length = to - from;
    let reach = 15.0_f64.sqrt() / 10.0;
    let [first, middle, last] =
        [0.5 - reach, 0.5, 0.5 + reach].map(|part| row.at(from + part * length));
    let own_time = length / 18.0 * (5.0 * (first.lapse() + last.lapse()) + 8.0 * middle.lapse());
    let [first, middle, last] = [first, middle, last].map(|instant| instant.thomas());
    let a = length * middle;
    let b = length * 15.0_f64.sqrt() / 3.0 * (last - first);
    let c = length * 10.0 / 3.0 * (last - 2.0 * middle + first);
    let ab = a.cross(b);
    let bc = a.cross(2.0 * c + ab) / -60.0;
    let turn = a + c / 12.0 + (ab - 20.0 * a - c).cross(b + bc) / 240.0;
    Step { own_time, turn }
}

/// The table while it is computed.
struct Tabulation<'r> {
    rows: &'r [Row],
    nodes: Vec<Node>,
    bounds: Vec<[f64; 2]>,
    own_time: Sum,
    turn: DQuat,
}

/// A sum with its rounding error (Neumaier).
#[derive(Clone, Copy, Debug, Default)]
struct Sum {
    sum: f64,
    rest: f64,
}

impl Sum {
    fn add(&mut self, x: f64) {
        let sum = self.sum + x;
        self.rest += if self.sum >= x { self.sum - sum + x } else { x - sum + self.sum };
        self.sum = sum;
    }
}

impl Tabulation<'_> {
    /// Halvings of the time between two rows, of which the shortest piece is left.
    const MOST_HALVINGS: usize = 40;

    /// The nodes that a path may have beyond those of its rows. Further pieces are not halved.
    const MOST_NODES: usize = 1 << 18;

    /// The relative error of a step.
    const TOLERANCE: f64 = 1e-14;

    /// Adds a part of the time between two rows.
    ///
    /// # Errors
    /// [`WorldLineError::TooFast`] unless the speed is below that of light in all of it.
    fn add(
        &mut self,
        row: usize,
        [from, to]: [f64; 2],
        halvings: usize,
    ) -> Result<(), WorldLineError> {
        let too_fast = WorldLineError::TooFast { row };
        let cubic = &self.rows[row];
        let middle = from.midpoint(to);
        let [start, inside, end] = [from, middle, to].map(|passed| cubic.at(passed));
        let least = start.slowness().min(inside.slowness()).min(end.slowness());
        // NaN fails the comparison.
        if !matches!(
            least.partial_cmp(&SampledPath::LEAST_SLOWNESS),
            Some(core::cmp::Ordering::Greater)
        ) {
            return Err(too_fast);
        }
        let bound = Instant::least_slowness_between(&start, &end, to - from);
        let is_full = self.nodes.len() > self.rows.len() + Self::MOST_NODES;
        let is_precise =
            || bound >= 0.8 * least && self.is_precise(cubic, [from, middle, to], least);
        if if is_full { bound > 0.0 } else { is_precise() } {
            self.push(row, [from, to], (&start, &end), bound);
            return Ok(());
        }
        if is_full || halvings == Self::MOST_HALVINGS {
            return Err(too_fast);
        }
        self.add(row, [from, middle], halvings + 1)?;
        self.add(row, [middle, to], halvings + 1)
    }

    /// Compares a step with two of half its length. `slowness`: the least of 1 − v², whose rounding
    /// error limits the precision.
    fn is_precise(&self, row: &Row, [from, middle, to]: [f64; 3], slowness: f64) -> bool {
        let (whole, first, last) =
            (step(row, from, to), step(row, from, middle), step(row, middle, to));
        let tolerance = Self::TOLERANCE + 2e-15 / slowness;
        let own_time = first.own_time + last.own_time - whole.own_time;
        let halves = rotation(last.turn, 1.0) * rotation(first.turn, 1.0);
        let turn = (halves * rotation(whole.turn, -1.0)).xyz().length();
        own_time.abs() <= tolerance * whole.own_time
            && turn <= tolerance * (first.turn.length() + last.turn.length()) + 1e-15
    }

    fn push(
        &mut self,
        row: usize,
        [from, to]: [f64; 2],
        (start, end): (&Instant, &Instant),
        slowness: f64,
    ) {
        let own_time = self.own_time.sum + self.own_time.rest;
        self.nodes.push(Node { row: row as u32, passed: from, own_time, turn: self.turn });
        // With γ' = γ³ v·a: |a| ≤ γ³|a'| and |da/dτ| ≤ γ⁴|j| + 3γ⁶|a'|², for the second and third
        // derivative a' and j by the time of the scene.
        let gamma = 1.0 / slowness.sqrt();
        let rate = gamma * gamma * gamma * start.second.length().max(end.second.length());
        let jerk = self.rows[row].third.length();
        self.bounds.push(
            [rate, gamma * gamma * gamma * gamma * jerk + 3.0 * rate * rate]
                .map(|x| x * (1.0 + 1e-9)),
        );
        let step = step(&self.rows[row], from, to);
        self.own_time.add(step.own_time);
        self.turn = (rotation(step.turn, 1.0) * self.turn).normalize();
    }
}

impl SampledPath {
    /// The least of 1 − v² that is accepted: γ is at most a million.
    const LEAST_SLOWNESS: f64 = 1e-12;

    /// The most events of a path.
    pub const MOST_EVENTS: usize = 1_000_000;

    /// Bytes of memory for each event while a path is computed and kept, if one piece of
    /// integration is enough between two of them.
    pub const BYTES_PER_EVENT: usize =
        size_of::<Event>() + size_of::<Row>() + size_of::<Node>() + 64;

    /// A number that two paths have in common if they share their memory.
    pub fn address(&self) -> usize {
        Arc::as_ptr(&self.0).addr()
    }

    /// The path through events in the order of their times.
    ///
    /// # Errors
    /// [`WorldLineError::FewEvents`] for fewer than two, [`WorldLineError::NotFinite`],
    /// [`WorldLineError::TimeOrder`] if the times do not increase, and [`WorldLineError::TooFast`]
    /// if the speed, between two of them, too, is not below that of light, up to a factor γ of a
    /// million.
    pub fn new(events: &[Event]) -> Result<Self, WorldLineError> {
        if events.len() < 2 {
            return Err(WorldLineError::FewEvents);
        }
        if let Some(row) = events.windows(2).position(|pair| pair[0].t >= pair[1].t) {
            return Err(WorldLineError::TimeOrder { row });
        }
        let rows = spline(events)?;
        let mut table = Tabulation {
            rows: &rows,
            nodes: Vec::with_capacity(events.len()),
            bounds: Vec::with_capacity(events.len()),
            own_time: Sum::default(),
            turn: DQuat::IDENTITY,
        };
        for (row, pair) in events.windows(2).enumerate() {
            table.add(row, [0.0, pair[1].t - pair[0].t], 0)?;
        }
        let own_time = table.own_time.sum + table.own_time.rest;
        let Tabulation { mut nodes, mut bounds, turn, .. } = table;
        nodes.push(Node { row: rows.len() as u32 - 1, passed: 0.0, own_time, turn });
        bounds.push([0.0; 2]);
        let velocity = Velocity::from_beta(rows[0].at(0.0).velocity)?;
        Ok(Self(Arc::new(Table { rows, nodes, bounds: RangeMaximum::new(bounds), velocity })))
    }

    /// The events that it passes.
    pub fn events(&self) -> impl Iterator<Item = Event> + '_ {
        self.0.rows.iter().map(|row| row.event)
    }

    /// At own time 0.
    pub(super) fn velocity(&self) -> Velocity {
        self.0.velocity
    }

    /// The own time at the last event.
    pub(super) fn end(&self) -> f64 {
        self.0.nodes[self.0.nodes.len() - 1].own_time
    }

    /// Upper bounds of |a| and |da/dτ| between two own times.
    pub(super) fn bounds(&self, [from, to]: [f64; 2]) -> [f64; 2] {
        let nodes = &self.0.nodes;
        let first = nodes.partition_point(|node| node.own_time <= from).max(1) - 1;
        let end = nodes.partition_point(|node| node.own_time < to);
        self.0.bounds.of(first..end)
    }

    /// The motion at an own time, and the turn of the carried axes there.
    fn state(&self, own_time: f64) -> (Event, Instant, DQuat) {
        let Table { rows, nodes, .. } = &*self.0;
        let node = nodes.partition_point(|node| node.own_time <= own_time);
        let straight = |row: &Row, late: f64, turn: DQuat| {
            let instant = Instant { second: DVec3::ZERO, ..row.at(0.0) };
            let passed = late / instant.lapse();
            let event =
                Event { t: row.event.t + passed, x: row.event.x + passed * instant.velocity };
            (event, instant, turn)
        };
        if node == 0 {
            return straight(&rows[0], own_time, DQuat::IDENTITY);
        }
        let (Node { row, passed, own_time: start, turn }, next) =
            (nodes[node - 1], nodes.get(node));
        let row = &rows[row as usize];
        let late = own_time - start;
        let Some(next) = next else { return straight(row, late, turn) };
        let end = if next.passed > 0.0 {
            next.passed
        } else {
            rows[next.row as usize].event.t - row.event.t
        };
        let now = time_after(row, [passed, end], late / (next.own_time - start), late);
        let turned = step(row, passed, now).turn;
        let turn = if turned == DVec3::ZERO { turn } else { rotation(turned, 1.0) * turn };
        (row.event_at(now), row.at(now), turn)
    }

    /// The pose and the proper acceleration in the carried axes.
    pub(super) fn pose(&self, own_time: f64) -> (Pose, DVec3) {
        let (event, instant, turn) = self.state(own_time);
        let acceleration = turn.conjugate() * instant.proper_acceleration();
        // Its speed was checked.
        let velocity = Velocity::from_beta(instant.velocity).unwrap_or(self.0.velocity);
        let scene_from_axes = Lorentz::boost(velocity) * Lorentz::rotation(turn);
        (Pose { event, scene_from_axes, turn: DQuat::IDENTITY }, acceleration)
    }
}

/// The time since a row at which `late` of own time has passed since the begin of a piece, by
/// Newton's method within a bracket. `part`: of the own time of the piece.
fn time_after(row: &Row, [begin, end]: [f64; 2], part: f64, late: f64) -> f64 {
    const MOST_STEPS: usize = 60;
    let (mut low, mut high) = (begin, end);
    let mut now = begin + part * (end - begin);
    for _ in 0..MOST_STEPS {
        let missing = late - step(row, begin, now).own_time;
        if missing > 0.0 {
            low = now;
        } else {
            high = now;
        }
        let newton = now + missing / row.at(now).lapse();
        let next = if newton >= low && newton <= high { newton } else { low.midpoint(high) };
        let moved = (next - now).abs();
        now = next;
        // The error after a step is about its square, in units of the piece.
        if moved <= 1e-9 * (end - begin) {
            break;
        }
    }
    now
}
