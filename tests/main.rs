//! The tests of several crates, in one program: `cargo test -p ugtests MODULE` runs those of a
//! module.

#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a test fails by panicking, its helpers too"
)]

mod acceleration;
mod avenue;
mod determinism;
mod docs;
mod exact;
mod faces;
mod figures;
mod film;
mod film_inputs;
mod golden;
mod help;
mod history;
mod hostile;
mod laws;
mod light;
mod limits;
mod look;
mod maps;
mod mesh;
mod notes;
mod oracle;
mod own_time;
mod page;
mod postscript;
mod processors;
mod prompt;
mod reader;
mod rounds;
mod shells;
mod sky;
mod stage;
mod stop;
mod surround;
mod tidy;
mod untrusted;
mod warp;
mod world_lines;
mod worlds;
mod z_skipped;
