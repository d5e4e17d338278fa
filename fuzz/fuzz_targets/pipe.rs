//! Scenes through the whole pipe in memory, with options that follow from the scene: no panic, what
//! a stage writes is read by the next, light is finite, and threads change nothing.
#![no_main]

ug_fuzz::target!(ugtests::hostile::File::Scene);
