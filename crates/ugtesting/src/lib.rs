//! What tests of several crates share: reproducible random numbers, and programs run with text on
//! their standard input.

mod random;
pub mod run;

pub use random::Random;
