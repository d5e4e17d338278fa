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
mod coplanar;
mod frames;
mod generate;
mod light;
mod mirror;
mod parts;
pub mod picture;
mod placement;
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

const fn law(name: &'static str, check: fn(&mut Random) -> Outcome) -> Law {
    Law { name, check }
}

/// All laws.
pub const LAWS: &[Law] = &[
    law("mirror", mirror::mirror),
    law("mirror-with-moving-lamps", mirror::mirror_with_moving_lamps),
    law("unseen-bodies", unseen::unseen_bodies),
    law("unused-statements", unseen::unused_statements),
    law("instances", unseen::instances),
    law("two-eyes", placement::two_eyes),
    law("boosts", frames::boosts),
    law("turns", frames::turns),
    law("parity", frames::parity),
    law("passing-eyes", frames::passing_eyes),
    law("vacuum", solids::vacuum),
    law("nested", solids::nested),
    law("delay", solids::delay),
    law("hollow", solids::hollow),
    law("under-water", solids::under_water),
    law("sums-of-spectra", light::sums_of_spectra),
    law("sums-of-quantities", light::sums_of_quantities),
    law("powers-of-doppler", light::powers_of_doppler),
    law("crops", parts::crops),
    law("stereo", parts::stereo),
    law("film-shutter", parts::film_shutter),
    law("lenses", parts::lenses),
    law("looked-up", parts::looked_up),
    law("exact", renderers::exact),
    law("pipe", renderers::pipe),
    law("painted-exact", renderers::painted_exact),
    law("painted-pipe", renderers::painted_pipe),
    law("colored-exact", renderers::colored_exact),
    law("colored-pipe", renderers::colored_pipe),
    law("coplanar-first", coplanar::first),
    law("coplanar-last", coplanar::last),
    law("accelerated-pipe", accelerated::pipe),
    law("accelerated-boosts", accelerated::boosts),
    law("accelerated-turns", accelerated::turns),
    law("accelerated-stretches", accelerated::stretches),
    law("accelerated-mirror", mirror::accelerated_mirror),
];
