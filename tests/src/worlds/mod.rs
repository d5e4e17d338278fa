//! Laws that need no reference: what must be the same in pictures of random worlds.
//!
//! A world has several bodies, lamps and a camera, each with a motion of its own; it follows from a
//! number. A [`Law`] draws pictures of a world that have to agree, because of how light behaves and
//! not because of how the programs compute it. [`spacetime`] has the changes of frame that this
//! needs, by 4×4 matrices.
//!
//! Pixels are compared at samples, one a pixel. The same rays, computed in another frame or order,
//! differ by rounding, so only a ray that passes an edge by less than that may see something else.

mod accelerated;
mod compare;
mod frames;
mod generate;
mod light;
mod mirror;
mod parts;
pub mod picture;
mod renderers;
mod solids;
pub mod spacetime;
mod unseen;
pub mod world;

use std::panic::{AssertUnwindSafe, catch_unwind};

use ugtesting::Random;

/// The number of pixels that were compared and are not black, or what does not hold.
pub type Outcome = Result<usize, String>;

/// A law.
#[derive(Clone, Copy, Debug)]
pub struct Law {
    /// Its name on the command line.
    pub name: &'static str,
    /// Checks it in a random world.
    check: fn(&mut Random) -> Outcome,
    /// How many worlds the tests have time for.
    pub worlds: u64,
}

impl Law {
    /// Checks the law in the world of this number.
    ///
    /// # Errors
    /// A violation, with commands and scenes to draw it by hand.
    pub fn check(&self, seed: u64) -> Outcome {
        let mut random = Random(seed.wrapping_mul(0x2545_f491_4f6c_dd1d) ^ 0x5eed);
        let found = catch_unwind(AssertUnwindSafe(|| (self.check)(&mut random)));
        let found = found.unwrap_or_else(|_| Err("panics".to_owned()));
        found.map_err(|finding| format!("{} {seed}: {finding}", self.name))
    }
}

const fn law(name: &'static str, check: fn(&mut Random) -> Outcome, worlds: u64) -> Law {
    Law { name, check, worlds }
}

/// All laws.
pub const LAWS: &[Law] = &[
    law("mirror", mirror::mirror, 40),
    law("mirror-with-moving-lamps", mirror::mirror_with_moving_lamps, 40),
    law("unseen-bodies", unseen::unseen_bodies, 10),
    law("unused-statements", unseen::unused_statements, 6),
    law("instances", unseen::instances, 6),
    law("boosts", frames::boosts, 12),
    law("turns", frames::turns, 8),
    law("parity", frames::parity, 6),
    law("passing-eyes", frames::passing_eyes, 30),
    law("vacuum", solids::vacuum, 10),
    law("nested", solids::nested, 10),
    law("delay", solids::delay, 60),
    law("hollow", solids::hollow, 60),
    law("under-water", solids::under_water, 60),
    law("sums-of-spectra", light::sums_of_spectra, 4),
    law("sums-of-quantities", light::sums_of_quantities, 6),
    law("powers-of-doppler", light::powers_of_doppler, 30),
    law("crops", parts::crops, 6),
    law("stereo", parts::stereo, 6),
    law("film-shutter", parts::film_shutter, 10),
    law("lenses", parts::lenses, 10),
    law("looked-up", parts::looked_up, 2),
    law("exact", renderers::exact, 30),
    law("pipe", renderers::pipe, 4),
    law("painted-exact", renderers::painted_exact, 30),
    law("painted-pipe", renderers::painted_pipe, 4),
    law("colored-exact", renderers::colored_exact, 30),
    law("colored-pipe", renderers::colored_pipe, 4),
    law("accelerated-pipe", accelerated::pipe, 4),
    law("accelerated-boosts", accelerated::boosts, 10),
    law("accelerated-turns", accelerated::turns, 10),
    law("accelerated-stretches", accelerated::stretches, 10),
    law("accelerated-mirror", mirror::accelerated_mirror, 20),
];
