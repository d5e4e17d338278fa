//! The top level over rest frames: which of them rays may meet.
//!
//! In the frame of the camera the bounding box of bodies with one velocity v moves with them: at a
//! time t after a reference time it reaches from low + v t to high + v t. A node of the hierarchy
//! bounds several such boxes. Let low and high be the bounds of their corners at the reference
//! time, and v₀ and v₁ those of their velocities. Then the node reaches from low + v₁ t to
//! high + v₀ t before the reference time (t ≤ 0), and from low + v₀ t to high + v₁ t after it.
//!
//! Time and position along a ray are linear in its parameter. So on each side of the reference time
//! the ray is inside a node where six linear functions of the parameter are positive. The reference
//! time is that at which light left bodies at the mean distance.
//!
//! # Why no hit is lost
//!
//! The hierarchy of a part finds hits within 2⁻³⁰ sizes of the part and 2⁻⁵⁰ times the distance of
//! the ray's origin ([`ugbvh`]), in the rest frame. An event is carried there with errors of a few
//! 2⁻⁵³ γ times its distance from the eye, and back with 2⁻⁵³ γ² times it. None of them becomes
//! greater in the frame of the camera, where lengths are contracted. Boxes are extended by more
//! than that, and velocities likewise, for times far in the past: [`SLACK`] γ² of all distances.
//! If γ is so large that an extension is not a finite number, the box is infinite: its part is
//! tested with every ray.

use std::ops::Range;

use glam::DVec3;
use ugphysics::Event;

/// Children of a node.
const WIDTH: usize = 8;

/// Rounding errors relative to γ² and to the distances from the eye are far below it: 2⁻⁴⁰.
const SLACK: f64 = 1.0 / (1_u64 << 40) as f64;

/// Hits are this close to a box, in sizes of the box: more than 2⁻³⁰.
const TOLERANCE: f64 = 1e-8;

/// The part of a parameter of a ray by which rounding may have changed it.
const ROUNDING: f64 = 1e-9;

/// Times at which bodies are seen differ from the reference time by about this part of it.
const SPREAD: f64 = 0.25;

/// Marks a child that is a part.
const IS_PART: u32 = 1 << 31;

/// Most entries of a stack: seven of each level and one, for the levels of 2³¹ parts.
const MOST_ENTRIES: usize = 7 * 12 + 1;

/// The box around bodies of one velocity.
#[derive(Clone, Copy, Debug)]
pub struct MovingBox {
    low: DVec3,
    high: DVec3,
    /// In the frame of the camera.
    velocity: DVec3,
    slack: f64,
}

impl MovingBox {
    /// The box of an empty body, which no ray crosses.
    pub const EMPTY: Self =
        Self { low: DVec3::INFINITY, high: DVec3::NEG_INFINITY, velocity: DVec3::ZERO, slack: 0.0 };

    /// `corners`: at the moment of the picture, in the frame of the camera. `size` and `reach`: the
    /// size of the bodies and their greatest coordinate, in the rest frame.
    pub fn new(corners: [DVec3; 8], velocity: DVec3, gamma: f64, size: f64, reach: f64) -> Self {
        let slack = SLACK * gamma * gamma;
        let margin = DVec3::splat(TOLERANCE * size + slack * reach);
        let low = corners.into_iter().fold(DVec3::INFINITY, DVec3::min) - margin;
        let high = corners.into_iter().fold(DVec3::NEG_INFINITY, DVec3::max) + margin;
        // NaN fails every comparison.
        if slack < 1.0 && low.is_finite() && high.is_finite() {
            Self { low, high, velocity, slack }
        } else {
            Self {
                low: DVec3::NEG_INFINITY,
                high: DVec3::INFINITY,
                velocity: DVec3::ZERO,
                slack: 1.0,
            }
        }
    }

    /// The common data of similar boxes: the centre at the reference time, `time` before the
    /// picture, and how far they move meanwhile.
    fn key(&self, axis: usize, time: f64) -> f64 {
        match axis {
            0..3 => self.low[axis] / 2.0 + self.high[axis] / 2.0 - self.velocity[axis] * time,
            _ => self.velocity[axis - 3] * (time * SPREAD),
        }
    }
}

/// A hierarchy of moving boxes.
#[derive(Debug)]
pub struct MovingBoxes {
    /// The reference time, so long before the picture.
    time: f64,
    /// The root comes first.
    nodes: Vec<Node>,
}

/// Up to eight moving boxes around parts.
#[derive(Clone, Debug)]
struct Node {
    /// x, y and z of each child at the reference time. Where there is no child they are +∞ and −∞,
    /// which no ray crosses.
    low: [[f64; WIDTH]; 3],
    high: [[f64; WIDTH]; 3],
    /// Bounds of the velocities, with their slack.
    slowest: [[f64; WIDTH]; 3],
    fastest: [[f64; WIDTH]; 3],
    slack: [f64; WIDTH],
    /// Rows of nodes, or of parts if [`IS_PART`] is set.
    children: [u32; WIDTH],
}

/// A ray into the past, or several with origins and steps close to each other.
#[derive(Clone, Copy, Debug)]
pub struct Rays {
    /// Bounds of their origins.
    from: Event,
    to: Event,
    /// Bounds of their steps for each unit of time.
    low: DVec3,
    high: DVec3,
    /// The greatest coordinate of an origin.
    reach: f64,
}

impl Rays {
    /// A ray: `step` is a step of it into the past. Returns `None` for a ray that is not in the
    /// past of the picture.
    pub fn from_step(origin: Event, step: Event) -> Option<Self> {
        let direction = step.x / -step.t;
        let is_past = step.t < 0.0 && direction.is_finite();
        is_past.then(|| Self::bounded([origin; 2], [direction; 2])).flatten()
    }

    /// Rays of light from the eye, in directions of any length but 0.
    pub fn from_eye(directions: impl Iterator<Item = DVec3>) -> Option<Self> {
        let bounds = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let (low, high) = directions.fold(bounds, |(low, high), direction| {
            let unit = direction / direction.length();
            (low.min(unit), high.max(unit))
        });
        let is_finite = low.is_finite() && high.is_finite();
        is_finite.then(|| Self::bounded([Event::ORIGIN; 2], [low, high])).flatten()
    }

    /// Rays with the least and greatest coordinates and times of their origins, and steps for each
    /// unit of time. Returns `None` if an origin may be after the picture.
    fn bounded([from, to]: [Event; 2], [low, high]: [DVec3; 2]) -> Option<Self> {
        let reach = from.x.abs().max(to.x.abs()).max_element().max(-from.t);
        let is_past = to.t <= 0.0 && reach.is_finite();
        is_past.then_some(Self { from, to, low, high, reach })
    }

    /// Rays whose origins and steps differ from those of a single one by up to `margin` and
    /// `turn`.
    pub fn around(&self, margin: f64, turn: f64) -> Option<Self> {
        let (from, to) = (self.from, self.to);
        // Times of a surface that is seen at once differ by as much as its distances.
        let origins = [
            Event { t: from.t - 2.0 * margin, x: from.x - margin },
            Event { t: (to.t + 2.0 * margin).min(0.0), x: to.x + margin },
        ];
        Self::bounded(origins, [self.low - turn, self.high + turn])
    }

    /// The greatest coordinate of an origin, or time before the picture.
    pub fn reach(&self) -> f64 {
        self.reach
    }

    /// True if it bounds all other rays, too.
    pub fn contains(&self, other: &Self) -> bool {
        let is_ascending = |low: DVec3, high: DVec3| low.cmple(high).all();
        self.from.t <= other.from.t
            && other.to.t <= self.to.t
            && is_ascending(self.from.x, other.from.x)
            && is_ascending(other.to.x, self.to.x)
            && is_ascending(self.low, other.low)
            && is_ascending(other.high, self.high)
    }
}

impl MovingBoxes {
    /// A hierarchy whose parts are the rows of `boxes`, which are fewer than 2³¹. The first 2³¹
    /// count.
    pub fn new(boxes: &[MovingBox]) -> Self {
        let mut rows: Vec<u32> = (0..boxes.len().min(IS_PART as usize) as u32).collect();
        // Light arrives from boxes at a typical distance after that time.
        let distances = boxes.iter().map(|part| {
            let center = DVec3::from_array([0, 1, 2].map(|axis| part.key(axis, 0.0)));
            if center.is_finite() { center.length() } else { 0.0 }
        });
        let time = distances.sum::<f64>() / boxes.len().max(1) as f64;
        let time = if time.is_finite() { time } else { 0.0 };
        let mut tree = Self { time, nodes: Vec::new() };
        tree.build(boxes, &mut rows);
        tree
    }

    /// Appends a node for these rows and all below it. Returns its index.
    fn build(&mut self, boxes: &[MovingBox], rows: &mut [u32]) -> u32 {
        let idx = self.nodes.len();
        self.nodes.push(Node::EMPTY);
        for (child, rows) in groups(boxes, rows, self.time).into_iter().enumerate() {
            for &row in &*rows {
                self.nodes[idx].extend(child, &boxes[row as usize], self.time);
            }
            let row = match rows {
                [row] => *row | IS_PART,
                rows => self.build(boxes, rows),
            };
            self.nodes[idx].children[child] = row;
        }
        idx as u32
    }

    /// Calls `visit` with the parts that a ray may meet at times `range` before its origin, roughly
    /// the nearest first. `visit` returns the end of the range from then on.
    pub fn visit_nearest(
        &self,
        rays: &Rays,
        range: Range<f64>,
        mut visit: impl FnMut(usize) -> f64,
    ) {
        let (start, mut end) = (range.start * (1.0 - ROUNDING), range.end * (1.0 + ROUNDING));
        let turns = [rays.from.t + self.time, rays.to.t + self.time];
        let [before_turn, behind_turn] = [turns[0] * (1.0 - ROUNDING), turns[1] * (1.0 + ROUNDING)];
        let mut stack = [(0.0, 0); MOST_ENTRIES];
        let mut n = 1;
        while n > 0 {
            n -= 1;
            let (near, row) = stack[n];
            if near > end {
                continue;
            }
            if row & IS_PART != 0 {
                end = visit((row & !IS_PART) as usize) * (1.0 + ROUNDING);
                continue;
            }
            let node = &self.nodes[row as usize];
            let first = n;
            let mut entries = [f64::INFINITY; WIDTH];
            if before_turn < end {
                let limits = [if before_turn > start { before_turn } else { start }, end];
                node.enter(rays, turns, [&node.slowest, &node.fastest], limits, &mut entries);
            }
            if behind_turn > start {
                let limits = [start, if behind_turn < end { behind_turn } else { end }];
                node.enter(rays, turns, [&node.fastest, &node.slowest], limits, &mut entries);
            }
            for (child, near) in entries.into_iter().enumerate() {
                if near < f64::INFINITY {
                    // The nearest is popped first.
                    let mut at = n;
                    while at > first && stack[at - 1].0 < near {
                        stack[at] = stack[at - 1];
                        at -= 1;
                    }
                    stack[at] = (near, node.children[child]);
                    n += 1;
                }
            }
        }
    }

    /// The parts that rays may meet at times `range` before their origin, in ascending order.
    pub fn find(&self, rays: &Rays, range: Range<f64>, found: &mut Vec<usize>) {
        found.clear();
        let end = range.end;
        self.visit_nearest(rays, range, |part| {
            found.push(part);
            end
        });
        found.sort_unstable();
    }
}

/// Divides rows into up to eight groups of similar boxes, of equal size up to one.
fn groups<'r>(boxes: &[MovingBox], rows: &'r mut [u32], time: f64) -> Vec<&'r mut [u32]> {
    let mut groups = vec![rows];
    while groups.len() < WIDTH {
        let largest = (0..groups.len())
            .filter(|&idx| groups[idx].len() > 1)
            .reduce(|best, idx| if groups[idx].len() > groups[best].len() { idx } else { best });
        let Some(largest) = largest else { break };
        let group = groups.swap_remove(largest);
        let extent = |key: usize| {
            let keys = group.iter().map(|&row| boxes[row as usize].key(key, time));
            let (low, high) = keys.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), key| {
                (f64::min(low, key), f64::max(high, key))
            });
            high - low
        };
        let widest = (0..6).reduce(|best, key| if extent(key) > extent(best) { key } else { best });
        let key = |row: u32| boxes[row as usize].key(widest.unwrap_or(0), time);
        let half = group.len() / 2;
        group.select_nth_unstable_by(half, |&a, &b| key(a).total_cmp(&key(b)).then(a.cmp(&b)));
        let (low, high) = group.split_at_mut(half);
        groups.extend([low, high]);
    }
    groups
}

impl Node {
    const EMPTY: Self = Self {
        low: [[f64::INFINITY; WIDTH]; 3],
        high: [[f64::NEG_INFINITY; WIDTH]; 3],
        slowest: [[2.0; WIDTH]; 3],
        fastest: [[-2.0; WIDTH]; 3],
        slack: [0.0; WIDTH],
        children: [0; WIDTH],
    };

    /// Extends a child by a box.
    fn extend(&mut self, child: usize, part: &MovingBox, time: f64) {
        let margin = part.slack * time;
        for axis in 0..3 {
            let moved = part.velocity[axis] * time;
            let at = |side: &[[f64; WIDTH]; 3]| side[axis][child];
            self.low[axis][child] = f64::min(at(&self.low), part.low[axis] - moved - margin);
            self.high[axis][child] = f64::max(at(&self.high), part.high[axis] - moved + margin);
            self.slowest[axis][child] =
                f64::min(at(&self.slowest), part.velocity[axis] - part.slack);
            self.fastest[axis][child] =
                f64::max(at(&self.fastest), part.velocity[axis] + part.slack);
        }
        self.slack[child] = f64::max(self.slack[child], part.slack);
    }

    /// Reduces entries to the times before the origin, within limits, at which rays may enter each
    /// child. `turns`: bounds of the reference time before the origins. `of_high`, `of_low`: the
    /// velocities of the upper sides and of the lower sides.
    #[inline]
    fn enter(
        &self,
        rays: &Rays,
        turns: [f64; 2],
        [of_high, of_low]: [&[[f64; WIDTH]; 3]; 2],
        [start, end]: [f64; 2],
        entries: &mut [f64; WIDTH],
    ) {
        let mut near = [start; WIDTH];
        let mut far = [end; WIDTH];
        for axis in 0..3 {
            let (from, to) = (rays.from.x[axis], rays.to.x[axis]);
            for child in 0..WIDTH {
                let margin = self.slack[child] * rays.reach;
                // Where the coordinate of a ray is not below the box: rate × time ≥ bound.
                let velocity = of_low[axis][child];
                let [a, b] = turns.map(|turn| velocity * turn);
                let bound = self.low[axis][child] + if a < b { a } else { b } - to - margin;
                limit(rays.high[axis] + velocity, bound, &mut near[child], &mut far[child]);
                // Where it is not above: both with the opposite sign.
                let velocity = of_high[axis][child];
                let [a, b] = turns.map(|turn| velocity * turn);
                let bound = self.high[axis][child] + if a < b { b } else { a } - from + margin;
                limit(-(rays.low[axis] + velocity), -bound, &mut near[child], &mut far[child]);
            }
        }
        for child in 0..WIDTH {
            let is_nearer = near[child] <= far[child] && near[child] < entries[child];
            entries[child] = if is_nearer { near[child] } else { entries[child] };
        }
    }
}

/// Limits times to those for which rate × time ≥ bound.
#[inline(always)]
fn limit(rate: f64, bound: f64, near: &mut f64, far: &mut f64) {
    // Without a rate nothing is limited, which is rare, and NaN fails comparisons.
    let at = bound / rate;
    *near = if rate > 0.0 && at > *near { at } else { *near };
    *far = if rate < 0.0 && at < *far { at } else { *far };
}
