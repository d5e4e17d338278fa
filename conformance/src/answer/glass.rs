//! Questions about light in moving glass.

use glam::DVec3;
use ugphysics::{Slab, Wave, light_in_glass, refract};

use super::numbers::{Answer, along_x, exactly, list, velocity};

pub const KINDS: &[(&str, Answer)] = &[
    ("glass_speed", |given| {
        let [index, speed] = exactly(given)?;
        Some(vec![light_in_glass(DVec3::X, index, along_x(speed)?)?.beta().x])
    }),
    ("glass_slab", |given| {
        let [index, thickness, speed] = exactly(given)?;
        let exit = Slab { normal: DVec3::X, thickness, index }.exit(DVec3::X, along_x(speed)?);
        Some(vec![exit.t, exit.x.x, exit.t - exit.x.x])
    }),
    ("slab_exit", |given| {
        let [nx, ny, nz, ux, uy, uz, mx, my, mz, index, thickness] = exactly(given)?;
        let normal = DVec3::new(mx, my, mz).normalize_or_zero();
        let v = velocity(DVec3::new(ux, uy, uz))?;
        let exit = Slab { normal, thickness, index }.exit(DVec3::new(nx, ny, nz), v);
        Some([&[exit.t], &exit.x.to_array()[..]].concat())
    }),
    ("slab_out", |given| {
        let [nx, ny, nz, ux, uy, uz, mx, my, mz, index] = exactly(given)?;
        let normal = DVec3::new(mx, my, mz).normalize_or_zero();
        let v = velocity(DVec3::new(ux, uy, uz))?;
        let there = Wave { frequency: 1.0, direction: DVec3::new(nx, ny, nz) }.in_frame(v);
        let inside = refract(there.direction, normal, 1.0 / index)?;
        let out = Wave { direction: refract(inside, normal, index)?, ..there }.out_of_frame(v);
        Some(list(out.direction, &[out.frequency]))
    }),
];
