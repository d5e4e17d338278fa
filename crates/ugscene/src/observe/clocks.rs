//! Clocks of inertial bodies.
//!
//! The own time of a body is that of the clock of its motion: for an inertial body the time of its
//! rest frame, which is 0 where its reference point is at time 0 of the scene. What
//! a program downstream knows of an inertial body, its velocity and rest positions relative to the
//! eye, does not tell when that was. So tables of colours are changed to count from the event of
//! the eye: light that is seen directly left |p'| before that.

use rustc_hash::FxHashMap;
use ugphysics::{Event, InertialFrame, Lorentz};

use super::MotionError;
use super::placement::Placement;
use crate::{BodyId, Color, ColorId, ColorTable, RelativeMotion, Scene, UniqueNames};

/// For each inertial body, its own time at the event of the eye; 0 for others. `motions`: of each
/// body. `frames`: see [`Placement::frames`].
pub(super) fn times_at_eye(
    (motions, frames): (&[RelativeMotion], &[InertialFrame]),
    placement: &Placement<'_>,
) -> Vec<f64> {
    let time = |(motion, frame): (&RelativeMotion, &InertialFrame)| {
        if motion.world_line().is_some() {
            return 0.0;
        }
        // With `-in`, a body is displaced in its rest frame in space alone, so its clock still
        // shows 0 at time 0 of the scene at the origin.
        let zero = if placement.options.in_place { Event::ORIGIN } else { frame.start() };
        Lorentz::boost(motion.in_scene()).inverse().apply(placement.eye_event() - zero).t
    };
    motions.iter().zip(frames).map(time).collect()
}

/// Makes the tables of colours on inertial bodies count from the event of the eye. `times`: see
/// [`times_at_eye`].
///
/// # Errors
/// [`MotionError::PartialTimes`].
pub(super) fn count_from_eye(
    scene: &mut Scene,
    times: &[f64],
    placement: &Placement<'_>,
) -> Result<(), MotionError> {
    if scene.color_tables.is_empty() {
        return Ok(());
    }
    if !placement.options.geometry.contraction {
        return Err(MotionError::PartialTimes);
    }
    let mut recount = Recount { times, known: FxHashMap::default(), names: None };
    for row in 0..scene.faces.len() {
        let face = &scene.faces[row];
        scene.faces[row].color = recount.color(scene, face.color, face.body);
    }
    for row in 0..scene.wires.len() {
        let wire = &scene.wires[row];
        scene.wires[row].color = recount.color(scene, wire.color, wire.body);
    }
    for row in 0..scene.lights.len() {
        let light = &scene.lights[row];
        if let Some(body) = light.motion.body() {
            scene.lights[row].color = recount.color(scene, light.color, body);
        }
    }
    Ok(())
}

/// Adds the tables of several bodies.
struct Recount<'t> {
    /// For each body, its own time at the event of the eye; 0 on world lines.
    times: &'t [f64],
    /// By colour and the bits of that time.
    known: FxHashMap<(ColorId, u64), ColorId>,
    names: Option<UniqueNames>,
}

impl Recount<'_> {
    fn color(
        &mut self,
        scene: &mut Scene,
        color: Option<ColorId>,
        body: BodyId,
    ) -> Option<ColorId> {
        let id = color?;
        let zero = self.times[body.index()];
        if zero == 0.0 {
            return color;
        }
        if let Some(&known) = self.known.get(&(id, zero.to_bits())) {
            return Some(known);
        }
        let Some(table) = scene.table_of(id) else { return color };
        let table = table.counted_from(zero);
        let original = scene.colors[id.index()].name;
        let all = || scene.colors.iter().map(|color| scene.names.get(color.name)).collect();
        let name = self.names.get_or_insert_with(all).add_copy(original, &mut scene.names);
        let new = ColorId::from_index(scene.colors.len());
        scene.colors.push(Color { name, ..scene.colors[id.index()].clone() });
        // Ids in ascending order, as the scene requires.
        scene.color_tables.push(ColorTable { color: new, ..table });
        self.known.insert((id, zero.to_bits()), new);
        Some(new)
    }
}
