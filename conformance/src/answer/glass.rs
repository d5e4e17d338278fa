//! Questions about light in moving glass.

use glam::DVec3;
use ugphysics::{Event, Lorentz, Medium, Velocity, WaveVector};

use super::light::behind;
use super::numbers::{Answer, along_x, exactly, list, velocity};

pub const KINDS: &[(&str, Answer)] = &[
    ("glass_speed", |given| {
        let [index, speed] = exactly(given)?;
        let glass = Medium { index, velocity: along_x(speed)? };
        let light = WaveVector { frequency: 1.0, k: index * DVec3::X }.in_frame(-glass.velocity);
        let step = glass.step(light);
        (index > 1.0).then(|| vec![step.x.x / step.t])
    }),
    ("glass_slab", |given| {
        let [index, thickness, speed] = exactly(given)?;
        let exit = slab_exit(DVec3::X, DVec3::X, index, thickness, along_x(speed)?)?;
        Some(vec![exit.t, exit.x.x, exit.t - exit.x.x])
    }),
    ("slab_exit", |given| {
        let [nx, ny, nz, ux, uy, uz, mx, my, mz, index, thickness] = exactly(given)?;
        let normal = DVec3::new(mx, my, mz).normalize_or_zero();
        let v = velocity(DVec3::new(ux, uy, uz))?;
        let exit = slab_exit(DVec3::new(nx, ny, nz), normal, index, thickness, v)?;
        Some([&[exit.t], &exit.x.to_array()[..]].concat())
    }),
    ("slab_out", |given| {
        let [nx, ny, nz, ux, uy, uz, mx, my, mz, index] = exactly(given)?;
        let normal = DVec3::new(mx, my, mz).normalize_or_zero();
        let v = velocity(DVec3::new(ux, uy, uz))?;
        let there = WaveVector::in_vacuum(1.0, DVec3::new(nx, ny, nz)).in_frame(v);
        let inside = behind(index, there, normal)?;
        let out = behind(1.0, inside, normal)?.in_frame(-v);
        Some(list(out.k / out.frequency, &[out.frequency]))
    }),
];

/// The event at which light that travels along `direction` and enters a slab at event 0 leaves it.
/// The slab moves with `v`.  Eq. (P35)
fn slab_exit(direction: DVec3, normal: DVec3, index: f64, thickness: f64, v: Velocity) -> Option<Event> {
    let inside = behind(index, WaveVector::in_vacuum(1.0, direction).in_frame(v), normal)?.k.normalize();
    let path = thickness / inside.dot(normal).abs();
    Some(Lorentz::boost(v).apply(Event { t: path * index, x: path * inside }))
}
