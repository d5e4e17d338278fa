//! Colours that change with own time, of faces and wires.
//!
//! Where light left later, a colour is seen later in its table. Edges are halved until the colour
//! interpolated between their ends is right within a bound, sampled as the errors of bodies on
//! world lines are; where a colour jumps, or changes faster than a picture shows, until they are so
//! short that the blur is about that of a pixel. Then every vertex gets the colour that its point
//! had when its light left.

use std::collections::BTreeMap;

use glam::DVec3;
use rustc_hash::{FxHashMap, FxHashSet};
use uglight::{RestColor, mean_color};
use ugscene::{BodyId, Color, ColorId, ColorTable, FaceOrWire, Mix, Scene};

use crate::attributes::free_prefix;
use crate::relative_motion::{Point, RelativeMotion};
use crate::tables::{Tables, common, table_row};
use crate::world_line::is_short;

/// Where an edge is sampled.
const SAMPLES: [f64; 3] = [0.25, 0.5, 0.75];

/// The factor on sampled errors.
const MARGIN: f64 = 1.5;

/// At an edge where more tables meet, as many are tested: so work is not quadratic in faces of one
/// place. Edges and points inside faces are tested with the table of their face alone.
const MOST_TABLES: usize = 64;

/// The prefix of the names of new colours.
const PREFIX: &str = "t#";

/// The tables of the faces and wires.
#[derive(Clone, Debug, Default)]
pub(crate) struct Clocks {
    /// By row in the scene; `None` for those of one colour.
    lights: Vec<Option<Lights>>,
    /// Of each body, whether a colour changes; empty if none does.
    changes: Vec<bool>,
    /// The bound of the error of the light, as a part of the brightest of a table; infinite for
    /// none.
    bound: f64,
}

/// The light of the colours of a table.
#[derive(Clone, Debug)]
struct Lights {
    table: ColorTable,
    linear: BTreeMap<ColorId, DVec3>,
    /// The largest component of all.
    brightest: f64,
}

impl Clocks {
    /// `bound`: of the error of light; infinite for none.
    pub(crate) fn new(scene: &Scene, bound: f64) -> Self {
        if !scene.has_changing_surfaces() {
            return Self::default();
        }
        let lights: Vec<_> =
            scene.color_tables.iter().map(|table| Lights::new(scene, table)).collect();
        let mut changes = vec![false; scene.bodies.len()];
        for FaceOrWire { body, color, .. } in scene.drawn() {
            changes[body.index()] |=
                table_row(scene, color).is_some_and(|row| lights[row].is_some());
        }
        Self { lights, changes, bound }
    }

    /// True if no colour of this body changes.
    pub(crate) fn are_still(&self, body: BodyId) -> bool {
        !self.changes.get(body.index()).is_some_and(|&changes| changes)
    }

    /// Is the colour of a table wrong, interpolated along an edge? The ends must always be given in
    /// the same order. `tables`: of the ends. `tan_half`: of the bound of the outline.
    pub(crate) fn is_off(
        &self,
        [a, b]: [&Point; 2],
        tables: [&Tables; 2],
        motion: &RelativeMotion,
        tan_half: f64,
    ) -> bool {
        if self.are_still(a.body) || self.bound == f64::INFINITY || is_short(a, b, tan_half) {
            return false;
        }
        let ends = [a, b].map(|end| end.own_time);
        let tables = common(&tables);
        SAMPLES.into_iter().any(|s| {
            let point = Point::between(motion, a, b, s);
            let chord = b.seen - a.seen;
            let along = (point.seen - a.seen).dot(chord) / chord.length_squared();
            let along = if along.is_finite() { along.clamp(0.0, 1.0) } else { s };
            let is_off = |lights: &Lights| {
                lights.is_off(ends, [1.0 - along, along], point.own_time, self.bound)
            };
            self.lights(&tables).any(is_off)
        })
    }

    /// Is the colour at the middle of a triangle wrong?
    pub(crate) fn is_off_inside(
        &self,
        corners: [&Point; 3],
        tables: [&Tables; 3],
        motion: &RelativeMotion,
        tan_half: f64,
    ) -> bool {
        let [a, b, c] = corners;
        if self.are_still(a.body) || self.bound == f64::INFINITY {
            return false;
        }
        if [(a, b), (b, c), (c, a)].into_iter().all(|(a, b)| is_short(a, b, tan_half)) {
            return false;
        }
        let point = Point::middle(motion, corners);
        let (ends, weights) = (corners.map(|corner| corner.own_time), [1.0 / 3.0; 3]);
        let is_off = |lights: &Lights| lights.is_off(ends, weights, point.own_time, self.bound);
        self.lights(&common(&tables)).any(is_off)
    }

    fn lights(&self, tables: &[u32]) -> impl Iterator<Item = &Lights> {
        tables.iter().take(MOST_TABLES).filter_map(|&row| self.lights[row as usize].as_ref())
    }
}

impl Lights {
    fn new(scene: &Scene, table: &ColorTable) -> Option<Self> {
        let mut linear = BTreeMap::new();
        for &(_, color) in &table.rows {
            linear.entry(color).or_insert_with(|| RestColor::new(scene, Some(color)).linear());
        }
        let brightest = linear.values().map(|light| light.abs().max_element()).fold(0.0, f64::max);
        // One colour does not change.
        (linear.len() > 1).then(|| Self { table: table.clone(), linear, brightest })
    }

    fn light(&self, own_time: f64) -> DVec3 {
        let parts = self.table.at(own_time).parts;
        parts.into_iter().map(|(color, share)| share * self.linear[&color]).sum()
    }

    /// Does a colour interpolated between corners with these own times and weights differ from that
    /// at `own_time`?
    fn is_off<const N: usize>(
        &self,
        corners: [f64; N],
        weights: [f64; N],
        own_time: f64,
        bound: f64,
    ) -> bool {
        let place = self.table.at(own_time);
        let number = |cycle: f64, row: i64| cycle * self.table.rows.len() as f64 + row as f64;
        let here = number(place.cycle, place.row);
        // Between two rows that are neighbours, samples show the error.
        let most = if self.table.is_stepped { 0.0 } else { 1.0 };
        let is_far = |time: f64| {
            let corner = self.table.at(time);
            (number(corner.cycle, corner.row) - here).abs() > most
        };
        if corners.into_iter().any(is_far) {
            return true;
        }
        if self.table.is_stepped {
            return false;
        }
        let drawn: DVec3 =
            corners.into_iter().zip(weights).map(|(time, part)| part * self.light(time)).sum();
        MARGIN * (drawn - self.light(own_time)).abs().max_element() > bound * self.brightest
    }
}

/// Gives the corners of faces and wires whose colour changes the colour that they had when their
/// light left. `times`: of each vertex, see [`Point::own_time`]. Only lights keep their tables.
pub(crate) fn show(scene: &mut Scene, mut times: Vec<f64>) {
    if !scene.has_changing_surfaces() {
        return;
    }
    let changing = |color: Option<ColorId>| color.filter(|&color| scene.table_of(color).is_some());
    let users: Vec<_> =
        scene.drawn().map(|drawn| (drawn.contours, changing(drawn.color))).collect();
    let rows = users.iter().map(|(rows, _)| rows.clone());
    let copies = ugscene::split_corners(scene, rows, |user, _, vertex| {
        vertex.color.is_none().then_some(users[user].1)
    });
    times.extend(copies.into_iter().map(|original| times[original.index()]).collect::<Vec<_>>());
    let mut painter = Painter::new(scene);
    for (rows, table) in users {
        let Some(table) = table.and_then(|color| scene.table_of(color)).cloned() else { continue };
        for idx in 0..scene.contours.corners(rows.clone()).len() {
            let corner = scene.contours.corners(rows.clone())[idx].index();
            if scene.vertices[corner].color.is_none() {
                scene.vertices[corner].color =
                    Some(painter.color(scene, table.at(times[corner]).parts));
            }
        }
    }
    let emitted = scene.emissions.iter().map(|emission| emission[1]);
    let lights: FxHashSet<ColorId> =
        scene.lights.iter().filter_map(|light| light.color).chain(emitted).collect();
    scene.color_tables.retain(|table| lights.contains(&table.color));
}

/// Statements of the colours between two others. Equal ones share a statement.
struct Painter {
    prefix: String,
    known: FxHashMap<(ColorId, ColorId, u64), ColorId>,
    rest: FxHashMap<ColorId, RestColor>,
}

impl Painter {
    fn new(scene: &Scene) -> Self {
        let names = scene.colors.iter().map(|color| scene.names.get(color.name));
        let prefix = free_prefix(PREFIX, names);
        Self { prefix, known: FxHashMap::default(), rest: FxHashMap::default() }
    }

    fn color(&mut self, scene: &mut Scene, parts: [(ColorId, f64); 2]) -> ColorId {
        let [(a, _), (b, share)] = parts;
        if share == 0.0 {
            return a;
        }
        if let Some(&known) = self.known.get(&(a, b, share.to_bits())) {
            return known;
        }
        let mut rest = |id| *self.rest.entry(id).or_insert_with(|| RestColor::new(scene, Some(id)));
        let mean = mean_color(parts.map(|(id, share)| (rest(id), share)));
        let name = scene.names.add_parts(&[&self.prefix, &(self.known.len() + 1).to_string()]);
        let color = ColorId::from_index(scene.colors.len());
        scene.colors.push(Color { name, value: mean.value(), translucency: mean.translucency });
        // Colours in ascending order, as the scene requires.
        scene.mixes.push(Mix { color, parts: parts.to_vec() });
        self.known.insert((a, b, share.to_bits()), color);
        color
    }
}
